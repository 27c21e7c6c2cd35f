//! Every known answer of the `validation` folder is reproduced within its tolerance, and `docs/validation.md` agrees
//! with the results.

use std::fs;
use std::path::Path;

use sweetspot::base::telling::nobody;
use sweetspot_proof::published::PublishedCase;
use sweetspot_report::hit_figure;
use sweetspot_report::proof_page;

#[test]
fn every_known_answer_is_reproduced_and_the_page_says_so() {
    let answers = PublishedCase::all(&nobody).unwrap();
    let mut rows = 0;
    for PublishedCase { name, rows: table, .. } in &answers {
        assert!(!table.is_empty(), "{name} checks nothing");
        for row in table {
            let (expected, found) = (row.expected, row.found);
            assert!(!row.missed(), "{name}: {} expected {expected}, found {found}", row.quantity);
            // Values for information only must at least exist.
            assert!(found.is_finite(), "{name}: {}", row.quantity);
        }
        rows += table.iter().filter(|row| !row.information).count();
    }
    assert!(rows > 500, "{rows}");

    let path = Path::new(env!("SWEETSPOT_TOP")).join("docs/validation.md");
    let committed = fs::read_to_string(path).unwrap().replace("\r\n", "\n");
    let stale = first_difference(&committed, &proof_page::text(&answers).unwrap());
    let again = "run: sweetspot validate --page docs/validation.md";
    assert_eq!(stale, None, "docs/validation.md is stale; {again}");
}

/// The committed picture equals the present one, except for a pixel where a number is close to a rounding boundary.
#[test]
fn the_picture_of_the_page_is_todays() {
    let path = Path::new(env!("SWEETSPOT_TOP")).join("docs").join(hit_figure::FILE);
    let committed = fs::read_to_string(path).unwrap();
    let now = hit_figure::svg().unwrap();
    let words = |text: &str| -> Vec<String> {
        text.split([' ', ',', '"', '(', ')', 'M', 'L', '\n', '\r']).map(str::to_owned).collect()
    };
    let (committed, now) = (words(&committed), words(&now));
    assert_eq!(committed.len(), now.len(), "docs/r161_hit.svg is stale");
    for (old, new) in committed.iter().zip(&now) {
        let near = match (old.parse::<f64>(), new.parse::<f64>()) {
            (Ok(old), Ok(new)) => (old - new).abs() < 0.15,
            _ => old == new,
        };
        assert!(near, "docs/r161_hit.svg is stale: {old} {new}");
    }
}

/// The first line that differs. The values on the page for published bats are rounded far above round-off and must be
/// equal; the errors of the exact answers are round-off themselves, and may differ by that share of their tolerance.
fn first_difference(committed: &str, now: &str) -> Option<(String, String)> {
    const ROUND_OFF: f64 = 0.05;
    let mut exact = false;
    let same = |a: &str, b: &str, exact: bool| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) if exact => (a - b).abs() <= ROUND_OFF,
        _ => a == b,
    };
    for k in 0..committed.lines().count().max(now.lines().count()) {
        let line = |page: &'_ str| page.lines().nth(k).unwrap_or("(no line)").to_owned();
        let (old, new) = (line(committed), line(now));
        exact |= old.starts_with("## Exact answers");
        // The one figure of the exact answers above their table.
        let shares = exact || old.starts_with("- Exact answers:");
        let (before, after): (Vec<&str>, Vec<&str>) =
            (old.split_whitespace().collect(), new.split_whitespace().collect());
        let words = before.iter().zip(&after).all(|(a, b)| same(a, b, shares));
        if before.len() != after.len() || !words {
            return Some((old, new));
        }
    }
    None
}

#[test]
fn a_stale_page_is_found() {
    let page = "| f1 | 174.5 |\n## Exact answers\n| dowel | 0.06 |\n";
    assert_eq!(first_difference(page, page), None);
    assert_eq!(first_difference(page, &page.replace("0.06", "0.08")), None);
    for (from, to) in [("174.5", "174.6"), ("0.06", "0.66"), ("dowel", "cone"), ("| f1", "f1")] {
        assert!(first_difference(page, &page.replace(from, to)).is_some(), "{from} {to}");
    }
    assert!(first_difference(page, "| f1 | 174.5 |\n").is_some());
    assert!(first_difference(page, &format!("{page}more\n")).is_some());
}
