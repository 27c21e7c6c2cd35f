//! The modes of a bat, and their accuracy.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use serde::Serialize;

use crate::bat::{Bat, Theory};
use crate::beam::{Elements, Mesh};
use crate::modes::damping::Damping;
use crate::modes::mode::Mode;
use crate::modes::plan::Reason;
use crate::modes::referee::Solver;

/// How the search for the modes of a bat ended. [`fmt::Display`] tells a person why the request was not met; it is
/// empty if it was.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[must_use]
pub enum Ending {
    /// Every frequency is within the tolerance by its own estimate, and no mode is missing. For a search with a time
    /// limit: it ended in time and no mode is missing.
    Reached,
    /// Round-off alone exceeds the tolerance; its relative size.
    RoundOff(f64),
    /// It is not certain that no mode is missing.
    Uncounted,
    /// The reason why the refinement ended before the tolerance was met.
    Stopped(String),
    /// A further refinement gained nothing.
    Stalled,
}

impl fmt::Display for Ending {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reached => Ok(()),
            Self::RoundOff(share) => write!(out, "round-off alone is {share:.1e}"),
            Self::Uncounted => out.write_str(
                "the number of slower motions does not show that no mode is missing: two \
                 frequencies are too near each other to count between them",
            ),
            Self::Stopped(why) => out.write_str(why),
            Self::Stalled => out.write_str("further refinement gained nothing"),
        }
    }
}

/// The modes of a bat, the method, and their accuracy.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Solution {
    /// The bending modes, by rising frequency.
    pub modes: Vec<Mode>,
    /// Number of rigid modes of the bat, at frequency 0.
    pub rigid_modes: usize,
    /// Method for the eigenvalues.
    pub solver: Solver,
    /// The beam theory.
    pub theory: Theory,
    /// The elements.
    pub mesh: Mesh,
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// Why this mesh and this degree.
    pub reason: Reason,
    /// Products with the compliance or the inverse (Lanczos steps); 0 for the dense solver.
    pub steps: usize,
    /// How the search for the modes ended, and whether the request was met.
    pub ending: Ending,
    /// Whether the list of modes is certainly complete: by the number of nodes where theory requires one, or by the
    /// count of slower modes.
    pub complete: bool,
    /// The decay of the modes.
    pub damping: Damping,
    /// Time for each step.
    pub timing: Timing,
    /// The bat with moduli fitted to the tap, if it was solved so.
    #[serde(skip)]
    pub(crate) tuned: Option<Arc<Bat>>,
}

impl Solution {
    /// The bat that this solution belongs to: the given one, with moduli fitted to the tap.
    pub fn of<'a>(&'a self, bat: &'a Bat) -> &'a Bat {
        self.tuned.as_deref().filter(|_| bat.tap().is_some()).unwrap_or(bat)
    }

    /// The solution with the bat whose moduli were fitted to the tap, if they were.
    pub(crate) fn of_tapped(mut self, bat: Cow<'_, Bat>) -> Self {
        if let Cow::Owned(bat) = bat {
            self.tuned = Some(Arc::new(bat));
        }
        self
    }

    /// The largest relative error of a frequency, by its own estimate.
    pub fn worst(&self) -> f64 {
        // NaN must count as unbounded; `f64::max` would drop it.
        let known = |error: f64| if error.is_nan() { f64::INFINITY } else { error };
        self.modes.iter().map(|mode| known(mode.error.total())).fold(0.0, f64::max)
    }

    /// The largest round-off of a frequency, relative.
    pub fn round_off(&self) -> f64 {
        self.modes.iter().map(|mode| mode.error.round_off).fold(0.0, f64::max)
    }

    /// Whether the request was met ([`Ending::Reached`]).
    pub fn met(&self) -> bool {
        self.ending == Ending::Reached
    }

    /// Stores the reason why the refinement ended before the tolerance was met.
    pub(super) fn stop(&mut self, why: String) {
        if self.ending == Ending::Stalled {
            self.ending = Ending::Stopped(why);
        }
    }

    /// The elements of the bat.
    pub fn elements(&self) -> Elements<'_> {
        Elements { mesh: &self.mesh, degree: self.degree, theory: self.theory }
    }

    /// Number of unknowns of the assembled matrices.
    pub fn degrees_of_freedom(&self) -> usize {
        let strains = if self.theory.shears() { 2 } else { 1 };
        strains * (self.degree - 1) * self.mesh.len() + 2
    }
}

/// Time for each step.
#[derive(Debug, Clone, Copy, Default, Serialize)]
#[non_exhaustive]
pub struct Timing {
    /// Planning.
    pub plan: Duration,
    /// Compliance or matrices.
    pub assemble: Duration,
    /// Eigenpairs, shapes and errors.
    pub solve: Duration,
}
