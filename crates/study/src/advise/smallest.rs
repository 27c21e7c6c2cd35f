//! The smallest model whose frequencies are near enough to those of the full one.

use std::rc::Rc;

use crate::advise::model::{Bench, Model, Solved};
use sweetspot::base::error::Result;
use sweetspot::base::telling::Tell;
use sweetspot::bat::theory::Theory;

/// A model that will do.
#[derive(Debug, Clone)]
pub struct Smallest {
    /// The model and its modes.
    pub solved: Rc<Solved>,
    /// The largest |f/f_full − 1|.
    pub deviation: f64,
    /// How far the deviation may be off.
    pub error: f64,
}

/// The model with the fewest switches on whose every frequency is within `tolerance` of the full
/// one's, errors included; of several, the nearest. Every candidate is solved, from the smallest
/// on.
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
            let Ok(bat) = model.bat(bench.bat()) else { continue };
            let others = bat.fixtures().rigid_modes() != truth.bat.fixtures().rigid_modes();
            if others || (model.theory.shears() && !bat.knows_shear()) {
                continue;
            }
            let solved = bench.solve(&model)?;
            let Some([deviation, error]) = deviation(&solved, &truth) else { continue };
            let nearer = best.as_ref().is_none_or(|best| deviation < best.deviation);
            if deviation + error <= tolerance && nearer {
                best = Some(Smallest { solved, deviation, error });
            }
        }
        if let Some(best) = best {
            return Ok(best);
        }
    }
    Ok(Smallest { solved: truth, deviation: 0.0, error: 0.0 })
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

/// The largest |f/f_full − 1| and its possible error; None where the modes are others.
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
