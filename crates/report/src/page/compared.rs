//! Several bats on one page, with the differences first.

use crate::page::figure::Figure;
use crate::page::html::Page;
use crate::parts::{Fold, Part, Quantity, Section, Table, Units, sentence};
use crate::plot::compared::pictures;
use crate::report::comparison::{ALONG, ComparisonRow, FIRST, letter, rows, swing, words};
use crate::report::edits;
use sweetspot::Result;
use sweetspot_study::comparison::table::Comparison;

/// The page of bats side by side, made by that command; `us` selects which units are shown first.
///
/// # Errors
///
/// Those of a hit that cannot be computed, as of [`sweetspot::collision::hitter::Hitter::new`].
pub fn page(comparison: &Comparison, command: &str, us: bool) -> Result<String> {
    let figures = Figure::all(|sheet| pictures(sheet, comparison))?;
    let first = comparison.bats[0].bat.name();
    let name = match &comparison.bats[1..] {
        [other] => format!("{first} · {}", other.bat.name()),
        others => format!("{first} and {} other bats", others.len()),
    };
    let sections = [Units::Si, Units::Us].map(|units| sections(comparison, command, units));
    let page = Page {
        kind: "Bats compared",
        name: [&name, ": which hits harder, and where"],
        source: "",
        us,
        sections,
        figures: &figures,
        data: None,
        lab: None,
    };
    Ok(page.text())
}

/// Everything, in order, in one system of units.
fn sections<'a>(comparison: &Comparison, command: &'a str, units: Units) -> Vec<Section<'a>> {
    let (differing, same): (Vec<ComparisonRow>, Vec<ComparisonRow>) =
        ordered(rows(comparison, units)).into_iter().partition(|row| row.differs);
    let (first, others): (Vec<ComparisonRow>, Vec<ComparisonRow>) =
        differing.into_iter().partition(|row| FIRST.contains(&row.key.as_str()));
    let sentences = words(comparison, units).into_iter().map(|text| sentence(&text));
    let (along, best): (Vec<String>, Vec<String>) =
        sentences.partition(|text| text.starts_with(ALONG));
    let section = |fold, id, title, parts| Section { fold, id, title, parts };
    let pictures = |names: &[&'static str]| names.iter().map(|name| Part::Picture(name)).collect();
    let differs = |rows| {
        Part::Table(table(comparison, "What differs by more than the computation's errors", rows))
    };
    let rest = vec![
        differs(others),
        Part::Table(table(comparison, "No significant difference", same)),
        Part::List(along),
    ];
    let how = vec![Part::Command(command), Part::List(scene(comparison, units))];
    let edited = edited(comparison, units);
    let edited = (!edited.is_empty()).then_some(Part::List(edited));
    let top = [Part::Picture("sweet_spot")].into_iter().chain(edited);
    let top = top.chain([Part::List(best), differs(first)]).collect();
    use Fold::{Open, ScreenOnly};
    let (hit, bats) = (["contact", "hysteresis", "hands"], comparison.bats.len());
    vec![
        section(Open, "summary", "Which hits harder", top),
        section(Open, "speed", "How fast the ball leaves", pictures(&["exit_speed", "difference"])),
        section(ScreenOnly, "bats", "The bats", pictures(&["profile"])),
        section(ScreenOnly, "modes", "How they vibrate", pictures(&["shapes"])),
        section(ScreenOnly, "same", "The other figures, and what does not differ", rest),
        section(ScreenOnly, "touch", "The hits at the sweet spots", pictures(&hit)),
        section(ScreenOnly, "energy", "Where the energy goes", pictures(&LEDGERS[..bats])),
        section(ScreenOnly, "inputs", "How they were compared", how),
    ]
}

/// The pictures of energies, one for each bat there can be.
const LEDGERS: [&str; 6] = ["ledger_A", "ledger_B", "ledger_C", "ledger_D", "ledger_E", "ledger_F"];

/// The changes made to each bat.
fn edited(comparison: &Comparison, units: Units) -> Vec<String> {
    let bats = comparison.bats.iter().enumerate();
    let told = bats.map(|(k, contender)| (letter(k), edits::listed(&contender.bat, units)));
    let edited = told.filter(|(_, edits)| !edits.is_empty());
    edited.map(|(bat, edits)| format!("{bat} is edited: {edits}.")).collect()
}

/// The conditions common to all hits.
fn scene(comparison: &Comparison, units: Units) -> Vec<String> {
    let first = &comparison.bats[0];
    let speed = Quantity::Speed.said(units, first.scene.ball_speed);
    vec![
        format!("{} at {speed}.", first.scene.ball.name),
        sentence(
            swing(comparison, units).split_whitespace().collect::<Vec<_>>().join(" ").as_str(),
        ),
        "Differences within the stated errors of both computations count as none.".to_owned(),
    ]
}

/// The most important rows first.
fn ordered(mut rows: Vec<ComparisonRow>) -> Vec<ComparisonRow> {
    let rank =
        |row: &ComparisonRow| FIRST.iter().position(|key| row.key == *key).unwrap_or(FIRST.len());
    rows.sort_by_key(rank);
    rows
}

/// Values of all bats, each but the first with its difference below.
fn table(comparison: &Comparison, caption: &str, rows: Vec<ComparisonRow>) -> Table {
    let bats = comparison.bats.len();
    let letters = (0..bats).map(|k| letter(k).to_string());
    let pieces = rows.iter().any(|row| !row.pieces.is_empty());
    let last = pieces.then(|| "two pieces of one wood".to_owned());
    let head: Vec<String> = [String::new()].into_iter().chain(letters).chain(last).collect();
    let mut table = Table { caption: caption.to_owned(), head, ..Table::default() };
    for ComparisonRow { label, values, differences, pieces: apart, .. } in rows {
        let others = values[1..].iter().zip(differences).map(|(value, by)| match by.as_str() {
            "" | "none" => value.clone(),
            by => format!("{value}\n{by}"),
        });
        let cells = [label, values[0].clone()].into_iter().chain(others);
        let cells = cells.chain(pieces.then_some(apart));
        table.row(cells);
    }
    table
}
