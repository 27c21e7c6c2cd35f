//! The effect of a cut, band by band: sentences, CSV and JSON. The table is in [`crate::report::lathe_table`].

use schemars::JsonSchema;
use serde::Serialize;

use crate::csv::Csv;
use crate::parts::{Cell, Quantity, Units, wrapped};
use crate::report::hit_json::scene_out;
use crate::report::lathe_table::{TableUnits, legend, table};
use crate::report::text::edited;
use crate::schema::{Written, document, hit};
use sweetspot::base::number::significant;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::bat::edit::Edit;
use sweetspot::collision::{Model, Scene};
use sweetspot_study::answers::Answer;
use sweetspot_study::ignored::in_hit;
use sweetspot_study::lathe::found::{LatheFound, TurnedBand, WholeChange};
use sweetspot_study::lathe::gauges::WhyNotSmooth;
use sweetspot_study::lathe::map::LatheMap;
use sweetspot_study::lathe::recipe::{RecipeCut, least_wood};

const MM: f64 = 1e-3;

/// The title, and how the bat is swung.
fn title(map: &LatheMap, scene: &Scene, units: Units) -> String {
    let bat = map.piece.bat();
    let shown = TableUnits::of(units, bat);
    let swing = format!(
        "  swung at {} rad/s about a point {} beyond the knob, {} at {}; per {} taken off the diameter of \
         each band, the curve between stations unchanged",
        significant(scene.swing, 4),
        Quantity::Length.said(units, scene.pivot),
        scene.ball.title(),
        Quantity::Speed.said(units, scene.ball_speed),
        shown.per_name(),
    );
    format!("What a cut does to {}\n{}{}", bat.title(), edited(bat, units), wrapped(&swing, 4))
}

/// The text of a screen: where a cut has the largest effects, and the text below the tables; None where that is not
/// known.
pub fn screen(map: &LatheMap, scene: &Scene, units: Units) -> Option<String> {
    let most = strongest(map, units);
    if most.is_empty() {
        return None;
    }
    let mut out = title(map, scene, units) + "\nWhere a cut does most\n";
    most.iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    Some(out + &below(map, TableUnits::of(units, map.piece.bat())))
}

/// The whole text for the terminal: the title, both tables, and the text below them.
pub fn text(map: &LatheMap, scene: &Scene, units: Units) -> [String; 4] {
    let shown = TableUnits::of(units, map.piece.bat());
    let (per, unit) = if shown.us() { (0.0254, "in") } else { (MM, "mm") };
    let cuts = format!(
        "\nThe same, still per {}, when {} {unit} come off and all is solved again\n{}",
        shown.per_name(),
        significant(map.terms.cut / per, 3),
        table(map, shown, TurnedBand::when_cut)
    );
    let mut out = "\n".to_owned() + &wrapped(&legend(map, shown), 2) + &below(map, shown);
    if let Some(check) = map.found.check.formula_against_difference {
        let line = format!(
            "Check: formula and whole bats agree on the frequencies to {check:.0e} of the largest change."
        );
        out += &wrapped(&line, 2);
    }
    [title(map, scene, units), table(map, shown, TurnedBand::derivative), cuts, out]
}

/// Where a cut has the largest effects, in three lines.
pub fn in_short(map: &LatheMap, units: Units) -> String {
    let shown = TableUnits::of(units, map.piece.bat());
    let lines = strongest(map, units);
    let mut out = format!("Where a cut does most, per {} off the diameter\n", shown.per_name());
    lines.iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    if lines.is_empty() { String::new() } else { out + "  More: sweetspot lathe\n" }
}

/// Where a cut changes the sweet spot, the first frequency and the highest exit speed most; a line each.
pub fn strongest(map: &LatheMap, units: Units) -> Vec<String> {
    let shown = TableUnits::of(units, map.piece.bat());
    let laws = [(0.0, "the same swing"), (0.5, "a swing of the same energy")];
    let line = |what: &str, answer: Answer, exponent: f64| {
        let (band, change) = map.strongest(answer, exponent)?;
        let [from, to] = band.ends().map(|x| shown.place(x));
        let change = change / MM * shown.per();
        Some(format!("{from} to {to}: {}{what}", shown.sentence(answer, change)?))
    };
    let mut lines: Vec<String> = [Answer::ExitSpeedPlace, Answer::Frequency(1)]
        .into_iter()
        .filter_map(|answer| line("", answer, 0.0))
        .collect();
    let balls = laws
        .into_iter()
        .filter_map(|(exponent, law)| line(&format!(" for {law}"), Answer::ExitSpeed, exponent));
    let balls: Vec<String> = balls.collect();
    lines.extend((!balls.is_empty()).then(|| balls.join("; ")));
    lines
}

/// The unit of cut in [`strongest`], in words for a page.
pub fn per(map: &LatheMap, units: Units) -> &'static str {
    TableUnits::of(units, map.piece.bat()).per_name()
}

/// The text below the tables.
fn below(map: &LatheMap, shown: TableUnits) -> String {
    let mut out = String::new();
    for (k, line) in recipes(map, shown).into_iter().enumerate() {
        out += if k == 0 { "\n" } else { "" };
        out += &wrapped(&line, 2);
    }
    out += &wholes(map, shown);
    let (mut uneven, mut lines) = (vec![], vec![]);
    for rival in &map.found.not_smooth_at {
        let name = named(rival.answer);
        let [one, other] = rival.x_m.map(|x| shown.place(x));
        match rival.why {
            WhyNotSmooth::Rivals => lines.push(format!(
                "No slope of {name}: places at {one} and {other} are rivals, and a cut may make it jump."
            )),
            WhyNotSmooth::Corner => lines.push(format!("No slope of {name}: it has a corner at {one}.")),
            WhyNotSmooth::Cut if uneven.contains(&name) => {}
            WhyNotSmooth::Cut => uneven.push(name),
        }
    }
    if !uneven.is_empty() {
        lines.push(format!(
            "The slopes do not predict finite cuts of some bands for: {}.",
            uneven.join(", ")
        ));
    }
    lines.iter().for_each(|line| out += &wrapped(line, 2));
    for band in map.found.bands.iter().filter(|band| band.reason.is_some()) {
        let [from, to] = band.ends().map(|x| shown.place(x));
        let reason = band.reason.as_deref().unwrap_or_default();
        out += &wrapped(&format!("{from} to {to}: {reason}."), 2);
    }
    out
}

/// The smallest amount of wood for the most frequent wishes.
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
            Some(found) => format!("To {what} and {kept}, the least material: {}.", cuts(&found)),
            None => {
                let how = "not by cuts that leave nine tenths of the diameter";
                format!("To {what} and {kept}: {how}.")
            }
        })
    };
    wishes.iter().filter_map(one).collect()
}

/// An answer in words.
fn named(answer: Answer) -> String {
    let name = match answer {
        Answer::ExitSpeed => "fastest ball",
        Answer::ExitSpeedPlace => "sweet spot",
        Answer::Zone(_) => "sweet zone",
        Answer::Vibration => "vibration",
        Answer::VibrationPlace => "place of least vibration",
        Answer::Bbcor => "BBCOR",
        Answer::HandsVelocity | Answer::HandsAcceleration => "hands",
        _ => return answer.name(),
    };
    name.to_owned()
}

/// Knob weight, cup, hole and cork, each solved.
fn wholes(map: &LatheMap, shown: TableUnits) -> String {
    let mut out = String::from("\nSolved, for a derivative does not tell it (same swing)\n");
    for whole in &map.found.done_to_the_end {
        let WholeChange { what, reason, .. } = whole;
        let line = match reason {
            Some(reason) => format!("  {what}: not on this bat ({reason})"),
            None => {
                let of = |answer: &Answer| shown.sentence(*answer, whole.of(*answer)?);
                let all: Vec<String> = map.terms.answers.iter().filter_map(of).collect();
                format!("  {what}: {}", all.join(", "))
            }
        };
        out += &wrapped(&line, 4);
    }
    out
}

/// How cuts and weights change a bat. SI units, named at the end of each member; positions count from the knob end; a
/// value that does not exist is null. Changes of bands are per millimetre of diameter removed. Later versions with the
/// same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Lathe file of sweetspot, sweetspot-lathe/1")]
pub struct LatheFile {
    /// Name of the bat.
    pub bat_name: String,
    /// Changes made to the bat before; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// The collision model: how the bending of the bat is treated in hits.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: String,
    /// The swing and the ball.
    pub scene: hit::Scene,
    /// The beam theory of the modes.
    #[schemars(extend("enum" = ["euler-bernoulli", "rayleigh", "timoshenko"]))]
    pub theory: String,
    /// The results.
    #[serde(flatten)]
    pub found: LatheFound,
    /// Neglected effects and their consequences; left out where none is known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ignored: Vec<String>,
}

document!(LatheFile, "lathe");

/// The `sweetspot-lathe/1` document.
pub fn document(map: &LatheMap, scene: &Scene, model: Model) -> Written<LatheFile> {
    let bat = map.piece.bat();
    Written::of(LatheFile {
        bat_name: bat.name().to_owned(),
        edits: bat.edits().to_vec(),
        model: model.name().to_owned(),
        scene: scene_out(bat, scene),
        theory: map.piece.solution().theory.name().to_owned(),
        found: map.found.clone(),
        ignored: in_hit(bat, scene),
    })
}

/// A line for each band, SI, per mm of diameter removed.
pub fn csv(map: &LatheMap) -> String {
    let mut names: Vec<String> = ["from_m", "to_m", "diameter_m"].map(str::to_owned).to_vec();
    let exponents = map.terms.exponents();
    for answer in &map.terms.answers {
        let name = answer.name();
        names.extend(["", "_error", "_finite"].map(|end| format!("{name}{end}")));
        if answer.of_a_hit() {
            names.push(format!("{name}_same_energy"));
            names.extend(exponents.get(2).map(|_| format!("{name}_by_law")));
        }
    }
    let mut table = Csv::new(names);
    for band in &map.found.bands {
        let mut row: Vec<Cell> = [band.from_m, band.to_m, band.diameter_m].map(Cell::from).into();
        for answer in &map.terms.answers {
            let slope = band.derivative(*answer, 0.0);
            row.extend([slope, band.error(*answer), band.when_cut(*answer, 0.0)].map(Cell::from));
            let laws = exponents[1..].iter().filter(|_| answer.of_a_hit());
            row.extend(laws.map(|exponent| Cell::from(band.derivative(*answer, *exponent))));
        }
        table.row(row);
    }
    table.text()
}
