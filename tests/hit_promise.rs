//! The stated errors of exit speeds are correct, compared with Taylor series that have no code in common with the
//! contact (`search/hits`).

use std::sync::LazyLock;

use sweetspot::base::telling::nobody;
use sweetspot_proof::hit_promise::{CheckedHit, ReferenceCourse, Summary, rows};

static ROWS: LazyLock<Vec<CheckedHit>> = LazyLock::new(|| rows(&nobody).unwrap());

#[test]
fn true_errors_of_exit_speeds_are_within_three_times_the_stated_ones() {
    let false_ones: Vec<&CheckedHit> = ROWS.iter().filter(|row| !row.holds()).collect();
    assert!(false_ones.is_empty(), "{false_ones:#?}");
    let all = Summary::of(ROWS.iter());
    assert!(all.hits >= 300 && all.visible >= 250, "{all:?}");
    assert!(all.holds(), "{all:?}");
}

#[test]
fn tolerances_are_met_or_missed_in_words() {
    // With shear, frequencies grow only in proportion to n, and a hit to 1e-7 needs more modes than are used.
    let usual = Summary::of(ROWS.iter().filter(|row| row.tolerance >= 1e-5));
    assert!(20 * usual.met >= 19 * usual.hits, "{usual:?}");
    for row in ROWS.iter().filter(|row| row.met) {
        assert!(row.truth <= 3.0 * row.tolerance + row.known_to, "{row:?}");
    }
}

/// The set includes later contacts and reloads, and the former change the exit speed.
#[test]
fn hits_of_all_kinds_are_looked_at() {
    for (course, name) in ReferenceCourse::ALL {
        let count = ROWS.iter().filter(|row| row.course == course).count();
        assert!(count >= 5, "{count} {name}");
    }
    assert!(ROWS.iter().any(|row| row.course == ReferenceCourse::Later && row.later > 0.01));
    let known = ROWS.iter().filter(|row| row.known_to < 1e-9).count();
    assert!(known >= 200, "{known}");
}
