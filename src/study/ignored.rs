//! What does a beam theory leave out, and what does that cost on this bat?
//!
//! [`ignored`](fn@ignored) says it in sentences, [`shifts`] in numbers.
//!
//! On a bare bat both shifts come from the plain beam's own mode: rotary inertia adds to the
//! kinetic energy of Rayleigh's quotient, shear to the compliance. With anything on the bat or
//! under it the shear force has parts that the mode alone does not tell, and the theories are
//! solved side by side.

use crate::bat::body::Bat;
use crate::bat::material::Material;
use crate::bat::theory::Theory;
use crate::collision::hit::Scene;
use crate::collision::hoop_wall::{HoopInHit, WhyRigid, barrel_walls};
use crate::modes::mode::Mode;
use crate::modes::solve::{Request, Solution, solve};

/// Relative change of a mode's frequency by effects that the model leaves out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shift {
    /// Relative shift of the frequency by the sections' own rotary inertia.
    pub rotary_inertia: f64,
    /// Relative shift of the frequency by shear; None if the material's shear modulus is not known.
    pub shear: Option<f64>,
}

impl Shift {
    /// How much too high a frequency is without them, relative to the one with all that count.
    pub fn cost(&self, rotary_inertia: bool, shear: bool) -> f64 {
        let left_out = |effect: f64, counts: bool| if counts { 1.0 + effect } else { 1.0 };
        let shear = left_out(self.shear.unwrap_or(0.0), shear);
        1.0 / (left_out(self.rotary_inertia, rotary_inertia) * shear) - 1.0
    }
}

/// What rotary inertia and shear would do to a mode's frequency.
///
/// ```text
/// rotary inertia: f/f₀ = (1 + ∫ρI φ′² dx / ∫ρA φ² dx)^−½
/// shear:          f/f₀ = (1 + ∫Q²/(κGA) dx / ∫EI φ″² dx)^−½,   Q(x) = ω² ∫₀ˣ ρA φ dx
/// ```
///
/// with `∫EI φ″² dx = ω² m` for a mode of modal mass m of a bare bat. Midpoint sums over 400
/// stretches. Right in the first order; on an R161 within a fifth of the shift of modes 1 to 4.
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

/// Frequency shifts of the lowest modes by rotary inertia and shear: of a bare bat by [`shift`], of any
/// other by solving with each theory, to that tolerance.
pub fn shifts(bat: &Bat, modes: &[Mode], tolerance: f64) -> Vec<Shift> {
    let by_modes = || modes.iter().map(|mode| shift(bat, mode)).collect();
    match bat.fixtures().none_moving() {
        true => by_modes(),
        false => solved_shifts(bat, modes.len(), tolerance).unwrap_or_else(by_modes),
    }
}

/// Frequency shifts of the lowest modes by rotary inertia and shear, by solving with each theory to
/// that tolerance; None where a solve fails.
pub fn solved_shifts(bat: &Bat, modes: usize, tolerance: f64) -> Option<Vec<Shift>> {
    let all = |theory| {
        let request = Request { modes, tolerance, theory, ..Request::default() };
        Some(solve(bat, &request).ok()?.modes)
    };
    let [plain, turning] = [all(Theory::EulerBernoulli)?, all(Theory::Rayleigh)?];
    let shearing = if bat.knows_shear() { Some(all(Theory::Timoshenko)?) } else { None };
    let shift = |k: usize| Shift {
        rotary_inertia: turning[k].omega / plain[k].omega - 1.0,
        shear: shearing.as_ref().map(|s| s[k].omega / turning[k].omega - 1.0),
    };
    Some((0..modes).map(shift).collect())
}

/// What a typical material of that kind has for G/E, where it is not known: wood between 0.058 and
/// 0.111 ([`crate::bat::material::BUILT_IN`]), an isotropic metal `1/(2 (1 + ν))`.
fn typical_shear(material: &Material) -> f64 {
    const LIGHT: f64 = 1200.0;
    if material.density < LIGHT { 0.08 } else { 1.0 / (2.0 * 1.33) }
}

/// The bat with a typical shear modulus in every material that has none.
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

/// By how much effects would change the lowest modes, in words.
fn percents(shifts: &[Shift], change: impl Fn(&Shift) -> f64) -> String {
    let digits = |v: f64| match v.abs() {
        size if size >= 0.095 => format!("{v:.1} %"),
        size if size >= 5e-5 => format!("{v:.1e} %"),
        _ => "0 %".to_owned(),
    };
    let shown: Vec<String> = shifts.iter().map(|shift| digits(100.0 * change(shift))).collect();
    match shifts.len() {
        1 => format!("mode 1 by about {}", shown[0]),
        many => format!("modes 1 to {many} by about {}", shown.join(", ")),
    }
}

/// What the model leaves out and what it costs, a sentence each.
pub fn ignored(bat: &Bat, solution: &Solution) -> Vec<String> {
    let modes = &solution.modes[..solution.modes.len().min(4)];
    /// Shifts are shown to two digits.
    const SHOWN: f64 = 1e-6;
    let typical = with_typical_shear(bat);
    let shifts = if solution.theory.shears() { vec![] } else { shifts(&typical, modes, SHOWN) };
    let mut ignored = Vec::new();
    if !modes.is_empty() && !solution.theory.turns() {
        let change = percents(&shifts, |shift| shift.rotary_inertia);
        ignored.push(format!("rotary inertia of the sections: would change {change}"));
    }
    if !modes.is_empty() && !solution.theory.shears() {
        let change = percents(&shifts, |shift| shift.shear.unwrap_or(0.0));
        ignored.push(match bat.knows_shear() {
            true => format!("shear: would change {change}"),
            false => format!(
                "shear: not known, a material has no shear modulus; with the G/E of its kind ({}) \
                 it would change {change}",
                typical_shear(bat.material()).to_string().chars().take(5).collect::<String>()
            ),
        });
    }
    if !solution.theory.turns() && !bat.fixtures().holding() {
        let inertia = bat.inertia();
        let own = 100.0 * (inertia.about_balance / inertia.line_about_balance - 1.0);
        ignored.push(format!(
            "the sections' own inertia in the hit: this beam recoils as a line of mass, its \
             inertia about the balance point {own:.2} % below the body's"
        ));
    }
    if bat.fixtures().damping() {
        ignored.push(
            "damping by hands and absorbers in shapes, nodes and undamped frequencies: the damped \
             frequencies are given beside them"
                .to_owned(),
        );
    }
    if !bat.lossy() {
        let unknown = "damping by the material: no loss factor known, undamped";
        ignored.push(format!("{unknown} (\"loss_factor\" in the bat file)"));
    }
    if bat.fixtures().grip.is_none() {
        ignored.push("hands (add a \"grip\" to the bat file to model them)".to_owned());
    }
    ignored.push(match thinnest_wall(bat) {
        Some(_) => {
            "hoop modes of this hollow barrel: not a beam's; sweetspot hoop has them".to_owned()
        }
        None => "hoop modes of hollow barrels: not a beam's, and not modelled".to_owned(),
    });
    ignored
}

/// The thinnest wall (m) of the outer half of the bat, where a ball is hit, and its place (m); None
/// where that half is solid, as [`barrel_walls`] says.
pub fn thinnest_wall(bat: &Bat) -> Option<[f64; 2]> {
    barrel_walls(bat).into_iter().min_by(|a, b| a[0].total_cmp(&b[0]))
}

/// What a hit on this bat leaves out, a sentence each: how the wall of a hollow barrel gives way, where
/// it is taken as rigid.
///
/// # Source
///
/// For the direction: A. M. Nathan, D. A. Russell, L. V. Smith, "The physics of the trampoline effect
/// in baseball and softball bats", Engineering of Sport 5 (2004).
pub fn in_hit(bat: &Bat, scene: &Scene) -> Vec<String> {
    let rigid = thinnest_wall(bat).filter(|_| !scene.wall_gives_way());
    let Some([wall, x]) = rigid else { return vec![] };
    let barrel = format!(
        "the wall of this hollow barrel ({:.1} mm at its thinnest, {:.0} cm from the knob) is rigid here",
        1e3 * wall,
        100.0 * x
    );
    let faster = "a thin one gives way under the ball and spares it a loss, so that the ball leaves \
                  faster and BBCOR is larger than computed";
    let given = "--wall-stiffness and --wall-mass put in what is known of it";
    vec![match &scene.hoop {
        HoopInHit::LeftOut(WhyRigid::Small { gain, tolerance }) => format!(
            "{barrel}: giving way it would change BBCOR by about {gain:.0e}, less than the \
             {tolerance:.0e} asked for; --wall on counts its hoop modes"
        ),
        HoopInHit::LeftOut(WhyRigid::Asked) => {
            format!("{barrel}: {faster}; --wall auto counts its hoop modes")
        }
        HoopInHit::LeftOut(WhyRigid::ModesTold) => format!(
            "{barrel}: {faster}; a number of modes was told and nothing else is counted, but --wall on \
             counts its hoop modes"
        ),
        HoopInHit::LeftOut(WhyRigid::ManyBats) => {
            format!("{barrel}, as many bats are compared: {faster}; hit counts its hoop modes")
        }
        HoopInHit::LeftOut(WhyRigid::Unsolved(why)) => {
            format!("{barrel}: {faster}; its hoop modes could not be found ({why}), {given}")
        }
        HoopInHit::None | HoopInHit::Counted(_) => format!("{barrel}: {faster}; {given}"),
    }]
}
