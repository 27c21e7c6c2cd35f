//! Even for inputs far outside the range of bats, every answer is correct within its stated error or is refused with
//! the reason.

use std::collections::HashSet;

use sweetspot_proof::extremes::{EXTREMES, Verdict};

/// All but the slow rows, which `sweetspot validate --extremes` runs.
#[test]
fn every_extreme_is_right_or_refused() {
    let (mut right, mut refused) = (0, vec![]);
    for extreme in EXTREMES.iter().filter(|extreme| !extreme.slow) {
        let outcome = extreme.run();
        match &outcome.verdict {
            Verdict::Right => right += 1,
            Verdict::Refused(reason) => {
                assert!(!reason.is_empty(), "{}", extreme.what);
                refused.push(extreme.what);
            }
            Verdict::Wrong(_) => panic!("{}: {outcome:?}", extreme.what),
        }
    }
    assert!(right >= 30, "{right}");
    // Exactly the cases that are impossible.
    let impossible = [
        "accuracy 10^-16",
        "10 modes of two cubic elements",
        "dense solver, 10^5 elements",
        "E = 10^300 Pa",
    ];
    assert_eq!(refused, impossible);
}

#[test]
fn every_row_has_a_name_of_its_own_that_fits_the_table() {
    let names: HashSet<&str> = EXTREMES.iter().map(|extreme| extreme.what).collect();
    assert_eq!(names.len(), EXTREMES.len());
    assert!(names.iter().all(|name| name.len() < 40), "{names:?}");
}
