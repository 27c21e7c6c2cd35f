//! Every format that is read or written, with its schema.

use serde_json::{Map, Value, json};

use crate::page::data::Data;
use crate::schema::advice::AdviceFile;
#[cfg(feature = "aim")]
use crate::schema::aimed::AimedFile;
use crate::schema::analysis::AnalysisFile;
use crate::schema::bbcor::BbcorFile;
use crate::schema::calibrate::CalibrateFile;
use crate::schema::compare::CompareFile;
use crate::schema::frf::{FrfFile, FrfSetFile};
use crate::schema::hit::HitFile;
use crate::schema::hoop::HoopFile;
use crate::schema::identify::IdentifyFile;
use crate::schema::lathe::LatheFile;
use crate::schema::materials::MaterialsFile;
use crate::schema::measured::MeasuredFile;
use crate::schema::mistakes::ErrorFile;
use crate::schema::modes::ModesFile;
use crate::schema::ring::RingFile;
use crate::schema::scatter::ScatterResult;
use crate::schema::study::StudyManifest;
use crate::schema::tap::TapFile;
use crate::schema::trade::{TradeFile, UCurveFile};
use crate::schema::{DRAFT, id, of};
use sweetspot::files::schema::ball::BallFile;
use sweetspot::files::schema::bat::BatFile;
use sweetspot::files::schema::document::{Document, format};
use sweetspot_proof::case::Case;
#[cfg(feature = "aim")]
use sweetspot_study::files::aim_file::AimForm;
use sweetspot_study::files::readings_file::ReadingsForm;
#[cfg(feature = "aim")]
use sweetspot_study::files::rules_file::RulesForm;
use sweetspot_study::files::scatter_file::ScatterForm;
use sweetspot_study::files::study_file::StudyForm;

/// The number of formats: with the feature `aim`, wishes and rules of games are read and answers to wishes written.
const COUNT: usize = if cfg!(feature = "aim") { 31 } else { 28 };

/// A kind of file that has a schema.
#[derive(Debug, Clone, Copy)]
pub struct FileKind {
    name: &'static str,
    schema: fn() -> Value,
}

impl FileKind {
    /// The formats that are read, then those that are written.
    pub const ALL: [Self; COUNT] = [
        Self::of::<BatFile>(),
        Self::of::<BallFile>(),
        Self::of::<StudyForm>(),
        #[cfg(feature = "aim")]
        Self::of::<AimForm>(),
        #[cfg(feature = "aim")]
        Self::of::<RulesForm>(),
        Self::of::<ReadingsForm>(),
        Self::of::<ScatterForm>(),
        Self::of::<Case>(),
        Self::of::<ModesFile>(),
        Self::of::<HitFile>(),
        Self::of::<AnalysisFile>(),
        Self::of::<BbcorFile>(),
        Self::of::<HoopFile>(),
        Self::of::<LatheFile>(),
        Self::of::<CompareFile>(),
        Self::of::<MeasuredFile>(),
        Self::of::<RingFile>(),
        Self::of::<FrfFile>(),
        Self::of::<FrfSetFile>(),
        Self::of::<AdviceFile>(),
        Self::of::<CalibrateFile>(),
        Self::of::<IdentifyFile>(),
        Self::of::<TapFile>(),
        Self::of::<ScatterResult>(),
        Self::of::<StudyManifest>(),
        #[cfg(feature = "aim")]
        Self::of::<AimedFile>(),
        Self::of::<TradeFile>(),
        Self::of::<UCurveFile>(),
        Self::of::<MaterialsFile>(),
        Self::of::<ErrorFile>(),
        Self::of::<Data>(),
    ];

    const fn of<D: Document>() -> Self {
        Self { name: D::NAME, schema: of::<D> }
    }

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        self.name
    }

    /// The `format` member that identifies such a file.
    pub fn format(self) -> String {
        format(self.name)
    }

    /// Its schema.
    pub fn schema(self) -> Value {
        (self.schema)()
    }
}

/// One schema for all of them, selected by `format`, with the schema of each inside.
pub fn all() -> Value {
    let by_format = |file: FileKind| {
        json!({
            "if": { "properties": { "format": { "const": file.format() } } },
            "then": { "$ref": id(file.name) },
        })
    };
    let definition = |file: FileKind| (file.name.to_owned(), file.schema());
    json!({
        "$schema": DRAFT,
        "$id": "urn:sweetspot:1",
        "title": "A file of sweetspot",
        "description": "A bat, a ball, or what was found of them, told apart by the member \"format\".",
        "type": "object",
        "properties": { "format": { "enum": FileKind::ALL.map(FileKind::format) } },
        "required": ["format"],
        "allOf": FileKind::ALL.map(by_format),
        "$defs": FileKind::ALL.map(definition).into_iter().collect::<Map<_, _>>(),
    })
}
