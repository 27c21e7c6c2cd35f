//! The motion of a bat in time, `sweetspot-ring/1`, and the load on it in a hit.

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use crate::schema::document;
use crate::schema::hit::Impact;
use sweetspot::Theory;
use sweetspot::bat::edit::Edit;
use sweetspot::collision::aftermath::{Strained, Watched};
use sweetspot::collision::strength::Load;

/// The motion of a bat in time after a hit, after a blow, under a force or from an initial shape. SI units, named at
/// the end of each member; positions count from the knob end, times from the first contact; a value that does not exist
/// is null. Later versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Ring file of sweetspot, sweetspot-ring/1")]
#[serde(untagged)]
pub enum RingFile {
    /// After a hit.
    Hit(Box<Struck>),
    /// After a blow, under a force or from an initial shape.
    Motion(Motion),
}

document!(RingFile, "ring");

/// A hit and the motion after it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Struck {
    /// The motion.
    #[serde(flatten)]
    pub motion: AfterHit,
    /// The hit itself, as in a hit file.
    pub impact: Impact,
    /// Neglected effects and their consequences.
    pub ignored: Vec<String>,
}

/// The motion after a hit, relative to the swing.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AfterHit {
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Number of bending modes.
    pub modes: usize,
    /// Position of the impact (m).
    pub at_m: f64,
    /// When the ball is gone for good (s).
    pub contact_s: f64,
    /// Instants (s).
    pub times_s: Vec<f64>,
    /// Force between ball and bat at every instant (N).
    pub force_n: Vec<f64>,
    /// The motion at the watched places.
    pub watched: Vec<Watched>,
    /// The largest strain while the ball is there.
    pub strain_max_in_contact: Option<Strained>,
    /// The largest strain of the whole time.
    pub strain_max: Option<Strained>,
    /// Relative change of the largest strain when a quarter of the modes is omitted.
    pub strain_error: f64,
    /// The largest strain of every place in the whole time.
    #[serde(serialize_with = "Along::of")]
    #[schemars(with = "Along")]
    pub along: Vec<Strained>,
    /// The load relative to the strength of the materials; empty where that is not known.
    pub strength: Vec<Load>,
    /// End of the time considered (s).
    #[serde(skip)]
    pub until: f64,
    /// Whether the bat is damped; without damping its vibration has no end, and no size that a hand feels.
    #[serde(skip)]
    pub damped: bool,
}

/// The largest strain along the bat.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Along {
    /// Places (m).
    pub x_m: Vec<f64>,
    /// Largest strain of the surface at each place.
    pub strain_max: Vec<f64>,
    /// Largest stress of the surface at each place (Pa).
    pub stress_max_pa: Vec<f64>,
}

impl Along {
    fn of<S: Serializer>(places: &[Strained], out: S) -> Result<S::Ok, S::Error> {
        let all = |of: fn(&Strained) -> f64| places.iter().map(of).collect();
        let [x_m, strain_max] = [all(|at| at.x_m), all(|at| at.strain)];
        Self { x_m, strain_max, stress_max_pa: all(|at| at.stress_pa) }.serialize(out)
    }
}

/// The deflection along the bat in time.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Motion {
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Number of bending modes.
    pub modes: usize,
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
    /// Whether the rigid motion is included.
    pub rigid_motion: bool,
    /// Position of the blow or force (m); null where the bat is released from a shape.
    pub at_m: Option<f64>,
    /// Impulse of the blow (N s); null for a force or a release.
    pub impulse_n_s: Option<f64>,
    /// Places (m).
    pub x_m: Vec<f64>,
    /// Instants (s).
    pub times_s: Vec<f64>,
    /// Deflection at every instant, at every place (m).
    pub deflection_m: Vec<Vec<f64>>,
}
