//! Are the stated errors of hoop modes correct?
//!
//! [`rows`] solves barrels to several tolerances and compares the stated error of each mode with the true one: against
//! published frequencies (another program with the same elements, compared with exact elasticity), and for random
//! barrels against solutions some hundred times finer. The promise is the first one of beams:
//!
//! ```text
//! true error ≤ 3 × stated error       always
//! ```

use std::f64::consts::TAU;

use crate::promise::ALWAYS;
use sweetspot::base::{Result, Tell, golden, threads};
use sweetspot::bat::{
    Bat, Fixtures, Formula, FormulaPiece, Interpolation, Layup, Material, Profile, Region, Stations,
};
use sweetspot::modes::hoop::{Hoop, HoopRequest};

/// Tolerances at which every barrel is solved.
const TOLERANCES: [f64; 3] = [1e-3, 1e-4, 1e-5];
/// Harmonics and modes of each that are compared.
const HARMONICS: [usize; 2] = [2, 3];
const MODES: usize = 3;
/// Random barrels of the promise.
pub const BARRELS: usize = 20;

/// One hoop mode at one tolerance: the promise and the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedHoop {
    /// Name of the barrel.
    pub barrel: String,
    /// The harmonic and the order of the mode.
    pub mode: [usize; 2],
    /// The requested tolerance.
    pub tolerance: f64,
    /// Whether it is claimed.
    pub met: bool,
    /// The true error, relative.
    pub truth: f64,
    /// The stated error.
    pub stated: f64,
    /// Error of the reference itself.
    pub known_to: f64,
}

impl CheckedHoop {
    /// True error divided by stated error, as far as the truth is known.
    pub fn ratio(&self) -> f64 {
        let off = if self.truth.is_nan() { f64::INFINITY } else { self.truth - self.known_to };
        off.max(0.0) / self.stated
    }

    /// Whether the stated error is true and the claim to meet the tolerance is correct.
    pub fn holds(&self) -> bool {
        self.ratio() <= ALWAYS && !(self.met && self.stated > self.tolerance)
    }
}

/// A barrel with its known frequencies (Hz) for n = 2 and 3 and their possible errors.
struct TestBarrel {
    name: String,
    bat: Bat,
    from: Option<f64>,
    known: Option<(Frequencies, f64)>,
}

/// All published barrels and that number of random ones at all tolerances.
///
/// # Errors
///
/// As [`Hoop::of`].
pub fn rows(tell: Tell, random: usize) -> Result<Vec<CheckedHoop>> {
    tell(0.0, "hoop modes");
    let barrels = barrels(random)?;
    let checked = threads::map(barrels.len(), |k| check(&barrels[k]));
    Ok(checked.into_iter().collect::<Result<Vec<_>>>()?.concat())
}

fn solve(barrel: &TestBarrel, tol: f64) -> Result<Hoop> {
    let harmonics = HARMONICS.to_vec();
    let request = HoopRequest { tol, harmonics, up_to_hz: 1.0, least: MODES, ..Default::default() };
    match barrel.from {
        Some(from) => Hoop::between(&barrel.bat, [from, barrel.bat.length()], &request),
        None => Hoop::of(&barrel.bat, &request),
    }
}

fn check(barrel: &TestBarrel) -> Result<Vec<CheckedHoop>> {
    let (known, known_to) = match barrel.known {
        Some((known, known_to)) => (known.concat(), known_to),
        None => {
            let finer = solve(barrel, 1e-2 * TOLERANCES[2])?;
            let worst = finer.modes().iter().map(|mode| mode.error).fold(0.0, f64::max);
            (finer.modes().iter().map(|mode| mode.frequency_hz).collect(), worst)
        }
    };
    let mut rows = vec![];
    for tolerance in TOLERANCES {
        let hoop = solve(barrel, tolerance)?;
        for (mode, known) in hoop.modes().iter().zip(&known) {
            rows.push(CheckedHoop {
                barrel: barrel.name.clone(),
                mode: [mode.harmonic, mode.order],
                tolerance,
                met: hoop.met(),
                truth: (mode.omega / (TAU * known) - 1.0).abs(),
                stated: mode.error,
                known_to,
            });
        }
    }
    Ok(rows)
}

/// An alloy of bats.
fn aluminium() -> Result<Material> {
    let mut material = Material::new(2810.0, 71e9)?;
    material.poisson_ratio = Some(0.33);
    Ok(material)
}

/// A tube (m).
fn tube(length: f64, radius: f64, thickness: f64) -> Result<Bat> {
    let (outer, inner) = (vec![radius + 0.5 * thickness; 2], vec![radius - 0.5 * thickness; 2]);
    let interpolation = Interpolation::Linear;
    let profile = Profile::new(Stations { x: vec![0.0, length], outer, inner, interpolation })?;
    Bat::builder(profile, aluminium()?).build()
}

/// A made-up baseball bat of formulas, open at its tip, with a wall of 3 mm in the barrel.
fn open_barrel() -> Result<Bat> {
    let formula = |text: &str| Formula::parse(text).map_err(sweetspot::base::error::Error::Value);
    let taper = "0.0115 + 0.0218*(3*((x - 0.28)/0.3)^2 - 2*((x - 0.28)/0.3)^3)";
    let piece = |from, to, outer: &str, inner: &str| -> Result<FormulaPiece> {
        Ok(FormulaPiece { from, to, outer: formula(outer)?, inner: Some(formula(inner)?) })
    };
    let pieces = vec![
        piece(0.0, 0.28, "0.0115", "0.0089")?,
        piece(0.28, 0.58, taper, &format!("{taper} - (0.0026 + 0.0004*(x - 0.28)/0.3)"))?,
        piece(0.58, 0.8382, "0.0333", "0.0303")?,
    ];
    Bat::builder(Profile::from_formulas(pieces)?, aluminium()?).build()
}

/// A bat with its bore filled beyond a place (m), with a material of that modulus (Pa).
fn plugged(bat: &Bat, from: f64, modulus: f64) -> Result<Bat> {
    let mut plug = Material::new(1150.0, modulus)?;
    plug.poisson_ratio = Some(0.40);
    let layup = Layup { core: Some(plug), ..Layup::of(bat.material().clone()) };
    let regions = vec![Region { from, to: bat.length(), layup }];
    bat.with(|parts| parts.fixtures = Fixtures { regions, ..Fixtures::default() })
}

/// Published frequencies (Hz): those of each harmonic.
type Frequencies = [[f64; MODES]; 2];

const FREE_TUBE: Frequencies = [
    [1_451.365_952_02, 1_481.103_529_51, 2_421.683_109_93],
    [4_085.875_031_92, 4_122.894_500_91, 4_386.431_461_54],
];
const THIN_TUBE: Frequencies = [
    [218.584_634_69, 223.487_474_26, 1_822.932_988_87],
    [618.173_945_51, 624.424_590_34, 1_097.619_441_82],
];
const OPEN_BARREL: Frequencies = [
    [1_939.920_069_39, 2_132.837_659_05, 2_810.245_663_24],
    [5_430.375_400_23, 5_553.603_500_06, 5_873.714_604_27],
];
const PLUGGED_BARREL: Frequencies =
    [[2_036.593_97, 2_586.862_61, 3_379.647_15], [5_502.597_34, 5_747.838_06, 6_239.308_72]];

fn barrels(count: usize) -> Result<Vec<TestBarrel>> {
    let named = |name: &str, bat: Bat, from, known| TestBarrel {
        name: name.to_owned(),
        bat,
        from,
        known: Some(known),
    };
    let open = open_barrel()?;
    let plug = plugged(&open, 0.8262, 1e9)?;
    let mut barrels = vec![
        named("free tube", tube(0.25, 0.030, 0.002)?, None, (FREE_TUBE, 2e-9)),
        named("thin free tube", tube(0.25, 0.030, 0.0003)?, None, (THIN_TUBE, 1e-8)),
        named("open barrel", open, Some(0.2), (OPEN_BARREL, 2e-9)),
        named("plugged barrel", plug, Some(0.28), (PLUGGED_BARREL, 2e-7)),
    ];
    for k in 0..count {
        let bat = random(k)?;
        barrels.push(TestBarrel {
            name: format!("random {}", k + 1),
            bat,
            from: None,
            known: None,
        });
    }
    Ok(barrels)
}

/// A random barrel: a handle, a taper and a barrel with walls that differ; every third has straight lines and so
/// kinks, every fourth a step of its wall, every fifth a plug.
fn random(k: usize) -> Result<Bat> {
    let between =
        |j: usize, low: f64, high: f64| low + (high - low) * golden::fraction(97 * k + 13 * j);
    let handle = between(0, 0.010, 0.013);
    let barrel = between(1, 0.026, 0.034);
    let [thin, thick] = [between(2, 0.0012, 0.004), between(3, 0.0015, 0.006)];
    let length = between(4, 0.75, 0.86);
    let (taper, begins) = (between(5, 0.22, 0.32), between(6, 0.50, 0.60));
    let mut x = vec![0.0, taper, 0.5 * (taper + begins), begins];
    let mut outer = vec![handle, handle, between(7, 0.45, 0.55) * (handle + barrel), barrel];
    let mut wall = vec![0.0025, 0.0025, 0.5 * (0.0025 + thin), thin];
    if k % 4 == 3 {
        let step = between(8, 0.64, 0.70);
        x.extend([step, step, length]);
        outer.extend([barrel; 3]);
        wall.extend([thin, thick, thick]);
    } else {
        x.push(length);
        outer.push(between(9, 0.97, 1.0) * barrel);
        wall.push(if k.is_multiple_of(2) { thin } else { thick });
    }
    let inner = outer.iter().zip(&wall).map(|(r, h)| r - h).collect();
    let interpolation = if k % 3 == 2 { Interpolation::Linear } else { Interpolation::Pchip };
    let profile = Profile::new(Stations { x, outer, inner, interpolation })?;
    let bat = Bat::builder(profile, aluminium()?).build()?;
    match k % 5 {
        4 => plugged(&bat, length - between(10, 0.008, 0.02), 1e9 * between(11, 0.05, 3.0)),
        _ => Ok(bat),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_false_statement_breaks_the_promise() {
        let row = |truth, stated| CheckedHoop {
            barrel: "tube".to_owned(),
            mode: [2, 1],
            tolerance: 1e-4,
            met: true,
            truth,
            stated,
            known_to: 1e-9,
        };
        assert!(row(2e-6, 1e-6).holds());
        assert!(!row(4e-6, 1e-6).holds());
        assert!(!row(f64::NAN, 1e-6).holds());
        assert!(!row(1e-6, 2e-4).holds(), "a claim beyond the stated error");
    }
}
