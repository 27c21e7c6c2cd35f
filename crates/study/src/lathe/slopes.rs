//! How does each answer change with the diameter, and by which method?

use serde::Serialize;

use crate::answers::Answer;
use crate::comparison::contender::Figure;

/// Method for a derivative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Rayleigh's quotient, stationary in the motion.
    Formula,
    /// Derivative of the rigid body's integrals.
    Exact,
    /// Central differences of whole bats.
    Difference,
}

impl Method {
    /// The method for an answer.
    pub fn of(answer: Answer) -> Self {
        match answer {
            Answer::Mass | Answer::BalancePoint | Answer::Inertia | Answer::CenterOfPercussion => {
                Self::Exact
            }
            Answer::Frequency(_) => Self::Formula,
            _ => Self::Difference,
        }
    }
}

/// How the answers change per unit of one change of the diameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Slopes {
    /// Derivative of each answer with its error, at the same angular speed of the swing; `None` if there is none.
    pub same_swing: Vec<Option<Figure>>,
    /// The derivatives of the frequencies by differences too, as a check of the formula; None for other answers
    /// and without two steps.
    pub checked: Vec<Option<f64>>,
    /// Derivative of the moment of inertia about the standard pivot (kg m²).
    pub inertia: f64,
    /// Change of each answer per rad/s of the swing; 0 for answers that do not belong to a hit.
    pub(super) by_swing: Vec<Option<f64>>,
    /// Share by which a swing of the same energy of rotation gains per unit of 2n: `−Ω/I dI`.
    pub(super) gain: f64,
}

impl Slopes {
    /// The derivatives for a batter who swings another bat at `Ω (I₀/I)^n`: n = 0 is the same swing, n = ½ the
    /// same energy of rotation.
    pub fn by_law(&self, exponent: f64) -> Vec<Option<Figure>> {
        // A bat at rest stays at rest.
        if exponent == 0.0 || self.gain == 0.0 {
            return self.same_swing.clone();
        }
        let of = |(slope, by_swing): (&Option<Figure>, &Option<f64>)| {
            let Figure { value, error } = (*slope)?;
            Some(Figure::new(value + exponent * self.gain * (*by_swing)?, error))
        };
        self.same_swing.iter().zip(&self.by_swing).map(of).collect()
    }
}
