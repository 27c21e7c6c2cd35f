//! The promise and the truth as tables.

use std::fmt::Write;

use sweetspot::base::number::percent;
use sweetspot_proof::promise::{BATS, CheckedBat, DIGITS, Summary};
use sweetspot_report::report::columns::{Columns, first, labels, numbers};

const TITLE: &str = "The promise: true errors within 3 times the stated ones, always; stated within
30 times the true ones in nine of ten above 1e-13. Worst true/stated error:

";
const LEGEND: &str =
    "+ met; ~ met by the estimate, not quite by the truth; - out of reach, and said
so; ! an error beyond three times the stated one
";

/// One line per bat: the worst ratios of true to stated errors, and what became of every tolerance.
pub fn summary(rows: &[CheckedBat]) -> String {
    let mut out = TITLE.to_owned() + &columns().heads();
    for (bat, _) in BATS {
        let of_bat: Vec<CheckedBat> = rows.iter().filter(|row| row.bat == *bat).cloned().collect();
        let modes = of_bat.iter().map(|row| row.modes).max().unwrap_or(0);
        let marks: String = of_bat.iter().map(mark).collect();
        line(&mut out, bat, &modes.to_string(), &Summary::of(&of_bat), &marks);
    }
    let all = Summary::of(rows);
    line(&mut out, "all", "", &all, if all.holds() { "kept" } else { "BROKEN" });
    out + LEGEND
}

fn columns() -> Columns {
    Columns::new([
        first(19, "bat"),
        numbers(6, "modes"),
        numbers(11, "frequency"),
        numbers(7, "nodes"),
        numbers(8, "masses"),
        numbers(9, "close"),
        labels(11, "1e-2..1e-12"),
    ])
}

fn line(out: &mut String, bat: &str, modes: &str, summary: &Summary, marks: &str) {
    *out += &columns().row([
        bat,
        modes,
        &ratio(summary.frequency_ratio),
        &ratio(summary.node_ratio),
        &ratio(summary.mass_ratio),
        &percent(summary.share_close(), 1),
        marks,
    ]);
}

/// One line per bat and tolerance.
pub fn table(rows: &[CheckedBat]) -> String {
    let mut out = String::from(
        "                          degree x   worst error     true/stated         within\n\
         bat                tol    elements   true   stated  freq nodes masses   30   met\n",
    );
    for (k, row) in rows.iter().enumerate() {
        if k > 0 && k % DIGITS.count() == 0 {
            out.push('\n');
        }
        let plan = format!("{:>2} x {}", row.degree, row.elements);
        let _ = writeln!(
            out,
            "{:<18} {:>5.0e}  {plan:<8} {:>7.1e} {:>7.1e}  {:>4} {:>4}  {:>4}  {:>2}/{:<2}  {}",
            row.bat,
            row.tolerance,
            row.truth,
            row.stated,
            ratio(row.frequency_ratio),
            ratio(row.node_ratio),
            ratio(row.mass_ratio),
            row.close,
            row.visible,
            mark(row)
        );
    }
    out.push('\n');
    out
}

/// A ratio to two digits; nothing where nothing is known.
fn ratio(value: f64) -> String {
    if value == 0.0 { String::new() } else { format!("{value:.2}") }
}

fn mark(row: &CheckedBat) -> char {
    match (row.holds(), row.met, row.truly_met()) {
        (false, _, _) => '!',
        (_, true, true) => '+',
        (_, true, false) => '~',
        (_, false, _) => '-',
    }
}
