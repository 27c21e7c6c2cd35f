//! Figures 1 and 16 to 18 of the WPI report: the ball's speed, rigid and with its empirical loss.
//!
//! In the report's units: inch, second, slug. Speeds are divided by the incoming one, 1584 in/s.

use crate::table::{Table, grid};
use crate::vibration::sampled;
use sweetspot::collision::energy_loss::EnergyLoss;
use sweetspot::collision::rigid::{Incoming, RigidBat};

pub const INCOMING: f64 = 1584.0;
pub const OMEGAS: [f64; 3] = [40.0, 50.0, 60.0];
/// The kilograms in a slug.
const SLUG: f64 = 14.593_902_937_206_365;
/// 5 oz in slug; the report's list says 30 oz, its script 0.009712797.
const BALL_MASS: f64 = 5.0 / 16.0 * 0.453_592_37 / SLUG;
/// The joules in one slug in²/s², a unit that mixes slugs with inches.
const JOULE: f64 = SLUG * 0.0254 * 0.0254;
const LENGTH: f64 = 33.0;
/// Distance of the swing's centre beyond the knob.
const PIVOT: f64 = 2.5;

pub fn all() -> Vec<Table> {
    vec![rigid_speeds(), rigid_energies(), mode_sums(), three_speeds(), summary()]
}

/// Exit speed over incoming speed for a stiff uniform rod of six ball masses, struck at `x` (in L).
pub fn rigid(omega: f64, x: f64) -> f64 {
    let bat = RigidBat {
        mass: 6.0 * BALL_MASS,
        balance_point: LENGTH / 2.0,
        inertia: 6.0 * BALL_MASS * LENGTH.powi(2) / 12.0,
    };
    let ball = Incoming { mass: BALL_MASS, velocity: -INCOMING, restitution: 0.5 };
    bat.strike(bat.swung(omega, PIVOT), ball, x * LENGTH).ball_velocity / INCOMING
}

/// `E_v` with the script's constants at every `x`, for the given numbers of modes.
pub fn vibrations(x: &[f64], counts: &[usize]) -> Vec<Vec<f64>> {
    let shapes = sampled(x, counts.iter().copied().max().unwrap_or(0));
    let at = |i: usize| {
        let shape: Vec<f64> = shapes.iter().map(|w| w[i]).collect();
        counts.iter().map(|&n| EnergyLoss::default().vibration(&shape[..n])).collect()
    };
    (0..x.len()).map(at).collect()
}

/// The same ratio as [`rigid`], with the empirical loss `e_v`; NaN where the model has no value.
pub fn with_loss(omega: f64, x: f64, e_v: f64) -> f64 {
    EnergyLoss::exit_velocity(-1.0, rigid(omega, x), e_v).unwrap_or(f64::NAN)
}

fn rigid_curve(omega: f64, x: &[f64]) -> Vec<f64> {
    x.iter().map(|&x| rigid(omega, x)).collect()
}

/// [`with_loss`] of `count` modes at every `x`.
pub fn curve(omega: f64, x: &[f64], count: usize) -> Vec<f64> {
    let losses = vibrations(x, &[count]);
    x.iter().zip(losses).map(|(&x, e_v)| with_loss(omega, x, e_v[0])).collect()
}

/// Figure 1.
pub fn rigid_speeds() -> Table {
    let x = grid(1000);
    let curves = OMEGAS.map(|omega| rigid_curve(omega, &x));
    Table::of_curves("fig01_rigid_speed", "X,omega40,omega50,omega60", &x, &curves)
}

/// Figure 16: the ball's change of kinetic energy, rigid, in slug in²/s², and for 50 rad/s in J.
pub fn rigid_energies() -> Table {
    let change = |omega, x| 0.5 * BALL_MASS * INCOMING.powi(2) * (rigid(omega, x).powi(2) - 1.0);
    let row = |x: f64| {
        let [slow, middle, fast] = OMEGAS.map(|omega| change(omega, x));
        vec![x, slow, middle, fast, middle * JOULE]
    };
    let header = "X,omega40,omega50,omega60,omega50_joule";
    Table::new("fig16_rigid_energy", header, grid(1000).into_iter().map(row).collect())
}

/// Figure 17: no, one, two and ten modes at 50 rad/s.
pub fn mode_sums() -> Table {
    let x = grid(1000);
    let mut curves = vec![rigid_curve(50.0, &x)];
    curves.extend([1, 2, 10].map(|count| curve(50.0, &x, count)));
    Table::of_curves("fig17_mode_sums", "X,rigid,modes1,modes2,modes10", &x, &curves)
}

/// Figure 18: ten modes at three swing speeds.
pub fn three_speeds() -> Table {
    let x = grid(1000);
    let pairs = OMEGAS.map(|omega| [rigid_curve(omega, &x), curve(omega, &x, 10)]);
    let header = "X,rigid40,vib40,rigid50,vib50,rigid60,vib60";
    Table::of_curves("fig18_three_speeds", header, &x, &pairs.concat())
}

pub const COUNTS: [usize; 7] = [1, 2, 5, 10, 20, 50, 100];
const SUMMARY: &str = "omega,modes,X_peak_rigid,v_peak_rigid,X_peak_vib,v_peak_vib,shift_in_L,\
    relative_shift,velocity_drop_peak_to_peak,ball_energy_drop_peak_to_peak,\
    velocity_drop_at_rigid_peak,mean_velocity_drop,drop_of_mean_velocity,drop_of_mean_energy,\
    min_drop,max_drop,no_real_J_up_to";

/// All possible meanings of "shift" and "drop" of figure 18. Means are over `X ≥ 0.135`, the part that the script does
/// not set to zero, on its 10 001 points.
pub fn summary() -> Table {
    let x = grid(10_000);
    let losses = vibrations(&x, &COUNTS);
    let case = |omega: f64, k: usize| {
        let rigid = rigid_curve(omega, &x);
        let with: Vec<_> =
            x.iter().zip(&losses).map(|(&x, e_v)| with_loss(omega, x, e_v[k])).collect();
        let mut row = vec![omega, COUNTS[k] as f64];
        row.extend(peaks(omega, COUNTS[k], x[highest(&with)]));
        row.extend(averages(&rigid, &with));
        row.push(x[with.iter().rposition(|v| v.is_nan()).unwrap_or(0)]);
        row
    };
    let rows = OMEGAS.iter().flat_map(|&omega| (0..COUNTS.len()).map(move |k| (omega, k)));
    Table::new("fig18_summary", SUMMARY, rows.map(|(omega, k)| case(omega, k)).collect())
}

/// Place and height of both peaks, the shift between them and the drop, by several measures.
fn peaks(omega: f64, count: usize, near: f64) -> [f64; 9] {
    let stiff = |x| rigid(omega, x);
    let soft = |x| curve(omega, &[x], count)[0];
    let (x_rigid, x_soft) = (peak(stiff, 0.5, 0.9), peak(soft, near - 1e-4, near + 1e-4));
    let (v_rigid, v_soft) = (stiff(x_rigid), soft(x_soft));
    let (shift, ratio) = (x_soft - x_rigid, v_soft / v_rigid);
    let drop_there = 1.0 - soft(x_rigid) / v_rigid;
    let drops = [1.0 - ratio, 1.0 - ratio * ratio, drop_there];
    let [a, b, c] = drops;
    [x_rigid, v_rigid, x_soft, v_soft, shift, shift / x_rigid, a, b, c]
}

/// Mean local drop, drop of the mean speed and of the mean energy, least and largest drop.
fn averages(rigid: &[f64], with: &[f64]) -> [f64; 5] {
    let pairs = || rigid.iter().zip(with).skip(1350).filter(|(_, v)| !v.is_nan());
    let drops: Vec<_> = pairs().map(|(r, v)| 1.0 - v / r).collect();
    let mean = drops.iter().sum::<f64>() / drops.len() as f64;
    let lost = |power| {
        let soft: f64 = pairs().map(|(_, v)| v.powi(power)).sum();
        1.0 - soft / pairs().map(|(r, _)| r.powi(power)).sum::<f64>()
    };
    let least = drops.iter().copied().fold(f64::INFINITY, f64::min);
    let most = drops.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [mean, lost(1), lost(2), least, most]
}

fn highest(values: &[f64]) -> usize {
    let above = |best: usize, i: usize| if values[i] > values[best] { i } else { best };
    let first = values.iter().position(|v| !v.is_nan()).unwrap_or(0);
    (first..values.len()).fold(first, above)
}

/// Golden-section search for the maximum. A maximum is flat, so its place is accurate only to `√ε`.
fn peak(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    while high - low > 1e-9 {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if f(left) > f(right) { high = right } else { low = left }
    }
    (low + high) / 2.0
}
