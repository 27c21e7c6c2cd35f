//! The damped string of `examples/struck_string.rs`: modes against travelling fronts.

#[path = "../examples/struck_string.rs"]
mod example;

use example::{Blow, DampedString, example};

/// Places and times (in lengths, and periods of `2l/v`) at least 0.04 l from every front.
const CALM: [(f64, f64); 6] =
    [(0.6, 0.11), (0.6, 0.31), (0.35, 0.2), (0.9, 0.52), (0.6, 1.31), (0.1, 2.6)];

/// A string whose first mode has the damping ratio `first`.
fn damped(first: f64) -> DampedString {
    let mut string = example();
    string.damping *= first / string.mode(1).damping_ratio;
    string
}

/// A first mode that oscillates, one that is critically damped, and one that is overdamped while the higher ones
/// oscillate.
#[test]
fn the_sum_of_modes_is_the_pair_of_damped_fronts() {
    for ratio in [0.0, 0.1, 0.7, 1.0, 1.5] {
        let string = damped(ratio);
        let period = 2.0 * string.length / string.wave_speed();
        let unit = 0.5 / (string.line_mass * string.wave_speed());
        for (x, t) in CALM {
            let (x, t) = (x * string.length, t * period);
            let blow = Blow { at: string.length / 4.0, impulse: 1.0 };
            let sum = string.by_modes(4000, blow, x, t, true);
            let error = (sum - string.by_fronts(blow, x, t)) / unit;
            // The fading factor exp(−36 (n/N)⁸) leaves ripples of wavelength l/N, which vanish within 0.04 l of a
            // front.
            assert!(error.abs() < 1e-9, "{ratio} {x} {t}: {error:e}");
        }
    }
}

#[test]
fn a_sharply_cut_sum_misses_by_one_over_the_number_of_modes() {
    let string = damped(0.1);
    let period = 2.0 * string.length / string.wave_speed();
    let unit = 0.5 / (string.line_mass * string.wave_speed());
    for count in [100, 1000, 10_000] {
        for (x, t) in CALM {
            let (x, t) = (x * string.length, t * period);
            let blow = Blow { at: string.length / 4.0, impulse: 1.0 };
            let sum = string.by_modes(count, blow, x, t, false);
            let error = (sum - string.by_fronts(blow, x, t)) / unit;
            assert!(error.abs() * (count as f64) < 10.0, "{count} {x} {t}: {error:e}");
        }
    }
}

/// The first terms of `Σ 2J/(ρ l ω_d) sin(nπa/l) sin(nπx/l) e^(−bt) sin ω_d t`, added up as written.
#[test]
fn a_few_modes_are_the_first_terms_of_the_series() {
    let string = example();
    let blow = Blow { at: string.length / 4.0, impulse: 0.01 };
    let b = string.damping / (2.0 * string.line_mass);
    let wave = std::f64::consts::PI / string.length;
    for (count, x, t) in [(1, 0.6, 0.002), (25, 0.6, 0.002), (25, 0.35, 0.005), (25, 0.9, 0.011)] {
        let x = x * string.length;
        let mut sum = 0.0;
        for n in 1..=count {
            let k = f64::from(n) * wave;
            let swing = (k * k * string.tension / string.line_mass - b * b).sqrt();
            let place = (k * blow.at).sin() * (k * x).sin();
            let scale = 2.0 * blow.impulse / (string.line_mass * string.length * swing);
            sum += scale * place * (-b * t).exp() * (swing * t).sin();
        }
        let ours = string.by_modes(count as usize, blow, x, t, false);
        // Round-off: 25 terms of at most 1e-2 m.
        assert!((ours - sum).abs() < 1e-16 * 25.0, "{x} {t}: {ours:e} {sum:e}");
    }
}

#[test]
fn the_damping_ratio_falls_as_the_frequency_rises() {
    let string = damped(0.1);
    for n in 1..=10 {
        assert!((string.mode(n).damping_ratio * n as f64 - 0.1).abs() < 1e-15);
    }
}

#[test]
fn the_example_runs_and_finds_itself_right() {
    example::main();
}
