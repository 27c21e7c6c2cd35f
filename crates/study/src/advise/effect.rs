//! What one part of a model does: the bat with it beside the bat without it.

use std::rc::Rc;

use crate::advise::model::{Bench, Model, Solved};
use crate::advise::part::ModelPart;
use crate::ignored::with_typical_shear;
use sweetspot::base::error::Result;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::bat::theory::Theory;
use sweetspot::modes::mode::Mode;

/// What is switched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Switch {
    /// The sections' own rotary inertia: from Euler–Bernoulli to Rayleigh.
    RotaryInertia,
    /// Shear: from Rayleigh to Timoshenko.
    Shear,
    /// Shear with the G/E of a material's kind, where it is not known; not part of the full model.
    TypicalShear,
    /// Both: from Euler–Bernoulli to Timoshenko.
    Theory,
    /// One kind of thing on the bat.
    Part(ModelPart),
    /// All of [`ModelPart::ATTACHED`] together.
    Attachments,
}

impl Switch {
    /// What people and files call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::RotaryInertia => "rotary inertia",
            Self::Shear => "shear",
            Self::TypicalShear => "shear, typical G/E",
            Self::Theory => "rotary inertia and shear",
            Self::Part(part) => part.name(),
            Self::Attachments => "all attachments",
        }
    }
}

/// The bat with something and without it, all else as in the full model.
#[derive(Debug, Clone)]
pub struct Effect {
    /// What is switched.
    pub switch: Switch,
    /// The bat that has it.
    pub with: Rc<Solved>,
    /// The bat that does not.
    pub without: Rc<Solved>,
    /// Change of every mode by the effect; None where the modes are others altogether.
    pub shifts: Option<Vec<Shift>>,
    /// Change of mass (kg), balance point (m) and inertia 6 in from the knob (kg m²) by the effect.
    pub body: [f64; 3],
}

/// Relative change of a mode's frequency, and the shift of its nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Shift {
    /// Change of the frequency, relative to the one without the effect; negative where that lowers it.
    pub frequency: f64,
    /// Error bound of [`Self::frequency`], relative.
    pub error: f64,
    /// Shift of every node towards the tip (m); None where their number changes.
    pub nodes: Option<Vec<f64>>,
    /// Error bound of [`Self::nodes`] (m).
    pub node_error: f64,
}

impl Effect {
    fn new(switch: Switch, with: Rc<Solved>, without: Rc<Solved>) -> Self {
        let shifts = with.pairs_with(&without).then(|| shifts(&with, &without));
        let body = |solved: &Solved| {
            let inertia = solved.inertia();
            [inertia.mass, inertia.balance_point, inertia.about(STANDARD_PIVOT)]
        };
        let (a, b) = (body(&with), body(&without));
        let body = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        Self { switch, with, without, shifts, body }
    }

    /// The largest |shift| of a frequency; None where the modes are others.
    pub fn largest(&self) -> Option<f64> {
        let shifts = self.shifts.as_ref()?;
        Some(shifts.iter().map(|shift| shift.frequency.abs()).fold(0.0, f64::max))
    }
}

/// Mode by mode, from the bat without something to the bat with it.
fn shifts(with: &Solved, without: &Solved) -> Vec<Shift> {
    let pairs = with.solution.modes.iter().zip(&without.solution.modes);
    let shift = |(a, b): (&Mode, &Mode)| {
        let ratio = a.omega / b.omega;
        let moved = || a.nodes.iter().zip(&b.nodes).map(|(a, b)| a - b).collect();
        Shift {
            frequency: ratio - 1.0,
            error: ratio * (a.error.total() + b.error.total()),
            nodes: (a.nodes.len() == b.nodes.len()).then(moved),
            node_error: a.error.nodes + b.error.nodes,
        }
    };
    pairs.map(shift).collect()
}

/// The effect of everything that can be switched on this bat, one at a time, from the full model.
///
/// # Errors
///
/// Those of [`sweetspot::modes::solve::solve`].
pub fn effects(bench: &mut Bench, full: &Model) -> Result<Vec<Effect>> {
    let plain = bench.solve(&full.by(Theory::EulerBernoulli))?;
    let turning = bench.solve(&full.by(Theory::Rayleigh))?;
    let mut effects =
        vec![Effect::new(Switch::RotaryInertia, Rc::clone(&turning), Rc::clone(&plain))];
    if full.theory.shears() {
        let shearing = bench.solve(full)?;
        effects.push(Effect::new(Switch::Shear, Rc::clone(&shearing), turning));
        effects.push(Effect::new(Switch::Theory, shearing, plain));
    } else {
        let typical = with_typical_shear(bench.bat());
        let shearing = bench.solve_instead(&full.by(Theory::Timoshenko), typical)?;
        effects.push(Effect::new(Switch::TypicalShear, Rc::new(shearing), turning));
    }
    for part in ModelPart::ALL.into_iter().filter(|part| full.parts.contains(part)) {
        effects.push(taken_off(bench, full, Switch::Part(part), &[part])?);
        let last_attached =
            full.parts.iter().rev().find(|part| ModelPart::ATTACHED.contains(part)) == Some(&part);
        let several =
            full.parts.iter().filter(|part| ModelPart::ATTACHED.contains(part)).count() > 1;
        if last_attached && several {
            effects.push(taken_off(bench, full, Switch::Attachments, &ModelPart::ATTACHED)?);
        }
    }
    Ok(effects)
}

/// By the full model's theory, or without shear where what is left has no known shear modulus.
fn taken_off(
    bench: &mut Bench,
    full: &Model,
    switch: Switch,
    parts: &[ModelPart],
) -> Result<Effect> {
    let mut without = full.without(parts);
    let known = without.bat(bench.bat())?.knows_shear();
    if without.theory.shears() && !known {
        without = without.by(Theory::Rayleigh);
    }
    let with = full.by(without.theory);
    Ok(Effect::new(switch, bench.solve(&with)?, bench.solve(&without)?))
}
