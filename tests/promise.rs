//! The stated errors of a solution are correct wherever the exact answer is known.

use std::sync::LazyLock;

use sweetspot::base::telling::nobody;
use sweetspot_proof::promise::{BATS, CheckedBat, DIGITS, Summary, rows};

static ROWS: LazyLock<Vec<CheckedBat>> = LazyLock::new(|| rows(&nobody).unwrap());

#[test]
fn true_errors_are_within_three_times_the_stated_ones() {
    assert_eq!(ROWS.len(), BATS.len() * DIGITS.count());
    for row in ROWS.iter() {
        assert!(row.holds(), "{row:?}");
        // Only round-off may prevent a tolerance from being met, and then by a small factor.
        assert!(row.met || row.tolerance < 1e-10, "{row:?}");
        assert!(row.truth < 3.0 * row.tolerance, "{row:?}");
    }
    let all = Summary::of(&ROWS);
    assert!(all.holds(), "{all:?}");
    assert!(all.visible > 5000, "{all:?}");
    // The stated error is an estimate, not a bound far above the true error.
    assert!(all.share_close() > 0.95, "{all:?}");
}

#[test]
fn nodes_and_modal_masses_are_looked_at() {
    let known = |ratio: fn(&CheckedBat) -> f64| {
        BATS.iter().filter(|(bat, _)| ROWS.iter().any(|r| r.bat == *bat && ratio(r) > 0.0)).count()
    };
    assert!(known(|row| row.node_ratio) >= 15);
    assert!(known(|row| row.mass_ratio) >= 4);
}
