//! How are the differences between bats of one model and swings of one batter written?
//!
//! In the `sweetspot-scatter/1` file. A covariance in it is the result of a calibration, `sweetspot-calibrate/1`.

use std::collections::BTreeMap;
use std::ops::Bound::{Excluded, Included};

use crate::answers::Answer;
use crate::engine::{
    Ball, Bat, Complaint, Node, Quantity, Result, Scatter, Setup, balls, scene_file,
};
use crate::files::amounts::{Said, share};
use crate::files::asked;
use crate::files::form::{amount, at, later, text};
use crate::files::written::{Members, object, written};
use crate::scatter::rows::{AT_IMPACT, Output, ScatterPlan};
use crate::scatter::spreads::{Difference, Differences, Differs};
use crate::scatter::turning::Turning;

/// Default outputs.
const USUAL: [&str; 6] = [
    "f1_hz",
    "mass_kg",
    "inertia_pivot_kg_m2",
    "exit_speed_max.value",
    "exit_speed_max.x_m",
    "node_mode_1_m",
];
/// Default accuracy.
const TOLERANCE: f64 = 1e-4;
/// Default number of rows.
const POINTS: u64 = 1024;
/// Default width of a lathe's error along a bat (m): 12 in.
const ALONG: f64 = 0.3048;

/// The default differences: the wood, from piece to piece of one species, stiffness and density independent
/// ([`sweetspot::bat::material::Material::scatter`]), with the usual outputs. `None` for a bat that is not of wood.
pub fn of_wood(bat: &Bat) -> Option<ScatterPlan> {
    let Scatter { youngs_modulus, density } = bat.material().scatter()?;
    let one = |what, deviation| Difference { what, deviation };
    let (density, modulus) =
        (one(Differs::Density, density), one(Differs::YoungsModulus, youngs_modulus));
    Some(ScatterPlan {
        differences: Differences { all: vec![density, modulus], correlations: vec![] },
        setup: Setup::default(),
        impact: None,
        outputs: usual().ok()?,
        tolerance: TOLERANCE,
        points: POINTS,
        seed: 1,
    })
}

written! {
    /// The differences between bats of one model and swings of one batter, for sweetspot scatter: standard deviations,
    /// in the order in which correlated ones are reported. At least one of them.
    ScatterForm("scatter", "Scatter file") {
        /// Name of the scatter.
        name = text();
        /// The ball: a ball file, from the folder of this one, or the name of a built-in ball. By default a baseball.
        ball = text();
        /// The mean hit: the options of sweetspot hit, such as swing_speed, by their names.
        scene = later::<BTreeMap<String, Said>>();
        /// The outputs for every bat, by name; exit_speed_m_s@impact is the speed at the impact point.
        outputs = later::<Vec<String>>().saying("minItems", 1).like(["f1_hz", AT_IMPACT].to_vec());
        /// Wanted accuracy of frequencies, relative, and of exit speeds, relative to the closing speed. Default 1e-4.
        tol = share();
        /// Triples of two differences and the correlation of their normal numbers; the later one is reported with the
        /// earlier one known.
        correlation = later::<Vec<(String, String, f64)>>();
        /// Density and moduli as a calibration left them, in place of these three: the file with its result, looked up
        /// from the folder of this file.
        covariance = text();
        /// Density of the wood.
        density = object::<LognormalForm>().map(differing(Differs::Density));
        /// Young's modulus of the wood, and G with it.
        youngs_modulus = object::<LognormalForm>().map(differing(Differs::YoungsModulus));
        /// G/E of the wood.
        shear_over_young = object::<LognormalForm>().map(differing(Differs::ShearOverYoung));
        /// The lathe's error of the diameter: a smooth curve.
        turning = object::<TurningForm>();
        /// Moisture, as a share of the mass; E and G fall by 1.3 % for each per cent.
        moisture = object::<NormalForm>().map(differing(Differs::Moisture));
        /// Speed of the swing, relative.
        swing_speed = object::<NormalForm>().map(differing(Differs::SwingSpeed));
        /// Speed of the pitch, relative.
        pitch = object::<NormalForm>().map(differing(Differs::Pitch));
        /// Coefficient of restitution of the ball, as an amount.
        cor = object::<CorForm>().map(differing(Differs::Cor));
        /// The impact point.
        impact = object::<ImpactForm>();
    }
    |of| -> ScatterPlan {
        let setup = setup(of, ball);
        let (impact, middle) = impact.unzip();
        let wood = [density, youngs_modulus, shear_over_young, turning, moisture];
        let found = [&wood[..], &[swing_speed, pitch, cor, impact]].concat();
        // In the order of the file.
        let named = |key: &String| found.iter().flatten().find(|one| one.what.name() == key);
        let all = of.object.keys().iter().filter_map(|(key, _)| named(key).copied()).collect();
        let mut differences = Differences { all, correlations: vec![] };
        if let Some(name) = covariance {
            let calibrated = calibrated(of, &name, &mut differences);
            of.mistakes.note(calibrated);
        }
        if let Some(node) = of.at("correlation") {
            let read = correlations(node, &differences);
            differences.correlations.extend(of.mistakes.note(read));
        }
        let outputs = asked(of.at("outputs"), &differences);
        let outputs = of.mistakes.note(outputs);
        of.sound()?;
        let node = of.node();
        if differences.all.is_empty() {
            let expected = "one at least, such as \"density\": { \"lognormal\": \"4 %\" }";
            return Err(node.error("nothing that differs", expected));
        }
        // Impossible correlations are reported here, where their place is known.
        let node = of.at("correlation").or(of.at("covariance")).unwrap_or(node);
        differences.designs(1.0, 64, 0).map_err(|error| at(node, error))?;
        let (impact, tolerance) = (middle.flatten(), tol.unwrap_or(TOLERANCE));
        let (points, seed) = (POINTS, 1);
        Ok(ScatterPlan { differences, setup, impact, outputs, tolerance, points, seed })
    }
}

written! {
    /// A factor whose logarithm is normal.
    LognormalForm {
        /// Standard deviation of the natural logarithm.
        lognormal = share(), needed "\"lognormal\": a standard deviation, such as \"4 %\"";
    }
    |_| -> f64 { Ok(lognormal) }
}

written! {
    /// A normal number.
    NormalForm {
        /// Standard deviation.
        normal = share(), needed "\"normal\": a standard deviation, such as \"4 %\"";
    }
    |_| -> f64 { Ok(normal) }
}

written! {
    /// How the ball differs.
    CorForm {
        /// Standard deviation.
        normal = share()
            .within((Excluded(0.0), Included(0.1)), "a standard deviation above 0 and up to 0.1"),
            needed "\"normal\": a standard deviation, such as 0.016";
    }
    |_| -> f64 { Ok(normal) }
}

written! {
    /// The lathe's error.
    TurningForm {
        /// Standard deviation of the diameter.
        normal = amount(Quantity::Length).like("0.1 mm")
            .within((Excluded(0.0), Included(2e-3)), "a length above 0 and up to 2 mm"),
            needed "\"normal\": a standard deviation, such as \"0.1 mm\"";
        /// How far along the bat an error reaches. Without it 12 in.
        along = amount(Quantity::Length).like("12 in")
            .within(0.02..=2.0, "a length from 0.02 to 2 m");
    }
    |_| -> Difference {
        let turning = Turning { deviation: normal, along: along.unwrap_or(ALONG) };
        Ok(Difference { what: Differs::Turned(turning), deviation: normal })
    }
}

written! {
    /// The impact point.
    ImpactForm {
        /// Standard deviation of the place.
        normal = amount(Quantity::Length).like("0.5 in")
            .within((Excluded(0.0), Included(0.2)), "a length above 0 and up to 0.2 m"),
            needed "\"normal\": a standard deviation, such as \"0.5 in\"";
        /// The place in the middle, from the knob end. By default the place where the ball leaves fastest.
        at = amount(Quantity::Length).like("27.7 in");
    }
    |_| -> (Difference, Option<f64>) {
        Ok((Difference { what: Differs::Impact, deviation: normal }, at))
    }
}

/// A difference with that standard deviation.
fn differing(what: Differs) -> impl Fn(f64) -> Difference {
    move |deviation| Difference { what, deviation }
}

/// How the bat is hit in the middle, with the ball of that name.
fn setup(of: &mut Members, ball: Option<String>) -> Setup {
    let node = of.at("ball").zip(ball);
    let ball =
        node.map(|(node, name)| balls::ball_in(&name, of.folder).map_err(|error| at(node, error)));
    let ball = of.mistakes.some(ball.transpose()).flatten().unwrap_or_else(Ball::baseball);
    let setup = of.at("scene").map(|node| scene_file::read(node, ball.clone()));
    of.mistakes.note(setup.unwrap_or(Ok(Setup { ball, ..Setup::default() })))
}

/// Triples of two that differ and their correlation.
fn correlations(node: &Node, differences: &Differences) -> Result<Vec<(usize, usize, f64)>> {
    let all = &differences.all;
    let names: Vec<&str> = all.iter().map(|one| one.what.name()).collect();
    let expected = [
        "two names and their correlation, such as [\"density\", \"youngs_modulus\", 0.6]",
        "another one than the first",
    ];
    asked::correlations(node, expected, |node| {
        let name = node.string()?;
        let is_meant =
            |one: &Difference| one.what.name() == name && !matches!(one.what, Differs::Turned(_));
        all.iter().position(is_meant).ok_or_else(|| {
            let expected =
                format!("something that differs in one number, one of {}", names.join(", "));
            let complaint = Complaint::new("", node.shown(), expected);
            node.complain(complaint.or_nearest(&name, &names))
        })
    })
}

/// Density and moduli as a calibration left them: its values take precedence over the file's.
fn calibrated(of: &Members, name: &str, differences: &mut Differences) -> Result<()> {
    for key in ["density", "youngs_modulus", "shear_over_young"] {
        if let Some(other) = of.at(key) {
            let found = format!("\"{key}\" beside \"covariance\"");
            return Err(other.key().error(found, "one of them: the calibration says it"));
        }
    }
    let node = of.at("covariance").unwrap_or(of.node());
    let document = of.folder.json(name, "calibrate").map_err(|error| at(node, error))?;
    let file = Node::root(&document)?.members()?;
    file.check_format("sweetspot-calibrate/1")?;
    let listed = file.require("parameters", "\"parameters\" of a calibration")?.items()?;
    let rows = file.require("covariance", "\"covariance\" of a calibration")?;
    let wrong = || rows.error("a list of other size", "a row and a column for each parameter");
    let numbers = |row: &Node| row.items()?.iter().map(Node::number).collect::<Result<Vec<f64>>>();
    let matrix = rows.items()?.iter().map(numbers).collect::<Result<Vec<_>>>()?;
    if matrix.len() != listed.len() || matrix.iter().any(|row| row.len() != listed.len()) {
        return Err(wrong());
    }
    let mut found: Vec<(usize, Difference)> = vec![];
    for (k, item) in listed.iter().enumerate() {
        let object = item.members()?;
        let name = object.require("name", "\"name\" of the parameter")?;
        use Differs::{BarrelDensity, Density, ModulusRatio, ShearModulus, YoungsModulus};
        let known = [YoungsModulus, ShearModulus, Density, BarrelDensity, ModulusRatio];
        let text = name.string()?;
        let what = known.into_iter().find(|what| what.name() == text);
        let wrong = || name.error(name.shown(), "a parameter of a calibration");
        let what = what.ok_or_else(wrong)?;
        // A held property does not differ.
        if matrix[k][k] > 1e-16 {
            found.push((k, Difference { what, deviation: matrix[k][k].sqrt() }));
        }
    }
    let correlation = |i: usize, j: usize| matrix[i][j] / (matrix[i][i] * matrix[j][j]).sqrt();
    let count = found.len();
    let pairs = (0..count).flat_map(|a| (0..a).map(move |b| (b, a)));
    let pairs: Vec<_> = pairs.map(|(a, b)| (a, b, correlation(found[a].0, found[b].0))).collect();
    let found = found.into_iter().map(|(_, difference)| difference);
    let later = std::mem::take(&mut differences.all);
    differences.all = found.chain(later).collect();
    differences.correlations = pairs;
    Ok(())
}

fn usual() -> Result<Vec<Output>> {
    USUAL.iter().map(|name| Answer::named(name).map(Output::Of)).collect()
}

/// The outputs; by default, if the impact point differs, the speed there too.
fn asked(node: Option<&Node>, differences: &Differences) -> Result<Vec<Output>> {
    let Some(node) = node else {
        let at_impact = differences.all.iter().any(|one| one.what == Differs::Impact);
        let all = usual()?.into_iter().chain(at_impact.then_some(Output::AtImpact));
        return Ok(all.collect());
    };
    let outputs = asked::outputs(node, |name| {
        if name == AT_IMPACT { Ok(Output::AtImpact) } else { Answer::named(name).map(Output::Of) }
    })?;
    Ok(outputs.into_iter().map(|(_, output)| output).collect())
}
