//! How fine must the elements be for a tolerance?
//!
//! Each harmonic is solved on finer and finer meshes until the difference of two is small enough.

use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

use crate::base::error::{Error, Result};
use crate::base::threads;
use crate::beam::wall::columns::{Grading, columns};
use crate::beam::wall::elastic::Elastic;
use crate::beam::wall::layers::Layers;
use crate::beam::wall::unknowns::{EndHold, WallMesh};
use crate::eigen::fronts::Fronts;
use crate::modes::hoop::request::HoopRequest;
use crate::modes::hoop::spectrum::{Spectrum, count_below, keep};
use crate::modes::hoop::system::Wall;

/// The sequence of meshes: degrees along and across, geometric steps towards ends, kinks and corners.
///
/// The slowest error to fall is that at the wall's edge at a free end. The motion at its corners is proportional to
/// `r^λ` with λ = 2.740 ± 1.119 i, the least root of `sin(λπ/2) = ±λ` beyond 1, whatever the material (M. L. Williams,
/// J. Appl. Mech. 19, 526, 1952). One element reaches across the wall, so the error falls as a power of the degree. A
/// wall that bends warps its sections by odd polynomials: an odd degree gains much, the even one after it a tenth or
/// nothing. Every step from 5 across on therefore adds two degrees; steps of one would let two meshes agree on a wrong
/// result. The errors for a tube of Poisson's ratio 0.45 by degree across: 5 1.8e-7, 6 1.7e-7, 7 1.6e-8, 8 1.6e-8, 9
/// 2.8e-9.
const LADDER: [([usize; 2], [usize; 3]); 7] = [
    ([4, 2], [0, 0, 1]),
    ([5, 3], [1, 0, 1]),
    ([6, 4], [2, 1, 2]),
    ([8, 5], [3, 2, 3]),
    ([9, 7], [4, 3, 4]),
    ([10, 9], [5, 4, 5]),
    ([12, 11], [6, 5, 6]),
];
/// For a smooth wall, this share of the difference of two meshes is stated as the error of the finer one. The error
/// falls at least to 0.47 of itself from one mesh to the next, and a true error may be three times the stated one.
const SMOOTH: f64 = 0.3;
/// Relative error of a frequency over k², at a kink where the slope changes by k, if the elements beside it are not
/// graded. Measured on tubes of 62 mm with cones at their ends, k 0.02 to 0.2, walls of 2 and 3 mm, modes 1 to 4 of n =
/// 2 and 4: 7e-6 to 2.7e-3 at degrees 6 along and 4 across, 2e-6 to 3.5e-4 at 8 and 5.
const KINK: f64 = 1e-3;

/// A harmonic on a mesh that is fine enough.
pub(crate) struct Climbed {
    /// Its modes.
    pub spectrum: Spectrum,
    /// Their stated errors.
    pub errors: Vec<f64>,
    /// The largest error due to the cut in the handle, as a share of the allowed error.
    pub cut: f64,
    /// Whether each is within the allowed error.
    pub met: bool,
}

/// Harmonics on finer and finer meshes.
pub(crate) struct Climb<'a> {
    request: &'a HoopRequest,
    layers: &'a Layers,
    ends: [EndHold; 2],
    /// Whether the stretch begins at a cut in the handle.
    cut: bool,
    materials: Arc<[Elastic]>,
    walls: [OnceLock<std::result::Result<Wall, String>>; LADDER.len()],
    round_off: f64,
    least_kink: f64,
    /// Share of the difference of two meshes that is stated as the error of the finer.
    stated: f64,
    /// Relative error due to kinks without grading.
    left_kinks: f64,
}

impl<'a> Climb<'a> {
    pub fn new(
        layers: &'a Layers,
        ends: [EndHold; 2],
        cut: bool,
        request: &'a HoopRequest,
    ) -> Self {
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
        let wall = threads::made(&self.walls[k], || {
            let (degrees, [end, kink, corner]) = LADDER[k];
            // A free end at the knob is an end of the bat; at a cut the motion has decayed.
            let knob = if self.layers.stretches[0].from == 0.0 { end } else { 0 };
            let least_kink = self.least_kink;
            let grading = Grading { knob, tip: end, kink, least_kink, corner, soft: corner };
            let mesh = WallMesh::new(columns(self.layers, grading), degrees);
            let mesh = Arc::new(mesh.map_err(|error| error.to_string())?);
            Ok(Wall { mesh, materials: self.materials.clone() })
        });
        wall.as_ref().map_err(|said| Error::value("profile", said, "walls that meet"))
    }

    /// The modes of harmonic n on the first mesh that is fine enough, and their stated errors.
    ///
    /// If the handle is cut off, modes of the handle depend on the cut and are not modes of the barrel: modes that move
    /// there by more than a tenth of their largest motion are omitted.
    pub fn harmonic(&self, n: usize) -> Result<Climbed> {
        let HoopRequest { tol, least, up_to_hz, .. } = *self.request;
        let first = usize::from(tol < 3e-3);
        let coarse = self.wall(first)?;
        let least = least.max(1);
        let below = count_below(coarse, n, self.ends, TAU * up_to_hz);
        let mut count = below.clamp(least, least.max(MOST_MODES));
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
                keep(&mut errors, &kept);
            }
            let within = |errors: &[f64]| errors.iter().all(|error| *error <= tol);
            if k + 1 == LADDER.len() || within(&errors) {
                // Modes of n = 0 are waves along the whole bat; these belong to the modelled stretch.
                let dies_out = self.cut && n >= 2;
                let of_cut = |mode| if dies_out { cut_off(&now, mode) } else { 0.0 };
                let cut: Vec<f64> = (0..errors.len()).map(of_cut).collect();
                errors.iter_mut().zip(&cut).for_each(|(error, cut)| *error += cut);
                let met = within(&errors);
                let cut = cut.iter().map(|cut| cut / tol).fold(0.0, f64::max);
                now.factors = Fronts::default();
                return Ok(Climbed { spectrum: now, errors, cut, met });
            }
            before = omegas;
            k += 1;
        }
    }
}

/// Most modes of a harmonic that are kept, unless more are asked for; bats of the trade have less than a tenth of these
/// below 12 kHz.
const MOST_MODES: usize = 200;
/// Most modes of the handle that are omitted in addition to the required modes of the barrel.
const MOST_LEFT_OUT: usize = 40;

/// Relative error of a mode's frequency due to the cut in the handle: about a fiftieth of its squared motion there,
/// relative to the largest, and times the cube of the radii, as for the stiffness of a section that does not stay
/// round. Measured on twenty random barrels, cut where their taper begins and eight radii before.
fn cut_off(spectrum: &Spectrum, mode: usize) -> f64 {
    let columns = &spectrum.system.mesh.columns;
    let size = |x: f64| spectrum.radial(mode, x).abs();
    let from = columns[0].from;
    let radius = spectrum.system.radius(from);
    let there = (0..=PLACES).map(|k| size(from + 2.0 * radius * k as f64 / PLACES as f64));
    let places = columns.iter().flat_map(|column| [0.5 * (column.from + column.to), column.to]);
    let places = places.map(|x| (size(x), x));
    let (largest, at) = places.fold((0.0, from), |a, b| if b.0 > a.0 { b } else { a });
    let radii = spectrum.system.radius(at) / radius;
    0.02 * (there.fold(0.0, f64::max) / largest).powi(2) * radii.powi(3)
}

/// Number of places at which the motion beside a cut is checked.
const PLACES: usize = 8;

/// Whether a mode moves, where the stretch begins, by more than a tenth of its largest motion.
pub(crate) fn in_handle(spectrum: &Spectrum, mode: usize) -> bool {
    let columns = &spectrum.system.mesh.columns;
    let size = |x: f64| spectrum.radial(mode, x).abs();
    let middles =
        columns.iter().flat_map(|column| [column.from, 0.5 * (column.from + column.to), column.to]);
    let largest = middles.map(size).fold(0.0, f64::max);
    size(columns[0].from) > 0.1 * largest
}

/// Relative round-off of a frequency: 1e-9 if the wall is a hundredth of the radius, growing as `(R/h)^3.5` (measured
/// on tubes of h/R from 0.01 to 1e-4).
pub(crate) fn round_off(layers: &Layers) -> f64 {
    let (_, thickness, radius) = thinnest(layers);
    1e-9 * (0.01 * radius / thickness).powf(3.5)
}

/// Where the wall is thinnest against its radius: place, thickness, radius (m).
pub(crate) fn thinnest(layers: &Layers) -> (f64, f64, f64) {
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
