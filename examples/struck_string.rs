//! How does a damped string move when it is struck at a quarter of its length?
//!
//! The worked example of the WPI report, chapter 3 (Eqs 3-1 to 3-8), with the code that computes the vibration of bats:
//! a string of length `l`, tension `T`, line mass `ρ`, with damping `c` per length, at rest until an impulse `J` at `a
//! = l/4`.
//!
//! ```text
//! ρ ÿ + c ẏ = T y″                       φ_n = sin(nπx/l),  m_n = ρl/2
//! y(x, t) = Σ φ_n(x) J φ_n(a) h_n(t)     ω_n = (nπ/l) √(T/ρ),  ζ_n = c/(2 ρ ω_n)
//! ```
//!
//! The report prints `ζ = (c/2) m ω` and later `c/2`; `c/(2 m ω_n)` is the right one. The sum has a
//! closed form, two damped fronts that run to both ends and are reflected with the opposite sign, and the program
//! compares its results with it.

#[path = "wpi_report/sums.rs"]
mod sums;

use std::f64::consts::PI;
use sums::{partial_sums, struck};
use sweetspot::motion::oscillator::Oscillator;

/// A string between two fixed ends; SI units.
pub struct DampedString {
    pub length: f64,
    pub tension: f64,
    pub line_mass: f64,
    /// `c`, force per length and velocity (N s/m²).
    pub damping: f64,
}

/// An impulse (N s) at a place, at t = 0.
#[derive(Clone, Copy)]
pub struct Blow {
    pub at: f64,
    pub impulse: f64,
}

impl DampedString {
    pub fn wave_speed(&self) -> f64 {
        (self.tension / self.line_mass).sqrt()
    }

    /// The motion of mode `n`, counted from 1. Its modal damping is `c l/2`, just as its modal mass is `ρ l/2`.
    pub fn mode(&self, n: usize) -> Oscillator {
        let omega = n as f64 * PI / self.length * self.wave_speed();
        let damping_ratio = self.damping / (2.0 * self.line_mass * omega);
        Oscillator { omega, damping_ratio, mass: self.line_mass * self.length / 2.0 }
    }

    fn shape(&self, n: usize, x: f64) -> f64 {
        (n as f64 * PI * x / self.length).sin()
    }

    /// `y(x, t)` by the first `count` modes.
    ///
    /// `smoothed` fades the last terms out by `e^(−36 (n/count)⁸)`: the string's shape has jumps,
    /// and a sum cut off sharply is wrong by `1/count` everywhere, not just at the jumps.
    pub fn by_modes(&self, count: usize, blow: Blow, x: f64, t: f64, smoothed: bool) -> f64 {
        let orders = || 1..=count;
        let modes: Vec<_> = orders().map(|n| self.mode(n)).collect();
        let at_a: Vec<_> = orders().map(|n| self.shape(n, blow.at)).collect();
        let fade = |n: usize| if smoothed { fade(n, count) } else { 1.0 };
        let at_x: Vec<_> = orders().map(|n| vec![fade(n) * self.shape(n, x)]).collect();
        let sums = partial_sums(&at_x, &struck(&modes, &at_a, blow.impulse, t));
        sums.last().map_or(0.0, |sum| sum[0])
    }

    /// `y(x, t)` in closed form.
    ///
    /// On an endless string `y = J/(2ρv) e^(−bt) I₀(b √(t² − d²/v²))` within the distance `d < vt`
    /// of the blow and 0 beyond, `b = c/2ρ`, `v = √(T/ρ)`. Fixed ends add mirror images with the
    /// opposite sign.
    pub fn by_fronts(&self, blow: Blow, x: f64, t: f64) -> f64 {
        let (v, b) = (self.wave_speed(), self.damping / (2.0 * self.line_mass));
        let endless = |source: f64| {
            let square = t * t - ((x - source) / v).powi(2);
            if square > 0.0 { bessel_i0(b * square.sqrt()) } else { 0.0 }
        };
        let reach = (v * t / (2.0 * self.length)).ceil() as i32 + 1;
        let images = -reach..=reach;
        let period = |k: i32| 2.0 * f64::from(k) * self.length;
        let sum: f64 =
            images.map(|k| endless(period(k) + blow.at) - endless(period(k) - blow.at)).sum();
        blow.impulse / (2.0 * self.line_mass * v) * (-b * t).exp() * sum
    }
}

fn fade(n: usize, count: usize) -> f64 {
    (-36.0 * (n as f64 / count as f64).powi(8)).exp()
}

/// `I₀(x) = Σ (x²/4)^k/(k!)²`: all terms positive, so the plain series is exact enough.
fn bessel_i0(x: f64) -> f64 {
    let (mut term, mut sum, mut k) = (1.0, 1.0, 1.0);
    while term > 1e-17 * sum {
        term *= x * x / (4.0 * k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

/// The low string of a guitar, damped so that its first mode loses nearly half of its amplitude in a period.
pub fn example() -> DampedString {
    let (length, tension, line_mass) = (0.65, 80.0, 6.8e-3);
    let undamped = DampedString { length, tension, line_mass, damping: 0.0 };
    DampedString { damping: 2.0 * line_mass * 0.1 * undamped.mode(1).omega, ..undamped }
}

pub fn main() {
    let string = example();
    let blow = Blow { at: string.length / 4.0, impulse: 0.01 };
    let x = 0.6 * string.length;
    let period = 2.0 * string.length / string.wave_speed();
    println!("String struck at l/4, displacement at 0.6 l in mm (period {:.3} ms)\n", period * 1e3);
    println!("   t/period   10 modes  100 modes   smoothed   closed form");
    for step in 1..=10 {
        let t = 0.1 * period * f64::from(step);
        let (few, more) =
            (string.by_modes(10, blow, x, t, false), string.by_modes(100, blow, x, t, false));
        let (smooth, exact) =
            (string.by_modes(1000, blow, x, t, true), string.by_fronts(blow, x, t));
        print!("{:>11.2} {:>10.4} {:>10.4}", t / period, few * 1e3, more * 1e3);
        println!(" {:>10.4} {:>13.4}", smooth * 1e3, exact * 1e3);
        assert!((smooth - exact).abs() < 1e-9, "modes and fronts disagree at {t} s");
    }
}
