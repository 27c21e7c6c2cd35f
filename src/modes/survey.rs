//! How many waves fit on a piece of the profile, and how much does it taper?
//!
//! [`Survey::of`] samples a bat for [`crate::modes::plan`].

use crate::bat::{Bat, Cubics, Piece, Radii, Section, Theory};

/// A piece is sampled until the radius changes by at most this factor between samples.
const SMOOTH: f64 = 1.35;
/// With this many pieces, each is short compared with the features of a bat.
pub(super) const MANY: usize = 8;
/// A radius below this share of the widest is replaced by that share: a point is not an infinite taper.
const THIN: f64 = 1e-3;

/// One place of a piece.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sample {
    /// Position from 0 to 1 along the piece.
    pub s: f64,
    /// `∫k dx/√ω` from the piece's left end, with the wave number `k` at the angular frequency ω:
    /// for the Euler–Bernoulli beam `∫(ρA/EI)^¼ dx`, whatever ω.
    pub phase: f64,
    /// The taper from the piece's left end; for a straight side `∫|d ln r|`.
    pub taper: f64,
    /// [`Self::taper`] without the third derivative that the curve between two stations adds: for elements that reach
    /// over stations.
    pub smooth: f64,
}

/// The pieces of a profile, sampled from end to end.
#[derive(Debug)]
pub struct Survey {
    samples: Vec<Sample>,
    /// Index after the last sample of each piece.
    ends: Vec<usize>,
    /// The highest frequency considered, as `√ω` (√(rad/s)).
    pub root_omega: f64,
}

/// Quantities for the wave number at a sample with rotary inertia or shear: ρA/EI (s²/m⁴), ρI/EI and ρA/κGA (s²/m²),
/// and the distance from the sample before (m).
#[derive(Debug, Clone, Copy, Default)]
struct Ratios {
    slender: f64,
    turning: f64,
    shear: f64,
    step: f64,
}

impl Ratios {
    /// The squares of both wave numbers (1/m²) at ω²; the second belongs to a wave only if it is positive.
    ///
    /// ```text
    /// k⁴ − ω² (ρA/κGA + ρI/EI) k² + ω⁴ (ρA/κGA)(ρI/EI) − ω² ρA/EI = 0
    /// ```
    ///
    /// # Source
    ///
    /// Timoshenko's equation (named in [`Theory::Timoshenko`]) for `w = e^{i(kx − ωt)}`.
    fn waves(&self, square: f64) -> [f64; 2] {
        let middle = 0.5 * square * (self.shear + self.turning);
        let half = 0.5 * square * (self.shear - self.turning);
        let root = (half * half + square * self.slender).sqrt();
        [middle + root, middle - root]
    }
}

impl Survey {
    /// A bat whose highest wanted mode has that total phase of all waves from end to end (rad).
    pub fn of(bat: &Bat, theory: Theory, phase: f64) -> Self {
        let widest = bat.profile().widest();
        let pieces = &bat.profile().pieces;
        let mut samples = Vec::with_capacity(5 * pieces.len());
        let mut ends = Vec::with_capacity(pieces.len());
        let mut ratios = Vec::new();
        for piece in pieces {
            take(bat, piece, THIN * widest, pieces.len(), &mut samples);
            ends.push(samples.len());
            if theory.turns() {
                let first = ratios.len();
                ratios.extend(
                    samples[first..]
                        .iter()
                        .map(|sample| ratios_at(bat, piece, sample.s, THIN * widest, theory)),
                );
                for k in first + 1..samples.len() {
                    ratios[k].step = piece.length * (samples[k].s - samples[k - 1].s);
                }
            }
        }
        let slender: f64 = ends.iter().map(|end| samples[end - 1].phase).sum();
        let mut survey = Self { samples, ends, root_omega: phase / slender };
        if theory.turns() {
            survey.tune(&ratios, phase);
        }
        survey
    }

    /// Finds the frequency at which the waves have that phase, and the longer wave there.
    fn tune(&mut self, ratios: &[Ratios], phase: f64) {
        // With shear and rotary inertia the phase is a power of ω between ½ and 1; this many steps leave little error.
        for _ in 0..4 {
            let square = self.root_omega.powi(4);
            let both = |r: &Ratios| r.waves(square).map(|k| k.max(0.0).sqrt()).iter().sum::<f64>();
            let found: f64 = pairs(ratios, both).sum();
            self.root_omega *= (phase / found).powf(0.6);
        }
        let square = self.root_omega.powi(4);
        let faster = |r: &Ratios| r.waves(square)[0].sqrt() / self.root_omega;
        let steps: Vec<f64> = pairs(ratios, faster).collect();
        let mut sum = 0.0;
        for (k, sample) in self.samples.iter_mut().enumerate() {
            sum = if ratios[k].step == 0.0 { 0.0 } else { sum + steps[k - 1] };
            sample.phase = sum;
        }
    }

    /// The samples of every piece.
    pub fn pieces(&self) -> impl Iterator<Item = &[Sample]> {
        (0..self.ends.len()).map(|k| self.piece(k))
    }

    /// The samples of one piece.
    pub fn piece(&self, k: usize) -> &[Sample] {
        &self.samples[if k == 0 { 0 } else { self.ends[k - 1] }..self.ends[k]]
    }
}

/// `∫ f dx` from each sample to the next by the trapezoid rule; 0 between pieces.
fn pairs(ratios: &[Ratios], f: impl Fn(&Ratios) -> f64) -> impl Iterator<Item = f64> {
    ratios.windows(2).map(move |w| match w[1].step {
        0.0 => 0.0,
        step => 0.5 * step * (f(&w[0]) + f(&w[1])),
    })
}

/// [`Ratios`] at a place of a piece, without its step.
fn ratios_at(bat: &Bat, piece: &Piece, s: f64, thin: f64, theory: Theory) -> Ratios {
    let section = piece.at(s);
    let section = Section { outer: section.outer.max(thin), ..section };
    let worth = bat.layup(piece).worth(section);
    let shear = if theory.shears() { worth.mass / worth.shear } else { 0.0 };
    let [slender, turning] = [worth.mass, worth.turning].map(|inertia| inertia / worth.bending);
    Ratios { slender, turning, shear, step: 0.0 }
}

/// The data of a sample.
#[derive(Clone, Copy)]
struct SamplePoint {
    s: f64,
    /// Outer radius (m).
    radius: f64,
    /// `(ρA/EI)^¼` (√(s/rad)/m).
    wave: f64,
    /// The taper per unit of `s`, for stations: `max_j |c_j r_j/r|^{1/j}` with the radius `Σ r_j (Δs)^j` around the
    /// place and c = 1, 0.5, 0.3. For a straight side it is `|d ln r/ds|`, and a cubic counts as the cone whose series
    /// falls as slowly.
    ///
    /// The second value omits the third term.
    taper: Option<[f64; 2]>,
}

/// Samples along one of `pieces` pieces, denser where the radius changes; a radius below `thin` is replaced by that.
fn take(bat: &Bat, piece: &Piece, thin: f64, pieces: usize, samples: &mut Vec<Sample>) {
    let at = |s: f64| {
        let section = piece.at(s);
        let radius = section.outer.max(thin);
        let section = Section { outer: radius, ..section };
        let [bending, mass] = bat.layup(piece).bending_and_mass(section);
        let ratio = mass / bending;
        let taper = match &piece.radii {
            Radii::Cubic(cubics) => Some(taper(cubics, s, radius)),
            Radii::Formula(_) => None,
        };
        SamplePoint { s, radius, wave: ratio.sqrt().sqrt(), taper }
    };
    samples.push(Sample::default());
    let parts = match &piece.radii {
        Radii::Cubic(cubics) if cubics.degree == 0 => {
            let phase = piece.length * at(0.0).wave;
            samples.push(Sample { s: 1.0, phase, ..Sample::default() });
            return;
        }
        Radii::Cubic(cubics) if cubics.degree == 1 => 1,
        Radii::Cubic(_) if pieces > MANY => 2,
        Radii::Cubic(_) => 4,
        Radii::Formula(_) => 32,
    };
    let mut left = at(0.0);
    for k in 1..=parts {
        let right = at(f64::from(k) / f64::from(parts));
        between(&at, piece.length, [left, right], samples, 40);
        left = right;
    }
}

/// [`SamplePoint::taper`] for stations.
///
/// The series of `(1 + c s^j)⁻⁴` has every j-th term of the cone's, with smaller coefficients: the first is
/// `4/(j+3 choose 3)` of it, 0.4 and 0.2 for j = 2 and 3, the next 0.29² and 0.12². The factors c lie between these.
fn taper(cubics: &Cubics, s: f64, radius: f64) -> [f64; 2] {
    let b = &cubics.outer;
    let first = [b[1] - b[0], b[2] - b[1], b[3] - b[2]];
    let second = [first[1] - first[0], first[2] - first[1]];
    let third = second[1] - second[0];
    let t = 1.0 - s;
    let r1 = 3.0 * (first[0] * t * t + 2.0 * first[1] * t * s + first[2] * s * s);
    let r2 = 3.0 * (second[0] * t + second[1] * s);
    let [r1, r2, r3] = [r1, r2, third].map(|r| (r / radius).abs());
    // The higher terms of a straight side are round-off.
    if cubics.degree == 1 {
        return [r1; 2];
    }
    let smooth = r1.max((0.5 * r2).sqrt());
    let third = 0.3 * r3;
    [if third > smooth * smooth * smooth { third.cbrt() } else { smooth }, smooth]
}

fn between(
    at: &dyn Fn(f64) -> SamplePoint,
    length: f64,
    [left, right]: [SamplePoint; 2],
    samples: &mut Vec<Sample>,
    depth: usize,
) {
    let ratio = left.radius / right.radius;
    if depth > 0 && !(1.0 / SMOOTH..=SMOOTH).contains(&ratio) {
        let middle = at(0.5 * (left.s + right.s));
        between(at, length, [left, middle], samples, depth - 1);
        between(at, length, [middle, right], samples, depth - 1);
        return;
    }
    let last = samples[samples.len() - 1];
    let step = right.s - left.s;
    let phase = 0.5 * (left.wave + right.wave) * length * step;
    let [taper, smooth] = match (left.taper, right.taper) {
        (Some(from), Some(to)) => [0, 1].map(|k| 0.5 * (from[k] + to[k]) * step),
        _ => [2.0 * (right.radius - left.radius).abs() / (right.radius + left.radius); 2],
    };
    samples.push(Sample {
        s: right.s,
        phase: last.phase + phase,
        taper: last.taper + taper,
        smooth: last.smooth + smooth,
    });
}
