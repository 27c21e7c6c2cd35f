//! The extremes as a table.

use std::fmt::Write;

use sweetspot::base::telling::Tell;
use sweetspot_proof::extremes::{EXTREMES, Outcome, Verdict};
use sweetspot_report::report::columns::{Columns, first, labels, numbers};

/// Every row, and whether all are right or refused with a reason.
pub fn table(tell: Tell) -> (String, bool) {
    let mut out = String::from("Right within three times the stated error, or refused");
    out += " with the reason:\n\n";
    let columns = Columns::new([
        first(40, "what"),
        numbers(8, "asked"),
        numbers(9, "found"),
        numbers(9, "stated"),
        labels(7, "verdict"),
    ]);
    out += &columns.heads();
    // Right, refused, wrong.
    let mut counts = [0; 3];
    for (k, extreme) in EXTREMES.iter().enumerate() {
        tell(k as f64 / EXTREMES.len() as f64, extreme.what);
        let Outcome { asked, found, stated, verdict, note } = extreme.run();
        let (which, word, remark) = match verdict {
            Verdict::Right => (0, "right", note),
            Verdict::Refused(reason) => (1, "refused", reason),
            Verdict::Wrong(reason) => (2, "WRONG", reason),
        };
        counts[which] += 1;
        let [asked, found, stated] = [asking(asked), number(found), number(stated)];
        out += &columns.row([extreme.what, &asked, &found, &stated, word]);
        wrapped(&remark, &mut out);
    }
    let [right, refused, wrong] = counts;
    let _ = writeln!(out, "{right} right, {refused} refused, {wrong} wrong");
    (out, wrong == 0)
}

/// A remark below its row, in lines of at most 80 columns.
fn wrapped(remark: &str, out: &mut String) {
    let mut room = 0;
    for word in remark.split_whitespace() {
        let width = word.chars().count() + 1;
        if width > room {
            *out += if room == 0 { "   " } else { "\n   " };
            room = 77;
        }
        room = room.saturating_sub(width).max(1);
        *out += " ";
        *out += word;
    }
    if room > 0 {
        out.push('\n');
    }
}

fn asking(value: f64) -> String {
    match value {
        0.0 => "bits".into(),
        value => number(value),
    }
}

fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:.1e}") } else { String::new() }
}
