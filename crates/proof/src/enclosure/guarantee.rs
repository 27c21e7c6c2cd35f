//! Between which numbers do the frequencies of a bat lie, as narrow as requested?
//!
//! [`guarantee`] plans and solves for a tenth of the tolerance, tries more modes than requested, proves, and refines
//! until the intervals are as narrow as requested or stop improving.

use crate::enclosure::beam::{Layout, Proven, carried};
use crate::enclosure::conclude::{Eigenvalue, conclude};
use crate::enclosure::energies::Energies;
use crate::enclosure::nodes::Nodes;
use crate::enclosure::norms::Norms;
use crate::enclosure::trials::trials;
use sweetspot::base::Result;
use sweetspot::bat::{Bat, Theory};
use sweetspot::beam::Mesh;
use sweetspot::modes::plan::Plan;
use sweetspot::modes::request::Request;
use sweetspot::modes::solution::Solution;
use sweetspot::modes::solve::solve;
use sweetspot::modes::theory_choice;

/// The proven statements about the modes of a bat.
#[derive(Debug, Clone)]
pub struct Guarantee {
    /// The requested modes that are proven, without gaps from the first on.
    pub modes: Vec<ProvenMode>,
    /// Number of requested modes.
    pub asked: usize,
    /// Whether all of them are proven, each within the tolerance.
    pub met: bool,
    /// The numbers that the proof rests on.
    pub proof: Proof,
}

/// A mode that is proven.
#[derive(Debug, Clone)]
pub struct ProvenMode {
    /// Lower and upper bound of the frequency (Hz).
    pub hertz: [f64; 2],
    /// Intervals (m) with a node of the mode in each, from the knob.
    pub nodes: Vec<[f64; 2]>,
    /// The numbers of its trial.
    pub eigenvalue: Eigenvalue,
}

/// The numbers that a proof rests on.
#[derive(Debug, Clone)]
pub struct Proof {
    /// How many modes are proven in all.
    pub proven: usize,
    /// How many motions were tried.
    pub trials: usize,
    /// Number of cells on which they are polynomials, and the degree of their deflection.
    pub cells: usize,
    /// Degree of the trials' deflection.
    pub degree: usize,
    /// Trace and norm of the compliance.
    pub norms: Norms,
    /// Upper bound of every other eigenvalue (s²).
    pub others: f64,
}

impl Guarantee {
    /// The largest relative width of the intervals; infinite if a requested mode is not proven.
    pub fn width(&self) -> f64 {
        let widest = self.modes.iter().map(|mode| mode.eigenvalue.width()).fold(0.0, f64::max);
        if self.modes.len() < self.asked { f64::INFINITY } else { widest }
    }

    /// Why the tolerance was not met, for people; empty if it was.
    pub fn shortfall(&self, tolerance: f64) -> String {
        let (asked, proven) = (self.asked, self.modes.len());
        match self.met {
            true => String::new(),
            false if proven < asked => format!("{proven} of {asked} modes are proven"),
            false => format!(
                "the widest interval is {:.1e} of its frequency, {tolerance:.1e} was asked",
                self.width()
            ),
        }
    }

    /// Whether another has more modes, or equally many with narrower intervals.
    fn is_worse_than(&self, other: &Self) -> bool {
        let widest =
            |of: &Self| of.modes.iter().map(|mode| mode.eigenvalue.width()).fold(0.0, f64::max);
        let more = other.modes.len().cmp(&self.modes.len());
        more.is_gt() || more.is_eq() && widest(other) < widest(self)
    }
}

/// A refinement that leaves more than this share of the width is useless.
const STALLED: f64 = 0.7;
/// Rounds before the answer is given as it is.
const MOST_ROUNDS: usize = 6;
/// Plans aim at this or less: elements then end at stations.
const COARSEST: f64 = 1e-10;
/// Plans aim at no smaller width: arithmetic cannot resolve one.
const FINEST: f64 = 1e-14;

/// The solution for the requested modes of a bat, and the proven statements about them. The frequencies of the solution
/// lie in the proven intervals.
///
/// # Errors
///
/// [`sweetspot::Error::Value`] for a bat without a proof, with the reason, and those of [`solve`]. A width that cannot
/// be reached is not an error: the result then has `met` false.
pub fn guarantee(bat: &Bat, request: &Request) -> Result<(Solution, Guarantee)> {
    let request = &Request { theory: theory_choice::of(bat, request)?, ..*request };
    carried(bat, request.theory)?;
    let layout = Layout::of(bat, request.theory)?;
    let norms = Norms::of(bat, &layout, request.theory)?;
    let (mut planned, mut cut) = ((0.1 * request.tolerance).min(COARSEST), 1);
    let mut more = (request.modes / 2).max(6);
    let mut best: Option<(Solution, Guarantee)> = None;
    for round in 0..MOST_ROUNDS {
        let tolerance = planned.max(FINEST);
        let solution = solve(bat, &Request { tolerance, ..*request })?;
        let (mesh, degree) = (&solution.mesh, solution.degree);
        let proven = Attempt { bat, layout: &layout, norms: &norms, theory: request.theory };
        let found = proven.of(mesh, degree, cut, request.modes, more)?;
        let found = Guarantee { met: found.width() <= request.tolerance, ..found };
        let (met, enough) = (found.met, found.modes.len() == request.modes);
        let width = |of: &Guarantee| of.width();
        let gained = best.as_ref().is_none_or(|(_, best)| {
            best.modes.len() < found.modes.len() || width(&found) < STALLED * width(best)
        });
        if best.as_ref().is_none_or(|(_, best)| best.is_worse_than(&found)) {
            best = Some((solution, found));
        }
        if met || round > 1 && !gained {
            break;
        }
        // More trials where modes are not separated, a finer mesh where intervals are wide.
        if enough && planned > FINEST {
            planned *= 1e-2;
        } else if enough {
            cut *= 2;
        } else {
            more += more.max(request.modes);
            planned *= 1e-1;
        }
    }
    Ok(best.expect("there was a round"))
}

/// One try on one mesh.
struct Attempt<'a> {
    bat: &'a Bat,
    layout: &'a Layout,
    norms: &'a Norms,
    theory: Theory,
}

impl Attempt<'_> {
    /// On that mesh, with each element divided into at least the given number of pieces.
    fn of(
        &self,
        mesh: &Mesh,
        degree: usize,
        cut: usize,
        asked: usize,
        more: usize,
    ) -> Result<Guarantee> {
        let Self { bat, layout, norms, theory } = *self;
        let count = asked + more;
        // Room for the trials beyond the requested modes.
        let strains = mesh.len() * (degree - 1);
        let parts = (2 * count).div_ceil(strains).max(cut);
        let mesh = if parts > 1 { mesh.refined(bat, |_| parts) } else { mesh.clone() };
        let plan = Plan { mesh, degree, ..Plan::default() };
        let tried = trials(bat, &plan, count, theory)?;
        let proven = Proven::of(bat, layout, &plan.mesh, theory)?;
        let energies: Vec<Option<Energies>> =
            tried.iter().map(|trial| proven.energies(trial)).collect();
        let conclusion = conclude(&energies, norms);
        let nodes = Nodes { proven: &proven, norms, conclusion: &conclusion };
        let modes = conclusion.proven.iter().take(asked).enumerate();
        let modes = modes.map(|(k, eigenvalue)| ProvenMode {
            hertz: eigenvalue.hertz(),
            nodes: nodes.of(k, &tried[eigenvalue.trial]),
            eigenvalue: *eigenvalue,
        });
        let proof = Proof {
            proven: conclusion.proven.len(),
            trials: tried.len(),
            cells: proven.cells.len(),
            degree,
            norms: *norms,
            others: conclusion.others,
        };
        Ok(Guarantee { modes: modes.collect(), asked, met: false, proof })
    }
}
