//! A hit in words.

use std::fmt::Write;

use crate::parts::{Quantity, Units, wrapped};
use crate::report::wall_text::{wall_facts, wall_words};
use crate::report::{curve, edits};
use sweetspot::Bat;
use sweetspot::base::units::gravities;
use sweetspot::collision::figures::{BarrelSpeed, Figures};
use sweetspot::collision::sweet_spot::Peak;
use sweetspot::collision::{Impact, Model, Scene, Sweep, SweetSpot, hit::Wall};
use sweetspot_study::ignored;

/// The flags of hits, their letters in the table, and their meaning.
const FLAGS: [(&str, char, &str); 8] = [
    ("reload", 'r', "pressed again while it was springing back"),
    ("late_contact", 'l', "the bat caught up when the force had almost gone"),
    ("second_contact", 's', "hit again after it left; the speed is that in the end"),
    ("ball_law_beyond", 'b', "not measured for such a hit (docs/limits.md)"),
    ("no_contact", 'n', "the bat runs away from the ball"),
    ("no_section", 'p', "the bat ends in a point"),
    ("no_real_solution", 'i', "the model has no real solution"),
    ("unresolved", 'u', "not resolved: the energies do not close"),
];

/// The letters of the flags of a hit.
pub fn letters(impact: &Impact) -> String {
    FLAGS.iter().filter(|flag| impact.flags.contains(&flag.0)).map(|flag| flag.1).collect()
}

/// A line for every flag that hits have.
pub fn legend(impacts: &[Impact]) -> Vec<String> {
    let has = |flag: &&(&str, char, &str)| impacts.iter().any(|i| i.flags.contains(&flag.0));
    let line = |(name, letter, words): &(&str, char, &str)| {
        format!("{letter}  {}: {words}", name.replace('_', " "))
    };
    FLAGS.iter().filter(has).map(line).collect()
}

/// Some of many impacts: a few at equal distances, and the nearest to the best place.
pub fn some(impacts: &[Impact], best: Option<f64>) -> Vec<Impact> {
    const FEW: usize = 7;
    let step = impacts.len().div_ceil(FEW);
    let off = |k: &usize| best.map_or(f64::INFINITY, |best| (impacts[*k].x - best).abs());
    let near = (0..impacts.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
    let shown = |k: &usize| k.is_multiple_of(step) || best.is_some() && near == Some(*k);
    (0..impacts.len()).filter(shown).map(|k| impacts[k].clone()).collect()
}

/// Exit speed along the barrel, drawn.
pub fn curve(impacts: &[Impact], units: Units) -> String {
    let us = units.us_first();
    let [fast, far] = [Quantity::Speed, Quantity::Length].map(|of| of.scale(us).per);
    let places: Vec<f64> = impacts.iter().map(|i| far * i.x).collect();
    let exit = |i: &Impact| i.outcome.as_ref().map(|o| fast * o.exit_speed);
    let ours: Vec<_> = impacts.iter().map(exit).collect();
    let rigid: Vec<_> = impacts.iter().map(|i| i.rigid_exit_speed.map(|v| fast * v)).collect();
    let wall = |impact: &Impact| impact.outcome.as_ref().is_some_and(|o| o.energy.wall > 0.0);
    let stiff = match impacts.iter().any(wall) {
        true => "if it and its wall were stiff",
        false => "if it did not bend",
    };
    let [speed, place] = if us { ["mph", "in"] } else { ["m/s", "cm"] };
    let label = format!("exit speed, {speed} (* this bat, . {stiff})");
    let labels = [&label, &format!("{place} from the knob")];
    curve::draw(&places, [(&rigid, '.'), (&ours, '*')], labels.map(String::as_str), [66, 15])
}

/// Why the exit speed is highest where it is; None without such a place.
pub fn reason(figures: &Figures, units: Units) -> Option<String> {
    let place = |x: f64| Quantity::Length.said(units, x);
    let (peak, rigid) = (figures.spot.exit_speed_max?, figures.rigid_best?);
    if let Some(text) = lives_on_later(figures, units) {
        return Some(text);
    }
    let here = figures.best.as_ref().and_then(|best| best.outcome.as_ref());
    let (Some(there), Some(here)) = (figures.vibration_at_rigid_best, here) else {
        let text =
            "Why there: further out recoil takes more than the bat's speed there makes up for.";
        return Some(text.to_owned());
    };
    let kept = here.energy.wall;
    let (wall, of_wall) = match kept > 0.0 {
        true => {
            ("the wall, ", format!(", where the wall keeps {}", Quantity::Energy.said(units, kept)))
        }
        false => ("", String::new()),
    };
    let way = if peak.x > rigid.x { "towards the tip" } else { "towards the handle" };
    Some(format!(
        "Why there: a bat that does not bend would be best at {}; vibration takes {} there and {} \
         at the sweet spot, {} {way}{of_wall}. Further out {wall}recoil and vibration take more than \
         the bat's speed there makes up for.",
        place(rigid.x),
        Quantity::Energy.said(units, there),
        Quantity::Energy.said(units, here.energy.vibration),
        place((peak.x - rigid.x).abs())
    ))
}

/// A remark on a best place that is best because the bat catches up with the ball late or again; None for any other.
fn lives_on_later(figures: &Figures, units: Units) -> Option<String> {
    let best = figures.best.as_ref()?;
    let has = |flag: &str| best.flags.contains(&flag);
    let (again, late) = (has("second_contact"), has("late_contact"));
    let how = match (again, late) {
        (false, false) => return None,
        (true, _) => "hits it again after it has left",
        (false, true) => "pushes it again as it is leaving",
    };
    let first = figures.spot.first_separation_max.map_or(String::new(), |first| {
        let place = Quantity::Length.said(units, first.x);
        let speed = Quantity::Speed.said(units, first.value);
        format!(" By its first contact alone the ball leaves fastest at {place}, with {speed}.")
    });
    Some(format!("The fastest ball is so fast because the bat's vibration {how}.{first}"))
}

/// The description of a model that accompanies its results; an empirical one is marked as such.
pub fn meaning(model: Model) -> &'static str {
    match model {
        Model::Rigid => "the bat does not bend in this model",
        Model::EnergyLoss(_) => {
            "empirical: the loss to vibration is the WPI report's fit, not derived, and energy is not conserved \
             (energy_j.imbalance in the JSON)"
        }
        Model::Pulse(_) => {
            "the force is a half sine of a given duration, and the ball's loss a given share"
        }
        Model::Contact => {
            "ball and modes in contact; the ball gives back less energy than it absorbs"
        }
    }
}

/// The effects neglected in a hit with as many modes as it needs; None for a given number of modes.
pub fn beyond(sweep: &Sweep, scene: &Scene, units: Units) -> Option<String> {
    let closing = |i: &Impact| i.bat_speed + scene.ball_speed;
    let fastest = sweep.impacts.iter().map(closing).fold(0.0, f64::max);
    let change = sweep.truncation? * fastest;
    let change = Quantity::Speed.said(units, change);
    let count = sweep.solution.modes.len();
    Some(format!(
        "{count} modes; what is left out of those above changes an exit speed by {change} at most, \
         by estimate."
    ))
}

/// The sweet spot by one of its definitions.
pub struct SpotLine {
    /// The definition, with the value of the extremum.
    pub what: String,
    /// Its position (m from the knob end).
    pub x: f64,
}

/// The sweet spot by each definition. The vibration of an undamped bat has no end, and no size that a hand feels, so
/// that definition is omitted.
pub fn spot_lines(bat: &Bat, spot: &SweetSpot, units: Units) -> Vec<SpotLine> {
    let mut lines = vec![];
    let mut line = |what: &str, x: Option<f64>, value: Option<String>| {
        let what = value.map_or(what.to_owned(), |value| format!("{what}, {value}"));
        lines.extend(x.map(|x| SpotLine { what, x }));
    };
    let mut peak = |what: &str, peak: Option<Peak>, shown: &dyn Fn(f64) -> String| {
        line(what, peak.map(|p| p.x), peak.map(|p| shown(p.value)));
    };
    let speed = |v: f64| Quantity::Speed.said(units, v);
    peak("fastest ball", spot.exit_speed_max, &speed);
    let first =
        spot.first_separation_max.filter(|_| spot.exit_speed_max != spot.first_separation_max);
    peak("first contact", first, &speed);
    peak("least vibration", spot.vibration_min, &|energy| {
        Quantity::Energy.said(units.first(), energy)
    });
    let slow = |v: f64| Quantity::Speed.said(units.first(), v);
    peak("least hand speed, undamped", spot.hands_velocity_min, &slow);
    if bat.damped() {
        let shaken = |a: f64| format!("{:.0} g", gravities(a));
        peak("least hand shaking (rms)", spot.hands_acceleration_min, &shaken);
    }
    line("node of mode 1", spot.node_mode_1, None);
    line("node of mode 2", spot.node_mode_2, None);
    line("centre of percussion (swing)", spot.center_of_percussion, None);
    if let Some([from, to]) = spot.zone {
        line("within 1 % of the best: from", Some(from), None);
        line("                        to", Some(to), None);
    }
    lines
}

/// The stated figures of a bat: efficiency, BBCOR, effect of an inch, swings.
pub fn stated(figures: &Figures, units: Units) -> Vec<(String, String)> {
    let Some(outcome) = figures.best.as_ref().and_then(|best| best.outcome.as_ref()) else {
        return vec![];
    };
    let mut lines = vec![];
    let speed = |v: f64| Quantity::Speed.said(units, v);
    let place = |x: f64| Quantity::Length.said(units, x);
    let mut line = |what: &str, value: String| lines.push((what.to_owned(), value));
    line("bat-ball speed", speed(outcome.exit_speed));
    line("collision efficiency e_A", format!("{:.3}", outcome.collision_efficiency));
    line("BBCOR there, free (or as it is held)", format!("{:.3}", outcome.bbcor));
    line("BBCOR there, held 6 in from the knob", format!("{:.3}", outcome.bbcor_pivoted));
    let most = |peak: Peak| format!("{:.3} at {}", peak.value, place(peak.x));
    if let Some(peak) = figures.bbcor_max {
        line("largest BBCOR, free (or as it is held)", most(peak));
    }
    if let Some(peak) = figures.bbcor_pivoted_max {
        line("largest BBCOR, held 6 in from the knob", most(peak));
    }
    if let Some([knob, tip]) = figures.spot.inch_off {
        let lost = |speed: f64| {
            Quantity::Speed.in_both(units, |scale| scale.change(speed - outcome.exit_speed))
        };
        let lost = |speed: Option<f64>| speed.map_or("no hit".to_owned(), lost);
        line("1 in off towards the knob", lost(knob));
        line("1 in off towards the tip", lost(tip));
    }
    if let Some(wall) = figures.wall {
        wall_facts(&wall, units).into_iter().for_each(|fact| line(fact.label, fact.value));
    }
    for swung in &figures.swings {
        let what = match swung.exponent {
            0.0 => "same angular speed".to_owned(),
            0.5 => "same energy of rotation".to_owned(),
            n => format!("speed falls as (swing weight)^{}", -n),
        };
        let best = swung.best.map_or("no hit".to_owned(), |best| speed(best.value));
        line(&what, format!("{:.2} rad/s: {best}", swung.swing));
    }
    lines
}

/// The heading of these figures.
pub const STATED: &str = "Figures at the sweet spot (computed, not certified)";

/// The scene in words, and the meaning of the model.
pub fn scene(bat: &Bat, scene: &Scene, model: Model, units: Units) -> String {
    let side = if scene.pivot < 0.0 { "inside" } else { "beyond" };
    let barrel = BarrelSpeed::of(bat, scene, BarrelSpeed::BROADCAST);
    let mut out = format!(
        "Hit with {}: model {}\n     swing {:.1} rad/s about a point {} {side} the knob end:\n     \
         {} where the bat is {} from the tip\n     {} at {}, cor {}\n",
        bat.title(),
        model.name(),
        scene.swing,
        Quantity::Length.said(units, scene.pivot.abs()),
        Quantity::Speed.said(units, barrel.speed),
        Quantity::Length.said(units, barrel.from_tip),
        scene.ball.title(),
        Quantity::Speed.said(units, scene.ball_speed),
        match scene.ball.cor_by_speed.is_empty() {
            true => scene.cor.to_string(),
            false => "by its speed".to_owned(),
        }
    );
    if !bat.edits().is_empty() {
        out += &wrapped(&format!("     the bat is edited: {}", edits::listed(bat, units)), 5);
    }
    if let Some(Wall { stiffness, mass }) = scene.wall {
        let _ = writeln!(out, "     the barrel's wall gives way: {stiffness:.3e} N/m, {mass} kg");
    }
    if let Some(wall) = scene.hoop.wall() {
        out += &wrapped(&format!("     {}", wall_words(bat, scene, wall)), 5);
    }
    for effect in ignored::in_hit(bat, scene) {
        out += &wrapped(&format!("     left out: {effect}"), 5);
    }
    if bat.fixtures().holding() {
        out += "     the bat is held: energies are as its hands see them, the bat at rest;\n     \
         swinging in what holds it counts as vibration\n";
    }
    out + &wrapped(&format!("     {}", meaning(model)), 5)
}
