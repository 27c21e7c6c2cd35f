//! How does the wall respond to a ball, as accurately as a hit needs it?
//!
//! One mesh and a few modes are enough: an exit speed to 1e-4 needs the wall's frequencies to 4e-4 and its flexibility
//! to 1e-3. Only two kinds of figures are kept: the motion of the outer surface in the modes, and its flexibility under
//! every load.
//!
//! ```text
//! K = L D Lᵀ,   y_s = D^{−½} L⁻¹ e_s for every function s of the outer surface
//! C(load) = Σ load_s load_t y_s·y_t          the same for any patch, anywhere
//! ```
//!
//! Stiffness and density are scale factors. With E (the stiffness around the bat) and ρ of the stiffest material
//! divided out, `ω = ω̂ √(E/ρ)`, `C = Ĉ/E`, `c = ĉ/ρ`. Walls that differ only in these share one solve if they keep the
//! same modes.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::base::error::{Error, Result};
use crate::base::lanes::vectorized;
use crate::base::threads;
use crate::bat::body::Bat;
use crate::bat::profile::SAME_PLACE;
use crate::beam::wall::columns::{Grading, columns};
use crate::beam::wall::elastic::Elastic;
use crate::beam::wall::extent::{Extent, Limit};
use crate::beam::wall::layers::Layers;
use crate::beam::wall::unknowns::{EndHold, WallMesh};
use crate::eigen::fronts::{Fronts, SIDES};
use crate::modes::compliance::taken;
use crate::modes::hoop::climb::{in_handle, round_off};
use crate::modes::hoop::patch::{Patch, Share};
use crate::modes::hoop::spectrum::{Figures, Spectrum, count_below};
use crate::modes::hoop::surface::Surface;
use crate::modes::hoop::system::Wall;

/// Accuracy of a wall's solution for a hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fineness {
    /// Degrees of the elements along the bat and across the wall.
    degrees: [usize; 2],
    /// Geometric steps towards the tip, kinks and corners.
    steps: [usize; 3],
    /// Length of the handle that is modelled before the taper, in radii.
    lead: f64,
    /// The last harmonic.
    last: usize,
    /// Modes are kept up to this frequency (Hz); faster ones follow the force quasi-statically.
    up_to_hz: f64,
    /// A harmonic keeps no modes if `(2/n)^3.6 (ω_kept/ω_n)²` is below this number. ω_kept is the frequency up to which
    /// modes are kept, and `1/ω_n²` is the harmonic's `D/C`.
    little: f64,
    /// Possible relative error of frequencies: on a smooth wall, and beside corners of its layers.
    off: [f64; 2],
    /// Share of the flexibility beyond the modes that the elements may miss. It is that of the wall close to the patch,
    /// where frequencies say nothing about the elements.
    pub(crate) missed: f64,
}

impl Fineness {
    /// The accuracy for exit speeds within that share of the closing speed.
    pub fn for_exit_speed(tolerance: f64) -> Self {
        match tolerance {
            t if t >= 1e-3 => Self {
                degrees: [5, 2],
                steps: [0, 0, 1],
                lead: 0.0,
                last: 6,
                up_to_hz: 9e3,
                little: 0.06,
                off: [2e-3, 4e-3],
                missed: 0.02,
            },
            t if t >= 1e-4 => Self {
                degrees: [6, 3],
                steps: [1, 1, 1],
                lead: 5.0,
                last: 8,
                up_to_hz: 16e3,
                little: 0.06,
                off: [5e-5, 4e-4],
                missed: 0.005,
            },
            // A higher accuracy is useless: the patch is a thousand times as uncertain.
            _ => Self {
                degrees: [8, 5],
                steps: [3, 2, 3],
                lead: f64::INFINITY,
                last: 14,
                up_to_hz: 45e3,
                little: 0.003,
                off: [1e-6, 1e-5],
                missed: 0.002,
            },
        }
    }
}

/// The wall of a bat under a ball, solved once.
#[derive(Debug, Clone)]
pub struct Response {
    solved: Arc<Solved>,
    /// Stiffness around the bat, c_θθ (Pa), and density (kg/m³) of the stiffest material.
    scale: [f64; 2],
}

/// The figures of a wall scaled to c_θθ = 1 and ρ = 1 of the stiffest material.
#[derive(Debug)]
struct Solved {
    surface: Surface,
    harmonics: Vec<Harmonic>,
    /// Possible relative error of frequencies.
    off: f64,
}

/// The figures of one harmonic.
#[derive(Debug)]
struct Harmonic {
    n: usize,
    /// Angular frequencies of its modes, rising.
    omegas: Vec<f64>,
    losses: Vec<f64>,
    /// Motion of each function of the surface in each mode.
    motions: Vec<Vec<f64>>,
    /// Flexibility under loads on the surface.
    flexibility: Flexibility,
    /// `1/ω²` of the part of the flexibility beyond its modes.
    slow: f64,
}

/// The quantities that determine a wall's response.
#[derive(Debug, Clone, PartialEq)]
struct Key {
    layers: Layers,
    cut: bool,
    fineness: Fineness,
    /// The frequency up to which modes are kept, for c_θθ = 1 and ρ = 1.
    up_to: f64,
}

/// A wall that is being solved or has been solved.
type Cell = Arc<OnceLock<std::result::Result<Arc<Solved>, String>>>;

/// The walls that were requested last.
static KNOWN: Mutex<Vec<(Key, Cell)>> = Mutex::new(vec![]);
/// At most this many are kept, or fewer if together they exceed [`NUMBERS`] numbers.
const KEPT: usize = 16;
/// 32 MB.
const NUMBERS: usize = 4_000_000;

impl Response {
    /// The wall of a hollow bat. The last few walls are cached: a bat with the same wall, or with one whose stiffness
    /// and density alone differ by a few per cent, needs no new solve.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a solid bat, a wall of wood, walls that do not meet in the barrel, or if no mode can be
    /// found.
    pub fn of(bat: &Bat, fineness: Fineness) -> Result<Self> {
        let extent = Extent::of(bat, fineness.lead)?;
        let mut layers = Layers::of(bat, extent.from, extent.to)?;
        let scale = normalise(&mut layers.materials);
        let unit = (scale[0] / scale[1]).sqrt();
        let cut = extent.limit == Limit::Handle;
        let key = Key { layers, cut, fineness, up_to: stepped(TAU * fineness.up_to_hz / unit) };
        let cell = {
            let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
            let asked = match known.iter().position(|(other, _)| *other == key) {
                Some(at) => known.remove(at).1,
                None => Cell::default(),
            };
            known.insert(0, (key.clone(), Arc::clone(&asked)));
            known.truncate(KEPT);
            let mut numbers = 0;
            known.retain(|(_, cell)| {
                numbers += cell.get().and_then(|of| of.as_ref().ok()).map_or(0, |of| of.numbers());
                numbers <= NUMBERS || Arc::ptr_eq(cell, &asked)
            });
            asked
        };
        let solved = threads::made(&cell, || key.solve().map(Arc::new).map_err(|e| e.to_string()));
        let solved = solved.as_ref().map_err(|said| {
            Error::value("profile", said, "a wall whose hoop modes can be found")
        })?;
        Ok(Self { solved: Arc::clone(solved), scale })
    }

    /// Whether both come from one solve.
    pub fn shares_with(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.solved, &other.solved)
    }

    /// Harmonic, ω (rad/s) and damping ratio of every mode, by harmonic.
    pub fn modes(&self) -> Vec<(usize, [f64; 2])> {
        let unit = (self.scale[0] / self.scale[1]).sqrt();
        let of = |harmonic: &Harmonic| -> Vec<(usize, [f64; 2])> {
            let modes = harmonic.omegas.iter().zip(&harmonic.losses);
            modes.map(|(omega, loss)| (harmonic.n, [omega * unit, 0.5 * loss])).collect()
        };
        self.solved.harmonics.iter().flat_map(of).collect()
    }

    /// The harmonics that are modelled.
    pub fn harmonics(&self) -> Vec<usize> {
        self.solved.harmonics.iter().map(|harmonic| harmonic.n).collect()
    }

    /// Possible relative error of a frequency.
    pub fn off(&self) -> f64 {
        self.solved.off
    }

    /// Beginning and end of the modelled stretch (m).
    pub fn ends(&self) -> [f64; 2] {
        self.solved.surface.ends()
    }

    /// Outer radius at `x` (m).
    pub fn radius(&self, x: f64) -> f64 {
        self.solved.surface.radius(x)
    }

    /// Whether the ball presses on the modelled stretch: it may overhang at the tip, but not at the knob side. A patch
    /// longer than that of any ball is not covered.
    pub fn covers(&self, patch: &Patch) -> bool {
        let [from, to] = self.ends();
        let short = 2.0 * patch.half_length <= WIDEST;
        short && patch.x - patch.half_length >= from && patch.x <= to * (1.0 + SAME_PLACE)
    }

    /// The compliance of each harmonic under a patch.
    pub fn under(&self, patch: &Patch) -> Vec<Share> {
        let (radius, load) = (self.radius(patch.x), self.solved.surface.load(patch));
        let of = |harmonic: &Harmonic| {
            harmonic.under(&load, patch.share(harmonic.n, radius), self.scale)
        };
        self.solved.harmonics.iter().map(of).collect()
    }
}

impl Solved {
    /// Number of stored numbers.
    fn numbers(&self) -> usize {
        let of = |harmonic: &Harmonic| {
            let kept = harmonic.flexibility.0.iter().map(|(_, row)| row.len()).sum::<usize>();
            kept + harmonic.motions.iter().map(Vec::len).sum::<usize>()
        };
        self.harmonics.iter().map(of).sum()
    }
}

impl Harmonic {
    /// The compliance under a load with that resultant, for these E and ρ.
    fn under(&self, load: &[(usize, f64)], g: f64, [e, rho]: [f64; 2]) -> Share {
        let turn = if self.n == 0 { TAU } else { PI };
        let moved = |motion: &Vec<f64>| load.iter().map(|(s, a)| a * motion[*s]).sum::<f64>();
        let gain = |motion: &Vec<f64>| g * g * moved(motion).powi(2) / turn;
        let gains: Vec<f64> = self.motions.iter().map(gain).collect();
        let soft = g * g * self.flexibility.under(load) / turn;
        let [here, slow] = taken(&gains, |k| self.omegas[k].powi(2));
        let slowness = slow + self.slow * (soft - here).max(0.0);
        Share {
            harmonic: self.n,
            gains: gains.into_iter().map(|gain| gain / rho).collect(),
            flexibility: soft / e,
            slowness: slowness * rho / (e * e),
        }
    }
}

impl Key {
    /// The elements and their outer surface.
    fn mesh(&self) -> Result<(Wall, Surface)> {
        let Fineness { degrees: [p, q], steps: [end, kink, corner], .. } = self.fineness;
        // A composite is soft in shear across its wall and needs one degree more.
        let across = if self.layers.materials.iter().any(differs) { q.max(3) } else { q };
        let knob = if self.layers.stretches[0].from == 0.0 { end } else { 0 };
        let grading = Grading { knob, tip: end, kink, least_kink: LEAST_KINK, corner, soft: 0 };
        let mesh = WallMesh::new(columns(&self.layers, grading), [p, across])?;
        let surface = Surface::of(&mesh);
        let (mesh, materials) = (Arc::new(mesh), self.layers.materials.clone().into());
        Ok((Wall { mesh, materials }, surface))
    }

    fn solve(&self) -> Result<Solved> {
        let Fineness { last, off, .. } = self.fineness;
        let (wall, surface) = self.mesh()?;
        let harmonics = std::iter::once(0).chain(2..=last);
        // One after the other: a thread that solves a wall for others must not wait for the pool.
        let harmonics = harmonics.map(|n| self.harmonic(&wall, &surface, n));
        let harmonics = harmonics.collect::<Result<_>>()?;
        let smooth = self.layers.kinks().is_some() || self.layers.stays_stiff();
        let off = off[usize::from(!smooth)] + round_off(&self.layers);
        Ok(Solved { surface, harmonics, off })
    }

    fn harmonic(&self, wall: &Wall, surface: &Surface, n: usize) -> Result<Harmonic> {
        const RESIDUAL: f64 = 1e-4;
        let ends = [EndHold::Free; 2];
        let mut spectrum = Spectrum::new(wall, n, ends)?;
        let [from, to] = surface.ends();
        // Six inches from the tip, or the middle of a short wall.
        let middle = (to - 0.1524).max(0.5 * (from + to));
        let radius = surface.radius(middle);
        let patch = Patch::under(middle, 0.0366, radius, 0.008);
        let all = surface.under(&spectrum, &patch);
        let square = all.flexibility / all.slowness;
        let count = match n {
            0 => 0,
            _ if (2.0 / n as f64).powf(FALLS) * self.up_to * self.up_to
                < self.fineness.little * square =>
            {
                0
            }
            _ => count_below(wall, n, ends, self.up_to),
        };
        if count > 0 {
            let losses = wall.materials.iter().map(|m| m.loss_factor);
            let same = losses.clone().all(|loss| loss == wall.materials[0].loss_factor);
            let figures = if same { Figures::Motions } else { Figures::Strains };
            spectrum.solve(count, RESIDUAL, figures)?;
            if same {
                spectrum.losses = vec![wall.materials[0].loss_factor; count];
            }
            if self.cut {
                let kept: Vec<bool> = (0..count).map(|mode| !in_handle(&spectrum, mode)).collect();
                spectrum.keep(&kept);
            }
        }
        let radial: Vec<Option<(usize, f64)>> = surface.radial(&spectrum.system.unknowns).collect();
        let on_surface = |motion: &Vec<f64>| -> Vec<f64> {
            radial.iter().map(|of| of.map_or(0.0, |(u, sign)| sign * motion[u])).collect()
        };
        let motions: Vec<Vec<f64>> = spectrum.motions.iter().map(on_surface).collect();
        let mut harmonic = Harmonic {
            n,
            motions,
            flexibility: Flexibility::of(&spectrum.factors, surface, &radial),
            slow: 0.0,
            omegas: spectrum.omegas,
            losses: spectrum.losses,
        };
        let modes = harmonic.under(&surface.load(&patch), patch.share(n, radius), [1.0; 2]);
        let [soft, slow] = taken(&modes.gains, |k| harmonic.omegas[k].powi(2));
        let [soft, slow] = [all.flexibility - soft, all.slowness - slow];
        harmonic.slow = if soft > 0.0 { (slow / soft).max(0.0) } else { 0.0 };
        Ok(harmonic)
    }
}

/// A harmonic's share of the compliance under a ball falls as this power of n: n = 3 to 8 on a barrel of 3 mm.
const FALLS: f64 = 3.6;
/// Least change of slope to which the elements are graded.
const LEAST_KINK: f64 = 0.02;

/// `y_s·y_t` of the functions of a surface: for each s the first t, and all values from there to s. It is 0 for earlier
/// t, which no patch loads together with s.
#[derive(Debug, Default)]
struct Flexibility(Vec<(usize, Vec<f64>)>);

/// `D^{−½} L⁻¹` of a few functions of the surface side by side, and the first unknown where it is not 0.
struct Tile {
    functions: Range<usize>,
    begin: usize,
    sides: Vec<[f64; SIDES]>,
}

impl Flexibility {
    /// The flexibility of a wall with those factors; `radial` has the unknown and the sign of each function.
    fn of(factors: &Fronts, surface: &Surface, radial: &[Option<(usize, f64)>]) -> Self {
        let mut rows = vec![];
        let mut near: VecDeque<Tile> = VecDeque::new();
        for first in (0..radial.len()).step_by(SIDES) {
            let functions = first..(first + SIDES).min(radial.len());
            let mut sides = vec![[0.0; SIDES]; factors.pivots().len()];
            for (s, of) in radial[functions.clone()].iter().enumerate() {
                if let Some((unknown, sign)) = of {
                    sides[*unknown][s] = *sign;
                }
            }
            factors.halfway_together(&mut sides);
            let begin = sides.iter().position(|side| *side != [0.0; SIDES]).unwrap_or(0);
            near.push_back(Tile { functions: functions.clone(), begin, sides });
            while surface.gap(near[0].functions.clone(), first) > WIDEST {
                near.pop_front();
            }
            let from = near[0].functions.start;
            let mut own = vec![vec![0.0; functions.end - from]; functions.len()];
            let last = &near[near.len() - 1];
            for other in &near {
                let begin = last.begin.max(other.begin);
                let block = vectorized!(block(&last.sides[begin..], &other.sides[begin..]));
                for (row, block) in own.iter_mut().zip(&block) {
                    let to = &mut row[other.functions.start - from..other.functions.end - from];
                    to.iter_mut().zip(block).for_each(|(to, value)| *to = *value);
                }
            }
            rows.extend(own.into_iter().map(|row| (from, row)));
        }
        Self(rows)
    }

    /// `Σ load_s load_t y_s·y_t` of a load with rising function indices.
    fn under(&self, load: &[(usize, f64)]) -> f64 {
        let of = |(k, (s, a)): (usize, &(usize, f64))| {
            let (from, row) = &self.0[*s];
            let before = load[..k].iter().filter(|(t, _)| t >= from);
            let before: f64 = before.map(|(t, b)| b * row[t - from]).sum();
            a * (2.0 * before + a * row[s - from])
        };
        load.iter().enumerate().map(of).sum()
    }
}

/// Longest patch (m): a softball squeezed flat, at twice its compression.
const WIDEST: f64 = 0.15;

/// Products of all columns of one tile with all columns of the other.
#[inline(always)]
fn block(one: &[[f64; SIDES]], other: &[[f64; SIDES]]) -> [[f64; SIDES]; SIDES] {
    let mut block = [[0.0; SIDES]; SIDES];
    for (x, y) in one.iter().zip(other) {
        for (row, x) in block.iter_mut().zip(x) {
            (0..SIDES).for_each(|t| row[t] += x * y[t]);
        }
    }
    block
}

/// Divides all materials by E and ρ of the stiffest, and returns both. The results are rounded to twelve digits, so
/// that materials that differ only by E and ρ become equal.
fn normalise(materials: &mut [Elastic]) -> [f64; 2] {
    let around = |of: &Elastic| of.normal[1][1];
    let stiffest = materials.iter().max_by(|a, b| around(a).total_cmp(&around(b)));
    let [e, rho] = stiffest.map_or([1.0; 2], |of| [around(of), of.density]);
    for of in materials {
        of.normal.iter_mut().flatten().for_each(|c| *c = rounded(*c / e));
        for shear in [&mut of.shear_xr, &mut of.shear_rt, &mut of.shear_xt] {
            *shear = rounded(*shear / e);
        }
        of.density = rounded(of.density / rho);
    }
    [e, rho]
}

/// The number to forty bits.
fn rounded(x: f64) -> f64 {
    const DROPPED: u64 = 1 << 12;
    f64::from_bits((x.to_bits() + DROPPED / 2) & !(DROPPED - 1))
}

/// The next number of a series with steps of a tenth: bats that differ a little then keep the same modes.
fn stepped(x: f64) -> f64 {
    const STEP: f64 = 1.1;
    STEP.powf((x.ln() / STEP.ln()).ceil())
}

/// Whether a material is orthotropic.
fn differs(of: &Elastic) -> bool {
    of.shear_xr != of.shear_xt || of.normal[0][0] != of.normal[2][2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of half solutions against a solve for each load: anywhere, under patches of half and twice the usual
    /// length, on walls with a taper, a plug and kinks.
    #[test]
    fn what_is_kept_of_a_wall_is_what_a_solve_gives() {
        for (name, tolerance) in
            [("bbcor_made_up", 1e-4), ("northwestern_aluminium", 1e-4), ("softball_made_up", 1e-3)]
        {
            let bat = Bat::builtin(name).unwrap();
            let fineness = Fineness::for_exit_speed(tolerance);
            let extent = Extent::of(&bat, fineness.lead).unwrap();
            let layers = Layers::of(&bat, extent.from, extent.to).unwrap();
            let key = Key { layers, cut: true, fineness, up_to: TAU * 1e3 };
            let solved = key.solve().unwrap();
            let (wall, surface) = key.mesh().unwrap();
            for harmonic in
                solved.harmonics.iter().filter(|harmonic| [0, 2, 5].contains(&harmonic.n))
            {
                let spectrum = Spectrum::new(&wall, harmonic.n, [EndHold::Free; 2]).unwrap();
                for k in 0..60 {
                    let x = extent.from + (extent.to - extent.from) * f64::from(k) / 59.0;
                    for compression in [0.002, 0.008, 0.07] {
                        let radius = surface.radius(x);
                        let patch = Patch::under(x, 0.0366, radius, compression);
                        let exact = surface.under(&spectrum, &patch).flexibility;
                        let load = surface.load(&patch);
                        let g = patch.share(harmonic.n, radius);
                        let kept = harmonic.under(&load, g, [1.0; 2]).flexibility;
                        let off = (kept / exact - 1.0).abs();
                        assert!(off < 1e-8, "{name} n {} {x} {compression}: {off:e}", harmonic.n);
                    }
                }
            }
        }
    }
    /// `D` of a harmonic without modes is extrapolated from one place; with modes it is computed from these. Along the
    /// barrel the sum is within 2 % of solves.
    #[test]
    fn the_slowness_of_a_wall_is_that_of_solves() {
        for name in ["bbcor_made_up", "northwestern_aluminium", "composite_made_up"] {
            let bat = Bat::builtin(name).unwrap();
            let fineness = Fineness::for_exit_speed(1e-4);
            let response = Response::of(&bat, fineness).unwrap();
            let extent = Extent::of(&bat, fineness.lead).unwrap();
            let layers = Layers::of(&bat, extent.from, extent.to).unwrap();
            let (wall, surface) = Key { layers, cut: true, fineness, up_to: 1.0 }.mesh().unwrap();
            let spectra: Vec<Spectrum> = response
                .harmonics()
                .into_iter()
                .map(|n| Spectrum::new(&wall, n, [EndHold::Free; 2]).unwrap())
                .collect();
            for from_tip in [0.0, 0.02, 0.05, 0.1, 0.2, 0.28] {
                let x = extent.to - from_tip;
                let patch = Patch::under(x, 0.0366, surface.radius(x), 0.008);
                let solves = spectra.iter().map(|of| surface.under(of, &patch).slowness);
                let (exact, kept): (f64, f64) =
                    (solves.sum(), response.under(&patch).iter().map(|share| share.slowness).sum());
                assert!((kept / exact - 1.0).abs() < 0.02, "{name} {from_tip}: {kept:e} {exact:e}");
            }
        }
    }
}
