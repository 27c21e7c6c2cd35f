//! A bat drawn with characters, and below it where its places are.

use std::fmt::Write;

use crate::parts::Units;
use sweetspot::base::units::inches;
use sweetspot::collision::SweetSpot;
use sweetspot::{Bat, Solution};

/// Columns left of the drawing, for the labels of its rows.
pub const GUTTER: usize = 12;
/// Columns of the drawing. The knob end is at the beginning of the first and the tip at the end of the last.
pub const WIDTH: usize = 66;
/// Rows above and below the axis at most.
const HALF_HEIGHT: usize = 4;
/// A character is about twice as high as wide. Drawn at three times its thickness, the bat shows its taper in half
/// rows.
const THICKER: f64 = 3.0;

/// The characters of the drawing: block elements, or ASCII for terminals without them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Glyphs {
    /// Unicode's full and half blocks.
    Blocks,
    /// `#`, `.`, `'` and `-`.
    Ascii,
}

impl Glyphs {
    /// A full cell, one with a full lower half, one with a full upper half; the line of the ruler.
    fn characters(self) -> [char; 4] {
        match self {
            Self::Blocks => ['█', '▄', '▀', '─'],
            Self::Ascii => ['#', '.', '\'', '-'],
        }
    }
}

/// Places below the bat (m), and their label.
#[derive(Debug, Clone, PartialEq)]
pub struct SketchRow {
    /// The label on the left of the drawing, at most ten columns.
    pub label: String,
    /// The marks below the bat.
    pub places: Places,
}

/// Single places, or a stretch.
#[derive(Debug, Clone, PartialEq)]
pub enum Places {
    /// A mark at each of them (m from the knob end).
    Points(Vec<f64>),
    /// From one place to another (m from the knob end).
    Zone([f64; 2]),
}

impl SketchRow {
    fn points(label: impl Into<String>, places: &[f64]) -> Self {
        Self { label: label.into(), places: Places::Points(places.to_vec()) }
    }
}

/// The bat, rulers from the knob end, and the rows; 78 columns wide.
pub fn draw(bat: &Bat, rows: &[SketchRow], units: Units, glyphs: Glyphs) -> String {
    let mut out = outline(bat, glyphs);
    let rulers = [(Units::Us, "inches", inches(1.0), 5.0), (Units::Si, "cm", 100.0, 10.0)];
    for (system, unit, of_a_metre, step) in rulers {
        if units.both() || units == system {
            let line = ruler(bat.length() * of_a_metre, step, glyphs);
            line_of(unit, &line, &mut out);
        }
    }
    for row in rows {
        line_of(&row.label, &marks(&row.places, bat.length()), &mut out);
    }
    out
}

/// The nodes of the first modes, and the balance point.
pub fn of_modes(bat: &Bat, solution: &Solution) -> Vec<SketchRow> {
    const MOST: usize = 5;
    let nodes = solution.modes.iter().take(MOST);
    let nodes = nodes.map(|mode| SketchRow::points(format!("mode {}", mode.order), &mode.nodes));
    nodes.chain([balance(bat)]).collect()
}

fn balance(bat: &Bat) -> SketchRow {
    SketchRow::points("balance", &[bat.inertia().balance_point])
}

/// The place of the highest exit speed, and the zone around it.
pub fn of_sweet_spot(spot: &SweetSpot) -> Vec<SketchRow> {
    let best = spot.exit_speed_max.map(|peak| SketchRow::points("fastest", &[peak.x]));
    let zone =
        spot.zone.map(|zone| SketchRow { label: "within 1 %".into(), places: Places::Zone(zone) });
    best.into_iter().chain(zone).collect()
}

/// The places found by a hit: nodes of the barrel, balance point, centre of percussion, sweet spot.
pub fn of_hit(bat: &Bat, spot: &SweetSpot) -> Vec<SketchRow> {
    let named = [
        ("node 1", spot.node_mode_1),
        ("node 2", spot.node_mode_2),
        ("balance", Some(bat.inertia().balance_point)),
        ("percussion", spot.center_of_percussion),
    ];
    let known = named.into_iter().filter_map(|(label, x)| Some(SketchRow::points(label, &[x?])));
    known.chain(of_sweet_spot(spot)).collect()
}

/// Half rows on each side of the axis, column by column, as the radius in the column's middle: in
/// proportion to it, and one at least.
fn half_heights(bat: &Bat) -> [usize; WIDTH] {
    let column = bat.length() / WIDTH as f64;
    let middle = |k: usize| bat.profile().at((k as f64 + 0.5) * column).outer;
    let widest = (0..WIDTH).map(middle).fold(f64::MIN_POSITIVE, f64::max);
    // A half row is as high as a column is wide.
    let scale = (THICKER / column).min((2 * HALF_HEIGHT) as f64 / widest);
    std::array::from_fn(|k| (middle(k) * scale).round().max(1.0) as usize)
}

fn outline(bat: &Bat, glyphs: Glyphs) -> String {
    let heights = half_heights(bat);
    let [full, lower, upper, _] = glyphs.characters();
    let rows = heights.iter().max().map_or(1, |most| most.div_ceil(2));
    let mut out = String::new();
    let mut row = |from_axis: usize, half: char| {
        let cell = |height: &usize| match height.saturating_sub(2 * from_axis) {
            0 => ' ',
            1 => half,
            _ => full,
        };
        line_of("", &heights.iter().map(cell).collect::<String>(), &mut out);
    };
    (0..rows).rev().for_each(|from_axis| row(from_axis, lower));
    (0..rows).for_each(|from_axis| row(from_axis, upper));
    out
}

/// A line with the number of every `step` where it begins; `step` is doubled or halved until the
/// numbers fit a very long or very short bat.
fn ruler(length: f64, step: f64, glyphs: Glyphs) -> String {
    /// As a share of the length of the drawing, so that the numbers are separated.
    const LEAST: f64 = 0.09;
    let mut step = step;
    while step < LEAST * length {
        step *= 2.0;
    }
    while step > 0.5 * length {
        step /= 2.0;
    }
    let mut line = vec![glyphs.characters()[3]; WIDTH];
    for k in 0..=(length / step) as usize {
        let at = column(k as f64 * step, length);
        let number = format!("{}", k as f64 * step);
        if at + number.len() <= WIDTH && number.len() < (LEAST * WIDTH as f64) as usize {
            line[at..at + number.len()].copy_from_slice(&number.chars().collect::<Vec<_>>());
        }
    }
    line.into_iter().collect()
}

/// The column of a place on an object of that length.
fn column(x: f64, length: f64) -> usize {
    ((x / length * WIDTH as f64).max(0.0) as usize).min(WIDTH - 1)
}

fn marks(places: &Places, length: f64) -> String {
    let mut line = [' '; WIDTH];
    match places {
        // A point beyond the bat, such as a balance point may be, has no column.
        Places::Points(points) => {
            let on = points.iter().filter(|x| (0.0..=length).contains(*x));
            on.for_each(|x| line[column(*x, length)] = '^');
        }
        Places::Zone([from, to]) => {
            let (from, to) = (column(*from, length), column(*to, length));
            line[from..=to].fill('=');
            (line[from], line[to]) = ('[', ']');
        }
    }
    line.iter().collect()
}

fn line_of(label: &str, drawing: &str, out: &mut String) {
    let width = GUTTER - 2;
    let _ = writeln!(out, "{}", format!("  {label:<width$}{drawing}").trim_end());
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::modes::solve::{Request, solve};
    use sweetspot_proof::bundled::bundled_bat;

    /// The drawing in a line, column by column.
    fn drawing(line: &str) -> Vec<char> {
        line.chars().skip(GUTTER).collect()
    }

    #[test]
    fn a_mark_stands_in_the_column_of_its_place() {
        let bat = bundled_bat("meshes/r161.json").unwrap();
        let solution = solve(&bat, &Request { modes: 3, ..Request::plain() }).unwrap();
        let drawn = draw(&bat, &of_modes(&bat, &solution), Units::Both, Glyphs::Blocks);
        for mode in &solution.modes {
            let label = format!("  mode {}", mode.order);
            let line = drawn.lines().find(|line| line.starts_with(&label)).unwrap();
            let at = drawing(line).into_iter().enumerate().filter(|(_, c)| *c == '^');
            let at: Vec<usize> = at.map(|(k, _)| k).collect();
            assert_eq!(at.len(), mode.nodes.len(), "{drawn}");
            for (k, x) in at.iter().zip(&mode.nodes) {
                let [from, to] = [*k, k + 1].map(|k| k as f64 / WIDTH as f64 * bat.length());
                assert!((from..to).contains(x), "{k} {x} {drawn}");
            }
        }
    }

    #[test]
    fn the_ruler_s_numbers_stand_where_they_are() {
        let bat = bundled_bat("meshes/dowel.json").unwrap();
        let drawn = draw(&bat, &[], Units::Us, Glyphs::Ascii);
        let line = drawing(drawn.lines().last().unwrap());
        // Two columns an inch.
        assert_eq!(line[20..22], ['1', '0']);
        assert_eq!(line[60..62], ['3', '0']);
        assert_eq!(line.len(), WIDTH);
    }

    #[test]
    fn the_outline_is_as_wide_as_the_radius_in_its_column() {
        for name in ["r161", "cone", "dowel", "torpedo", "two_piece"] {
            let bat = bundled_bat(&format!("meshes/{name}.json")).unwrap();
            for (glyphs, full) in [(Glyphs::Blocks, '█'), (Glyphs::Ascii, '#')] {
                let drawn = outline(&bat, glyphs);
                let rows: Vec<Vec<char>> = drawn.lines().map(drawing).collect();
                let halves = |k: usize| {
                    let cells = rows.iter().map(|row| row.get(k).copied().unwrap_or(' '));
                    cells.map(|c| if c == full { 2.0 } else { f64::from(c != ' ') }).sum::<f64>()
                };
                let radius = |k: usize| {
                    bat.profile().at((k as f64 + 0.5) / WIDTH as f64 * bat.length()).outer
                };
                let widest = (0..WIDTH).max_by(|a, b| radius(*a).total_cmp(&radius(*b))).unwrap();
                for k in 0..WIDTH {
                    // Half a half row on each side is round-off, of this column and of the widest.
                    let expected = halves(widest) * radius(k) / radius(widest);
                    let off = (halves(k) - expected).abs();
                    assert!(off <= 2.0 || halves(k) == 2.0, "{name} {k}: {off}\n{drawn}");
                }
            }
        }
    }

    #[test]
    fn a_zone_covers_its_columns_and_every_row_fits() {
        let bat = bundled_bat("meshes/torpedo.json").unwrap();
        let zone = Places::Zone([0.5 * bat.length(), bat.length()]);
        let rows = [SketchRow { label: "within 1 %".into(), places: zone }];
        let drawn = draw(&bat, &rows, Units::Both, Glyphs::Blocks);
        let line = drawing(drawn.lines().last().unwrap());
        let begins = line.iter().position(|c| *c == '[');
        assert_eq!((begins, line.len(), line[WIDTH - 1]), (Some(WIDTH / 2), WIDTH, ']'));
        assert!(drawn.lines().all(|line| line.chars().count() <= GUTTER + WIDTH), "{drawn}");
    }
}
