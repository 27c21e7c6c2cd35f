//! The whole comparison of measured modes with a bat's computed ones.

use faer::c64;
use serde::Serialize;

use crate::engine::{Bat, Error, Mode, Request, Result, Solution, solve};
use crate::measured::data::{Measured, MeasuredMode};
use crate::measured::mac;
use crate::measured::pairing::{by_order, by_shape, octaves};
use crate::measured::place::{Placed, ToldPoints, place};
use crate::measured::weigh::{Curve, Scale};

/// Measured modes compared with computed ones.
#[derive(Debug, Clone)]
pub struct Study {
    /// The measurement.
    pub measured: Measured,
    /// The computed modes.
    pub solution: Solution,
    /// The measured modes that are rigid motions on their supports.
    pub rigid: Vec<RigidMode>,
    /// Indices (from 0) of the bending modes.
    pub bending: Vec<usize>,
    /// Which is which.
    pub pairs: Vec<Pair>,
    /// Numbers (from 0) of measured bending modes without a computed partner.
    pub lone_measured: Vec<usize>,
    /// Numbers (from 0) of computed modes up to the highest measured frequency without a measured
    /// partner.
    pub lone_computed: Vec<usize>,
    /// Results about the shapes, if there are shapes.
    pub shapes: Option<Shapes>,
}

/// A measured and a computed mode that are the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Number of the measured mode, from 0.
    pub measured: usize,
    /// Number of the computed mode, from 0.
    pub computed: usize,
    /// MAC of both shapes; None without measured shapes.
    pub mac: Option<f64>,
    /// Computed over measured frequency, less 1; None for a measured 0 Hz.
    pub difference: Option<f64>,
    /// Stated relative error of the computed frequency.
    pub within: f64,
    /// The factor from the computed shape (largest deflection 1) to the measured one.
    pub scale: Option<c64>,
}

/// A measured mode too slow to bend the bat: the bat on its supports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMode {
    /// Number of the measured mode, from 0.
    pub measured: usize,
    /// How far from a straight line its shape is, as a share of its size (root of the squares at
    /// the points).
    pub bent: f64,
}

/// Results about measured shapes and their computed partners.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Shapes {
    /// The points on the bat, and the shapes there.
    #[serde(flatten)]
    pub placed: Placed,
    /// Names of the measured bending modes, the rows of the tables.
    pub rows: Vec<String>,
    /// MAC of measured (rows) with computed modes (columns).
    pub mac: Vec<Vec<f64>>,
    /// MAC of the computed modes among themselves at the same points.
    #[serde(rename = "mac_of_computed")]
    pub own_mac: Vec<Vec<f64>>,
    /// Mass orthogonality of every two measured modes; null for a bat with absorbers.
    // 1 for the same mode. The motion of absorbers was not measured.
    #[serde(rename = "common_in_mass")]
    pub common: Option<Vec<Vec<f64>>>,
    /// Mass orthogonality of their computed partners at the same points; null without one.
    // And with absorbers.
    #[serde(rename = "common_in_mass_of_computed")]
    pub sampled_common: Vec<Vec<Option<f64>>>,
    /// MAC of the computed modes among themselves, at many points.
    #[serde(skip)]
    pub dense_mac: Vec<Vec<f64>>,
    /// Phase collinearity of every measured bending mode.
    #[serde(skip)]
    pub collinearity: Vec<f64>,
    /// Share out of phase of every measured bending mode.
    #[serde(skip)]
    pub out_of_phase: Vec<f64>,
    /// Rigid motion in every measured bending mode, as a share of its size. None for a bat with
    /// absorbers, and for one that something holds.
    #[serde(skip)]
    pub rigid_share: Option<Vec<f64>>,
    /// Rigid motion in the computed partner of every measured bending mode, as a share of its size;
    /// taken from the measured points.
    #[serde(skip)]
    pub sampled_rigid_share: Option<Vec<Option<f64>>>,
}

/// A MAC without doubt, at points that distinguish the modes.
pub const ALIKE: f64 = 0.8;
/// A measured mode below this share of the first bending frequency is rigid, if its shape departs from a straight line
/// by no more than that.
const RIGID_BELOW: f64 = 0.5;
const STRAIGHT: f64 = 0.5;
/// Computed modes go up to this times the highest measured frequency.
const ABOVE: f64 = 1.25;
/// Computed modes are at most this many.
const MOST: usize = 100;
/// Even steps along a bat that hide no shape.
const MANY: usize = 400;

impl Study {
    /// Solves the bat, for the request's modes if `exactly`, else for as many as reach beyond the measured frequencies;
    /// pairs the modes and checks the measured shapes. If the frequencies of shapes match similar modes only in the
    /// other of Hz and rad/s, they are read so.
    ///
    /// # Errors
    ///
    /// As [`solve`], and [`Error::Value`] for points that are not on the bat, and for shapes that contradict the file's
    /// unit of frequency.
    pub fn new(
        bat: &Bat,
        measured: Measured,
        request: &Request,
        exactly: bool,
        told: ToldPoints,
    ) -> Result<Self> {
        let Some(otherwise) = measured.otherwise else {
            return Self::as_read(bat, measured, request, exactly, told);
        };
        let own = Self::as_read(bat, measured.clone(), request, exactly, told)?;
        if 2 * own.alike() >= own.bending.len().max(1) {
            return Ok(own);
        }
        let other = Self::as_read(bat, measured.read_otherwise(), request, exactly, told)?;
        match other.alike() {
            none if none <= own.alike() => Ok(own),
            _ if otherwise.settled => {
                let [found, expected] = [otherwise.read_in, otherwise.read_in.other()];
                let [found, expected] = [found.name(), expected.name()];
                let found = format!(
                    "frequencies in {found} by its modal masses, and in {expected} by its shapes"
                );
                let expected =
                    format!("--frequency-unit, {expected} or {}", otherwise.read_in.name());
                Err(Error::value(&own.measured.source, found, expected))
            }
            _ => Ok(other),
        }
    }

    /// Number of measured modes with a computed partner whose shape leaves no doubt.
    fn alike(&self) -> usize {
        let sure = |pair: &&Pair| pair.mac.is_some_and(|mac| mac >= ALIKE);
        self.pairs.iter().filter(sure).count()
    }

    /// As [`Self::new`], with the frequencies as they were read.
    fn as_read(
        bat: &Bat,
        measured: Measured,
        request: &Request,
        exactly: bool,
        told: ToldPoints,
    ) -> Result<Self> {
        let solution =
            if exactly { solve(bat, request)? } else { reaching(bat, &measured, request)? };
        let first = solution.modes.first().map_or(0.0, |mode| mode.frequency());
        let slow = |k: &usize| {
            let mode = &measured.modes[*k];
            let straight = || bent(&measured.along, &mode.shape) < STRAIGHT;
            let slow = solution.rigid_modes > 0 && mode.frequency < RIGID_BELOW * first;
            slow && !mode.shape.is_empty() && straight()
        };
        let (slowest, bending): (Vec<usize>, Vec<usize>) =
            (0..measured.modes.len()).partition(slow);
        if !measured.has_shapes() && told != ToldPoints::default() {
            let expected =
                "a file with shapes, or nothing said of where they begin and which end comes first";
            return Err(Error::value("measured modes", "frequencies alone", expected));
        }
        let fit = |x: &[f64], shapes: &[Vec<c64>]| {
            let own = sampled(&solution, x);
            let best = |k: &usize| best(&solution, &own, &measured.modes[*k], &shapes[*k]);
            bending.iter().map(best).sum::<f64>() / bending.len().max(1) as f64
        };
        let there = measured.has_shapes().then(|| place(&measured, bat.length(), told, fit));
        let placed = there.transpose()?;
        let bent = |k: usize| bent(&measured.along, &measured.modes[k].shape);
        let rigid = slowest.iter().map(|&k| RigidMode { measured: k, bent: bent(k) }).collect();
        let mut study = Self {
            rigid,
            bending,
            pairs: vec![],
            lone_measured: vec![],
            lone_computed: vec![],
            shapes: None,
            measured,
            solution,
        };
        let seen = placed.map(|placed| study.seen(placed));
        study.pair(seen.as_ref());
        study.shapes = seen.map(|seen| study.look(bat, seen));
        Ok(study)
    }

    /// The file's name of a measured mode.
    pub fn name(&self, measured: usize) -> &str {
        &self.measured.modes[measured].name
    }

    /// The modes at the measured points.
    fn seen(&self, placed: Placed) -> MatchedShapes {
        let rows: Vec<_> = self.bending.iter().map(|k| placed.shapes[*k].clone()).collect();
        let computed = sampled(&self.solution, &placed.x);
        MatchedShapes { mac: mac::matrix(&rows, &computed), computed, placed }
    }

    fn pair(&mut self, seen: Option<&MatchedShapes>) {
        let computed: Vec<f64> = self.solution.modes.iter().map(|mode| mode.frequency()).collect();
        let frequency = |k: &usize| self.measured.modes[*k].frequency;
        let measured: Vec<f64> = self.bending.iter().map(frequency).collect();
        let pairs = match seen {
            Some(seen) => by_shape(&seen.mac, &measured, &computed),
            None => {
                let orders = self.bending.iter().map(|k| self.measured.modes[*k].order);
                by_order(&orders.collect::<Vec<_>>(), computed.len())
            }
        };
        let one = |(row, column): &(usize, usize)| {
            let mode = &self.solution.modes[*column];
            let number = self.bending[*row];
            let scale = |seen: &MatchedShapes| {
                mac::scale(&seen.placed.shapes[number], &seen.computed[*column])
            };
            let difference = mode.frequency() / measured[*row] - 1.0;
            Pair {
                measured: number,
                computed: *column,
                mac: seen.map(|seen| seen.mac[*row][*column]),
                difference: Some(difference).filter(|d| d.is_finite()),
                within: mode.error.total(),
                scale: seen.map(scale),
            }
        };
        self.pairs = pairs.iter().map(one).collect();
        let highest = measured.last().copied().unwrap_or(0.0);
        let taken = |k: &usize| self.pairs.iter().all(|pair| pair.measured != *k);
        self.lone_measured = self.bending.iter().copied().filter(taken).collect();
        let alone = |k: &usize| self.pairs.iter().all(|pair| pair.computed != *k);
        let below = (0..computed.len()).filter(|k| computed[*k] <= highest);
        self.lone_computed = below.filter(alone).collect();
    }

    /// The checks of the shapes.
    fn look(&self, bat: &Bat, seen: MatchedShapes) -> Shapes {
        let MatchedShapes { placed, computed, mac } = seen;
        let whole = bat.fixtures().absorbers.is_empty();
        let scale = Scale::new(bat, self.solution.theory, &placed.x);
        let shape = |k: &usize| placed.shapes[*k].as_slice();
        let curve = |values: &[c64]| scale.curve(&placed.x, &mac::unit(values));
        let curves: Vec<Curve> = self.bending.iter().map(|k| curve(shape(k))).collect();
        let partner = |k: &usize| self.pairs.iter().find(|pair| pair.measured == *k);
        let of_partner = |pair: &Pair| curve(&computed[pair.computed]);
        let partners: Vec<Option<Curve>> =
            self.bending.iter().map(|k| partner(k).filter(|_| whole).map(of_partner)).collect();
        let known: Vec<Curve> = partners.iter().flatten().cloned().collect();
        let sampled_common = spread(&scale.common(&known), &partners);
        let free = whole && self.solution.rigid_modes == 2;
        let rigid = |curve: &Curve| scale.rigid_share(curve);
        let many: Vec<f64> = (0..=MANY).map(|k| bat.length() * k as f64 / MANY as f64).collect();
        let dense = sampled(&self.solution, &many);
        Shapes {
            rows: self.bending.iter().map(|k| self.name(*k).to_owned()).collect(),
            mac,
            own_mac: mac::matrix(&computed, &computed),
            dense_mac: mac::matrix(&dense, &dense),
            collinearity: self.bending.iter().map(|k| mac::collinearity(shape(k))).collect(),
            out_of_phase: self.bending.iter().map(|k| mac::out_of_phase(shape(k))).collect(),
            common: whole.then(|| scale.common(&curves)),
            sampled_common,
            rigid_share: free.then(|| curves.iter().map(rigid).collect()),
            sampled_rigid_share: free
                .then(|| partners.iter().map(|curve| curve.as_ref().map(rigid)).collect()),
            placed,
        }
    }
}

/// The measured shapes that are on the bat and the computed shapes, both at the measured points, and the MAC of each
/// with each.
struct MatchedShapes {
    placed: Placed,
    computed: Vec<Vec<c64>>,
    mac: Vec<Vec<f64>>,
}

/// A matrix with a row and a column for every shape that is present, and gaps for those that are missing.
fn spread(matrix: &[Vec<f64>], present: &[Option<Curve>]) -> Vec<Vec<Option<f64>>> {
    let mut next = 0..;
    let numbers: Vec<Option<usize>> =
        present.iter().map(|one| one.as_ref().and_then(|_| next.next())).collect();
    let entry = |i: &Option<usize>, j: &Option<usize>| Some(matrix[(*i)?][(*j)?]);
    numbers.iter().map(|i| numbers.iter().map(|j| entry(i, j)).collect()).collect()
}

/// The computed modes, up to some way beyond the highest measured frequency.
fn reaching(bat: &Bat, measured: &Measured, request: &Request) -> Result<Solution> {
    let highest = measured.modes.last().map_or(0.0, |mode| mode.frequency);
    let orders = measured.modes.iter().filter_map(|mode| mode.order).max();
    let mut modes = (measured.modes.len() + 2).max(orders.unwrap_or(0)).clamp(4, MOST);
    loop {
        let solution = solve(bat, &Request { modes, ..*request })?;
        let last = solution.modes.last().map_or(0.0, |mode| mode.frequency());
        if last >= ABOVE * highest || modes == MOST {
            return Ok(solution);
        }
        modes = (modes + modes / 2).min(MOST);
    }
}

/// The computed shapes at the points.
fn sampled(solution: &Solution, x: &[f64]) -> Vec<Vec<c64>> {
    let at = |mode: &Mode| x.iter().map(|x| c64::new(mode.shape.deflection(*x), 0.0)).collect();
    solution.modes.iter().map(at).collect()
}

/// The best MAC of a measured mode with a computed one that it may be.
fn best(solution: &Solution, own: &[Vec<c64>], mode: &MeasuredMode, shape: &[c64]) -> f64 {
    let near = |k: &usize| octaves(mode.frequency, solution.modes[*k].frequency()).is_some();
    let near = (0..own.len()).filter(near);
    near.map(|k| mac::mac(shape, &own[k])).fold(0.0, f64::max)
}

/// How far a shape is from the straight line nearest to it at the points, as a share of its size.
fn bent(x: &[f64], shape: &[c64]) -> f64 {
    let shape = mac::unit(shape);
    let count = x.len() as f64;
    let middle = x.iter().sum::<f64>() / count;
    let mean = shape.iter().fold(c64::new(0.0, 0.0), |sum, v| sum + v) / count;
    let arms = x.iter().map(|x| x - middle);
    let squares: f64 = arms.clone().map(|arm| arm * arm).sum();
    let turn = arms.clone().zip(&shape).fold(c64::new(0.0, 0.0), |sum, (arm, v)| sum + v * arm);
    let slope = if squares > 0.0 { turn / squares } else { c64::new(0.0, 0.0) };
    let left: f64 = arms.zip(&shape).map(|(arm, v)| (v - mean - slope * arm).norm_sqr()).sum();
    let size: f64 = shape.iter().map(|v| v.norm_sqr()).sum();
    if size > 0.0 { (left / size).sqrt() } else { 0.0 }
}
