//! The bat to be changed: what are the changed bat and its goals for given unknowns?
//!
//! The unknowns are the coefficients of the change of the diameter (mm), then one for each free choice besides the
//! shape, in its unit (see [`Extra`]).

use serde::Serialize;

use crate::aim::limits::Limits;
use crate::aim::spline::Splines;
use crate::aim::wish::{FreeChoice, Goal, Wish};
use crate::answers::Answer;
use crate::engine::{
    Attachment, Bat, DiameterChange, Error, INCH, Request, Result, SAME_PLACE, Scene, SwingLaw,
    shown_length,
};
use crate::lathe::workpiece::{Care, HitTerms, Workpiece};
use crate::verdict::rigid_wall;

/// How bats are computed: modes, hit, and the law by which a batter swings another bat.
#[derive(Debug, Clone)]
pub struct Terms {
    /// Theory, and the accuracy of frequencies and exit speeds.
    pub request: Request,
    /// Swing, ball and model.
    pub hit: HitTerms,
    /// The swing law for other bats; without it the swing is the same.
    pub law: Option<SwingLaw>,
}

/// A free choice besides the shape. One unit of it counts as this many millimetres of diameter all along the bat. That
/// is less than its effect on the goals, so that it is used before the shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extra {
    /// The quantity.
    pub what: ExtraKind,
    /// One unit, in SI.
    pub unit: f64,
    /// The weight of a unit (mm).
    pub cost: f64,
    /// Its present value, in SI.
    pub start: f64,
    /// Least and greatest value, in SI.
    pub range: [f64; 2],
}

/// The quantities that may change besides the shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum ExtraKind {
    /// Length of the bat (m), everything on it moving with it.
    #[serde(rename = "length_m")]
    Length,
    /// Density of the bat's own material (kg/m³).
    #[serde(rename = "density_kg_m3")]
    Density,
    /// A weight on the knob end (kg).
    #[serde(rename = "knob_weight_kg")]
    KnobWeight,
}

/// A bat, its free quantities and its goals.
#[derive(Debug, Clone)]
pub struct Bench {
    /// The original bat.
    pub bat: Bat,
    /// How bats are computed.
    pub terms: Terms,
    /// The possible curves of the change of the diameter.
    pub splines: Splines,
    /// The free choices besides the shape.
    pub extras: Vec<Extra>,
    /// The goals.
    pub goals: Vec<Goal>,
    changes: Vec<DiameterChange>,
}

/// A changed bat and its goals.
pub struct Look {
    /// Value of every goal; NaN if the bat has none.
    pub values: Vec<f64>,
    piece: Workpiece,
    p: Vec<f64>,
}

impl Bench {
    /// The bat with the free choices of a wish. Where nothing may change, its diameters are checked against the limits.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] about a wish that leaves nothing free, or whose limits the bat violates where it may not
    /// change.
    pub fn new(bat: &Bat, wish: &Wish, terms: Terms) -> Result<Self> {
        let length = bat.length();
        for (k, keep) in wish.keep.iter().enumerate() {
            if !(keep[0] < keep[1] && keep[1] <= length * (1.0 + SAME_PLACE)) {
                let found = format!("{} to {}", shown_length(keep[0]), shown_length(keep[1]));
                let expected = format!("a stretch of the bat, 0 to {}", shown_length(length));
                return Err(Error::value(format!("keep[{k}]"), found, expected));
            }
        }
        let pointed = [0.0, length].map(|x| bat.profile().at(x).outer == 0.0);
        // Under a sleeve the diameter is that of the sleeve.
        let pieces = bat.profile().pieces.iter();
        let sleeved = pieces.filter(|piece| !bat.layup(piece).sleeves.is_empty());
        let sleeved = sleeved.map(|piece| [piece.start, piece.start + piece.length]);
        let keep: Vec<[f64; 2]> = wish.keep.iter().copied().chain(sleeved).collect();
        let splines = Splines::beside(&keep, length, pointed);
        let extras = extras(&wish.free, bat);
        if splines.is_empty() && extras.is_empty() {
            let expected = "a stretch of more than 2 cm that may change";
            return Err(Error::value("keep", "all of the bat", expected));
        }
        let free = |x: f64| splines.stretches.iter().any(|s| x > s[0] && x < s[1]);
        let end = |x: f64| {
            let at = |end: f64| splines.stretches.iter().any(|s| s.contains(&end));
            (x == 0.0 && at(0.0)) || (x >= length && at(length))
        };
        Limits::new(wish, bat).check(|x| !(free(x) || end(x)))?;
        let change = |curve: &super::spline::BSpline| {
            DiameterChange::through(&curve.knots(), |x| 1e-3 * curve.at(x))
        };
        let changes = splines.basis.iter().map(change).collect();
        let goals = wish.goals().into_iter().map(|(goal, _)| goal).collect();
        Ok(Self { bat: bat.clone(), terms, splines, extras, goals, changes })
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.splines.len() + self.extras.len()
    }

    /// Number of bats computed for an evaluation with slopes.
    pub fn bats_of_slopes(&self) -> usize {
        let of_hit = |goal: &Goal| match goal.answer() {
            Answer::Node(_) | Answer::ModalMass(_) => true,
            answer => answer.of_a_hit(),
        };
        let shape = if self.goals.iter().any(of_hit) { 2 * self.splines.len() } else { 0 };
        shape + 2 * self.extras.len()
    }

    /// The value of a free choice, in SI.
    pub fn extra(&self, p: &[f64], k: usize) -> f64 {
        /// A choice closer to its start than this share of a unit counts as unchanged: the program's own accuracy.
        const NEAR: f64 = 1e-6;
        let (extra, by) = (&self.extras[k], p[self.splines.len() + k]);
        let by = if by.abs() < NEAR { 0.0 } else { by };
        (extra.start + by * extra.unit).clamp(extra.range[0], extra.range[1])
    }

    /// The bat with other free choices; its shape stays except for its length.
    ///
    /// # Errors
    ///
    /// Those of [`Bat::with`].
    pub fn rechosen(&self, bat: &Bat, p: &[f64]) -> Result<Bat> {
        let mut made = bat.clone();
        for (k, extra) in self.extras.iter().enumerate() {
            let value = self.extra(p, k);
            made = match extra.what {
                ExtraKind::Density => made.with(|parts| parts.material.density = value)?,
                ExtraKind::KnobWeight if value <= 0.0 => made,
                ExtraKind::KnobWeight => made.with(|parts| {
                    let weight = Attachment { mass: value, ..Attachment::default() };
                    parts.fixtures.attachments.push(weight);
                })?,
                ExtraKind::Length => stretched(&made, value / extra.start)?,
            };
        }
        Ok(made)
    }

    /// How much longer the bat is by its free choices, as a factor.
    pub fn stretch(&self, p: &[f64]) -> f64 {
        let length = self.extras.iter().position(|extra| extra.what == ExtraKind::Length);
        length.map_or(1.0, |k| self.extra(p, k) / self.extras[k].start)
    }

    /// The changed bat.
    ///
    /// # Errors
    ///
    /// Those of [`Bat::turned`] and [`Bat::with`].
    pub fn changed(&self, p: &[f64]) -> Result<Bat> {
        let change = self.change(p);
        let turned = match change.stretches().is_empty() {
            true => self.bat.clone(),
            false => self.bat.turned(&change)?,
        };
        self.rechosen(&turned, p)
    }

    /// The change of the diameter (m), on the bat with its original length.
    pub fn change(&self, p: &[f64]) -> DiameterChange {
        let parts: Vec<(f64, &DiameterChange)> =
            p.iter().copied().zip(&self.changes).filter(|(p, _)| *p != 0.0).collect();
        DiameterChange::sum(&parts)
    }

    /// The changed bat with its goals.
    ///
    /// # Errors
    ///
    /// Those of [`Workpiece::new`].
    pub fn look(&self, p: &[f64]) -> Result<Look> {
        let (bat, stretch) = (self.changed(p)?, self.stretch(p));
        let borders: Vec<f64> = self.splines.knots().iter().map(|x| x * stretch).collect();
        let piece = self.piece(&bat, &borders, &self.answers())?;
        Ok(Look { values: self.values(&piece), piece, p: p.to_vec() })
    }

    /// The goals of a bat that was not made from the unknowns, such as a written one.
    ///
    /// # Errors
    ///
    /// As [`Self::look`].
    pub fn of(&self, bat: &Bat) -> Result<Vec<f64>> {
        Ok(self.values(&self.piece_of(bat, &self.answers())?))
    }

    /// Any answers of any bat, swung by the terms.
    ///
    /// # Errors
    ///
    /// As [`Self::look`].
    pub fn piece_of(&self, bat: &Bat, answers: &[Answer]) -> Result<Workpiece> {
        self.piece(bat, &[], answers)
    }

    fn piece(&self, bat: &Bat, borders: &[f64], answers: &[Answer]) -> Result<Workpiece> {
        Workpiece::new(bat, borders, &self.terms.request, Some(&self.swung(bat)), answers)
    }

    fn answers(&self) -> Vec<Answer> {
        self.goals.iter().map(|goal| goal.answer()).collect()
    }

    /// The reason why the wall of a hollow barrel is rigid in the hits of that bat; `None` if it would change little.
    pub fn rigid_wall(&self, bat: &Bat) -> Option<String> {
        let scene = &self.terms.hit.scene;
        rigid_wall(bat, &Scene { hoop: scene.hoop.left_out(), ..scene.clone() })
    }

    /// The scene of that bat. Its wall stays rigid, because it would have to be solved for every bat.
    fn swung(&self, bat: &Bat) -> HitTerms {
        let mut hit = self.terms.hit.clone();
        hit.scene.hoop = hit.scene.hoop.left_out();
        if let Some(law) = self.terms.law {
            hit.scene.swing = law.swing(bat);
        }
        hit
    }

    fn values(&self, piece: &Workpiece) -> Vec<f64> {
        let length = piece.bat().length();
        let known = |k: usize| piece.values()[k].map_or(f64::NAN, |figure| figure.value);
        self.goals.iter().enumerate().map(|(k, goal)| goal.of(known(k), length)).collect()
    }

    /// The derivatives of the goals by the unknowns: a row for each goal.
    ///
    /// # Errors
    ///
    /// Those of [`Workpiece::slopes`].
    pub fn slopes(&self, look: &Look) -> Result<Vec<Vec<f64>>> {
        let stretch = self.stretch(&look.p);
        let along = |curve: &super::spline::BSpline| {
            let knots: Vec<f64> = curve.knots().iter().map(|x| x * stretch).collect();
            DiameterChange::through(&knots, |x| 1e-3 * curve.at(x / stretch))
        };
        let changes: Vec<DiameterChange> = match stretch == 1.0 {
            true => self.changes.clone(),
            false => self.splines.basis.iter().map(along).collect(),
        };
        let exponent = self.terms.law.map_or(0.0, |law| law.exponent);
        let mut rows = vec![vec![]; self.goals.len()];
        for slopes in look.piece.slopes(&changes, Care::OneStep)? {
            for ((row, goal), slope) in
                rows.iter_mut().zip(&self.goals).zip(slopes.by_law(exponent))
            {
                row.push(goal.slope() * slope.map_or(0.0, |slope| slope.value));
            }
        }
        for k in 0..self.extras.len() {
            for (row, slope) in rows.iter_mut().zip(self.slope_of_extra(look, k)?) {
                row.push(slope);
            }
        }
        Ok(rows)
    }

    /// Derivatives by a free choice besides the shape, as a difference of two bats.
    fn slope_of_extra(&self, look: &Look, k: usize) -> Result<Vec<f64>> {
        /// Step, in units of the choice.
        const STEP: f64 = 0.02;
        let at = self.splines.len() + k;
        let moved = |by: f64| -> Result<(f64, Vec<f64>)> {
            let mut p = look.p.clone();
            p[at] += by;
            let extra = &self.extras[k];
            // A choice at the end of its range gets a one-sided difference.
            let value = self.extra(&p, k);
            p[at] = (value - extra.start) / extra.unit;
            let bat = self.changed(&p)?;
            Ok((p[at], self.of(&bat)?))
        };
        let ((from, behind), (to, ahead)) = (moved(-STEP)?, moved(STEP)?);
        let slope = |(a, b): (f64, f64)| if to > from { (b - a) / (to - from) } else { 0.0 };
        let finite = |slope: f64| if slope.is_finite() { slope } else { 0.0 };
        Ok(behind.into_iter().zip(ahead).map(slope).map(finite).collect())
    }
}

/// The free choices besides the shape for that bat.
fn extras(free: &FreeChoice, bat: &Bat) -> Vec<Extra> {
    /// An inch, a twentieth of the density, an ounce; the weight of each.
    const COSTS: [f64; 3] = [0.2, 0.1, 0.1];
    let density = bat.material().density;
    let extra = |what, unit, cost, start| move |range| Extra { what, unit, cost, start, range };
    let length = free.length.map(extra(ExtraKind::Length, INCH, COSTS[0], bat.length()));
    let knob = free.knob_weight.map(|most| [0.0, most]);
    let knob = knob.map(extra(ExtraKind::KnobWeight, 0.028_349_523_125, COSTS[2], 0.0));
    let density = free.density.map(extra(ExtraKind::Density, 0.05 * density, COSTS[1], density));
    // The length last: the fixtures move with it.
    density.into_iter().chain(knob).chain(length).collect()
}

/// The bat made longer by a factor, everything on it moving with it.
fn stretched(bat: &Bat, by: f64) -> Result<Bat> {
    if by == 1.0 {
        return Ok(bat.clone());
    }
    bat.with(|parts| {
        let profile = &mut parts.profile;
        for piece in &mut profile.pieces {
            piece.start *= by;
            piece.length *= by;
        }
        profile.stations.x.iter_mut().for_each(|x| *x *= by);
        profile.formulas = None;
        parts.fixtures.places().for_each(|x| *x *= by);
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_on_a_bat_moves_with_its_length() {
        let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
            "grip": { "from": "1 in", "to": "6 in", "stiffness": 3e4 },
            "attachments": [{ "x": "20 in", "mass": "1 oz" }],
            "profile": { "unit": "in", "x": [0, 6, 20, 33], "diameter": [1.0, 0.9, 1.6, 2.5] } }"#;
        let bat = Bat::from_text("bat.json", text, "".as_ref()).unwrap();
        let longer = stretched(&bat, 1.1).unwrap();
        let grip = longer.fixtures().grip.unwrap();
        let there = [grip.from, grip.to, longer.fixtures().attachments[0].x, longer.length()];
        let inches = there.map(|x| x / INCH);
        for (found, wanted) in inches.into_iter().zip([1.1, 6.6, 22.0, 36.3]) {
            assert!((found - wanted).abs() < 1e-9, "{inches:?}");
        }
    }
}
