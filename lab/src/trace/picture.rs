//! What is the colour of a place in the picture, and what would it be without a bat?

use sweetspot::base::error::{Error, Result};
use sweetspot::base::linear::inverse;

/// Red, green and blue, 0 to 255.
pub type Colour = [f32; 3];

/// A picture as a canvas gives it: four bytes per pixel, line by line from the top.
pub struct Picture<'a> {
    pub width: usize,
    pub height: usize,
    bytes: &'a [u8],
}

/// Most pixels along a side of a picture.
const MOST: usize = 8192;

impl<'a> Picture<'a> {
    /// # Errors
    ///
    /// [`Error::Value`] if there are not four bytes for each pixel.
    pub fn new(width: usize, height: usize, bytes: &'a [u8]) -> Result<Self> {
        if width.max(height) > MOST {
            let found = format!("{width} by {height} pixels");
            return Err(Error::value("the picture", found, format!("{MOST} along a side at most")));
        }
        let expected = width.checked_mul(height).and_then(|pixels| pixels.checked_mul(4));
        if expected != Some(bytes.len()) || bytes.is_empty() {
            let found = format!("{} bytes for {width} by {height} pixels", bytes.len());
            return Err(Error::value("the picture", found, "four bytes a pixel"));
        }
        Ok(Self { width, height, bytes })
    }

    /// The colour of a pixel; outside the picture, that of the nearest pixel in it.
    pub fn pixel(&self, x: isize, y: isize) -> Colour {
        let inside = |at: isize, size: usize| at.clamp(0, size as isize - 1) as usize;
        let at = 4 * (inside(y, self.height) * self.width + inside(x, self.width));
        std::array::from_fn(|k| f32::from(self.bytes[at + k]))
    }

    /// The colour at a place (px), between the middles of four pixels.
    pub fn at(&self, x: f64, y: f64) -> Colour {
        let (left, top) = (x.floor(), y.floor());
        let (right, down) = ((x - left) as f32, (y - top) as f32);
        let corner = |dx, dy| self.pixel(left as isize + dx, top as isize + dy);
        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
        std::array::from_fn(|k| {
            let above = a[k] + (b[k] - a[k]) * right;
            above + (c[k] + (d[k] - c[k]) * right - above) * down
        })
    }
}

/// The mean of some colours.
pub fn mean(colours: impl ExactSizeIterator<Item = Colour>) -> Colour {
    let count = colours.len() as f32;
    let add = |sum: Colour, one: Colour| std::array::from_fn(|k| sum[k] + one[k]);
    colours.fold(Colour::default(), add).map(|sum| sum / count)
}

/// The distance of two colours.
pub fn distance(one: Colour, other: Colour) -> f32 {
    one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt()
}

/// The ground that the bat lies on: each colour is a quadratic function of the place.
pub struct Ground {
    size: [f64; 2],
    factors: [[f64; TERMS]; 3],
    /// Median deviation of its pixels.
    pub noise: f32,
}

/// Number of terms of a quadratic function of two numbers.
const TERMS: usize = 6;

impl Ground {
    /// The ground, fitted to the pixels along the frame of the picture without outliers.
    pub fn of(picture: &Picture) -> Self {
        /// The width of the frame as a share of the picture's shorter side, and the number of pixels that are used.
        const FRAME: (f64, usize) = (0.06, 20_000);
        /// Number of fits, and largest deviation of a used pixel beyond the median (in noises).
        const ROUNDS: (usize, f32) = (4, 3.0);
        let Picture { width, height, .. } = *picture;
        let deep = ((width.min(height) as f64 * FRAME.0) as usize).max(1);
        let step = (2 * deep * (width + height) / FRAME.1 + 1).isqrt().max(1);
        let framed =
            |x: usize, y: usize| x.min(width - 1 - x) < deep || y.min(height - 1 - y) < deep;
        let places = (0..height).step_by(step).flat_map(|y| {
            (0..width).step_by(step).filter(move |x| framed(*x, y)).map(move |x| (x, y))
        });
        let mut seen: Vec<(f64, f64, Colour)> = places
            .map(|(x, y)| (x as f64, y as f64, picture.pixel(x as isize, y as isize)))
            .collect();
        let mut ground =
            Self { size: [width as f64, height as f64], factors: Default::default(), noise: 0.0 };
        for _ in 0..ROUNDS.0 {
            ground.fit(&seen);
            let off = |(x, y, colour): &(f64, f64, Colour)| distance(*colour, ground.at(*x, *y));
            let mut all: Vec<f32> = seen.iter().map(off).collect();
            all.sort_by(f32::total_cmp);
            let noise = all[all.len() / 2].max(0.5);
            seen.retain(|one| off(one) <= ROUNDS.1 * noise);
            ground.noise = noise;
        }
        ground
    }

    /// The terms at a place in parts of the picture, −1 to 1.
    fn scaled(&self, x: f64, y: f64) -> [f64; TERMS] {
        let (x, y) = (2.0 * x / self.size[0] - 1.0, 2.0 * y / self.size[1] - 1.0);
        [1.0, x, y, x * x, x * y, y * y]
    }

    /// The least-squares fit to these pixels.
    fn fit(&mut self, seen: &[(f64, f64, Colour)]) {
        let mut matrix = vec![vec![0.0; TERMS]; TERMS];
        let mut right = [[0.0; TERMS]; 3];
        for (x, y, colour) in seen {
            let row = self.scaled(*x, *y);
            for i in 0..TERMS {
                for (sum, other) in matrix[i].iter_mut().zip(row) {
                    *sum += row[i] * other;
                }
                for (sums, colour) in right.iter_mut().zip(colour) {
                    sums[i] += row[i] * f64::from(*colour);
                }
            }
        }
        // A picture of one line has no slope across it.
        (0..TERMS).for_each(|i| matrix[i][i] += 1e-9 * seen.len() as f64);
        let Some(inverse) = inverse(&matrix) else { return };
        for (factors, right) in self.factors.iter_mut().zip(right) {
            for (factor, row) in factors.iter_mut().zip(&inverse) {
                *factor = row.iter().zip(right).map(|(a, b)| a * b).sum();
            }
        }
    }

    /// The colour of the ground at a place (px).
    pub fn at(&self, x: f64, y: f64) -> Colour {
        let row = self.scaled(x, y);
        self.factors.map(|factors| factors.iter().zip(row).map(|(a, b)| a * b).sum::<f64>() as f32)
    }
}
