//! Many bats: how an answer is spread, what spreads it, and how two numbers go together.

use crate::many::table::Column;
use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::series::{digits, short};
use crate::plot::sheet::Sheet;
use crate::plot::svg::{Mark, Pen, Svg};
use crate::plot::theme::{GRID, MUTED, SERIES, TEXT};
use crate::plot::words::{Anchor, LABEL, SMALL, fitted, width};
use sweetspot_study::many::indices::{Indices, Share};

/// Height of a diagram (px), of a row of bars and of a bar in it.
const DIAGRAM: f64 = 300.0;
const ROW: f64 = 30.0;
const BAR: f64 = 8.0;
/// Bars of a histogram.
const BARS: [f64; 2] = [8.0, 60.0];
/// Bars of a tornado, and points of a scatter.
const MOST_BARS: usize = 12;
const MOST_POINTS: usize = 4000;

/// How many rows have an answer of about that size; picture `histogram_NAME`. None where fewer than eight rows
/// have one or all are the same.
pub fn histogram(column: &Column, sorted: &[f64], percentiles: [f64; 3]) -> Option<Picture> {
    let (low, high) = (*sorted.first()?, *sorted.last()?);
    if sorted.len() < 8 || high - low <= 1e-9 * high.abs().max(low.abs()) {
        return None;
    }
    let axis = Axis::new(&label(column), [low, high]);
    // D. Freedman, P. Diaconis, Z. Wahrsch. verw. Geb. 57 (1981) 453: twice the middle half over n^(1/3).
    let quarter = |k: usize| sorted[k * (sorted.len() - 1) / 4];
    let wide = 2.0 * (quarter(3) - quarter(1)) / (sorted.len() as f64).cbrt();
    let bars = ((high - low) / wide.max(1e-9 * (high - low))).ceil().clamp(BARS[0], BARS[1]);
    let wide = (high - low) / bars;
    let mut counts = vec![0_usize; bars as usize];
    for value in sorted {
        counts[(((value - low) / wide) as usize).min(bars as usize - 1)] += 1;
    }
    let [p5, p50, p95] = percentiles.map(|value| digits(value, 5));
    let title = format!("How {} is spread", column.name);
    let unit = &column.unit;
    let facts =
        format!("{} bats; nine in ten from {p5} to {p95} {unit}, half below {p50}", sorted.len());
    let sheet = Sheet::file(false);
    let mut svg = Svg::on(sheet);
    head(&mut svg, &title, ["", facts.trim_end()]);
    let top = sheet.head() + 22.0;
    let frame = Frame::across(sheet, [top, top + DIAGRAM]);
    svg.height = frame.bottom + NUMBERS + 4.0;
    let most = counts.iter().copied().max().unwrap_or(1) as f64;
    let y = Axis::around("bats", [0.0, most].into_iter(), ticks_up(DIAGRAM));
    let plane = Plane { frame, x: axis, y };
    plane.draw(&mut svg);
    let mut told = vec![];
    for (k, count) in counts.iter().enumerate() {
        let [from, to] = [k, k + 1].map(|k| low + k as f64 * wide);
        let [upper, lower] = [plane.at([from, *count as f64]), plane.at([to, 0.0])];
        svg.rect([upper, lower], SERIES[0], 0.75, Some(Pen::new(GRID, 0.8)));
        let words = format!("{} to {} {unit}: {count} bats", short(from), short(to));
        told.push(([0.5 * (upper[0] + lower[0]), 0.5 * (upper[1] + lower[1])], words));
    }
    svg.hover(&told, told.len());
    for (value, name) in percentiles.into_iter().zip(["5 %", "half", "95 %"]) {
        let x = plane.across(value);
        svg.line(&[[x, frame.top], [x, frame.bottom]], Pen::new(TEXT, 1.3).dashed("5 3"));
        svg.text([x, frame.top - 6.0], SMALL.at(Anchor::Middle), name);
    }
    plane.below(&mut svg);
    let alt = format!("Histogram of {}: {facts}.", column.name);
    Some(Picture::new(&format!("histogram_{}", plain(&column.name)), &title, &alt, svg))
}

/// What makes an answer vary, the most first: a bar for what it does with others, and in it one for what it does
/// alone; picture `tornado_NAME`.
pub fn tornado(answer: &str, varied: &[String], indices: &Indices) -> Picture {
    let mut order: Vec<usize> = (0..varied.len()).collect();
    order.sort_by(|a, b| indices.total[*b].value.total_cmp(&indices.total[*a].value));
    order.truncate(MOST_BARS);
    let title = format!("What makes {answer} vary");
    // What is left of an exact fit is round-off.
    let rest = indices.unexplained.value.max(0.0);
    let facts = format!(
        "shares of its variance, {} bats; dark alone, light with others; {rest:.2} not followed",
        indices.rows
    );
    let sheet = Sheet::file(false);
    let mut svg = Svg::on(sheet);
    head(&mut svg, &title, ["", &facts]);
    let names: Vec<String> = order.iter().map(|k| fitted(&varied[*k], LABEL, 300.0)).collect();
    let widest = names.iter().map(|name| width(name, LABEL)).fold(0.0, f64::max);
    let top = sheet.head() + 6.0;
    let bottom = top + ROW * order.len() as f64 + 8.0;
    let frame = Frame { left: 20.0 + widest + 12.0, ..Frame::across(sheet, [top, bottom]) };
    svg.height = frame.bottom + NUMBERS + 4.0;
    let x = Axis::new("share of the variance", [0.0, 1.0]);
    let plane = Plane { frame, x, y: Axis::new("", [0.0, 1.0]) };
    for tick in plane.x.ticks(12) {
        let x = plane.across(tick.value);
        svg.line(&[[x, frame.top], [x, frame.bottom]], Pen::new(GRID, 1.0));
    }
    let mut said = vec![];
    for (row, (k, name)) in order.iter().zip(&names).enumerate() {
        let middle = top + ROW * (row as f64 + 0.5) + 4.0;
        svg.text([frame.left - 10.0, middle + 4.4], LABEL.at(Anchor::End), name);
        let (alone, all) = (&indices.first[*k], &indices.total[*k]);
        bar(&mut svg, &plane, (all, middle), (1.0, 0.35));
        bar(&mut svg, &plane, (alone, middle), (0.5, 0.85));
        let words =
            format!("{}: alone {:.3}, with others {:.3}", varied[*k], alone.value, all.value);
        svg.hover(&[([plane.across(0.5 * all.value.clamp(0.0, 1.0)), middle], words.clone())], 1);
        said.push(words);
    }
    plane.below(&mut svg);
    let alt = format!("{title}: {}.", said.join("; "));
    Picture::new(&format!("tornado_{}", plain(answer)), &title, &alt, svg)
}

fn bar(svg: &mut Svg, plane: &Plane, (share, middle): (&Share, f64), (high, opacity): (f64, f64)) {
    let [from, to] = [0.0, share.value.clamp(0.0, 1.0)].map(|value| plane.across(value));
    svg.rect([[from, middle - high * BAR], [to, middle + high * BAR]], SERIES[0], opacity, None);
    let ends = [-1.0, 1.0].map(|sign| (share.value + sign * share.sd).clamp(0.0, 1.0));
    let ends = ends.map(|value| [plane.across(value), middle]);
    svg.line(&ends, Pen::new(MUTED, 1.2));
}

/// Two columns against each other, a point a row; picture `scatter_A_B`. None where fewer than two rows have
/// both.
pub fn scatter(a: &Column, b: &Column) -> Option<Picture> {
    let both: Vec<[f64; 2]> = a.values.iter().zip(&b.values).map(|(a, b)| [*a, *b]).collect();
    let known: Vec<[f64; 2]> =
        both.into_iter().filter(|at| at.iter().all(|v| v.is_finite())).collect();
    if known.len() < 2 {
        return None;
    }
    let title = format!("{} and {}", a.name, b.name);
    let r = correlation(&known);
    let related = r.map_or(String::new(), |r| format!("; correlation {}", digits(r, 3)));
    let step = known.len().div_ceil(MOST_POINTS);
    let shown = if step > 1 { format!(", one in {step} shown") } else { String::new() };
    let facts = format!("{} bats{shown}{related}", known.len());
    let sheet = Sheet::file(false);
    let mut svg = Svg::on(sheet);
    head(&mut svg, &title, ["", &facts]);
    let top = sheet.head() + 6.0;
    let frame = Frame::across(sheet, [top, top + 1.3 * DIAGRAM]);
    svg.height = frame.bottom + NUMBERS + 4.0;
    let x = Axis::around(&label(a), known.iter().map(|at| at[0]), 9);
    let y = Axis::around(&label(b), known.iter().map(|at| at[1]), ticks_up(1.3 * DIAGRAM));
    let plane = Plane { frame, x, y };
    plane.draw(&mut svg);
    let half = if known.len() > 500 { 1.4 } else { 2.4 };
    for at in known.iter().step_by(step) {
        svg.mark(Mark::Circle, plane.at(*at), half, SERIES[0], true);
    }
    plane.below(&mut svg);
    let alt = format!("Points: {} against {}, {facts}.", b.name, a.name);
    let name = format!("scatter_{}_{}", plain(&a.name), plain(&b.name));
    Some(Picture::new(&name, &title, &alt, svg))
}

/// Pearson's; None where one of both is the same in all rows.
fn correlation(points: &[[f64; 2]]) -> Option<f64> {
    let count = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|at| at[k]).sum::<f64>() / count);
    let sum = |i: usize, j: usize| -> f64 {
        points.iter().map(|at| (at[i] - mean[i]) * (at[j] - mean[j])).sum()
    };
    let r = sum(0, 1) / (sum(0, 0) * sum(1, 1)).sqrt();
    r.is_finite().then_some(r)
}

fn label(column: &Column) -> String {
    match column.unit.is_empty() {
        true => column.name.clone(),
        false => format!("{} ({})", column.name, column.unit),
    }
}

/// A name as part of a file's: letters, digits, and `_` for all else.
fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_on_a_line_have_a_correlation_of_one() {
        let line: Vec<[f64; 2]> =
            (0..9).map(|k| [f64::from(k), 3.0 - 2.0 * f64::from(k)]).collect();
        assert!((correlation(&line).unwrap() + 1.0).abs() < 1e-12);
        let level: Vec<[f64; 2]> = (0..9).map(|k| [f64::from(k), 3.0]).collect();
        assert!(correlation(&level).is_none());
    }
}
