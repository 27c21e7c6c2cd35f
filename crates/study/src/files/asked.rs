//! Names of outputs, and correlations of names, in files.

use crate::engine::{Node, Result, mistakes};
use crate::files::form::{at, sound};

/// The outputs by their names: at least one, each once.
pub(super) fn outputs<T: Copy + PartialEq>(
    node: &Node,
    named: impl Fn(&str) -> Result<T>,
) -> Result<Vec<(String, T)>> {
    let items = node.items()?;
    if items.is_empty() {
        return Err(node.error("an empty list", "one name at least, such as \"f1_hz\""));
    }
    let mut seen: Vec<T> = vec![];
    mistakes::all(items.iter().map(|item| {
        let name = item.string()?;
        let output = named(&name).map_err(|error| at(item, error))?;
        sound(item, !seen.contains(&output), "every output once")?;
        seen.push(output);
        Ok((name, output))
    }))
}

/// Triples of two names, which `place` finds, and the correlation of the named values; `expected` texts for a triple
/// and for the second name.
pub(super) fn correlations(
    node: &Node,
    [all, second]: [&str; 2],
    place: impl Fn(&Node) -> Result<usize>,
) -> Result<Vec<(usize, usize, f64)>> {
    mistakes::all(node.items()?.iter().map(|item| {
        let [a, b, r] = &item.items()?[..] else { return Err(item.error(item.shown(), all)) };
        let (of_a, of_b) = (place(a)?, place(b)?);
        sound(b, of_a != of_b, second)?;
        let value = r.number()?;
        sound(r, value.abs() < 1.0, "a number between -1 and 1")?;
        Ok((of_a, of_b, value))
    }))
}
