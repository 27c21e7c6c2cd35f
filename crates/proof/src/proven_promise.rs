//! Are the stated errors of frequencies correct where every frequency is proven?
//!
//! [`rows`] solves [`BATS`] random-looking bats for tolerances from 1e-2 to 1e-9 and compares the stated error of each
//! frequency with the interval that contains the true one ([`crate::enclosure`]). The true error is then at least the
//! distance to the interval and at most that to its farther end.

use crate::enclosure::guarantee::guarantee;
use crate::promise::ALWAYS;
use sweetspot::base::{Result, Tell};
use sweetspot::bat::{
    Attachment, Bat, Fixtures, Interpolation, Material, Profile, Stations, Theory,
};
use sweetspot::modes::mode::Mode;
use sweetspot::modes::solve::{Request, solve};

/// Number of random bats.
pub const BATS: usize = 200;
/// Number of modes examined of each bat.
const MODES: usize = 6;
/// Intervals are this narrow where arithmetic allows.
const WIDTH: f64 = 1e-11;

/// One bat: the stated errors of its modes, and the proven intervals.
#[derive(Debug, Clone)]
pub struct ProvenBat {
    /// Kind of the bat.
    pub kind: &'static str,
    /// The theory.
    pub theory: Theory,
    /// Wanted relative accuracy.
    pub tolerance: f64,
    /// Modes that are proven.
    pub proven: usize,
    /// Modes whose true error is proven to be within three times the stated one.
    pub held: usize,
    /// Modes whose true error is proven to be beyond it.
    pub broken: usize,
    /// The largest proven lower bound of the ratio of true to stated error.
    pub at_least: f64,
    /// The widest interval as a share of its frequency.
    pub width: f64,
}

/// All rows.
///
/// # Errors
///
/// As [`solve`] and [`guarantee`].
pub fn rows(tell: Tell) -> Result<Vec<ProvenBat>> {
    let mut random = Random(7);
    (0..BATS)
        .map(|k| {
            tell(k as f64 / BATS as f64, "proven bats");
            row(k, &mut random)
        })
        .collect()
}

fn row(k: usize, random: &mut Random) -> Result<ProvenBat> {
    let (kind, bat) = drawn(k, random)?;
    let theory = Theory::ALL[k % Theory::ALL.len()];
    let tolerance = 10f64.powf(-2.0 - 7.0 * random.share());
    let request = Request { modes: MODES, tolerance, theory, ..Request::default() };
    let stated = solve(&bat, &request)?;
    let (_, found) = guarantee(&bat, &Request { tolerance: WIDTH, ..request })?;
    let mut row = ProvenBat {
        kind,
        theory,
        tolerance,
        proven: found.modes.len(),
        held: 0,
        broken: 0,
        at_least: 0.0,
        width: found.modes.iter().map(|mode| mode.eigenvalue.width()).fold(0.0, f64::max),
    };
    for (mode, proven) in stated.modes.iter().zip(&found.modes) {
        let [least, most] = between(mode, proven.hertz);
        let by = mode.error.total();
        row.held += usize::from(most <= ALWAYS * by);
        row.broken += usize::from(least > ALWAYS * by);
        row.at_least = row.at_least.max(least / by);
    }
    Ok(row)
}

/// Bounds of the relative error of a frequency, given that the true one is between these.
fn between(mode: &Mode, [lower, upper]: [f64; 2]) -> [f64; 2] {
    let found = mode.frequency();
    let beside = f64::max(lower / found - 1.0, 1.0 - upper / found).max(0.0);
    [beside, f64::max(found / lower - 1.0, 1.0 - found / upper)]
}

/// Random-looking numbers in [0, 1), the same on every machine.
struct Random(u64);

impl Random {
    fn share(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A bat of four to ten stations: smooth or straight between them, solid or hollow, bare or with a weight on it.
fn drawn(k: usize, random: &mut Random) -> Result<(&'static str, Bat)> {
    const LENGTH: f64 = 0.84;
    let count = 4 + (random.share() * 7.0) as usize;
    let mut x: Vec<f64> = (0..count).map(|k| k as f64 + 0.7 * random.share()).collect();
    let (first, last) = (x[0], x[count - 1]);
    x.iter_mut().for_each(|x| *x = LENGTH * (*x - first) / (last - first));
    (x[0], x[count - 1]) = (0.0, LENGTH);
    let outer: Vec<f64> = (0..count).map(|_| 0.01 * 3.3f64.powf(random.share())).collect();
    let (hollow, smooth) = (k % 4 == 1, k % 5 != 2);
    let bore = 0.3 + 0.5 * random.share();
    let inner = outer.iter().map(|r| if hollow { bore * r } else { 0.0 }).collect();
    let interpolation = if smooth { Interpolation::Pchip } else { Interpolation::Linear };
    let profile = Profile::new(Stations { x, outer, inner, interpolation })?;
    let mut wood = Material::new(500.0 + 400.0 * random.share(), 1e10 * (1.0 + random.share()))?;
    wood.shear_modulus = Some(1e9);
    let mut fixtures = Fixtures::default();
    let weighted = k % 6 == 3;
    if weighted {
        fixtures.attachments.push(Attachment {
            x: LENGTH * random.share(),
            mass: 0.2 * random.share(),
            rotary_inertia: 1e-5,
            offset: 0.01,
            ..Attachment::default()
        });
    }
    let kind = match (hollow, smooth, weighted) {
        (_, _, true) => "with a weight",
        (true, ..) => "hollow",
        (_, true, _) => "smooth",
        _ => "straight",
    };
    Ok((kind, Bat::builder(profile, wood).name(kind).fixtures(fixtures).build()?))
}
