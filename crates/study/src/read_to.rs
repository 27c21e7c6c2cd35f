//! To what step were the diameters of a bat read?
//!
//! Calipers read to 0.1 mm and better; a ruler, a tape or a template is read to a sixteenth of an inch, or to a
//! millimetre. A column whose diameters all lie on such a grid was read to it. Numbers that were typed with two or
//! three decimals (2.56 for 2 9/16) lie on it but for their rounding: then enough of them are needed that
//! chance does not put them all there.

use crate::engine::{Bat, INCH, Stations, barrel_walls};

/// The step to which diameters were read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadTo {
    /// The step (m).
    pub step: f64,
    /// In words, such as 1/16 in.
    pub name: &'static str,
}

impl ReadTo {
    /// Standard deviation (m) of a reading that was rounded to the step, `step/√12`.
    pub fn deviation(&self) -> f64 {
        self.step / 12.0_f64.sqrt()
    }
}

/// The grids, the coarsest first. The rounding to a finer grid is less than the error of calipers.
const GRIDS: [ReadTo; 4] = [
    ReadTo { step: INCH / 16.0, name: "1/16 in" },
    ReadTo { step: 1e-3, name: "1 mm" },
    ReadTo { step: INCH / 32.0, name: "1/32 in" },
    ReadTo { step: INCH / 64.0, name: "1/64 in" },
];
/// Largest roundings of a typed number (m): none, three and two decimals of an inch.
const ROUNDED: [f64; 3] = [1e-6 * INCH, 0.5e-3 * INCH, 5e-3 * INCH];
/// So rarely does chance put all diameters of a column on a grid.
const CHANCE: f64 = 1e-3;
/// Least number of different values that identify a grid.
const FEWEST: usize = 3;

/// The coarsest step to which all outer diameters of a bat were read, before its edits; `None` for values on no grid,
/// as from calipers, and for a formula, which was not read off an instrument.
pub fn diameters_read_to(bat: &Bat) -> Option<ReadTo> {
    let profile = bat.unedited().profile();
    if profile.formulas.is_some() {
        return None;
    }
    let Stations { outer, inner, .. } = &profile.stations;
    // Stations of a cup in a solid tip are the cup's; the tip itself was read.
    let solid = barrel_walls(bat.unedited()).is_empty();
    let of_cup = |k: usize| k + 1 < inner.len() && (inner[k] > 0.0 || inner[k + 1] > 0.0);
    let read = (0..outer.len()).filter(|k| !(solid && of_cup(*k)));
    let mut diameters: Vec<f64> = read.map(|k| 2.0 * outer[k]).filter(|d| *d > 0.0).collect();
    diameters.sort_by(f64::total_cmp);
    diameters.dedup_by(|a, b| (*a - *b).abs() < ROUNDED[0]);
    read_to(&diameters)
}

/// The grid of different diameters (m).
fn read_to(diameters: &[f64]) -> Option<ReadTo> {
    let off = |diameter: f64, step: f64| (diameter - step * (diameter / step).round()).abs();
    let on = |grid: &ReadTo, within: f64| diameters.iter().all(|d| off(*d, grid.step) <= within);
    let count = diameters.len() as i32;
    let told = |grid: &ReadTo| {
        let [exactly, ..] = ROUNDED;
        let by_chance = |within: f64| (2.0 * within / grid.step).powi(count) < CHANCE;
        let inches = grid.step != 1e-3;
        // An odd number of eighths, or finer, is not typed by people who read decimals.
        let fraction = |d: &f64| inches && off(*d, INCH / 4.0) > exactly;
        let enough = diameters.len() >= FEWEST || diameters.iter().any(fraction);
        let rounded = ROUNDED[1..].iter().filter(|_| inches && diameters.len() >= FEWEST);
        (on(grid, exactly) && enough)
            || rounded.into_iter().any(|within| on(grid, *within) && by_chance(*within))
    };
    GRIDS.into_iter().find(told)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(diameters: &[f64], unit: f64) -> Option<&'static str> {
        let metres: Vec<f64> = diameters.iter().map(|d| d * unit).collect();
        read_to(&metres).map(|read| read.name)
    }

    #[test]
    fn fractions_are_told_however_they_are_typed_and_calipers_are_not() {
        let sixteenths = [1.75, 0.9375, 1.0625, 1.5, 2.5625];
        assert_eq!(named(&sixteenths, INCH), Some("1/16 in"));
        assert_eq!(named(&[1.75, 0.938, 1.063, 1.5, 2.563], INCH), Some("1/16 in"));
        assert_eq!(named(&[1.75, 0.94, 1.06, 1.5, 2.56], INCH), Some("1/16 in"));
        assert_eq!(named(&[0.96875, 2.5625, 1.0], INCH), Some("1/32 in"));
        assert_eq!(named(&[0.984375, 2.5625, 1.0], INCH), Some("1/64 in"));
        assert_eq!(named(&[47.0, 24.0, 31.0, 65.0], 1e-3), Some("1 mm"));
        assert_eq!(named(&[47.2, 24.1, 31.4, 65.0], 1e-3), None);
        assert_eq!(named(&[1.902, 0.951, 1.214, 2.487], INCH), None);
        assert_eq!(named(&[1.9, 1.2, 2.5], INCH), None);
    }

    #[test]
    fn a_few_round_numbers_tell_nothing() {
        assert_eq!(named(&[1.0, 2.5], INCH), None);
        assert_eq!(named(&[40.0], 1e-3), None);
        assert_eq!(named(&[2.5625], INCH), Some("1/16 in"));
    }

    #[test]
    fn a_rounding_to_a_step_is_off_by_its_share() {
        assert!((GRIDS[0].deviation() - 0.458e-3).abs() < 1e-6);
    }
}
