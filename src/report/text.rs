//! Tables for the terminal, 80 columns wide, in the units asked for.

use std::fmt::Write;

use crate::bat::{Bat, STANDARD_PIVOT};
use crate::collision::hit::{Impact, Scene};
use crate::collision::sweet_spot::SweetSpot;
use crate::plan::Solution;
use crate::report::json::solver_name;
use crate::theory::ignored;
use crate::units::{inches, miles_per_hour, ounce_square_inches, ounces};

/// Which units the tables are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    Si,
    Us,
    Both,
}

impl Units {
    /// A value in SI, in US units, or in both.
    fn show(self, si: String, us: String) -> String {
        match self {
            Self::Si => si,
            Self::Us => us,
            Self::Both => format!("{si:<18} {us}"),
        }
    }

    fn length(self, metres: f64) -> String {
        self.show(format!("{metres:.4} m"), format!("{:.2} in", inches(metres)))
    }

    fn mass(self, kilograms: f64) -> String {
        self.show(format!("{kilograms:.4} kg"), format!("{:.2} oz", ounces(kilograms)))
    }

    fn inertia(self, value: f64) -> String {
        let us = format!("{:.0} oz in²", ounce_square_inches(value));
        self.show(format!("{value:.5} kg m²"), us)
    }

    fn speed(self, value: f64) -> String {
        self.show(format!("{value:.2} m/s"), format!("{:.1} mph", miles_per_hour(value)))
    }

    /// The same in running text: `0.0635 m (2.50 in)`.
    fn inline(self, value: String) -> String {
        match (self, value.split_once("   ")) {
            (Self::Both, Some((si, us))) => format!("{si} ({})", us.trim()),
            _ => value.split_whitespace().collect::<Vec<_>>().join(" "),
        }
    }

    /// A list of positions (m), a line per system of units.
    fn positions(self, places: &[f64]) -> Vec<String> {
        let list = |scale: f64, unit: &str| {
            let shown: Vec<String> = places.iter().map(|x| format!("{:.2}", x * scale)).collect();
            format!("{} {unit}", shown.join("  "))
        };
        let (si, us) = (list(100.0, "cm"), list(inches(1.0), "in"));
        match self {
            Self::Si => vec![si],
            Self::Us => vec![us],
            Self::Both => vec![si, us],
        }
    }
}

/// What bat this is: size, mass, balance, swing weight, centre of percussion.
pub fn summary(bat: &Bat, units: Units) -> String {
    let inertia = bat.inertia();
    let length = bat.length();
    let mut out = format!("{}\n", bat.name);
    let mut line = |what: &str, value: String| {
        let _ = writeln!(out, "  {what:<34} {value}");
    };
    line("length", units.length(length));
    line("mass", units.mass(inertia.mass));
    line("balance point, from knob", units.length(inertia.balance_point));
    line("balance point, from tip", units.length(length - inertia.balance_point));
    line("inertia about balance point", units.inertia(inertia.about_balance));
    line("swing weight (6 in from knob)", units.inertia(inertia.about(STANDARD_PIVOT)));
    if let Some(center) = inertia.center_of_percussion(STANDARD_PIVOT) {
        line("centre of percussion, from knob", units.length(center));
        line("centre of percussion, from tip", units.length(length - center));
    }
    out
}

/// The modes: frequencies with their errors, and the nodes of the first `with_nodes` modes.
pub fn modes(bat: &Bat, solution: &Solution, with_nodes: usize, units: Units) -> String {
    let mut out =
        String::from("Bending modes of the free bat (and two rigid ones, at 0 Hz exactly)\n");
    out += "  mode    frequency   f/f1     relative error   modal mass (largest deflection 1)\n";
    let first = solution.modes.first().map_or(1.0, |mode| mode.omega);
    for mode in &solution.modes {
        let _ = writeln!(
            out,
            "  {:>4} {:>9.2} Hz {:>7.3}   within {:<8} {:>8.1} g",
            mode.order,
            mode.frequency(),
            mode.omega / first,
            format!("{:.0e}", mode.error.total()),
            1e3 * mode.modal_mass,
        );
    }
    if !solution.modes.is_empty() {
        out += "Nodes\n";
    }
    for mode in solution.modes.iter().take(with_nodes) {
        let from_tip: Vec<f64> = mode.nodes.iter().rev().map(|x| bat.length() - x).collect();
        let mut label = format!("mode {}", mode.order);
        for (end, places) in [("from knob", &mode.nodes), ("from tip", &from_tip)] {
            for line in units.positions(places) {
                let line = format!("  {label:<8} {end:<9}  {line}");
                out += &wrapped(&line, 22);
                label.clear();
            }
        }
    }
    out
}

/// How the modes were found, and what the model left out.
pub fn model(bat: &Bat, solution: &Solution) -> String {
    let mut out = format!(
        "Model: Euler-Bernoulli, {} cubic elements, solver {}",
        solution.elements,
        solver_name(solution.solver)
    );
    if solution.steps > 0 {
        let _ = write!(out, " ({} Lanczos steps)", solution.steps);
    }
    out += "\n";
    for effect in ignored(bat, solution) {
        out += &wrapped(&format!("  left out: {effect}"), 12);
    }
    out
}

/// Breaks a line at its last spaces before column 80, the rest indented; ends the line.
fn wrapped(text: &str, indent: usize) -> String {
    let (mut out, mut rest, mut lead) = (String::new(), text, 0);
    while lead + rest.chars().count() > 80 {
        let end = rest.char_indices().nth(80 - lead).map_or(rest.len(), |(at, _)| at);
        let Some(space) = rest[..end].rfind(' ').filter(|at| *at > 0) else { break };
        let _ = writeln!(out, "{:lead$}{}", "", rest[..space].trim_end());
        (rest, lead) = (rest[space..].trim_start(), indent);
    }
    let _ = writeln!(out, "{:lead$}{rest}", "");
    out
}

/// Exit speed along the barrel, some of the impacts.
pub fn impacts(bat: &Bat, impacts: &[Impact], units: Units) -> String {
    let (position, speed) = match units {
        Units::Us => ("in", "mph"),
        _ => ("cm", "m/s"),
    };
    let scale = |x: f64| if units == Units::Us { inches(x) } else { 100.0 * x };
    let fast = |v: f64| if units == Units::Us { miles_per_hour(v) } else { v };
    let both = units == Units::Both;
    let mut out = format!(
        "  from knob  from tip  bat speed  exit speed  {}rigid bat     e_A  vibration\n",
        if both { "            " } else { "" }
    );
    let _ = writeln!(
        out,
        "  {position:>9}  {position:>8}  {speed:>9}  {speed:>10}  {}{speed:>9}                  J",
        if both { "       mph  " } else { "" }
    );
    for impact in impacts {
        let from_tip = bat.length() - impact.x;
        let _ = write!(
            out,
            "  {:>9.2}  {:>8.2}  {:>9.2}",
            scale(impact.x),
            scale(from_tip),
            fast(impact.bat_speed)
        );
        let Some(outcome) = &impact.outcome else {
            let _ = writeln!(out, "  no value ({})", impact.flags.join(", "));
            continue;
        };
        let exit = outcome.exit_speed;
        let _ = write!(out, "  {:>10.2}", fast(exit));
        if both {
            let _ = write!(out, "  {:>10.1}", miles_per_hour(exit));
        }
        let rigid = impact.rigid_exit_speed.map_or(f64::NAN, fast);
        let _ = writeln!(
            out,
            "  {rigid:>9.2}  {:>6.3}  {:>9.2}",
            outcome.collision_efficiency,
            outcome.energy.vibration()
        );
    }
    out
}

/// The sweet spot by each definition, from knob and tip.
pub fn sweet_spot(bat: &Bat, spot: &SweetSpot, units: Units) -> String {
    let mut out =
        String::from("Sweet spot                            from knob              from tip\n");
    let mut line = |what: &str, x: Option<f64>, value: String| {
        let Some(x) = x else { return };
        let place = |x: f64| match units {
            Units::Si => format!("{:.2} cm", 100.0 * x),
            Units::Us => format!("{:.2} in", inches(x)),
            Units::Both => format!("{:.2} cm, {:.2} in", 100.0 * x, inches(x)),
        };
        let what = if value.is_empty() { what.to_owned() } else { format!("{what}, {value}") };
        let text = format!("  {what:<34}  {:<21}  {}", place(x), place(bat.length() - x));
        let _ = writeln!(out, "{text}");
    };
    let peak = spot.exit_speed_max;
    line(
        "fastest ball",
        peak.map(|p| p.x),
        peak.map_or(String::new(), |p| units.inline(units.speed(p.value))),
    );
    let still = spot.vibration_min;
    let energy = still.map_or(String::new(), |p| format!("{:.2} J", p.value));
    line("least vibration", still.map(|p| p.x), energy);
    line("node of mode 1", spot.node_mode_1, String::new());
    line("node of mode 2", spot.node_mode_2, String::new());
    line("centre of percussion (swing)", spot.center_of_percussion, String::new());
    if let Some([from, to]) = spot.zone {
        line("within 1 % of the best: from", Some(from), String::new());
        line("                        to", Some(to), String::new());
    }
    out
}

/// The scene in words.
pub fn scene(scene: &Scene, model: &str, units: Units) -> String {
    let side = if scene.pivot < 0.0 { "inside" } else { "beyond" };
    format!(
        "Hit: model {model}\n     swing {:.1} rad/s about a point {} {side} the knob end\n     \
         {} at {}, cor {}\n",
        scene.swing,
        units.inline(units.length(scene.pivot.abs())),
        scene.ball.name,
        units.inline(units.speed(scene.ball_speed)),
        scene.cor
    )
}
