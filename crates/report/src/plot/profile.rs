//! Bats from the side, their diameter along them, and the places that matter.

use crate::plot::marks::marked;
use crate::plot::subject::{lengths, longest, names};
use crate::plot::{
    Anchor, Chart, Frame, Lying, Panel, Pen, Picture, PlaceRow, SMALL, Series, Sheet, Svg, bats,
    digits, sections, series, short,
};
use sweetspot::Bat;
use sweetspot::base::units::ounces;

pub use crate::plot::marks::MarkedBat;

/// Of the diameters' diagram (px).
const DIAGRAM: f64 = 130.0;
/// Heights that a bat from the side may have (px).
const THICK: [f64; 2] = [14.0, 84.0];

/// The bats in one picture, `profile`.
pub fn picture(sheet: Sheet, subjects: &[MarkedBat]) -> Picture {
    let rows: Vec<PlaceRow> = marked(sheet, subjects);
    let ends = ends(longest(subjects), &rows);
    let thickest = subjects.iter().map(|s| widest(s.bat)).fold(0.0, f64::max);
    let Frame { left, right, .. } = Frame::across(sheet, [0.0; 2]);
    let [times, per_metre] = thickness(thickest, (right - left) / (ends[1] - ends[0]));
    let each = 2.0 * thickest * per_metre + 26.0;
    let axis = |k: usize| each * (k as f64 + 0.5) + 4.0;
    let lying = Panel::plain(each * subjects.len() as f64).over(|svg, plane| {
        for (k, subject) in subjects.iter().enumerate() {
            let lying = Lying { plane, axis: plane.frame.top + axis(k), per_metre };
            lying.draw(svg, subject.bat, series(k).0);
        }
        proportions(svg, times, [plane.frame.right, plane.frame.top + 14.0]);
    });
    // Dashes on a whole line are seen.
    let curves = subjects.iter().enumerate().flat_map(|(k, s)| curves(k, s)).rev().collect();
    let diameters = Panel::around(DIAGRAM, ("diameter", sheet.length()), curves, &[0.0]);
    let ((title, facts), alt) = (words(sheet, subjects), described(subjects, &rows));
    let along = (ends, &lengths(subjects)[..]);
    let chart = Chart::along(sheet, ("profile", &title), ["", &facts], along);
    let chart = chart.keys(&bats(&names(subjects))).panel(lying).panel(diameters);
    chart.rows(rows).guides(axis(0)).picture(sheet, &alt)
}

/// The first two lines of the pictures.
fn words(sheet: Sheet, subjects: &[MarkedBat]) -> (String, String) {
    match subjects {
        [MarkedBat { name, bat, .. }] => {
            let (mass, length) = (bat.inertia().mass, bat.length());
            let thick = 2.0 * widest(bat);
            let unit = sheet.length();
            let [length, thick] = [short(unit.per * length), digits(unit.per * thick, 3)];
            let mass = match sheet.us {
                true => format!("{} oz", digits(ounces(mass), 3)),
                false => format!("{} g", digits(1e3 * mass, 3)),
            };
            let mut second =
                format!("{length} {0} long, {mass}, at most {thick} {0} thick", unit.name);
            if bat.profile().stations.inner.iter().any(|r| *r > 0.0) {
                second += "; thin line: the bore";
            }
            ((*name).to_owned(), second)
        }
        _ => ("Profiles".to_owned(), "outer diameter solid or dashed, bore thin".to_owned()),
    }
}

fn described(subjects: &[MarkedBat], rows: &[PlaceRow]) -> String {
    let names: Vec<&str> = subjects.iter().map(|s| s.name).collect();
    let places: Vec<&str> = rows.iter().map(|row| row.label.as_str()).collect();
    format!(
        "{} from the side with the diameter along it. Marked: {}.",
        names.join(", "),
        places.join("; ")
    )
}

/// The largest radius (m).
pub fn widest(bat: &Bat) -> f64 {
    let stations = &bat.profile().stations;
    stations.outer.iter().fold(0.0_f64, |most, r| most.max(*r))
}

/// Enlargement of the thickness for a bat of that radius (m), 1 wherever this is visible, and the resulting scale of
/// radii, from the scale along the bat (px/m).
fn thickness(radius: f64, along: f64) -> [f64; 2] {
    let natural = 2.0 * radius * along;
    let round = |wanted: f64| {
        let power = 10f64.powf(wanted.log10().floor());
        let digit = [5.0, 2.0, 1.0].into_iter().find(|d| d * power <= wanted * (1.0 + 1e-9));
        digit.unwrap_or(1.0) * power
    };
    let times = match natural {
        thick if thick > THICK[1] => round(THICK[1] / thick),
        // Rounded up: twice as much is still a bat.
        thin if thin < THICK[0] => 1.0 / round(thin / THICK[0]),
        _ => 1.0,
    };
    [times, times * along]
}

fn proportions(svg: &mut Svg, times: f64, at: [f64; 2]) {
    if times != 1.0 {
        let words = format!("drawn {} times as thick", short(times));
        svg.text(at, SMALL.at(Anchor::End), &words);
    }
}

/// The outer diameter, and the inner one where there is a bore.
fn curves(k: usize, MarkedBat { name, bat, .. }: &MarkedBat) -> Vec<Series> {
    const MOST: usize = 300;
    let all = sections(bat.profile(), MOST);
    let outer = all.iter().map(|(x, at)| Some([*x, 2.0 * at.outer])).collect();
    let mut curves = vec![Series::curve(name, k, outer)];
    if all.iter().any(|(_, at)| at.inner > 0.0) {
        let bore = |(x, at): &(f64, sweetspot::bat::profile::Section)| {
            (at.inner > 0.0).then_some([*x, 2.0 * at.inner])
        };
        let inner = Series::curve(&format!("{name}, bore"), k, all.iter().map(bore).collect());
        let pen = Pen { width: 1.2, ..inner.pen };
        curves.push(inner.pen(pen));
    }
    curves
}

/// The range of positions shown: the bats, and marks near them (m).
fn ends(longest: f64, rows: &[PlaceRow]) -> [f64; 2] {
    /// As a share of the length; more distant marks are drawn at the edge.
    const BEYOND: f64 = 0.15;
    let places = rows.iter().flat_map(|row| row.places.iter().map(|(_, x)| *x));
    let near = places.filter(|x| (-BEYOND * longest..=(1.0 + BEYOND) * longest).contains(x));
    near.fold([0.0, longest], |[from, to], x| [from.min(x), to.max(x)])
}
