//! BBCOR along a bat: table, CSV and JSON.

use std::fmt::Write;

use crate::base::units::{inches, miles_per_hour};
use crate::bat::body::STANDARD_PIVOT;
use crate::collision::bbcor::{
    COR_SOURCE, LIMIT, LIMIT_SOURCE, MEASURES_SOURCE, Place, Protocol, STEP, Tested,
};
use crate::collision::columns::{BBCOR, EFFICIENCY, EXIT_SPEED, X};
use crate::files::schema::bbcor as file;
use crate::files::schema::document::{Format, Generator};
use crate::show::csv::Csv;
use crate::show::report::columns::{Columns, numbers};
use crate::show::report::hit_json::{ball_out, wall_under_ball};
use crate::show::report::text::{edited, wrapped};
use crate::show::report::units::Units;
use crate::show::report::wall_text::{wall_lines, wall_words};
use crate::study::ignored;
use crate::study::spread::of_frequencies;

/// Where the ball's restitution is from: the source of the default, the ball's file, or who asked.
pub fn cor_source(tested: &Tested, given: bool) -> String {
    let ball = &tested.protocol.ball;
    match (given, ball.name.as_str()) {
        (true, _) => "given with --cor".to_owned(),
        (false, "baseball") => COR_SOURCE.to_owned(),
        (false, _) => format!("the ball's own ({})", ball.source),
    }
}

/// Everything for the terminal.
pub fn text(tested: &Tested, cor_source: &str, units: Units) -> String {
    let protocol = &tested.protocol;
    let mut out = format!("BBCOR of {} (computed, not certified)\n", tested.bat.name());
    out += &edited(&tested.bat, units);
    let pivot = units.inline(units.length(STANDARD_PIVOT));
    let speed = units.inline(units.speed(protocol.ball_speed));
    let cor = match protocol.ball.cor_by_speed.is_empty() {
        true => protocol.cor.to_string(),
        false => "by its speed".to_owned(),
    };
    let scene = format!(
        "  bat at rest on a pivot {pivot} from the knob end; {} at {speed}, cor {cor}: {cor_source}",
        protocol.ball.name
    );
    out += &wrapped(&scene, 4);
    if let Some(wall) = tested.scene.hoop.wall() {
        out += &wrapped(&format!("  {}", wall_words(&tested.bat, &tested.scene, wall)), 4);
    }
    for effect in ignored::in_hit(&tested.bat, &tested.scene) {
        out += &wrapped(&format!("  left out: {effect}"), 4);
    }
    out += &table(tested, units);
    if let Some(wall) = &tested.wall {
        out += "\nWhere it is largest\n";
        for [what, value] in wall_lines(wall, wall.bbcor_pivoted, units) {
            let _ = writeln!(out, "  {what:<40} {value}");
        }
    }
    out + &verdict(tested, units)
}

fn table(tested: &Tested, units: Units) -> String {
    let us = units.us_first();
    let (near, fast) = if us { ("in", "mph") } else { ("cm", "m/s") };
    let columns = Columns::new([
        numbers(9, "knob"),
        numbers(10, "tip"),
        numbers(10, "rebound"),
        numbers(10, ""),
        numbers(9, "e_A"),
        numbers(10, "BBCOR"),
        numbers(10, "within"),
    ]);
    let [tip, second] = match units {
        Units::Both => ["in", "mph"],
        Units::BothUsFirst => ["in", "m/s"],
        _ => [near, ""],
    };
    let mut out = String::from("\n");
    out += &columns.heads();
    out += &columns.row([near, tip, fast, second, "", "", ""]);
    let length = |x: f64, unit: &str| {
        format!("{:.2}", if unit == "in" { inches(x) } else { 100.0 * x } + 0.0)
    };
    for (k, place) in tested.places.iter().enumerate() {
        let x = place.impact.x;
        let outcome = place.impact.outcome.as_ref();
        let shown = |v: f64| format!("{:.2}", if us { miles_per_hour(v) } else { v });
        let other = |v: f64| match us {
            true => format!("{v:.2}"),
            false => format!("{:.1}", miles_per_hour(v)),
        };
        let line = columns.row([
            length(x, near),
            length(tested.bat.length() - x, tip),
            outcome.map_or("no value".to_owned(), |o| shown(o.exit_speed)),
            outcome.filter(|_| units.both()).map_or(String::new(), |o| other(o.exit_speed)),
            outcome.map_or(String::new(), |o| format!("{:.4}", o.collision_efficiency)),
            place.bbcor.map_or(String::new(), |bbcor| format!("{bbcor:.4}")),
            place.error.map_or(String::new(), |error| format!("{error:.0e}")),
        ]);
        let mark = if tested.largest == Some(k) { "  largest" } else { "" };
        let _ = writeln!(out, "{}{mark}", line.trim_end());
    }
    out
}

/// By so much two bats of one wood differ easily: three standard deviations of an R161's, whose stiffness differs by
/// 22 % and whose density by 10 % (`sweetspot scatter r161`).
const NEAR: f64 = 0.01;

/// The largest against the limit, in a sentence.
fn verdict(tested: &Tested, units: Units) -> String {
    let Some((most, bbcor)) = tested.most().and_then(|most| Some((most, most.bbcor?))) else {
        return "\nNo place of the scan has a figure.\n".to_owned();
    };
    let place = units.inline(units.length(tested.bat.length() - most.impact.x));
    let against = match tested.within() {
        Some(true) => format!("below the limit of {LIMIT:.2}"),
        Some(false) => format!("above the limit of {LIMIT:.2}"),
        None => format!("as near the limit of {LIMIT:.2} as its error"),
    };
    let text = format!(
        "Largest {bbcor:.4}, {place} from the tip: {against} ({LIMIT_SOURCE}). It rises with the \
         ball's cor by about as much; a laboratory's ball and limit decide, not this."
    );
    let deep = tested.wall.as_ref().filter(|wall| wall.is_deep()).map(|wall| {
        let [low, high] = wall.bbcor.range;
        let text = format!(
            "The wall is dented by more than half of its thickness there, where the theory of it ends: the \
             figure is rough, {low:.3} to {high:.3} by what balls squeezed twice to half as much do."
        );
        wrapped(&text, 0)
    });
    let figures = most.besr().zip(most.bpf(&tested.protocol)).map(|(besr, bpf)| {
        let text = format!(
            "There BESR, e_A + 1/2, is {besr:.4}, and BPF, BBCOR over the ball's cor, {bpf:.3} \
             ({MEASURES_SOURCE})."
        );
        wrapped(&text, 0)
    });
    let open = of_frequencies(&tested.bat).map(|_| {
        let text = "Trust: pieces of one wood differ by more than the last digits here, so that a bat this near the \
                    limit may be on either side of it: sweetspot scatter";
        wrapped(text, 7)
    });
    let open = open.filter(|_| (bbcor - LIMIT).abs() < NEAR);
    let [deep, figures, open] = [deep, figures, open].map(Option::unwrap_or_default);
    format!("\n{}{deep}{figures}{open}", wrapped(&text, 0))
}

/// A line for each place, SI.
pub fn csv(tested: &Tested) -> String {
    let [x, exit, efficiency, bbcor] = [X, EXIT_SPEED, EFFICIENCY, BBCOR].map(|c| c.name);
    let mut table =
        Csv::new([x, "from_tip_m", exit, efficiency, bbcor, "bbcor_error", "besr", "bpf"]);
    for place in &tested.places {
        table.row([
            place.impact.x.into(),
            (tested.bat.length() - place.impact.x).into(),
            EXIT_SPEED.at(&place.impact).into(),
            EFFICIENCY.at(&place.impact).into(),
            place.bbcor.into(),
            place.error.into(),
            place.besr().into(),
            place.bpf(&tested.protocol).into(),
        ]);
    }
    table.text()
}

/// The `sweetspot-bbcor/1` document.
pub fn document(tested: &Tested, cor_source: &str) -> file::BbcorFile {
    let (protocol, length) = (&tested.protocol, tested.bat.length());
    let largest = |place: &Place| {
        Some(file::Largest {
            x_m: place.impact.x,
            from_tip_m: length - place.impact.x,
            bbcor: place.bbcor?,
            besr: place.besr(),
            bpf: place.bpf(protocol),
            error: place.error?,
        })
    };
    file::BbcorFile {
        format: Format::new(),
        generator: Generator::this(),
        bat_name: tested.bat.name().to_owned(),
        edits: tested.bat.edits().to_vec(),
        certified: false,
        protocol: file::Protocol {
            pivot_m: STANDARD_PIVOT,
            inertia_pivot_kg_m2: tested.bat.inertia().about(STANDARD_PIVOT),
            ball_speed_m_s: protocol.ball_speed,
            step_m: STEP,
            ball: ball_out(&protocol.ball),
            cor: protocol.cor,
            cor_source: cor_source.to_owned(),
            limit_source: LIMIT_SOURCE.to_owned(),
            measures_source: MEASURES_SOURCE.to_owned(),
        },
        places: tested.places.iter().map(|at| place(at, length, protocol)).collect(),
        largest: tested.most().and_then(largest),
        wall: tested.wall.map(|wall| wall_under_ball(&wall, wall.bbcor_pivoted)),
        limit: LIMIT,
        within_limit: tested.within(),
        tolerance_met: tested.sweep.met,
        ignored: ignored::in_hit(&tested.bat, &tested.scene),
    }
}

fn place(place: &Place, length: f64, protocol: &Protocol) -> file::Place {
    let (impact, outcome) = (&place.impact, place.impact.outcome.as_ref());
    file::Place {
        x_m: impact.x,
        from_tip_m: length - impact.x,
        exit_speed_m_s: EXIT_SPEED.at(impact),
        collision_efficiency: EFFICIENCY.at(impact),
        bbcor: place.bbcor,
        besr: place.besr(),
        bpf: place.bpf(protocol),
        flags: impact.flags.iter().map(|flag| (*flag).to_owned()).collect(),
        error: file::PlaceError {
            exit_speed_m_s: outcome.map(|o| o.error * protocol.ball_speed),
            bbcor: place.error,
        },
    }
}
