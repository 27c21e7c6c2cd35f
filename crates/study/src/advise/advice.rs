//! The advice: effects, damping, the smallest model, and what is out of scope.

use std::rc::Rc;

use serde::Serialize;

use crate::advise::damping::Damping;
use crate::advise::effect::{Effect, Switch, effects};
use crate::advise::model::{Bench, Model, Solved};
use crate::advise::outside::outside;
use crate::advise::smallest::{Smallest, smallest};
use crate::engine::{Bat, Error, Result, Tell, nobody, tuned};

/// The parts of a model that a bat needs.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct Advice {
    /// Number of modes that were compared.
    pub modes: usize,
    /// How near to the full model's frequencies is near enough, relative.
    pub tolerance: f64,
    /// The model with everything that is known of the bat.
    pub full_model: FullModel,
    /// One effect for everything that can be switched.
    pub effects: Vec<Effect>,
    /// The damping of the bat's materials and dashpots.
    pub damping: Damping,
    /// The smallest model within the tolerance.
    pub smallest_model: Smallest,
    /// The physics that no model here has, a sentence each.
    pub out_of_scope: Vec<String>,
}

/// The full model.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct FullModel {
    /// The model and its modes.
    #[serde(flatten)]
    pub solved: Rc<Solved>,
    /// Whether its frequencies are known to the tolerance.
    pub tolerance_met: bool,
}

impl Advice {
    /// The largest shift that shear would typically make, where it is not known.
    pub fn unknown_shear(&self) -> Option<f64> {
        let row = self.effects.iter().find(|effect| effect.switch == Switch::TypicalShear)?;
        row.largest()
    }
}

/// Most modes that are advised on.
pub const MOST_MODES: usize = 100;

/// The effect of each part of a bat's model on its first modes, and the smallest model whose frequencies are within
/// `tolerance` of those of the full model.
///
/// Every model is solved far more accurately than the tolerance and the effects. The stiffness from a tapped frequency
/// is fitted once, with all parts, and kept when parts are removed.
///
/// ```
/// use sweetspot::Bat;
/// use sweetspot_study::advise::advice::advise;
///
/// # fn main() -> sweetspot::Result<()> {
/// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
/// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
/// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
/// let advice = advise(&bat, 3, 0.01)?;
/// println!("within 1 % without {:?}", advice.smallest_model.left_out);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// [`Error::Value`] for a number of modes that is not 1 to [`MOST_MODES`] or a tolerance that is
/// not between 0 and 1; those of [`sweetspot::modes::solve::solve`].
pub fn advise(bat: &Bat, modes: usize, tolerance: f64) -> Result<Advice> {
    advise_telling(bat, modes, tolerance, &nobody)
}

/// Advises as [`advise`] does, and reports the progress through the smaller models.
///
/// # Errors
///
/// As [`advise`].
pub fn advise_telling(bat: &Bat, modes: usize, tolerance: f64, tell: Tell) -> Result<Advice> {
    if !(1..=MOST_MODES).contains(&modes) {
        return Err(Error::value("modes", modes, format!("1 to {MOST_MODES}")));
    }
    if !(tolerance > 0.0 && tolerance < 1.0) {
        let expected = "a number between 0 and 1, such as 1e-6 or 0.01";
        return Err(Error::value("tolerance", tolerance, expected));
    }
    /// The round-off of a bat is a few times this.
    const FINEST: f64 = 1e-13;
    const FINE: f64 = 1e-10;
    let accuracy = (0.01 * tolerance).clamp(FINEST, FINE);
    let full = Model::full(bat);
    tell(0.0, "everything on the bat, and each of it taken off");
    let bat = tuned(bat.clone(), full.theory, accuracy)?;
    let mut bench = Bench::new(&bat, modes, accuracy);
    let effects = effects(&mut bench, &full)?;
    let smallest_model = smallest(&mut bench, &full, tolerance, tell)?;
    let solved = bench.solve(&full)?;
    Ok(Advice {
        modes: solved.solution.modes.len(),
        tolerance,
        effects,
        damping: Damping::of(&bat, &solved.solution),
        smallest_model,
        out_of_scope: outside(&bat),
        full_model: FullModel {
            tolerance_met: solved.solution.worst() <= tolerance && solved.solution.complete,
            solved,
        },
    })
}
