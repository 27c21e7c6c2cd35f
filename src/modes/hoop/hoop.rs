//! What are the hoop modes of a bat, as accurately as asked?

use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

use crate::base::error::{Error, Result};
use crate::base::golden;
use crate::base::threads;
use crate::bat::body::Bat;
use crate::beam::wall::columns::{Grading, columns};
use crate::beam::wall::elastic::Elastic;
use crate::beam::wall::extent::{Extent, Limit};
use crate::beam::wall::layers::Layers;
use crate::beam::wall::unknowns::{EndHold, WallMesh};
use crate::eigen::fronts::SIDES;
use crate::modes::hoop::patch::{Patch, Share, shares};
use crate::modes::hoop::request::{HoopRequest, KnobSide};
use crate::modes::hoop::spectrum::{Spectrum, count_below};
use crate::modes::hoop::system::Wall;

/// One hoop mode.
#[derive(Debug, Clone, PartialEq)]
pub struct HoopMode {
    /// Its harmonic n: it moves as `cos nθ` around the bat.
    pub harmonic: usize,
    /// Its order among those of its harmonic, from 1.
    pub order: usize,
    /// Angular frequency (rad/s).
    pub omega: f64,
    /// Damping ratio ζ, half the loss factor of the wall.
    pub damping_ratio: f64,
    /// Largest relative error of the frequency, as it is stated.
    pub error: f64,
    /// Where the outer surface moves most, radially (m from the knob end).
    pub largest_at: f64,
}

impl HoopMode {
    /// Frequency (Hz).
    pub fn frequency(&self) -> f64 {
        self.omega / TAU
    }
}

/// The motion of the outer surface in a mode; the largest |radial| is 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Places from the knob end (m).
    pub x: Vec<f64>,
    /// Radial displacement at θ = 0, which goes as `cos nθ`.
    pub radial: Vec<f64>,
    /// Displacement around, which goes as `sin nθ`.
    pub around: Vec<f64>,
    /// Displacement along the bat, which goes as `cos nθ`.
    pub along: Vec<f64>,
}

/// What was assumed, or is worth a warning.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// A material has no Poisson's ratio: this one was assumed. `change` is by how much the lowest frequency
    /// changes, relative, with 0.05 more and with 0.05 less.
    PoissonRatioAssumed {
        /// The ratio that was assumed.
        ratio: f64,
        /// Relative change of the lowest frequency with 0.05 more and with 0.05 less.
        change: [f64; 2],
    },
    /// The wall is so thin that rounding counts.
    ThinWall {
        /// Where it is thinnest against its radius (m).
        at: f64,
        /// Thickness there (m).
        thickness: f64,
        /// Radius there (m).
        radius: f64,
    },
    /// The model begins beyond a step whose walls do not meet.
    BeginsBeyondStep {
        /// Where the step is (m).
        at: f64,
    },
    /// The model begins where the wood ends.
    BeginsBeyondWood {
        /// Where the wood ends (m).
        at: f64,
    },
    /// The bore is open at the tip: no end cap was given.
    OpenTip,
    /// The modes have not died out where the model begins: free and clamped there differ by this, relative, in
    /// the lowest frequency.
    KnobSideMatters {
        /// Relative difference of the lowest frequency.
        difference: f64,
    },
}

/// Hoop modes of a bat.
#[derive(Debug, Clone)]
pub struct Hoop {
    from: f64,
    to: f64,
    spectra: Vec<Spectrum>,
    modes: Vec<HoopMode>,
    notes: Vec<Note>,
    met: bool,
}

/// One fineness of the elements after the other: degrees along and across, geometric steps towards ends, kinks
/// and corners.
const LADDER: [([usize; 2], [usize; 3]); 7] = [
    ([4, 2], [0, 0, 1]),
    ([5, 3], [1, 0, 1]),
    ([6, 4], [2, 1, 2]),
    ([8, 5], [3, 2, 3]),
    ([9, 6], [4, 3, 4]),
    ([10, 7], [5, 4, 5]),
    ([12, 8], [6, 5, 6]),
];
/// Of a smooth wall this share of the difference of two meshes is stated as the error of the finer: the
/// error falls at least to 0.47 of itself from one mesh to the next, and a true error may be three times as
/// large as the stated one.
const SMOOTH: f64 = 0.3;
/// A kink where the slope changes by k costs a frequency about this times k², relative, if the elements beside it
/// are not graded: measured on cones of 2 mm wall at degrees 6 along and 3 across, with kinks of 0.02 to 0.2.
const KINK: f64 = 2.5e-4;
/// Walls thinner than this share of their radius get a warning.
const THIN: f64 = 1.0 / 300.0;

impl Hoop {
    /// The hoop modes of a hollow bat.
    ///
    /// The stretch from the handle to the tip is a solid of revolution; its modes in the handle, which depend on where
    /// that is cut off, are left out. Every harmonic is solved on two meshes, the second with a higher degree along and across and finer towards
    /// ends, kinks and corners; the answer is the second, and their difference is its stated error. While that
    /// is above the tolerance both get finer.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a solid bat, a wall of wood, walls that do not meet in the barrel, and a request that
    /// is none; [`Error::NotConverged`] if an iteration fails.
    pub fn of(bat: &Bat, request: &HoopRequest) -> Result<Self> {
        let tol = request.tol;
        if !(tol > 0.0 && tol < 1.0) {
            return Err(Error::value("tol", tol, "a number above 0 and below 1"));
        }
        // A harmonic motion dies out in the handle by a factor ten over two or three radii.
        let lead = 2.5 * (1e-5 / tol).log10().max(0.0);
        let extent = Extent::of(bat, lead)?;
        let cut = extent.limit == Limit::Handle;
        let mut hoop = Self::solved(bat, [extent.from, extent.to], cut, request)?;
        match extent.limit {
            Limit::Step => hoop.notes.push(Note::BeginsBeyondStep { at: extent.from }),
            Limit::Wood => hoop.notes.push(Note::BeginsBeyondWood { at: extent.from }),
            Limit::Handle | Limit::Knob => {}
        }
        Ok(hoop)
    }

    /// The hoop modes of a stretch of a bat (m), which is cut off at both ends.
    ///
    /// # Errors
    ///
    /// As [`Self::of`].
    pub fn between(bat: &Bat, stretch: [f64; 2], request: &HoopRequest) -> Result<Self> {
        Self::solved(bat, stretch, stretch[0] > 0.0, request)
    }

    /// The modes of a stretch; if it is `cut` off in the handle, without those that ring there.
    fn solved(bat: &Bat, [from, to]: [f64; 2], cut: bool, request: &HoopRequest) -> Result<Self> {
        let layers = Layers::of(bat, from, to)?;
        let ends = match request.end {
            KnobSide::Free => [EndHold::Free; 2],
            KnobSide::Clamped => [EndHold::Clamped, EndHold::Free],
        };
        let climb = Climb::new(&layers, ends, cut, request);
        let solved =
            threads::map(request.harmonics.len(), |k| climb.harmonic(request.harmonics[k]));
        let solved = solved.into_iter().collect::<Result<Vec<_>>>()?;
        let met = solved.iter().flat_map(|(_, errors)| errors).all(|error| *error <= request.tol);
        let modes = solved.iter().flat_map(|(spectrum, errors)| modes(spectrum, errors)).collect();
        let notes = notes(&layers);
        let spectra = solved.into_iter().map(|(spectrum, _)| spectrum).collect();
        Ok(Self { from, to, spectra, modes, notes, met })
    }

    /// All modes that were kept, by harmonic, then order.
    pub fn modes(&self) -> &[HoopMode] {
        &self.modes
    }

    /// The lowest modes of n ≥ 2, by rising frequency.
    pub fn lowest(&self, count: usize) -> Vec<&HoopMode> {
        let mut lowest: Vec<&HoopMode> = self.modes.iter().filter(|m| m.harmonic >= 2).collect();
        lowest.sort_by(|a, b| a.omega.total_cmp(&b.omega));
        lowest.truncate(count);
        lowest
    }

    /// Whether every stated error is within the tolerance.
    pub fn met(&self) -> bool {
        self.met
    }

    /// Where the modelled stretch begins (m).
    pub fn from(&self) -> f64 {
        self.from
    }

    /// Where it ends (m).
    pub fn to(&self) -> f64 {
        self.to
    }

    /// What was assumed or is worth a warning.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Outer radius at `x` (m).
    pub fn radius(&self, x: f64) -> f64 {
        self.spectra.first().map_or(0.0, |spectrum| spectrum.system.radius(x))
    }

    /// Whether the ball presses on the modelled stretch: at the tip it may overhang, at the knob side not.
    pub fn covers(&self, patch: &Patch) -> bool {
        patch.x - patch.half_length >= self.from && patch.x <= self.to
    }

    /// How each harmonic gives way under a patch.
    pub fn under(&self, patch: &Patch) -> Vec<Share> {
        self.under_each(std::slice::from_ref(patch)).remove(0)
    }

    /// How each harmonic gives way under each of some patches; patches that are neighbours take less time
    /// together than one by one.
    pub fn under_each(&self, patches: &[Patch]) -> Vec<Vec<Share>> {
        let placed: Vec<(Patch, f64)> = patches.iter().map(|p| (*p, self.radius(p.x))).collect();
        let mut all = vec![vec![]; patches.len()];
        for spectrum in self.spectra.iter().filter(|spectrum| spectrum.system.n != 1) {
            let shares = placed.chunks(SIDES).flat_map(|few| shares(spectrum, few));
            all.iter_mut().zip(shares).for_each(|(all, share)| all.push(share));
        }
        all
    }

    /// The motion of the outer surface in mode `mode` of [`Self::modes`] at so many even places.
    pub fn outline(&self, mode: usize, points: usize) -> Outline {
        let asked = &self.modes[mode];
        let of_harmonic = |spectrum: &&Spectrum| spectrum.system.n == asked.harmonic;
        let spectrum = self.spectra.iter().find(of_harmonic).expect("every mode has its harmonic");
        let motion = &spectrum.motions[asked.order - 1];
        let scale = 1.0 / spectrum.system.surface(motion, asked.largest_at)[0];
        let mut outline = Outline { x: vec![], radial: vec![], around: vec![], along: vec![] };
        for k in 0..points {
            let share = k as f64 / (points.max(2) - 1) as f64;
            let x = self.from + (self.to - self.from) * share;
            let [u, v, w] = spectrum.system.surface(motion, x);
            outline.x.push(x);
            outline.radial.push(scale * u);
            outline.around.push(scale * v);
            outline.along.push(scale * w);
        }
        outline
    }
}

/// Harmonics on meshes that get finer.
struct Climb<'a> {
    request: &'a HoopRequest,
    layers: &'a Layers,
    ends: [EndHold; 2],
    /// Whether the handle is cut off where the stretch begins.
    cut: bool,
    materials: Arc<[Elastic]>,
    walls: [OnceLock<std::result::Result<Wall, String>>; LADDER.len()],
    round_off: f64,
    least_kink: f64,
    /// Share of the difference of two meshes that is stated as the error of the finer.
    stated: f64,
    /// What kinks cost that are left as they are, relative.
    left_kinks: f64,
}

impl<'a> Climb<'a> {
    fn new(layers: &'a Layers, ends: [EndHold; 2], cut: bool, request: &'a HoopRequest) -> Self {
        let least_kink = (0.03 * request.tol / KINK).sqrt();
        let kinks = layers.kinks();
        let graded = kinks.as_ref().is_none_or(|kinks| kinks.iter().any(|k| *k >= least_kink));
        let stated = if graded { 1.0 } else { SMOOTH };
        let left = kinks.iter().flatten().filter(|kink| **kink < least_kink);
        let left_kinks = left.map(|kink| KINK * kink * kink).sum();
        Self {
            least_kink,
            left_kinks,
            request,
            layers,
            ends,
            cut,
            materials: layers.materials.clone().into(),
            walls: Default::default(),
            round_off: round_off(layers),
            stated,
        }
    }

    /// The wall on mesh `k`.
    fn wall(&self, k: usize) -> Result<&Wall> {
        let made = self.walls[k].get_or_init(|| {
            let (degrees, [end, kink, corner]) = LADDER[k];
            // A free end at the knob is one of the bat; elsewhere the motion has died out.
            let knob = if self.layers.stretches[0].from == 0.0 { end } else { 0 };
            let least_kink = self.least_kink;
            let grading = Grading { knob, tip: end, kink, least_kink, corner };
            let mesh = WallMesh::new(columns(self.layers, grading), degrees);
            let mesh = Arc::new(mesh.map_err(|error| error.to_string())?);
            Ok(Wall { mesh, materials: self.materials.clone() })
        });
        made.as_ref().map_err(|said| Error::value("profile", said, "walls that meet"))
    }

    /// The modes of harmonic n on the first mesh that is fine enough, and their stated errors.
    ///
    /// Where the handle is cut off, modes of the handle depend on the cut and are no modes of the barrel: those
    /// that move there by more than a tenth of their largest motion are left out.
    fn harmonic(&self, n: usize) -> Result<(Spectrum, Vec<f64>)> {
        let HoopRequest { tol, least, up_to_hz, .. } = *self.request;
        let first = usize::from(tol < 3e-3);
        let coarse = self.wall(first)?;
        let mut count = count_below(coarse, n, self.ends, TAU * up_to_hz).max(least);
        let residual = (0.03 * tol).clamp(1e-12, 1e-4);
        let mut before = Spectrum::frequencies(coarse, n, self.ends, count, residual)?;
        let mut k = first + 1;
        loop {
            let mut now = Spectrum::of(self.wall(k)?, n, self.ends, count, residual)?;
            let omegas = now.omegas.clone();
            let others = self.left_kinks + self.round_off;
            let stated = |(a, b): (&f64, &f64)| self.stated * (a / b - 1.0).abs() + others;
            let mut errors: Vec<f64> = before.iter().zip(&omegas).map(stated).collect();
            if self.cut {
                let kept: Vec<bool> = (0..count).map(|mode| !in_handle(&now, mode)).collect();
                let missing = least.saturating_sub(kept.iter().filter(|kept| **kept).count());
                if missing > 0 && count < least + MOST_LEFT_OUT {
                    count += missing;
                    before =
                        Spectrum::frequencies(self.wall(k - 1)?, n, self.ends, count, residual)?;
                    continue;
                }
                now.keep(&kept);
                let mut kept = kept.into_iter();
                errors.retain(|_| kept.next() == Some(true));
            }
            if k + 1 == LADDER.len() || errors.iter().all(|error| *error <= tol) {
                return Ok((now, errors));
            }
            before = omegas;
            k += 1;
        }
    }
}

/// Modes of the handle, at most, beside those of the barrel that are wanted at least.
const MOST_LEFT_OUT: usize = 40;

/// Whether a mode moves where the stretch begins by more than a tenth of its largest motion.
fn in_handle(spectrum: &Spectrum, mode: usize) -> bool {
    let motion = &spectrum.motions[mode];
    let columns = &spectrum.system.mesh.columns;
    let size = |x: f64| spectrum.system.surface(motion, x)[0].abs();
    let middles =
        columns.iter().flat_map(|column| [column.from, 0.5 * (column.from + column.to), column.to]);
    let largest = middles.map(size).fold(0.0, f64::max);
    size(columns[0].from) > 0.1 * largest
}

/// Round-off of a frequency, relative: 1e-9 where the wall is a hundredth of the radius, and growing as
/// `(R/h)^3.5` (measured on tubes of h/R from 0.01 to 1e-4).
fn round_off(layers: &Layers) -> f64 {
    let (_, thickness, radius) = thinnest(layers);
    1e-9 * (0.01 * radius / thickness).powf(3.5)
}

/// Where the wall is thinnest against its radius: place, thickness, radius (m).
fn thinnest(layers: &Layers) -> (f64, f64, f64) {
    let places = layers.stretches.iter().flat_map(|stretch| {
        (0..=8).map(|k| {
            let x = stretch.from + (stretch.to - stretch.from) * f64::from(k) / 8.0;
            let radii = stretch.radii(x);
            let outer = radii[radii.len() - 1];
            (x, outer - radii[0], outer)
        })
    });
    let share = |place: &(f64, f64, f64)| place.1 / place.2;
    places.min_by(|a, b| share(a).total_cmp(&share(b))).expect("a wall has a place")
}

/// The modes of a harmonic with their stated errors.
fn modes(spectrum: &Spectrum, errors: &[f64]) -> Vec<HoopMode> {
    let each = spectrum.omegas.iter().zip(&spectrum.losses).zip(errors).enumerate();
    let modes = each.map(|(k, ((omega, loss), error))| HoopMode {
        harmonic: spectrum.system.n,
        order: k + 1,
        omega: *omega,
        damping_ratio: 0.5 * loss,
        error: *error,
        largest_at: largest_at(spectrum, k),
    });
    modes.collect()
}

/// Samples of a column of elements in which the largest motion is sought.
const SAMPLES: usize = 8;

/// Where the outer surface moves most, radially (m).
fn largest_at(spectrum: &Spectrum, mode: usize) -> f64 {
    let motion = &spectrum.motions[mode];
    let size = |x: f64| spectrum.system.surface(motion, x)[0].abs();
    let columns = &spectrum.system.mesh.columns;
    let mut places: Vec<f64> = columns
        .iter()
        .flat_map(|c| (0..SAMPLES).map(|k| c.from + (c.to - c.from) * k as f64 / SAMPLES as f64))
        .collect();
    places.push(columns[columns.len() - 1].to);
    let sizes: Vec<f64> = places.iter().map(|x| size(*x)).collect();
    let k = (0..places.len()).max_by(|&a, &b| sizes[a].total_cmp(&sizes[b])).expect("some place");
    let (low, high) = (places[k.saturating_sub(1)], places[(k + 1).min(places.len() - 1)]);
    let x = golden::least(low, high, |x| -size(x));
    if size(x) > sizes[k] { x } else { places[k] }
}

fn notes(layers: &Layers) -> Vec<Note> {
    let mut notes = vec![];
    let (at, thickness, radius) = thinnest(layers);
    if thickness < THIN * radius {
        notes.push(Note::ThinWall { at, thickness, radius });
    }
    let last = &layers.stretches[layers.stretches.len() - 1];
    if last.radii(last.to)[0] > 0.0 {
        notes.push(Note::OpenTip);
    }
    notes
}
