//! Error against time, as measured on a bat: the settings that are worth their time.

use crate::plot::{
    Anchor, Axis, Chart, MARKS, Mark, Panel, Pen, Picture, Plane, SERIES, SMALL, Series, Sheet,
    Svg, TEXT, short, width,
};
use sweetspot::Solver;
use sweetspot_study::trade::front::{Run, front};
use sweetspot_study::trade::measure::Trade;
use sweetspot_study::trade::reference::solver_name;
use sweetspot_study::trade::words::time;

/// Height of the diagram (px).
const DIAGRAM: f64 = 330.0;
/// The solvers in the order of their marks.
const SOLVERS: [Solver; 4] = [Solver::Statics, Solver::ShiftInvert, Solver::Dense, Solver::Arpack];

/// Every run, the front and the planner's choices; picture `front`. None without runs.
pub fn picture(name: &str, trade: &Trade) -> Option<Picture> {
    let Trade { reference, runs, words, .. } = trade;
    let floor = reference.floor;
    let at = |run: &Run| [1e6 * run.seconds, run.error.max(floor)];
    runs.first()?;
    let mut curves = solvers(runs, at);
    let (pen, best) = (Pen::new(TEXT, 1.4), front(runs).map(|run| Some(at(run))).collect());
    let best = Series::curve("front: nothing is faster and as accurate", 0, best).pen(pen).untold();
    let planner = Series::curve("ringed: the planner's choice for that tolerance", 0, vec![]);
    curves.extend([best, planner.dots(Mark::Circle).pen(pen)]);
    let facts = format!("{} frequencies, every run measured here and now", reference.omegas.len());
    let x = Axis::logarithmic("time (µs)", runs.iter().map(|run| at(run)[0]));
    let errors = runs.iter().map(|run| at(run)[1]);
    let y = Axis::logarithmic("largest relative error of a frequency", errors);
    let alt = format!("{name}: {facts}. {}", words.join(". "));
    let chart = Chart::new("front", "Speed against accuracy", [name, &facts], x).keys(&curves);
    let panel = Panel::new(DIAGRAM, y, curves).over(|svg, plane| {
        planned(svg, plane, runs, at);
        let told: Vec<_> = front(runs).map(|run| (plane.at(at(run)), told(run))).collect();
        svg.hover(&told, 60);
    });
    Some(chart.panel(panel).picture(Sheet::file(false), &alt))
}

/// The runs of every solver.
fn solvers(runs: &[Run], at: impl Fn(&Run) -> [f64; 2]) -> Vec<Series> {
    let of = |(k, solver): (usize, Solver)| {
        let own = runs.iter().filter(|run| run.choice.solver == solver);
        let points: Vec<_> = own.map(|run| Some(at(run))).collect();
        Series::curve(solver_name(solver), k, points).dots(MARKS[k]).untold()
    };
    let all = SOLVERS.into_iter().enumerate().map(of);
    all.filter(|series| !series.points.is_empty()).collect()
}

fn told(run: &Run) -> String {
    let (solver, seconds) = (solver_name(run.choice.solver), time(run.seconds));
    let (n, p, error) = (run.choice.elements, run.choice.degree, short(run.error));
    format!("{solver}, {n} elements of degree {p}: {seconds}, error {error}")
}

/// Rings around the planner's choices, with the tolerance.
fn planned(svg: &mut Svg, plane: &Plane, runs: &[Run], at: impl Fn(&Run) -> [f64; 2]) {
    let mut taken: Vec<[f64; 2]> = vec![];
    for run in runs {
        let Some(tolerance) = run.planned_for else { continue };
        let [x, y] = plane.at(at(run));
        svg.ring([x, y], 8.0, Pen::new(TEXT, 1.4));
        let words = format!("{tolerance:.0e}").replace('-', "−");
        // Below, if the words of another point are here.
        let near = |other: &[f64; 2]| (other[0] - x).abs() < 50.0 && (other[1] - y).abs() < 16.0;
        let lower = if taken.iter().any(near) { 16.0 } else { 0.0 };
        taken.push([x, y + lower]);
        let left = x + 12.0 + width(&words, SMALL) > plane.frame.right;
        let (side, anchor) = if left { (-12.0, Anchor::End) } else { (12.0, Anchor::Start) };
        svg.text([x + side, y + lower - 5.0], SMALL.at(anchor).ink(SERIES[5]), &words);
    }
}
