//! The comparison of measured modes with computed ones in sentences.

use crate::measured::study::{Pair, RigidMode, Shapes, Study};

/// A MAC below this between two shapes that should be equal is reported.
const ALIKE: f64 = 0.9;
/// Frequencies that differ by less are equal for a laboratory.
const SAME: f64 = 5e-4;
/// Ratios of frequencies that are farther than this from their mean are not of one bat and its modes.
const MISNUMBERED: f64 = 0.1;
/// Two computed shapes, which should differ, count as similar above this MAC, if it is more than twice the MAC at many
/// points: in a plain sum over points even smooth shapes have a MAC above 0.
const CONFUSED: f64 = 0.1;
/// Shares of rigid motion, or mass orthogonality between two shapes, are reported above this if the points alone do not
/// explain half of it.
const MUCH: f64 = 0.1;
/// Shares out of phase above this are reported.
const WHIRLING: f64 = 0.05;

/// All sentences; warnings first.
pub fn words(study: &Study) -> Vec<String> {
    let mut all = vec![];
    all.extend(frequencies(study));
    all.extend(slow(study));
    let Some(shapes) = &study.shapes else { return all };
    if shapes.placed.turned_fits_better {
        let [here, turned] = shapes.placed.fits.map(|fit| fit.unwrap_or(0.0));
        all.push(format!(
            "Turned end for end the shapes fit better (mean MAC {turned:.3}, not {here:.3}): were the \
             places measured from the other end? --tip-first or --knob-first says so."
        ));
    }
    all.extend(alike(study));
    all.extend(confused(study, shapes));
    all.extend(whirling(study, shapes));
    all.extend(rigid(study, shapes));
    all.extend(common(study, shapes));
    all
}

/// The common error of all frequencies, and the rest after one factor on the stiffness.
fn frequencies(study: &Study) -> Vec<String> {
    let differences = study.pairs.iter().filter_map(|pair| pair.difference);
    let logs: Vec<f64> = differences.map(f64::ln_1p).collect();
    if logs.is_empty() {
        return vec!["No measured mode is paired with a computed one.".to_owned()];
    }
    let (mean, left) = common_factor(&logs);
    if mean.abs().max(left) < SAME {
        return vec![format!(
            "The computed frequencies are the measured ones to {:.0e}.",
            left.max(mean.abs())
        )];
    }
    let percent = |v: f64| format!("{:.1} %", 100.0 * v.abs());
    let way = if mean > 0.0 { "above" } else { "below" };
    let mut text = format!(
        "The computed frequencies are {} {way} the measured ones in the mean",
        percent(mean.exp_m1())
    );
    if logs.len() > 1 {
        let stiffness = (-2.0 * mean).exp_m1();
        let softer = if stiffness < 0.0 { "softer" } else { "stiffer" };
        text += &format!(
            ": a bat {} {softer} all along would leave {} at most",
            percent(stiffness),
            percent(left)
        );
    }
    let mut all = vec![text + "."];
    if study.shapes.is_none() && left > MISNUMBERED {
        all.push(numbers(study, left));
    }
    all
}

/// The mean of the logarithms of the ratios, and the largest deviation from it.
fn common_factor(logs: &[f64]) -> (f64, f64) {
    let mean = logs.iter().sum::<f64>() / logs.len() as f64;
    (mean, logs.iter().map(|log| (log - mean).exp_m1().abs()).fold(0.0, f64::max))
}

/// The evidence that modes without shapes are paired wrongly, and whether other numbers would fit.
fn numbers(study: &Study, left: f64) -> String {
    let shifted = |by: isize| {
        let log = |pair: &Pair| {
            let other = study.solution.modes.get(pair.computed.checked_add_signed(by)?)?;
            Some((other.frequency() / study.measured.modes[pair.measured].frequency).ln())
        };
        let logs: Vec<f64> = study.pairs.iter().map(log).collect::<Option<_>>()?;
        let (_, left) = common_factor(&logs);
        Some((by, left)).filter(|(_, left)| left.is_finite())
    };
    let best = [-1, 1].into_iter().filter_map(shifted).min_by(|a, b| a.1.total_cmp(&b.1));
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let told = "Without shapes the modes are paired by their numbers, and their ratios differ by";
    let told = format!("{told} up to {}", percent(left));
    match best.filter(|(_, other)| 2.0 * other < left) {
        Some((by, other)) => {
            let way = if by < 0 { "lower" } else { "higher" };
            format!("{told}: with every number one {way} it would be {}.", percent(other))
        }
        None => format!("{told}: a number may be wrong, or the bat is another one."),
    }
}

/// Rigid motions that are not straight.
fn slow(study: &Study) -> Option<String> {
    let crooked = study.rigid.iter().filter(|mode| mode.bent > MUCH);
    let name =
        |mode: &RigidMode| format!("{} by {:.0} %", study.name(mode.measured), 100.0 * mode.bent);
    let list: Vec<String> = crooked.map(name).collect();
    (!list.is_empty()).then(|| {
        format!(
            "Shapes of modes this slow should be straight lines, and these are not, {}: is every \
             sensor's calibration right, and the order of the points?",
            list.join(", ")
        )
    })
}

fn alike(study: &Study) -> Vec<String> {
    let poor = study.pairs.iter().filter(|pair| pair.mac.is_some_and(|mac| mac < ALIKE));
    poor.map(|pair| {
        format!(
            "{} and computed mode {} have a MAC of {:.2} only.",
            study.name(pair.measured),
            pair.computed + 1,
            pair.mac.unwrap_or(0.0)
        )
    })
    .collect()
}

/// Computed modes in the measured range that look similar at these points, but not at many.
fn confused(study: &Study, shapes: &Shapes) -> Option<String> {
    let highest = study.measured.modes.last()?.frequency;
    let modes = &study.solution.modes;
    let within = modes.iter().filter(|mode| mode.frequency() <= highest).count();
    let pairs = (0..within).flat_map(|i| (0..i).map(move |j| (i, j)));
    let alike = |(i, j): (usize, usize)| shapes.own_mac[i][j];
    let confused =
        pairs.filter(|&(i, j)| alike((i, j)) > CONFUSED.max(2.0 * shapes.dense_mac[i][j]));
    let (i, j) = confused.max_by(|a, b| alike(*a).total_cmp(&alike(*b)))?;
    Some(format!(
        "At these {} points computed modes {} and {} look alike, MAC {:.2}, at many {:.2}: more points, \
         or points elsewhere, would tell the modes apart.",
        shapes.placed.x.len(),
        j + 1,
        i + 1,
        alike((i, j)),
        shapes.dense_mac[i][j]
    ))
}

fn whirling(study: &Study, shapes: &Shapes) -> Option<String> {
    let list =
        study.bending.iter().zip(&shapes.out_of_phase).filter(|(_, share)| **share > WHIRLING);
    let list: Vec<String> =
        list.map(|(k, share)| format!("{} {:.0} %", study.name(*k), 100.0 * share)).collect();
    (!list.is_empty()).then(|| {
        format!(
            "Much of the motion is a quarter period off the rest: {}. Modes near each other, strong \
             damping or delays between channels do that.",
            list.join(", ")
        )
    })
}

/// Shapes with momentum, which the bending of a free bat cannot have. Without a computed partner the effect of the
/// points on a shape is not known.
fn rigid(study: &Study, shapes: &Shapes) -> Option<String> {
    let (own, sampled) = (shapes.rigid_share.as_ref()?, shapes.sampled_rigid_share.as_ref()?);
    let one = |row: usize| {
        let points = sampled[row].filter(|points| own[row] > MUCH.max(2.0 * points))?;
        let [own, points] = [own[row], points].map(|share| format!("{:.0} %", 100.0 * share));
        let name = study.name(study.bending[row]);
        Some(format!("{name} {own} (the points explain {points})"))
    };
    let list: Vec<String> = (0..own.len()).filter_map(one).collect();
    (!list.is_empty()).then(|| {
        format!(
            "A free bat's bending carries no momentum, but these shapes carry rigid motion: {}. A \
             sensor's calibration, the order or the places of points, or supports may be the reason.",
            list.join(", ")
        )
    })
}

/// The two measured shapes that are the least orthogonal in the bat's mass, among those whose computed partners show
/// the effect of the points.
fn common(study: &Study, shapes: &Shapes) -> Option<String> {
    let (own, sampled) = (shapes.common.as_ref()?, &shapes.sampled_common);
    let pairs = (0..study.bending.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let known = pairs.filter_map(|(i, j)| Some((i, j, own[i][j], sampled[i][j]?)));
    let (i, j, worst, points) = known.max_by(|a, b| a.2.total_cmp(&b.2))?;
    let names = [j, i].map(|row| study.name(study.bending[row]));
    let verdict = match worst {
        w if w <= MUCH => "they are sound in this",
        w if w <= 2.0 * points => "with so few points that proves nothing",
        _ => "the shapes, or the masses in the bat file, are off",
    };
    Some(format!(
        "{} and {} are the least orthogonal in the bat's mass, {worst:.3}, their computed partners at \
         these points {points:.3}: {verdict}.",
        names[0], names[1]
    ))
}
