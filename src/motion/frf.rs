//! How does a bat respond to a harmonic force: receptance, mobility, accelerance?
//!
//! Make a [`Frf`] for two points with [`Frf::new`], and evaluate it with [`Frf::receptances`]; [`ResponseKind::of`]
//! gives the factors to the other kinds.
//!
//! ```text
//! H(ω) = Σ_rigid φ(x) φ(a)/(−ω² m) + row(x)ᵀ (1 + iK″ + iωC − ω²M)⁻¹ row(a)/U
//! ```
//!
//! with time as `e^{+iωt}`. The strains are those of the modes and the static ones under a force at either point, so
//! that the omitted modes respond as they do at 0 Hz. Further strains follow from the residuals at the worst
//! frequencies, until the estimated error is small. The error is the product of the residuals of both points, because H
//! depends on their product.

use std::f64::consts::TAU;

use faer::c64;

use serde::{Serialize, Serializer};

use crate::base::{Error, Result, dot};
use crate::bat::Bat;
use crate::beam::Elements;
use crate::modes::driven::{Driven, DrivenStrains, UnitForce};
use crate::modes::prepared::{Prepared, prepare};
use crate::modes::reduced::Reduced;
use crate::modes::solve::{Request, Solution, solve};
use crate::motion::peaks::{self, Peak};

/// Kind of the response to a force.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ResponseKind {
    /// Deflection (m/N).
    #[default]
    Receptance,
    /// Velocity (m/(s N)).
    Mobility,
    /// Acceleration (m/(s² N) = 1/kg).
    Accelerance,
}

impl ResponseKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Receptance, Self::Mobility, Self::Accelerance];

    /// The name that the command line and the files use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Receptance => "receptance",
            Self::Mobility => "mobility",
            Self::Accelerance => "accelerance",
        }
    }

    /// The unit of the response, as in the names of columns.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Receptance => "m_per_n",
            Self::Mobility => "m_per_s_n",
            Self::Accelerance => "1_per_kg",
        }
    }

    /// The factor from a receptance at that frequency (Hz): 1, iω or −ω².
    pub fn of(self, frequency: f64) -> c64 {
        let omega = TAU * frequency;
        match self {
            Self::Receptance => c64::new(1.0, 0.0),
            Self::Mobility => c64::new(0.0, omega),
            Self::Accelerance => c64::new(-omega * omega, 0.0),
        }
    }
}

/// The receptance at one frequency.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Sample {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Deflection per force (m/N).
    #[serde(serialize_with = "parts")]
    pub receptance: c64,
    /// Possible error (m/N), due to omitted strains and to the effect of the modes' own relative errors on the inertia
    /// of every shape.
    pub truncation: f64,
}

/// A complex number as its real and imaginary part.
fn parts<S: Serializer>(value: &c64, to: S) -> std::result::Result<S::Ok, S::Error> {
    [value.re, value.im].serialize(to)
}

/// A bat with a forced and a watched point, ready for any frequency.
pub struct Frf {
    /// The modes, on a mesh with a node at both points.
    pub solution: Solution,
    reduced: Reduced,
    /// The forced and the watched point.
    places: [UnitForce; 2],
    points: [f64; 2],
    /// Whether the response is 0, because a support keeps the watched point at rest.
    pub still: bool,
    /// Damping ratios of the modes in place of the bat's; empty if the bat's apply.
    ratios: Vec<f64>,
}

/// The modes on the mesh of a response are at least this accurate.
const MESH: f64 = 1e-8;
/// Error of the inertia of all shapes over the largest relative error of a requested frequency. The mesh is not planned
/// for shapes above the requested modes.
const BEYOND: f64 = 12.0;
/// Least relative error of the inertia.
const KNOWN: f64 = 1e-12;
/// Allowed error, relative to the points' own responses.
const MISSING: f64 = 1e-12;

impl Frf {
    /// The bat forced at `at` and watched at `to` (m from the knob end), for frequencies up to about that of the last
    /// requested mode.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a point that is not on the bat; those of [`solve`].
    pub fn new(bat: &Bat, request: &Request, at: f64, to: f64) -> Result<Self> {
        for (name, x) in [("place of the force", at), ("place that is watched", to)] {
            if !(x >= 0.0 && x <= bat.length()) {
                let expected = format!("a place on the bat, 0 to {} m", bat.length());
                return Err(Error::value(name, format!("{x} m"), expected));
            }
        }
        let Prepared { bat, request, .. } = prepare(bat, request)?;
        let bat = bat.with(|parts| parts.profile.cut([at, to]))?;
        let request = Request { tolerance: request.tolerance.min(MESH), ..request };
        let solution = solve(&bat, &request)?;
        // A force bends the bat with a kink, which no polynomial inside an element can represent.
        let mesh = solution.mesh.with_nodes(&bat, &[at, to]);
        let elements = Elements { mesh: &mesh, ..solution.elements() };
        let mut reduced = Reduced::new(&bat, elements, solution.modes.len())?;
        [at, to].iter().for_each(|x| {
            reduced.place(*x);
        });
        let places = [at, to].map(|x| reduced.place(x));
        let (points, still) = ([at, to], bat.fixtures().keeps_still([at, to]));
        Ok(Self { solution, reduced, places, points, still, ratios: vec![] })
    }

    /// The response with measured damping ratios of its modes in place of the materials' loss factors; a mode without
    /// one gets the mean of the others. For a bat whose materials have no loss.
    pub fn damped_as(mut self, ratios: &[Option<f64>]) -> Self {
        let known: Vec<f64> = ratios.iter().flatten().copied().collect();
        let mean = known.iter().sum::<f64>() / known.len().max(1) as f64;
        let ratio = |k: usize| ratios.get(k).copied().flatten().unwrap_or(mean);
        let losses: Vec<f64> = (0..self.reduced.omega.len()).map(|k| 2.0 * ratio(k)).collect();
        self.reduced.lose(&losses);
        self.ratios = (0..self.solution.modes.len()).map(ratio).collect();
        self
    }

    /// The damping ratios given to [`Self::damped_as`]; empty without.
    pub fn damping_ratios(&self) -> &[f64] {
        &self.ratios
    }

    /// The deflection (m/N) under a constant force. For a free bat it is the bending alone, balanced by the bat's
    /// inertia.
    pub fn static_compliance(&self) -> f64 {
        let [at, to] = self.points.map(|x| self.reduced.flexible.row(x));
        if self.still { 0.0 } else { dot(&at, &to) / self.reduced.flexible.energy_unit }
    }

    /// The receptance (m/N) without the free rigid motions, at 0 Hz or more, with the present strains: those of the
    /// modes and of a constant force, until [`Self::receptances`] adds others.
    pub fn strained(&self, frequency: f64) -> c64 {
        self.strained_by(&self.reduced.driven(), frequency)
    }

    fn strained_by(&self, driven: &Driven, frequency: f64) -> c64 {
        self.reduced.answer(driven, &self.places[0], TAU * frequency).at(&self.places[1])
    }

    /// The part of the receptance (m/N) due to free rigid motions.
    pub fn rigid(&self, frequency: f64) -> f64 {
        if self.reduced.coupled {
            return 0.0;
        }
        let square = (TAU * frequency).powi(2);
        let [at, to] = &self.places;
        let motions = self.reduced.flexible.rigid.iter().zip(at.rigid.iter().zip(&to.rigid));
        motions.map(|(motion, (a, b))| -a * b / (square * motion.mass)).sum::<f64>() + 0.0
    }

    /// The receptance (m/N) at a frequency (Hz) with the present strains.
    fn receptance(&self, driven: &Driven, frequency: f64) -> c64 {
        self.strained_by(driven, frequency) + c64::new(self.rigid(frequency), 0.0)
    }

    /// Natural frequency (Hz) and damping ratio of every mode.
    fn modes(&self) -> Vec<[f64; 2]> {
        let own = |k: usize| self.solution.damping.modes.get(k).map_or(0.0, |d| d.ratio);
        let ratio = |k: usize| self.ratios.get(k).copied().unwrap_or_else(|| own(k));
        let modes = self.solution.modes.iter().enumerate();
        modes.map(|(k, mode)| [mode.frequency(), ratio(k)]).collect()
    }

    /// Frequencies between two limits (Hz) that show every peak: the natural frequencies, and others around them at
    /// shares of their half-power width ([`peaks::around`]), rising.
    pub fn around_modes(&self, [low, high]: [f64; 2]) -> Vec<f64> {
        let all = self.modes().into_iter().flat_map(|[f, ratio]| peaks::around(f, ratio));
        let mut within: Vec<f64> = all.filter(|f| (low..=high).contains(f)).collect();
        within.sort_by(f64::total_cmp);
        within.dedup();
        within
    }

    /// The peaks between the ends of a rising grid of frequencies (Hz), in the unit of that kind, with the present
    /// strains: [`Self::receptances`] adds those that are missing.
    pub fn peaks(&self, kind: ResponseKind, grid: &[f64]) -> Vec<Peak> {
        if self.still {
            return vec![];
        }
        let driven = self.reduced.driven();
        let size = |f: f64| (self.receptance(&driven, f) * kind.of(f)).norm();
        peaks::of(grid, &self.modes(), &size)
    }

    /// Number of strains of the response, modes included.
    pub fn strains(&self) -> usize {
        self.reduced.len()
    }

    /// The receptances at frequencies (Hz); 0 Hz only if there is no free rigid motion.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a frequency that is negative, not finite, or 0 for a bat that is not held.
    pub fn receptances(&mut self, frequencies: &[f64]) -> Result<Vec<Sample>> {
        const MOST_ROUNDS: usize = 20;
        const PROBES: usize = 16;
        let free = !self.reduced.flexible.rigid.is_empty();
        let possible = |f: f64| f.is_finite() && f >= 0.0 && (f > 0.0 || !free);
        if let Some(f) = frequencies.iter().find(|f| !possible(**f)) {
            let expected = if free { "above 0 Hz: nothing holds the bat" } else { "0 Hz or more" };
            return Err(Error::value("frequencies", format!("{f} Hz"), expected));
        }
        let mut probes: Vec<f64> = frequencies.to_vec();
        probes.sort_by(f64::total_cmp);
        let last = probes.len().saturating_sub(1);
        let count = probes.len().min(PROBES);
        let probe = |k: usize| probes[k * last / (count - 1).max(1)];
        let probes: Vec<f64> = (0..count).map(probe).collect();
        for _ in 0..MOST_ROUNDS {
            let driven = self.reduced.driven();
            let mut worst: Option<(f64, [DrivenStrains; 2])> = None;
            for f in &probes {
                let answers = self.answers(&driven, *f);
                let missing = self.missing(&answers) / self.scale(&answers, *f);
                if missing > worst.as_ref().map_or(MISSING, |(most, _)| *most) {
                    worst = Some((missing, answers));
                }
            }
            let Some((_, answers)) = worst else { break };
            let before = self.reduced.len();
            for strains in answers.into_iter().flat_map(|answer| answer.residual) {
                self.reduced.add(strains);
            }
            if self.reduced.len() == before {
                break;
            }
            // The new strains move both points too.
            self.places = self.points.map(|x| self.reduced.place(x));
        }
        let driven = self.reduced.driven();
        let sample = |f: &f64| {
            if self.still {
                return Sample { frequency: *f, ..Sample::default() };
            }
            let answers = self.answers(&driven, *f);
            Sample {
                frequency: *f,
                receptance: answers[0].at(&self.places[1]) + c64::new(self.rigid(*f), 0.0),
                truncation: self.missing(&answers) + self.blurred(&answers, *f),
            }
        };
        Ok(frequencies.iter().map(sample).collect())
    }

    fn answers(&self, driven: &Driven, frequency: f64) -> [DrivenStrains; 2] {
        let omega = TAU * frequency;
        [0, 1].map(|k| self.reduced.answer(driven, &self.places[k], omega))
    }

    /// The part of the receptance that the strains miss (m/N).
    fn missing(&self, answers: &[DrivenStrains; 2]) -> f64 {
        self.reduced.flexible.energy_unit * answers[0].missed() * answers[1].missed()
    }

    /// Possible effect of the modes' errors on the receptance (m/N): a change δM of the inertia changes it by
    /// `ω² qᵀ δM q′`.
    fn blurred(&self, answers: &[DrivenStrains; 2], frequency: f64) -> f64 {
        let inertia = (TAU * frequency).powi(2) * self.reduced.inertia_of(answers);
        let strained = inertia * self.reduced.flexible.energy_unit;
        BEYOND * self.solution.worst().max(KNOWN) * (strained + self.rigid(frequency).abs())
    }

    /// The mean magnitude of both points' own receptances (m/N); the receptance between the points may be far smaller.
    fn scale(&self, answers: &[DrivenStrains; 2], frequency: f64) -> f64 {
        let omega = (TAU * frequency).powi(2);
        let own = |k: usize| {
            let place = &self.places[k];
            let mut own = answers[k].at(place);
            if !self.reduced.coupled {
                for (motion, w) in self.reduced.flexible.rigid.iter().zip(&place.rigid) {
                    own -= w * w / (omega * motion.mass);
                }
            }
            own.norm()
        };
        (own(0) * own(1)).sqrt().max(f64::MIN_POSITIVE)
    }
}
