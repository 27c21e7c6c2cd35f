//! What does a contact need from a ball's force law?
//!
//! Another law is a type with [`ForceLaw`]; [`crate::collision::contact::power_law`] is one to
//! follow. The force is one function of the compression on the way to the largest compression, and another, reversible
//! one below it, so that the stored and the lost energy are known in every state.

/// The largest compression so far (m) and the force there (N), once the ball springs back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Top {
    /// x_m (m).
    pub compression: f64,
    /// Force (N) at it.
    pub force: f64,
}

/// The law of one ball for one hit. The force begins at 0 and rises with the compression. `top` is `None` on the way to
/// the largest compression; otherwise the force is that of the way back, below it.
pub trait ForceLaw: Copy + Send + Sync {
    /// Force (N) at that compression (m) and its derivative (N/m); both are 0 at a compression of 0 or less.
    fn force(&self, x: f64, top: Option<Top>) -> [f64; 2];

    /// Energy stored and energy lost so far (J) at the compression `x` (m), from the force (N) there.
    fn energy_of(&self, x: f64, force: f64, top: Option<Top>) -> [f64; 2];

    /// The compression (m) that stores that energy (J).
    fn compression(&self, energy: f64) -> f64;

    /// The power of the compression with which the force begins, or with which it ends on the way back; if it is not a
    /// power, the largest exponent that it approaches.
    fn exponent(&self, top: Option<Top>) -> f64;

    /// Stiffness, loading and unloading exponent of a power law; hits with such a law are computed side by side.
    #[inline(always)]
    fn powers(&self) -> Option<[f64; 3]> {
        None
    }

    /// The derivative (N/m) at a compression with that force (N).
    #[inline(always)]
    fn slope(&self, x: f64, _force: f64, top: Option<Top>) -> f64 {
        self.force(x, top)[1]
    }

    /// Derivative (N/m) of the force (N) at a compression on the way back by the largest compression.
    #[inline(always)]
    fn by_top(&self, x: f64, _force: f64, top: Top) -> f64 {
        /// Relative change of the largest compression for the difference.
        const BY: f64 = 1e-5;
        let of = |compression: f64| {
            let force = self.force(compression, None)[0];
            self.force(x, Some(Top { compression, force }))[0]
        };
        let [more, less] = [1.0 + BY, 1.0 - BY].map(|by| of(by * top.compression));
        (more - less) / (2.0 * BY * top.compression)
    }

    /// The forces (N) at compressions that differ little from those where they are known, if there is a shorter way
    /// than [`Self::force`].
    #[inline(always)]
    fn near<const N: usize>(
        &self,
        _x: [f64; N],
        _force: [f64; N],
        _by: [f64; N],
        _top: Option<Top>,
    ) -> Option<[f64; N]> {
        None
    }

    /// An upper bound of the compression (m) at that force (N).
    #[inline(always)]
    fn at(&self, _force: f64, _top: Option<Top>) -> f64 {
        f64::INFINITY
    }

    /// Energy stored and energy lost so far (J).
    #[inline(always)]
    fn energy(&self, x: f64, top: Option<Top>) -> [f64; 2] {
        self.energy_of(x, self.force(x, top)[0], top)
    }

    /// The share of a compression that is small on a branch that may be steep: 10 over its exponent, at most 1.
    #[inline(always)]
    fn fine(&self, top: Option<Top>) -> f64 {
        (10.0 / self.exponent(top)).min(1.0)
    }

    /// The ball's part (m) of `x + C F(x) = whole` with a spring of that flexibility C (m/N), and the
    /// force (N), by Newton's method from `guess` (m). A guess outside of 0 to `whole` is rejected.
    #[inline(always)]
    fn share(&self, whole: f64, flexibility: f64, top: Option<Top>, guess: f64) -> [f64; 2] {
        if flexibility == 0.0 || whole <= 0.0 {
            return [whole, self.force(whole, top)[0]];
        }
        // The function is convex, so Newton's method descends from here, above the root.
        let above = || whole.min(self.at(whole / flexibility, top));
        let mut x = if guess > 0.0 && guess < whole { guess } else { above() };
        let fine = self.fine(top);
        for _ in 0..60 {
            let [force, slope] = self.force(x, top);
            let by = (whole - x - flexibility * force) / (1.0 + flexibility * slope);
            // The remaining error is the square of this.
            if by.abs() <= (1e-10 * fine).max(f64::EPSILON) * x {
                return [x + by, force + slope * by];
            }
            // A guess so far below is of no use.
            x = if by > 0.1 * fine * x { above() } else { x + by };
        }
        [x, self.force(x, top)[0]]
    }
}
