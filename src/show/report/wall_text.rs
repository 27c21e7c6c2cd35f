//! What a hollow barrel's wall does in a hit, in words.

use crate::base::number::significant;
use crate::base::units::inches;
use crate::bat::body::Bat;
use crate::collision::hit::Scene;
use crate::collision::hoop_wall::HoopWall;
use crate::collision::wall_figures::{WallBbcor, WallFigures};
use crate::show::report::units::Units;

/// What of the wall gives way, and why it is counted.
pub fn wall_words(bat: &Bat, scene: &Scene, wall: &HoopWall) -> String {
    let modes = wall.hoop().modes();
    let last = modes.iter().map(|mode| mode.harmonic).max().unwrap_or(0);
    let why = scene.gain_by_wall(bat).map_or(String::new(), |gain| {
        format!(": by estimate that is {} of BBCOR", significant(gain, 1))
    });
    format!(
        "the barrel's wall gives way by {} hoop modes of its own, of harmonics 0 and 2 to {last} around \
         it{why}",
        modes.len()
    )
}

/// What a hollow barrel's wall does at a place, and to that BBCOR there: names and values.
pub fn wall_lines(wall: &WallFigures, bbcor: WallBbcor, units: Units) -> Vec<[String; 2]> {
    let short = |x: f64| units.inline(units.show(millimetres(x), format!("{:.2} in", inches(x))));
    let [along, around] = wall.patch.map(|half| 2.0 * half);
    let [low, high] = bbcor.range;
    let deep =
        wall.is_deep().then(|| ("  more than half the wall", "this theory ends there".to_owned()));
    let lines = [
        ("BBCOR with a stiff wall", format!("{:.3}", bbcor.stiff)),
        ("  ball squeezed twice to half as much", format!("{low:.3} to {high:.3}")),
        (
            "wall under the ball",
            format!("{:.1} MN/m, {:.1} times the ball's", 1e-6 * wall.stiffness, wall.over_ball),
        ),
        ("  patch, along and around", format!("{} by {}", short(along), short(around))),
        ("  it dents by", short(wall.dent)),
    ];
    lines.into_iter().chain(deep).map(|(what, value)| [what.to_owned(), value]).collect()
}

fn millimetres(x: f64) -> String {
    format!("{:.1} mm", 1e3 * x)
}
