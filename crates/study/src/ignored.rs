//! What does a beam theory leave out, and how large is the effect on this bat?
//!
//! [`ignored`](fn@ignored) gives it in sentences, [`shifts`] in numbers.

pub use sweetspot::modes::shifts::{Shift, shift, shifts, solved_shifts, with_typical_shear};

use crate::engine::{
    ASSUMED_LOSS, Bat, HoopInHit, Material, Scene, Solution, WhyRigid, barrel_walls, rings,
    typical_shear,
};

/// The shifts of the lowest modes by an effect, in words.
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

/// Beginning of the sentence about shear.
pub(crate) const SHEAR: &str = "shear: ";

/// The effects that the model leaves out, with their size, one sentence each.
pub fn ignored(bat: &Bat, solution: &Solution) -> Vec<String> {
    let bat = solution.of(bat);
    let modes = &solution.modes[..solution.modes.len().min(4)];
    /// Tolerance of the shifts, which are shown to two digits.
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
            true => format!("{SHEAR}would change {change}"),
            false => format!(
                "{SHEAR}not known, a material has no shear modulus; with the G/E of its kind ({}) \
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
    ignored.extend(material_damping(bat));
    if bat.fixtures().grip.is_none() {
        ignored.push("hands (add a \"grip\" to the bat file to model them)".to_owned());
    }
    let hoops = match (thinnest_wall(bat), rings(bat)) {
        (Some(_), true) => "this hollow barrel: not a beam's; sweetspot hoop has them",
        (Some(_), false) => "this hollow barrel: not a beam's, and in wood not modelled",
        (None, _) => "hollow barrels: not a beam's, and not modelled",
    };
    ignored.push(format!("hoop modes of {hoops}"));
    ignored
}

/// The omitted part of the damping by the materials.
fn material_damping(bat: &Bat) -> Vec<String> {
    let mut materials = bat.layups().iter().flat_map(|layup| layup.materials());
    let undamped = materials.any(|m| m.losses() == [0.0; 2]);
    match bat.lossy() {
        true => published_damping(bat)
            .into_iter()
            .chain(undamped.then(|| "damping by a material that has no loss factor".to_owned()))
            .collect(),
        false => vec![
            "damping by the material: no loss factor known, undamped (\"loss_factor\" in the bat file, or --damping \
             assumed for a metal)"
                .to_owned(),
        ],
    }
}

/// A note about a metal with the published loss factor of its kind.
pub fn published_damping(bat: &Bat) -> Option<String> {
    let mut materials = bat.layups().iter().flat_map(|layup| layup.materials());
    let published = |m: &Material| m.published_loss().filter(|loss| m.losses() == [*loss; 2]);
    let loss = materials.find_map(published)?;
    Some(format!(
        "damping by grip, plugs and joints: the loss factor {loss} of the metal is that of aluminium alone \
         (sweetspot materials names its source)"
    ))
}

/// The assumed damping in the sound of a bat whose materials have no loss factor, in words; `None` if all have one.
pub fn damping_in_sound(bat: &Bat) -> Option<String> {
    let materials = || bat.layups().iter().flat_map(|layup| layup.materials());
    let mut taken: Vec<(bool, f64)> = (materials().filter(|material| material.loss_factor == 0.0))
        .map(|m| (m.published_loss().is_some(), m.published_loss().unwrap_or(ASSUMED_LOSS)))
        .collect();
    taken.sort_by_key(|(published, _)| !published);
    taken.dedup();
    let told = |(published, loss): &(bool, f64)| match published {
        true => format!("{loss} for the metal, as published of aluminium"),
        false => format!("an assumed {loss} for all else"),
    };
    let told: Vec<String> = taken.iter().map(told).collect();
    let told = (!told.is_empty()).then(|| told.join(" and "))?;
    Some(format!("a material has no loss factor: the sound alone takes {told}"))
}

/// The thinnest wall (m) of the outer half of the bat, where balls are hit, and its place (m); `None` if that half is
/// solid, by [`barrel_walls`].
pub fn thinnest_wall(bat: &Bat) -> Option<[f64; 2]> {
    barrel_walls(bat).into_iter().min_by(|a, b| a[0].total_cmp(&b[0]))
}

/// The effects that a hit on this bat leaves out, one sentence each: the wall of a hollow barrel, if it is taken as
/// rigid.
///
/// # Source
///
/// For the direction: A. M. Nathan, D. A. Russell, L. V. Smith, "The physics of the trampoline effect
/// in baseball and softball bats", Engineering of Sport 5 (2004).
pub fn in_hit(bat: &Bat, scene: &Scene) -> Vec<String> {
    published_damping(bat).into_iter().chain(wall_left_out(bat, scene)).collect()
}

/// The note about the wall of a hollow barrel that is taken as rigid.
pub fn wall_left_out(bat: &Bat, scene: &Scene) -> Option<String> {
    let rigid = thinnest_wall(bat).filter(|_| !scene.wall_gives_way());
    let [wall, x] = rigid?;
    let barrel = format!(
        "the wall of this hollow barrel ({:.1} mm at its thinnest, {:.0} cm from the knob) is rigid here",
        1e3 * wall,
        100.0 * x
    );
    let faster = "a thin one gives way under the ball and spares it a loss, so that the ball leaves \
                  faster and BBCOR is larger than computed";
    let given = "--wall-stiffness and --wall-mass put in what is known of it";
    Some(match &scene.hoop {
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
    })
}
