//! How do published numbers of real bats compare with ours?
//!
//! [`PublishedCase::all`] computes every case again, [`side_by_side`] compares those of one bat.

use std::fmt::Write;

use crate::bundled::CASES;
use crate::case::{Case, Check, Known, Provenance};
use crate::validation::{KnownNumber, run};
use sweetspot::base::{Result, Tell, inches};
use sweetspot::bat::Theory;
use sweetspot::modes::solve::{Request, solve};

/// A case with its rows, one for each check.
#[derive(Debug)]
pub struct PublishedCase {
    /// Name of the case: its file in `validation/`, without the ending.
    pub name: &'static str,
    /// The case.
    pub case: Case,
    /// Rows, one for each check.
    pub rows: Vec<KnownNumber>,
}

impl PublishedCase {
    /// All built-in cases, computed again.
    ///
    /// # Errors
    ///
    /// As [`run`].
    pub fn all(tell: Tell) -> Result<Vec<Self>> {
        let answer = |(k, &(name, text)): (usize, &(&'static str, &str))| {
            tell(k as f64 / CASES.len() as f64, name);
            let (case, rows) = run(name, text)?;
            Ok(Self { name, case, rows })
        };
        CASES.iter().enumerate().map(answer).collect()
    }

    /// Whether it misses a number.
    pub fn missed(&self) -> bool {
        self.rows.iter().any(KnownNumber::missed)
    }

    /// The rows that count, without those for information only.
    pub fn counted(&self) -> impl Iterator<Item = &KnownNumber> {
        self.rows.iter().filter(|row| !row.information)
    }

    /// The worst error in units of its tolerance.
    pub fn worst(&self) -> f64 {
        self.rows.iter().map(KnownNumber::share).fold(0.0, f64::max)
    }
}

/// The published bats, those with most numbers checked first.
pub fn bats(answers: &[PublishedCase]) -> Vec<&str> {
    let mut bats: Vec<(usize, &str)> = Vec::new();
    for answer in answers {
        let Some(published) = &answer.case.published else { continue };
        let counted = answer.counted().count();
        match bats.iter_mut().find(|(_, bat)| *bat == published.bat) {
            Some((numbers, _)) => *numbers += counted,
            None => bats.push((counted, &published.bat)),
        }
    }
    bats.sort_by_key(|&(numbers, bat)| (std::cmp::Reverse(numbers), bat));
    bats.into_iter().map(|(_, bat)| bat).collect()
}

/// The largest deviations of a frequency, node, exit speed and time, as the end of a sentence.
pub fn furthest(rows: &[&KnownNumber]) -> String {
    let largest = |relative: bool, unit: &str| {
        let rows =
            rows.iter().filter(|row| row.relative == relative && row.quantity.ends_with(unit));
        rows.map(|row| row.error).fold(f64::NAN, f64::max)
    };
    let (share, ratio) = (largest(true, " Hz"), largest(true, "/f1"));
    let (hertz, node) = (largest(false, " Hz"), largest(false, " m"));
    let (speed, time) = (largest(false, " m/s"), largest(true, " ms"));
    let mut words = Vec::new();
    if !share.is_nan() {
        words.push(format!("frequencies within {:.1} %", 100.0 * share));
    }
    if !hertz.is_nan() {
        let decimals = if hertz < 0.1 { 3 } else { 1 };
        words.push(format!("frequencies within {hertz:.decimals$} Hz"));
    }
    if !ratio.is_nan() {
        words.push(format!("frequency ratios within {:.1} %", 100.0 * ratio));
    }
    if !node.is_nan() {
        words.push(format!("nodes within {:.1} cm", 100.0 * node));
    }
    if !speed.is_nan() {
        let decimals = if speed < 0.1 { 3 } else { 1 };
        words.push(format!("exit speeds within {speed:.decimals$} m/s"));
    }
    if !time.is_nan() {
        words.push(format!("times within {:.1} %", 100.0 * time));
    }
    if words.is_empty() { String::new() } else { format!(" ({})", words.join(", ")) }
}

/// A line of the table: a mode's frequency, or its ratio to the first one's.
#[derive(Clone, Copy, PartialEq, Eq)]
struct TableLine<'a> {
    /// Which of several bats or meshes.
    row: Option<&'a str>,
    ratio: bool,
    mode: usize,
}

/// The cases of one bat as one table, a line for each mode: measured, computed by others, ours with and without shear,
/// nodes. Empty columns are omitted. Without modes there is no table.
///
/// # Errors
///
/// The errors of the bats and their solutions.
pub fn side_by_side(answers: &[&PublishedCase]) -> Result<String> {
    let lines = lines(answers);
    if lines.is_empty() {
        return Ok(String::new());
    }
    let mut cells = Vec::new();
    for line in &lines {
        cells.push(line_of_cells(answers, line)?);
    }
    let filled = |column: usize| cells.iter().any(|cells| !cells[column].is_empty());
    let columns: Vec<usize> = (0..HEADINGS.len()).filter(|&column| filled(column)).collect();
    let mut out = String::new();
    let mut write = |cells: &[String]| {
        let chosen: Vec<&str> = columns.iter().map(|&column| cells[column].as_str()).collect();
        let _ = writeln!(out, "| {} |", chosen.join(" | "));
    };
    write(&HEADINGS.map(str::to_owned));
    write(&HEADINGS.map(|_| "---".to_owned()));
    cells.iter().for_each(|cells| write(cells));
    Ok(out)
}

const HEADINGS: [&str; 9] = [
    "which",
    "mode",
    "measured",
    "published, Euler-Bernoulli",
    "published, with shear",
    "ours, Euler-Bernoulli",
    "ours, Timoshenko",
    "nodes, published",
    "nodes, ours",
];

/// Every mode that a case has a frequency, a ratio or a node of.
fn lines<'a>(answers: &[&'a PublishedCase]) -> Vec<TableLine<'a>> {
    let mut lines: Vec<TableLine> = Vec::new();
    for answer in answers {
        let ratio = answer.case.checks.iter().any(|check| check.quantity == Known::FrequencyRatio);
        for mode in answer.case.checks.iter().filter_map(|check| check.mode) {
            let line = TableLine { row: row_of(answer), ratio, mode };
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
    }
    // Rows in the order of the cases, modes rising.
    let order: Vec<Option<&str>> = lines.iter().map(|line| line.row).collect();
    lines.sort_by_key(|line| (order.iter().position(|row| *row == line.row), line.mode));
    lines
}

fn row_of(answer: &PublishedCase) -> Option<&str> {
    answer.case.published.as_ref()?.row.as_deref()
}

/// A line of the table, a cell for each heading.
fn line_of_cells(answers: &[&PublishedCase], line: &TableLine) -> Result<[String; 9]> {
    let here = || answers.iter().copied().filter(|answer| row_of(answer) == line.row);
    let measured =
        here().find_map(|answer| given(answer, line, |kind, _| kind == Provenance::Measured));
    let computed = |shears: bool| {
        here().find_map(|answer| {
            given(answer, line, |kind, theory| {
                kind == Provenance::Computed && theory.shears() == shears
            })
        })
    };
    let (plain, sheared) = (computed(false), computed(true));
    let Some(first) = here().next() else { return Ok(Default::default()) };
    let [ours, ours_sheared] = [
        ours(first, line, Theory::EulerBernoulli)?,
        if first.case.bat()?.knows_shear() { ours(first, line, Theory::Timoshenko)? } else { None },
    ];
    let published = [measured, plain, sheared].into_iter().flatten();
    let digits = published.map(decimals).max().unwrap_or(0).clamp(1, 2);
    let beside = |ours: &Option<Ours>, same: Option<f64>, other: Option<f64>| {
        let shown = |ours: &Ours| {
            let value = number(ours.value, digits);
            let than = measured.or(same).or(other);
            than.map_or(value.clone(), |than| {
                format!("{value} ({})", percent(ours.value / than - 1.0))
            })
        };
        let first = line.ratio && line.mode == 1;
        ours.as_ref().filter(|_| !first).map(shown).unwrap_or_default()
    };
    let known = |value: Option<f64>| {
        let shown = |value: f64| if line.ratio { number(value, 2) } else { value.to_string() };
        value.map(shown).unwrap_or_default()
    };
    let mode = match (line.ratio, line.mode) {
        (true, mode) if mode > 1 => format!("{mode} : 1"),
        (_, mode) => mode.to_string(),
    };
    let published_nodes = nodes(here().flat_map(|answer| &answer.case.checks), line.mode);
    let our_nodes = ours_sheared.as_ref().or(ours.as_ref()).filter(|_| !published_nodes.is_empty());
    Ok([
        line.row.unwrap_or_default().to_owned(),
        mode,
        known(measured),
        known(plain),
        known(sheared),
        beside(&ours, plain, sheared),
        beside(&ours_sheared, sheared, plain),
        places(&published_nodes),
        our_nodes.map(|ours| places(&ours.nodes)).unwrap_or_default(),
    ])
}

/// The published frequency or ratio of a line, where the case's kind and theory are `wanted`.
fn given(
    answer: &PublishedCase,
    line: &TableLine,
    wanted: impl Fn(Provenance, Theory) -> bool,
) -> Option<f64> {
    let kind = answer.case.published.as_ref()?.kind;
    let theory = answer.case.request().ok()?.theory;
    let quantity = if line.ratio { Known::FrequencyRatio } else { Known::FrequencyHz };
    let here = |check: &&Check| check.quantity == quantity && check.mode == Some(line.mode);
    let check = answer.case.checks.iter().find(here)?;
    wanted(kind, theory).then_some(check.expected)
}

/// The published nodes of a mode (m), by rising place.
fn nodes<'a>(checks: impl Iterator<Item = &'a Check>, mode: usize) -> Vec<f64> {
    let here = checks.filter(|check| check.quantity == Known::NodeM && check.mode == Some(mode));
    let mut nodes: Vec<f64> = here.map(|check| check.expected).collect();
    nodes.sort_by(f64::total_cmp);
    nodes.dedup();
    nodes
}

/// A mode of ours: frequency (Hz) or ratio to the first, and nodes (m).
struct Ours {
    value: f64,
    nodes: Vec<f64>,
}

/// The mode of that line by that theory, with the mesh of the case if it requests one.
fn ours(answer: &PublishedCase, line: &TableLine, theory: Theory) -> Result<Option<Ours>> {
    let request = Request { theory, modes: line.mode, ..answer.case.request()? };
    let modes = solve(&answer.case.bat()?, &request)?.modes;
    let (Some(first), Some(mode)) = (modes.first(), modes.last()) else { return Ok(None) };
    let unit = if line.ratio { first.frequency() } else { 1.0 };
    Ok(Some(Ours { value: mode.frequency() / unit, nodes: mode.nodes.clone() }))
}

/// Places (m) in both units; empty without places.
fn places(nodes: &[f64]) -> String {
    let listed = |unit: fn(f64) -> f64| {
        let shown: Vec<String> = nodes.iter().map(|node| number(unit(*node), 1)).collect();
        shown.join(", ")
    };
    match nodes {
        [] => String::new(),
        _ => format!("{} cm ({} in)", listed(|x| 100.0 * x), listed(inches)),
    }
}

/// How many decimals a number was published with.
pub fn decimals(value: f64) -> usize {
    value.to_string().split('.').nth(1).map_or(0, str::len)
}

/// The number with the given number of decimals.
pub fn number(value: f64, decimals: usize) -> String {
    if value.is_nan() { "none".to_owned() } else { format!("{value:.decimals$}") }
}

/// A share in per cent, to one decimal, with its sign.
pub fn percent(share: f64) -> String {
    format!("{} %", signed(100.0 * share, 1))
}

/// The number with its sign, but without a sign if it rounds to zero.
pub fn signed(value: f64, decimals: usize) -> String {
    let size = number(value.abs(), decimals);
    match size.parse() {
        Ok(0.0) => "0".to_owned(),
        _ if value < 0.0 => format!("−{size}"),
        _ => format!("+{size}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_with_their_signs_and_no_minus_zero() {
        assert_eq!(signed(-0.26, 1), "−0.3");
        assert_eq!(signed(-0.04, 1), "0");
        assert_eq!(percent(0.0581), "+5.8 %");
        assert_eq!(number(f64::NAN, 3), "none");
        assert_eq!([165.0, 11.58, 295.215].map(decimals), [0, 2, 3]);
        assert_eq!(places(&[0.254, 0.5]), "25.4, 50.0 cm (10.0, 19.7 in)");
        assert_eq!(places(&[]), "");
    }

    /// Northwestern's clamped wood bat on two of its four meshes, to the last printed digit.
    #[test]
    fn a_table_has_a_line_for_each_mesh_and_mode_and_only_columns_that_are_filled() {
        let names = ["northwestern_wood_09", "northwestern_wood_20"];
        let cases = CASES.iter().filter(|(name, _)| names.contains(name));
        let answers: Vec<PublishedCase> = cases
            .map(|&(name, text)| {
                let (case, rows) = run(name, text).unwrap();
                PublishedCase { name, case, rows }
            })
            .collect();
        assert_eq!(bats(&answers), ["Northwestern wood bat, their finite elements"]);
        let table = side_by_side(&answers.iter().collect::<Vec<_>>()).unwrap();
        let lines: Vec<&str> = table.lines().collect();
        let heading = "| which | mode | published, Euler-Bernoulli | ours, Euler-Bernoulli |";
        assert_eq!(lines[0], heading);
        assert_eq!(
            lines[2..],
            [
                "| 2/5/2 | 1 | 11.66 | 11.66 (0 %) |",
                "| 2/5/2 | 2 | 176.24 | 176.24 (0 %) |",
                "| 5/10/5 | 1 | 11.6 | 11.6 (0 %) |",
                "| 5/10/5 | 2 | 176.92 | 176.92 (0 %) |",
            ]
        );
    }
}
