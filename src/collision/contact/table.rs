//! The force in time, piece by piece, and the effect of a step's force on the modes: one table for every length of a
//! step.

use faer::c64;

use crate::collision::contact::collocation::{LANES, Lanes, Lobatto, POINTS, polynomial};
use crate::motion::phi::{driven, moments, pushed, shortened};

/// A part of the force in time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ForcePiece {
    /// When it begins, since the first touch (s).
    pub start: f64,
    /// How long it lasts (s).
    pub length: f64,
    /// Coefficients (N) of the powers of `(t − start)/length`.
    pub powers: [f64; POINTS],
}

impl ForcePiece {
    /// When it ends, since the first touch (s).
    #[inline(always)]
    pub fn end(&self) -> f64 {
        self.start + self.length
    }

    /// Its beginning, of that length (s).
    #[inline(always)]
    pub fn first(&self, length: f64) -> Self {
        let powers = shortened(self.powers, length / self.length);
        Self { start: self.start, length, powers }
    }

    /// A mode's memory at its end, given that at its beginning.
    #[inline(always)]
    pub fn drive(&self, s: c64, memory: c64) -> c64 {
        driven(s, memory, &self.powers, self.length)
    }

    /// `∫∫F dt²` and `∫F dt` until its end: the displacement and the speed that it gives to a unit mass.
    #[inline(always)]
    pub fn push(&self) -> [f64; 2] {
        pushed(&self.powers, self.length)
    }

    /// Whether it is negative somewhere by more than about a millionth of that force (N): a ball never pulls.
    #[inline(always)]
    pub fn pulls(&self, most: f64) -> bool {
        const LOOKS: u32 = 16;
        /// The force may be a few times as negative between two samples.
        const NOTHING: f64 = 3e-7;
        // Samples are closer towards the ends, where the force is flat.
        let force = |k: u32| {
            let at = f64::from(k) / f64::from(LOOKS);
            polynomial(&self.powers, at * at * (3.0 - 2.0 * at))
        };
        (1..LOOKS).any(|k| force(k) < -NOTHING * most)
    }
}

/// Effect of a step on some modes side by side; `[part]` is the real part, the imaginary part.
#[derive(Debug, Clone, Copy, Default)]
pub struct Moves {
    /// `e^{sh s_i}`, by which every memory turns up to point i, `[i][part]`.
    pub turns: [[Lanes; 2]; POINTS],
    /// `∫₀^{h s_i} e^{s(h s_i − τ)} L_j dτ`, the effect of the force at point j on every memory at point i,
    /// `[i][j][part]`.
    pub kernels: [[[Lanes; 2]; POINTS]; POINTS],
}

/// Effect of a step of one length on every mode.
#[derive(Debug, Clone)]
pub struct StepTable {
    /// Length of the step (s).
    pub length: f64,
    /// Effect on the modes, lane by lane.
    pub moves: Vec<Moves>,
    /// `∫₀^h e^{s(h − τ)} σ(1 − σ) dτ` with σ = τ/h: the bump over the whole step, `[part]`.
    pub bump: Vec<[Lanes; 2]>,
}

impl StepTable {
    /// The table of a step of that length (s) for modes of those `s` (1/s), which fill the lanes.
    pub fn new(rule: &Lobatto, poles: &[c64], length: f64) -> Self {
        let chunks = poles.len() / LANES;
        let mut table = Self {
            length,
            moves: vec![Moves::default(); chunks],
            bump: vec![Default::default(); chunks],
        };
        for (n, s) in poles.iter().enumerate() {
            let (moves, l) = (&mut table.moves[n / LANES], n % LANES);
            let put =
                |all: &mut [Lanes; 2], value: c64| (all[0][l], all[1][l]) = (value.re, value.im);
            for i in 1..POINTS {
                let at = length * rule.at[i];
                let (whole, all) = moments::<POINTS>(s * at);
                put(&mut moves.turns[i], whole);
                for j in 0..POINTS {
                    let mut sum = c64::new(0.0, 0.0);
                    for (power, moment) in shortened(rule.powers[j], rule.at[i]).iter().zip(&all) {
                        sum += moment * (at * power);
                    }
                    put(&mut moves.kernels[i][j], sum);
                }
                if i == POINTS - 1 {
                    put(&mut table.bump[n / LANES], (all[1] - all[2]) * length);
                }
            }
        }
        table
    }
}
