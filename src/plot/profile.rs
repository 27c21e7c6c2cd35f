//! Bats from the side, their diameter along them, and the places that matter.

use crate::bat::{Bat, STANDARD_PIVOT};
use crate::fixtures::Held;
use crate::material::Material;
use crate::plot::axis::Axis;
use crate::plot::outline::{Lying, sections};
use crate::plot::picture::Picture;
use crate::plot::place::{self, CM, Row};
use crate::plot::plane::{Frame, HEAD, LEFT, NUMBERS, Plane, WIDTH, head, ticks_up};
use crate::plot::series::{Series, digits, hover, legend, short};
use crate::plot::svg::{Anchor, Pen, SMALL, Svg};
use crate::plot::theme::series;
use crate::units::{inches, ounces};

/// A bat, the name it has in the picture, and where its swing turns.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    pub name: &'a str,
    pub bat: &'a Bat,
    /// Rotation centre beyond the knob end (m), negative inside the handle; none if nobody swings.
    pub swing_pivot: Option<f64>,
}

/// Right of the frame there is a second axis.
const RIGHT: f64 = 74.0;
/// Of the diameters' diagram (px).
const DIAGRAM: f64 = 130.0;
/// Heights that a bat from the side may have (px).
const THICK: [f64; 2] = [14.0, 84.0];

/// The bats in one picture, `profile`.
pub fn picture(subjects: &[Subject]) -> Picture {
    let longest = subjects.iter().map(|s| s.bat.length()).fold(0.0, f64::max);
    let rows: Vec<Row> = marked(subjects);
    let ends = ends(longest, &rows);
    let bats: Vec<(&str, f64)> = subjects.iter().map(|s| (s.name, s.bat.length())).collect();
    let [knob, tip] = place::axes(ends, &bats);
    let thickest = subjects.iter().map(|s| widest(s.bat)).fold(0.0, f64::max);
    let [times, per_metre] = thickness(thickest, (WIDTH - LEFT - RIGHT) / (ends[1] - ends[0]));
    let each = 2.0 * thickest * per_metre + 26.0;
    let keys = if subjects.len() > 1 { 18.0 * subjects.len().div_ceil(2) as f64 } else { 0.0 };
    let top = HEAD + keys + NUMBERS;
    let side = top + each * subjects.len() as f64 + 6.0;
    let (right, below) = (WIDTH - RIGHT, side + DIAGRAM + 6.0);
    let frame = |top, bottom| Frame { left: LEFT, top, right, bottom };
    let bottom = below + place::height(&rows);
    let mut svg = Svg::new(WIDTH, bottom + NUMBERS + 6.0);
    let (title, facts) = words(subjects);
    head(&mut svg, &title, ["", &facts]);
    let shapes = Plane { frame: frame(top, side), x: knob.clone(), y: Axis::new("", [0.0, 1.0]) };
    shapes.above(&mut svg, &tip);
    for (k, subject) in subjects.iter().enumerate() {
        let axis = top + each * (k as f64 + 0.5) + 4.0;
        let lying = Lying { plane: &shapes, axis, per_metre };
        lying.draw(&mut svg, subject.bat, series(k).0);
    }
    proportions(&mut svg, times, [right, top + 14.0]);
    let y = Axis::around("diameter (cm)", diameters(subjects), ticks_up(DIAGRAM));
    let in_inches = Axis::new("diameter (in)", [y.from, y.to].map(|d| inches(d / CM)));
    let plane = Plane { frame: frame(side, side + DIAGRAM), x: knob.clone(), y };
    plane.draw(&mut svg);
    plane.right(&mut svg, &in_inches);
    let curves: Vec<Series> = subjects.iter().enumerate().flat_map(|(k, s)| curves(k, s)).collect();
    curves.iter().for_each(|curve| curve.draw(&mut svg, &plane));
    let first = top + 0.5 * each + 4.0;
    let strip = Plane { frame: frame(below, bottom), x: knob, y: shapes.y.clone() };
    place::guides(&mut svg, &strip, &rows, first);
    place::rows(&mut svg, &strip, &rows);
    strip.below(&mut svg);
    if subjects.len() > 1 {
        let outer: Vec<&Series> = curves.iter().filter(|c| c.pen.width > 1.5).collect();
        legend(&mut svg, &outer, [LEFT, HEAD + 8.0, WIDTH - 12.0]);
    }
    hover(&mut svg, &plane, &curves.iter().collect::<Vec<_>>());
    Picture::new("profile", &title, &described(subjects, &rows), svg)
}

/// What the pictures' first two lines say.
fn words(subjects: &[Subject]) -> (String, String) {
    match subjects {
        [Subject { name, bat, .. }] => {
            let (mass, length) = (bat.inertia().mass, bat.length());
            let thick = 2.0 * widest(bat);
            let mut second = format!(
                "{} cm ({} in) long, {} g ({} oz), at most {} cm ({} in) thick",
                short(CM * length),
                short(inches(length)),
                digits(1e3 * mass, 3),
                digits(ounces(mass), 3),
                digits(CM * thick, 3),
                digits(inches(thick), 3)
            );
            if bat.profile.stations.inner.iter().any(|r| *r > 0.0) {
                second += "; thin line: the bore";
            }
            ((*name).to_owned(), second)
        }
        _ => ("Profiles".to_owned(), "outer diameter solid or dashed, bore thin".to_owned()),
    }
}

fn described(subjects: &[Subject], rows: &[Row]) -> String {
    let names: Vec<&str> = subjects.iter().map(|s| s.name).collect();
    let places: Vec<&str> = rows.iter().map(|row| row.label.as_str()).collect();
    format!(
        "{} from the side with the diameter along it. Marked: {}.",
        names.join(", "),
        places.join("; ")
    )
}

/// The largest radius (m).
fn widest(bat: &Bat) -> f64 {
    let stations = &bat.profile.stations;
    stations.outer.iter().fold(0.0_f64, |most, r| most.max(*r))
}

/// How many times as thick as long a bat of that radius (m) is drawn, 1 wherever it can be seen so,
/// and what a metre of radius is then high; from what a metre is long (px).
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

/// 0, and every diameter (cm).
fn diameters<'a>(subjects: &'a [Subject]) -> impl Iterator<Item = f64> + 'a {
    subjects.iter().map(|s| 2.0 * CM * widest(s.bat)).chain([0.0])
}

/// The outer diameter, and the inner one where there is a bore.
fn curves(k: usize, Subject { name, bat, .. }: &Subject) -> Vec<Series> {
    const MOST: usize = 300;
    let all = sections(&bat.profile, MOST);
    let outer = all.iter().map(|(x, at)| Some([CM * x, 2.0 * CM * at.outer])).collect();
    let mut curves = vec![Series::curve(name, k, outer).units("cm", "cm")];
    if all.iter().any(|(_, at)| at.inner > 0.0) {
        let bore = |(x, at): &(f64, crate::profile::Section)| {
            (at.inner > 0.0).then_some([CM * x, 2.0 * CM * at.inner])
        };
        let inner = Series::curve(&format!("{name}, bore"), k, all.iter().map(bore).collect());
        let pen = Pen { width: 1.2, ..inner.pen };
        curves.push(inner.pen(pen).units("cm", "cm"));
    }
    curves
}

/// The positions to be shown: the bats, and what is marked near them (m).
fn ends(longest: f64, rows: &[Row]) -> [f64; 2] {
    /// Of the length: marks farther off are at the edge.
    const BEYOND: f64 = 0.15;
    let places = rows.iter().flat_map(|row| row.places.iter().map(|(_, x)| *x));
    let near = places.filter(|x| (-BEYOND * longest..=(1.0 + BEYOND) * longest).contains(x));
    near.fold([0.0, longest], |[from, to], x| [from.min(x), to.max(x)])
}

/// Balance points, pivots, centres of percussion; what one bat is made of and bears.
fn marked(subjects: &[Subject]) -> Vec<Row> {
    let of = |what: &str, place: &dyn Fn(&Subject) -> Option<f64>| {
        let places: Vec<(usize, f64)> =
            subjects.iter().enumerate().filter_map(|(k, s)| Some((k, place(s)?))).collect();
        let label = match (subjects, places.as_slice()) {
            ([one], [(_, x)]) => format!("{what}: {}", place::shown(*x, one.bat.length())),
            _ => {
                format!("{what}: {}", place::listed(&places))
            }
        };
        (!places.is_empty()).then(|| Row::of_places(label, places))
    };
    let standard = |s: &Subject| s.bat.inertia().center_of_percussion(STANDARD_PIVOT);
    let swung = |s: &Subject| s.bat.inertia().center_of_percussion(-s.swing_pivot?);
    let on_bat = |s: &Subject| (STANDARD_PIVOT <= s.bat.length()).then_some(STANDARD_PIVOT);
    let mut rows: Vec<Row> = [
        of("balance point", &|s| Some(s.bat.inertia().balance_point)),
        of("pivot of standards", &on_bat),
        of("its centre of percussion", &standard),
        of("pivot of the swing", &|s| s.swing_pivot.map(|beyond| -beyond)),
        of("its centre of percussion", &swung),
    ]
    .into_iter()
    .flatten()
    .collect();
    if let [subject] = subjects {
        rows.extend(fastened(subject.bat));
    }
    rows
}

/// Other materials, weights, joints, supports and hands, as rows.
fn fastened(bat: &Bat) -> Vec<Row> {
    let fixtures = &bat.fixtures;
    let stretch = |label: String, from, to| Row::of_stretches(label, vec![(0, [from, to])]);
    let place = |label: String, x| Row::of_places(label, vec![(0, x)]);
    let mut rows = vec![];
    for region in &fixtures.regions {
        let name = |material: &Material| match &material.name {
            Some(name) => name.clone(),
            None => format!("{} kg/m³", short(material.density)),
        };
        let outer = &region.layup.outer;
        let wall = (outer != bat.material()).then(|| name(outer));
        let core = region.layup.core.as_ref().map(name);
        let label = match (wall, core) {
            (Some(wall), Some(core)) => format!("hatched: {wall} with a core of {core}"),
            (Some(wall), None) => format!("hatched: {wall}"),
            (None, Some(core)) => format!("hatched: core of {core}"),
            (None, None) => continue,
        };
        rows.push(stretch(label, region.from, region.to));
    }
    for tape in &fixtures.tapes {
        rows.push(stretch(format!("tape of {:.0} g", 1e3 * tape.mass), tape.from, tape.to));
    }
    if let Some(grip) = fixtures.grip {
        rows.push(stretch("hands".into(), grip.from, grip.to));
    }
    for joint in &fixtures.joints {
        rows.push(place("joint".into(), joint.x));
    }
    for a in &fixtures.attachments {
        let label = match a.mass {
            mass if mass > 0.0 => format!("weight of {:.0} g ({:.1} oz)", 1e3 * mass, ounces(mass)),
            _ => "spring".to_owned(),
        };
        rows.push(place(label, a.x));
    }
    for a in &fixtures.absorbers {
        rows.push(place(format!("absorber of {:.0} g", 1e3 * a.mass), a.x));
    }
    for support in &fixtures.supports {
        let label = if support.kind == Held::Pinned { "pinned" } else { "clamped" };
        rows.push(place(label.into(), support.x));
    }
    // More would be no picture.
    rows.truncate(12);
    rows
}
