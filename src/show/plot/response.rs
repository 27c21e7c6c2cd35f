//! Frequency responses: size and phase over frequency.

use faer::c64;

use crate::motion::frf::Kind;
use crate::show::plot::axis::Axis;
use crate::show::plot::picture::Picture;
use crate::show::plot::place::along;
use crate::show::plot::plane::{Frame, NUMBERS, Plane, head};
use crate::show::plot::series::{Series, hover, legend, short};
use crate::show::plot::sheet::Sheet;
use crate::show::plot::svg::Svg;

/// Of the diagram of sizes and of that of phases, and between them (px).
const SIZES: f64 = 260.0;
const PHASES: f64 = 120.0;
const BETWEEN: f64 = 18.0;

/// A response: what it is called, and the answers (in the unit of their kind) over frequency (Hz), which
/// rises.
pub struct Curve<'a> {
    /// What the legend calls it.
    pub name: &'a str,
    /// Frequency and answer.
    pub answers: Vec<(f64, c64)>,
}

/// What is drawn: a bat, forced and watched at two places (m from the knob end).
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// What the bat is called.
    pub name: &'a str,
    /// What is answered.
    pub kind: Kind,
    /// Where the force is, and where the answer is seen.
    pub points: [f64; 2],
    /// Whether frequencies are equal steps apart, not equal ratios.
    pub linear: bool,
}

/// Size above phase; picture `response`. None without two frequencies above 0.
pub fn picture(sheet: Sheet, subject: &Subject, curves: &[Curve]) -> Option<Picture> {
    let Subject { name, kind, points, linear } = *subject;
    let all = || curves.iter().flat_map(|curve| &curve.answers).filter(|(f, _)| *f > 0.0 || linear);
    let ends =
        all().fold([f64::INFINITY, 0.0_f64], |[low, high], (f, _)| [low.min(*f), high.max(*f)]);
    if ends[0] >= ends[1] {
        return None;
    }
    let unit = match kind {
        Kind::Receptance => "m/N",
        Kind::Mobility => "m/(s N)",
        Kind::Accelerance => "1/kg",
    };
    let [at, to] = points.map(|x| along(sheet, x));
    let title = "Frequency response";
    let facts = format!("{}, force at {at}, seen at {to} from the knob end", kind.name());
    let mut svg = Svg::on(sheet);
    head(&mut svg, title, [name, &facts]);
    let series = |(k, curve): (usize, &Curve), of: fn(c64) -> f64, y: &'static str| {
        let points = curve.answers.iter().map(|(f, answer)| Some([*f, of(*answer)])).collect();
        Series::curve(curve.name, k, points).units("Hz", y)
    };
    let numbered = || curves.iter().enumerate();
    let sizes: Vec<Series> = numbered().map(|curve| series(curve, c64::norm, unit)).collect();
    let phases = numbered().map(|curve| series(curve, degrees, "deg"));
    let phases: Vec<Series> = phases.map(unwrapped).collect();
    let top = match curves.len() {
        1 => sheet.head(),
        _ => legend(&mut svg, &sizes.iter().collect::<Vec<_>>()) + 10.0,
    };
    let label = "frequency (Hz)";
    let x = match linear {
        true => Axis::new(label, ends),
        false => Axis::logarithmic(label, all().map(|(f, _)| *f)),
    };
    let y = Axis::logarithmic(&format!("size ({unit})"), all().map(|(_, answer)| answer.norm()));
    let upper =
        Plane { frame: Frame::across(sheet, [top + 6.0, top + 6.0 + SIZES]), x: x.clone(), y };
    let low = upper.frame.bottom + BETWEEN;
    let y = Axis::new("phase (deg)", [-180.0, 180.0]);
    let lower = Plane { frame: Frame::across(sheet, [low, low + PHASES]), x, y };
    svg.height = lower.frame.bottom + NUMBERS + 4.0;
    for (plane, series) in [(&upper, &sizes), (&lower, &phases)] {
        plane.draw(&mut svg);
        series.iter().rev().for_each(|curve| curve.draw(&mut svg, plane));
        hover(&mut svg, plane, &series.iter().collect::<Vec<_>>());
    }
    lower.below(&mut svg);
    let most =
        all().fold(
            (0.0, 0.0),
            |most: (f64, f64), (f, answer)| {
                if answer.norm() > most.1 { (*f, answer.norm()) } else { most }
            },
        );
    let alt = format!(
        "{title} of {name}: {facts}. Largest {} {unit} at {} Hz of the frequencies drawn.",
        short(most.1),
        short(most.0)
    );
    Some(Picture::new("response", title, &alt, svg))
}

/// From −180 to 180; 0 of nothing.
fn degrees(answer: c64) -> f64 {
    (answer.im + 0.0).atan2(answer.re + 0.0).to_degrees()
}

/// With a gap where the phase goes on from one end at the other.
fn unwrapped(series: Series) -> Series {
    let mut points: Vec<Option<[f64; 2]>> = vec![];
    for point in series.points {
        let last = points.last().copied().flatten();
        if let (Some([_, before]), Some([_, now])) = (last, point)
            && (now - before).abs() > 270.0
        {
            points.push(None);
        }
        points.push(point);
    }
    Series { points, ..series }
}
