//! The outer surface of a barrel as a cylinder of points, and how its hoop modes move it.

use std::f64::consts::TAU;

use crate::exchange::solid::Grid;
use sweetspot::Bat;
use sweetspot::modes::hoop::{Hoop, HoopMode, Outline};

/// Rings of points on a barrel.
#[derive(Debug, Clone, PartialEq)]
pub struct BarrelGrid {
    /// The points, ring by ring from the handle to the tip; the first point of a ring lies in the direction of +y.
    pub grid: Grid,
    /// Places of the rings (m).
    pub x: Vec<f64>,
    /// Outer radius of the rings (m).
    pub radius: Vec<f64>,
    /// Points of a ring.
    pub around: usize,
    /// Every mode.
    pub modes: Vec<MovedBarrel>,
}

/// A hoop mode at these points. Each mode has a twin at the same frequency, rotated about the axis of the bat by a
/// quarter of a wave. Of the two, this is the one that moves most in the plane of x and y.
#[derive(Debug, Clone, PartialEq)]
pub struct MovedBarrel {
    /// The mode.
    pub mode: HoopMode,
    /// Modal mass (kg), the largest motion across the surface being 1.
    pub modal_mass: f64,
    /// How it moves every point, the largest motion across the surface being 1.
    pub motion: Vec<[f64; 3]>,
}

impl BarrelGrid {
    /// The stretch of a bat that its hoop modes cover, at `places` places with `around` points around each.
    pub fn of(bat: &Bat, hoop: &Hoop, places: usize, around: usize) -> Self {
        let (from, to) = (hoop.from(), hoop.to());
        let ring = |k: usize| from + (to - from) * k as f64 / (places.max(2) - 1) as f64;
        let x: Vec<f64> = (0..places).map(ring).collect();
        let radius: Vec<f64> = x.iter().map(|x| bat.profile().at(*x).outer).collect();
        let modes = hoop.modes().iter().enumerate().map(|(k, mode)| MovedBarrel {
            mode: mode.clone(),
            modal_mass: hoop.modal_mass(k),
            motion: moved(mode.harmonic, &hoop.outline(k, places), around),
        });
        Self { grid: Grid::tube(&x, &radius, around), modes: modes.collect(), x, radius, around }
    }
}

/// The motion of every point of the rings.
///
/// With `u_r = U cos nθ`, `u_θ = V sin nθ`, `u_x = W cos nθ` and θ from y towards z:
///
/// ```text
/// x: u_x     y: u_r cos θ − u_θ sin θ     z: u_r sin θ + u_θ cos θ
/// ```
fn moved(harmonic: usize, outline: &Outline, around: usize) -> Vec<[f64; 3]> {
    let rings = outline.radial.iter().zip(&outline.around).zip(&outline.along);
    let ring = |((radial, tangential), along): ((&f64, &f64), &f64)| {
        let at = move |k: usize| {
            let theta = TAU * k as f64 / around as f64;
            let (sin_n, cos_n) = (harmonic as f64 * theta).sin_cos();
            let (sine, cosine) = theta.sin_cos();
            let [out, turn] = [radial * cos_n, tangential * sin_n];
            [along * cos_n, out * cosine - turn * sine, out * sine + turn * cosine]
        };
        (0..around).map(at).collect::<Vec<_>>()
    };
    rings.flat_map(ring).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sideways shift has one wave around: `U = 1`, `V = −1`.
    #[test]
    fn a_harmonic_of_one_wave_is_a_shift_of_the_whole_ring() {
        let outline =
            Outline { x_m: vec![0.0], radial: vec![1.0], around: vec![-1.0], along: vec![0.0] };
        for motion in moved(1, &outline, 12) {
            let off = [motion[0], motion[1] - 1.0, motion[2]];
            assert!(off.iter().all(|by| by.abs() < 1e-15), "{motion:?}");
        }
    }

    /// `U = 1`, `V = −½` of two waves stretch no fibre of the circle: the first order of its length is 0.
    #[test]
    fn an_oval_ring_keeps_its_length_to_first_order() {
        let around = 360;
        let outline =
            Outline { x_m: vec![0.0], radial: vec![1.0], around: vec![-0.5], along: vec![0.0] };
        let motion = moved(2, &outline, around);
        let length = |by: f64| -> f64 {
            let at = |k: usize| {
                let theta = TAU * (k % around) as f64 / around as f64;
                let [_, y, z] = motion[k % around];
                [theta.cos() + by * y, theta.sin() + by * z]
            };
            (0..around)
                .map(|k| {
                    let [[a, b], [c, d]] = [at(k), at(k + 1)];
                    (c - a).hypot(d - b)
                })
                .sum()
        };
        let change = (length(1e-4) - length(-1e-4)) / 2e-4;
        assert!(change.abs() < 1e-3, "{change}");
        // Reduced in radius by 1, a circle without motion around would be 2π shorter.
        assert!((moved(0, &outline, 4)[0][1] - 1.0).abs() < 1e-15);
    }
}
