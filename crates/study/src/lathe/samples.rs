//! How do frequencies, mass, balance point and swing weight change with the radius along the bat?
//!
//! Rayleigh's quotient is stationary in the motion, so only the sections vary. With the modal mass `m` of a motion `w`,
//! rotation θ and shear strain `γ = w′ − θ`,
//!
//! ```text
//! δω² = (1/m) ∫ [δEI θ′² + δκGA γ² − ω² (δρA w² + δρI θ²)] dx,        δf = δω²/(8π² f),
//! ```
//!
//! where a theory without shear has no γ, and one without rotary inertia no ρI. A held bat has the same formula with
//! its own motion. A mass δm at x, with its centre `d` beyond, changes f by `−f (w + dθ)² δm/(2m)`. The rigid body:
//!
//! ```text
//! δM = ∫ δρA dx,    δx_b = ∫ (x − x_b) δρA dx/M,    δI = ∫ [(x − p)² δρA + δρI] dx about p,
//! δ(I/S) = δI/S − I δS/S²,    S = ∫ (x − p) ρA dx
//! ```
//!
//! # Source
//!
//! Lord Rayleigh, The Theory of Sound (2nd ed. 1894), section 90: to the first order of a change, periods follow
//! from the energies of the unchanged type.

use std::f64::consts::PI;

use crate::engine::{Bat, Inertia, Mode, Solution, Theory, Worth, gauss};
use sweetspot::beam::mesh::ElementPart;

/// A place along the bat at which integrals are sampled.
#[derive(Debug, Clone, Copy)]
struct SlopeSample {
    /// From the knob end (m).
    x: f64,
    /// Weight of the sample (m).
    weight: f64,
    /// The element, and the position in it, from −1 to 1.
    at: (usize, f64),
    /// Derivatives of the section's values per metre of outer and of inner radius.
    slopes: [Worth; 2],
}

/// The bat's sections at the points of a quadrature between all its borders.
#[derive(Debug, Clone)]
pub struct SectionSlopes {
    all: Vec<SlopeSample>,
    body: Inertia,
    theory: Theory,
}

/// How the rigid body changes with a change of the radius.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BodySlope {
    /// Mass (kg).
    pub mass: f64,
    /// Balance point from the knob end (m).
    pub balance_point: f64,
    /// Moment of inertia about the given pivot (kg m²).
    pub inertia: f64,
    /// Centre of percussion of a swing about that pivot (m); None if the bat balances there.
    pub center_of_percussion: Option<f64>,
}

impl SectionSlopes {
    /// Those of a bat with its modes.
    pub fn new(bat: &Bat, solution: &Solution) -> Self {
        // Sections to the ninth degree, twice the motion, a cubic change of the radius.
        let rule = gauss(solution.degree + 8);
        let mut all = vec![];
        for (k, element) in solution.mesh.elements.iter().enumerate() {
            for ElementPart { piece, of_piece: [from, to], of_element: [begin, end] } in
                element.parts(bat)
            {
                let piece = &bat.profile().pieces[piece];
                let layup = bat.layup(piece);
                all.extend(rule.iter().map(|&(s, weight)| {
                    let of_element = begin + (end - begin) * s;
                    SlopeSample {
                        x: element.start + element.length * of_element,
                        weight: weight * (end - begin) * element.length,
                        at: (k, 2.0 * of_element - 1.0),
                        slopes: layup.slopes(piece.at(from + (to - from) * s)),
                    }
                }));
            }
        }
        Self { all, body: bat.inertia(), theory: solution.theory }
    }

    /// Change of a mode's frequency (Hz) and its error, for a change of the outer and of the inner radius (m) along the
    /// bat: a function of the place (m from the knob end), smooth between the bat's borders.
    pub fn frequency(&self, mode: &Mode, change: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
        let (mut sum, mut size) = (0.0, 0.0);
        for sample in &self.all {
            let by = change(sample.x);
            if by == [0.0; 2] {
                continue;
            }
            let strains = mode.shape.strains(sample.at.0, sample.at.1);
            for (by, slope) in by.into_iter().zip(sample.slopes) {
                let [density, parts] = density(self.theory, mode, strains, slope);
                sum += sample.weight * by * density;
                size += (sample.weight * by * parts).abs();
            }
        }
        // The parts are proportional to the square of the motion, and the modal mass has its own error.
        let off = 2.0 * mode.error.shape + mode.error.modal_mass + mode.error.round_off;
        [sum, size * off + 1e-13 * size]
    }

    /// Change of the rigid body for a change of outer and inner radius (m), about that pivot (m from the knob).
    pub fn body(&self, pivot: f64, change: impl Fn(f64) -> [f64; 2]) -> BodySlope {
        let Inertia { mass, balance_point, .. } = self.body;
        let [mut more, mut moment, mut inertia] = [0.0; 3];
        for SlopeSample { x, weight, slopes, .. } in &self.all {
            for (by, slope) in change(*x).into_iter().zip(slopes) {
                let here = weight * by * slope.mass;
                more += here;
                moment += here * (x - balance_point);
                inertia += here * (x - pivot).powi(2) + weight * by * slope.turning;
            }
        }
        let arm = mass * (balance_point - pivot);
        let tilt = moment + more * (balance_point - pivot);
        let percussion = inertia / arm - self.body.about(pivot) * tilt / (arm * arm);
        BodySlope {
            mass: more,
            balance_point: moment / mass,
            inertia,
            center_of_percussion: percussion.is_finite().then_some(percussion),
        }
    }

    /// Sampling points of the integrals (m from the knob end), rising.
    pub fn places(&self) -> impl Iterator<Item = f64> {
        self.all.iter().map(|sample| sample.x)
    }
}

/// Change of a mode's frequency per metre of outer radius and metre of length at `x` (Hz/m²).
pub fn frequency_density(bat: &Bat, solution: &Solution, mode: &Mode, x: f64) -> f64 {
    let slope = bat.layup(bat.profile().piece_at(x)).slopes(bat.profile().at(x))[0];
    let (k, xi) = mode.shape.locate(x);
    density(solution.theory, mode, mode.shape.strains(k, xi), slope)[0]
}

/// Change of a mode's frequency (Hz) per kg fixed at `x`, with its centre `offset` (m) beyond, and per kg m² of its own
/// inertia.
pub fn by_added_mass(mode: &Mode, x: f64, offset: f64) -> [f64; 2] {
    let (w, turn) = (mode.shape.deflection(x), mode.shape.rotation(x));
    let unit = -0.5 * mode.frequency() / mode.modal_mass;
    [unit * (w + offset * turn).powi(2), unit * turn * turn]
}

/// `δf` per length of bat for sections with these slopes, and the sum of the absolute values of its parts.
fn density(theory: Theory, mode: &Mode, [w, turn, bend, slip]: [f64; 4], by: Worth) -> [f64; 2] {
    let (f, squared) = (mode.frequency(), mode.omega * mode.omega);
    let unit = 1.0 / (8.0 * PI * PI * f * mode.modal_mass);
    let shear = if theory.shears() { by.shear * slip * slip } else { 0.0 };
    let turning = if theory.turns() { by.turning * turn * turn } else { 0.0 };
    let (strain, kinetic) = (by.bending * bend * bend + shear, by.mass * w * w + turning);
    [unit * (strain - squared * kinetic), unit * (strain.abs() + squared * kinetic.abs())]
}
