//! The effects of a hit: hands, strain and stress, spectrum; as text, CSV and JSON.

use std::fmt::Write;

use crate::csv::Csv;
use crate::parts::{Cell, Columns, Quantity, Units, numbers, wrapped};
use crate::schema::Written;
use crate::schema::hit::Impact;
use crate::schema::ring::{AfterHit, RingFile, Struck};
use sweetspot::Bat;
use sweetspot::base::units::gravities;
use sweetspot::collision::aftermath::{Aftermath, PeakMotion, Watched};
use sweetspot::collision::hit;
use sweetspot::collision::strength::{Limit, Load, Strength, nearest};

/// Number of points along the bat at which strain is computed.
const PLACES: usize = 200;

impl AfterHit {
    /// Looks from the first touch until that time (s), or until the ball leaves if that is later.
    pub fn new(bat: &Bat, after: &Aftermath, watched: &[f64], until: f64) -> Self {
        const WITHIN: usize = 200;
        /// Steps as short as while the ball is there; then they grow with the time.
        const SHORT: usize = 2000;
        let end = after.end();
        let until = until.max(end);
        let step = end / WITHIN as f64;
        // The instants do not depend on the end of the time considered, so a maximum once found remains.
        let later = |t: &f64| Some(t + step * (t / (step * SHORT as f64)).max(1.0));
        let within = (0..=WITHIN).map(|k| end * k as f64 / WITHIN as f64);
        let beyond = std::iter::successors(later(&end), later).take_while(|t| *t <= until);
        let times: Vec<f64> = within.chain(beyond).collect();
        let instants = after.at(&times);
        let places: Vec<f64> =
            (0..=PLACES).map(|k| bat.length() * k as f64 / PLACES as f64).collect();
        let all = after.count();
        let during = after.worst(&places, &instants[..=WITHIN], all);
        let envelope = after.envelope(&places, &instants, all);
        let whole = after.worst(&places, &instants, all);
        let load = |limit: &Limit| nearest(bat, &envelope, *limit);
        let loads = Limit::ALL.iter().filter_map(load).collect();
        let fewer = after.worst(&places, &instants, all - all / 4);
        let change = whole.zip(fewer).map(|(a, b)| (b.strain / a.strain - 1.0).abs());
        Self {
            edits: bat.edits().to_vec(),
            modes: all,
            at_m: after.place,
            contact_s: end,
            times_s: instants.iter().map(|now| now.time).collect(),
            force_n: instants.iter().map(|now| now.force).collect(),
            watched: watched.iter().map(|x| after.watched(*x, &instants)).collect(),
            strain_max_in_contact: during,
            strain_max: whole,
            strain_error: change.filter(|change| change.is_finite()).unwrap_or(1.0),
            along: envelope,
            strength: loads,
            until,
            damped: bat.damped(),
        }
    }
}

/// One line of the hit itself, which ends at that time (s).
pub fn impact(impact: &hit::Impact, end: f64, units: Units) -> String {
    let Some(outcome) = &impact.outcome else { return String::new() };
    format!(
        "     at {}\n     the ball leaves at {}, after {:.2} ms\n     the force is {} at most\n",
        Quantity::Length.said(units, impact.x),
        Quantity::Speed.said(units, outcome.exit_speed),
        1e3 * end,
        Quantity::Force.said(units, outcome.peak_force.unwrap_or(0.0))
    )
}

/// The tables for the terminal; `full` adds strains along the bat and the spectrum. Where the strength is known, the
/// largest strain is included in any case.
pub fn text(bat: &Bat, report: &AfterHit, units: Units, full: bool) -> String {
    let mut out = format!(
        "\nMotion against the swing, {:.1} ms from the first touch, hands without mass\n",
        1e3 * report.until
    );
    for seen in &report.watched {
        out += &motion(seen, report.damped, units);
    }
    if !full {
        let strains =
            if report.strength.is_empty() { strains(report, units) } else { String::new() };
        return (out + &strains + &strength(bat, report, units)).replace("\n\n", "\n");
    }
    out += &strains(report, units);
    out += &along(report, units);
    out += &strength(bat, report, units);
    if let Some(seen) = report.watched.first() {
        out += &spectrum(seen, report.damped, units);
    }
    out
}

/// When a place begins to move, and its largest displacement, velocity and acceleration.
fn motion(seen: &Watched, damped: bool, units: Units) -> String {
    let PeakMotion { displacement_m: most, velocity_m_s: speed, acceleration_m_s2 } = seen.peak;
    let [a, b, c] = seen.when.map(|t| format!("at {:.2} ms", 1e3 * t));
    let (place, begins) = (Quantity::Length.said(units, seen.x_m), 1e3 * seen.begins_s);
    let mut out = format!("  at {place}, which begins to move after {begins:.2} ms\n");
    let mut line = |what: &str, size: String, when: String| {
        let _ = writeln!(out, "{}", format!("    {what:<36} {size} {when}").trim_end());
    };
    let moved = Quantity::Small.in_both(units, |scale| scale.finer().text(most));
    let growing = seen.displacement_m.last().is_some_and(|last| last.abs() >= most);
    line("largest displacement", moved, if growing { "and growing".into() } else { a });
    line("largest velocity", Quantity::Speed.said(units, speed), b);
    let shaken = Quantity::Acceleration.said(units.first(), acceleration_m_s2);
    let shaken = format!("{shaken} ({:.0} g)", gravities(acceleration_m_s2));
    let endless = "without end: nothing damps the bat".to_owned();
    let (size, when) = if damped { (shaken, c) } else { (endless, String::new()) };
    line("largest acceleration", size, when);
    out
}

/// The largest bending strain while the ball is there and in the whole time.
fn strains(report: &AfterHit, units: Units) -> String {
    let (Some(during), Some(after)) = (report.strain_max_in_contact, report.strain_max) else {
        return String::new();
    };
    let mut out = format!(
        "\nBending strain at the outermost fibre (within {:.0} % as a quarter fewer modes say)\n",
        (100.0 * report.strain_error).max(1.0)
    );
    for (what, worst) in [("while the ball is there", during), ("in the whole time", after)] {
        let _ = writeln!(
            out,
            "  {what:<24} {:.3} %, {} at {}, {:.2} ms",
            100.0 * worst.strain,
            units.first().stress(worst.stress_pa, 1),
            Quantity::Length.said(units, worst.x_m),
            1e3 * worst.time_s
        );
    }
    out
}

/// The modes that vibrate at a place after the contact.
fn spectrum(seen: &Watched, damped: bool, units: Units) -> String {
    let (place, lines) = (Quantity::Length.said(units, seen.x_m), &seen.spectrum);
    let mut out =
        format!("\nSpectrum at {place} when the ball has left: amplitude of every mode\n");
    let us = units.us_first();
    let [length, speed] = [Quantity::Small, Quantity::Speed].map(|of| of.scale(us).finer().finer());
    let columns = Columns::new(
        [numbers(9, "Hz"), numbers(10, length.name), numbers(10, speed.name)]
            .into_iter()
            .chain(damped.then(|| numbers(10, "g"))),
    );
    out += &columns.heads();
    let largest = lines.iter().map(|line| line.velocity_m_s).fold(0.0, f64::max);
    for line in lines.iter().filter(|line| line.velocity_m_s >= 0.01 * largest) {
        let (moved, fast) = (length.value(line.displacement_m), speed.value(line.velocity_m_s));
        let cells = [format!("{:.1}", line.frequency_hz), moved, fast];
        let shaken = damped.then(|| format!("{:.0}", gravities(line.acceleration_m_s2)));
        out += &columns.row(cells.into_iter().chain(shaken));
    }
    out
}

/// The largest strain of some places.
fn along(report: &AfterHit, units: Units) -> String {
    let mut out = String::from("\nAlong the bat, the largest in the whole time\n");
    let every = (report.along.len() / 10).max(1);
    for at in report.along.iter().step_by(every) {
        let place = format!("at {}", Quantity::Length.said(units, at.x_m));
        let stress = units.first().stress(at.stress_pa, 1);
        let _ = writeln!(out, "  {place:<24} {:.3} %, {stress}", 100.0 * at.strain);
    }
    out
}

/// The heading of the load relative to the strength, which is that of clear wood in a bat of wood.
fn heading(bat: &Bat) -> String {
    let clear = " (clear wood along the grain; grain, knots, dents not known)";
    format!("Strength{}\n", bat.material().scatter().map_or("", |_| clear))
}

/// The load relative to the strength.
fn strength(bat: &Bat, report: &AfterHit, units: Units) -> String {
    let mut out = format!("\n{}", heading(bat));
    if report.strength.is_empty() {
        let unknown = "  no material has a known strength: \"strength\" and \"strain_to_failure\" of \
                       the material in the bat file say what it bears";
        return out + &wrapped(unknown, 4);
    }
    for load in &report.strength {
        out += &wrapped(&format!("  {}", reached(load, units)), 4);
    }
    out + &beyond(report.strength.iter())
}

/// The meaning of a share above 100 %; empty where there is none.
fn beyond<'a>(mut loads: impl Iterator<Item = &'a Load>) -> String {
    match loads.any(|load| load.share > 1.0) {
        true => wrapped(
            "  More than 100 %: the stress is above what a small clear piece of the material bears in a slow \
             test, so that such a piece would break there. Whether this bat does is not said: pieces differ, \
             and so does what a short blow does.",
            4,
        ),
        false => String::new(),
    }
}

/// How near a hit takes the bat to a limit, where, and the swing that takes it there.
pub fn reached(load: &Load, units: Units) -> String {
    let bears = load.strength_pa.or(load.strain_to_failure).unwrap_or(0.0);
    let (bears, most, test) = match load.limit {
        Limit::Stress => (
            units.stress(bears, 0),
            units.stress(load.at.stress_pa, 1),
            "published for slow bending (how much more a blow bears is not known)",
        ),
        Limit::Strain => (
            format!("{:.2} %", 100.0 * bears),
            format!("a strain of {:.3} %", 100.0 * load.at.strain),
            "published, at which it breaks in a blow",
        ),
    };
    let swing = match load.reached_at_swing_rad_s {
        Some(0.0) => "reached by the pitch alone, without a swing".to_owned(),
        Some(swing) => format!("reached at a swing of about {swing:.1} rad/s"),
        None => "not reached by any swing up to 200 rad/s".to_owned(),
    };
    format!(
        "{most} at {}: {:.0} % of the {bears} {test}; {swing}",
        Quantity::Length.said(units, load.at.x_m),
        100.0 * load.share
    )
}

/// The load on the bat in hits at some places, for a screen.
pub fn strengths(bat: &Bat, all: &[Strength], units: Units) -> String {
    if all.iter().all(|at| at.limits.is_empty()) {
        return String::new();
    }
    let mut out = heading(bat);
    for at in all {
        for load in &at.limits {
            let text = reached(load, units);
            out +=
                &wrapped(&format!("  hit at {}: {text}", Quantity::Length.said(units, at.x_m)), 4);
        }
    }
    out + &beyond(all.iter().flat_map(|at| &at.limits))
}

/// Force, and motion and strain at the watched places, in time.
pub fn history(report: &AfterHit) -> String {
    let columns = report.watched.iter().flat_map(|seen| {
        ["displacement_m", "velocity_m_s", "acceleration_m_s2", "strain"]
            .map(|what| format!("{what}_at_{}_m", seen.x_m))
    });
    let mut table = Csv::new(["t_s", "force_n"].map(str::to_owned).into_iter().chain(columns));
    for (k, (time, force)) in report.times_s.iter().zip(&report.force_n).enumerate() {
        let at_places = report.watched.iter().flat_map(|seen| {
            [
                seen.displacement_m[k],
                seen.velocity_m_s[k],
                seen.acceleration_m_s2[k],
                seen.strain[k],
            ]
        });
        table.row([*time, *force].into_iter().chain(at_places).map(Cell::from));
    }
    table.text()
}

/// The `sweetspot-ring/1` document of a hit, including the neglected effects.
pub fn document(motion: AfterHit, impact: Impact, ignored: Vec<String>) -> Written<RingFile> {
    Written::of(RingFile::Hit(Box::new(Struck { motion, impact, ignored })))
}
