//! Which bat hits harder, where and by how much, as parts of sentences.

use serde::Serialize;

use crate::comparison::rows::ComparedFigure;

/// A stretch of the barrel where one of two bats hits harder, or neither.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Stretch {
    /// Beginning and end, as distances from the tip (m).
    pub from_tip_m: [f64; 2],
    /// Which bat hits harder; null where the difference is within the errors.
    pub harder: Option<Harder>,
    /// The largest difference of the exit speeds (m/s).
    pub largest_difference_m_s: f64,
    /// Error of that difference (m/s).
    pub largest_difference_error_m_s: f64,
    /// Place of the largest difference, as a distance from the tip (m).
    pub largest_at_from_tip_m: f64,
}

/// Which of two bats hits harder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, schemars::JsonSchema)]
pub enum Harder {
    /// This one.
    #[serde(rename = "this")]
    This,
    /// The first one, which the others are compared with.
    #[serde(rename = "the first")]
    TheFirst,
}

/// Stretches of one sign, from the tip on, of one bat's speeds against the first one's.
pub fn stretches(distances: &[f64], speeds: &[ComparedFigure], bat: usize) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = vec![];
    for (distance, row) in distances.iter().zip(speeds) {
        let Some(most) = row.difference(bat) else { continue };
        let by = if most.by > 0.0 { Harder::This } else { Harder::TheFirst };
        let here = Stretch {
            from_tip_m: [*distance; 2],
            harder: most.beyond_errors.then_some(by),
            largest_difference_m_s: most.by,
            largest_difference_error_m_s: most.within,
            largest_at_from_tip_m: *distance,
        };
        match all.last_mut().filter(|last| last.harder == here.harder) {
            Some(last) if most.by.abs() > last.largest_difference_m_s.abs() => {
                *last = Stretch { from_tip_m: [last.from_tip_m[0], *distance], ..here };
            }
            Some(last) => last.from_tip_m[1] = *distance,
            None => all.push(here),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comparison::contender::Figure;
    use crate::comparison::rows::{From, Unit};

    #[test]
    fn stretches_are_of_one_sign_and_a_difference_within_the_errors_is_none() {
        let row = |by: f64| {
            let values = [Some(Figure::new(40.0, 0.1)), Some(Figure::new(40.0 + by, 0.1))];
            ComparedFigure::new(("", ""), Unit::MetresPerSecond, From::Tip, &values)
        };
        let rows = [row(1.0), row(2.0), row(0.15), row(-0.15), row(-1.0)];
        let found = stretches(&[0.0, 0.1, 0.2, 0.3, 0.4], &rows, 1);
        let harder: Vec<Option<Harder>> = found.iter().map(|s| s.harder).collect();
        assert_eq!(harder, [Some(Harder::This), None, Some(Harder::TheFirst)]);
        assert_eq!((found[0].from_tip_m, found[0].largest_at_from_tip_m), ([0.0, 0.1], 0.1));
        assert_eq!(found[1].from_tip_m, [0.2, 0.3]);
    }
}
