//! The causes of the variation of an answer: a table of shares.

use crate::parts::{Columns, first, labels, wrapped};
use sweetspot_study::many::indices::{Indices, Share};

/// Shares below this have no row.
pub const LITTLE: f64 = 0.005;

/// Shares of the variance of an answer, a row each from the largest on, where shares below `least` are sampling error;
/// the names of those too small for a row; and the row of the remainder.
pub fn shares_of(names: &[String], indices: &Indices, least: f64, rest: &str) -> [String; 3] {
    let columns = Columns::new([first(44, ""), labels(16, "alone"), labels(16, "with others")]);
    let shown = |share: &Share| format!("{:.3} ± {:.3}", share.value.max(least), share.sd);
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by(|a, b| indices.total[*b].value.total_cmp(&indices.total[*a].value));
    let (told, little): (Vec<usize>, Vec<usize>) =
        order.into_iter().partition(|k| indices.total[*k].value >= LITTLE);
    let row =
        |k: usize| columns.row([&names[k], &shown(&indices.first[k]), &shown(&indices.total[k])]);
    let rows: String = told.into_iter().map(row).collect();
    let little: Vec<&str> = little.into_iter().map(|k| names[k].as_str()).collect();
    let little = match little.is_empty() {
        true => String::new(),
        false => wrapped(&format!("less than {LITTLE} each: {}", little.join(", ")), 2),
    };
    [columns.heads() + &rows, little, columns.row([rest, &shown(&indices.unexplained)])]
}
