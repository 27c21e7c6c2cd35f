//! The effect of one part of a model: the bat with it compared with the bat without it.

use std::rc::Rc;

use serde::{Serialize, Serializer};

use crate::advise::model::{Bench, Model, Solved};
use crate::advise::part::ModelPart;
use crate::engine::{Mode, STANDARD_PIVOT, Theory, error};
use crate::ignored::with_typical_shear;

/// A part that is switched on or off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Switch {
    /// The sections' own rotary inertia: from Euler–Bernoulli to Rayleigh.
    RotaryInertia,
    /// Shear: from Rayleigh to Timoshenko.
    Shear,
    /// Shear with the typical G/E of a material whose shear modulus is not known; not part of the full model.
    TypicalShear,
    /// Both: from Euler–Bernoulli to Timoshenko.
    Theory,
    /// One kind of part on the bat.
    Part(ModelPart),
    /// All of [`ModelPart::ATTACHED`] together.
    Attachments,
}

impl Switch {
    /// Its name for people and in files.
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

impl Serialize for Switch {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.name())
    }
}

/// The effect of one part of the model; shifts are null if the modes do not correspond.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct Effect {
    /// The part, in words.
    #[schemars(with = "String")]
    pub switch: Switch,
    /// Whether the bat file gives the value; false for a typical one.
    pub known: bool,
    /// The model that has it.
    pub with: Rc<Solved>,
    /// The model that does not.
    pub without: Rc<Solved>,
    /// Relative change of each frequency, negative where the part lowers it.
    pub shift_by_mode: Option<Vec<f64>>,
    /// Error of each change.
    pub shift_error_by_mode: Option<Vec<f64>>,
    /// Shift of every node of each mode towards the tip (m); null if their number changes.
    pub node_shift_m_by_mode: Option<Vec<Option<Vec<f64>>>>,
    /// Error of the shifts of each mode's nodes (m).
    pub node_shift_error_m_by_mode: Option<Vec<f64>>,
    /// Change of the mass (kg).
    pub mass_kg: f64,
    /// Change of the balance point (m).
    pub balance_point_m: f64,
    /// Change of the moment of inertia about the point 6 in from the knob end (kg m²).
    pub inertia_pivot_kg_m2: f64,
}

impl Effect {
    fn new(switch: Switch, with: Rc<Solved>, without: Rc<Solved>) -> Self {
        let paired = with.pairs_with(&without);
        let pairs = || with.solution.modes.iter().zip(&without.solution.modes);
        let numbers = |of: fn((&Mode, &Mode)) -> f64| paired.then(|| pairs().map(of).collect());
        let moved = |(a, b): (&Mode, &Mode)| {
            let moved = || a.nodes.iter().zip(&b.nodes).map(|(a, b)| a - b).collect();
            (a.nodes.len() == b.nodes.len()).then(moved)
        };
        let [more, less] = [with.inertia(), without.inertia()];
        Self {
            switch,
            known: switch != Switch::TypicalShear,
            shift_by_mode: numbers(|(a, b)| a.omega / b.omega - 1.0),
            shift_error_by_mode: numbers(|(a, b)| {
                a.omega / b.omega * (a.error.total() + b.error.total())
            }),
            node_shift_m_by_mode: paired.then(|| pairs().map(moved).collect()),
            node_shift_error_m_by_mode: numbers(|(a, b)| a.error.nodes + b.error.nodes),
            mass_kg: more.mass - less.mass,
            balance_point_m: more.balance_point - less.balance_point,
            inertia_pivot_kg_m2: more.about(STANDARD_PIVOT) - less.about(STANDARD_PIVOT),
            with,
            without,
        }
    }

    /// The largest |shift| of a frequency; `None` if the modes do not correspond.
    pub fn largest(&self) -> Option<f64> {
        let shifts = self.shift_by_mode.as_ref()?;
        Some(shifts.iter().map(|shift| shift.abs()).fold(0.0, f64::max))
    }

    /// The relative change of a mode's frequency (counted from 0) and its error; `None` if the modes do not correspond.
    pub fn shift(&self, mode: usize) -> Option<[f64; 2]> {
        Some([self.shift_by_mode.as_ref()?[mode], self.shift_error_by_mode.as_ref()?[mode]])
    }
}

/// The effect of everything that can be switched on this bat, one at a time, from the full model.
///
/// # Errors
///
/// Those of [`sweetspot::modes::solve::solve`].
pub fn effects(bench: &mut Bench, full: &Model) -> error::Result<Vec<Effect>> {
    let plain = bench.solve(&full.by(Theory::EulerBernoulli))?;
    let turning = bench.solve(&full.by(Theory::Rayleigh))?;
    let mut effects =
        vec![Effect::new(Switch::RotaryInertia, Rc::clone(&turning), Rc::clone(&plain))];
    if full.theory.shears() {
        let shearing = bench.solve(full)?;
        effects.push(Effect::new(Switch::Shear, Rc::clone(&shearing), turning));
        effects.push(Effect::new(Switch::Theory, shearing, plain));
    } else {
        let typical = with_typical_shear(bench.bat);
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

/// With the full model's theory, or without shear if a remaining material has no known shear modulus.
fn taken_off(
    bench: &mut Bench,
    full: &Model,
    switch: Switch,
    parts: &[ModelPart],
) -> error::Result<Effect> {
    let mut without = full.without(parts);
    let known = without.bat(bench.bat)?.knows_shear();
    if without.theory.shears() && !known {
        without = without.by(Theory::Rayleigh);
    }
    let with = full.by(without.theory);
    Ok(Effect::new(switch, bench.solve(&with)?, bench.solve(&without)?))
}
