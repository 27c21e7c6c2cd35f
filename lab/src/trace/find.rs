//! Where in the picture is the bat?

use sweetspot::base::error::{Error, Result};

use crate::trace::picture::{Ground, Picture, distance, mean};

/// The position of the bat (px): the middle of the object that differs from the ground, the direction of its axis, its
/// extent to both sides along the axis, and half its width.
#[derive(Debug, Clone, Copy)]
pub struct Found {
    pub middle: [f64; 2],
    pub along: [f64; 2],
    pub ends: [f64; 2],
    pub half: f64,
    /// Its contrast: distance from the ground in colour, over the ground's noise.
    pub contrast: f32,
}

impl Found {
    /// A place of the picture from along the axis and across it.
    pub fn place(&self, u: f64, v: f64) -> [f64; 2] {
        let ([x, y], [c, s]) = (self.middle, self.along);
        [x + u * c - v * s, y + u * s + v * c]
    }

    /// Coordinates of a place of the picture along the axis and across it.
    pub fn along_across(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([x, y], [c, s]) = ([x - self.middle[0], y - self.middle[1]], self.along);
        [x * c + y * s, y * c - x * s]
    }
}

/// A picture in cells: distance of each from the ground in colour.
struct Cells {
    size: usize,
    width: usize,
    height: usize,
    off: Vec<f32>,
}

impl Cells {
    fn of(picture: &Picture, ground: &Ground) -> Self {
        /// Number of cells along the longer side.
        const ALONG: usize = 800;
        let size = picture.width.max(picture.height).div_ceil(ALONG);
        let (width, height) = ((picture.width / size).max(1), (picture.height / size).max(1));
        let off = (0..width * height).map(|k| {
            let (x, y) = (k % width * size, k / width * size);
            let one = |j: usize| picture.pixel((x + j % size) as isize, (y + j / size) as isize);
            let (mean, middle) = (mean((0..size * size).map(one)), 0.5 * (size - 1) as f64);
            distance(mean, ground.at(x as f64 + middle, y as f64 + middle))
        });
        Self { size, width, height, off: off.collect() }
    }

    /// The level above which a cell belongs to an object. The bat fills some hundredths of a picture or, if it is
    /// small, some thousandths: the level is that of the first of these shares that reaches the contrast.
    fn level(&self, contrast: f32) -> f32 {
        const SHARES: [f64; 3] = [0.98, 0.995, 0.998];
        let mut all = self.off.clone();
        all.sort_by(f32::total_cmp);
        let at = |share: f64| all[((all.len() as f64 * share) as usize).min(all.len() - 1)];
        SHARES.map(at).into_iter().find(|level| *level >= contrast).unwrap_or(at(SHARES[0]))
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

/// An error if a condition holds.
fn refuse(so: bool, found: String, expected: &str) -> Result<()> {
    if so { Err(Error::value("the picture", found, expected)) } else { Ok(()) }
}

/// Finds the bat.
///
/// # Errors
///
/// [`Error::Value`] if nothing differs from the ground, if an object is cut off by the edge of the picture, if there
/// are several objects, and if the object is too small or not as slender as a bat.
pub fn find(picture: &Picture, ground: &Ground) -> Result<Found> {
    /// Least contrast of a bat over the ground's noise, as the mean of its cells.
    const CONTRAST: f32 = 4.0;
    /// Least area of a second object, as a share of the largest.
    const ANOTHER: f64 = 0.06;
    /// Least ratio of length to mean width: a bat has 15 to 25.
    const SLENDER: [f64; 2] = [8.0, 40.0];
    /// Least number of pixels along the bat.
    const LEAST: f64 = 700.0;
    let cells = Cells::of(picture, ground);
    let bat = cells.level(CONTRAST * ground.noise);
    let contrast = bat / ground.noise;
    let plain = "a bat on plain ground of another colour, in even light";
    let told = format!("no bat: what stands out most is {contrast:.1} times the ground's noise");
    refuse(contrast < CONTRAST, told, plain)?;
    let groups = cells.groups(0.6 * bat);
    let Some((group, others)) = groups.split_first().filter(|(group, _)| group.len() > 40) else {
        return Err(Error::value("the picture", "no bat", plain));
    };
    let others = others.iter().filter(|one| one.len() as f64 > ANOTHER * group.len() as f64);
    let things = 1 + others.count();
    refuse(things > 1, format!("{things} things on the ground"), "one bat and nothing else")?;
    let cut = group.iter().any(|k| {
        let (x, y) = (k % cells.width, k / cells.width);
        x == 0 || y == 0 || x + 1 == cells.width || y + 1 == cells.height
    });
    refuse(cut, "a bat that is cut off by its edge".to_owned(), "the whole bat, ground around it")?;
    let found = Found { contrast, ..axis(&cells, group) };
    let length = found.ends[1] - found.ends[0];
    let slender = length * length / (group.len() * cells.size * cells.size) as f64;
    let told = format!("a thing {slender:.1} times as long as wide");
    refuse(!(SLENDER[0]..SLENDER[1]).contains(&slender), told, "a bat, which is 15 to 25 times")?;
    let expected = "1500 for 0.3 mm, 700 at least: come nearer with the zoom";
    refuse(length < LEAST, format!("a bat {length:.0} pixels long"), expected)?;
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
    let mut found = Found { middle, along, ends: [0.0; 2], half: 0.0, contrast: 0.0 };
    for k in group {
        let [u, v] = found.along_across(place(k));
        found.ends = [found.ends[0].min(u), found.ends[1].max(u)];
        found.half = found.half.max(v.abs());
    }
    found
}
