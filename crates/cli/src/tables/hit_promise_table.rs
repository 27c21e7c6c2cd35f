//! The promise of exit speeds and the truth as a table.

use std::fmt::Write;

use sweetspot::base::number::percent;
use sweetspot_proof::hit_promise::{CheckedHit, ReferenceCourse, Summary};
use sweetspot_report::report::columns::{Columns, first, labels, numbers};

const TITLE: &str = "Errors of exit speeds on random hits, relative to the closing speed:

";

/// A line for every kind of bat and for what happens in a hit, and one for all.
pub fn summary(rows: &[CheckedHit]) -> String {
    let mut out = TITLE.to_owned() + &columns().heads();
    let mut bats: Vec<&str> = rows.iter().map(|row| row.bat.as_str()).collect();
    bats.sort_unstable();
    bats.dedup();
    for bat in bats {
        line(&mut out, bat, rows.iter().filter(|row| row.bat == bat));
    }
    for (course, name) in ReferenceCourse::ALL {
        line(&mut out, name, rows.iter().filter(|row| row.course == course));
    }
    line(&mut out, "all", rows.iter());
    out
}

fn columns() -> Columns {
    Columns::new([
        first(22, "hits"),
        numbers(6, "n"),
        numbers(13, "true/stated"),
        numbers(9, "close"),
        labels(3, "met"),
    ])
}

fn line<'a>(out: &mut String, name: &str, rows: impl Iterator<Item = &'a CheckedHit>) {
    let summary = Summary::of(rows);
    let met = match summary.broken {
        0 => summary.met.to_string(),
        broken => format!("{}; {broken} BROKEN", summary.met),
    };
    *out += &columns().row([
        name,
        &summary.hits.to_string(),
        &format!("{:.2}", summary.ratio),
        &percent(summary.share_close(), 1),
        &met,
    ]);
}

/// One line per hit.
pub fn table(rows: &[CheckedHit]) -> String {
    let mut out = String::from(
        "hit  bat        what happens      tol     true   stated  known to  ratio  met\n",
    );
    for row in rows {
        let (_, course) = ReferenceCourse::ALL
            .into_iter()
            .find(|(c, _)| *c == row.course)
            .unwrap_or(ReferenceCourse::ALL[0]);
        let _ = writeln!(
            out,
            "{:>3}  {:<9}  {course:<13}  {:>5.0e}  {:>7.1e}  {:>7.1e}   {:>7.1e}  {:>5.2}  {}",
            row.number,
            row.bat,
            row.tolerance,
            row.truth,
            row.stated,
            row.known_to,
            row.ratio(),
            match (row.holds(), row.met) {
                (false, _) => '!',
                (true, true) => '+',
                (true, false) => '-',
            }
        );
    }
    out.push('\n');
    out
}
