//! Where on the picture does a bat lie?

use sweetspot::base::error::{Error, Result};

use crate::trace::picture::{Colour, Ground, Picture, distance};

/// Where the bat lies (px): the middle of what stands out from the ground, the direction of its axis, how far it
/// reaches to both sides along it and, half, across it.
#[derive(Debug, Clone, Copy)]
pub struct Found {
    pub middle: [f64; 2],
    pub along: [f64; 2],
    pub ends: [f64; 2],
    pub half: f64,
    /// How far it is from the ground in colour, over the ground's noise.
    pub contrast: f32,
}

/// A picture in cells: how far each is from the ground.
struct Cells {
    size: usize,
    width: usize,
    height: usize,
    off: Vec<f32>,
}

impl Cells {
    fn of(picture: &Picture, ground: &Ground) -> Self {
        /// Cells along the longer side.
        const ALONG: usize = 800;
        let size = picture.width.max(picture.height).div_ceil(ALONG);
        let (width, height) = (picture.width / size, picture.height / size);
        let off = (0..width * height).map(|k| {
            let (x, y) = (k % width * size, k / width * size);
            let mut sum = Colour::default();
            for j in 0..size * size {
                let one = picture.pixel((x + j % size) as isize, (y + j / size) as isize);
                sum.iter_mut().zip(one).for_each(|(sum, one)| *sum += one);
            }
            let (mean, middle) =
                (sum.map(|sum| sum / (size * size) as f32), 0.5 * (size - 1) as f64);
            distance(mean, ground.at(x as f64 + middle, y as f64 + middle))
        });
        Self { size, width, height, off: off.collect() }
    }

    /// How far a bat, which fills some hundredths of a picture, is from the ground.
    fn level(&self) -> f32 {
        const SHARE: f64 = 0.98;
        let mut all = self.off.clone();
        all.sort_by(f32::total_cmp);
        all[((all.len() as f64 * SHARE) as usize).min(all.len() - 1)]
    }

    /// Connected cells above the level, the largest group first.
    fn groups(&self, level: f32) -> Vec<Vec<usize>> {
        let mut open: Vec<bool> = self.off.iter().map(|off| *off > level).collect();
        let mut groups = vec![];
        for first in 0..open.len() {
            if !std::mem::take(&mut open[first]) {
                continue;
            }
            let mut group = vec![first];
            let mut done = 0;
            while done < group.len() {
                let (x, y) = (group[done] % self.width, group[done] / self.width);
                let beside = [
                    (x > 0).then(|| group[done] - 1),
                    (x + 1 < self.width).then(|| group[done] + 1),
                    (y > 0).then(|| group[done] - self.width),
                    (y + 1 < self.height).then(|| group[done] + self.width),
                ];
                group
                    .extend(beside.into_iter().flatten().filter(|k| std::mem::take(&mut open[*k])));
                done += 1;
            }
            groups.push(group);
        }
        groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
        groups
    }
}

fn refused(found: impl std::fmt::Display, expected: &str) -> Error {
    Error::value("the picture", found, expected)
}

/// Finds the bat.
///
/// # Errors
///
/// [`Error::Value`] where nothing stands out from the ground, where something is cut off by the picture's edge, where
/// several things lie there, where the one that does is not as slender as a bat, and where it is too small.
pub fn find(picture: &Picture, ground: &Ground) -> Result<Found> {
    /// Times the ground's noise that a bat differs from it, in the mean of its cells.
    const CONTRAST: f32 = 4.0;
    /// Of the largest thing's area, what another one has at least.
    const ANOTHER: f64 = 0.06;
    /// Times as long as wide on average: a bat is 15 to 25.
    const SLENDER: [f64; 2] = [8.0, 40.0];
    /// Pixels along the bat.
    const LEAST: f64 = 700.0;
    let cells = Cells::of(picture, ground);
    let bat = cells.level();
    let plain = "a bat on plain ground of another colour, in even light";
    let contrast = bat / ground.noise;
    if contrast < CONTRAST {
        return Err(refused(
            format!("no bat: what stands out most is {contrast:.1} times the ground's noise"),
            plain,
        ));
    }
    let groups = cells.groups(0.6 * bat);
    let Some(group) = groups.first().filter(|group| group.len() > 40) else {
        return Err(refused("no bat: nothing large stands out from the ground", plain));
    };
    let others = groups[1..].iter().filter(|one| one.len() as f64 > ANOTHER * group.len() as f64);
    let others = others.count();
    if others > 0 {
        return Err(refused(
            format!("{} things on the ground", others + 1),
            "one bat and nothing else",
        ));
    }
    let cut = |k: &usize| {
        let (x, y) = (k % cells.width, k / cells.width);
        x == 0 || y == 0 || x + 1 == cells.width || y + 1 == cells.height
    };
    if group.iter().any(cut) {
        return Err(refused(
            "a bat that is cut off by its edge",
            "the whole bat with ground around it",
        ));
    }
    let found = Found { contrast, ..axis(&cells, group) };
    let length = found.ends[1] - found.ends[0];
    let wide = (group.len() * cells.size * cells.size) as f64 / length;
    let slender = length / wide;
    if !(SLENDER[0]..SLENDER[1]).contains(&slender) {
        return Err(refused(
            format!("a thing {slender:.1} times as long as wide"),
            "a bat, which is 15 to 25 times",
        ));
    }
    if length < LEAST {
        let expected = "1500 pixels for 0.3 mm, 700 at least: come nearer with the zoom, or send the picture itself";
        return Err(refused(format!("a bat {length:.0} pixels long"), expected));
    }
    Ok(found)
}

/// The principal axis of a group of cells.
fn axis(cells: &Cells, group: &[usize]) -> Found {
    let place = |k: &usize| {
        let middle = |at: usize| (at * cells.size) as f64 + 0.5 * (cells.size - 1) as f64;
        [middle(k % cells.width), middle(k / cells.width)]
    };
    let count = group.len() as f64;
    let middle: [f64; 2] =
        std::array::from_fn(|j| group.iter().map(|k| place(k)[j]).sum::<f64>() / count);
    let product = |i: usize, j: usize| -> f64 {
        group.iter().map(|k| (place(k)[i] - middle[i]) * (place(k)[j] - middle[j])).sum()
    };
    let angle = 0.5 * (2.0 * product(0, 1)).atan2(product(0, 0) - product(1, 1));
    let along = [angle.cos(), angle.sin()];
    let (mut ends, mut half) = ([0.0_f64; 2], 0.0_f64);
    for k in group {
        let [x, y] = [place(k)[0] - middle[0], place(k)[1] - middle[1]];
        let u = x * along[0] + y * along[1];
        ends = [ends[0].min(u), ends[1].max(u)];
        half = half.max((y * along[0] - x * along[1]).abs());
    }
    Found { middle, along, ends, half, contrast: 0.0 }
}
