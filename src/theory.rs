//! What the Euler–Bernoulli beam leaves out, and what that costs on this bat.
//!
//! Both shifts are first-order changes of Rayleigh's quotient, from the plain beam's own mode.

use crate::bat::Bat;
use crate::modes::Mode;
use crate::profile::Section;
use crate::solve::Solution;

/// Relative change of a mode's frequency by effects that the model leaves out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shift {
    /// By the sections' own rotary inertia.
    pub rotary_inertia: f64,
    /// By shear, if the material's shear modulus is known.
    pub shear: Option<f64>,
}

/// What rotary inertia and shear would do to a mode's frequency.
///
/// ```text
/// rotary inertia: Δf/f = −½ ∫ρI φ′² dx / ∫ρA φ² dx
/// shear:          Δf/f = −½ ∫Q²/(κGA) dx / ∫EI φ″² dx,   Q(x) = ω² ∫₀ˣ ρA φ dx
/// ```
///
/// with `∫EI φ″² dx = ω² m` for a mode of modal mass m. Midpoint sums over 400 stretches: good
/// to about a hundredth of the shift, while the shift is small.
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
        let section = bat.profile.at(x);
        let load = dx * bat.mass_per_length(section) * mode.shape.deflection(x);
        let turning = bat.material.density * section.second_moment();
        rotary += dx * turning * mode.shape.rotation(x).powi(2);
        let across = mode.omega.powi(2) * (force + 0.5 * load);
        force += load;
        if let Some(modulus) = bat.material.shear_modulus {
            let coefficient = shear_coefficient(bat, section);
            shear += dx * across * across / (coefficient * modulus * section.area());
        }
    }
    let energy = mode.omega.powi(2) * mode.modal_mass;
    Shift {
        rotary_inertia: -0.5 * rotary / mode.modal_mass,
        shear: bat.material.shear_modulus.map(|_| -0.5 * shear / energy),
    }
}

/// The material's κ, else Cowper's for a ring, with ν = 0.3 where it is not known:
/// `κ = 6(1+ν)(1+m²)² / [(7+6ν)(1+m²)² + (20+12ν)m²]`, `m = r_i/r`.
///
/// # Source
///
/// G. R. Cowper, J. Appl. Mech. 33 (1966) 335.
fn shear_coefficient(bat: &Bat, section: Section) -> f64 {
    bat.material.shear_coefficient.unwrap_or_else(|| {
        let nu = bat.material.poisson_ratio.unwrap_or(0.3);
        let m2 = (section.inner / section.outer).powi(2);
        let square = (1.0 + m2).powi(2);
        6.0 * (1.0 + nu) * square / ((7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * m2)
    })
}

/// What the model leaves out and what it costs, a sentence each.
pub fn ignored(bat: &Bat, solution: &Solution) -> Vec<String> {
    let modes = &solution.modes[..solution.modes.len().min(4)];
    let percents = |f: &dyn Fn(&Shift) -> f64| {
        let shifts = modes.iter().map(|mode| shift(bat, mode));
        let shown: Vec<String> = shifts.map(|s| format!("{:.1} %", 100.0 * f(&s))).collect();
        format!("modes 1 to {} by about {}", modes.len(), shown.join(", "))
    };
    let mut ignored = Vec::new();
    if !modes.is_empty() {
        let rotary = percents(&|s| s.rotary_inertia);
        ignored.push(format!("rotary inertia of the sections: would change {rotary}"));
        ignored.push(match bat.material.shear_modulus {
            Some(_) => {
                let shear = percents(&|s| s.shear.unwrap_or(0.0));
                format!("shear: would change {shear} (first order, too large where it is large)")
            }
            None => {
                "shear: not known, the material has no shear modulus; on an ash bat (the R161, \
                     G/E 0.058) it lowers modes 1 to 4 by about 1, 5, 11 and 19 %"
                    .to_owned()
            }
        });
    }
    let inertia = bat.inertia();
    let own = 100.0 * (inertia.about_balance / inertia.line_about_balance - 1.0);
    ignored.push(format!(
        "the sections' own inertia in the hit: this beam recoils as a line of mass, its inertia \
         about the balance point {own:.2} % below the body's"
    ));
    ignored.push("hands: the bat is free; they damp it and hardly move a frequency".to_owned());
    ignored.push("hoop modes of hollow barrels: not a beam's, and not modelled".to_owned());
    ignored
}
