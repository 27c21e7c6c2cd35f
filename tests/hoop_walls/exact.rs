//! Three-dimensional elasticity of layered tubes, exact except for the rounding of a quadrature in r.
//!
//! With `u_r = U cos nθ sin kx`, `u_θ = V sin nθ sin kx`, `u_x = W cos nθ cos kx` the equations of motion are six
//! equations of first order in r for U, V, W and the stresses rr, rθ, xr, all of which are continuous across layers:
//!
//! ```text
//! U′ = (S − c_rθ e_θ − c_rx e_x)/c_rr,   V′ = T/G_rθ + (V + nU)/r,   W′ = Q/G_xr − kU
//! S′ = (s_θ − S − nT)/r + kQ − ρω²U
//! T′ = (n s_θ − 2T)/r + k t − ρω²V,      Q′ = −(Q + n t)/r − k s_x − ρω²W
//! e_θ = (U + nV)/r,   e_x = −kW,   t = G_xθ (kV − nW/r),   s_θ and s_x from the strains
//! ```
//!
//! At a frequency, a combination of the three motions with a stress-free bore also has a stress-free surface.

use std::f64::consts::TAU;

use sweetspot::beam::wall::elastic::Elastic;

/// A tube between diaphragms, or with `wave` 0 a ring in plane strain.
pub struct Ring {
    /// Material and thickness (m) of the layers, from the inside out.
    pub layers: Vec<(Elastic, f64)>,
    /// Radius of the bore (m).
    pub inner: f64,
    /// The harmonic.
    pub n: usize,
    /// Wave number along the tube, mπ/L (1/m).
    pub wave: f64,
}

/// Steps of Runge's and Kutta's rule through a layer.
const STEPS: usize = 300;

impl Ring {
    /// The derivatives of the six quantities with respect to r.
    fn slopes(&self, of: &Elastic, omega: f64, r: f64, [u, v, w, s, t, q]: [f64; 6]) -> [f64; 6] {
        let (n, k) = (self.n as f64, self.wave);
        let [[c_rr, c_rt, c_rx], [_, c_tt, c_tx], [.., c_xx]] = of.normal;
        let (e_t, e_x) = ((u + n * v) / r, -k * w);
        let e_r = (s - c_rt * e_t - c_rx * e_x) / c_rr;
        let s_t = c_rt * e_r + c_tt * e_t + c_tx * e_x;
        let s_x = c_rx * e_r + c_tx * e_t + c_xx * e_x;
        let shear = of.shear_xt * (k * v - n * w / r);
        let inertia = of.density * omega * omega;
        [
            e_r,
            t / of.shear_rt + (v + n * u) / r,
            q / of.shear_xr - k * u,
            (s_t - s - n * t) / r + k * q - inertia * u,
            (n * s_t - 2.0 * t) / r + k * shear - inertia * v,
            -(q + n * shear) / r - k * s_x - inertia * w,
        ]
    }

    /// Determinant of the loads at the surface of three motions without load at the bore.
    fn determinant(&self, omega: f64) -> f64 {
        // In plane strain W is independent of the others.
        let motions = if self.wave == 0.0 { 2 } else { 3 };
        let mut loads = [[0.0; 3], [0.0; 3], [0.0, 0.0, 1.0]];
        for (k, loads) in loads.iter_mut().enumerate().take(motions) {
            let mut y = [0.0; 6];
            y[k] = 1.0;
            let mut r = self.inner;
            for (of, thickness) in &self.layers {
                let h = thickness / STEPS as f64;
                for _ in 0..STEPS {
                    let at = |y: [f64; 6], d: [f64; 6], share: f64| -> [f64; 6] {
                        std::array::from_fn(|i| y[i] + share * h * d[i])
                    };
                    let a = self.slopes(of, omega, r, y);
                    let b = self.slopes(of, omega, r + 0.5 * h, at(y, a, 0.5));
                    let c = self.slopes(of, omega, r + 0.5 * h, at(y, b, 0.5));
                    let d = self.slopes(of, omega, r + h, at(y, c, 1.0));
                    y = std::array::from_fn(|i| {
                        y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i])
                    });
                    r += h;
                }
            }
            *loads = [y[3], y[4], if motions == 3 { y[5] } else { 0.0 }];
        }
        let [[a, b, c], [d, e, f], [g, h, i]] = loads;
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    }
}

/// The frequency (Hz) of the ring nearest to the given one, by secants.
pub fn roots_near(ring: &Ring, frequency: f64) -> f64 {
    let value = |f: f64| ring.determinant(TAU * f);
    let (mut a, mut b) = (frequency * (1.0 - 1e-5), frequency * (1.0 + 1e-5));
    let (mut at_a, mut at_b) = (value(a), value(b));
    for _ in 0..12 {
        if at_b == at_a {
            break;
        }
        let next = b - at_b * (b - a) / (at_b - at_a);
        (a, at_a) = (b, at_b);
        (b, at_b) = (next, value(next));
        if (b / a - 1.0).abs() < 1e-15 {
            break;
        }
    }
    b
}
