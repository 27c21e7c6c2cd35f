//! The force in time, piece by piece, and what the force of a step does to the modes: a table for every
//! length of a step, made once.

use faer::c64;

use crate::collision::contact::collocation::{LANES, Lobatto, POINTS, lanes, polynomial};
use crate::motion::phi::{driven, moments, pushed, shortened};

/// A part of the force in time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Piece {
    /// When it begins, since the first touch (s).
    pub start: f64,
    /// How long it lasts (s).
    pub length: f64,
    /// Coefficients (N) of the powers of `(t − start)/length`.
    pub powers: [f64; POINTS],
}

impl Piece {
    /// When it ends, since the first touch (s).
    #[inline(always)]
    pub fn end(&self) -> f64 {
        self.start + self.length
    }

    /// Its first so many seconds.
    #[inline(always)]
    pub fn first(&self, length: f64) -> Self {
        let powers = shortened(self.powers, length / self.length);
        Self { start: self.start, length, powers }
    }

    /// What becomes of a mode's memory by its end.
    #[inline(always)]
    pub fn drive(&self, s: c64, memory: c64) -> c64 {
        driven(s, memory, &self.powers, self.length)
    }

    /// `∫∫F dt²` and `∫F dt` until its end: what it does to the place and the speed of a unit mass.
    #[inline(always)]
    pub fn push(&self) -> [f64; 2] {
        pushed(&self.powers, self.length)
    }

    /// Whether it is less than zero somewhere by more than about a millionth of that force (N), which
    /// no ball's is.
    #[inline(always)]
    pub fn pulls(&self, most: f64) -> bool {
        const LOOKS: u32 = 16;
        /// Between two looks it may be some times less.
        const NOTHING: f64 = 3e-7;
        // Closer towards the ends, where it is flat.
        let force = |k: u32| {
            let at = f64::from(k) / f64::from(LOOKS);
            polynomial(&self.powers, at * at * (3.0 - 2.0 * at))
        };
        (1..LOOKS).any(|k| force(k) < -NOTHING * most)
    }
}

/// What a step of one length does to every mode; numbers of the modes side by side.
#[derive(Debug, Clone)]
pub struct StepTable {
    /// Length of the step (s).
    pub length: f64,
    /// Number of modes, those that fill the lanes included.
    pub modes: usize,
    /// `e^{sh s_i}`, `[i][part][mode]`.
    pub turns: Vec<f64>,
    /// `∫₀^{h s_i} e^{s(h s_i − τ)} L_j dτ`, `[i][j][part][mode]`.
    pub kernels: Vec<f64>,
    /// `∫₀^h e^{s(h − τ)} σ(1 − σ) dτ` with σ = τ/h: the bump over the whole step, `[part][mode]`.
    pub bump: Vec<f64>,
}

impl StepTable {
    /// The table of a step of that length (s) for modes of those `s` (1/s).
    pub fn new(rule: &Lobatto, poles: &[c64], length: f64) -> Self {
        let modes = poles.len();
        let mut table = Self {
            length,
            modes,
            turns: vec![0.0; POINTS * 2 * modes],
            kernels: vec![0.0; POINTS * POINTS * 2 * modes],
            bump: vec![0.0; 2 * modes],
        };
        for (n, s) in poles.iter().enumerate() {
            for i in 1..POINTS {
                let at = length * rule.at[i];
                let (whole, all) = moments::<POINTS>(s * at);
                let put = |all: &mut [f64], row: usize, value: c64| {
                    (all[2 * row * modes + n], all[(2 * row + 1) * modes + n]) =
                        (value.re, value.im);
                };
                put(&mut table.turns, i, whole);
                for j in 0..POINTS {
                    let mut sum = c64::new(0.0, 0.0);
                    for (power, moment) in shortened(rule.powers[j], rule.at[i]).iter().zip(&all) {
                        sum += moment * (at * power);
                    }
                    put(&mut table.kernels, i * POINTS + j, sum);
                }
                if i == POINTS - 1 {
                    put(&mut table.bump, 0, (all[1] - all[2]) * length);
                }
            }
        }
        table
    }

    /// What a step turns every memory by up to point i: real parts (0) or imaginary parts (1).
    #[inline(always)]
    pub fn turn(&self, i: usize, part: usize) -> &[[f64; LANES]] {
        lanes(&self.turns[(2 * i + part) * self.modes..][..self.modes])
    }

    /// What the force at point j does to every memory at point i: real (0) or imaginary parts (1).
    #[inline(always)]
    pub fn kernel(&self, i: usize, j: usize, part: usize) -> &[[f64; LANES]] {
        lanes(&self.kernels[((i * POINTS + j) * 2 + part) * self.modes..][..self.modes])
    }

    /// What the bump does to every mode, real and imaginary parts.
    #[inline(always)]
    pub fn bumps(&self) -> [&[f64]; 2] {
        self.bump.split_at(self.modes).into()
    }
}
