//! BBCOR along a bat: text and columns.

use schemars::JsonSchema;
use serde::Serialize;

use crate::parts::cell::Quantity::{Error, Length, Ratio, Speed, Words};
use crate::parts::{Column, Part, Quantity, Table, Units};
use crate::report::edits;
use crate::report::wall_text::{wall_facts, wall_words};
use crate::schema::{Written, document};
use sweetspot::bat::edit::Edit;
use sweetspot::collision::bbcor::{
    LIMIT, LIMIT_SOURCE, Largest, MEASURES_SOURCE, Place, Scan, Tested,
};
use sweetspot_study::ignored;
use sweetspot_study::spread::of_frequencies;

/// BBCOR along a bat as laboratories measure it, with the bat at rest on a pivot. It is computed and is not a
/// certificate. SI units, named at the end of each member; positions count from the knob end; a value that does not
/// exist is null. Later versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "BBCOR file of sweetspot, sweetspot-bbcor/1")]
pub struct BbcorFile {
    /// Name of the bat.
    pub bat_name: String,
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Settings and results of the scan.
    #[serde(flatten)]
    pub scan: Scan,
    /// Neglected effects and their consequences.
    pub ignored: Vec<String>,
}

document!(BbcorFile, "bbcor");

/// The document of that test.
pub fn document(tested: &Tested) -> Written<BbcorFile> {
    let Tested { bat, scene, scan, .. } = tested;
    let (edits, scan) = (bat.edits().to_vec(), scan.clone());
    let (bat_name, ignored) = (bat.name().to_owned(), ignored::in_hit(bat, scene));
    Written::of(BbcorFile { bat_name, edits, scan, ignored })
}

/// The columns of the scan.
pub const COLUMNS: [Column<Place>; 9] = [
    Column::new("knob", "x_m", Length, |at| at.x_m.into()),
    Column::both("tip", "from_tip_m", Length, |at| at.from_tip_m.into()),
    Column::both("rebound", "exit_speed_m_s", Speed, |at| at.exit_speed_m_s.into()),
    Column::new("e_A", "collision_efficiency", Ratio(4), |at| at.collision_efficiency.into()),
    Column::new("BBCOR", "bbcor", Ratio(4), |at| at.bbcor.into()),
    Column::new("within", "bbcor_error", Error, |at| at.error.bbcor.into()),
    Column::in_files("besr", |at| at.besr.into()),
    Column::in_files("bpf", |at| at.bpf.into()),
    Column::new("why not", "", Words, |at| {
        at.bbcor.map_or(Some(at.flags.join(" ")), |_| None).into()
    }),
];

/// Number of places on either side of the largest on a screen.
const BESIDE: usize = 2;
/// A likely difference between two bats of one model: three standard deviations for an R161, with 22 % scatter of
/// stiffness and 10 % of density (`sweetspot scatter r161`).
const NEAR: f64 = 0.01;

/// The title, and everything in order; `full` with every place and every source.
pub fn report(tested: &Tested, units: Units, full: bool) -> (String, Vec<Part<'static>>) {
    let Tested { bat, scene, scan, .. } = tested;
    let Scan { protocol, places, largest, .. } = scan;
    let speed = Quantity::Speed.said(units, protocol.ball_speed_m_s);
    let cor = if protocol.ball.cor_by_speed.is_empty() {
        protocol.cor.to_string()
    } else {
        "by its speed".to_owned()
    };
    let source = if full { format!(": {}", protocol.cor_source) } else { String::new() };
    let pivot = Quantity::Length.said(units, protocol.pivot_m);
    let mut notes = vec![format!(
        "bat at rest on a pivot {pivot} from the knob end; {} at {speed}, cor {cor}{source}",
        protocol.ball.title()
    )];
    notes.extend(edits::noted(bat, units));
    notes.extend(scene.hoop.wall().map(|wall| wall_words(bat, scene, wall)));
    notes.extend(ignored::in_hit(bat, scene).iter().map(|effect| format!("left out: {effect}")));
    let shown = if full { &places[..] } else { around(places, largest.as_ref()) };
    let mut parts = vec![Part::List(notes), Part::Table(Table::of("", &COLUMNS, shown, units))];
    let left = places.len() - shown.len();
    parts.extend((left > 0).then(|| Part::List(vec![format!("and {left} places more")])));
    if let Some(wall) = scan.wall.as_ref().filter(|_| full) {
        parts.extend([
            Part::Heading("Where it is largest"),
            Part::Facts("", wall_facts(wall, units)),
        ]);
    }
    parts.extend(verdict(tested, units, full).into_iter().map(Part::Text));
    (format!("BBCOR of {} (computed, not certified)", bat.title()), parts)
}

/// The places around the largest, as many as a first screen shows.
fn around<'a>(places: &'a [Place], largest: Option<&Largest>) -> &'a [Place] {
    let at =
        largest.and_then(|most| places.iter().position(|place| place.x_m == most.x_m)).unwrap_or(0);
    let from = at.saturating_sub(BESIDE).min(places.len().saturating_sub(2 * BESIDE + 1));
    &places[from..places.len().min(from + 2 * BESIDE + 1)]
}

/// The largest against the limit, in sentences.
fn verdict(tested: &Tested, units: Units, full: bool) -> Vec<String> {
    let scan = &tested.scan;
    let Some(Largest { from_tip_m, bbcor, besr, bpf, .. }) = scan.largest else {
        return vec!["No place of the scan has a figure.".to_owned()];
    };
    let place = Quantity::Length.said(units, from_tip_m);
    let against = match scan.within_limit {
        Some(true) => "below the limit of",
        Some(false) => "above the limit of",
        None => "as near as its error to the limit of",
    };
    let source = if full { format!(" ({LIMIT_SOURCE})") } else { String::new() };
    let mut said = vec![format!(
        "Largest of {} places {bbcor:.4}, {place} from the tip: {against} {LIMIT:.2}{source}. It rises with the \
         ball's cor by about as much; a laboratory's ball and limit decide, not this.",
        scan.places.len()
    )];
    let there = scan
        .places
        .iter()
        .find(|place| Some(place.x_m) == scan.largest.as_ref().map(|most| most.x_m));
    if there.is_some_and(|place| place.flags.iter().any(|flag| flag == "ball_law_beyond")) {
        said.push("The ball's law was not measured for such a hit (docs/limits.md).".to_owned());
    }
    if let Some(wall) = scan.wall.as_ref().filter(|wall| wall.is_deep()) {
        let [low, high] = wall.bbcor.range;
        said.push(format!(
            "The wall is dented by more than half of its thickness there, where the theory of it ends: the figure \
             is rough, {low:.3} to {high:.3} by what balls squeezed twice to half as much do."
        ));
    }
    if let Some((besr, bpf)) = besr.zip(bpf) {
        let source = if full { format!(" ({MEASURES_SOURCE})") } else { String::new() };
        said.push(format!(
            "There BESR, e_A + 1/2, is {besr:.4}, and BPF, BBCOR over the ball's cor, {bpf:.3}{source}."
        ));
    }
    if of_frequencies(&tested.bat).is_some() && (bbcor - LIMIT).abs() < NEAR {
        said.push(
            "Trust: pieces of one wood differ by more than the last digits here, so that a bat this near the limit \
             may be on either side of it: sweetspot scatter"
                .to_owned(),
        );
    }
    said
}
