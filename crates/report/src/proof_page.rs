//! What is on the page `docs/validation.md`?
//!
//! It compares published bats with our results, and has exact answers in one table. [`text`] writes it.
//!
//! Everything on it is a case of `validation/` or was computed from one, and is rounded so that every run and every
//! machine writes the same page.

use std::fmt::Write;

use crate::hit_figure;
use sweetspot::base::error::Result;
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

/// The page, as Markdown.
///
/// # Errors
///
/// The errors of the solutions on the page.
pub fn text(answers: &[PublishedCase]) -> Result<String> {
    let bats = published::bats(answers);
    let (known, exact): (Vec<&PublishedCase>, Vec<&PublishedCase>) =
        answers.iter().partition(|answer| answer.case.published.is_some());
    let mut out = format!("# Known answers beside ours\n\n**{}**\n\n{START}\n", verdict(answers));
    verdicts(&known, &bats, &mut out);
    let _ = writeln!(out, "- Exact answers: {}", exact_verdict(&exact));
    let _ = write!(out, "\n{MEANING}");
    contents(&bats, &mut out);
    let _ = write!(out, "\n## The hit\n\n![{PICTURE}]({})\n\n{HIT}", hit_figure::FILE);
    let _ = write!(out, "\n## Published bats\n\n{PUBLISHED}");
    for bat in bats {
        let of_bat: Vec<&PublishedCase> = known.iter().copied().filter(|a| named(a, bat)).collect();
        let table = published::side_by_side(&of_bat)?;
        let gap = if table.is_empty() { "" } else { "\n" };
        let _ = write!(out, "\n### {bat}\n{gap}{table}");
        of_bat.iter().for_each(|answer| details(answer, &mut out));
    }
    exact_table(&exact, &mut out);
    let _ = write!(out, "\n## How to make this page\n\n{MAKE}");
    Ok(out)
}

const START: &str = "\
This page sets numbers that others measured or computed beside what `sweetspot` finds for the same
bat. A number is *missed* if it is further off than its tolerance, and every tolerance has its
reason below the table. Numbers *for information* are shown with their difference but not counted:
what was published is not enough to compute them again. In plain words:
";

const MEANING: &str = "\
For a bat maker: where shape and wood of the bat are the published ones, the beam with shear gives
the bending frequencies to one or two per cent and the nodes to a centimetre. Where the difference
is larger, what was published is not quite the bat that was tapped or computed: a twin of the
profile, a profile of another bat, a clamp that gives way, a wall that was guessed; the reasons say
which. The plain beam, without shear, is good for the first mode and more and more too high from the
second on. We fitted nothing to make a number pass; where the authors fitted E, the reasons say so.
";

const PICTURE: &str = "Exit speed along an R161, ours beside measured and computed points";

const HIT: &str = "\
Left: a ball at 1 m/s on a bat at rest; R. Cross's points with error bars of 0.015 m/s, the middle of
those that were drawn. Right: a ball at 40 m/s meets a bat whose balance point moves at 24 m/s; points
of A. M. Nathan's Fig. 10, read off to 0.4 m/s. Nothing is fitted: the ball's law, E and G are
Nathan's, the profile is a near twin of his bat. At rest a rigid bat would be best at its balance
point; at game speed it is as good as the one that bends only between the nodes of the first modes.
The empirical loss of the WPI report takes a little speed off everywhere, the sweet spot included,
and far too little on both sides of it.
";

const PUBLISHED: &str = "\
First the numbers side by side, frequencies in Hz and node positions from the knob end; in
brackets the difference from what was published (measured if there is such a number, else computed
by the same theory, else by another). Euler-Bernoulli is the plain beam, Timoshenko the beam with
shear and rotary inertia. Then every number with its tolerance.
";

const MAKE: &str = "\
```
sweetspot validate --page docs/validation.md
```

writes it and the picture beside it from the cases in `validation/`, one JSON file each, and exits
with 1 if a number is missed. `sweetspot validate --case NAME` prints one case with more digits.
";

const EXACT: &str = "\
Closed forms, solutions with many digits by other methods, and printed tables of such. The fourth
column is the largest error of the case in units of its tolerance; up to 1 it passes. What confirms
the truths besides is in the case files.
";

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
    let _ = write!(out, "\n## Contents\n\n{}{}", line("The hit"), line("Published bats"));
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
    let _ = write!(out, "\n## Exact answers\n\n{EXACT}\n");
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

/// With a capital and a full stop.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    let stop = if text.ends_with('.') { "" } else { "." };
    format!("{first}{}{stop}", letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_is_found_by_its_address() {
        assert_eq!(anchor("Hillerich & Bradsby BB296, 1992"), "hillerich--bradsby-bb296-1992");
    }
}
