//! How fast the ball leaves along the bat, and where the sweet spot is by each definition.

use crate::base::units::miles_per_hour;
use crate::collision::hit::Impact;
use crate::collision::sweet_spot::{Peak, SweetSpot};
use crate::show::plot::axis::Axis;
use crate::show::plot::picture::Picture;
use crate::show::plot::place::{self, CM, PlaceRow};
use crate::show::plot::plane::{Frame, HEAD, LEFT, NUMBERS, Plane, SECOND, WIDTH, head, ticks_up};
use crate::show::plot::series::{Series, hover, legend};
use crate::show::plot::svg::{Pen, Svg};
use crate::show::plot::theme::{SERIES, series};

/// A bat, the name it has in the picture, its hits and its sweet spot.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// What the bat is called.
    pub name: &'a str,
    /// Length of the bat (m).
    pub length: f64,
    /// Impacts, by rising place.
    pub impacts: &'a [Impact],
    /// Sweet spot by every definition.
    pub spot: &'a SweetSpot,
}

/// Height of the curves' diagram (px).
const DIAGRAM: f64 = 230.0;

/// Exit speed against place, exit speed of bats that do not bend, and rows of sweet spots; picture
/// `exit_speed`. None without two places.
pub fn picture(subjects: &[Subject]) -> Option<Picture> {
    let places = subjects.iter().flat_map(|s| s.impacts.iter().map(|i| i.x));
    let [from, to] = places
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [f64::min(a, x), f64::max(b, x)]);
    let alone = subjects.len() == 1;
    let all = subjects.iter().enumerate();
    let curves: Vec<Series> = all.flat_map(|(k, s)| curves(k, s, alone)).collect();
    let values = || curves.iter().flat_map(|c| c.points.iter().flatten().map(|[_, v]| *v));
    if from >= to || values().next().is_none() {
        return None;
    }
    let rows = sweet_spots(subjects);
    let mut svg = Svg::new(WIDTH, 0.0);
    let (title, name, facts) = words(subjects);
    head(&mut svg, title, [name, &facts]);
    let keys = keys(&curves, alone);
    let keys: Vec<&Series> = keys.iter().collect();
    let top = legend(&mut svg, &keys, [LEFT, HEAD + 10.0, WIDTH - 12.0]) + 12.0 + NUMBERS;
    let (right, side) = (WIDTH - SECOND, top + DIAGRAM);
    let bottom = side + 6.0 + place::height(&rows);
    svg.height = bottom + NUMBERS + 4.0;
    let bats: Vec<(&str, f64)> = subjects.iter().map(|s| (s.name, s.length)).collect();
    let [x, tip] = place::axes([from, to], &bats);
    let y = Axis::around("exit speed (m/s)", values(), ticks_up(DIAGRAM));
    let plane = Plane { frame: Frame { left: LEFT, top, right, bottom: side }, x, y };
    svg.read_off = Some([LEFT, top, right, bottom]);
    let strip = Frame { left: LEFT, top: side + 6.0, right, bottom };
    let strip = Plane { frame: strip, ..plane.clone() };
    zone(&mut svg, [&plane, &strip], subjects);
    plane.above(&mut svg, &tip);
    diagram(&mut svg, &plane, (subjects, &curves));
    place::rows(&mut svg, &strip, &rows);
    strip.below(&mut svg);
    Some(Picture::new("exit_speed", title, &described(subjects, &rows), svg))
}

/// The curves, and the fastest ball on each.
fn diagram(svg: &mut Svg, plane: &Plane, (subjects, curves): (&[Subject], &[Series])) {
    plane.draw(svg);
    let fast = [plane.y.from, plane.y.to].map(miles_per_hour);
    plane.right(svg, &Axis::new("exit speed (mph)", fast));
    curves.iter().rev().for_each(|curve| curve.draw(svg, plane));
    for (k, subject) in subjects.iter().enumerate() {
        let peak = subject.spot.exit_speed_max.map(|peak| [CM * peak.x, peak.value]);
        let seen = |at: &[f64; 2]| plane.x.holds(at[0]) && plane.y.holds(at[1]);
        if let Some(at) = peak.filter(seen) {
            place::mark(svg, k, plane.at(at));
        }
    }
    hover(svg, plane, &curves.iter().collect::<Vec<_>>());
}

fn words<'a>(subjects: &[Subject<'a>]) -> (&'static str, &'a str, String) {
    let title = "Exit speed along the bat";
    let [one] = subjects else {
        return (title, "", "each bat as it bends, and if it did not".to_owned());
    };
    let most = one.spot.exit_speed_max.map(|Peak { x, value }| {
        let mph = miles_per_hour(value);
        format!("at most {value:.1} m/s ({mph:.1} mph), {}", place::shown(x, one.length))
    });
    (title, one.name, most.unwrap_or_default())
}

fn described(subjects: &[Subject], rows: &[PlaceRow]) -> String {
    let names: Vec<&str> = subjects.iter().map(|s| s.name).collect();
    let places: Vec<&str> = rows.iter().map(|row| row.label.as_str()).collect();
    format!(
        "Exit speed of the ball against where it meets the bat, of {}, with the same if the bat did \
         not bend. Sweet spots: {}.",
        names.join(", "),
        places.join("; ")
    )
}

/// As the bat is, and if it did not bend.
fn curves(k: usize, subject: &Subject, alone: bool) -> Vec<Series> {
    let curve = |name: &str, of: &dyn Fn(&Impact) -> Option<f64>| {
        let points = subject.impacts.iter().map(|i| Some([CM * i.x, of(i)?])).collect();
        Series::curve(name, k, points).units("cm", "m/s")
    };
    let name = if alone { "as it bends" } else { subject.name };
    let stiff = match alone {
        true => "if it did not bend".to_owned(),
        false => format!("{name}, if it did not bend"),
    };
    let rigid = curve(&stiff, &|i| i.rigid_exit_speed);
    let pen = if alone { Pen::new(SERIES[5], 1.4) } else { Pen::new(series(k).0, 1.2) };
    let bent = curve(name, &|i| i.outcome.as_ref().map(|o| o.exit_speed));
    // A bat that does not bend in the model has one curve.
    let rigid =
        if bent.points == rigid.points { vec![] } else { vec![rigid.pen(pen.dashed("5 4"))] };
    let seen = |curve: &Series| curve.points.iter().any(Option::is_some);
    std::iter::once(bent).chain(rigid).filter(seen).collect()
}

/// What is named of the curves: of several bats that do not bend, one.
fn keys(curves: &[Series], alone: bool) -> Vec<Series> {
    let stiff = |curve: &&Series| !alone && curve.pen.width < 2.0;
    let mut named: Vec<Series> = curves.iter().filter(|c| !stiff(c)).cloned().collect();
    if let Some(one) = curves.iter().find(stiff) {
        let name = "thin: if it did not bend".to_owned();
        named.push(Series { name, ..one.clone().pen(Pen { ink: SERIES[5], ..one.pen }) });
    }
    named
}

/// Where a single bat's exit speed is within 1 % of its best.
fn zone(svg: &mut Svg, planes: [&Plane; 2], subjects: &[Subject]) {
    let [one] = subjects else { return };
    if let Some(zone) = one.spot.zone {
        let zone = zone.map(|x| CM * x);
        planes.iter().for_each(|plane| plane.band(svg, zone, SERIES[0]));
    }
}

/// A row for every definition that has a place.
fn sweet_spots(subjects: &[Subject]) -> Vec<PlaceRow> {
    type Of = fn(&SweetSpot) -> Option<f64>;
    let all: [(&str, Of); 7] = [
        ("fastest ball", |s| s.exit_speed_max.map(|p| p.x)),
        ("least vibration", |s| s.vibration_min.map(|p| p.x)),
        ("node of mode 1", |s| s.node_mode_1),
        ("node of mode 2", |s| s.node_mode_2),
        ("centre of percussion", |s| s.center_of_percussion),
        ("slowest at the hands", |s| s.hands_velocity_min.map(|p| p.x)),
        ("least shaken at the hands", |s| s.hands_acceleration_min.map(|p| p.x)),
    ];
    let mut rows: Vec<PlaceRow> =
        all.iter().filter_map(|(what, of)| row(subjects, what, *of)).collect();
    let zones: Vec<(usize, [f64; 2])> =
        subjects.iter().enumerate().filter_map(|(k, s)| Some((k, s.spot.zone?))).collect();
    if let [(_, [from, to])] = zones.as_slice() {
        let label = format!("within 1 %: {:.1} to {:.1} cm", CM * from, CM * to);
        rows.insert(1.min(rows.len()), PlaceRow::of_stretches(label, zones));
    } else if !zones.is_empty() {
        rows.insert(1.min(rows.len()), PlaceRow::of_stretches("within 1 %".into(), zones));
    }
    rows
}

fn row(
    subjects: &[Subject],
    what: &str,
    of: impl Fn(&SweetSpot) -> Option<f64>,
) -> Option<PlaceRow> {
    let places: Vec<(usize, f64)> =
        subjects.iter().enumerate().filter_map(|(k, s)| Some((k, of(s.spot)?))).collect();
    let label = match (subjects, places.as_slice()) {
        (_, []) => return None,
        ([one], [(_, x)]) => format!("{what}: {}", place::shown(*x, one.length)),
        _ => {
            format!("{what}: {}", place::listed(&places))
        }
    };
    Some(PlaceRow::of_places(label, places))
}
