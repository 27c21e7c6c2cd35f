//! What do rotary inertia and shear do to the frequencies of a bat?
//!
//! On a bare bat both shifts follow from the plain beam's mode: rotary inertia adds to the kinetic energy of Rayleigh's
//! quotient, shear to the compliance. With fixtures the shear force has parts that do not follow from the mode, and the
//! bat is solved with each theory.

use crate::bat::{Bat, Material, Theory};
use crate::modes::mode::Mode;
use crate::modes::refine::refine;
use crate::modes::request::Request;

/// Relative change of a mode's frequency by effects that the model leaves out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shift {
    /// Relative shift of the frequency by the sections' own rotary inertia.
    pub rotary_inertia: f64,
    /// Relative shift of the frequency by shear; None if the material's shear modulus is not known.
    pub shear: Option<f64>,
}

impl Shift {
    /// Relative excess of a frequency without these effects over the frequency with all effects that matter.
    pub fn cost(&self, rotary_inertia: bool, shear: bool) -> f64 {
        let left_out = |effect: f64, counts: bool| if counts { 1.0 + effect } else { 1.0 };
        let shear = left_out(self.shear.unwrap_or(0.0), shear);
        1.0 / (left_out(self.rotary_inertia, rotary_inertia) * shear) - 1.0
    }
}

/// Shift of a mode's frequency by rotary inertia and by shear.
///
/// ```text
/// rotary inertia: f/f₀ = (1 + ∫ρI φ′² dx / ∫ρA φ² dx)^−½
/// shear:          f/f₀ = (1 + ∫Q²/(κGA) dx / ∫EI φ″² dx)^−½,   Q(x) = ω² ∫₀ˣ ρA φ dx
/// ```
///
/// with `∫EI φ″² dx = ω² m` for a mode of modal mass m of a bare bat. The integrals are midpoint sums over 400
/// stretches. The shifts are correct to first order: within a fifth of the true shift for modes 1 to 4 of an R161.
///
/// # Source
///
/// Rayleigh's quotient, with kinetic energy `½ ∫ρI θ̇²` and complementary energy `½ ∫Q²/(κGA)`
/// added: S. Timoshenko, Philos. Mag. 41 (1921) 744.
pub fn shift(bat: &Bat, mode: &Mode) -> Shift {
    const STRETCHES: usize = 400;
    let dx = bat.length() / STRETCHES as f64;
    let (mut rotary, mut shear, mut force) = (0.0, 0.0, 0.0);
    for k in 0..STRETCHES {
        let x = (k as f64 + 0.5) * dx;
        let worth = bat.worth_at(x);
        let load = dx * worth.mass * mode.shape.deflection(x);
        rotary += dx * worth.turning * mode.shape.rotation(x).powi(2);
        let across = mode.omega.powi(2) * (force + 0.5 * load);
        force += load;
        shear += dx * across * across / worth.shear;
    }
    let energy = mode.omega.powi(2) * mode.modal_mass;
    let lower = |share: f64| (1.0 + share).powf(-0.5) - 1.0;
    Shift {
        rotary_inertia: lower(rotary / mode.modal_mass),
        shear: bat.knows_shear().then_some(lower(shear / energy)),
    }
}

/// Frequency shifts of the lowest modes by rotary inertia and shear: for a bare bat by [`shift`], for others by solving
/// with each theory to that tolerance.
pub fn shifts(bat: &Bat, modes: &[Mode], tolerance: f64) -> Vec<Shift> {
    let by_modes = || modes.iter().map(|mode| shift(bat, mode)).collect();
    match bat.fixtures().none_moving() {
        true => by_modes(),
        false => solved_shifts(bat, modes.len(), tolerance).unwrap_or_else(by_modes),
    }
}

/// Frequency shifts of the lowest modes by rotary inertia and shear, by solving with each theory to that tolerance;
/// `None` if a solve fails.
pub fn solved_shifts(bat: &Bat, modes: usize, tolerance: f64) -> Option<Vec<Shift>> {
    let all = |theory| {
        let request = Request { modes, tolerance, theory, ..Request::default() };
        Some(refine(bat, &request).ok()?.modes)
    };
    let [plain, turning] = [all(Theory::EulerBernoulli)?, all(Theory::Rayleigh)?];
    let shearing = if bat.knows_shear() { Some(all(Theory::Timoshenko)?) } else { None };
    let shift = |k: usize| Shift {
        rotary_inertia: turning[k].omega / plain[k].omega - 1.0,
        shear: shearing.as_ref().map(|s| s[k].omega / turning[k].omega - 1.0),
    };
    Some((0..modes).map(shift).collect())
}

/// Typical G/E of a material whose G is not known: for wood between 0.058 and 0.111
/// ([`crate::bat::material::BUILT_IN`]), for an isotropic metal `1/(2 (1 + ν))`.
pub fn typical_shear(material: &Material) -> f64 {
    const LIGHT: f64 = 1200.0;
    if material.density < LIGHT { 0.08 } else { 1.0 / (2.0 * 1.33) }
}

/// The bat with a typical shear modulus for every material that has none.
pub fn with_typical_shear(bat: &Bat) -> Bat {
    let with = bat.with(|parts| {
        let regions = parts.fixtures.regions.iter_mut();
        let layups = regions.flat_map(|region| region.layup.materials_mut());
        for material in std::iter::once(&mut parts.material).chain(layups) {
            let typical = typical_shear(material) * material.youngs_modulus;
            material.shear_modulus.get_or_insert(typical);
        }
    });
    with.expect("a bat whose shear modulus is known is a bat")
}
