//! What are the lowest modes of the wall in one harmonic, on one mesh?

use crate::base::error::{Error, Result};
use crate::base::golden;
use crate::base::linear::dot;
use crate::beam::wall::unknowns::{EndHold, Unknowns};
use crate::eigen::fronts::Fronts;
use crate::eigen::lanczos::{Lanczos, Space, Wanted};
use crate::modes::hoop::system::{System, Wall};

/// Modes of one harmonic on one mesh.
#[derive(Debug, Clone)]
pub struct Spectrum {
    /// The wall in this harmonic.
    pub system: System,
    /// The factors of the stiffness (for n = 1 of `K + shift M`).
    pub factors: Fronts,
    /// Angular frequencies (rad/s), rising, from the strains or from the iteration.
    pub omegas: Vec<f64>,
    /// Motions in all unknowns, `xᵀMx = 1` without the factor π.
    pub motions: Vec<Vec<f64>>,
    /// Loss factors: those of the materials, weighted by the strain energies.
    pub losses: Vec<f64>,
    /// The rigid motion along the bat that harmonic 0 has, of mass 1, and M times it.
    pub rigid: Option<(Vec<f64>, Vec<f64>)>,
    /// Shift of the factors (1/s²).
    shift: f64,
    /// Number of rigid motions among the lowest that the iteration finds.
    skipped: usize,
}

/// Which figures of the modes are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Figures {
    /// Their frequencies, from the iteration.
    Frequencies,
    /// Motions too.
    Motions,
    /// Motions, and frequencies and loss factors from the strains.
    Strains,
}

/// Why a wall cannot be solved.
const TOO_THIN: &str = "round-off makes it indefinite; the wall is too thin for its radius, or \
                        a layer far softer than the others";

/// Modes of a high harmonic lie close together: half a wave more along the bat changes little beside many around it.
/// This many may have to be distinguished from the last wanted one.
const CLUSTERED: usize = 40;

/// Shift of harmonic 1 (1/s²), which has rigid motions: about 100 Hz.
const SHIFT: f64 = 4e5;

impl Spectrum {
    /// The wall with its factors, before any modes. Harmonic 0 is held at one place along the bat; harmonic 1 is
    /// shifted.
    ///
    /// # Errors
    ///
    /// [`Error::Factorization`] where round-off makes the stiffness indefinite.
    pub fn new(wall: &Wall, n: usize, ends: [EndHold; 2]) -> Result<Self> {
        let system = System::new(wall, n, ends);
        let shift = if n == 1 { SHIFT } else { 0.0 };
        let factors = system.factors(shift);
        if !factors.pivots().iter().all(|pivot| *pivot > 0.0 && pivot.is_finite()) {
            let unknowns = system.unknowns.count;
            return Err(Error::Factorization { unknowns, reason: TOO_THIN });
        }
        let rigid = (system.unknowns.held > 0).then(|| rigid_along(&system));
        let skipped = if n == 1 { rigid_motions(n, ends) } else { 0 };
        let (omegas, motions, losses) = (vec![], vec![], vec![]);
        Ok(Self { system, factors, shift, omegas, motions, losses, rigid, skipped })
    }

    /// The `count` lowest modes to that residual, without rigid ones; frequencies from the strains.
    ///
    /// # Errors
    ///
    /// [`Error::NotConverged`] if a mode does not converge; as [`Self::new`].
    pub fn of(
        wall: &Wall,
        n: usize,
        ends: [EndHold; 2],
        count: usize,
        residual: f64,
    ) -> Result<Self> {
        let mut spectrum = Self::new(wall, n, ends)?;
        spectrum.solve(count, residual, Figures::Strains)?;
        Ok(spectrum)
    }

    /// The frequencies alone, from the iteration.
    ///
    /// # Errors
    ///
    /// As [`Self::of`].
    pub fn frequencies(
        wall: &Wall,
        n: usize,
        ends: [EndHold; 2],
        count: usize,
        residual: f64,
    ) -> Result<Vec<f64>> {
        let mut spectrum = Self::new(wall, n, ends)?;
        spectrum.solve(count, residual, Figures::Frequencies)?;
        Ok(spectrum.omegas)
    }

    /// Lanczos on `D^{−½} L⁻¹ M L⁻ᵀ D^{−½}` of `K = L D Lᵀ`; the rigid motion of harmonic 0 is removed before M is
    /// applied.
    ///
    /// # Errors
    ///
    /// [`Error::NotConverged`] if a mode does not converge.
    pub fn solve(&mut self, count: usize, residual: f64, figures: Figures) -> Result<()> {
        let (system, factors) = (&self.system, &self.factors);
        let (size, all) = (system.unknowns.count, system.unknowns.all());
        let scale: Vec<f64> = factors.pivots().iter().map(|d| 1.0 / d.sqrt()).collect();
        let back = |z: &[f64], x: &mut [f64]| {
            x[..size].iter_mut().zip(z).zip(&scale).for_each(|((x, z), s)| *x = z * s);
            x[size..].fill(0.0);
            factors.backward(&mut x[..size]);
            if let Some((motion, momentum)) = &self.rigid {
                let part = dot(momentum, x);
                x.iter_mut().zip(motion).for_each(|(x, r)| *x -= part * r);
            }
        };
        let mut lanczos = Lanczos::<f64>::default();
        let total = (count + self.skipped).min(size);
        let wanted = Wanted { count: total, residual, earliest: 8, clustered: CLUSTERED };
        let space = Space { known: &[], allow: &mut |_| {} };
        let (mut x, mut y) = (vec![0.0; all], vec![0.0; all]);
        lanczos.largest(size, wanted, space, start, |z, image| {
            back(z, &mut x);
            system.mass(&x, &mut y);
            factors.forward(&mut y[..size]);
            image.iter_mut().zip(&y).zip(&scale).for_each(|((image, y), s)| *image = y * s);
        })?;
        let pairs = lanczos.vectors.chunks_exact(size).zip(&lanczos.values);
        for (z, value) in pairs.skip(self.skipped) {
            self.omegas.push((1.0 / value - self.shift).sqrt());
            if figures == Figures::Frequencies {
                continue;
            }
            back(z, &mut x);
            let mut mass = *value;
            if figures == Figures::Strains {
                let (strain, moved) = system.energies(&x);
                mass = moved;
                let stored: f64 = strain.iter().sum();
                let of = system.materials.iter();
                let lost: f64 = strain.iter().zip(of).map(|(s, m)| s * m.loss_factor).sum();
                *self.omegas.last_mut().expect("just pushed") = (stored / mass).sqrt();
                self.losses.push(lost / stored);
            }
            let scale = 1.0 / mass.sqrt();
            self.motions.push(x.iter().map(|x| x * scale).collect());
        }
        Ok(())
    }
}

impl Spectrum {
    /// Radial motion of the outer surface at `x` (m) in a mode.
    pub fn radial(&self, mode: usize, x: f64) -> f64 {
        self.system.surface(&self.motions[mode], x)[0]
    }

    /// Keeps some of the modes.
    pub fn keep(&mut self, kept: &[bool]) {
        keep(&mut self.omegas, kept);
        keep(&mut self.motions, kept);
        keep(&mut self.losses, kept);
    }
}

/// Keeps some of a list.
pub fn keep<T>(list: &mut Vec<T>, kept: &[bool]) {
    let mut kept = kept.iter();
    list.retain(|_| kept.next() == Some(&true));
}

/// The start vector: numbers that favour no mode.
fn start(z: &mut [f64]) {
    z.iter_mut().enumerate().for_each(|(k, z)| *z = golden::fraction(k) - 0.5);
}

/// Number of rigid motions of harmonic n with these ends.
pub fn rigid_motions(n: usize, ends: [EndHold; 2]) -> usize {
    match n {
        0 => usize::from(ends.iter().all(|end| *end != EndHold::Clamped)),
        1 => ends.iter().filter(|end| **end == EndHold::Free).count(),
        _ => 0,
    }
}

/// Number of modes of harmonic n below `omega` (rad/s), from the signs of the pivots of `K − ω²M`.
pub fn count_below(wall: &Wall, n: usize, ends: [EndHold; 2], omega: f64) -> usize {
    let unknowns = Unknowns::free(&wall.mesh, n, ends);
    let below = System::with(wall, n, unknowns).count_below(omega * omega);
    below.saturating_sub(rigid_motions(n, ends))
}

/// The rigid motion along the bat in all unknowns, scaled to mass 1, and M times it.
fn rigid_along(system: &System) -> (Vec<f64>, Vec<f64>) {
    let all = system.unknowns.all();
    let mut motion = vec![0.0; all];
    let mesh = &system.mesh;
    for (border, range) in mesh.borders.iter().zip(&mesh.at_border) {
        for function in range.clone().take(border.len()) {
            if let Some((unknown, share)) = system.unknowns.of[function][2] {
                motion[unknown] = share;
            }
        }
    }
    let mut momentum = vec![0.0; all];
    system.mass(&motion, &mut momentum);
    let scale = 1.0 / dot(&motion, &momentum).sqrt();
    motion.iter_mut().chain(&mut momentum).for_each(|x| *x *= scale);
    (motion, momentum)
}
