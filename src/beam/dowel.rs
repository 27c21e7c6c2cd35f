//! What does a uniform beam do, in closed form?
//!
//! The reference for all computed results: [`Dowel::frequency`], [`UniformMode::new`], [`beta_l`].
//!
//! Euler–Bernoulli bending, `EI w⁗ = ω² ρA w`. With `X = x/L` and `b = βL` the modes are
//!
//! ```text
//! W(X) = c cos bX + d sin bX + g (e^(−bX) + s e^(−b(1−X))),    ω = (b/L)² √(EI/ρA)
//! ```
//!
//! Both exponentials decay inward from their own end, so nothing cancels and nothing overflows,
//! at any mode number; the textbook `sinh + sin + α (cosh + cos)` loses every digit near `n = 12`.
//! Shapes are scaled to `∫₀¹ W² dX = 1`; a free end then moves by exactly 2.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// How the two ends are held, the one at `X = 0` first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Both free.
    FreeFree,
    /// Clamped, then free: a cantilever.
    ClampedFree,
    /// Both clamped.
    ClampedClamped,
    /// Both pinned.
    PinnedPinned,
    /// Clamped, then pinned.
    ClampedPinned,
    /// Free, then pinned.
    FreePinned,
}

/// The `n`-th positive root `b = βL` of the frequency equation, `n` from 1.
///
/// ```text
/// free–free, clamped–clamped    cos b = +sech b     b = (2n + 1) π/2 + δ
/// clamped–free                  cos b = −sech b     b = (2n − 1) π/2 + δ
/// clamped–pinned, free–pinned   tan b = tanh b      half the root 2n of the first line
/// pinned–pinned                 sin b = 0           b = nπ
/// ```
///
/// The small `δ` is solved for rather than `b`: `δ = asin(±sech b)` is a contraction (by 0.3 at
/// worst), exact to the last bit for any `n`. A beam with a pin is half of a longer beam whose
/// mode is antisymmetric about its middle, hence the third line.
///
/// # Panics
///
/// If `n` is 0: a rigid motion has no root.
pub fn beta_l(ends: Ends, n: usize) -> f64 {
    assert!(n > 0, "bending modes are counted from 1");
    let odd = parity(n);
    let (asymptote, sign) = match ends {
        Ends::FreeFree | Ends::ClampedClamped => ((2 * n + 1) as f64 * FRAC_PI_2, odd),
        Ends::ClampedFree => ((2 * n - 1) as f64 * FRAC_PI_2, odd),
        Ends::ClampedPinned | Ends::FreePinned => return beta_l(Ends::FreeFree, 2 * n) / 2.0,
        Ends::PinnedPinned => return n as f64 * PI,
    };
    let sech = |b: f64| 2.0 * (-b).exp() / (1.0 + (-2.0 * b).exp());
    let mut delta = 0.0;
    for _ in 0..60 {
        delta = (sign * sech(asymptote + delta)).asin();
    }
    asymptote + delta
}

/// Symmetry of mode `n` about the middle: +1 for odd `n`, −1 for even `n`.
fn parity(n: usize) -> f64 {
    if n % 2 == 1 { 1.0 } else { -1.0 }
}

/// One mode shape of a uniform beam, `∫₀¹ W² dX = 1`.
///
/// With `q = e^(−b)` and `s = ±1` for odd and even modes, a shape is
/// `cos bX − (1 − sq)/(1 + sq) sin bX ± (e^(−bX) + s e^(−b(1−X)))/(1 + sq)`, with `+` for a free
/// and `−` for a clamped end at `X = 0`; pinned ends leave `√2 sin bX`. These follow from two
/// conditions at each end. The far half is computed from its own end, so that a symmetric shape
/// is symmetric to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformMode {
    /// `βL` of this beam.
    pub beta_l: f64,
    order: usize,
    /// Share of the parent beam that this beam covers: ½ if one end of two is pinned, else 1.
    share: f64,
    cosine: f64,
    sine: f64,
    ends_near: f64,
    /// Seen from the far end: the sign of the shape, and the factor of the exponentials.
    far: (f64, f64),
}

impl UniformMode {
    /// Bending mode `n` (from 1) of a beam held as `ends` says.
    ///
    /// # Panics
    ///
    /// If `n` is 0.
    pub fn new(ends: Ends, n: usize) -> Self {
        let beta_l = beta_l(ends, n);
        let (share, order) = match ends {
            Ends::ClampedPinned | Ends::FreePinned => (0.5, 2 * n),
            _ => (1.0, n),
        };
        let s = parity(order);
        let tail = s * (-beta_l / share).exp();
        let (cosine, sine, size) = match ends {
            Ends::PinnedPinned => (0.0, SQRT_2, 0.0),
            _ => (1.0, -(1.0 - tail) / (1.0 + tail), 1.0 / (1.0 + tail)),
        };
        let free = matches!(ends, Ends::FreeFree | Ends::FreePinned);
        let ends_near = if free { size } else { -size };
        let far = if ends == Ends::ClampedFree { (-s, size) } else { (s, ends_near) };
        Self { beta_l, order, share, cosine, sine, ends_near, far }
    }

    /// `W` at `x` in [0, 1].
    pub fn deflection(&self, x: f64) -> f64 {
        self.derivative(x, 0)
    }

    /// `dW/dX` at `x` in [0, 1]; divide by `L` for the slope per metre.
    pub fn slope(&self, x: f64) -> f64 {
        self.derivative(x, 1)
    }

    /// `d²W/dX²` at `x` in [0, 1]; divide by `L²` for the curvature per metre squared.
    pub fn curvature(&self, x: f64) -> f64 {
        self.derivative(x, 2)
    }

    fn derivative(&self, x: f64, order: i32) -> f64 {
        let flip = if order % 2 == 1 { -1.0 } else { 1.0 };
        let near = x * self.share;
        let (y, sign, ends) = if near > 0.5 {
            (1.0 - near, self.far.0 * flip, self.far.1)
        } else {
            (near, 1.0, self.ends_near)
        };
        let b = self.beta_l / self.share;
        let (sin, cos) = (b * y).sin_cos();
        let (sin, cos) = match order {
            0 => (sin, cos),
            1 => (cos, -sin),
            _ => (-sin, -cos),
        };
        let tails = flip * (-b * y).exp() + parity(self.order) * (-b * (1.0 - y)).exp();
        sign * self.beta_l.powi(order) * (self.cosine * cos + self.sine * sin + ends * tails)
    }

    /// The interior zeros of `W`, rising, each to a few units in the last place.
    pub fn nodes(&self) -> Vec<f64> {
        // Ten samples per half wave; an odd number, so that none falls on the middle.
        let looks = 10 * (self.order + 2) + 1;
        let at = |i: usize| i as f64 / looks as f64;
        (1..looks - 1)
            .filter(|&i| self.deflection(at(i)) * self.deflection(at(i + 1)) < 0.0)
            .map(|i| bisect(|x| self.deflection(x), at(i), at(i + 1)))
            .collect()
    }

    /// The largest `|W|` on the beam: 2 where an end is free, the first antinode otherwise.
    pub fn largest(&self) -> f64 {
        let ends = self.deflection(0.0).abs().max(self.deflection(1.0).abs());
        if ends > 1.0 {
            return ends;
        }
        // If both ends are held, the antinode nearest the clamp, before the first node, is the highest.
        let until = self.nodes().first().copied().unwrap_or(0.99);
        self.deflection(bisect(|x| self.slope(x), 0.01 * until, until)).abs()
    }
}

/// A zero of `f` between two points where its signs differ, as far as f64 can tell.
fn bisect(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = f(high) > 0.0;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if (f(middle) > 0.0) == rising { high = middle } else { low = middle }
    }
}

/// A solid round bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dowel {
    /// Length (m).
    pub length: f64,
    /// Radius (m).
    pub radius: f64,
    /// Young's modulus (Pa).
    pub youngs_modulus: f64,
    /// Density (kg/m³).
    pub density: f64,
}

impl Dowel {
    /// `ρ π r² L` (kg).
    pub fn mass(&self) -> f64 {
        self.density * PI * self.radius.powi(2) * self.length
    }

    /// `M L²/12` (kg m²) about the middle: a line mass, as Euler–Bernoulli's theory sees it.
    pub fn inertia(&self) -> f64 {
        self.mass() * self.length.powi(2) / 12.0
    }

    /// `ω = (βL/L)² √(EI/ρA)` (rad/s), with `I/A = r²/4`.
    pub fn omega(&self, ends: Ends, n: usize) -> f64 {
        let wave_speed = (self.youngs_modulus / self.density).sqrt();
        (beta_l(ends, n) / self.length).powi(2) * wave_speed * self.radius / 2.0
    }

    /// `ω/2π` (Hz).
    pub fn frequency(&self, ends: Ends, n: usize) -> f64 {
        self.omega(ends, n) / (2.0 * PI)
    }

    /// `∫ρA φ² dx` (kg) of the mode scaled to largest `|φ| = 1`: a quarter of the mass if an
    /// end is free.
    pub fn modal_mass(&self, ends: Ends, n: usize) -> f64 {
        self.mass() / UniformMode::new(ends, n).largest().powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Ends::*;

    /// Roots of the frequency equations, computed with 30 digits.
    #[test]
    fn roots_are_the_known_ones() {
        let known = [
            (FreeFree, 1, 4.730_040_744_862_704),
            (FreeFree, 2, 7.853_204_624_095_838),
            (FreeFree, 3, 10.995_607_838_001_671),
            (FreeFree, 4, 14.137_165_491_257_464),
            (FreeFree, 5, 17.278_759_657_399_48),
            (ClampedClamped, 1, 4.730_040_744_862_704),
            (ClampedFree, 1, 1.875_104_068_711_961),
            (ClampedFree, 2, 4.694_091_132_974_175),
            (ClampedFree, 3, 7.854_757_438_237_613),
            (ClampedPinned, 1, 3.926_602_312_047_919),
            (FreePinned, 2, 7.068_582_745_628_732),
            (PinnedPinned, 3, 9.424_777_960_769_38),
        ];
        for (ends, n, root) in known {
            let error = beta_l(ends, n) / root - 1.0;
            assert!(error.abs() < 4e-16, "{ends:?} {n}: {error:e}");
        }
    }

    /// The dowel of the WPI report with its density in consistent units: 33 in, radius 0.83885 in, 2.02e6 psi, 0.0257
    /// lb/in³.
    #[test]
    fn the_report_s_dowel_rings_at_239_hz() {
        let (inch, pound) = (0.0254, 0.453_592_37);
        let dowel = Dowel {
            length: 33.0 * inch,
            radius: 0.83885 * inch,
            youngs_modulus: 2.02e6 * pound * 9.806_65 / (inch * inch),
            density: 0.0257 * pound / (inch * inch * inch),
        };
        let ounces = dowel.mass() / pound * 16.0;
        assert!((ounces - 29.997_532_759_892_77).abs() < 1e-13);
        let known = [238.907_031_026_809_53, 658.556_430_642_325_6, 1_291.033_917_466_125];
        for (n, f) in known.into_iter().enumerate() {
            assert!((dowel.frequency(FreeFree, n + 1) / f - 1.0).abs() < 1e-14, "mode {}", n + 1);
        }
        assert!((dowel.modal_mass(FreeFree, 7) / dowel.mass() - 0.25).abs() < 1e-14);
        assert!((dowel.inertia() - 0.049_790_4).abs() < 1e-7);
    }
}
