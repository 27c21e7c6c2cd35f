//! The bat coloured by the effect of a cut at each place, with a strip for each output.

use crate::parts::Units;
use crate::plot::profile::widest;
use crate::plot::{
    Anchor, Chart, FRAME, Frame, Ink, LABEL, Lying, Panel, Pen, Picture, SERIES, SMALL, Sheet, Svg,
    fitted, place,
};
use crate::report::lathe_table::{LatheOutput, TableUnits, outputs};
use sweetspot::Bat;
use sweetspot::bat::profile::Section;
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

/// A strip: an output, and its change for a cut at each band.
struct Strip {
    output: LatheOutput,
    changes: Vec<Option<f64>>,
}

/// The strips of the bat; picture `lathe`. None where no band has a change to show.
pub fn picture(sheet: Sheet, map: &LatheMap) -> Option<Picture> {
    let bat = map.piece.bat();
    let units = TableUnits::of(Units::one(sheet.us), bat);
    let strip = |output: LatheOutput| {
        let changes = output.changes(map, TurnedBand::derivative);
        changes.iter().any(Option::is_some).then_some(Strip { output, changes })
    };
    let strips: Vec<Strip> = outputs(map, units).into_iter().filter_map(strip).collect();
    if strips.is_empty() {
        return None;
    }
    let (name, length) = (bat.name(), bat.length());
    let per = units.per_name();
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
        format!("{}: {} to {}", self.output.name, self.shown(low), self.text(high))
    }

    fn shown(&self, change: f64) -> String {
        self.output.signed(change).replace('-', "−")
    }

    fn text(&self, change: f64) -> String {
        format!("{} {}", self.shown(change), self.output.scale.name)
    }

    fn of(&self, sheet: Sheet, band: &TurnedBand, change: f64) -> String {
        let [from, to] = band.ends().map(|x| place::along(sheet, x));
        format!("{}, {from} to {to}: {}", self.output.name, self.text(change))
    }
}
