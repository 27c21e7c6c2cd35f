//! The effect of the wall of a hollow barrel in a hit, in words.

use crate::parts::{Fact, Quantity, Units};
use sweetspot::Bat;
use sweetspot::base::number::significant;
use sweetspot::collision::Scene;
use sweetspot::collision::hoop_wall::HoopWall;
use sweetspot::collision::wall_figures::WallFigures;

/// The compliance of the wall, and why it is included.
pub fn wall_words(bat: &Bat, scene: &Scene, wall: &HoopWall) -> String {
    let last = wall.harmonics().into_iter().max().unwrap_or(0);
    let why = scene.gain_by_wall(bat).map_or(String::new(), |gain| {
        format!(": by estimate that is {} of BBCOR", significant(gain, 1))
    });
    format!(
        "the barrel's wall gives way {}, of harmonics 0 and 2 to {last} around it{why}",
        by(wall)
    )
}

/// How a wall gives way.
pub fn by(wall: &HoopWall) -> String {
    let modes = wall.modes().len();
    if modes == 0 { "at once".to_owned() } else { format!("by {modes} hoop modes") }
}

/// The effect of the wall of a hollow barrel at a place, and on BBCOR there.
pub fn wall_facts(wall: &WallFigures, units: Units) -> Vec<Fact> {
    let short = |x: f64| Quantity::Small.said(units, x);
    let [along, around] = wall.patch_half_lengths_m.map(|half| 2.0 * half);
    let [low, high] = wall.bbcor.range;
    let deep =
        wall.is_deep().then(|| ("  more than half the wall", "this theory ends there".to_owned()));
    let lines = [
        ("BBCOR with a stiff wall", format!("{:.3}", wall.bbcor.stiff)),
        ("  ball squeezed twice to half as much", format!("{low:.3} to {high:.3}")),
        (
            "wall under the ball",
            format!(
                "{}, {:.1} times the ball's",
                Quantity::Stiffness.said(units, wall.stiffness_n_m),
                wall.stiffness_over_ball
            ),
        ),
        ("  patch, along and around", format!("{} by {}", short(along), short(around))),
        ("  it dents by", short(wall.dent_m)),
    ];
    let fact = |(label, value)| Fact { key: "", label, value, note: String::new() };
    lines.into_iter().chain(deep).map(fact).collect()
}
