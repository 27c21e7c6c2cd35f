//! A warm batch makes no allocation per bat. This is a separate test program, because it counts allocations.

mod common;

use common::cone;
use sweetspot::modes::batch::{Way, each};
use sweetspot::{Bat, Request};

#[test]
fn ten_times_the_bats_take_no_more_allocations() {
    let cone = |k: usize| cone(0.010 + 1e-5 * k as f64, 0.033 - 1e-6 * k as f64);
    let bats: Vec<Bat> = (0..320).map(cone).collect();
    let planned = Request { modes: 6, ..Request::plain() };
    let fixed = Request { elements: Some(40), ..planned };
    for (request, way) in [
        (planned, Way::OneByOne),
        (planned, Way::SideBySide),
        (fixed, Way::OneByOne),
        (fixed, Way::SideBySide),
    ] {
        let count = |bats: &[Bat]| {
            let job = || each(bats, &request, way, |_, found| assert!(found.is_ok()));
            allocation_counter::measure(job).count_total
        };
        // The first batch computes the quadrature rules, which are then kept.
        count(&bats[..32]);
        let (few, many) = (count(&bats[..32]), count(&bats));
        assert_eq!(few, many, "{way:?}");
    }
}
