//! The document of the whole analysis, `sweetspot-analysis/1`: modes, hits, strength and uncertainty.

use schemars::JsonSchema;
use serde::Serialize;

use crate::report::hoop::HoopFile;
use crate::report::trust::Open;
use crate::schema::hit::HitFile;
use crate::schema::modes::ModesFile;
use crate::schema::{Written, document};
use sweetspot::collision::strength::Strength;

/// The whole analysis of a bat: its modes, its hits along the barrel, the stress that they cause, and the uncertainty
/// of the answers. SI units, named at the end of each member; positions count from the knob end. Later versions with
/// the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Analysis file of sweetspot, sweetspot-analysis/1")]
pub struct AnalysisFile {
    /// The bending modes, as a complete document.
    pub modes: ModesFile,
    /// The hits along the barrel, as a complete document.
    pub hit: HitFile,
    /// The load on the bat in hits at the sweet spot and five inches closer to the handle.
    pub strength: Vec<Strength>,
    /// The uncertainty of the answers due to calipers, scale and wood.
    pub open: Open,
    /// How the barrel of a hollow bat rings and how its wall affects the ball, as a complete document; left out for
    /// other bats.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hoop: Option<Written<HoopFile>>,
}

document!(AnalysisFile, "analysis");
