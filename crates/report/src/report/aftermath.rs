//! The effects of a hit: hands, strain and stress, spectrum; as text, CSV and JSON.

use std::fmt::Write;

use crate::csv::Csv;
use crate::parts::{Cell, Columns, Units, in_trade, numbers, wrapped};
use crate::schema::hit::Impact;
use crate::schema::{Written, ring as file};
use sweetspot::Bat;
use sweetspot::base::units::{gravities, inches, miles_per_hour};
use sweetspot::collision::aftermath::{Aftermath, Instant, PeakMotion, Strained, Watched};
use sweetspot::collision::hit;
use sweetspot::collision::strength::{Limit, Load, Strength, nearest};

/// The reported effects of a hit.
pub struct AfterHit {
    /// End of the time considered (s).
    pub until: f64,
    /// The motion at the watched places.
    pub watched: Vec<Watched>,
    /// The largest strain while the ball is there.
    pub during: Option<Strained>,
    /// The largest strain of the whole time.
    pub after: Option<Strained>,
    /// The largest strain of every place in the whole time.
    pub envelope: Vec<Strained>,
    /// The largest load relative to each known strength of the materials.
    pub loads: Vec<Load>,
    /// Whether the bat is damped; without damping its vibration has no end, and no size that a hand feels.
    pub damped: bool,
    /// Relative change of the largest strain when a quarter of the modes is omitted.
    pub strain_error: f64,
    instants: Vec<Instant>,
}

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
            until,
            watched: watched.iter().map(|x| after.watched(*x, &instants)).collect(),
            during,
            after: whole,
            envelope,
            loads,
            damped: bat.damped(),
            strain_error: change.filter(|change| change.is_finite()).unwrap_or(1.0),
            instants,
        }
    }
}

/// One line of the hit itself, which ends at that time (s).
pub fn impact(impact: &hit::Impact, end: f64, units: Units) -> String {
    let Some(outcome) = &impact.outcome else { return String::new() };
    format!(
        "     at {}\n     the ball leaves at {}, after {:.2} ms, {} at most\n",
        units.place(impact.x, 2),
        units.inline(units.speed(outcome.exit_speed)),
        1e3 * end,
        units.force(outcome.peak_force.unwrap_or(0.0), 1)
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
        let strains = if report.loads.is_empty() { strains(report, units) } else { String::new() };
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
    let (place, begins) = (units.place(seen.x_m, 2), 1e3 * seen.begins_s);
    let mut out = format!("  at {place}, which begins to move after {begins:.2} ms\n");
    let mut line = |what: &str, size: String, when: String| {
        let _ = writeln!(out, "{}", format!("    {what:<36} {size} {when}").trim_end());
    };
    let moved = units.show(format!("{:.2} mm", 1e3 * most), format!("{:.3} in", inches(most)));
    let growing = seen.displacement_m.last().is_some_and(|last| last.abs() >= most);
    line(
        "largest displacement",
        units.inline(moved),
        if growing { "and growing".into() } else { a },
    );
    line("largest velocity", units.inline(units.speed(speed)), b);
    let (unit, per) = in_trade("m/s²", units.us_first());
    let [shaken, g] = [per * acceleration_m_s2, gravities(acceleration_m_s2)];
    let shaken = format!("{shaken:.0} {unit} ({g:.0} g)");
    let endless = "without end: nothing damps the bat".to_owned();
    let (size, when) = if damped { (shaken, c) } else { (endless, String::new()) };
    line("largest acceleration", size, when);
    out
}

/// The largest bending strain while the ball is there and in the whole time.
fn strains(report: &AfterHit, units: Units) -> String {
    let (Some(during), Some(after)) = (report.during, report.after) else { return String::new() };
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
            units.place(worst.x_m, 2),
            1e3 * worst.time_s
        );
    }
    out
}

/// The modes that vibrate at a place after the contact.
fn spectrum(seen: &Watched, damped: bool, units: Units) -> String {
    let (place, lines) = (units.place(seen.x_m, 2), &seen.spectrum);
    let mut out =
        format!("\nSpectrum at {place} when the ball has left: amplitude of every mode\n");
    let us = units.us_first();
    let (length, velocity) = if us { ("in", "mph") } else { ("mm", "m/s") };
    let columns = Columns::new(
        [numbers(9, "Hz"), numbers(10, length), numbers(10, velocity)]
            .into_iter()
            .chain(damped.then(|| numbers(10, "g"))),
    );
    out += &columns.heads();
    let largest = lines.iter().map(|line| line.velocity_m_s).fold(0.0, f64::max);
    for line in lines.iter().filter(|line| line.velocity_m_s >= 0.01 * largest) {
        let (moved, speed) = (line.displacement_m, line.velocity_m_s);
        let [moved, speed] = match us {
            true => [format!("{:.4}", inches(moved)), format!("{:.3}", miles_per_hour(speed))],
            false => [format!("{:.3}", 1e3 * moved), format!("{speed:.3}")],
        };
        let cells = [format!("{:.1}", line.frequency_hz), moved, speed];
        let shaken = damped.then(|| format!("{:.0}", gravities(line.acceleration_m_s2)));
        out += &columns.row(cells.into_iter().chain(shaken));
    }
    out
}

/// The largest strain of some places.
fn along(report: &AfterHit, units: Units) -> String {
    let mut out = String::from("\nAlong the bat, the largest in the whole time\n");
    let every = (report.envelope.len() / 10).max(1);
    for at in report.envelope.iter().step_by(every) {
        let place = format!("at {}", units.place(at.x_m, 2));
        let stress = units.first().stress(at.stress_pa, 1);
        let _ = writeln!(out, "  {place:<24} {:.3} %, {stress}", 100.0 * at.strain);
    }
    out
}

/// The heading of the load relative to the strength, which is that of clear wood in a bat of wood.
fn heading(bat: &Bat) -> &'static str {
    match bat.material().scatter() {
        Some(_) => "Strength (clear wood along the grain; grain, knots, dents not known)\n",
        None => "Strength\n",
    }
}

/// The load relative to the strength.
fn strength(bat: &Bat, report: &AfterHit, units: Units) -> String {
    let mut out = format!("\n{}", heading(bat));
    if report.loads.is_empty() {
        let unknown = "  no material has a known strength: \"strength\" and \"strain_to_failure\" of \
                       the material in the bat file say what it bears";
        return out + &wrapped(unknown, 4);
    }
    for load in &report.loads {
        out += &wrapped(&format!("  {}", reached(load, units)), 4);
    }
    out + &beyond(report.loads.iter())
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
        units.place(load.at.x_m, 2),
        100.0 * load.share
    )
}

/// The load on the bat in hits at some places, for a screen.
pub fn strengths(bat: &Bat, all: &[Strength], units: Units) -> String {
    if all.iter().all(|at| at.limits.is_empty()) {
        return String::new();
    }
    let mut out = heading(bat).to_owned();
    for at in all {
        for load in &at.limits {
            let text = reached(load, units);
            out += &wrapped(&format!("  hit at {}: {text}", units.place(at.x_m, 2)), 4);
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
    for (k, now) in report.instants.iter().enumerate() {
        let at_places = report.watched.iter().flat_map(|seen| {
            [
                seen.displacement_m[k],
                seen.velocity_m_s[k],
                seen.acceleration_m_s2[k],
                seen.strain[k],
            ]
        });
        table.row([now.time, now.force].into_iter().chain(at_places).map(Cell::from));
    }
    table.text()
}

/// The `sweetspot-ring/1` document of a hit, including the neglected effects.
pub fn document(
    after: &Aftermath,
    report: &AfterHit,
    impact: Impact,
    ignored: Vec<String>,
) -> Written<file::RingFile> {
    let along = |of: fn(&Strained) -> f64| report.envelope.iter().map(of).collect::<Vec<_>>();
    Written::of(file::RingFile::Hit(Box::new(file::AfterHit {
        edits: after.bat().edits().to_vec(),
        modes: after.count(),
        at_m: after.place,
        contact_s: after.end(),
        times_s: report.instants.iter().map(|now| now.time).collect(),
        force_n: report.instants.iter().map(|now| now.force).collect(),
        watched: report.watched.clone(),
        strain_max_in_contact: report.during,
        strain_max: report.after,
        strain_error: report.strain_error,
        along: file::Along {
            x_m: along(|at| at.x_m),
            strain_max: along(|at| at.strain),
            stress_max_pa: along(|at| at.stress_pa),
        },
        strength: report.loads.clone(),
        impact,
        ignored,
    })))
}
