//! What is on the page `docs/validation.md`?
//!
//! It compares published bats with our results, and has exact answers in one table. [`text`] writes it.
//!
//! Everything on it is a case of `validation/` or was computed from one, and is rounded so that every run and every
//! machine writes the same page.

use std::fmt::Write;

use crate::hit_figure;
use crate::parts::sentence;
use sweetspot::Result;
use sweetspot_proof::published::{self, PublishedCase, decimals, number, percent, signed};
use sweetspot_proof::validation::KnownNumber;

/// The numbers of comparisons and of misses, in one sentence.
pub fn verdict(answers: &[PublishedCase]) -> String {
    let rows = || answers.iter().flat_map(|answer| &answer.rows);
    let information = rows().filter(|row| row.information).count();
    let counted = rows().count() - information;
    let missed = rows().filter(|row| row.missed()).count();
    let missed = if missed == 0 { "none".to_owned() } else { missed.to_string() };
    format!(
        "{counted} numbers in {} cases are checked, {missed} of them missed; {information} more are \
         shown for information.",
        answers.len()
    )
}

/// The text that does not depend on the answers; each mark `@…` is replaced by a part that does.
const PAGE: &str = include_str!("proof_page.md");

/// The page, as Markdown.
///
/// # Errors
///
/// The errors of the solutions on the page.
pub fn text(answers: &[PublishedCase]) -> Result<String> {
    let bats = published::bats(answers);
    let (known, exact): (Vec<&PublishedCase>, Vec<&PublishedCase>) =
        answers.iter().partition(|answer| answer.case.published.is_some());
    let [mut told, mut list, mut all, mut table] = [const { String::new() }; 4];
    verdicts(&known, &bats, &mut told);
    let _ = writeln!(told, "- Exact answers: {}", exact_verdict(&exact));
    contents(&bats, &mut list);
    for bat in bats {
        let of_bat: Vec<&PublishedCase> = known.iter().copied().filter(|a| named(a, bat)).collect();
        let beside = published::side_by_side(&of_bat)?;
        let gap = if beside.is_empty() { "" } else { "\n" };
        let _ = write!(all, "\n### {bat}\n{gap}{beside}");
        of_bat.iter().for_each(|answer| details(answer, &mut all));
    }
    exact_table(&exact, &mut table);
    let parts = [
        ("@verdicts\n", &*told),
        ("@verdict", &verdict(answers)),
        ("@contents\n", &list),
        ("@picture", hit_figure::FILE),
        ("@bats\n", &all),
        ("@exact\n", &table),
    ];
    Ok(parts.iter().fold(PAGE.to_owned(), |page, (mark, part)| page.replace(mark, part)))
}

/// Whether the case is of that bat.
fn named(answer: &PublishedCase, bat: &str) -> bool {
    answer.case.published.as_ref().is_some_and(|published| published.bat == bat)
}

/// A line for each bat: the number of values within their tolerance, and the deviations.
fn verdicts(known: &[&PublishedCase], bats: &[&str], out: &mut String) {
    for bat in bats {
        let rows: Vec<&KnownNumber> =
            known.iter().filter(|a| named(a, bat)).flat_map(|a| a.counted()).collect();
        let within = rows.iter().filter(|row| row.passes()).count();
        let _ = match rows.len() {
            0 => writeln!(out, "- {bat}: for information only."),
            all => writeln!(
                out,
                "- {bat}: {within} of {all} within their tolerance{}.",
                published::furthest(&rows)
            ),
        };
    }
}

/// The number of exact answers and the largest error among them.
fn exact_verdict(exact: &[&PublishedCase]) -> String {
    let all = exact.iter().map(|answer| answer.counted().count()).sum::<usize>();
    let within = exact.iter().flat_map(|answer| answer.counted()).filter(|row| row.passes());
    let worst = exact.iter().map(|answer| answer.worst()).fold(0.0, f64::max);
    format!("{} of {all} within their tolerance, the worst at {worst:.2} of it.", within.count())
}

/// The table of contents.
fn contents(bats: &[&str], out: &mut String) {
    let line = |title: &str| format!("- [{title}](#{})\n", anchor(title));
    let _ = write!(out, "{}{}", line("The hit"), line("Published bats"));
    bats.iter().for_each(|bat| {
        let _ = write!(out, "  {}", line(bat));
    });
    let _ = write!(out, "{}{}", line("Exact answers"), line("How to make this page"));
}

/// The address of a heading within a page, as the usual Markdown viewers make it.
fn anchor(title: &str) -> String {
    let kept = title.chars().filter(|c| c.is_alphanumeric() || *c == ' ' || *c == '-');
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}

/// Every number of a case with its tolerance, and the reasons below.
fn details(answer: &PublishedCase, out: &mut String) {
    let case = &answer.case;
    let _ = write!(out, "\n#### {} (`{}`)\n\nSource: ", case.name, answer.name);
    let _ = writeln!(out, "{}\n\nOur bat: {}\n", sentence(&case.source), case.bat_source());
    *out += "| quantity | published | ours | difference | tolerance | verdict | reason |\n";
    *out += "|---|--:|--:|--:|--:|---|---|\n";
    let mut reasons: Vec<&str> = Vec::new();
    for row in &answer.rows {
        let note = row.note.as_deref().unwrap_or_default();
        let known = reasons.iter().position(|reason| *reason == note);
        let place = known.unwrap_or_else(|| {
            reasons.push(note);
            reasons.len() - 1
        });
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} |",
            row.quantity,
            row.expected,
            found(row),
            difference(row),
            tolerance(row),
            if row.information {
                "information"
            } else if row.passes() {
                "ok"
            } else {
                "MISSED"
            },
            place + 1
        );
    }
    out.push('\n');
    for (place, reason) in reasons.iter().enumerate() {
        let _ = writeln!(out, "{}. {}", place + 1, sentence(reason));
    }
}

/// Our number, with one digit more than the published one, or as many as the difference.
fn found(row: &KnownNumber) -> String {
    if !row.relative {
        return number(row.found, digits_of_difference(row));
    }
    let before = row.expected.to_string().split('.').next().map_or(1, str::len);
    number(row.found, (decimals(row.expected) + 1).min(6_usize.saturating_sub(before)))
}

/// Two digits of the tolerance; a length without one to the millimetre.
fn digits_of_difference(row: &KnownNumber) -> usize {
    let decimals = if row.information { 3.0 } else { 1.0 - row.tolerance.log10().floor() };
    decimals.max(0.0) as usize
}

/// Our value minus the published one: relative in per cent, or in the unit of the quantity.
fn difference(row: &KnownNumber) -> String {
    let difference = row.found - row.expected;
    if row.relative {
        return percent(difference / row.expected.abs());
    }
    signed(difference, digits_of_difference(row))
}

fn tolerance(row: &KnownNumber) -> String {
    match (row.information, row.relative) {
        (true, _) => "none".to_owned(),
        (false, false) => row.tolerance.to_string(),
        // A share such as 0.07 times 100 is not exactly 7.
        (false, true) => {
            let percent: f64 = format!("{:.6e}", 100.0 * row.tolerance).parse().unwrap_or(f64::NAN);
            format!("{percent} %")
        }
    }
}

/// One line for every exact case, and where the truths come from.
fn exact_table(exact: &[&PublishedCase], out: &mut String) {
    *out += "| case | what | numbers | worst error | truth |\n|---|---|--:|--:|--:|\n";
    let mut sources: Vec<&str> = Vec::new();
    for answer in exact {
        let source = answer.case.source.split(';').next().unwrap_or_default().trim_end_matches('.');
        let known = sources.iter().position(|known| *known == source);
        let place = known.unwrap_or_else(|| {
            sources.push(source);
            sources.len() - 1
        });
        let (name, what) = (answer.name, &answer.case.name);
        let (numbers, worst) = (answer.counted().count(), answer.worst());
        let _ = writeln!(out, "| `{name}` | {what} | {numbers} | {worst:.2} | {} |", place + 1);
    }
    *out += "\nThe truths:\n\n";
    for (place, source) in sources.iter().enumerate() {
        let _ = writeln!(out, "{}. {}", place + 1, sentence(source));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_is_found_by_its_address() {
        assert_eq!(anchor("Hillerich & Bradsby BB296, 1992"), "hillerich--bradsby-bb296-1992");
    }
}
