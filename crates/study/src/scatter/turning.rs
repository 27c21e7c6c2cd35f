//! How does a lathe depart from the profile?
//!
//! Not by a separate amount at every station, but by a smooth curve. The error of the diameter is a sum of cubic
//! B-splines; the distance of their knots is the width of the error:
//!
//! ```text
//! d(x) = σ/s Σ z_j B(x/ℓ − j),   s² = mean of Σ B² = 151/315
//! ```
//!
//! each z_j a standard normal number, so that d has the standard deviation σ, to 3 % everywhere.
//!
//! # Source
//!
//! C. de Boor, A Practical Guide to Splines (Springer, 2001), chapter IX: B-splines, and the cubic one of equidistant
//! knots.

use crate::engine::{Bat, Error, Interpolation, Profile, Result, Stations};

/// `∫ B(t)² dt` of the cubic B-spline of equidistant knots: the mean over x of the sum of squares.
const MEAN_SQUARE: f64 = 151.0 / 315.0;
/// A radius is not turned below this share of its original value.
const LEAST: f64 = 0.05;

/// How far a lathe misses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// Standard deviation of the diameter (m).
    pub deviation: f64,
    /// How far along the bat an error reaches (m).
    pub along: f64,
}

impl Turning {
    /// Number of splines for a bat of that length (m).
    pub fn splines(&self, length: f64) -> usize {
        (length / self.along).ceil().max(1.0) as usize + 3
    }

    /// The error of the diameter at x (m) for a bat with those numbers.
    pub fn error(&self, x: f64, numbers: &[f64]) -> f64 {
        let t = x / self.along;
        let terms = numbers.iter().enumerate().map(|(j, z)| z * spline(t - j as f64 + 1.0));
        self.deviation / MEAN_SQUARE.sqrt() * terms.sum::<f64>()
    }

    /// The profile with errors: the curve is added at stations, and at places between distant ones.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a profile of formulas, and those of [`Profile::new`].
    pub fn turned(&self, bat: &Bat, numbers: &[f64]) -> Result<Profile> {
        let profile = bat.profile();
        if profile.formulas.is_some() {
            let expected = "a bat whose profile has stations";
            return Err(Error::value("turning", "a profile of formulas", expected));
        }
        let Stations { x, outer, inner, interpolation } = self.stations(profile);
        let turned = |(k, radius): (usize, &f64)| {
            let least = inner[k] + LEAST * (radius - inner[k]);
            // A pointed tip stays pointed.
            let off = if *radius > 0.0 { 0.5 * self.error(x[k], numbers) } else { 0.0 };
            (radius + off).max(least)
        };
        let outer = outer.iter().enumerate().map(turned).collect();
        Profile::new(Stations { x, outer, inner, interpolation })
    }

    /// The stations, with further ones on the curve where two are farther apart than a third of the error's width.
    fn stations(&self, profile: &Profile) -> Stations {
        let known = &profile.stations;
        // Held values have become steps between straight lines.
        let interpolation = match known.interpolation {
            Interpolation::Constant => Interpolation::Linear,
            other => other,
        };
        let (mut x, mut outer, mut inner) = (vec![], vec![], vec![]);
        for k in 0..known.x.len() {
            if let Some(before) = k.checked_sub(1).map(|before| known.x[before]) {
                let parts = (3.0 * (known.x[k] - before) / self.along).ceil().max(1.0) as usize;
                for part in 1..parts {
                    let at = before + (known.x[k] - before) * part as f64 / parts as f64;
                    let section = profile.at(at);
                    x.push(at);
                    outer.push(section.outer);
                    inner.push(section.inner);
                }
            }
            x.push(known.x[k]);
            outer.push(known.outer[k]);
            inner.push(known.inner[k]);
        }
        Stations { x, outer, inner, interpolation }
    }
}

/// The cubic B-spline on the knots −2 to 2.
fn spline(t: f64) -> f64 {
    let t = t.abs();
    match t {
        0.0..1.0 => 2.0 / 3.0 - t * t + 0.5 * t * t * t,
        1.0..2.0 => (2.0 - t).powi(3) / 6.0,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splines_add_up_to_one_and_their_squares_to_the_mean() {
        let (mut squares, count) = (0.0, 1000);
        for k in 0..count {
            let t = (f64::from(k) + 0.5) / f64::from(count);
            let all = [-2.0, -1.0, 0.0, 1.0].map(|j| spline(t + j));
            assert!((all.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            let here: f64 = all.iter().map(|b| b * b).sum();
            assert!((here / MEAN_SQUARE).sqrt().ln().abs() < 0.05, "{here}");
            squares += here / f64::from(count);
        }
        assert!((squares - MEAN_SQUARE).abs() < 1e-6, "{squares}");
    }

    #[test]
    fn a_bat_that_misses_nowhere_is_the_bat_and_one_number_for_all_is_an_allowance() {
        let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash",
            "profile": { "unit": "in", "x": [0, 6, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.0, 1.6, 2.4, 0] } }"#;
        let bat = Bat::from_text("bat.json", text, "".as_ref()).unwrap();
        let turning = Turning { deviation: 1e-4, along: 2.0 };
        let count = turning.splines(bat.length());
        assert_eq!(turning.turned(&bat, &vec![0.0; count]).unwrap(), *bat.profile());
        let by = 1e-4 / MEAN_SQUARE.sqrt();
        let turned = turning.turned(&bat, &vec![1.0; count]).unwrap();
        for (new, old) in turned.stations.outer.iter().zip(&bat.profile().stations.outer) {
            let known = if *old > 0.0 { old + 0.5 * by } else { 0.0 };
            assert!((new - known).abs() < 1e-15, "{new} {known}");
        }
    }
}
