//! Stated errors beside proven frequencies as a table.

use sweetspot::bat::theory::Theory;
use sweetspot_proof::proven_promise::ProvenBat;
use sweetspot_report::report::columns::{Columns, first, numbers};

const TITLE: &str = "\
Stated errors of frequencies held against proven intervals, on random bats:

";

/// A line for every kind of bat and every theory, and one for all.
pub fn summary(rows: &[ProvenBat]) -> String {
    let mut out = TITLE.to_owned() + &columns().heads();
    for kind in ["smooth", "straight", "hollow", "with a weight"] {
        out += &line(kind, rows.iter().filter(|row| row.kind == kind));
    }
    for theory in Theory::ALL {
        out += &line(theory.name(), rows.iter().filter(|row| row.theory == theory));
    }
    out + &line("all", rows.iter())
}

/// Whether no stated error is proven wrong.
pub fn holds(rows: &[ProvenBat]) -> bool {
    rows.iter().all(|row| row.broken == 0)
}

fn columns() -> Columns {
    Columns::new([
        first(16, "bats"),
        numbers(5, "n"),
        numbers(14, "proven modes"),
        numbers(8, "held"),
        numbers(6, "open"),
        numbers(8, "broken"),
        numbers(13, "true/stated"),
    ])
}

fn line<'a>(name: &str, rows: impl Iterator<Item = &'a ProvenBat> + Clone) -> String {
    let sum = |of: fn(&ProvenBat) -> usize| rows.clone().map(of).sum::<usize>();
    let [proven, held, broken] =
        [sum(|row| row.proven), sum(|row| row.held), sum(|row| row.broken)];
    let worst = rows.clone().map(|row| row.at_least).fold(0.0, f64::max);
    columns().row([
        name.to_owned(),
        rows.count().to_string(),
        proven.to_string(),
        held.to_string(),
        (proven - held - broken).to_string(),
        broken.to_string(),
        format!("{worst:.2}"),
    ])
}
