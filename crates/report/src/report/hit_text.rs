//! Tables of a hit for the terminal.

use std::fmt::Write;

use crate::parts::{Columns, Units, in_trade, numbers, wrapped};
use crate::report::wall_text::{wall_facts, wall_words};
use crate::report::{curve, edits};
use sweetspot::Bat;
use sweetspot::base::number::signed;
use sweetspot::base::units::{gravities, inches, miles_per_hour};
use sweetspot::collision::columns::{self, Column};
use sweetspot::collision::figures::{BarrelSpeed, Figures, Moved};
use sweetspot::collision::sweet_spot::Peak;
use sweetspot::collision::{Impact, Model, Scene, Sweep, SweetSpot, hit::Wall};
use sweetspot_study::ignored;

/// The meaning of the flags of hits, and their letters in the table.
const FLAGS: [(&str, char, &str); 8] = [
    ("reload", 'r', "pressed again while it was springing back"),
    ("late_contact", 'l', "the bat caught up when the force had almost gone"),
    ("second_contact", 's', "hit again after it left; the speed is that in the end"),
    ("ball_law_beyond", 'b', "not measured for such a hit (docs/limits.md)"),
    ("no_contact", 'n', "ball and bat do not approach each other"),
    ("no_section", 'p', "the bat ends in a point"),
    ("no_real_solution", 'i', "the model has no real solution"),
    ("unresolved", 'u', "not resolved: the energies do not close"),
];

/// A line for every flag that hits have.
fn legend(impacts: &[Impact]) -> String {
    let has = |flag: &&(&str, char, &str)| impacts.iter().any(|i| i.flags.contains(&flag.0));
    let line = |(name, letter, words): &(&str, char, &str)| {
        format!("  {letter}  {}: {words}\n", name.replace('_', " "))
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

/// Exit speed along the barrel: positions from knob and tip, speeds, efficiency, vibration and flags.
pub fn impacts(bat: &Bat, impacts: &[Impact], units: Units) -> String {
    // A compliant wall has a separate column.
    let walls = impacts.iter().any(|i| i.outcome.as_ref().is_some_and(|o| o.energy.wall > 0.0));
    let widths = if walls { [8, 8, 9, 9, 8, 9, 8, 9, 8] } else { [9, 9, 10, 10, 9, 10, 9, 9, 0] };
    let (near, far) = if units.us_first() { ("in", "mph") } else { ("cm", "m/s") };
    let (tip, second) = match units {
        Units::Si => ("cm", ""),
        Units::Us => ("in", ""),
        Units::Both => ("in", "mph"),
        Units::BothUsFirst => ("in", "m/s"),
    };
    let energy = units.of_energy().0;
    // The exit speed in a second unit, and the wall's share, where there are such.
    let used = |(k, _): &(usize, usize)| (*k != 4 || !second.is_empty()) && (*k != 8 || walls);
    let used: Vec<(usize, usize)> = widths.into_iter().enumerate().filter(used).collect();
    let table = Columns::new(used.iter().map(|(_, width)| numbers(*width, "")));
    let row = |cells: &[&str; 9]| table.row(used.iter().map(|(k, _)| cells[*k]));
    let mut out = row(&["from", "from", "bat", "exit", "exit", "rigid", "e_A", "vibra-", "wall"]);
    out += &row(&["knob", "tip", "speed", "speed", "speed", "bat", "", "tion", ""]);
    out += &row(&[near, tip, far, far, second, far, "", energy, energy]);
    let length = |x: f64, unit: &str| {
        let value = if unit == "in" { inches(x) } else { 100.0 * x };
        // Adding 0 turns a length of −0 into 0.
        format!("{:.2}", value + 0.0)
    };
    let fast = |v: f64| if units.us_first() { miles_per_hour(v) } else { v };
    for impact in impacts {
        let from_tip = (bat.length() - impact.x).max(0.0);
        let mut cells = [const { String::new() }; 9];
        cells[0] = length(impact.x, near);
        cells[1] = length(from_tip, tip);
        let told = |column: Column, shown: &dyn Fn(f64) -> String| {
            column.at(impact).map_or(String::new(), shown)
        };
        let speed = |v: f64| format!("{:.2}", fast(v));
        cells[2] = told(columns::BAT_SPEED, &speed);
        cells[3] = told(columns::EXIT_SPEED, &speed);
        if cells[3].is_empty() {
            cells[3] = "no value".to_owned();
        }
        cells[4] = told(columns::EXIT_SPEED, &|v| match units.us_first() {
            true => format!("{v:.2}"),
            false => format!("{:.1}", miles_per_hour(v)),
        });
        cells[5] = told(columns::RIGID_EXIT_SPEED, &speed);
        cells[6] = told(columns::EFFICIENCY, &|e| format!("{e:.3}"));
        let energy = |energy: f64| format!("{:.2}", units.of_energy().1 * energy);
        cells[7] = told(columns::VIBRATION, &energy);
        cells[8] = impact.outcome.as_ref().map_or(String::new(), |o| energy(o.energy.wall));
        let letters = FLAGS.iter().filter(|flag| impact.flags.contains(&flag.0)).map(|flag| flag.1);
        let marks: String = letters.collect();
        let gap = if marks.is_empty() { "" } else { " " };
        let cells = cells.each_ref().map(String::as_str);
        let _ = writeln!(out, "{}{gap}{marks}", row(&cells).trim_end_matches('\n'));
    }
    out + &legend(impacts)
}

/// Exit speed along the barrel, drawn.
pub fn curve(impacts: &[Impact], units: Units) -> String {
    let us = units.us_first();
    let fast = |v: f64| if us { miles_per_hour(v) } else { v };
    let places: Vec<f64> =
        impacts.iter().map(|i| if us { inches(i.x) } else { 100.0 * i.x }).collect();
    let exit = |i: &Impact| i.outcome.as_ref().map(|o| fast(o.exit_speed));
    let ours: Vec<_> = impacts.iter().map(exit).collect();
    let rigid: Vec<_> = impacts.iter().map(|i| i.rigid_exit_speed.map(fast)).collect();
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

/// One sentence: why the ball leaves fastest where it does.
pub fn why(figures: &Figures, units: Units) -> String {
    reason(figures, units).map_or(String::new(), |text| wrapped(&text, 0))
}

/// Why the exit speed is highest where it is; None without such a place.
pub fn reason(figures: &Figures, units: Units) -> Option<String> {
    let place = |x: f64| units.place(x, 1);
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
        true => ("the wall, ", format!(", where the wall keeps {}", units.energy(kept, 2))),
        false => ("", String::new()),
    };
    let way = if peak.x > rigid.x { "towards the tip" } else { "towards the handle" };
    Some(format!(
        "Why there: a bat that does not bend would be best at {}; vibration takes {} there and {} \
         at the sweet spot, {} {way}{of_wall}. Further out {wall}recoil and vibration take more than \
         the bat's speed there makes up for.",
        place(rigid.x),
        units.energy(there, 2),
        units.energy(here.energy.vibration, 2),
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
        let place = units.place(first.x, 1);
        let speed = units.inline(units.speed(first.value));
        format!(" By its first contact alone the ball leaves fastest at {place}, with {speed}.")
    });
    Some(format!("The fastest ball is so fast because the bat's vibration {how}.{first}"))
}

/// The description of a model that accompanies its results; an empirical one is marked as such.
pub fn meaning(model: Model) -> String {
    let told = match model {
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
    };
    wrapped(&format!("     {told}"), 5)
}

/// The effects neglected in a hit with as many modes as it needs.
pub fn beyond(sweep: &Sweep, scene: &Scene, units: Units) -> String {
    let Some((truncation, _)) = sweep.truncation.zip(sweep.worst()) else { return String::new() };
    let closing = |i: &Impact| i.bat_speed + scene.ball_speed;
    let fastest = sweep.impacts.iter().map(closing).fold(0.0, f64::max);
    let change = truncation * fastest;
    let mph = miles_per_hour(change);
    let change = units.beside(format!("{change:.1e} m/s"), format!("{mph:.1e} mph"));
    let count = sweep.solution.modes.len();
    let text = format!(
        "{count} modes; what is left out of those above changes an exit speed by {change} at most, \
         by estimate."
    );
    wrapped(&text, 0)
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
    let speed = |v: f64| units.inline(units.speed(v));
    peak("fastest ball", spot.exit_speed_max, &speed);
    let first =
        spot.first_separation_max.filter(|_| spot.exit_speed_max != spot.first_separation_max);
    peak("first contact", first, &speed);
    peak("least vibration", spot.vibration_min, &|energy| units.energy(energy, 2));
    let slow = |v: f64| units.first().speed(v);
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

/// The sweet spot by each definition, from knob and tip.
pub fn sweet_spot(bat: &Bat, spot: &SweetSpot, units: Units) -> String {
    let mut out =
        String::from("Sweet spot                             from knob            from tip\n");
    for SpotLine { what, x } in spot_lines(bat, spot, units) {
        let [knob, tip] = [x, bat.length() - x].map(|x| units.positions(&[x]).join(", "));
        let _ = writeln!(out, "  {what:<36} {knob:<19}  {tip}");
    }
    if let Some(apart) = spot.looked_every {
        let inch = format!("{:.2} in", inches(apart));
        let apart = units.beside(format!("{:.1} mm", 1e3 * apart), inch);
        let text = format!(
            "Places were tried every {apart} only: the bat hits the ball again there, and all places would take more \
             than about ten times as long as a usual hit. A narrower peak may be missed."
        );
        out.push_str(&wrapped(&text, 2));
    }
    out
}

/// The stated figures of a bat: efficiency, BBCOR, effect of an inch, swings.
pub fn stated(figures: &Figures, units: Units) -> Vec<(String, String)> {
    let Some(outcome) = figures.best.as_ref().and_then(|best| best.outcome.as_ref()) else {
        return vec![];
    };
    let mut lines = vec![];
    let speed = |v: f64| units.inline(units.speed(v));
    let place = |x: f64| units.place(x, 1);
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
            let by = speed - outcome.exit_speed;
            units.beside(format!("{by:+.2} m/s"), format!("{:+.1} mph", miles_per_hour(by)))
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

/// The stated figures of a bat, a line each.
pub fn figures(figures: &Figures, units: Units) -> String {
    let lines = stated(figures, units);
    let line = |(what, value): &(String, String)| format!("  {what:<38} {value}\n");
    let lines: String = lines.iter().map(line).collect();
    if lines.is_empty() { lines } else { format!("{STATED}\n{lines}") }
}

/// How the sweet spot moves, in mm or in towards the tip, and how the best speed changes.
pub fn moves(bat: &Bat, figures: &Figures, units: Units) -> String {
    if figures.spot.exit_speed_max.is_none() || figures.moves.is_empty() {
        return String::new();
    }
    let damped = bat.damped();
    let row = |what: &str, [ball, vibration, speed, shaking, best]: [String; 5]| {
        let shaking = if damped { format!(" {shaking:>11}") } else { String::new() };
        let line = format!("{what:<26} {ball:>8} {vibration:>7} {speed:>11}{shaking}   {best}");
        format!("{}\n", line.trim_end())
    };
    let heads = ["fastest", "least", "least hand", "least hand", "best"].map(str::to_owned);
    let (unit, per, places) =
        if units.us_first() { ("in", inches(1.0), 2) } else { ("mm", 1e3, 1) };
    let (mph, faster) = in_trade("m/s", units.us_first());
    let mut out = row(&format!("How it moves, {unit} to tip"), heads);
    out += &row("", ["ball", "vibr.", "speed", "shaking", "speed"].map(str::to_owned));
    let spot = &figures.spot;
    for Moved { change, sweet_spot: moved } in &figures.moves {
        let by = |of: fn(&SweetSpot) -> Option<Peak>| match (of(spot), of(moved)) {
            (Some(before), Some(after)) => signed(per * (after.x - before.x), places),
            _ => String::new(),
        };
        let faster = match (spot.exit_speed_max, moved.exit_speed_max) {
            (Some(before), Some(after)) => {
                let decimals = if units.us_first() { 1 } else { 2 };
                format!("{} {mph}", signed(faster * (after.value - before.value), decimals))
            }
            _ => String::new(),
        };
        let cells = [
            by(|s| s.exit_speed_max),
            by(|s| s.vibration_min),
            by(|s| s.hands_velocity_min),
            by(|s| s.hands_acceleration_min),
            faster,
        ];
        out += &row(&format!("  {change}"), cells);
    }
    out
}

/// The scene in words.
pub fn scene(bat: &Bat, scene: &Scene, model: &str, units: Units) -> String {
    let side = if scene.pivot < 0.0 { "inside" } else { "beyond" };
    let barrel = BarrelSpeed::of(bat, scene, BarrelSpeed::BROADCAST);
    let mut out = format!(
        "Hit with {}: model {model}\n     swing {:.1} rad/s about a point {} {side} the knob end:\n     \
         {} where the bat is {} from the tip\n     {} at {}, cor {}\n",
        bat.title(),
        scene.swing,
        units.inline(units.length(scene.pivot.abs())),
        units.inline(units.speed(barrel.speed)),
        units.inline(units.length(barrel.from_tip)),
        scene.ball.title(),
        units.inline(units.speed(scene.ball_speed)),
        match scene.ball.cor_by_speed.is_empty() {
            true => scene.cor.to_string(),
            false => "by its speed".to_owned(),
        }
    );
    if !bat.edits().is_empty() {
        out += &wrapped(&format!("     the bat is edited: {}", edits::listed(bat, units)), 5);
    }
    if let Some(Wall { stiffness, mass }) = scene.wall {
        let (stiffness, mass) = (units.stiffness(stiffness), units.inline(units.mass(mass)));
        let _ = writeln!(out, "     the barrel's wall gives way: {stiffness}, {mass}");
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
    out
}
