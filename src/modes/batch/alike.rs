//! Which bats can share a plan?

use crate::bat::{Bat, Piece, Radii, SAME_PLACE};
use crate::beam::Rule;

/// Whether a bat is made of stations and has only masses on it, and nothing that holds it.
pub fn plain(bat: &Bat) -> bool {
    let formula = |piece: &Piece| matches!(piece.radii, Radii::Formula(_));
    bat.fixtures().only_masses() && !bat.profile().pieces.iter().any(formula)
}

/// Whether a bat can use the plan of another: the same number of pieces, sampled at the same number of points, similar
/// proportions, and masses at the same borders, so that the same elements suit both.
pub fn same_pattern(a: &Bat, b: &Bat) -> bool {
    const ALIKE: f64 = 2.5;
    let (widest_a, widest_b) = (a.profile().widest(), b.profile().widest());
    let pieces = a.profile().pieces.iter().zip(&b.profile().pieces);
    // Places of the fixtures, by the piece that begins there, and which of them have a mass.
    let masses = |bat: &Bat| -> Vec<bool> {
        bat.fixtures().attachments.iter().map(|a| a.mass + a.rotary_inertia > 0.0).collect()
    };
    let border = |bat: &Bat, x: f64| {
        let same = SAME_PLACE * bat.length();
        bat.profile().pieces.partition_point(|piece| piece.start < x - same)
    };
    let borders = |bat: &Bat| -> Vec<usize> {
        bat.fixtures().borders().into_iter().map(|x| border(bat, x)).collect()
    };
    a.profile().pieces.len() == b.profile().pieces.len()
        && plain(a) == plain(b)
        && masses(a) == masses(b)
        && borders(a) == borders(b)
        && std::ptr::eq(Rule::of(a, false, 3), Rule::of(b, false, 3))
        && pieces.flat_map(|(a, b)| std::iter::zip(a.ends(), b.ends())).all(|(of_a, of_b)| {
            let (of_a, of_b) = (of_a.outer * widest_b, of_b.outer * widest_a);
            of_a <= ALIKE * of_b && of_b <= ALIKE * of_a
        })
}
