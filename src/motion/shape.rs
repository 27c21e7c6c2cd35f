//! From which shape is a bat released?

/// Deflections `w` (m) at rising places `x` (m).
#[derive(Debug, Clone, PartialEq)]
pub struct InitialShape {
    /// Places from the knob end (m).
    pub x: Vec<f64>,
    /// Deflections (m).
    pub w: Vec<f64>,
}

impl InitialShape {
    /// The deflection at `x`, linear between the rows and constant beyond them.
    pub fn at(&self, x: f64) -> f64 {
        let k = self.x.partition_point(|at| *at <= x);
        if k == 0 || k == self.x.len() {
            return self.w[k.saturating_sub(1)];
        }
        let s = (x - self.x[k - 1]) / (self.x[k] - self.x[k - 1]);
        (1.0 - s) * self.w[k - 1] + s * self.w[k]
    }

    /// The slope at `x`, at a row the mean of both sides.
    pub fn slope(&self, x: f64) -> f64 {
        let last = self.x.len() - 1;
        let of = |k: usize| (self.w[k] - self.w[k - 1]) / (self.x[k] - self.x[k - 1]);
        let right = self.x.partition_point(|at| *at <= x).clamp(1, last);
        let left = self.x.partition_point(|at| *at < x).clamp(1, last);
        0.5 * (of(left) + of(right))
    }
}
