//! The memory stated in a refusal is the memory that a solve takes. This is a separate test program, because it counts
//! allocations.

mod common;

use common::cone;
use sweetspot::base::threads::with;
use sweetspot::bat::theory::Theory;
use sweetspot::{Bat, Error, Request, Solver, solve};

fn bat() -> Bat {
    cone(0.0125, 0.033).with(|parts| parts.material.shear_modulus = Some(1e9)).unwrap()
}

/// The memory (GB) of one bat, from the refusal of ten thousand in parallel.
fn stated(asked: &Request) -> f64 {
    const MANY: usize = 10_000;
    let Err(Error::Value(refused)) = asked.check(MANY) else { panic!("{asked:?} is not refused") };
    let gigabytes = refused.found.rsplit(", ").next().and_then(|last| last.strip_suffix(" GB"));
    gigabytes.and_then(|number| number.parse::<f64>().ok()).unwrap() / MANY as f64
}

#[test]
fn a_mesh_is_refused_for_the_memory_that_it_would_take() {
    let bat = bat();
    for (elements, modes, degree, theory) in [
        (3000, 10, 3, Theory::EulerBernoulli),
        (3000, 10, 3, Theory::Timoshenko),
        (3000, 10, 3, Theory::Rayleigh),
        (1000, 10, 12, Theory::EulerBernoulli),
        (1000, 10, 12, Theory::Timoshenko),
        (12_000, 10, 3, Theory::EulerBernoulli),
        (12_000, 20, 3, Theory::Timoshenko),
        (1000, 100, 3, Theory::EulerBernoulli),
        (500, 100, 8, Theory::Timoshenko),
    ] {
        let (elements, degree) = (Some(elements), Some(degree));
        let asked = Request { modes, elements, degree, theory, ..Request::default() };
        let stated = stated(&asked);
        let solved = || assert!(solve(&bat, &asked).is_ok());
        // Only one thread is counted.
        let taken = with(Some(1), || allocation_counter::measure(solved));
        let taken = 1e-9 * taken.bytes_max as f64;
        let of = format!("{taken:.4} GB of {stated:.4} for {asked:?}");
        assert!(taken < 1.15 * stated && stated < 1.6 * taken, "{of}");
    }
}

/// Solvers that factor take memory according to the sparsity, which is bounded and not counted.
#[test]
fn solvers_that_factor_take_no_more_than_is_said() {
    let bat = bat();
    for (elements, solver) in [(3000, Solver::ShiftInvert), (300, Solver::Dense)] {
        let asked = Request { elements: Some(elements), solver, ..Request::plain() };
        let taken = allocation_counter::measure(|| assert!(solve(&bat, &asked).is_ok()));
        let stated = stated(&asked);
        let taken = 1e-9 * taken.bytes_max as f64;
        assert!(taken < 1.05 * stated, "{taken:.4} GB of {stated:.4} by {solver:?}");
    }
}
