//! Error against the number of elements, solver by solver.

use crate::plot::{Axis, Chart, MARKS, Panel, Pen, Picture, SERIES, Series, Sheet};
use sweetspot_study::trade::reference::solver_name;
use sweetspot_study::trade::u_curve::{Curve, SolverFrequency};

/// Height of the diagram (px).
const DIAGRAM: f64 = 320.0;
/// An error of 0 is drawn as this one.
const NOTHING: f64 = 1e-17;

/// The error of one mode (from 0), of the eigenvalue of the solver and of the one recomputed from the shape; picture
/// `u_curve`, or `u_curve_mode_N` for a mode other than the first. None without points.
pub fn picture(name: &str, curves: &[Curve], mode: usize) -> Option<Picture> {
    let mut drawn = vec![];
    for (k, curve) in curves.iter().enumerate() {
        for way in curve.ways() {
            let series = series(curve, *way, (k, mode));
            drawn.extend(Some(series).filter(|series| !series.points.is_empty()));
        }
    }
    let points = || drawn.iter().flat_map(|c: &Series| c.points.iter().flatten());
    points().next()?;
    let x = Axis::logarithmic("number of cubic elements", points().map(|at| at[0]));
    let x = Axis { unit: "elements", ..x };
    let y = Axis::logarithmic("relative error of the frequency", points().map(|at| at[1]));
    let title = format!("Error against elements, mode {}", mode + 1);
    let facts = "own: as the solver's eigenvalue says; again: from the energies of its shape";
    let file = match mode {
        0 => "u_curve".to_owned(),
        _ => format!("u_curve_mode_{}", mode + 1),
    };
    let names: Vec<&str> = drawn.iter().map(|series| series.name.as_str()).collect();
    let alt = format!("{title} of {name}; {facts}. Curves: {}.", names.join(", "));
    let chart = Chart::new(&file, &title, [name, facts], x).keys(&drawn);
    // Dashes on a whole line are seen.
    let drawn = drawn.into_iter().rev().collect();
    Some(chart.panel(Panel::new(DIAGRAM, y, drawn)).picture(Sheet::file(false), &alt))
}

fn series(curve: &Curve, way: SolverFrequency, (k, mode): (usize, usize)) -> Series {
    let name = match (curve.ways().len(), way) {
        (1, _) => solver_name(curve.solver).to_owned(),
        (_, SolverFrequency::Own) => format!("{}, own", solver_name(curve.solver)),
        (_, SolverFrequency::Recomputed) => format!("{}, again", solver_name(curve.solver)),
    };
    let points = curve.series(way, mode).into_iter();
    let points = points.map(|(n, error)| Some([n as f64, error.max(NOTHING)])).collect();
    let dash =
        if way == SolverFrequency::Recomputed && curve.ways().len() > 1 { "4 3" } else { "" };
    let pen = Pen::new(SERIES[k % 6], 1.6).dashed(dash);
    let series = Series::curve(&name, k, points).pen(pen);
    Series { mark: Some(MARKS[k % MARKS.len()]), ..series }
}
