//! How often do the 95 % intervals of `sweetspot calibrate` contain the truth? Woods are drawn from the prior of the
//! readings and read with the stated errors. The first seed is used.

use sweetspot::Bat;
use sweetspot_study::calibrate::calibration::{Calibration, CalibrationPlan, Property};
use sweetspot_study::calibrate::readings::{
    BatReadings, Pendulum, Priors, Reading, ShearPrior, SpectralLine,
};
use sweetspot_study::calibrate::unknowns::{Logs, UNKNOWNS, covariance};
use sweetspot_study::calibrate::wood::WoodenBat;

const R161: &str = include_str!("../meshes/r161.json");
const PIVOT: f64 = 0.1524;

/// Normal numbers by Box and Muller from the counter of Steele, Lea and Flood (SplitMix64, OOPSLA 2014).
struct Drawn(u64);

impl Drawn {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }

    /// Normal numbers of that covariance, by its Cholesky factor.
    fn together(&mut self, covariance: &[Vec<f64>]) -> Logs {
        let count = covariance.len();
        let mut factor = vec![vec![0.0; count]; count];
        for i in 0..count {
            for j in 0..=i {
                let sum: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
                let rest: f64 = covariance[i][j] - sum;
                factor[i][j] = if i == j { rest.sqrt() } else { rest / factor[j][j] };
            }
        }
        let normal: Vec<f64> = (0..count).map(|_| self.normal()).collect();
        let mut logs = [0.0; UNKNOWNS];
        for i in 0..count {
            logs[i] = (0..=i).map(|j| factor[i][j] * normal[j]).sum();
        }
        logs
    }
}

/// The readings taken of every bat.
#[derive(Debug, Clone, Copy)]
struct Kind {
    name: &'static str,
    lines: usize,
    mass: bool,
    pendulum: bool,
    split: Option<f64>,
    shear: ShearPrior,
}

const USUAL: Kind = Kind {
    name: "mass and 1 line",
    lines: 1,
    mass: true,
    pendulum: false,
    split: None,
    shear: ShearPrior::OverYoung(0.35),
};

const KINDS: [Kind; 11] = [
    USUAL,
    Kind { name: "mass and 2 lines", lines: 2, ..USUAL },
    Kind { name: "mass and 3 lines", lines: 3, ..USUAL },
    Kind { name: "mass and 4 lines", lines: 4, ..USUAL },
    Kind { name: "mass and 5 lines", lines: 5, ..USUAL },
    Kind { name: "mass and 6 lines", lines: 6, ..USUAL },
    Kind { name: "1 line", mass: false, ..USUAL },
    Kind { name: "3 lines", lines: 3, mass: false, ..USUAL },
    Kind { name: "mass, pendulum, 2 lines", lines: 2, pendulum: true, ..USUAL },
    Kind {
        name: "mass and 2 lines, G by itself",
        lines: 2,
        shear: ShearPrior::Alone(0.35),
        ..USUAL
    },
    Kind {
        name: "two regions: mass, balance point, pendulum, 3 lines",
        lines: 3,
        pendulum: true,
        split: Some(0.42),
        ..USUAL
    },
];

/// Reads a bat of that wood.
fn read(kind: &Kind, wood: &WoodenBat, logs: &Logs, drawn: &mut Drawn) -> BatReadings {
    let shown = wood.shown(logs, kind.lines).unwrap();
    let mut off = |value: f64, deviation: f64| Reading {
        value: value + deviation * drawn.normal(),
        deviation,
    };
    let priors = Priors { shear: kind.shear, ..Priors::default() };
    let mut readings = BatReadings { priors, ..BatReadings::default() };
    if kind.mass {
        readings.mass = Some(off(shown.mass.value, 1e-3));
    }
    if kind.pendulum {
        readings.balance_point = Some(off(shown.balance_point.value, 1e-3));
        readings.pendulum = Some(Pendulum { pivot: PIVOT, period: off(shown.period.value, 1e-3) });
    }
    for (k, tone) in shown.frequencies.iter().take(kind.lines).enumerate() {
        let of_beam = off(tone.value, readings.model * tone.value).value;
        let frequency = off(of_beam, 0.5);
        readings.lines.push(SpectralLine { frequency, mode: Some(k + 1) });
    }
    readings
}

/// The number of intervals of each property that contain the truth.
fn held(kind: &Kind, trials: u64, seed: u64) -> Vec<(Property, usize)> {
    let bat = Bat::from_text("r161.json", R161, "".as_ref()).unwrap();
    let wood = WoodenBat::new(&bat, kind.split, PIVOT).unwrap();
    let priors = Priors { shear: kind.shear, ..Priors::default() };
    let before = covariance(&priors, wood.regions());
    let plan = CalibrationPlan { split: kind.split, held: vec![] };
    let own = wood.materials(&[0.0; UNKNOWNS])[0].clone();
    let mut all: Vec<(Property, usize)> =
        Property::of(wood.regions()).iter().map(|property| (*property, 0)).collect();
    for trial in 0..trials {
        let mut drawn = Drawn(seed.wrapping_mul(1_000_003).wrapping_add(trial << 20));
        let logs = drawn.together(&before);
        let readings = read(kind, &wood, &logs, &mut drawn);
        let found = Calibration::new(&bat, readings, &plan).unwrap();
        let [e, shear, density, barrel, ratio] = logs.map(f64::exp);
        for ((property, inside), one) in all.iter_mut().zip(&found.parameters) {
            let truth = match property {
                Property::YoungsModulus => own.youngs_modulus * e,
                Property::ShearModulus => own.shear_modulus.unwrap() * e * shear,
                Property::Density => own.density * density,
                Property::BarrelDensity => own.density * barrel,
                _ => ratio,
            };
            let [low, high] = one.interval95;
            *inside += usize::from(low <= truth && truth <= high);
        }
    }
    all
}

/// The variable `SWEETSPOT_TRIALS` sets the number of trials of each kind, by default 40. For 1,000 trials 93 to 97 %
/// are three standard deviations about 95 %.
#[test]
fn of_a_hundred_intervals_ninety_five_hold_the_truth() {
    let trials = std::env::var("SWEETSPOT_TRIALS").ok().and_then(|count| count.parse().ok());
    let trials: usize = trials.unwrap_or(40);
    let chance = 3.0 * (0.95 * 0.05 / trials as f64).sqrt();
    let threads: Vec<_> = KINDS
        .into_iter()
        .enumerate()
        .map(|(k, kind)| {
            std::thread::spawn(move || (kind, held(&kind, trials as u64, 1 + k as u64)))
        })
        .collect();
    let mut wrong = vec![];
    for thread in threads {
        let (kind, all) = thread.join().unwrap();
        for (property, inside) in all {
            let share = inside as f64 / trials as f64;
            println!("{:52} {:22} {:.1} %", kind.name, property.name(), 100.0 * share);
            if (share - 0.95).abs() > chance {
                wrong.push((kind.name, property.name(), share));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
