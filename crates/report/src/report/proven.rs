//! How are proven frequencies written, with both ends rounded outwards?

use crate::parts::{first, lines, numbers, wrapped};
use crate::schema::modes as file;
use sweetspot_proof::enclosure::guarantee::Guarantee;
use sweetspot_proof::enclosure::within::{Band, Within};

/// The proven frequencies of a bat, and those of every similar bat if requested.
pub struct Proven {
    /// Of the bat.
    pub guarantee: Guarantee,
    /// The frequencies of every bat within these tolerances.
    pub band: Option<(Within, Band)>,
}

/// Two ends as numbers whose shortest decimals are not inside the interval.
fn outwards([lower, upper]: [f64; 2]) -> file::ProvenFrequency {
    file::ProvenFrequency { lower_hz: lower.next_down(), upper_hz: upper.next_up() }
}

/// Writes the proven frequencies into the document of the modes.
pub fn write(document: &mut file::ModesFile, proven: &Proven) {
    let Proven { guarantee, band } = proven;
    for (mode, known) in document.modes.iter_mut().zip(&guarantee.modes) {
        mode.proven = Some(outwards(known.hertz));
        let nodes = known.nodes.iter().map(|[from, to]| [from.next_down().max(0.0), to.next_up()]);
        mode.proven_nodes_m = Some(nodes.collect());
    }
    if let Some((_, band)) = band {
        for (mode, hertz) in document.modes.iter_mut().zip(&band.hertz) {
            mode.proven_within = Some(outwards(*hertz));
        }
    }
    let proof = &guarantee.proof;
    document.proof = Some(file::Proof {
        met: guarantee.met,
        proven: proof.proven,
        trials: proof.trials,
        cells: proof.cells,
        degree: proof.degree,
        trace_s2: proof.norms.trace.next_up(),
        norm_squared_s4: proof.norms.square.next_up(),
        others_s2: proof.others.next_up(),
        trial: guarantee
            .modes
            .iter()
            .map(|mode| file::ProofOfTrial {
                quotient_s2: [
                    mode.eigenvalue.quotient.low.next_down(),
                    mode.eigenvalue.quotient.high.next_up(),
                ],
                residual_s4: mode.eigenvalue.residual.next_up(),
            })
            .collect(),
        within: band.as_ref().map(|(within, band)| file::ProofWithin {
            radius_m: within.radius,
            modulus: within.modulus,
            met: band.met,
        }),
    });
}

/// The ends, each rounded outwards, with as many decimals as they need to differ.
pub fn decimals([lower, upper]: [f64; 2]) -> [String; 2] {
    let width = (upper - lower).max(1e-14 * upper.abs()).max(f64::MIN_POSITIVE);
    let places = (1.0 - width.log10()).ceil().clamp(0.0, 17.0);
    // More than half a unit of the last place outwards, and one double: rounding the decimals and the sum
    // takes back half of each at most.
    let step = 0.6 * 10f64.powf(-places);
    let places = places as usize;
    let [lower, upper] = [(lower - step).next_down(), (upper + step).next_up()];
    [format!("{lower:.places$}"), format!("{upper:.places$}")]
}

/// The table of proven frequencies.
pub fn text(proven: &Proven) -> String {
    let Proven { guarantee, band } = proven;
    let (asked, found) = (guarantee.asked, guarantee.modes.len());
    let mut out = match found {
        0 if asked == 0 => "Proven of the exact beam: no mode was asked for\n".to_owned(),
        0 => format!("Proven of the exact beam: none of {asked} modes\n"),
        _ => "Proven of the exact beam, no mode missing between them\n".to_owned(),
    };
    let mut rows = |title: &str, all: &[[f64; 2]]| {
        if all.is_empty() {
            return;
        }
        let numbered: Vec<(usize, [f64; 2])> = (1..).zip(all.iter().copied()).collect();
        out += title;
        out += &lines(
            &numbered,
            &[
                (numbers(6, "mode"), &|(k, _)| k.to_string()),
                (numbers(3, ""), &|_| String::new()),
                (first(22, "not below, Hz"), &|(_, hertz)| decimals(*hertz)[0].clone()),
                (first(22, "not above, Hz"), &|(_, hertz)| decimals(*hertz)[1].clone()),
                (first(12, "width"), &|(_, hertz)| format!("{:.0e}", hertz[1] / hertz[0] - 1.0)),
            ],
        );
    };
    let all: Vec<[f64; 2]> = guarantee.modes.iter().map(|mode| mode.hertz).collect();
    rows("", &all);
    if let Some((within, band)) = band {
        let title = format!(
            "Of every bat whose radii are within {} mm and whose moduli are within {} %\n",
            1e3 * within.radius,
            1e2 * within.modulus
        );
        rows(&title, &band.hertz);
    }
    let proof = &guarantee.proof;
    let rests = format!(
        "  {} modes are proven by {} trials of degree {} on {} cells; docs/proof.md has the theorem, what is \
         assumed and what is not claimed.",
        proof.proven, proof.trials, proof.degree, proof.cells
    );
    out + &wrapped(&rests, 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_never_inside_of_the_ends() {
        let mut lower = 1.0;
        for k in 0..20_000 {
            lower *= 1.000_731;
            let upper = lower * (1.0 + 10f64.powf(-15.5 * (0.618 * f64::from(k)).fract()));
            let [below, above] = decimals([lower, upper]);
            // A decimal that rounds to a double on the far side, or that is longer than its end, is outside.
            let (low, high): (f64, f64) = (below.parse().unwrap(), above.parse().unwrap());
            assert!(low < lower && high > upper, "{lower} {upper} {below} {above}");
            assert!(low > lower - 3.0 * (upper - lower) - 1e-13 * lower);
        }
    }
}
