//! Does a pointed end reflect waves?
//!
//! Let the radius fall to 0 as `c tⁿ`, with `t` the distance from the tip. The wave number is proportional to
//! `(ρA/EI)^¼ ∝ t^{−n/2}`, and the time that a wave needs to reach the tip as `∫ t^{−n/2} dt`: for n of 2 and more it
//! never arrives. With n = 2 the beam's equation near the tip, `(t⁸ w″)″ = λ t⁴ w` in scaled units, has the solutions
//! `w = t^{−5/2 ± iτ}` with `λ = (τ² + 25/4)(τ² + 49/4)`. Every frequency above that of `λ = 1225/16` is then possible
//! and none is a mode. With n above 2 that holds from 0 Hz on.
//!
//! # Source
//!
//! Waves never arrive at such a tip: Mironov's beam of 1988, as described in the introduction of "How the waveguide
//! acoustic black hole works", J. Acoust. Soc. Am. 151 (2022) 4279. The powers are derived here.

/// Distance from the tip at which the power is measured, as a share of the piece. Values at this and twice this
/// distance are used, so that a slow change of the power along the piece cancels.
const NEAR: f64 = 1.0 / 4096.0;
/// The power from which no wave returns, less the error of measuring it.
const POWER: f64 = 2.0 - 1e-5;

/// Whether a wave returns from an end with these outer radii (m), given as a function of the share of the end's piece.
pub(crate) fn sends_back(radius: impl Fn(f64) -> f64) -> bool {
    let [a, b, c] = [NEAR, 2.0 * NEAR, 4.0 * NEAR].map(&radius);
    // A bat without any radius is refused elsewhere, for that reason.
    radius(0.0) > 0.0 || radius(0.5) == 0.0 || 2.0 * (b / a).log2() - (c / b).log2() < POWER
}

/// Found and expected texts for an end from which no wave returns.
pub(crate) const NEVER_BACK: [&str; 2] = [
    "a radius that falls to 0 at an end as the square of the distance or faster",
    "an end of some radius, or one that comes to a point as a cone does: no wave ever arrives at the \
     point of such a tip and comes back, so that the bat has no modes",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cones_and_round_ends_send_waves_back_and_squares_do_not() {
        for power in [0.5, 1.0, 1.5, 1.9] {
            assert!(sends_back(|t| 0.03 * t.powf(power)), "{power}");
        }
        for power in [2.0, 2.1, 3.0, 40.0] {
            assert!(!sends_back(|t| 0.03 * t.powf(power)), "{power}");
        }
        assert!(!sends_back(|t| 0.01 * (1.0 - (2.0 * t).cos())));
        assert!(!sends_back(|t| 0.001 * t * t - 0.0001 * t * t * t));
        assert!(!sends_back(|t| if t < 0.01 { 0.0 } else { t }));
        assert!(sends_back(|_| 0.0));
        assert!(sends_back(|t| 1e-9 + 0.03 * t * t));
    }
}
