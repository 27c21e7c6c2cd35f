//! How fast the ball leaves along the bat, and where the sweet spot is by each definition.

use crate::plot::subject::{Subject, lengths, names};
use crate::plot::{
    Chart, Panel, Pen, Picture, PlaceRow, SERIES, Series, Sheet, heights, place, series,
};
use sweetspot::collision::sweet_spot::Peak;
use sweetspot::collision::{Impact, SweetSpot};

/// A bat with impacts by rising place and its sweet spot by every definition.
pub type SpeedCurves<'a> = Subject<'a, (&'a [Impact], &'a SweetSpot)>;

/// Height of the curves' diagram (px).
const DIAGRAM: f64 = 230.0;

/// Exit speed against place, exit speed of bats that do not bend, and rows of sweet spots; picture
/// `exit_speed`. None without two places.
pub fn picture(sheet: Sheet, subjects: &[SpeedCurves]) -> Option<Picture> {
    let places = subjects.iter().flat_map(|s| s.drawn.0.iter().map(|i| i.x));
    let [from, to] = places
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [f64::min(a, x), f64::max(b, x)]);
    let alone = subjects.len() == 1;
    let all = subjects.iter().enumerate();
    let curves: Vec<Series> = all.flat_map(|(k, s)| curves(k, s, alone)).collect();
    if from >= to || heights(&curves).next().is_none() {
        return None;
    }
    let rows = sweet_spots(sheet, subjects);
    let (title, name, facts) = words(sheet, subjects);
    let alt = described(subjects, &rows);
    let bats = lengths(subjects);
    let zone = match subjects {
        [one] => one.drawn.1.zone,
        _ => None,
    };
    let chart = Chart::along(sheet, ("exit_speed", title), [name, &facts], ([from, to], &bats));
    let chart = chart.keys(&keys(&curves, alone)).rows(rows).read_off();
    let panel = Panel::around(DIAGRAM, ("exit speed", sheet.speed()), curves, &[]);
    let panel = panel.band(zone, SERIES[0]).over(|svg, plane| {
        let fastest = subjects.iter().map(|s| s.drawn.1.exit_speed_max);
        for (k, peak) in fastest.enumerate() {
            let at = peak.map(|peak| [peak.x, peak.value]);
            let at = at.filter(|at| plane.x.holds(at[0]) && plane.y.holds(at[1]));
            at.into_iter().for_each(|at| place::mark(svg, k, plane.at(at)));
        }
    });
    Some(chart.panel(panel).picture(sheet, &alt))
}

fn words<'a>(sheet: Sheet, subjects: &[SpeedCurves<'a>]) -> (&'static str, &'a str, String) {
    let title = "Exit speed along the bat";
    let [one] = subjects else {
        return (title, "", "each bat as it bends, and if it did not".to_owned());
    };
    let most = one.drawn.1.exit_speed_max.map(|Peak { x, value }| {
        let unit = sheet.speed();
        let place = place::shown(sheet, x, one.bat.length());
        format!("at most {:.1} {}, {place}", unit.per * value, unit.name)
    });
    (title, one.name, most.unwrap_or_default())
}

fn described(subjects: &[SpeedCurves], rows: &[PlaceRow]) -> String {
    let places: Vec<&str> = rows.iter().map(|row| row.label.as_str()).collect();
    format!(
        "Exit speed of the ball against where it meets the bat, of {}, with the same if the bat did \
         not bend. Sweet spots: {}.",
        names(subjects).join(", "),
        places.join("; ")
    )
}

/// The bat as it is, and as a rigid body (with a rigid wall, where a hollow barrel is compliant).
fn curves(k: usize, subject: &SpeedCurves, alone: bool) -> Vec<Series> {
    let curve = |name: &str, of: &dyn Fn(&Impact) -> Option<f64>| {
        let points = subject.drawn.0.iter().map(|i| Some([i.x, of(i)?])).collect();
        Series::curve(name, k, points)
    };
    let wall = |impact: &Impact| impact.outcome.as_ref().is_some_and(|o| o.energy.wall > 0.0);
    let rings = subject.drawn.0.iter().any(wall);
    let [name, stiff] = match (alone, rings) {
        (true, false) => ["as it bends", "if it did not bend"].map(str::to_owned),
        (true, true) => ["as bat and wall give way", "if both were stiff"].map(str::to_owned),
        (false, _) => [subject.name.to_owned(), format!("{}, if it did not bend", subject.name)],
    };
    let rigid = curve(&stiff, &|i| i.rigid_exit_speed);
    let pen = if alone { Pen::new(SERIES[5], 1.4) } else { Pen::new(series(k).0, 1.2) };
    let bent = curve(&name, &|i| i.outcome.as_ref().map(|o| o.exit_speed));
    // A bat that does not bend in the model has one curve.
    let rigid =
        if bent.points == rigid.points { vec![] } else { vec![rigid.pen(pen.dashed("5 4"))] };
    let seen = |curve: &Series| curve.points.iter().any(Option::is_some);
    std::iter::once(bent).chain(rigid).filter(seen).collect()
}

/// The entries of the legend: one for all rigid bats where there are several.
fn keys(curves: &[Series], alone: bool) -> Vec<Series> {
    let stiff = |curve: &&Series| !alone && curve.pen.width < 2.0;
    let mut named: Vec<Series> = curves.iter().filter(|c| !stiff(c)).cloned().collect();
    if let Some(one) = curves.iter().find(stiff) {
        let name = "thin: if it did not bend".to_owned();
        named.push(Series { name, ..one.clone().pen(Pen { ink: SERIES[5], ..one.pen }) });
    }
    named
}

/// A row for every definition that has a place.
fn sweet_spots(sheet: Sheet, subjects: &[SpeedCurves]) -> Vec<PlaceRow> {
    type Of = fn(&SpeedCurves) -> Option<f64>;
    let all: [(&str, Of); 7] = [
        ("fastest ball", |s| s.drawn.1.exit_speed_max.map(|p| p.x)),
        ("least vibration", |s| s.drawn.1.vibration_min.map(|p| p.x)),
        ("node of mode 1", |s| s.drawn.1.node_mode_1),
        ("node of mode 2", |s| s.drawn.1.node_mode_2),
        ("centre of percussion of the swing", |s| s.drawn.1.center_of_percussion),
        ("slowest at the hands", |s| s.drawn.1.hands_velocity_min.map(|p| p.x)),
        // The vibration of an undamped bat has no end, and no size that a hand feels.
        ("least shaken at the hands", |s| {
            s.drawn.1.hands_acceleration_min.filter(|_| s.bat.damped()).map(|p| p.x)
        }),
    ];
    let lengths: Vec<f64> = subjects.iter().map(|s| s.bat.length()).collect();
    let row = |(what, of): &(&str, Of)| {
        let places: Vec<Option<f64>> = subjects.iter().map(of).collect();
        PlaceRow::named(sheet, what, &lengths, &places)
    };
    let mut rows: Vec<PlaceRow> = all.iter().filter_map(row).collect();
    let zones: Vec<(usize, [f64; 2])> =
        subjects.iter().enumerate().filter_map(|(k, s)| Some((k, s.drawn.1.zone?))).collect();
    if let [(_, [from, to])] = zones.as_slice() {
        let (from, to) = (sheet.length().per * from, place::along(sheet, *to));
        let label = format!("within 1 %: {} to {to}", place::tenths(from));
        rows.insert(1.min(rows.len()), PlaceRow::of_stretches(label, zones));
    } else if !zones.is_empty() {
        rows.insert(1.min(rows.len()), PlaceRow::of_stretches("within 1 %".into(), zones));
    }
    rows
}
