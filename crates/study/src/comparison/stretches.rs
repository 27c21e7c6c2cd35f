//! Which bat hits harder, where and by how much, in sentences' parts.

use crate::comparison::rows::{ComparedFigure, Difference};

/// A stretch of the barrel where one bat hits harder, or neither.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Where it begins, from the tip (m).
    pub from: f64,
    /// Where it ends, farther from the tip (m).
    pub to: f64,
    /// 1 where the bat hits harder than the first one, −1 where the first does, 0 where the
    /// difference is within the errors.
    pub harder: i8,
    /// Where the difference is largest (m from the tip).
    pub most_at: f64,
    /// How large it is there (m/s).
    pub most: Difference,
}

/// Stretches of one sign, from the tip on, of one bat's speeds against the first one's.
pub fn stretches(distances: &[f64], speeds: &[ComparedFigure], bat: usize) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = vec![];
    for (distance, row) in distances.iter().zip(speeds) {
        let Some(most) = row.difference(bat) else { continue };
        let harder = if most.is_real() { most.by.signum() as i8 } else { 0 };
        let here = Stretch { from: *distance, to: *distance, harder, most_at: *distance, most };
        match all.last_mut().filter(|last| last.harder == harder) {
            Some(last) => {
                last.to = *distance;
                if most.by.abs() > last.most.by.abs() {
                    (last.most_at, last.most) = (*distance, most);
                }
            }
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
        let row = |by: f64| ComparedFigure {
            key: String::new(),
            name: String::new(),
            unit: Unit::MetresPerSecond,
            from: From::Tip,
            values: vec![Some(Figure::new(40.0, 0.1)), Some(Figure::new(40.0 + by, 0.1))],
        };
        let rows = [row(1.0), row(2.0), row(0.15), row(-0.15), row(-1.0)];
        let found = stretches(&[0.0, 0.1, 0.2, 0.3, 0.4], &rows, 1);
        let signs: Vec<i8> = found.iter().map(|s| s.harder).collect();
        assert_eq!(signs, [1, 0, -1]);
        assert_eq!((found[0].from, found[0].to, found[0].most_at), (0.0, 0.1, 0.1));
        assert_eq!((found[1].from, found[1].to), (0.2, 0.3));
    }
}
