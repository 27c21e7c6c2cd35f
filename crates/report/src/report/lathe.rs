//! What a cut does, band by band: sentences, CSV and JSON. The table is in [`crate::report::lathe_table`].

use crate::csv::Csv;
use crate::parts::cell::Cell;
use crate::parts::terminal::wrapped;
use crate::parts::units::Units;
use crate::report::hit_json::scene_out;
use crate::report::lathe_table::{TableUnits, legend, table};
use crate::report::text::edited;
use crate::schema::lathe as file;
use sweetspot::base::number::significant;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::collision::hit::{Model, Scene};
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot_study::comparison::contender::Figure;
use sweetspot_study::lathe::gauges::{Rivals, WhyNotSmooth};
use sweetspot_study::lathe::map::{LatheMap, TurnedBand};
use sweetspot_study::lathe::recipe::{RecipeCut, least_wood};
use sweetspot_study::lathe::workpiece::Method;
use sweetspot_study::many::answers::Answer;

const MM: f64 = 1e-3;

/// The title, and how the bat is swung.
fn title(map: &LatheMap, scene: &Scene, units: Units) -> String {
    let bat = map.piece.bat();
    let shown = TableUnits::of(units, bat.inches());
    let swing = format!(
        "  swung at {} rad/s about a point {} beyond the knob, {} at {}; per {} taken off the diameter of \
         each band, the curve between stations unchanged",
        significant(scene.swing, 4),
        units.inline(units.length(scene.pivot)),
        scene.ball.name,
        units.inline(units.speed(scene.ball_speed)),
        shown.per_name(),
    );
    format!("What a cut does to {}\n{}{}", bat.name(), edited(bat, units), wrapped(&swing, 4))
}

/// What a screen holds: where a cut does most, and what stands below the tables; None where nothing of that is known.
pub fn screen(map: &LatheMap, scene: &Scene, units: Units) -> Option<String> {
    let most = strongest(map, units);
    if most.is_empty() {
        return None;
    }
    let mut out = title(map, scene, units) + "\nWhere a cut does most\n";
    most.iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    Some(out + &below(map, TableUnits::of(units, map.piece.bat().inches())))
}

/// The change of answer k by the derivative.
fn derivative(band: &TurnedBand, exponent: f64, k: usize) -> Option<f64> {
    let found = band.slopes.as_ref()?.by_law(exponent);
    found[k].map(|figure| figure.value)
}

/// Everything for the terminal.
pub fn text(map: &LatheMap, scene: &Scene, units: Units) -> String {
    let shown = TableUnits::of(units, map.piece.bat().inches());
    let mut out = title(map, scene, units);
    out += &table(map, shown, &derivative);
    let depth = if shown.us() {
        format!("{} in", significant(map.terms.cut / 0.0254, 3))
    } else {
        format!("{} mm", significant(map.terms.cut / MM, 3))
    };
    out += &format!(
        "\nThe same, still per {}, when {depth} come off and all is solved again\n",
        shown.per_name()
    );
    let exponents = map.exponents();
    let finite = |band: &TurnedBand, exponent: f64, k: usize| {
        let law = exponents.iter().position(|n| *n == exponent)?;
        band.finite.as_ref()?[law][k]
    };
    out += &table(map, shown, &finite);
    out += &("\n".to_owned() + &wrapped(&legend(map, shown), 2) + &below(map, shown));
    if let Some(check) = map.check {
        let line = format!(
            "Check: formula and whole bats agree on the frequencies to {check:.0e} of the largest change."
        );
        out += &wrapped(&line, 2);
    }
    out
}

/// Where a cut does most, in three lines.
pub fn in_short(map: &LatheMap, units: Units) -> String {
    let shown = TableUnits::of(units, map.piece.bat().inches());
    let lines = strongest(map, units);
    let mut out = format!("Where a cut does most, per {} off the diameter\n", shown.per_name());
    lines.iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    if lines.is_empty() { String::new() } else { out + "  More: sweetspot lathe\n" }
}

/// Where a cut moves the sweet spot, the first frequency and the fastest ball most; a line each.
pub fn strongest(map: &LatheMap, units: Units) -> Vec<String> {
    let shown = TableUnits::of(units, map.piece.bat().inches());
    let laws = [(0.0, "the same swing"), (0.5, "a swing of the same energy")];
    let line = |what: &str, answer: Answer, exponent: f64| {
        let (band, change) = map.strongest(answer, exponent)?;
        let [from, to] = band.ends.map(|x| shown.place(x));
        Some(format!("{from} to {to}: {}{what}", shown.sentence(answer, change * shown.per())?))
    };
    let mut lines: Vec<String> = [Answer::ExitSpeedPlace, Answer::Frequency(1)]
        .into_iter()
        .filter_map(|answer| line("", answer, 0.0))
        .collect();
    let balls = laws
        .into_iter()
        .filter_map(|(exponent, law)| line(&format!(" for {law}"), Answer::ExitSpeed, exponent));
    let balls: Vec<String> = balls.collect();
    let wall = if map.piece.has_rigid_wall() { " (the wall rigid)" } else { "" };
    lines.extend((!balls.is_empty()).then(|| balls.join("; ") + wall));
    lines
}

/// What [`strongest`] says of, in words for a page.
pub fn per(map: &LatheMap, units: Units) -> &'static str {
    TableUnits::of(units, map.piece.bat().inches()).per_name()
}

/// What stands below the tables.
fn below(map: &LatheMap, shown: TableUnits) -> String {
    let mut out = String::new();
    for (k, line) in recipes(map, shown).into_iter().enumerate() {
        out += if k == 0 { "\n" } else { "" };
        out += &wrapped(&line, 2);
    }
    out += &wholes(map, shown);
    if map.piece.has_rigid_wall() {
        let line = "In all hits here the wall of the barrel is rigid, for every cut would need its hoop \
                    modes anew: sweetspot hit counts them.";
        out += &wrapped(line, 2);
    }
    for rival in &map.piece.rivals {
        let [a, b] = rival.peaks;
        let name = rival.answer.name();
        let [one, other] =
            [a, b].map(|peak| format!("{} at {}", significant(peak.value, 4), shown.place(peak.x)));
        let line = match rival.why {
            WhyNotSmooth::Rivals => format!(
                "No derivative of {name}: it is {one} and {other}, and a cut may make it jump."
            ),
            WhyNotSmooth::Corner => {
                format!("No derivative of {name}: there is a corner, {one}.")
            }
            WhyNotSmooth::Cut => format!(
                "The derivative of {name} does not tell the finite cut of some band: it jumps from \
                 {one} to {other}."
            ),
        };
        out += &wrapped(&line, 2);
    }
    for band in map.bands.iter().filter(|band| band.reason.is_some()) {
        let [from, to] = band.ends.map(|x| shown.place(x));
        let reason = band.reason.as_deref().unwrap_or_default();
        out += &wrapped(&format!("{from} to {to}: {reason}."), 2);
    }
    out
}

/// The least wood for what makers ask most.
fn recipes(map: &LatheMap, shown: TableUnits) -> Vec<String> {
    let cuts = |cuts: &[RecipeCut]| {
        let one = |cut: &RecipeCut| {
            let [from, to] = cut.ends.map(|x| shown.place(x));
            format!("{} off {from} to {to}", shown.depth(cut.depth))
        };
        cuts.iter().map(one).collect::<Vec<_>>().join(", ")
    };
    // Every cut lowers the swing weight.
    let most = 0.01 * map.piece.bat().inertia().about(STANDARD_PIVOT);
    let (far, by) = if shown.us() { ("1/16 in", 0.0254 / 16.0) } else { ("1 mm", MM) };
    let wishes = [
        (Answer::Frequency(1), 1.0, "raise f1 by 1 Hz".to_owned()),
        (Answer::ExitSpeedPlace, by, format!("move the sweet spot {far} outward")),
        (Answer::ExitSpeedPlace, -by, format!("move the sweet spot {far} inward")),
    ];
    let one = |(answer, by, what): &(Answer, f64, String)| {
        map.terms.answers.contains(answer).then_some(())?;
        let kept = "keep the swing weight within 1 %";
        Some(match least_wood(map, (*answer, *by), most) {
            Some(found) => format!("To {what} and {kept}, the least wood: {}.", cuts(&found)),
            None => {
                let how = "not by cuts that leave nine tenths of the diameter";
                format!("To {what} and {kept}: {how}.")
            }
        })
    };
    wishes.iter().filter_map(one).collect()
}

/// Knob weight, cup, hole and cork, solved.
fn wholes(map: &LatheMap, shown: TableUnits) -> String {
    let mut out = String::from("\nSolved, for a derivative does not tell it (same swing)\n");
    for whole in &map.wholes {
        let line = match &whole.change {
            Err(reason) => format!("  {}: cannot be done here ({reason})", whole.what),
            Ok(found) => {
                let of = |(k, answer): (usize, &Answer)| shown.sentence(*answer, found[0][k]?);
                let all: Vec<String> =
                    map.terms.answers.iter().enumerate().filter_map(of).collect();
                format!("  {}: {}", whole.what, all.join(", "))
            }
        };
        out += &wrapped(&line, 4);
    }
    out
}

/// Places of the curves along the bat.
const CURVE: usize = 240;

/// The `sweetspot-lathe/1` document.
pub fn document(map: &LatheMap, scene: &Scene, model: Model) -> file::LatheFile {
    let bat = map.piece.bat();
    let places: Vec<f64> = (0..=CURVE).map(|k| bat.length() * k as f64 / CURVE as f64).collect();
    let frequency = |answer: &Answer| match answer {
        Answer::Frequency(order) => {
            let per = map.curve(*order, &places)?;
            let per = per.into_iter().map(|density| density * MM * MM).collect();
            Some((format!("{}_per_mm_mm", answer.name()), per))
        }
        _ => None,
    };
    let output = |(answer, value): (&Answer, &Option<Figure>)| file::Output {
        name: answer.name(),
        value: value.map(|value| value.value),
        error: value.map(|value| value.error).filter(|error| *error > 0.0),
        method: Method::of(*answer).name().to_owned(),
    };
    file::LatheFile {
        format: Format::new(),
        generator: Generator::this(),
        bat_name: bat.name().to_owned(),
        edits: bat.edits().to_vec(),
        model: model.name().to_owned(),
        scene: scene_out(bat, scene),
        theory: map.piece.solution().theory.name().to_owned(),
        per: "mm of diameter taken off".to_owned(),
        swing_exponent: map.terms.exponent,
        outputs: map.terms.answers.iter().zip(map.piece.values()).map(output).collect(),
        bands: map.bands.iter().map(|band| lathe_band(map, band)).collect(),
        curves: file::Curves {
            density: map.terms.answers.iter().filter_map(frequency).collect(),
            x_m: places,
        },
        added_mass: added_mass(map),
        done_to_the_end: done_to_the_end(map),
        not_smooth_at: not_smooth(map),
        check: file::Check { formula_against_difference: map.check },
        tolerance_met: map.piece.met,
    }
}

/// Values by the names of the answers; of hits alone if asked so.
fn changes(map: &LatheMap, of_hits: bool, value: impl Fn(usize) -> Option<f64>) -> file::Changes {
    let all = map.terms.answers.iter().enumerate();
    let all = all.filter(|(_, answer)| !of_hits || answer.of_a_hit());
    all.map(|(k, answer)| (answer.name(), value(k))).collect()
}

fn lathe_band(map: &LatheMap, band: &TurnedBand) -> file::LatheBand {
    let slopes = band.slopes.as_ref();
    let by = |of_hits: bool, exponent: f64| {
        let found = slopes?.by_law(exponent);
        Some(changes(map, of_hits, |k| found[k].map(|figure| figure.value * MM)))
    };
    let errors = slopes.map(|slopes| {
        changes(map, false, |k| slopes.same_swing[k].map(|figure| figure.error * MM))
    });
    let exponents = map.exponents();
    let finite = band.finite.as_ref().map(|found| file::FiniteCut {
        cut_mm: map.terms.cut / MM,
        change: changes(map, false, |k| found[0][k].map(|value| value * MM)),
        same_energy: changes(map, true, |k| found[1][k].map(|value| value * MM)),
        by_law: exponents
            .get(2)
            .map(|_| changes(map, true, |k| found[2][k].map(|value| value * MM))),
    });
    file::LatheBand {
        from_m: band.ends[0],
        to_m: band.ends[1],
        diameter_m: band.diameter,
        change: by(false, 0.0),
        change_same_energy: by(true, 0.5),
        change_by_law: exponents.get(2).and_then(|n| by(true, *n)),
        error: errors,
        finite,
        reason: band.reason.clone(),
    }
}

fn added_mass(map: &LatheMap) -> file::AddedMass {
    let told = |k: &usize| map.weights.iter().any(|weight| weight.per_kilogram[*k].is_some());
    let of = |k: usize| {
        let per_g = |value: f64| 1e-3 * value;
        let all = map.weights.iter().map(|weight| weight.per_kilogram[k].map(per_g)).collect();
        (map.terms.answers[k].name(), all)
    };
    file::AddedMass {
        x_m: map.weights.iter().map(|weight| weight.x).collect(),
        per_g: (0..map.terms.answers.len()).filter(told).map(of).collect(),
    }
}

fn done_to_the_end(map: &LatheMap) -> Vec<file::DoneToTheEnd> {
    let one = |whole: &sweetspot_study::lathe::map::WholeChange| {
        let by = |law: usize| {
            let found = whole.change.as_ref().ok()?.get(law)?;
            Some(changes(map, law > 0, |k| found[k]))
        };
        file::DoneToTheEnd {
            what: whole.what.to_owned(),
            change: by(0),
            change_same_energy: by(1),
            change_by_law: by(2),
            reason: whole.change.as_ref().err().cloned(),
        }
    };
    map.wholes.iter().map(one).collect()
}

fn not_smooth(map: &LatheMap) -> Vec<file::NotSmooth> {
    let one = |rivals: &Rivals| file::NotSmooth {
        name: rivals.answer.name(),
        why: match rivals.why {
            WhyNotSmooth::Rivals => "rivals",
            WhyNotSmooth::Corner => "corner",
            WhyNotSmooth::Cut => "cut",
        }
        .to_owned(),
        x_m: rivals.peaks.map(|peak| peak.x),
        value: rivals.peaks.map(|peak| peak.value),
    };
    map.piece.rivals.iter().map(one).collect()
}

/// A line for each band, SI, per mm of diameter taken off.
pub fn csv(map: &LatheMap) -> String {
    let mut names: Vec<String> = ["from_m", "to_m", "diameter_m"].map(str::to_owned).to_vec();
    let exponents = map.exponents();
    for answer in &map.terms.answers {
        let name = answer.name();
        names.extend(["", "_error", "_finite"].map(|end| format!("{name}{end}")));
        if answer.of_a_hit() {
            names.push(format!("{name}_same_energy"));
            names.extend(exponents.get(2).map(|_| format!("{name}_by_law")));
        }
    }
    let mut table = Csv::new(names);
    for band in &map.bands {
        let mut row: Vec<Cell> = [band.ends[0], band.ends[1], band.diameter].map(Cell::from).into();
        let by = |exponent: f64, k: usize| {
            let found = band.slopes.as_ref()?.by_law(exponent);
            found[k]
        };
        for (k, answer) in map.terms.answers.iter().enumerate() {
            let slope = by(0.0, k);
            row.push(slope.map(|figure| figure.value * MM).into());
            row.push(slope.map(|figure| figure.error * MM).into());
            row.push(band.finite.as_ref().and_then(|found| found[0][k]).map(|v| v * MM).into());
            if answer.of_a_hit() {
                for exponent in &exponents[1..] {
                    row.push(by(*exponent, k).map(|figure| figure.value * MM).into());
                }
            }
        }
        table.row(row);
    }
    table.text()
}
