//! The coherence of a measured response: dataset 58, type 6.

use uff58::{Function, Universal, Values};

/// Number of a coherence among the functions of dataset 58.
const COHERENCE: i64 = 6;

/// The coherence for the same force and response over the same frequencies, without the first `dropped`.
pub fn of(universal: &Universal, response: &Function, dropped: usize) -> Option<Vec<f64>> {
    let all = universal.functions().map(|(_, function)| function);
    let mut functions = all.filter(|function| function.kind == COHERENCE);
    let nodes = |one: &Function| [one.response.node, one.reference.node];
    let same = |other: &&Function| {
        nodes(other) == nodes(response) && other.values.len() == response.values.len()
    };
    let values = match &functions.find(same)?.values {
        Values::Real(values) => values.clone(),
        Values::Complex(values) => values.iter().map(|[re, _]| *re).collect(),
    };
    values.iter().all(|v| (0.0..=1.001).contains(v)).then(|| values[dropped..].to_vec())
}
