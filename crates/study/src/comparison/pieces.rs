//! How much do two pieces of one wood differ in the compared figures?
//!
//! Two bats are two pieces of wood. Their E and density differ independently from the species' mean by the published
//! scatter. Let `σ_A` and `σ_B` be the standard deviations of a figure of both bats due to the wood alone. The figure
//! then differs by
//!
//! ```text
//! ± √(σ_A² + σ_B²),   √2 σ where both are of one model
//! ```
//!
//! between two bats picked from the shelf. A bat and its edited copy are one piece, with one wood.

use crate::comparison::contender::Contender;
use crate::engine::{Bat, Change, Model};
use crate::spread::{Analysed, COUNTED, Input, KEYS, Readings, Spread};

/// Standard deviations due to the wood alone, in the order of [`COUNTED`]; `None` if unknown.
pub type ByWood = [Option<f64>; COUNTED.len()];

/// The uncertainty of every answer of a bat due to the wood.
pub fn by_wood(contender: &Contender, model: Model) -> ByWood {
    let analysed = Analysed {
        bat: &contender.bat,
        solution: &contender.sweep.solution,
        model,
        scene: &contender.scene,
        law: contender.law,
        hits: &contender.sweep,
        spot: &contender.spot,
    };
    let spread = Spread::new(&analysed, &Readings::default());
    let wood = |k: usize| matches!(spread.sources[k].input, Input::Stiffness | Input::Density);
    if !(0..spread.sources.len()).any(wood) {
        return [None; COUNTED.len()];
    }
    COUNTED.map(|answer| {
        let estimate = spread.of(answer)?;
        estimate.deviation?;
        let parts = estimate.parts.iter().enumerate().filter(|(k, _)| wood(*k));
        Some(parts.map(|(_, part)| part * part).sum::<f64>().sqrt())
    })
}

/// The answer that a row of figures is, by its key: its place in [`COUNTED`].
pub fn answer(key: &str) -> Option<usize> {
    KEYS.iter().position(|[_, of_row]| *of_row == key)
}

/// Whether two bats are one piece of wood: one is the other with edits that do not change the wood.
pub fn one_piece(first: &Bat, other: &Bat) -> bool {
    let wood = |bat: &Bat| bat.edits().iter().any(|edit| matches!(edit.change, Change::Wood(_)));
    let [a, b] = [first, other].map(Bat::unedited);
    let edited = !(first.edits().is_empty() && other.edits().is_empty());
    let same = a.profile() == b.profile() && a.material() == b.material();
    edited && same && a.regional().eq(b.regional()) && !wood(first) && !wood(other)
}
