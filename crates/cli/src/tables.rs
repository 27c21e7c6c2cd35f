//! The promises and the extremes as tables. Each column is defined once: its head, its place and its text for a row.

use std::fmt::Write;

use sweetspot::Theory;
use sweetspot::base::number::percent;
use sweetspot::base::telling::Tell;
use sweetspot_proof::extremes::{EXTREMES, Extreme, Outcome, Verdict};
use sweetspot_proof::hit_promise::{self, CheckedHit, ReferenceCourse};
use sweetspot_proof::hoop_promise::CheckedHoop;
use sweetspot_proof::promise::{BATS, CheckedBat, DIGITS, Summary};
use sweetspot_proof::proven_promise::ProvenBat;
use sweetspot_report::parts::{Shown, first, labels, lines, numbers, wrapped};

/// A checked hit or hoop mode in one letter: kept and met, kept and out of reach, broken.
fn kept(holds: bool, met: bool) -> String {
    let mark = match (holds, met) {
        (false, _) => "!",
        (true, true) => "+",
        (true, false) => "-",
    };
    mark.to_owned()
}

/// A number with one digit after the point.
fn short(value: f64) -> String {
    format!("{value:.1e}")
}

/// Frequencies, nodes and masses on bats with exact frequencies: a line for each bat and tolerance.
pub fn beams(rows: &[CheckedBat]) -> String {
    let columns: &[Shown<CheckedBat>] = &[
        (first(18, "bat"), &|row| row.bat.to_owned()),
        (numbers(6, "tol"), &|row| format!("{:.0e}", row.tolerance)),
        (labels(8, "elements"), &|row| format!("{:>2} x {}", row.degree, row.elements)),
        (numbers(8, "true"), &|row| short(row.truth)),
        (numbers(8, "stated"), &|row| short(row.stated)),
        (numbers(6, "freq"), &|row| ratio(row.frequency_ratio)),
        (numbers(6, "nodes"), &|row| ratio(row.node_ratio)),
        (numbers(7, "masses"), &|row| ratio(row.mass_ratio)),
        (numbers(6, "30"), &|row| format!("{:>2}/{:<2}", row.close, row.visible)),
        (labels(3, "met"), &|row| mark(row).to_string()),
    ];
    let lines = lines(rows, columns);
    let mut out = String::from(
        "                          degree x   worst error     true/stated     within\n",
    );
    for (k, line) in lines.lines().enumerate() {
        // The first line is that of the heads.
        out += if k > 1 && (k - 1) % DIGITS.count() == 0 { "\n" } else { "" };
        out += &format!("{line}\n");
    }
    out + "\n"
}

/// The summary of a bat, or of all: its name, modes, worst ratios, and the result for every tolerance.
struct ToldBat {
    name: &'static str,
    modes: String,
    summary: Summary,
    marks: String,
}

/// A line for each bat: the worst ratios of true to stated errors, and the result for every tolerance.
pub fn beams_in_short(rows: &[CheckedBat]) -> String {
    let columns: &[Shown<ToldBat>] = &[
        (first(19, "bat"), &|bat| bat.name.to_owned()),
        (numbers(6, "modes"), &|bat| bat.modes.clone()),
        (numbers(11, "frequency"), &|bat| ratio(bat.summary.frequency_ratio)),
        (numbers(7, "nodes"), &|bat| ratio(bat.summary.node_ratio)),
        (numbers(8, "masses"), &|bat| ratio(bat.summary.mass_ratio)),
        (numbers(9, "close"), &|bat| percent(bat.summary.share_close(), 1)),
        (labels(11, "1e-2..1e-12"), &|bat| bat.marks.clone()),
    ];
    let told = |(name, _): &(&'static str, _)| {
        let rows: Vec<CheckedBat> = rows.iter().filter(|row| row.bat == *name).cloned().collect();
        let modes = rows.iter().map(|row| row.modes).max().unwrap_or(0).to_string();
        ToldBat { name, modes, summary: Summary::of(&rows), marks: rows.iter().map(mark).collect() }
    };
    let mut bats: Vec<ToldBat> = BATS.iter().map(told).collect();
    let summary = Summary::of(rows);
    let marks = if summary.holds() { "kept" } else { "BROKEN" }.to_owned();
    bats.push(ToldBat { name: "all", modes: String::new(), summary, marks });
    format!(
        "The promise: true errors within 3 times the stated ones, always; stated within\n\
         30 times the true ones in nine of ten above 1e-13. Worst true/stated error:\n\n\
         {}\
         + met; ~ met by the estimate, not quite by the truth; - out of reach, and said\n\
         so; ! an error beyond three times the stated one\n",
        lines(&bats, columns)
    )
}

/// A ratio to two digits; empty if it is not known.
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

/// Exit speeds on random hits: a line for each hit.
pub fn hits(rows: &[CheckedHit]) -> String {
    let columns: &[Shown<CheckedHit>] = &[
        (numbers(3, "hit"), &|row| row.number.to_string()),
        (labels(9, "bat"), &|row| row.bat.clone()),
        (labels(13, "what happens"), &|row| {
            let named = ReferenceCourse::ALL.into_iter().find(|(course, _)| *course == row.course);
            named.map_or(String::new(), |(_, name)| name.to_owned())
        }),
        (numbers(7, "tol"), &|row| format!("{:.0e}", row.tolerance)),
        (numbers(9, "true"), &|row| short(row.truth)),
        (numbers(9, "stated"), &|row| short(row.stated)),
        (numbers(10, "known to"), &|row| short(row.known_to)),
        (numbers(7, "ratio"), &|row| format!("{:.2}", row.ratio())),
        (labels(3, "met"), &|row| kept(row.holds(), row.met)),
    ];
    lines(rows, columns) + "\n"
}

/// A line for every kind of bat and every kind of hit, and one for all.
pub fn hits_in_short(rows: &[CheckedHit]) -> String {
    let columns: &[Shown<(&str, hit_promise::Summary)>] = &[
        (first(22, "hits"), &|(name, _)| (*name).to_owned()),
        (numbers(6, "n"), &|(_, all)| all.hits.to_string()),
        (numbers(13, "true/stated"), &|(_, all)| format!("{:.2}", all.ratio)),
        (numbers(9, "close"), &|(_, all)| percent(all.share_close(), 1)),
        (labels(3, "met"), &|(_, all)| match all.broken {
            0 => all.met.to_string(),
            broken => format!("{}; {broken} BROKEN", all.met),
        }),
    ];
    let mut bats: Vec<&str> = rows.iter().map(|row| row.bat.as_str()).collect();
    bats.sort_unstable();
    bats.dedup();
    let some = |name, belongs: &dyn Fn(&CheckedHit) -> bool| {
        (name, hit_promise::Summary::of(rows.iter().filter(|row| belongs(row))))
    };
    let bats = bats.into_iter().map(|bat| some(bat, &|row| row.bat == bat));
    let courses = ReferenceCourse::ALL.into_iter();
    let courses = courses.map(|(course, name)| some(name, &|row| row.course == course));
    let all: Vec<_> = bats.chain(courses).chain([some("all", &|_| true)]).collect();
    let title = "Errors of exit speeds on random hits, relative to the closing speed:\n\n";
    title.to_owned() + &lines(&all, columns)
}

/// A line for every barrel and tolerance: the largest errors of its modes and the largest ratio.
pub fn hoops(rows: &[CheckedHoop]) -> String {
    fn largest(rows: &[CheckedHoop], of: fn(&CheckedHoop) -> f64) -> f64 {
        rows.iter().map(of).fold(0.0, f64::max)
    }
    let columns: &[Shown<&[CheckedHoop]>] = &[
        (first(16, "barrel"), &|rows| rows[0].barrel.clone()),
        (numbers(8, "tol"), &|rows| format!("{:.0e}", rows[0].tolerance)),
        (numbers(10, "true"), &|rows| short(largest(rows, |row| row.truth))),
        (numbers(10, "stated"), &|rows| short(largest(rows, |row| row.stated))),
        (numbers(10, "known to"), &|rows| short(rows[0].known_to)),
        (numbers(13, "true/stated"), &|rows| format!("{:.2}", largest(rows, CheckedHoop::ratio))),
        (labels(3, "met"), &|rows| kept(rows.iter().all(CheckedHoop::holds), rows[0].met)),
    ];
    let same =
        |a: &CheckedHoop, b: &CheckedHoop| a.barrel == b.barrel && a.tolerance == b.tolerance;
    let barrels: Vec<&[CheckedHoop]> = rows.chunk_by(same).collect();
    let title = "Errors of hoop modes, n = 2 and 3, three modes each, relative:\n\n";
    title.to_owned() + &lines(&barrels, columns) + "\n"
}

/// Stated errors compared with proven frequencies: a line for every kind of bat and every theory, and one for all.
pub fn proven(rows: &[ProvenBat]) -> String {
    type Bats<'a> = (&'static str, Vec<&'a ProvenBat>);
    fn sum(bats: &Bats, of: fn(&ProvenBat) -> usize) -> usize {
        bats.1.iter().map(|bat| of(bat)).sum()
    }
    let columns: &[Shown<Bats>] = &[
        (first(16, "bats"), &|bats| bats.0.to_owned()),
        (numbers(5, "n"), &|bats| bats.1.len().to_string()),
        (numbers(14, "proven modes"), &|bats| sum(bats, |bat| bat.proven).to_string()),
        (numbers(8, "held"), &|bats| sum(bats, |bat| bat.held).to_string()),
        (numbers(6, "open"), &|bats| {
            sum(bats, |bat| bat.proven - bat.held - bat.broken).to_string()
        }),
        (numbers(8, "broken"), &|bats| sum(bats, |bat| bat.broken).to_string()),
        (numbers(13, "true/stated"), &|bats| {
            format!("{:.2}", bats.1.iter().map(|bat| bat.at_least).fold(0.0, f64::max))
        }),
    ];
    let some = |name, belongs: &dyn Fn(&&ProvenBat) -> bool| {
        (name, rows.iter().filter(belongs).collect::<Vec<_>>())
    };
    let kinds = ["smooth", "straight", "hollow", "with a weight"].into_iter();
    let kinds = kinds.map(|kind| some(kind, &|bat| bat.kind == kind));
    let theories = Theory::ALL.into_iter();
    let theories = theories.map(|theory| some(theory.name(), &|bat| bat.theory == theory));
    let all: Vec<Bats> = kinds.chain(theories).chain([some("all", &|_| true)]).collect();
    let title = "Stated errors of frequencies held against proven intervals, on random bats:\n\n";
    title.to_owned() + &lines(&all, columns)
}

/// Every extreme, and whether all are right or refused with a reason.
pub fn extremes(tell: Tell) -> (String, bool) {
    fn number(value: f64) -> String {
        if value.is_finite() { short(value) } else { String::new() }
    }
    let columns: &[Shown<(&str, Outcome)>] = &[
        (first(40, "what"), &|(what, _)| (*what).to_owned()),
        (numbers(8, "asked"), &|(_, out)| match out.asked {
            0.0 => "bits".to_owned(),
            asked => number(asked),
        }),
        (numbers(9, "found"), &|(_, out)| number(out.found)),
        (numbers(9, "stated"), &|(_, out)| number(out.stated)),
        (labels(7, "verdict"), &|(_, out)| judged(&out.verdict).1.to_owned()),
    ];
    let run = |(k, extreme): (usize, &Extreme)| {
        tell(k as f64 / EXTREMES.len() as f64, extreme.what);
        (extreme.what, extreme.run())
    };
    let rows: Vec<(&str, Outcome)> = EXTREMES.iter().enumerate().map(run).collect();
    let lines = lines(&rows, columns);
    let mut lines = lines.lines();
    let mut out = format!(
        "Right within three times the stated error, or refused with the reason:\n\n{}\n",
        lines.next().unwrap_or_default()
    );
    let mut counts = [0; 3];
    for ((_, outcome), line) in rows.iter().zip(lines) {
        let remark = match &outcome.verdict {
            Verdict::Right => &outcome.note,
            Verdict::Refused(reason) | Verdict::Wrong(reason) => reason,
        };
        counts[judged(&outcome.verdict).0] += 1;
        let remark =
            if remark.is_empty() { String::new() } else { wrapped(&format!("    {remark}"), 4) };
        out += &format!("{line}\n{remark}");
    }
    let [right, refused, wrong] = counts;
    let _ = writeln!(out, "{right} right, {refused} refused, {wrong} wrong");
    (out, wrong == 0)
}

/// A verdict as a number from 0, and in a word.
fn judged(verdict: &Verdict) -> (usize, &'static str) {
    match verdict {
        Verdict::Right => (0, "right"),
        Verdict::Refused(_) => (1, "refused"),
        Verdict::Wrong(_) => (2, "WRONG"),
    }
}
