//! How large is the round-off of a frequency? The basis of `modes::certificate::round_off`.
//!
//!     cargo run --release --example tuning_round_off
//!
//! Differences from a solution on the few elements of its plan, where sums are short, in units of ε, on more and more
//! elements; and the value of the formula.

use sweetspot::modes::certificate::round_off;
use sweetspot::{Bat, Request, Result, solve};

const MODES: usize = 12;

fn main() -> Result<()> {
    println!("bat        elements  mode 1  stated   mode {MODES}  stated (in ε)");
    for name in ["dowel", "cone", "house", "r161"] {
        let bat = Bat::from_file(format!("meshes/{name}.json"))?;
        let request = Request { modes: MODES, tolerance: 1e-14, ..Request::plain() };
        let reference = solve(&bat, &request)?;
        for elements in [30, 100, 300, 1000, 3000, 10_000, 30_000] {
            let request = Request { elements: Some(elements), degree: Some(10), ..request };
            let found = solve(&bat, &request)?;
            let columns = [0, MODES - 1].map(|k| {
                let exact = reference.modes[k].omega;
                let error = (found.modes[k].omega / exact - 1.0).abs();
                let stated =
                    round_off(found.modes[k].omega / found.modes[0].omega, elements, false);
                format!("{:7.1} {:7.1}", error / f64::EPSILON, stated / f64::EPSILON)
            });
            println!("{name:10} {elements:8} {}   {}", columns[0], columns[1]);
        }
    }
    Ok(())
}
