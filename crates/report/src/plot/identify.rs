//! The modes common to several responses: stability over the number of poles, and shapes.

use crate::plot::{Axis, Chart, MARKS, Panel, Picture, Series, Sheet, Unit, short};
use sweetspot_study::identify::modes::{Identified, SharedMode, placed};
use sweetspot_study::identify::set::ResponseSet;

/// Heights of diagrams (px).
const LEVELS: f64 = 240.0;
const POLES: f64 = 200.0;
const SHAPE: f64 = 240.0;
/// Points of a curve, and shapes in a picture.
const POINTS: usize = 900;
const MOST: usize = 6;
const LEVEL: Unit = Unit { name: "dB", per: 1.0 };

/// The pictures `stability` and `identified_shapes`.
pub fn pictures(set: &ResponseSet, found: &Identified, sheet: Sheet) -> Vec<Picture> {
    let mut all = vec![stability(set, found, sheet)];
    if set.points.len() > 1 && !found.modes.is_empty() {
        all.push(shapes(set, &found.modes[..found.modes.len().min(MOST)], sheet));
    }
    all
}

fn stability(set: &ResponseSet, found: &Identified, sheet: Sheet) -> Picture {
    let group = found.sum.len().div_ceil(POINTS).max(1);
    let highest = |part: &[[f64; 2]]| {
        let top = part.iter().max_by(|a, b| a[1].total_cmp(&b[1]))?;
        Some([top[0], 10.0 * (top[1] + 1e-24).log10()])
    };
    let levels: Vec<_> = found.sum.chunks(group).map(highest).collect();
    let level = |hz: f64| {
        let near =
            levels.iter().flatten().min_by(|a, b| (a[0] - hz).abs().total_cmp(&(b[0] - hz).abs()));
        near.map(|point| [hz, point[1]])
    };
    // The responses have the masses of the accelerometers still.
    let measured = |mode: &SharedMode| mode.frequency.value * (1.0 + mode.lowered.unwrap_or(0.0));
    let modes = found.modes.iter().map(|mode| level(measured(mode))).collect();
    let marked = Series::curve("modes", 1, modes).dots(MARKS[1]);
    let sum = Series::curve("sum of all responses", 0, levels.clone()).untold();
    let [low, high] = found.band;
    let poles = (1..).zip(&found.orders).flat_map(|(order, poles)| {
        let inside = poles.iter().filter(|pole| (low..=high).contains(&pole.hz));
        inside.map(move |pole| Some([pole.hz, f64::from(order)]))
    });
    let poles = Series::curve("poles", 2, poles.collect()).dots(MARKS[2]);
    let title = "Stability";
    let told: Vec<String> =
        found.modes.iter().map(|mode| format!("{} Hz", short(mode.frequency.value))).collect();
    let alt = format!("{title}: modes at {}.", told.join(", "));
    let facts = format!("{} responses; poles by how many were sought", set.responses.len());
    let x = Axis::new("frequency", found.band).counted_in(Unit::HZ);
    let mut curves = vec![marked, sum];
    curves.retain(|curve| !curve.points.is_empty());
    let chart = Chart::new("stability", title, ["", &facts], x).keys(&curves);
    let chart = chart.panel(Panel::around(LEVELS, ("level", LEVEL), curves, &[]));
    let most = found.orders.len().max(1) as f64;
    let poles = Panel::around(POLES, ("poles sought", Unit::NONE), vec![poles], &[0.0, most + 0.5]);
    chart.panel(poles).picture(sheet, &alt)
}

fn shapes(set: &ResponseSet, modes: &[SharedMode], sheet: Sheet) -> Picture {
    let curve = |(k, mode): (usize, &SharedMode)| {
        let points = placed(&set.points, &mode.shape).map(|(place, v)| Some([place.x, v.re]));
        let name = format!("{} Hz", short(mode.frequency.value));
        Series::curve(&name, k, points.collect())
    };
    let curves: Vec<Series> = modes.iter().enumerate().map(curve).collect();
    let places = set.points.iter().map(|place| place.x);
    let x = Axis::measured("place along the axis", sheet.length(), places, 10);
    let title = "Identified shapes";
    let names: Vec<&str> = curves.iter().map(|curve| &*curve.name).collect();
    let alt = format!("{title}: {}.", names.join(", "));
    let facts = "real parts, the largest deflection 1";
    let chart = Chart::new("identified_shapes", title, ["", facts], x).keys(&curves);
    let panel = Panel::around(SHAPE, ("deflection", Unit::NONE), curves, &[-1.0, 1.0]);
    chart.panel(panel.zero()).picture(sheet, &alt)
}
