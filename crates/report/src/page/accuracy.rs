//! How reliable are the numbers: what is certified, what was neglected, and the error that causes.

use crate::analysis::{Analysis, Proof};
use crate::parts::{Quantity, Units, sentence};
use crate::report::{advice, hit_text, text, trust};
use sweetspot::Request;
use sweetspot_proof::enclosure::guarantee::guarantee;
use sweetspot_proof::promise::{ALWAYS, largest};
use sweetspot_study::ignored::{ignored, in_hit};
use sweetspot_study::trade::reference::solver_name;

/// The uncertainty of this bat due to wood, scale and calipers, and what would reduce it.
pub fn open(analysis: &Analysis, units: Units) -> Vec<String> {
    trust::of_bat(analysis, units).iter().map(|text| sentence(text)).collect()
}

/// What is certified, one sentence each.
pub fn certified(analysis: &Analysis, units: Units) -> Vec<String> {
    let Analysis { solution, task, .. } = analysis;
    let tolerance = task.hits.tolerance;
    let mut told = vec![];
    if !solution.modes.is_empty() {
        let count = solution.modes.len();
        let worst = format!("{:.0e}", solution.worst());
        told.push(match (task.hits.elements, solution.met()) {
            (Some(_), _) => format!(
                "Frequencies: the elements were asked for and no tolerance; each of the {count} is \
                 within {worst} of itself."
            ),
            (None, true) => format!(
                "Frequencies: asked within {tolerance:.0e}, and met; each of the {count} is within {worst} of \
                 itself, by an estimate made for each."
            ),
            (None, false) => format!(
                "Frequencies: asked within {tolerance:.0e}, NOT met ({}); each of the {count} is within {worst} \
                 of itself.",
                solution.ending
            ),
        });
        told.push(text::counted(&analysis.bat, solution).to_owned());
        told.extend(proven(analysis));
    }
    told.push(format!("Proof: {}.", proof(analysis)));
    told.extend(exit_speeds(analysis, units));
    told.extend(hit_text::beyond(&analysis.hits, &task.scene, units));
    told.iter().map(|text| sentence(text)).collect()
}

/// The accuracy of the solver where the frequencies are known.
pub fn proof(analysis: &Analysis) -> String {
    let Proof { modes, truth, stated } = analysis.proof;
    format!(
        "on the uniform dowel, whose frequencies are known exactly, the same solver finds modes 1 to {modes} within \
         {truth:.0e} and states {stated:.0e}"
    )
}

/// A bat of more pieces than this is not proven in a report: it would take long.
const MOST_PIECES: usize = 300;
/// Most modes that are proven in a report.
const MOST_MODES: usize = 10;
/// Intervals are this narrow as a share of the frequency.
const WIDTH: f64 = 1e-9;

/// What is proven about the stated errors of the frequencies; None where nothing is proven, or where a stated error is
/// smaller than the proof can show.
fn proven(analysis: &Analysis) -> Option<String> {
    let Analysis { bat, solution, .. } = analysis;
    if bat.profile().pieces.len() > MOST_PIECES {
        return None;
    }
    let modes = solution.modes.len().min(MOST_MODES);
    let theory = solution.theory;
    let request = Request { modes, tolerance: WIDTH, theory, ..Request::default() };
    let (_, found) = guarantee(bat, &request).ok()?;
    let off = solution.modes.iter().zip(&found.modes).map(|(mode, known)| {
        let [lower, upper] = known.hertz;
        let frequency = mode.frequency();
        f64::max(frequency / lower - 1.0, 1.0 - frequency / upper) / mode.error.total()
    });
    // Rounded up to the printed digits.
    let worst = (100.0 * largest(off)).ceil() / 100.0;
    (found.met && worst <= ALWAYS).then(|| {
        format!(
            "Proven, rounding included (modes --guarantee): modes 1 to {modes} of this beam, none \
             missing between them; each frequency above is off by at most {worst:.2} times what is \
             stated for it."
        )
    })
}

/// The largest error of an exit speed within the model.
fn exit_speeds(analysis: &Analysis, units: Units) -> Option<String> {
    let hits = &analysis.hits;
    let fastest = hits.impacts.iter().map(|i| i.bat_speed + analysis.task.scene.ball_speed);
    let fastest = fastest.fold(0.0, f64::max);
    let outcomes = hits.impacts.iter().filter_map(|impact| impact.outcome.as_ref());
    let worst = outcomes.map(|outcome| outcome.error).reduce(f64::max)?;
    let verdict = match (analysis.task.hits.elements, hits.met()) {
        (Some(_), _) => "",
        (None, true) => "; asked and met",
        (None, false) => "; NOT met",
    };
    Some(format!(
        "Exit speeds: each within {worst:.0e} of the closing speed, {} at most, by estimate, as this model \
         has them{verdict}.",
        Quantity::Speed.said(units, worst * fastest),
    ))
}

/// How it was computed, a sentence each.
pub fn method(analysis: &Analysis) -> Vec<String> {
    let solution = &analysis.solution;
    let mut told = vec![format!(
        "The bat is a beam by the theory of {}: {} elements of degree {}, solver {} ({}).",
        text::theory(solution.theory),
        solution.mesh.len(),
        solution.degree,
        solver_name(solution.solver),
        solution.reason
    )];
    if !solution.damping.modes.is_empty() {
        told.push(format!("Damping: {}.", solution.damping.kind));
    }
    told.push(format!("The hit: {}.", hit_text::meaning(analysis.task.model)));
    told.iter().map(|text| sentence(text)).collect()
}

/// What the model neglected, and the error that causes.
pub fn left_out(analysis: &Analysis) -> Vec<String> {
    let ignored = ignored(&analysis.bat, &analysis.solution);
    let mut told: Vec<String> = ignored.iter().map(|text| sentence(text)).collect();
    told.extend(left_out_of_hit(analysis));
    told
}

/// What the hits neglected, which does not affect the modes.
pub fn left_out_of_hit(analysis: &Analysis) -> Vec<String> {
    let ignored = in_hit(&analysis.bat, &analysis.task.scene);
    ignored.iter().map(|text| sentence(&format!("Left out: {text}"))).collect()
}

/// What the model of this bat needs.
pub fn needed(analysis: &Analysis) -> Vec<String> {
    let told = analysis.advice.as_ref().map_or(vec![], advice::recommendation);
    told.iter().map(|text| sentence(text)).collect()
}
