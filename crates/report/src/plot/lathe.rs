//! The bat coloured by the effect of a cut at each place, with a strip for each output.

use crate::parts::in_trade;
use crate::plot::profile::widest;
use crate::plot::{
    Anchor, Chart, FRAME, Frame, Ink, LABEL, Lying, Panel, Pen, Picture, SERIES, SMALL, Sheet, Svg,
    digits, fitted, place,
};
use sweetspot::Bat;
use sweetspot::base::number::signed;
use sweetspot::base::units::{inches, miles_per_hour, ounce_square_inches, ounces};
use sweetspot::bat::profile::Section;
use sweetspot_study::answers::Answer;
use sweetspot_study::lathe::found::TurnedBand;
use sweetspot_study::lathe::map::LatheMap;

/// Height of a strip's bat and of the words above it (px).
const BAT: f64 = 34.0;
const WORDS: f64 = 19.0;
/// Evenly spaced sections of an outline.
const OUTLINE: usize = 40;
/// Most bands with a tooltip.
const MOST_TOLD: usize = 70;
/// Opacity of the largest change of a strip.
const FULL: f64 = 0.85;
/// Unit of the changes: a millimetre of diameter in SI, and 1/32 inch in US units.
const MM: f64 = 1e-3;
const THIRTY_SECOND: f64 = 0.0254 / 32.0;

/// A strip: name, unit, number of units per SI unit, and the change per metre for a band.
struct Strip {
    name: String,
    unit: &'static str,
    scale: f64,
    decimals: i32,
    changes: Vec<Option<f64>>,
}

/// The strips of the bat; picture `lathe`. None where no band has a change to show.
pub fn picture(sheet: Sheet, map: &LatheMap) -> Option<Picture> {
    let strips = strips(sheet, map);
    if strips.is_empty() {
        return None;
    }
    let bat = map.piece.bat();
    let (name, length) = (bat.name(), bat.length());
    let per = if sheet.us { "1/32 in" } else { "mm" };
    let facts = format!("per {per} taken off the diameter there; blue rises, red falls");
    let each = WORDS + BAT + 9.0;
    let per_metre = 0.5 * BAT / widest(bat);
    let outline = few_sections(bat);
    let panel = Panel::plain(each * strips.len() as f64 + 4.0).over(|svg, plane| {
        let mut told = vec![];
        for (k, strip) in strips.iter().enumerate() {
            let upper = plane.frame.top + each * k as f64;
            let lying = Lying { plane, axis: upper + WORDS + 0.5 * BAT, per_metre };
            label(svg, plane.frame, upper, strip);
            for (band, change) in map.found.bands.iter().zip(&strip.changes) {
                let Some(change) = change else { continue };
                let (ink, opacity) = strip.look(*change);
                if opacity > 0.0 {
                    lying.filled(svg, &between(bat, &outline, band.ends()), (ink, opacity));
                }
                let middle = plane.across(0.5 * (band.from_m + band.to_m));
                told.push(([middle, lying.axis], strip.of(sheet, band, *change)));
            }
            lying.outline(svg, &outline, Pen::new(FRAME, 0.9));
        }
        svg.hover(&told, MOST_TOLD);
    });
    let named: Vec<String> = strips.iter().map(Strip::range).collect();
    let alt = format!("{name}: what a cut does along the bat, {facts}. {}.", named.join("; "));
    let bats = ([0.0, length], &[(name, length)][..]);
    let chart = Chart::along(sheet, ("lathe", "What a cut does"), [name, &facts], bats);
    Some(chart.panel(panel).picture(sheet, &alt))
}

/// A few sections that give the shape of the bat: evenly spaced ones, and its stations with both sides of steps.
fn few_sections(bat: &Bat) -> Vec<(f64, Section)> {
    let (profile, stations) = (bat.profile(), &bat.profile().stations);
    let even = (0..=OUTLINE).map(|k| bat.length() * k as f64 / OUTLINE as f64);
    let mut all: Vec<(f64, Section)> = even.map(|x| (x, profile.at(x))).collect();
    if stations.x.len() <= 2 * OUTLINE {
        // A place that is a station has the station's two sides.
        all.retain(|(x, _)| !stations.x.contains(x));
        let radii = stations.outer.iter().zip(&stations.inner);
        let sections = radii.map(|(outer, inner)| Section { outer: *outer, inner: *inner });
        all.extend(stations.x.iter().copied().zip(sections));
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

/// The sections of a band: those of the outline, and those at its ends.
fn between(bat: &Bat, outline: &[(f64, Section)], [from, to]: [f64; 2]) -> Vec<(f64, Section)> {
    let just_before = to - 1e-9 * bat.length();
    let ends = [(from, bat.profile().at(from)), (to, bat.profile().at(just_before))];
    let inside = outline.iter().copied().filter(|(x, _)| *x > from && *x < just_before);
    [ends[0]].into_iter().chain(inside).chain([ends[1]]).collect()
}

fn label(svg: &mut Svg, frame: Frame, top: f64, strip: &Strip) {
    let range = strip.range();
    let (name, numbers) = range.split_once(": ").unwrap_or((&range, ""));
    let y = top + WORDS - 4.0;
    let wide = frame.right - frame.left;
    svg.text([frame.left, y], LABEL, &fitted(name, LABEL, 0.55 * wide));
    svg.text([frame.right, y], SMALL.at(Anchor::End), &fitted(numbers, SMALL, 0.45 * wide));
}

impl Strip {
    fn most(&self) -> f64 {
        self.changes.iter().flatten().fold(0.0, |most: f64, change| most.max(change.abs()))
    }

    /// The colour and opacity of a change, by its share of the largest.
    fn look(&self, change: f64) -> (Ink, f64) {
        let most = self.most();
        let share = if most > 0.0 { change.abs() / most } else { 0.0 };
        let ink = if change >= 0.0 { SERIES[0] } else { SERIES[1] };
        (ink, (100.0 * FULL * share).round() / 100.0)
    }

    /// The name, with the range of the changes.
    fn range(&self) -> String {
        let all = self.changes.iter().flatten();
        let [low, high] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], change| {
            [low.min(*change), high.max(*change)]
        });
        let [low, high] = [low, high].map(|value| self.shown(value));
        format!("{}: {low} to {high} {}", self.name, self.unit).trim_end().to_owned()
    }

    fn shown(&self, change: f64) -> String {
        let value = self.scale * change;
        match self.decimals {
            0.. => signed(value, self.decimals as usize).replace('-', "−"),
            _ => digits(value, 3),
        }
    }

    fn of(&self, sheet: Sheet, band: &TurnedBand, change: f64) -> String {
        let [from, to] = band.ends().map(|x| place::along(sheet, x));
        format!("{}, {from} to {to}: {} {}", self.name, self.shown(change), self.unit)
    }
}

/// The strips of the outputs.
fn strips(sheet: Sheet, map: &LatheMap) -> Vec<Strip> {
    let us = sheet.us;
    let per = if us { THIRTY_SECOND } else { MM };
    let answers = &map.terms.answers;
    let mut all = vec![];
    let mut add = |answer: Answer, name: &str, unit: (&'static str, f64, i32), exponent: f64| {
        let of = |band: &TurnedBand| band.derivative(answer, exponent).map(|change| change / MM);
        let changes: Vec<Option<f64>> = map.found.bands.iter().map(of).collect();
        if changes.iter().any(Option::is_some) {
            let (unit, scale, decimals) = (unit.0, unit.1 * per, unit.2);
            all.push(Strip { name: name.to_owned(), unit, scale, decimals, changes });
        }
    };
    let length = if us { ("in", inches(1.0), 4) } else { ("mm", 1e3, 2) };
    let speed = if us { ("mph", miles_per_hour(1.0), 3) } else { ("m/s", 1.0, 3) };
    let inertia = if us { ("oz in²", ounce_square_inches(1.0), 1) } else { ("kg cm²", 1e4, 2) };
    add(Answer::Mass, "mass", if us { ("oz", ounces(1.0), 3) } else { ("g", 1e3, 2) }, 0.0);
    add(Answer::Inertia, "swing weight", inertia, 0.0);
    add(Answer::Frequency(1), "frequency of mode 1", ("Hz", 1.0, 2), 0.0);
    add(Answer::Frequency(2), "frequency of mode 2", ("Hz", 1.0, 2), 0.0);
    add(Answer::Node(1), "node of mode 1, outward", length, 0.0);
    add(Answer::ExitSpeedPlace, "sweet spot, outward", length, 0.0);
    add(Answer::ExitSpeed, "fastest ball, same swing", speed, 0.0);
    if let Some(own) = map.terms.exponents().get(2) {
        add(Answer::ExitSpeed, &format!("fastest ball, swing law n = {own}"), speed, *own);
    }
    add(Answer::ExitSpeed, "fastest ball, same energy of the swing", speed, 0.5);
    let hands = answers.iter().copied().find(|a| matches!(a, Answer::HandsAccelerationAt(_)));
    if let Some(answer) = hands {
        let (unit, per) = in_trade("m/s²", us);
        add(answer, "acceleration that the hands feel", (unit, per, 0), 0.0);
    }
    all
}
