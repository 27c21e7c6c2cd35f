//! Where exactly are the two edges and the ends of the bat?
//!
//! Columns across the bat's axis, a pixel apart, are searched for the greatest change of colour between an object and
//! the ground. Each edge is the path along the bat with the largest sum of changes less a price for turning (dynamic
//! programming). It is then located between pixels by a parabola through the changes at three of them.

use crate::trace::find::Found;
use crate::trace::picture::{Colour, Ground, Picture, distance, mean};

/// Standard deviation of the Gaussian whose derivative filters the colours (px).
const BELL: f32 = 1.4;
/// Extent of the Gaussian to each side (px).
const REACH: usize = 4;
/// Number of columns to each side that are averaged.
const BESIDE: usize = 2;

/// The edges of a bat on a picture, in pixels along its axis and across it.
pub struct Edges {
    /// The axis, and the two ends along it.
    pub axis: Found,
    /// Position of the first column, from the origin.
    pub first: f64,
    /// Both edges at every column, a pixel apart.
    pub across: [Vec<f64>; 2],
}

impl Edges {
    /// Half the width at a column.
    pub fn half(&self, k: usize) -> f64 {
        0.5 * (self.across[1][k] - self.across[0][k])
    }

    pub fn columns(&self) -> usize {
        self.across[0].len()
    }

    /// The straight middle line: its height at the origin, its slope, and the middle's largest deviation from it (px).
    pub fn middle(&self) -> [f64; 3] {
        let n = self.columns() as f64;
        let all = || {
            (0..self.columns())
                .map(|k| (self.first + k as f64, 0.5 * (self.across[0][k] + self.across[1][k])))
        };
        let (mu, mv) = all().fold((0.0, 0.0), |(a, b), (u, v)| (a + u / n, b + v / n));
        let (uu, uv) = all()
            .fold((0.0, 0.0), |(a, b), (u, v)| (a + (u - mu) * (u - mu), b + (u - mu) * (v - mv)));
        let slope = uv / uu;
        let bow = all().map(|(u, v)| (v - mv - slope * (u - mu)).powi(2) / n).sum::<f64>().sqrt();
        [mv - slope * mu, slope, bow]
    }
}

/// Columns of the picture across an axis.
struct Columns<'a> {
    picture: &'a Picture<'a>,
    ground: &'a Ground,
    found: Found,
    /// Pixels across, to each side.
    wide: usize,
}

/// The change of colour by columns, and the excess of object over ground on the inner over the outer side.
struct Change {
    slope: Vec<f32>,
    score: [Vec<f32>; 2],
    rows: usize,
}

impl Columns<'_> {
    fn colour(&self, u: f64, v: f64) -> Colour {
        let [x, y] = self.found.place(u, v);
        self.picture.at(x, y)
    }

    fn off(&self, colour: Colour, u: f64, v: f64) -> f32 {
        let [x, y] = self.found.place(u, v);
        distance(colour, self.ground.at(x, y))
    }

    /// The changes along that number of columns.
    fn change(&self, first: f64, count: usize) -> Change {
        let rows = 2 * self.wide + 1;
        let across = |j: usize| j as f64 - self.wide as f64;
        let column = |k: isize| -> Vec<Colour> {
            (0..rows).map(|j| self.colour(first + k as f64, across(j))).collect()
        };
        let mut near: Vec<Vec<Colour>> =
            (0..=2 * BESIDE).map(|k| column(k as isize - BESIDE as isize)).collect();
        let mut change = Change { slope: vec![], score: [vec![], vec![]], rows };
        for k in 0..count {
            let mean: Vec<Colour> =
                (0..rows).map(|j| mean(near.iter().map(|one| one[j]))).collect();
            let u = first + k as f64;
            let off: Vec<f32> =
                mean.iter().enumerate().map(|(j, one)| self.off(*one, u, across(j))).collect();
            let slope = slopes(&mean);
            let share = shares(&off, self.ground.noise);
            for (side, score) in change.score.iter_mut().enumerate() {
                let sign = if side == 0 { 1.0 } else { -1.0 };
                score.extend(
                    slope.iter().zip(&share).map(|(slope, share)| weighed(*slope, sign * share)),
                );
            }
            change.slope.extend(slope);
            near.remove(0);
            near.push(column((k + 1 + BESIDE) as isize));
        }
        change
    }
}

/// The greatest change of colour at each pixel of a line that is smoothed by a Gaussian.
fn slopes(line: &[Colour]) -> Vec<f32> {
    let weight = |d: usize| d as f32 * (-0.5 * (d as f32 / BELL).powi(2)).exp();
    let weights: Vec<f32> = (1..=REACH).map(weight).collect();
    let last = line.len() - 1;
    (0..line.len())
        .map(|j| {
            let part = |i: usize| -> f32 {
                let pair = |(d, weight): (usize, &f32)| {
                    weight * (line[(j + d + 1).min(last)][i] - line[j.saturating_sub(d + 1)][i])
                };
                weights.iter().enumerate().map(pair).sum()
            };
            (0..3).map(|i| part(i).powi(2)).sum::<f32>().sqrt()
        })
        .collect()
}

/// At each pixel of a line: increase of the distance from the ground from before it to beyond it, as a share of both.
fn shares(off: &[f32], noise: f32) -> Vec<f32> {
    /// Number of pixels on each side that are averaged.
    const WINDOW: [usize; 2] = [2, 9];
    let last = off.len() - 1;
    let mean = |at: &dyn Fn(usize) -> usize| {
        (WINDOW[0]..WINDOW[1]).map(|d| off[at(d)]).sum::<f32>() / (WINDOW[1] - WINDOW[0]) as f32
    };
    (0..off.len())
        .map(|j| {
            let [before, beyond] = [mean(&|d| j.saturating_sub(d)), mean(&|d| (j + d).min(last))];
            (beyond - before) / (beyond + before + 2.0 * noise)
        })
        .collect()
}

/// The value of a change of colour as an edge: it is larger if the ground begins behind it. Beside a shadow that
/// differs from the ground as much as the bat does, the change alone counts.
fn weighed(slope: f32, share: f32) -> f32 {
    slope * (0.35 + 0.65 * share.max(0.0))
}

/// A peak between pixels: the top of the parabola through the largest of three values.
fn between(values: &[f32], j: usize) -> f64 {
    let near = j.saturating_sub(2)..(j + 3).min(values.len());
    let top = near.max_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(j);
    if top == 0 || top + 1 >= values.len() {
        return top as f64;
    }
    let [a, b, c] = [values[top - 1], values[top], values[top + 1]].map(f64::from);
    let bend = a - 2.0 * b + c;
    top as f64 + if bend < 0.0 { (0.5 * (a - c) / bend).clamp(-0.5, 0.5) } else { 0.0 }
}

/// The path over the columns with the largest sum less the price of turning: a row for each column.
fn path(score: &[f32], rows: usize, allowed: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    /// Price of a step of one row (four times that for two rows), and of a jump over any number.
    const PRICE: (f32, f32) = (0.05, 2.0);
    const STEPS: usize = 3;
    const NEVER: f32 = -1e6;
    let count = score.len() / rows;
    let mut tops: Vec<f32> =
        score.chunks(rows).map(|one| one.iter().copied().fold(0.0, f32::max)).collect();
    tops.sort_by(f32::total_cmp);
    let usual = tops[count / 2].max(1e-6);
    let mut came = vec![0_u16; score.len()];
    let mut best = vec![0.0_f32; rows];
    for (k, column) in score.chunks(rows).enumerate() {
        let leap = (0..rows).max_by(|a, b| best[*a].total_cmp(&best[*b])).unwrap_or(0);
        let next = (0..rows).map(|j| {
            let mut from = (best[leap] - PRICE.1, leap);
            let near = j.saturating_sub(STEPS);
            for (i, best) in best.iter().enumerate().take(j + STEPS + 1).skip(near) {
                let value = best - PRICE.0 * i.abs_diff(j).pow(2) as f32;
                from = if value > from.0 { (value, i) } else { from };
            }
            came[k * rows + j] = from.1 as u16;
            from.0 + if allowed(k, j) { (column[j] / usual).min(1.5) } else { NEVER }
        });
        best = next.collect();
    }
    let mut row = (0..rows).max_by(|a, b| best[*a].total_cmp(&best[*b])).unwrap_or(0);
    let mut rows_of = vec![0; count];
    for k in (0..count).rev() {
        rows_of[k] = row;
        row = usize::from(came[k * rows + row]);
    }
    rows_of
}

/// Largest distance of an edge from a pin, in rows.
const PINNED: f64 = 1.5;

/// The rows where the pins of an edge, in order, allow it at a place along the axis: a row and a tolerance. Between two
/// pins that is near the straight line.
fn corridor(pins: &[[f64; 2]], u: f64) -> Option<[f64; 2]> {
    /// Tolerance in rows, and as a share of the distance to a pin.
    const BESIDE: (f64, f64) = (3.0, 0.02);
    if let Some([_, at]) = pins.iter().find(|pin| (pin[0] - u).abs() <= 2.0) {
        return Some([*at, PINNED]);
    }
    let next = pins.iter().position(|pin| pin[0] > u).filter(|next| *next > 0)?;
    let ([a, one], [b, other]) = (pins[next - 1], pins[next]);
    Some([one + (other - one) * (u - a) / (b - a), BESIDE.0 + BESIDE.1 * (b - a)])
}

/// The edges of a bat that was found. `pins` are places (px) that the user has set on an edge or an end.
pub fn edges(picture: &Picture, ground: &Ground, found: Found, pins: &[[f64; 2]]) -> Edges {
    /// Searched width on each side, as a share of the largest half width and in additional px.
    const ROOM: (f64, f64) = (1.25, 16.0);
    let mut found = found;
    let mut edges = None;
    // Shadows turn the axis of the object that was found; that of the edges is the bat's.
    for _ in 0..2 {
        let wide = (ROOM.0 * found.half + ROOM.1).ceil() as usize;
        let columns = Columns { picture, ground, found, wide };
        let one = columns.edges(pins);
        let [height, slope, _] = one.middle();
        let [c, s] = found.along;
        let turned = [c - slope * s, s + slope * c];
        let long = turned[0].hypot(turned[1]);
        let half = (0..one.columns()).map(|k| one.half(k)).fold(0.0, f64::max);
        found = Found {
            middle: one.axis.place(0.0, height),
            along: turned.map(|t| t / long),
            half,
            ..one.axis
        };
        edges = Some(one);
    }
    edges.expect("two rounds")
}

impl Columns<'_> {
    fn edges(&self, pins: &[[f64; 2]]) -> Edges {
        /// Rows about the axis that are not searched.
        const CORE: usize = 2;
        let first = self.found.ends[0].ceil();
        let count = (self.found.ends[1].floor() - first) as usize;
        let Change { slope, score, rows } = self.change(first, count);
        let pins: Vec<[f64; 2]> = pins.iter().map(|pin| self.found.along_across(*pin)).collect();
        let mut across = [0, 1].map(|side| {
            let mut own: Vec<[f64; 2]> =
                pins.iter().filter(|pin| (pin[1] < 0.0) == (side == 0)).copied().collect();
            own.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let corridors: Vec<Option<[f64; 2]>> =
                (0..count).map(|k| corridor(&own, first + k as f64)).collect();
            let allowed = |k: usize, j: usize| {
                let v = j as f64 - self.wide as f64;
                let outside = if side == 0 { j + CORE < self.wide } else { j > self.wide + CORE };
                outside && corridors[k].is_none_or(|[at, wide]| (at - v).abs() <= wide)
            };
            let rows_of = path(&score[side], rows, allowed);
            let exact = rows_of.iter().enumerate().map(|(k, j)| match corridors[k] {
                Some([at, PINNED]) => at,
                _ => between(&slope[k * rows..(k + 1) * rows], *j) - self.wide as f64,
            });
            middles(&exact.collect::<Vec<_>>())
        });
        let ends = [0, 1].map(|end| self.end(end, &across, &pins));
        // Beyond the ends there are no edges.
        let from = ((ends[0] - first).ceil().max(0.0) as usize).min(count - 1);
        let to = ((ends[1] - first).floor().max(0.0) as usize).clamp(from + 1, count);
        across = across.map(|edge| edge[from..to].to_vec());
        let first = first + from as f64;
        Edges { axis: Found { ends, ..self.found }, first, across }
    }

    /// The position of an end: the greatest change of colour along the axis, in the inner part of the width.
    fn end(&self, end: usize, across: &[Vec<f64>; 2], pins: &[[f64; 2]]) -> f64 {
        /// Searched pixels on each side of the end that was found.
        const AROUND: usize = 80;
        /// Averaged part of half the width.
        const INNER: f64 = 0.3;
        let count = across[0].len();
        let near =
            if end == 0 { 60..100 } else { count.saturating_sub(100)..count.saturating_sub(60) };
        let of = |edge: &[f64]| {
            let mut some = edge[near.start.min(count)..near.end.min(count)].to_vec();
            some.sort_by(f64::total_cmp);
            some.get(some.len() / 2).copied().unwrap_or(0.0)
        };
        let [one, other] = [of(&across[0]), of(&across[1])];
        let (middle, half) = (0.5 * (one + other), 0.5 * (other - one));
        let about = self.found.ends[end];
        let set = pins.iter().find(|[u, v]| {
            (u - about).abs() < 1.5 * AROUND as f64 && (v - middle).abs() < 0.6 * half
        });
        if let Some([u, _]) = set {
            return *u;
        }
        let inner = (INNER * half).max(1.0) as i32;
        let from = about.round() - AROUND as f64;
        let line: Vec<Colour> = (0..=2 * AROUND)
            .map(|k| {
                let row = |v: i32| self.colour(from + k as f64, middle + f64::from(v - inner));
                mean((0..2 * inner + 1).map(row))
            })
            .collect();
        let off = line.iter().enumerate().map(|(k, one)| self.off(*one, from + k as f64, middle));
        let off: Vec<f32> = off.collect();
        let slope = slopes(&line);
        let sign = if end == 0 { 1.0 } else { -1.0 };
        let shares = shares(&off, self.ground.noise);
        let score = |j: &usize| weighed(slope[*j], sign * shares[*j]);
        let best = (0..slope.len()).max_by(|a, b| score(a).total_cmp(&score(b))).unwrap_or(AROUND);
        from + between(&slope, best)
    }
}

/// The median of five neighbours, to remove outliers.
fn middles(values: &[f64]) -> Vec<f64> {
    (0..values.len())
        .map(|k| {
            let mut near = values[k.saturating_sub(2)..(k + 3).min(values.len())].to_vec();
            near.sort_by(f64::total_cmp);
            near[near.len() / 2]
        })
        .collect()
}
