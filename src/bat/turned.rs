//! How does a bat change if a curve is added to its diameter or to that of its bore?
//!
//! A [`DiameterChange`] is a cubic between places. [`Bat::turned`] adds it to the bat's diameter, [`Bat::bored`] to
//! that of the bore. The pieces of the profile are cut at the ends of the change and moved one by one: a cubic stays a
//! cubic, and the rest of the curve stays unchanged.

use crate::base::{Error, Result};
use crate::bat::body::Bat;
use crate::bat::pchip::{bernstein, subdivide};
use crate::bat::profile::{Piece, SAME_PLACE};
use crate::bat::rework::{Surface, place};

/// A stretch of a [`DiameterChange`]: a cubic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChangedStretch {
    /// Where the stretch begins (m).
    pub from: f64,
    /// Where it ends (m).
    pub to: f64,
    /// The change of the diameter over the stretch (m), in Bernstein form: `Σ bᵢ Bᵢ(s)`, s from 0 to 1.
    pub diameter: [f64; 4],
}

/// A change of the diameter along the bat, positive where the bat becomes thicker: cubics on stretches that do not
/// overlap, and 0 between them.
///
/// ```
/// use sweetspot::bat::turned::DiameterChange;
/// # use sweetspot::Bat;
///
/// # fn main() -> sweetspot::Result<()> {
/// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash",
/// #     "profile": { "unit": "m", "x": [0, 0.84], "diameter": [0.04, 0.04] } }"#;
/// # let bat = Bat::from_text("dowel.json", text, "".as_ref())?;
/// let thinner = DiameterChange::band([0.3, 0.4], -1e-3); // a millimetre off ten centimetres
/// let rounded = DiameterChange::through(&[0.3, 0.35, 0.4], |x| 0.2 * (x - 0.3).powi(2) * (x - 0.4));
/// let turned = bat.turned(&DiameterChange::sum(&[(1.0, &thinner), (0.5, &rounded)]))?;
/// assert!(turned.inertia().mass < bat.inertia().mass);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DiameterChange {
    stretches: Vec<ChangedStretch>,
}

impl DiameterChange {
    /// A constant change (m of diameter) along a stretch (m).
    pub fn band([from, to]: [f64; 2], by: f64) -> Self {
        Self { stretches: vec![ChangedStretch { from, to, diameter: [by; 4] }] }
    }

    /// The curve through the values of `change` (m of diameter) at the knots (m, rising) and at two places between each
    /// pair. It equals the function where that is a cubic between knots.
    pub fn through(knots: &[f64], change: impl Fn(f64) -> f64) -> Self {
        let stretch = |ends: &[f64]| {
            let (from, to) = (ends[0], ends[1]);
            let at = |s: f64| change(from + s * (to - from));
            ChangedStretch {
                from,
                to,
                diameter: cubic([at(0.0), at(1.0 / 3.0), at(2.0 / 3.0), at(1.0)]),
            }
        };
        Self { stretches: knots.windows(2).map(stretch).collect() }
    }

    /// `Σ factor · change`.
    pub fn sum(parts: &[(f64, &Self)]) -> Self {
        let mut knots: Vec<f64> = parts.iter().flat_map(|(_, part)| part.knots()).collect();
        knots.sort_by(f64::total_cmp);
        knots.dedup_by(|a, b| (*a - *b).abs() <= SAME_PLACE * a.abs());
        let on = |ends: &[f64]| {
            let (from, to) = (ends[0], ends[1]);
            let covers = |part: &&(f64, &Self)| part.1.covering(0.5 * (from + to)).is_some();
            let here: Vec<_> = parts.iter().filter(covers).collect();
            let at = |s: f64| {
                // At an end, the value from inside.
                let x = from + s * (to - from);
                let middle = 0.5 * (from + to);
                let of = |(factor, part): &&(f64, &Self)| {
                    let stretch = part.covering(middle).expect("it was looked for");
                    factor * stretch.at(x)
                };
                here.iter().map(of).sum::<f64>()
            };
            let diameter = cubic([at(0.0), at(1.0 / 3.0), at(2.0 / 3.0), at(1.0)]);
            (!here.is_empty()).then_some(ChangedStretch { from, to, diameter })
        };
        Self { stretches: knots.windows(2).filter_map(on).collect() }
    }

    /// The stretches, from the knob on.
    pub fn stretches(&self) -> &[ChangedStretch] {
        &self.stretches
    }

    /// Where the cubics begin and end (m), rising.
    pub fn knots(&self) -> Vec<f64> {
        let mut knots: Vec<f64> = self.stretches.iter().flat_map(|s| [s.from, s.to]).collect();
        knots.dedup();
        knots
    }

    /// The change at `x` (m of diameter); where two cubics meet, that of the one to the right.
    pub fn at(&self, x: f64) -> f64 {
        let k = self.stretches.partition_point(|stretch| stretch.from <= x);
        let last = k.checked_sub(1).map(|k| &self.stretches[k]);
        last.filter(|stretch| x <= stretch.to).map_or(0.0, |stretch| stretch.at(x))
    }

    /// This change multiplied by a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        let all = scaled.stretches.iter_mut().flat_map(|stretch| &mut stretch.diameter);
        all.for_each(|by| *by *= factor);
        scaled
    }

    /// The change of the radius (m) over a piece that lies within one stretch, in Bernstein form.
    fn radius_over(&self, piece: &Piece) -> Option<[f64; 4]> {
        let end = piece.start + piece.length;
        let ChangedStretch { from, to, diameter } = self.covering(0.5 * (piece.start + end))?;
        let share = |x: f64| ((x - from) / (to - from)).clamp(0.0, 1.0);
        Some(subdivide(diameter, share(piece.start), share(end)).map(|by| 0.5 * by))
    }

    /// The stretch around `x`.
    fn covering(&self, x: f64) -> Option<&ChangedStretch> {
        self.stretches.iter().find(|stretch| stretch.from < x && x < stretch.to)
    }
}

impl ChangedStretch {
    /// The change at `x` (m).
    fn at(&self, x: f64) -> f64 {
        bernstein(&self.diameter, ((x - self.from) / (self.to - self.from)).clamp(0.0, 1.0))
    }
}

/// The cubic with these values at 0, 1/3, 2/3 and 1, in Bernstein form.
fn cubic([a, b, c, d]: [f64; 4]) -> [f64; 4] {
    [
        a,
        (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0,
        (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0,
        d,
    ]
}

impl Bat {
    /// The bat with this change of its outer diameter. Densities stay as weighing set them: turning does not change the
    /// density of the billet.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if the change reaches beyond the bat, no wood would be left, or a sleeve covers the stretch.
    pub fn turned(&self, change: &DiameterChange) -> Result<Self> {
        let length = self.length();
        let same = SAME_PLACE * length;
        let mut profile = self.profile().clone();
        profile.cut(change.knots());
        for &ChangedStretch { from, to, .. } in &change.stretches {
            if !(from >= -same && to <= length + same && to - from > same) {
                let expected = format!("a stretch of the bat, 0 to {}", place(length));
                let found = format!("{} to {}", place(from), place(to));
                return Err(Error::value("stretch", found, expected));
            }
            if self.is_sleeved([from, to]) {
                let expected = "wood at the surface: cut before the sleeve is put on";
                let found = format!("a sleeve between {} and {}", place(from), place(to));
                return Err(Error::value("stretch", found, expected));
            }
        }
        profile.moved(Surface::Outside, |piece| change.radius_over(piece))?;
        self.with(|parts| parts.profile = profile)
    }

    /// The bat with this change of its bore's diameter, if it has a bore; the wall becomes thinner where the change is
    /// positive. Densities stay as weighing set them.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if no wall would be left.
    pub fn bored(&self, change: &DiameterChange) -> Result<Self> {
        let mut profile = self.profile().clone();
        profile.cut(change.knots());
        profile.moved(Surface::Bore, |piece| change.radius_over(piece))?;
        self.with(|parts| parts.profile = profile)
    }

    /// The bat with added borders between pieces of its profile at these places (m); its shape is unchanged.
    ///
    /// # Errors
    ///
    /// As [`crate::bat::body::Builder::build`].
    pub fn cut_at(&self, places: &[f64]) -> Result<Self> {
        let mut profile = self.profile().clone();
        profile.cut(places.iter().copied());
        self.with(|parts| parts.profile = profile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_between_knots_is_held_exactly_and_sums_are_sums() {
        let f = |x: f64| 1.0 - 3.0 * x + 0.5 * x * x + 2.0 * x.powi(3);
        let whole = DiameterChange::through(&[0.1, 0.4, 0.7], f);
        let band = DiameterChange::band([0.3, 0.5], 0.2);
        let both = DiameterChange::sum(&[(2.0, &whole), (-1.0, &band)]);
        assert_eq!(both.knots(), [0.1, 0.3, 0.4, 0.5, 0.7]);
        for k in 1..60 {
            let x = 0.1 + 0.01 * f64::from(k) + 1e-4;
            let expected = if x < 0.7 { 2.0 * f(x) } else { 0.0 };
            let expected = expected - if x > 0.3 && x < 0.5 { 0.2 } else { 0.0 };
            assert!((both.at(x) - expected).abs() < 1e-14, "{x} {} {expected}", both.at(x));
        }
        assert_eq!([both.at(0.05), both.at(0.75)], [0.0; 2]);
    }

    #[test]
    fn the_bat_has_the_changed_diameter_and_no_other() {
        let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash",
            "profile": { "unit": "m", "x": [0, 0.2, 0.4, 0.84], "diameter": [0.03, 0.025, 0.03, 0.06] } }"#;
        let bat = Bat::from_text("bat.json", text, "".as_ref()).unwrap();
        let change = DiameterChange::through(&[0.1, 0.3, 0.5], |x| -0.1 * (x - 0.1) * (0.5 - x));
        let turned = bat.turned(&change).unwrap();
        for k in 1..84 {
            let x = 0.01 * f64::from(k) + 1e-5;
            let [was, is] = [&bat, &turned].map(|bat| bat.profile().at(x).outer);
            assert!((is - was - 0.5 * change.at(x)).abs() < 1e-16, "{x}");
        }
        let all = bat.turned(&DiameterChange::band([0.1, 0.2], -0.03));
        assert!(all.unwrap_err().to_string().contains("no wood left"));
        assert!(bat.turned(&DiameterChange::band([0.8, 0.9], -1e-4)).is_err());
    }

    #[test]
    fn the_bore_has_the_changed_diameter_and_the_surface_its_own() {
        let columns = r#""x": [0, 0.2, 0.2, 0.84], "radius": [0.012, 0.014, 0.014, 0.03],
            "inner_radius": [0, 0, 0.011, 0.027]"#;
        let pieces = r#""pieces": [ { "from": 0, "to": 0.2, "formula": "0.012" },
            { "from": 0.2, "to": 0.84, "formula": "0.014 + 0.025*(x - 0.2)",
              "inner_formula": "0.011 + 0.025*(x - 0.2)" } ]"#;
        let change = DiameterChange::through(&[0.1, 0.5, 0.84], |x| -0.002 * (x - 0.1));
        for profile in [columns, pieces] {
            let text = format!(
                r#"{{ "format": "sweetspot-bat/1", "material": "aluminium-7075",
                    "profile": {{ {profile} }} }}"#
            );
            let bat = Bat::from_text("bat.json", &text, "".as_ref()).unwrap();
            let bored = bat.bored(&change).unwrap();
            for k in 1..84 {
                let x = 0.01 * f64::from(k) + 1e-5;
                let [was, is] = [&bat, &bored].map(|bat| bat.profile().at(x));
                assert!((is.outer - was.outer).abs() < 1e-16, "{x}");
                let by = if was.inner > 0.0 { 0.5 * change.at(x) } else { 0.0 };
                assert!((is.inner - was.inner - by).abs() < 1e-15, "{x}");
            }
            let through = bat.bored(&DiameterChange::band([0.3, 0.5], 0.01));
            assert!(through.unwrap_err().to_string().contains("no wood left"));
        }
    }
}
