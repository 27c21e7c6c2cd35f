//! The promise of hoop modes and the truth as a table.

use sweetspot_proof::hoop_promise::CheckedHoop;
use sweetspot_report::report::columns::{Columns, first, labels, numbers};

const TITLE: &str = "Errors of hoop modes, n = 2 and 3, three modes each, relative:

";

/// A line for every barrel and tolerance: the largest errors of its modes and the largest ratio.
pub fn table(rows: &[CheckedHoop]) -> String {
    let columns = Columns::new([
        first(16, "barrel"),
        numbers(8, "tol"),
        numbers(10, "true"),
        numbers(10, "stated"),
        numbers(10, "known to"),
        numbers(13, "true/stated"),
        labels(3, "met"),
    ]);
    let mut out = TITLE.to_owned() + &columns.heads();
    let same =
        |a: &CheckedHoop, b: &CheckedHoop| a.barrel == b.barrel && a.tolerance == b.tolerance;
    for rows in rows.chunk_by(same) {
        let largest = |of: fn(&CheckedHoop) -> f64| rows.iter().map(of).fold(0.0, f64::max);
        let met = match (rows.iter().all(CheckedHoop::holds), rows[0].met) {
            (false, _) => "!",
            (true, true) => "+",
            (true, false) => "-",
        };
        out += &columns.row([
            &rows[0].barrel,
            &format!("{:.0e}", rows[0].tolerance),
            &format!("{:.1e}", largest(|row| row.truth)),
            &format!("{:.1e}", largest(|row| row.stated)),
            &format!("{:.1e}", rows[0].known_to),
            &format!("{:.2}", largest(CheckedHoop::ratio)),
            met,
        ]);
    }
    out.push('\n');
    out
}
