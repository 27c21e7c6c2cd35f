//! Every known answer of the `validation` folder is reproduced within its tolerance.

use sweetspot::validation::{CASES, run};

#[test]
fn every_known_answer_is_reproduced() {
    let mut rows = 0;
    for (name, text) in CASES {
        let (_, table) = run(name, text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(!table.is_empty(), "{name} checks nothing");
        for row in &table {
            let (expected, found) = (row.expected, row.found);
            assert!(row.passes(), "{name}: {} expected {expected}, found {found}", row.quantity);
        }
        rows += table.len();
    }
    assert!(rows > 500, "{rows}");
}
