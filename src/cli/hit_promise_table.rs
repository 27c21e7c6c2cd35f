//! The promise of exit speeds and the truth as a table.

use std::fmt::Write;

use sweetspot::proof::hit_promise::{CheckedHit, Course, Summary};

const TITLE: &str = "Errors of exit speeds on random hits, relative to the closing speed:

hits                       n  true/stated    close  met
";

/// A line for every kind of bat and for what happens in a hit, and one for all.
pub fn summary(rows: &[CheckedHit]) -> String {
    let mut out = TITLE.to_owned();
    let mut bats: Vec<&str> = rows.iter().map(|row| row.bat.as_str()).collect();
    bats.sort_unstable();
    bats.dedup();
    for bat in bats {
        line(&mut out, bat, rows.iter().filter(|row| row.bat == bat));
    }
    for (course, name) in Course::ALL {
        line(&mut out, name, rows.iter().filter(|row| row.course == course));
    }
    line(&mut out, "all", rows.iter());
    out
}

fn line<'a>(out: &mut String, name: &str, rows: impl Iterator<Item = &'a CheckedHit>) {
    let summary = Summary::of(rows);
    let Summary { hits, ratio, met, .. } = summary;
    let close = 100.0 * summary.share_close();
    let _ = write!(out, "{name:<22} {hits:>5}  {ratio:>11.2}  {close:>5.1} %  {met}");
    let _ = match summary.broken {
        0 => writeln!(out),
        broken => writeln!(out, "; {broken} BROKEN"),
    };
}

/// One line per hit.
pub fn table(rows: &[CheckedHit]) -> String {
    let mut out = String::from(
        "hit  bat        what happens      tol     true   stated  known to  ratio  met\n",
    );
    for row in rows {
        let (_, course) =
            Course::ALL.into_iter().find(|(c, _)| *c == row.course).unwrap_or(Course::ALL[0]);
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
