//! Speed against accuracy, `sweetspot-trade/1`, and the errors of frequencies against the number of elements,
//! `sweetspot-u-curve/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::bat::body::Bat;
use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot_study::trade::measure::Trade;
use sweetspot_study::trade::reference::Reference;
use sweetspot_study::trade::u_curve::Curve;

/// Accuracy of the frequencies of a bat against computing time, measured for many meshes and solvers. Errors are
/// relative, times in s; a value that does not exist is null. Later versions with the same number may have more
/// members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Trade file of sweetspot, sweetspot-trade/1")]
pub struct TradeFile {
    /// Name of the format and its version: sweetspot-trade/1.
    pub format: Format<TradeFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat.
    pub bat: BatName,
    /// The measurements.
    #[serde(flatten)]
    pub trade: Trade,
}

impl Document for TradeFile {
    const NAME: &'static str = "trade";
}

impl TradeFile {
    /// The document of the measurements of that bat.
    pub fn of(bat: &Bat, trade: Trade) -> Self {
        Self { format: Format::new(), generator: Generator::this(), bat: BatName::of(bat), trade }
    }
}

/// The error of the frequencies of a bat against the number of cubic elements, for each solver: more elements first
/// reduce the error and then increase it. Errors are relative, times in s; a value that does not exist is null. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "U-curve file of sweetspot, sweetspot-u-curve/1")]
pub struct UCurveFile {
    /// Name of the format and its version: sweetspot-u-curve/1.
    pub format: Format<UCurveFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat.
    pub bat: BatName,
    /// Number of modes.
    pub modes: usize,
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// The reference of the errors.
    pub reference: Reference,
    /// A column for each solver.
    pub columns: Vec<Curve>,
}

impl Document for UCurveFile {
    const NAME: &'static str = "u-curve";
}

impl UCurveFile {
    /// The document of those curves of that bat.
    pub fn of(bat: &Bat, reference: Reference, columns: Vec<Curve>) -> Self {
        Self {
            format: Format::new(),
            generator: Generator::this(),
            bat: BatName::of(bat),
            modes: reference.omegas.len(),
            degree: 3,
            reference,
            columns,
        }
    }
}
