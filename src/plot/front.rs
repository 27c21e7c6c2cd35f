//! Time against error, as measured on a bat: what is worth its time.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::plane::{Frame, HEAD, LEFT, NUMBERS, Plane, RIGHT, WIDTH, head};
use crate::plot::series::{Series, legend, short};
use crate::plot::svg::{Anchor, MARKS, Mark, Pen, SMALL, Svg, width};
use crate::plot::theme::{SERIES, TEXT};
use crate::solve::Solver;
use crate::trade::front::{Run, front};
use crate::trade::measure::Trade;
use crate::trade::reference::solver_name;
use crate::trade::words::time;

/// Height of the diagram (px).
const DIAGRAM: f64 = 330.0;
/// The solvers in the order of their marks.
const SOLVERS: [Solver; 4] = [Solver::Statics, Solver::ShiftInvert, Solver::Dense, Solver::Arpack];

/// Every run, the front and the planner's choices; picture `front`. None without runs.
pub fn picture(name: &str, trade: &Trade) -> Option<Picture> {
    let floor = trade.reference.floor();
    let at = |run: &Run| [1e6 * run.seconds, run.error().max(floor)];
    let runs = &trade.runs;
    let x = Axis::logarithmic("time (µs)", runs.iter().map(|run| at(run)[0]));
    let y =
        Axis::logarithmic("largest relative error of a frequency", runs.iter().map(|r| at(r)[1]));
    runs.first()?;
    let curves: Vec<Series> = SOLVERS
        .into_iter()
        .enumerate()
        .map(|(k, solver)| {
            let own = runs.iter().filter(|run| run.choice.solver == solver);
            let points: Vec<_> = own.map(|run| Some(at(run))).collect();
            let series = Series::curve(solver_name(solver), k, points).units("µs", "");
            Series { joined: false, mark: Some(MARKS[k]), ..series }
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    let best: Vec<_> = front(runs).map(|run| Some(at(run))).collect();
    let best = Series::curve("front: nothing is faster and as accurate", 0, best);
    let best = best.pen(Pen::new(TEXT, 1.4));
    let title = "Speed against accuracy";
    let count = trade.reference.omegas.len();
    let facts = format!("{count} frequencies, every run measured here and now");
    let mut svg = Svg::new(WIDTH, 0.0);
    head(&mut svg, title, [name, &facts]);
    let mut keys: Vec<&Series> = curves.iter().collect();
    let planner = Series {
        joined: false,
        mark: Some(Mark::Circle),
        ..Series::curve("ringed: the planner's choice for that tolerance", 0, vec![])
            .pen(Pen::new(TEXT, 1.4))
    };
    keys.extend([&best, &planner]);
    let top = legend(&mut svg, &keys, [LEFT, HEAD + 10.0, WIDTH - 12.0]) + 16.0;
    let frame = Frame { left: LEFT + 8.0, top, right: WIDTH - RIGHT, bottom: top + DIAGRAM };
    svg.height = frame.bottom + NUMBERS + 4.0;
    let plane = Plane { frame, x, y };
    plane.draw(&mut svg);
    curves.iter().for_each(|curve| curve.draw(&mut svg, &plane));
    best.draw(&mut svg, &plane);
    planned(&mut svg, &plane, runs, at);
    plane.below(&mut svg);
    let told = |run: &Run| {
        let choice = run.choice;
        let solver = solver_name(choice.solver);
        let (n, p) = (choice.elements, choice.degree);
        let words = format!(
            "{solver}, {n} elements of degree {p}: {}, error {}",
            time(run.seconds),
            short(run.error())
        );
        (plane.at(at(run)), words)
    };
    svg.hover(&front(runs).map(told).collect::<Vec<_>>(), 60);
    let alt = format!("{name}: {facts}. {}", trade.words.join(". "));
    Some(Picture::new("front", title, &alt, svg))
}

/// Rings around the planner's choices, with the tolerance.
fn planned(svg: &mut Svg, plane: &Plane, runs: &[Run], at: impl Fn(&Run) -> [f64; 2]) {
    let mut taken: Vec<[f64; 2]> = vec![];
    for run in runs {
        let Some(tolerance) = run.planned_for else { continue };
        let [x, y] = plane.at(at(run));
        svg.ring([x, y], 8.0, Pen::new(TEXT, 1.4));
        let words = format!("{tolerance:.0e}").replace('-', "−");
        // Where another's words are, below.
        let near = |other: &[f64; 2]| (other[0] - x).abs() < 50.0 && (other[1] - y).abs() < 16.0;
        let lower = if taken.iter().any(near) { 16.0 } else { 0.0 };
        taken.push([x, y + lower]);
        let left = x + 12.0 + width(&words, SMALL) > plane.frame.right;
        let (side, anchor) = if left { (-12.0, Anchor::End) } else { (12.0, Anchor::Start) };
        svg.text([x + side, y + lower - 5.0], SMALL.at(anchor).ink(SERIES[5]), &words);
    }
}
