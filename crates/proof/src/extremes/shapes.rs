//! Needles, points, steps and weak necks, against exact frequencies.

use crate::extremes::judge::{against, apart, difference};
use crate::extremes::{Outcome, Verdict};
use crate::promise::ALWAYS;
use crate::validation::Truth;
use sweetspot::base::Result;
use sweetspot::bat::{Bat, Interpolation, Material, Profile, Stations};
use sweetspot::modes::solve::{Request, Solution, solve};

fn request(modes: usize, tolerance: f64) -> Request {
    Request { modes, tolerance, ..Request::plain() }
}

/// The bat of a validation case, for a tolerance.
pub fn known(case: &str, modes: usize, asked: f64) -> Result<Outcome> {
    let truth = Truth::of_cases(&[case])?;
    Ok(against(asked, &solve(&truth.bat, &request(modes, asked))?, &truth.frequencies))
}

/// The case with the bat reversed: equal frequencies, mirrored nodes.
pub fn turned(case: &str, modes: usize, asked: f64) -> Result<Outcome> {
    let truth = Truth::of_cases(&[case])?;
    let bat = truth.bat.with(|parts| parts.profile = parts.profile.clone().reversed())?;
    let solution = solve(&bat, &request(modes, asked))?;
    let outcome = against(asked, &solution, &truth.frequencies);
    Ok(match mirrored(&solution, &truth) {
        true => outcome,
        false => Outcome { verdict: Verdict::Wrong("nodes are not mirrored".into()), ..outcome },
    })
}

/// Whether every known node has the same distance from the other end, within three times its stated error and a
/// picometre.
fn mirrored(solution: &Solution, truth: &Truth) -> bool {
    let length = truth.bat.length();
    solution.modes.iter().zip(&truth.nodes).all(|(mode, nodes)| {
        let mut pairs = mode.nodes.iter().rev().zip(nodes);
        let limit = ALWAYS * mode.error.nodes + 1e-12;
        mode.nodes.len() == nodes.len()
            && pairs.all(|(node, exact)| (length - node - exact).abs() <= limit)
    })
}

/// Ten cylinders, each 1.5 times as thick as the previous one: two plans of different degree agree within three times
/// both stated errors.
pub fn chain_of_steps() -> Result<Outcome> {
    let count = 10;
    let profile = Profile::new(Stations {
        x: (0..=count).map(|k| 0.084 * k as f64).collect(),
        outer: (0..=count).map(|k| 0.001 * 1.5f64.powi(k.min(count - 1))).collect(),
        inner: vec![0.0; count as usize + 1],
        interpolation: Interpolation::Constant,
    })?;
    let bat = Bat::builder(profile, Material::new(680.0, 15.5e9)?).build()?;
    let of_degree = |degree| solve(&bat, &Request { degree: Some(degree), ..request(10, 1e-11) });
    let (a, b) = (of_degree(5)?, of_degree(12)?);
    let stated = a.worst() + b.worst();
    let outcome = difference(ALWAYS * 2e-11, apart(&a, &b, 1.0), stated);
    let claims = a.met() && b.met() && outcome.found <= ALWAYS * stated;
    let wrong = Verdict::Wrong("apart by more than both state, or not met".into());
    Ok(if claims { outcome } else { Outcome { verdict: wrong, ..outcome } })
}
