//! Every format that is read or written, with its schema.

use serde_json::{Map, Value, json};

use crate::many::folder::StudyManifest;
use crate::page::data::Data;
use crate::report::{advice, bbcor, calibrate, comparison_data, hoop, lathe, mistakes, scatter};
use crate::report::{trade, u_curve, whole};
use crate::schema::frf::{FrfFile, FrfSetFile};
use crate::schema::hit::HitFile;
use crate::schema::identify::IdentifyFile;
use crate::schema::materials::MaterialsFile;
use crate::schema::measured::MeasuredFile;
use crate::schema::modes::ModesFile;
use crate::schema::ring::RingFile;
use crate::schema::tap::TapFile;
use crate::schema::{DRAFT, Written, id, of};
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
        Self::written::<whole::AnalysisFile>(),
        Self::written::<bbcor::BbcorFile>(),
        Self::written::<hoop::HoopFile>(),
        Self::written::<lathe::LatheFile>(),
        Self::written::<comparison_data::CompareFile>(),
        Self::written::<MeasuredFile>(),
        Self::written::<RingFile>(),
        Self::written::<FrfFile>(),
        Self::written::<FrfSetFile>(),
        Self::written::<advice::AdviceFile>(),
        Self::written::<calibrate::CalibrateFile>(),
        Self::written::<IdentifyFile>(),
        Self::written::<TapFile>(),
        Self::written::<scatter::ScatterResult>(),
        Self::of::<StudyManifest>(),
        #[cfg(feature = "aim")]
        Self::written::<crate::report::aimed::AimedFile>(),
        Self::written::<trade::TradeFile>(),
        Self::written::<u_curve::UCurveFile>(),
        Self::written::<MaterialsFile>(),
        Self::written::<mistakes::ErrorFile>(),
        Self::of::<Data>(),
    ];

    const fn of<D: Document>() -> Self {
        Self { name: D::NAME, schema: of::<D> }
    }

    const fn written<D: Document>() -> Self {
        Self::of::<Written<D>>()
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
