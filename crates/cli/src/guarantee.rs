//! `--guarantee` and `--within`: proofs for the modes of a verb.

use sweetspot::{Bat, Result};
use sweetspot_proof::enclosure::guarantee::guarantee;
use sweetspot_proof::enclosure::within::{Within, band};
use sweetspot_report::report::proven::Proven;

use crate::common::{BatArgs, Prepared, SolveArgs, Solved};
use crate::done::NOT_REACHED;
use crate::output::FullArgs;
use crate::value::LITTLE;

#[derive(clap::Args)]
pub struct GuaranteeArgs {
    /// Prove an interval for each frequency of the exact beam, at most --tol wide
    ///
    /// The bat is that of the file, with its decimals exactly as written, as a beam of the named theory. Each of its
    /// frequencies lies in its interval, rounding included, and no mode is missing. The JSON also has intervals for the
    /// nodes, and the numbers of the proof. The variation of wood is not covered.
    #[arg(long, help_heading = "Accuracy", conflicts_with_all = ["elements", "degree", "budget", "solver"])]
    guarantee: bool,

    /// Prove it for every bat within these limits: radii and moduli, such as "0.1 mm, 2 %"
    #[arg(long, value_name = "m, %", help_heading = "Accuracy", requires = "guarantee",
        allow_hyphen_values = true, value_parser = within)]
    within: Option<Within>,
}

impl GuaranteeArgs {
    /// The modes of a bat that was read, and the proof if it was asked for.
    pub fn solve_for(
        &self,
        bat: Bat,
        args: &BatArgs,
        solve: &SolveArgs,
        output: &FullArgs,
    ) -> Result<(Solved, Option<Proven>)> {
        if !self.guarantee {
            return Ok((args.solve_for(bat, solve, output)?, None));
        }
        let Prepared { bat, request, warning } = args.prepare(bat, args.count(), solve, output)?;
        let (solution, guarantee) = guarantee(&bat, &request)?;
        let band = match self.within {
            Some(within) => Some((within, band(&bat, &request, within)?)),
            None => None,
        };
        Ok((Solved { bat, solution, warning }, Some(Proven { guarantee, band })))
    }
}

/// The exit code, after a warning about an incomplete proof.
pub fn verdict(Proven { guarantee, band }: &Proven, solve: &SolveArgs, output: &FullArgs) -> u8 {
    if !guarantee.met {
        output.warn(&format!("not proven as asked: {}", guarantee.shortfall(solve.tol)));
    }
    let narrow = band.as_ref().is_none_or(|(_, band)| band.met);
    if !narrow {
        output.warn("not proven as asked: the band of the bats within --within has a wider end");
    }
    if guarantee.met && narrow { 0 } else { NOT_REACHED }
}

/// `"0.1 mm, 2 %"`: a length for the radii, a share of the moduli, or both.
fn within(text: &str) -> std::result::Result<Within, String> {
    let expected = "a length for the radii and a share of the moduli, such as \"0.1 mm, 2 %\"";
    let mut within = Within { radius: 0.0, modulus: 0.0 };
    let (mut radii, mut moduli) = (0, 0);
    for part in text.split([',', ';']).map(str::trim) {
        match part.strip_suffix('%').map(|share| share.trim().parse::<f64>()) {
            Some(Ok(share)) => {
                within.modulus = 0.01 * share;
                moduli += 1;
            }
            Some(Err(_)) => return Err(expected.to_owned()),
            None => {
                within.radius = LITTLE.read(part).map_err(|said| format!("{said}; {expected}"))?;
                radii += 1;
            }
        }
    }
    let possible = within.radius >= 0.0 && (0.0..1.0).contains(&within.modulus);
    if radii > 1 || moduli > 1 || !possible {
        return Err(format!("expected {expected}, each once, the share below 100 %"));
    }
    Ok(within)
}
