//! The assumptions about a barrel and the limits of its model, in sentences.

use crate::parts::{Quantity, Units};
use sweetspot::Bat;
use sweetspot::base::number::significant;
use sweetspot::beam::wall::elastic::ASSUMED_POISSON_RATIO;
use sweetspot::collision::Ball;
use sweetspot::modes::hoop::{Note, Patch};
use sweetspot_study::ignored::published_damping;
use sweetspot_study::trampoline::barrel::Barrel;

/// A sentence each, without a capital and a full stop at its ends.
pub fn notes(bat: &Bat, barrel: &Barrel, units: Units) -> Vec<String> {
    let mut all: Vec<String> = barrel.hoop().notes().iter().map(|note| said(note, units)).collect();
    if let Some([less, more]) = barrel.by_poisson {
        let [less, more] = [less, more].map(|change| significant(100.0 * change, 2));
        all.push(format!(
            "Poisson's ratio is not known and taken as {ASSUMED_POISSON_RATIO}; one that is 0.05 smaller or larger changes the \
             first hoop mode by {less} or {more} % (\"poisson_ratio\" in the bat file, of every material: without it \
             the beam is computed without shear, which moves BBCOR too)"
        ));
    }
    all.extend(published_damping(bat));
    all.extend(alive(barrel));
    all.extend(dented(barrel));
    all.extend(unpressed(barrel, units));
    all
}

/// Why the wall under the ball is not computed: the ball misses the modelled stretch, or its patch is wider than the
/// part of the stretch on the knob side.
fn unpressed(barrel: &Barrel, units: Units) -> Option<String> {
    if barrel.struck.wall.is_some() {
        return None;
    }
    let (hoop, test) = (barrel.hoop(), &barrel.test);
    let place = |x: f64| place(units, x);
    let ball = format!("the ball at {} from the knob end", place(test.at));
    if !(hoop.from()..=hoop.to()).contains(&test.at) {
        return Some(format!("{ball} does not meet the stretch that is modelled"));
    }
    let Ball { radius_m: radius, .. } = test.ball;
    // How long a patch is does not depend on the barrel's radius.
    let half = Patch::under(test.at, radius, radius, test.ball.patch_compression()).half_length;
    if test.at - half >= hoop.from() {
        return Some(format!("{ball} meets the bat where it is solid: no wall gives way there"));
    }
    let first = hoop.from() + half;
    let needs = match first <= hoop.to() {
        true => format!("a ball from {} on is computed (--at)", place(first)),
        false => format!(
            "the stretch of {} is too short for any place of the ball",
            place(hoop.to() - hoop.from())
        ),
    };
    Some(format!(
        "the wall under {ball} is not computed: the ball presses on {} to either side of it, beyond the \
         beginning of the stretch that is modelled; {needs}",
        place(half)
    ))
}

/// A first mode that reaches the beginning of the stretch.
fn alive(barrel: &Barrel) -> Option<String> {
    let change = barrel.model.clamped_change.filter(|change| change.abs() > barrel.test.tol)?;
    Some(format!(
        "the first hoop mode is not dead where the model begins: clamped there it is {} % higher, and the \
         true one lies between",
        significant(100.0 * change, 2)
    ))
}

/// A dent that is too deep for small motions.
fn dented(barrel: &Barrel) -> Option<String> {
    let (wall, rebound) = (barrel.struck.wall.as_ref()?, barrel.struck.rebound.as_ref()?);
    let share = rebound.dent_m / wall.thickness_m;
    (rebound.dent_m > 0.5 * wall.thickness_m).then(|| {
        format!(
            "the wall is dented by {} of its thickness: beyond half of it the dent is not small, as is \
             assumed here, and a metal may yield",
            significant(share, 2)
        )
    })
}

/// A place along the bat (m).
fn place(units: Units, x: f64) -> String {
    units.beside(format!("{x:.4} m"), Quantity::Length.scale(true).text(x))
}

/// The notes of the solver of the modes.
fn said(note: &Note, units: Units) -> String {
    let place = |x: f64| place(units, x);
    match note {
        Note::ThinWall { at, thickness, radius } => format!(
            "the wall is {} mm thin on a radius of {} mm, {} from the knob end: below 1/300 of the radius \
             digits are lost",
            significant(1e3 * thickness, 2),
            significant(1e3 * radius, 3),
            place(*at)
        ),
        Note::BeginsBeyondStep { at } => format!(
            "the model begins at {} from the knob end: the walls on both sides of the step there do not meet",
            place(*at)
        ),
        Note::BeginsBeyondWood { at } => format!(
            "the model begins at {} from the knob end, where the wood ends: in its grain it is no solid of \
             revolution",
            place(*at)
        ),
        Note::WithoutMasses => "tape and weights on the barrel are left out of its wall: bonded to it, they would make \
                                the hoop modes slower by half their share of its mass"
            .to_owned(),
        Note::OpenTip => "the tip is open: a plug in it (a \"core\" in a region of the last 12 mm) raises the \
                          first hoop mode by about 5 % and moves its largest motion from the tip to the barrel"
            .to_owned(),
    }
}
