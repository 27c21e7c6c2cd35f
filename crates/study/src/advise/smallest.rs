//! The smallest model whose frequencies are close enough to those of the full one.

use std::rc::Rc;

use serde::Serialize;

use crate::advise::model::{Bench, Model, Solved};
use crate::engine::{Result, Tell, Theory};

/// The smallest model within the tolerance.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct Smallest {
    /// The model and its modes.
    #[serde(flatten)]
    pub solved: Rc<Solved>,
    /// The parts of the full model that it omits, in words.
    pub left_out: Vec<&'static str>,
    /// Largest relative difference of a frequency from the full model's.
    pub deviation: f64,
    /// Error of that difference.
    pub deviation_error: f64,
}

/// The parts of the full model that a model omits, in words.
fn left_out(kept: &Model, full: &Model) -> Vec<&'static str> {
    let turning = (full.theory.turns() && !kept.theory.turns()).then_some("rotary inertia");
    let shearing = (full.theory.shears() && !kept.theory.shears()).then_some("shear");
    let parts = full.parts.iter().filter(|part| !kept.parts.contains(part));
    turning.into_iter().chain(shearing).chain(parts.map(|part| part.name())).collect()
}

/// The model with the fewest parts whose every frequency is within `tolerance` of the full model's, errors included; of
/// several, the closest. Every candidate is solved, from the smallest on.
///
/// # Errors
///
/// Those of [`sweetspot::modes::solve::solve`].
pub fn smallest(bench: &mut Bench, full: &Model, tolerance: f64, tell: Tell) -> Result<Smallest> {
    let truth = bench.solve(full)?;
    let (mut tried, all) = (0, models(full).count());
    for size in 0..full.size() {
        let mut best: Option<Smallest> = None;
        for model in models(full).filter(|model| model.size() == size) {
            tell(f64::from(tried) / all as f64, "smaller models");
            tried += 1;
            let Ok(bat) = model.bat(bench.bat) else { continue };
            let others = bat.fixtures().rigid_modes() != truth.bat.fixtures().rigid_modes();
            if others || (model.theory.shears() && !bat.knows_shear()) {
                continue;
            }
            let solved = bench.solve(&model)?;
            let Some([deviation, deviation_error]) = deviation(&solved, &truth) else { continue };
            let nearer = best.as_ref().is_none_or(|best| deviation < best.deviation);
            if deviation + deviation_error <= tolerance && nearer {
                let left_out = left_out(&model, full);
                best = Some(Smallest { solved, left_out, deviation, deviation_error });
            }
        }
        if let Some(best) = best {
            return Ok(best);
        }
    }
    Ok(Smallest { solved: truth, left_out: vec![], deviation: 0.0, deviation_error: 0.0 })
}

/// Every theory with every set of the full model's parts.
fn models(full: &Model) -> impl Iterator<Item = Model> + '_ {
    let theories = Theory::ALL.into_iter().filter(|theory| *theory <= full.theory);
    theories.flat_map(move |theory| {
        (0..1_usize << full.parts.len()).map(move |set| {
            let kept = full.parts.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1);
            Model { theory, parts: kept.map(|(_, part)| *part).collect() }
        })
    })
}

/// The largest |f/f_full − 1| and its possible error; `None` if the modes do not correspond.
fn deviation(solved: &Solved, full: &Solved) -> Option<[f64; 2]> {
    if !solved.pairs_with(full) {
        return None;
    }
    let pairs = solved.solution.modes.iter().zip(&full.solution.modes);
    Some(pairs.fold([0.0, 0.0], |[most, error], (a, b)| {
        let ratio = a.omega / b.omega;
        let own = ratio * (a.error.total() + b.error.total());
        [f64::max(most, (ratio - 1.0).abs()), f64::max(error, own)]
    }))
}
