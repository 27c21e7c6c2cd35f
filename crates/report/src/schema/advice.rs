//! What the model of a bat needs, `sweetspot-advice/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot_study::advise::advice::Advice;

/// How each part of the model of a bat changes its modes, and the smallest model that suffices. SI units, named at the
/// end of each member; shifts of frequencies are relative; a value that does not exist is null. Later versions with the
/// same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Advice file of sweetspot, sweetspot-advice/1")]
pub struct AdviceFile {
    /// Name of the format and its version: sweetspot-advice/1.
    pub format: Format<AdviceFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat.
    pub bat: BatName,
    /// What the model needs.
    #[serde(flatten)]
    pub advice: Advice,
}

impl Document for AdviceFile {
    const NAME: &'static str = "advice";
}

impl AdviceFile {
    /// The document of that advice.
    pub fn of(advice: &Advice) -> Self {
        let bat = BatName::of(&advice.full_model.solved.bat);
        Self { format: Format::new(), generator: Generator::this(), bat, advice: advice.clone() }
    }
}
