//! Are bats beyond any real one solved correctly, or refused with the reason?
//!
//! [`EXTREMES`] are the rows, each of which can run separately.
//!
//! Every row requests something beyond any real bat or mesh. It is right if every true error is within three times the
//! stated one and the wanted accuracy is met, refused if the answer or an error gives the reason, wrong otherwise.

mod judge;
mod shapes;
mod sizes;
mod meshes;
mod sameness;

use sweetspot::base::Result;

/// How a row ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Right, within three times the stated error.
    Right,
    /// Refused, with the reason given to the user.
    Refused(String),
    /// Wrong, with the mistake.
    Wrong(String),
}

/// Request and result of a row; errors are relative, except where the row states otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The wanted accuracy; 0 requests identical bits.
    pub asked: f64,
    /// The largest true error or difference.
    pub found: f64,
    /// The worst error that the answers state.
    pub stated: f64,
    /// Verdict on the row.
    pub verdict: Verdict,
    /// Time and memory, where they are the point.
    pub note: String,
}

/// One row of the suite.
#[derive(Debug, Clone, Copy)]
pub struct Extreme {
    /// The request, as the table names it.
    pub what: &'static str,
    /// Whether it takes seconds rather than milliseconds.
    pub slow: bool,
    run: fn() -> Result<Outcome>,
}

impl Extreme {
    /// Runs the row; an unexpected error counts as wrong.
    pub fn run(&self) -> Outcome {
        (self.run)().unwrap_or_else(|error| Outcome {
            asked: f64::NAN,
            found: f64::NAN,
            stated: f64::NAN,
            verdict: Verdict::Wrong(error.to_string()),
            note: String::new(),
        })
    }
}

const fn row(what: &'static str, run: fn() -> Result<Outcome>) -> Extreme {
    Extreme { what, slow: false, run }
}

/// The suite. The large meshes come first, because the peak of memory is the whole program's.
pub const EXTREMES: &[Extreme] = &[
    row("dowel, 10^5 cubic elements, 10 modes", || meshes::many_elements(100_000)),
    Extreme {
        what: "dowel, 10^6 cubic elements, 10 modes",
        slow: true,
        run: || meshes::many_elements(1_000_000),
    },
    row("cone of 10^5 collinear stations", || meshes::many_stations(100_000)),
    row("one element of degree 3 to 12", meshes::one_element),
    row("dowel, 60 modes, every node counted", || sizes::modes(60, 1e-10)),
    row("dowel, 200 modes, every node counted", || sizes::modes(200, 1e-8)),
    row("slenderness L/r = 4", || sizes::slenderness(4.0)),
    row("slenderness L/r = 10", || sizes::slenderness(10.0)),
    row("slenderness L/r = 100", || sizes::slenderness(1e2)),
    row("slenderness L/r = 10^4", || sizes::slenderness(1e4)),
    row("slenderness L/r = 10^6", || sizes::slenderness(1e6)),
    row("E = 1 Pa", || sizes::modulus(1.0)),
    row("E = 10^15 Pa", || sizes::modulus(1e15)),
    row("length 1 um", || sizes::length(1e-6)),
    row("length 1 km", || sizes::length(1e3)),
    row("E of 1 to 10^15 Pa, by decades", sizes::moduli_by_decades),
    row("length of 1 um to 1 km, by decades", sizes::lengths_by_decades),
    row("E, density, length by powers of two", sizes::powers_of_two),
    row("the same, mesh planned anew", sizes::powers_of_two_planned),
    row("cone 1:10^4", || shapes::known("cone_1_10000", 20, 1e-10)),
    row("cone to a point at the knob", || shapes::known("cone_complete", 20, 1e-10)),
    row("cone to a point at the tip", || shapes::turned("cone_complete", 20, 1e-10)),
    row("step 1:3, 20 modes", || shapes::known("step_1_3_60", 20, 1e-11)),
    row("steps 3:1, 1:1.5, 1:2.4, 20 modes", || shapes::known("steps_many", 20, 1e-11)),
    row("chain of nine steps 1:1.5, two degrees", shapes::chain_of_steps),
    row("handle of 1 mm, barrel of 100 mm", || shapes::known("handle_1mm", 10, 1e-11)),
    row("dumbbell, pairs within 5e-5", || shapes::known("dumbbell", 20, 1e-9)),
    row("dumbbell, to 10^-12", || shapes::known("dumbbell", 20, 1e-12)),
    row("bat turned end for end, mirrored nodes", || shapes::turned("linear_bat", 20, 1e-11)),
    row("cone turned end for end, same mesh", sameness::turned_on_one_mesh),
    row("cylinders split in two", sameness::split_cylinders),
    row("collinear stations added", sameness::collinear_stations),
    row("solved again, same bits", sameness::repeated),
    row("1, 2, 8 threads at once, same bits", sameness::threads),
    row("accuracy 10^-16", || sizes::modes(10, 1e-16)),
    row("10 modes of two cubic elements", meshes::too_few_elements),
    row("dense solver, 10^5 elements", meshes::too_large_for_dense),
    row("E = 10^300 Pa", || sizes::out_of_range(1e300)),
];
