//! Which beam theory: how does a section's own motion take part?
//!
//! A [`Theory`] goes into [`crate::modes::solve::Request::theory`]; [`crate::modes::theory_choice::theory`] chooses the
//! simplest one that is accurate enough.

use serde::Serialize;

/// The beam theories, each the limit of the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Theory {
    /// Sections have mass but no rotary inertia and stay at right angles to the axis.
    EulerBernoulli,
    /// Sections also turn with their own inertia ρI, still at right angles to the axis.
    ///
    /// # Source
    ///
    /// Lord Rayleigh, The Theory of Sound I (1877), article 161.
    Rayleigh,
    /// Sections turn with their own inertia and are sheared, `w′ − θ = Q/κGA`.
    ///
    /// # Source
    ///
    /// S. Timoshenko, Philos. Mag. 41 (1921) 744.
    Timoshenko,
    /// The simplest theory that is accurate enough for the request ([`crate::modes::theory_choice`]). The answer names
    /// the theory that was chosen.
    #[default]
    Auto,
}

impl Theory {
    /// All beam theories, the simplest first.
    pub const ALL: [Self; 3] = [Self::EulerBernoulli, Self::Rayleigh, Self::Timoshenko];

    /// The name that the command line and the files use.
    pub fn name(self) -> &'static str {
        match self {
            Self::EulerBernoulli => "euler-bernoulli",
            Self::Rayleigh => "rayleigh",
            Self::Timoshenko => "timoshenko",
            Self::Auto => "auto",
        }
    }

    /// Whether the sections have rotary inertia.
    pub fn turns(self) -> bool {
        matches!(self, Self::Rayleigh | Self::Timoshenko)
    }

    /// Whether the sections shear.
    pub fn shears(self) -> bool {
        self == Self::Timoshenko
    }
}
