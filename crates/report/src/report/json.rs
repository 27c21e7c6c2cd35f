//! The JSON file of modes, in SI, with the unit in the name of every key.
//!
//! Numbers are written in the shortest form that reads back to the same bits; NaN and infinity never occur. A value
//! that does not exist is null.

use crate::report::damped;
use crate::report::resolved::resolved;
use crate::schema::modes as file;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::bat::weighed::Weighed;
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot::{Bat, Solution};
use sweetspot_study::ignored::ignored;
use sweetspot_study::trade::reference::solver_name;

/// Which samples of the shapes to write.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapePoints {
    /// At every node of the mesh.
    Nodes,
    /// At that many even points from end to end.
    Even(usize),
}

/// The `sweetspot-modes/1` document; `timing` only if wanted.
pub fn modes(bat: &Bat, solution: &Solution, points: ShapePoints, timing: bool) -> file::ModesFile {
    let places = places(bat, solution, points);
    file::ModesFile {
        format: Format::new(),
        generator: Generator::this(),
        bat: resolved(bat),
        summary: summary(bat),
        model: file::Model {
            theory: solution.theory.name().to_owned(),
            elements: solution.mesh.len(),
            degree: solution.degree,
            solver: solver_name(solution.solver).to_owned(),
            degrees_of_freedom: solution.degrees_of_freedom(),
            lanczos_steps: solution.steps,
            plan: solution.reason.to_string(),
            tolerance_met: solution.met(),
            no_mode_missing: solution.complete,
            ignored: ignored(bat, solution),
            damping: damped::of_model(solution),
        },
        rigid_modes: solution.rigid_modes,
        modes: (0..solution.modes.len()).map(|k| mode(solution, k, &places)).collect(),
        proof: None,
        timing: timing.then_some(file::Timing {
            plan_s: solution.timing.plan.as_secs_f64(),
            assemble_s: solution.timing.assemble.as_secs_f64(),
            solve_s: solution.timing.solve.as_secs_f64(),
        }),
    }
}

fn mode(solution: &Solution, k: usize, places: &[f64]) -> file::Mode {
    let mode = &solution.modes[k];
    let along = |f: &dyn Fn(f64) -> f64| places.iter().map(|x| f(*x)).collect::<Vec<f64>>();
    // NaN and infinity represent an unknown error.
    let known = |error: f64| Some(error).filter(|error| error.is_finite());
    file::Mode {
        order: mode.order,
        frequency_hz: mode.frequency(),
        omega_rad_s: mode.omega,
        damping_ratio: solution.damping.modes.get(k).map_or(0.0, |damped| damped.ratio),
        modal_mass_kg: mode.modal_mass,
        nodes_m: mode.nodes.clone(),
        nodes_untold_m: (!mode.untold.is_empty()).then(|| mode.untold.clone()),
        proven: None,
        proven_nodes_m: None,
        proven_within: None,
        error: file::ModeError {
            discretization: known(mode.error.discretization),
            round_off: known(mode.error.round_off),
            residual: known(mode.error.residual),
            nodes_m: known(mode.error.nodes),
            modal_mass: known(mode.error.modal_mass),
            shape: known(mode.error.shape),
        },
        shape: file::Shape {
            x_m: places.to_vec(),
            deflection: along(&|x| mode.shape.deflection(x)),
            rotation: along(&|x| mode.shape.rotation(x)),
        },
        damping: damped::of_mode(solution, k),
    }
}

fn places(bat: &Bat, solution: &Solution, points: ShapePoints) -> Vec<f64> {
    match points {
        ShapePoints::Nodes => solution.mesh.nodes(),
        ShapePoints::Even(1) => vec![0.0],
        ShapePoints::Even(n) => (0..n).map(|k| bat.length() * k as f64 / (n - 1) as f64).collect(),
    }
}

fn summary(bat: &Bat) -> file::Summary {
    let inertia = bat.inertia();
    let measured = bat.weighed().balance_point;
    let swing_weight = bat.measured_swing_weight();
    // The measurement describes the bat before its edits.
    let weighed = bat.unedited().inertia();
    let weighed = (bat.weighed() != Weighed::default()).then(|| file::WeighedFactors {
        density_factor: bat.factors()[0],
        modulus_factor: bat.factors()[1],
        balance_point_m: measured,
        balance_point_difference_m: measured.map(|x| weighed.balance_point - x),
        inertia_pivot_kg_m2: swing_weight,
        inertia_pivot_difference_kg_m2: swing_weight
            .map(|measured| weighed.about(STANDARD_PIVOT) - measured),
    });
    file::Summary {
        length_m: bat.length(),
        mass_kg: inertia.mass,
        balance_point_m: inertia.balance_point,
        inertia_balance_kg_m2: inertia.about_balance,
        pivot_m: STANDARD_PIVOT,
        inertia_pivot_kg_m2: inertia.about(STANDARD_PIVOT),
        center_of_percussion_m: inertia.center_of_percussion(STANDARD_PIVOT),
        weighed,
    }
}
