//! What the Euler–Bernoulli beam leaves out, and what that costs on this bat.
//!
//! Both shifts are first-order changes of Rayleigh's quotient, from the plain beam's own mode.

use crate::bat::Bat;
use crate::modes::Mode;
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
        let worth = bat.worth_at(x);
        let load = dx * worth.mass * mode.shape.deflection(x);
        rotary += dx * worth.turning * mode.shape.rotation(x).powi(2);
        let across = mode.omega.powi(2) * (force + 0.5 * load);
        force += load;
        shear += dx * across * across / worth.shear;
    }
    let energy = mode.omega.powi(2) * mode.modal_mass;
    Shift {
        rotary_inertia: -0.5 * rotary / mode.modal_mass,
        shear: bat.knows_shear().then_some(-0.5 * shear / energy),
    }
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
        ignored.push(match bat.knows_shear() {
            true => {
                let shear = percents(&|s| s.shear.unwrap_or(0.0));
                format!("shear: would change {shear} (first order, too large where it is large)")
            }
            false => {
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
