//! What does the picture `docs/r161_hit.svg` show?
//!
//! It shows exit speeds along an R161, ours compared with those that others measured and computed. [`svg`] draws it.

use crate::plot::{
    Anchor, Axis, Frame, LABEL, Mark, Pen, Plane, SERIES, Series, Svg, legend_between,
};
use sweetspot::{Request, Result, solve};
use sweetspot_proof::case::{Case, Known, bundled_case};
use sweetspot_proof::known_hits::KnownFigure;

/// The name of the file beside the page.
pub const FILE: &str = "r161_hit.svg";

/// Mean length of the error bars in Cross's figure, which range from 0.012 to 0.02 (m/s).
const CROSS: f64 = 0.015;
/// How well the other figure can be read (m/s).
const READ: f64 = 0.4;
/// Modes in the WPI report's loss.
const REPORT_MODES: usize = 10;

/// Of the picture, and of each of its diagrams (px).
const SIZE: [f64; 2] = [1040.0, 420.0];
const DIAGRAM: [f64; 2] = [430.0, 286.0];

/// The picture.
///
/// # Errors
///
/// The errors of the two hits.
pub fn svg() -> Result<String> {
    let tap = bundled_case("r161_hit_cross")?;
    let mut slow = curves(&tap)?;
    // The empirical loss depends on who is looking: no curve for a bat at rest.
    slow.truncate(2);
    slow.push(known(&tap, "measured by Cross", CROSS));
    let game = bundled_case("r161_hit_nathan")?;
    let mut fast = curves(&game)?;
    fast.push(known(&game, "Nathan's Fig. 10, read off", READ));
    let mut svg = Svg::new(SIZE[0], SIZE[1]);
    diagram(&mut svg, 70.0, ("R161 at rest, ball at 1 m/s", 0.5), &slow);
    diagram(&mut svg, 590.0, ("R161 at game speed, ball at 40 m/s", 50.0), &fast);
    let title = "Exit speed along an R161";
    let alt = "Exit speed against the place of the hit, of a bat at rest and of a swung one: this \
               project's curve, a rigid bat's, and what others measured and computed.";
    Ok(svg.finish(title, alt))
}

/// One diagram from that pixel on, with speeds up to that value (m/s).
fn diagram(svg: &mut Svg, left: f64, (title, most): (&str, f64), series: &[Series]) {
    const TOP: f64 = 84.0;
    let frame = Frame { left, top: TOP, right: left + DIAGRAM[0], bottom: TOP + DIAGRAM[1] };
    let x = Axis::new("from the knob end (cm)", [40.0, 85.0]);
    let plane = Plane { frame, x, y: Axis::new("exit speed (m/s)", [0.0, most]) };
    let middle = 0.5 * (frame.left + frame.right);
    svg.text([middle, 24.0], LABEL.at(Anchor::Middle).sized(16.0), title);
    plane.draw(svg);
    series.iter().for_each(|series| series.draw(svg, &plane));
    plane.below(svg);
    legend_between(svg, series, [left, 50.0, frame.right]);
}

/// Ours, the rigid bat's and the WPI report's loss.
fn curves(case: &Case) -> Result<Vec<Series>> {
    let bat = case.bat()?;
    let request = case.request()?;
    let solution = solve(&bat, &request)?;
    let ten = solve(&bat, &Request { modes: REPORT_MODES, ..request })?;
    let places: Vec<f64> = (80..168).map(|k| 0.005 * k as f64).collect();
    let [ours, rigid, loss] = match &case.hit {
        Some(throw) => throw.curves(&bat, [&solution, &ten], &places)?,
        None => Default::default(),
    };
    let series = |name: &str, pen, points: Vec<[f64; 2]>| {
        let points = points.iter().map(|[x, v]| Some([100.0 * x, *v])).collect();
        Series::curve(name, 0, points).pen(pen)
    };
    Ok(vec![
        series("ours, contact, with shear", Pen::new(SERIES[0], 2.2), ours),
        series("the same bat, rigid", Pen::new(SERIES[5], 1.6).dashed("7 5"), rigid),
        series("WPI report's energy loss", Pen::new(SERIES[4], 1.8).dashed("2 3"), loss),
    ])
}

/// The exit speeds in the case.
fn known(case: &Case, name: &str, error: f64) -> Series {
    let wanted = Known::Hit(KnownFigure::ExitSpeedMPerS);
    let checks = case.checks.iter().filter(|check| check.quantity == wanted);
    let points = checks.filter_map(|check| Some(Some([100.0 * check.at?, check.expected])));
    Series { error, ..Series::curve(name, 1, points.collect()).dots(Mark::Circle) }
}
