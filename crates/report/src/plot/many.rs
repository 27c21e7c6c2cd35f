//! Many bats: the distribution of an answer, its causes, and the relation between two numbers.

use crate::many::table::NumberColumn;
use crate::plot::{
    Axis, Bar, BarRow, Chart, GRID, Mark, Panel, Pen, Picture, SERIES, Sheet, Unit, bars, digits,
    short, ticks_up,
};
use sweetspot_study::many::indices::{Indices, Share};

/// Height of a diagram (px).
const DIAGRAM: f64 = 300.0;
/// Bars of a histogram.
const BARS: [f64; 2] = [8.0, 60.0];
/// Bars of a tornado, and points of a scatter.
const MOST_BARS: usize = 12;
const MOST_POINTS: usize = 4000;

/// How many rows have an answer of about that size; picture `histogram_NAME`. None where fewer than eight rows
/// have one or all are the same.
pub fn histogram(column: &NumberColumn, sorted: &[f64], percentiles: [f64; 3]) -> Option<Picture> {
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
    let most = counts.iter().copied().max().unwrap_or(1) as f64;
    let panel = Panel::around(DIAGRAM, ("bats", Unit::NONE), vec![], &[0.0, most]);
    let lines = percentiles.into_iter().zip(["5 %", "half", "95 %"]).collect();
    let panel = panel.lines(lines).over(|svg, plane| {
        let mut told = vec![];
        for (k, count) in counts.iter().enumerate() {
            let [from, to] = [k, k + 1].map(|k| low + k as f64 * wide);
            let [upper, lower] = [plane.at([from, *count as f64]), plane.at([to, 0.0])];
            svg.rect([upper, lower], SERIES[0], 0.75, Some(Pen::new(GRID, 0.8)));
            let words = format!("{} to {} {unit}: {count} bats", short(from), short(to));
            told.push(([0.5 * (upper[0] + lower[0]), 0.5 * (upper[1] + lower[1])], words));
        }
        svg.hover(&told, told.len());
    });
    let name = format!("histogram_{}", plain(&column.name));
    let chart = Chart::new(&name, &title, ["", facts.trim_end()], axis).panel(panel);
    Some(chart.picture(Sheet::file(false), &format!("Histogram of {}: {facts}.", column.name)))
}

/// The causes of the variation of an answer, the largest first: a bar for the total effect of an input, with a bar for
/// its own effect inside; picture `tornado_NAME`.
pub fn tornado(answer: &str, varied: &[String], indices: &Indices) -> Picture {
    let mut order: Vec<usize> = (0..varied.len()).collect();
    order.sort_by(|a, b| indices.total[*b].value.total_cmp(&indices.total[*a].value));
    order.truncate(MOST_BARS);
    let title = format!("What makes {answer} vary");
    // The remainder of an exact fit is round-off.
    let rest = indices.unexplained.value.max(0.0);
    let facts = format!(
        "shares of its variance, {} bats; dark alone, light with others; {rest:.2} not followed",
        indices.rows
    );
    let row = |k: usize| {
        let (alone, all) = (&indices.first[k], &indices.total[k]);
        let within = |value: f64| value.clamp(0.0, 1.0);
        let bar = |share: &Share, high, opacity| Bar {
            ends: [0.0, within(share.value)],
            high,
            look: (SERIES[0], opacity),
        };
        let open = |share: &Share| [-1.0, 1.0].map(|sign| within(share.value + sign * share.sd));
        let told = format!("{}: alone {:.3}, with others {:.3}", varied[k], alone.value, all.value);
        BarRow {
            label: varied[k].clone(),
            bars: vec![bar(all, 1.0, 0.35), bar(alone, 0.5, 0.85)],
            spans: vec![open(all), open(alone)],
            dot: None,
            told: (0.5 * within(all.value), told),
        }
    };
    let rows: Vec<BarRow> = order.into_iter().map(row).collect();
    let x = Axis::new("share of the variance", [0.0, 1.0]);
    let name = format!("tornado_{}", plain(answer));
    bars::picture((&name, &title, ["", &facts]), x, (&rows, &[]), &title)
}

/// Two columns against each other, a point a row; picture `scatter_A_B`. None where fewer than two rows have
/// both.
pub fn scatter(a: &NumberColumn, b: &NumberColumn) -> Option<Picture> {
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
    let x = Axis::around(&label(a), known.iter().map(|at| at[0]), 9);
    let y = Axis::around(&label(b), known.iter().map(|at| at[1]), ticks_up(1.3 * DIAGRAM));
    let half = if known.len() > 500 { 1.4 } else { 2.4 };
    let panel = Panel::new(1.3 * DIAGRAM, y, vec![]).over(|svg, plane| {
        for at in known.iter().step_by(step) {
            svg.mark(Mark::Circle, plane.at(*at), half, SERIES[0], true);
        }
    });
    let alt = format!("Points: {} against {}, {facts}.", b.name, a.name);
    let name = format!("scatter_{}_{}", plain(&a.name), plain(&b.name));
    let chart = Chart::new(&name, &title, ["", &facts], x).panel(panel);
    Some(chart.picture(Sheet::file(false), &alt))
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

fn label(column: &NumberColumn) -> String {
    match column.unit.is_empty() {
        true => column.name.clone(),
        false => format!("{} ({})", column.name, column.unit),
    }
}

/// A name as part of a file name: letters and digits are kept, others become `_`.
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
