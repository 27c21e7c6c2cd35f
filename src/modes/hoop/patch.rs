//! How far does the wall give way under a ball?
//!
//! The ball presses on a patch, with a pressure that is parabolic along the bat and around it. With
//! `P(k) = 3 (sin k − k cos k)/k³` and a resultant F across the bat:
//!
//! ```text
//! share of harmonic n      g_n = P(n a_t/r)/P(a_t/r),  g_0 = 1/P(a_t/r)
//! motion the ball feels    y_n = g_n · mean of U_n(x, r_o) with the weight 1 − (x − x₀)²/a_x²
//! mode (n, m)              c = (g_n Ū)²/M,   y″ + 2ζω y′ + ω² y = −c F
//! all modes of n           C_n = f·K⁻¹f = Σ c/ω²,   D_n = (K⁻¹f)·M(K⁻¹f) = Σ c/ω⁴
//! ```
//!
//! where f is the load for F = 1, the work of that pressure.

/// Where a ball presses on the barrel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Middle of the patch (m from the knob end).
    pub x: f64,
    /// Half its length along the bat, `a_x` (m).
    pub half_length: f64,
    /// Half its width around the bat, `a_t` (m).
    pub half_width: f64,
}

/// The compliance of one harmonic under a patch.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// The harmonic n.
    pub harmonic: usize,
    /// `(g_n Ū)²/M` of each kept mode, in their order (1/kg).
    pub gains: Vec<f64>,
    /// `C_n`: displacement under a static unit force, all modes of the harmonic (m/N).
    pub flexibility: f64,
    /// `D_n = Σ c/ω⁴` over all modes of the harmonic (m s²/N).
    pub slowness: f64,
}

impl Patch {
    /// The patch of a ball compressed by that amount, all lengths in m, as for two elastic bodies in contact:
    /// `a_x = √(R δ)`, `a_t = √(δ R r/(R + r))` for a ball of radius R on a barrel of radius r.
    ///
    /// # Source
    ///
    /// K. L. Johnson, Contact Mechanics (Cambridge 1985), chapter 4: Hertz.
    pub fn under(x: f64, ball_radius: f64, barrel_radius: f64, compression: f64) -> Self {
        let around = ball_radius * barrel_radius / (ball_radius + barrel_radius);
        let half_length = (ball_radius * compression).sqrt();
        Self { x, half_length, half_width: (compression * around).sqrt() }
    }

    /// `g_n` on a barrel of radius `r` (m).
    pub fn share(&self, n: usize, r: f64) -> f64 {
        let k = self.half_width / r;
        parabola(n as f64 * k) / parabola(k)
    }
}

/// `P(k) = 3 (sin k − k cos k)/k³`, the Fourier transform of a parabola of area 1 over [−1, 1].
fn parabola(k: f64) -> f64 {
    if k.abs() < 0.1 {
        // The series, where the difference would lose digits.
        let square = k * k;
        return 1.0 - square / 10.0 * (1.0 - square / 28.0 * (1.0 - square / 54.0));
    }
    3.0 * (k.sin() - k * k.cos()) / k.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_and_the_closed_form_of_the_parabola_agree() {
        let exact = |k: f64| 3.0 * (k.sin() - k * k.cos()) / k.powi(3);
        for k in [0.05, 0.09, 0.0999] {
            assert!((parabola(k) - exact(k)).abs() < 1e-11, "{k}");
        }
        assert_eq!(parabola(0.0), 1.0);
    }

    /// On a barrel of 33.3 mm: the published sizes.
    #[test]
    fn a_patch_is_that_of_hertz() {
        let patch = Patch::under(0.6858, 0.0366, 0.0333, 0.008);
        assert!((patch.half_length - 17.111_399_7e-3).abs() < 1e-10, "{patch:?}");
        assert!((patch.half_width - 11.810_521_5e-3).abs() < 1e-9, "{patch:?}");
    }
}
