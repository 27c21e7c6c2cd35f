//! The largest numbers of elements and stations that memory holds, and the smallest.

use std::time::{Duration, Instant};

use crate::extremes::judge::{against, difference, refusal};
use crate::extremes::sizes::{Size, dowel};
use crate::extremes::{Outcome, Verdict};
use crate::promise::{ALWAYS, largest};
use crate::validation::Truth;
use sweetspot::base::Result;
use sweetspot::bat::{Bat, Interpolation, Material, Profile, Stations};
use sweetspot::beam::{Ends, beta_l};
use sweetspot::modes::solve::{Request, Solver, solve};

/// Ten modes of the dowel on a fixed mesh of cubic elements, to 1e-12 of the exact frequencies
/// raised by `(βh)⁴/1440` for the mesh.
pub fn many_elements(count: usize) -> Result<Outcome> {
    let truth = Truth::of_dowel(10)?;
    let started = Instant::now();
    let request = Request { elements: Some(count), tolerance: 1e-12, ..Request::plain() };
    let solution = solve(&truth.bat, &request)?;
    let took = started.elapsed();
    let raised = |(k, f): (usize, &f64)| {
        f * (1.0 + (beta_l(Ends::FreeFree, k + 1) / count as f64).powi(4) / 1440.0)
    };
    let exact: Vec<f64> = truth.frequencies.iter().enumerate().map(raised).collect();
    let mut outcome = against(1e-12, &solution, &exact);
    if outcome.found > outcome.asked {
        outcome.verdict = Verdict::Wrong("more than asked".into());
    }
    outcome.note = note(took);
    Ok(outcome)
}

/// A cone through that many stations on its straight side is the cone.
pub fn many_stations(count: usize) -> Result<Outcome> {
    let cone = Truth::of_cases(&["cone_1_2p64_60"])?;
    let started = Instant::now();
    let bat = on_the_line(&cone.bat, count)?;
    let request = Request { tolerance: 1e-12, ..Request::plain() };
    let solution = solve(&bat, &request)?;
    let took = started.elapsed();
    Ok(Outcome { note: note(took), ..against(1e-12, &solution, &cone.frequencies) })
}

/// The bat of straight lines between two stations with `count` stations on its line.
fn on_the_line(bat: &Bat, count: usize) -> Result<Bat> {
    let [from, to] = [0.0, bat.length()].map(|x| bat.profile().at(x).outer);
    let share = |k: usize| k as f64 / (count - 1) as f64;
    let profile = Profile::new(Stations {
        x: (0..count).map(|k| bat.length() * share(k)).collect(),
        outer: (0..count).map(|k| from + (to - from) * share(k)).collect(),
        inner: vec![0.0; count],
        interpolation: Interpolation::Linear,
    })?;
    let Material { density, youngs_modulus, .. } = *bat.material();
    Bat::builder(profile, Material::new(density, youngs_modulus)?).build()
}

/// One element of every degree, with as many modes as it has: frequencies are above the exact ones (Rayleigh and Ritz),
/// by at most three times the stated error.
pub fn one_element() -> Result<Outcome> {
    let (mut errors, mut stated, mut outside) = (vec![], vec![], None);
    for degree in 3..=12 {
        let truth = Truth::of_dowel(degree - 1)?;
        let (modes, elements) = (degree - 1, Some(1));
        let request = Request { modes, elements, degree: Some(degree), ..Request::plain() };
        for (mode, exact) in solve(&truth.bat, &request)?.modes.iter().zip(&truth.frequencies) {
            let (error, total) = (mode.frequency() / exact - 1.0, mode.error.total());
            errors.push(error);
            stated.push(total);
            if error < -ALWAYS * mode.error.round_off || error > ALWAYS * total {
                let order = mode.order;
                outside.get_or_insert(format!("degree {degree} mode {order}: {error:.1e}"));
            }
        }
    }
    let (found, stated) = (largest(errors.into_iter()), largest(stated.into_iter()));
    let outcome = difference(f64::INFINITY, found, stated);
    Ok(outside
        .map(Verdict::Wrong)
        .map_or(outcome.clone(), |verdict| Outcome { verdict, ..outcome }))
}

/// Two cubic elements bend in four ways.
pub fn too_few_elements() -> Result<Outcome> {
    let request = Request { elements: Some(2), ..Request::plain() };
    Ok(refusal(request.tolerance, solve(&dowel(Size::default())?, &request)))
}

/// The dense solver would need 320 GB.
pub fn too_large_for_dense() -> Result<Outcome> {
    let (elements, solver) = (Some(100_000), Solver::Dense);
    let request = Request { elements, solver, ..Request::plain() };
    Ok(refusal(request.tolerance, solve(&dowel(Size::default())?, &request)))
}

/// Time, and the peak memory of the program, where the system gives it.
fn note(took: Duration) -> String {
    let seconds = took.as_secs_f64();
    let memory =
        peak_memory().map_or(String::new(), |kib| format!(", peak {:.0} MB", kib / 1024.0));
    format!("{seconds:.2} s{memory}")
}

/// The most memory that the program has had (KiB), from Linux' process table.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}
