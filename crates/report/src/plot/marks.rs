//! The important places of a bat, its materials and its fixtures, as rows.

use crate::plot::subject::Subject;
use crate::plot::{PlaceRow, Sheet, digits, short};
use sweetspot::base::units::ounces;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::bat::fixtures::{Held, Region};
use sweetspot::{Bat, Material};

/// A bat whose swing turns there beyond the knob end (m), negative inside the handle; None if it is not swung.
pub type MarkedBat<'a> = Subject<'a, Option<f64>>;

/// Balance points, pivots, centres of percussion; for one bat also its materials and fixtures.
pub fn marked(sheet: Sheet, subjects: &[MarkedBat]) -> Vec<PlaceRow> {
    let lengths: Vec<f64> = subjects.iter().map(|s| s.bat.length()).collect();
    let of = |what: &str, place: &dyn Fn(&MarkedBat) -> Option<f64>| {
        let places: Vec<Option<f64>> = subjects.iter().map(place).collect();
        PlaceRow::named(sheet, what, &lengths, &places)
    };
    let on_bat = |s: &MarkedBat| (STANDARD_PIVOT <= s.bat.length()).then_some(STANDARD_PIVOT);
    let standard = |s: &MarkedBat| s.bat.inertia().center_of_percussion(on_bat(s)?);
    let swung = |s: &MarkedBat| s.bat.inertia().center_of_percussion(-s.drawn?);
    let mut rows: Vec<PlaceRow> = [
        of("balance point", &|s| Some(s.bat.inertia().balance_point)),
        of("pivot of standards", &on_bat),
        of("centre of percussion of that pivot", &standard),
        of("pivot of the swing", &|s| s.drawn.map(|beyond| -beyond)),
        of("centre of percussion of the swing", &swung),
    ]
    .into_iter()
    .flatten()
    .collect();
    if let [subject] = subjects {
        rows.extend(fastened(sheet, subject.bat));
    }
    rows
}

/// Other materials, weights, joints, supports and hands, as rows; more than a dozen would
/// crowd the picture.
fn fastened(sheet: Sheet, bat: &Bat) -> Vec<PlaceRow> {
    const MOST: usize = 12;
    let fixtures = bat.fixtures();
    let stretch = |label: String, from, to| PlaceRow::of_stretches(label, vec![(0, [from, to])]);
    let place = |label: String, x| PlaceRow::of_places(label, vec![(0, x)]);
    let made =
        fixtures.regions.iter().filter_map(|r| Some(stretch(made_of(bat, r)?, r.from, r.to)));
    let taped = fixtures
        .tapes
        .iter()
        .map(|tape| stretch(weight(sheet, "tape", tape.mass), tape.from, tape.to));
    let held = fixtures.grip.iter().map(|grip| stretch("hands".into(), grip.from, grip.to));
    let joints = fixtures.joints.iter().map(|joint| place("joint".into(), joint.x));
    let attached = fixtures.attachments.iter().map(|a| {
        let spring = a.mass == 0.0;
        place(if spring { "spring".into() } else { weight(sheet, "weight", a.mass) }, a.x)
    });
    let absorbers =
        fixtures.absorbers.iter().map(|a| place(weight(sheet, "absorber", a.mass), a.x));
    let supports = fixtures.supports.iter().map(|support| {
        let label = if support.kind == Held::Pinned { "pinned" } else { "clamped" };
        place(label.into(), support.x)
    });
    let all = made.chain(taped).chain(held).chain(joints);
    all.chain(attached).chain(absorbers).chain(supports).take(MOST).collect()
}

fn weight(sheet: Sheet, what: &str, mass: f64) -> String {
    match sheet.us {
        true => format!("{what} of {} oz", digits(ounces(mass), 2)),
        false => format!("{what} of {} g", digits(1e3 * mass, 3)),
    }
}

/// The material of a region where it differs from that of the rest.
fn made_of(bat: &Bat, region: &Region) -> Option<String> {
    let name = |material: &Material| match &material.name {
        Some(name) => name.clone(),
        None => format!("{} kg/m³", short(material.density)),
    };
    let outer = &region.layup.outer;
    let wall = (outer != bat.material()).then(|| name(outer));
    let core = region.layup.core.as_ref().map(|core| format!("core of {}", name(core)));
    let sleeves =
        region.layup.sleeves.iter().map(|sleeve| format!("sleeve of {}", name(&sleeve.material)));
    let parts: Vec<String> = wall.into_iter().chain(core).chain(sleeves).collect();
    let (first, others) = parts.split_first()?;
    let others: Vec<String> = others.iter().map(|part| format!(" with a {part}")).collect();
    Some(format!("hatched: {first}{}", others.concat()))
}
