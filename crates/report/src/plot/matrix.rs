//! A table of numbers from 0 to 1 as a map of colours, with the numbers in its cells.

use crate::plot::{
    Anchor, FRAME, LABEL, PAPER, Pen, Picture, SERIES, SMALL, Sheet, Svg, TITLE, Type, fitted,
    head, width,
};

/// Numbers by row and column.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    /// Of the picture's files.
    pub name: String,
    /// Title of the picture.
    pub title: String,
    /// The line below the title.
    pub second: String,
    /// Labels of rows and columns: `computed mode`, `measured mode`.
    pub sides: [String; 2],
    /// Names of the rows, from above.
    pub rows: Vec<String>,
    /// Names of the columns, from the left.
    pub columns: Vec<String>,
    /// Values from 0 to 1, row by row; None for an empty cell.
    pub values: Vec<Vec<Option<f64>>>,
    /// Label of the scale, such as `MAC`.
    pub scale: String,
}

/// Opacity of the largest value: numbers read on it, on light and on dark paper.
pub const FULL: f64 = 0.5;
/// Largest width of a cell (px), its height, and the width of the scale on the right.
const CELL: [f64; 2] = [74.0, 30.0];
const SCALE: f64 = 90.0;
/// Most rows and columns drawn; a larger map would be unreadable.
const MOST: usize = 100;

/// The map, as wide as it needs and no wider than other pictures; of a very large one only the beginning.
pub fn picture(matrix: &Matrix) -> Picture {
    if matrix.rows.len().max(matrix.columns.len()) > MOST {
        return picture(&beginning(matrix));
    }
    let names = matrix.rows.iter().map(|name| width(name, LABEL)).fold(0.0, f64::max).min(200.0);
    let left = 44.0 + names;
    let count = matrix.columns.len().max(1) as f64;
    let wide = ((760.0 - left - SCALE) / count).min(CELL[0]);
    let top = Sheet::file(false).head() + 46.0;
    let (right, bottom) = (left + wide * count, top + CELL[1] * matrix.rows.len() as f64);
    let titles = [width(&matrix.title, TITLE), width(&matrix.second, SMALL)];
    let needed = titles.into_iter().fold(right + SCALE, |most, w| most.max(w + 40.0));
    let mut svg = Svg::new(needed.min(760.0), bottom.max(top + 130.0) + 18.0);
    head(&mut svg, &matrix.title, ["", &matrix.second]);
    let [rows, columns] = &matrix.sides;
    svg.text([0.5 * (left + right), top - 26.0], SMALL.at(Anchor::Middle), columns);
    let turned = Type { upwards: true, ..SMALL.at(Anchor::Middle) };
    svg.text([22.0, 0.5 * (top + bottom)], turned, rows);
    name_columns(&mut svg, matrix, [left, wide, top - 8.0]);
    for (i, name) in matrix.rows.iter().enumerate() {
        let y = top + CELL[1] * (i as f64 + 0.5) + 4.4;
        svg.text([left - 8.0, y], LABEL.at(Anchor::End), &fitted(name, LABEL, 200.0));
        let cells = matrix.values.get(i).map_or(&[][..], Vec::as_slice);
        for (k, value) in cells.iter().enumerate() {
            let from = [left + wide * k as f64, top + CELL[1] * i as f64];
            cell(&mut svg, [from, [from[0] + wide, from[1] + CELL[1]]], *value);
        }
    }
    scale(&mut svg, matrix, [right + 26.0, top]);
    Picture::new(&matrix.name, &matrix.title, &described(matrix), svg)
}

fn beginning(matrix: &Matrix) -> Matrix {
    let row = |row: &Vec<Option<f64>>| row.iter().take(MOST).copied().collect();
    Matrix {
        second: format!("{}; the first {MOST}", matrix.second),
        rows: matrix.rows.iter().take(MOST).cloned().collect(),
        columns: matrix.columns.iter().take(MOST).cloned().collect(),
        values: matrix.values.iter().take(MOST).map(row).collect(),
        ..matrix.clone()
    }
}

/// The names of the columns, reduced to every second, fifth or tenth for lack of room.
fn name_columns(svg: &mut Svg, matrix: &Matrix, [left, wide, y]: [f64; 3]) {
    let widest = matrix.columns.iter().map(|name| width(name, LABEL)).fold(0.0, f64::max);
    let fits = |every: &usize| *every as f64 * wide >= widest + 4.0;
    let every = [1, 2, 5, 10, 20, 50, 100].into_iter().find(fits).unwrap_or(200);
    let all = matrix.columns.iter().enumerate();
    for (k, name) in all.filter(|(k, _)| (k + 1).is_multiple_of(every)) {
        let x = left + wide * (k as f64 + 0.5);
        svg.text([x, y], LABEL.at(Anchor::Middle), &fitted(name, LABEL, every as f64 * wide));
    }
}

fn cell(svg: &mut Svg, [from, to]: [[f64; 2]; 2], value: Option<f64>) {
    let pen = Some(Pen::new(PAPER, 1.5));
    let Some(value) = value.filter(|value| value.is_finite()) else {
        svg.text([0.5 * (from[0] + to[0]), to[1] - 10.0], SMALL.at(Anchor::Middle), "–");
        return;
    };
    svg.rect([from, to], SERIES[0], opacity(value), pen);
    let words = format!("{value:.2}");
    if width(&words, LABEL) < to[0] - from[0] {
        svg.text([0.5 * (from[0] + to[0]), to[1] - 10.6], LABEL.at(Anchor::Middle), &words);
    }
}

fn opacity(value: f64) -> f64 {
    (100.0 * FULL * value.clamp(0.0, 1.0)).round() / 100.0
}

/// The scale of the colours.
fn scale(svg: &mut Svg, matrix: &Matrix, [x, y]: [f64; 2]) {
    const PARTS: usize = 5;
    const STEP: f64 = 22.0;
    for k in 0..=PARTS {
        let value = 1.0 - k as f64 / PARTS as f64;
        let from = [x, y + STEP * k as f64];
        let to = [x + 20.0, from[1] + STEP];
        svg.rect([from, to], SERIES[0], opacity(value), Some(Pen::new(FRAME, 0.6)));
        svg.text([to[0] + 6.0, from[1] + 15.0], SMALL, &format!("{value:.1}"));
    }
    svg.text([x, y - 8.0], SMALL, &matrix.scale);
}

fn described(matrix: &Matrix) -> String {
    let row = |(name, values): (&String, &Vec<Option<f64>>)| {
        let all: Vec<String> =
            values.iter().map(|v| v.map_or("none".into(), |v| format!("{v:.2}"))).collect();
        format!("{name}: {}", all.join(" "))
    };
    let rows: Vec<String> = matrix.rows.iter().zip(&matrix.values).take(20).map(row).collect();
    format!("{} of {} and {}. {}.", matrix.scale, matrix.sides[0], matrix.sides[1], rows.join("; "))
}
