//! Does a weighed mass hide the difference between two bats?

use crate::engine::{Bat, significant};

/// Least relative change of a density that is more than rounding.
const REAL: f64 = 1e-9;

/// A sentence if both bats have the same weighed mass; `name` is the second bat, `first` the first. The density of the
/// second was then set anew, so the mass does not show a difference in material. That is right for bats of different
/// makers, but not for a bat that was changed from the other.
pub fn hidden(first: (&str, &Bat), other: (&str, &Bat)) -> Option<String> {
    let [a, b] = [first.1.unedited(), other.1.unedited()];
    let [weighed, again] = [a, b].map(|bat| bat.weighed().mass);
    let mass = weighed.filter(|mass| Some(*mass) == again)?;
    let by = b.material().density / a.material().density - 1.0;
    let attached = (b.fixtures().attached_mass() - a.fixtures().attached_mass()).abs();
    if by.abs() < REAL && attached < REAL * mass {
        return None;
    }
    let way = if by < 0.0 { "below" } else { "above" };
    let density = format!("{} % {way}", significant(100.0 * by.abs(), 2));
    Some(format!(
        "{other} and {first} are both weighed at {mass} kg, which sets the density of {other} {density} that \
         of {first}: if {other} is {first} with a change, its mass and swing weight do not show it. Keep \
         \"weighed\" for the bat that was on the scale and write the change as an edit: \"edits\" in its \
         file, or --edit here",
        first = first.0,
        other = other.0,
        mass = significant(mass, 4),
    ))
}
