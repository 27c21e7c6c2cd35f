//! How a bat is written down: the `sweetspot-bat/1` file, read and checked.

use std::path::Path;

use crate::bat::Bat;
use crate::document::{Document, Node, Object};
use crate::error::{Error, Result};
use crate::fixtures_file;
use crate::formula::Formula;
use crate::material_file;
use crate::profile::{FormulaPiece, Interpolation, Profile};
use crate::station_table::Table;
use crate::units::{self, Quantity};

const KEYS: &[&str] = &[
    "format",
    "name",
    "source",
    "material",
    "profile",
    "weighed",
    "regions",
    "attachments",
    "tapes",
    "absorbers",
    "joints",
    "supports",
    "grip",
    "comment",
];
const PROFILE_KEYS: &[&str] = &[
    "interpolation",
    "unit",
    "measured_from",
    "csv",
    "pieces",
    "x",
    "radius",
    "diameter",
    "inner_radius",
    "inner_diameter",
    "wall_thickness",
    "comment",
];
const INTERPOLATIONS: &[(&str, Interpolation)] = &[
    ("pchip", Interpolation::Pchip),
    ("linear", Interpolation::Linear),
    ("constant", Interpolation::Constant),
];

impl Bat {
    /// Reads a bat file.
    ///
    /// # Errors
    ///
    /// [`Error::Read`] if there is no such file, [`Error::Input`] with line and column if
    /// anything in it is wrong or impossible.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        from_document(&Document::read(path)?, &folder)
    }

    /// Reads a bat from text; `file` is what messages call it, a `csv` is sought in `folder`.
    ///
    /// # Errors
    ///
    /// As [`Self::from_file`].
    pub fn from_text(file: &str, text: &str, folder: &Path) -> Result<Self> {
        from_document(&Document::new(file.to_owned(), text), folder)
    }
}

fn from_document(document: &Document, folder: &Path) -> Result<Bat> {
    let root = document.root()?.members()?;
    // Before the keys are looked at: another format may have others.
    if let Some(format) = root.get("format")
        && format.string().ok().as_deref() != Some("sweetspot-bat/1")
    {
        return Err(format.error(format.shown(), "\"sweetspot-bat/1\""));
    }
    let root = root.only(KEYS)?;
    root.require("format", "\"format\": \"sweetspot-bat/1\"")?;
    let weighed = fixtures_file::weighed(&root)?;
    let without_density = match (weighed.mass, root.get("regions")) {
        (None, _) => Err("\"density\" here or \"mass\" in \"weighed\""),
        (Some(_), Some(_)) => Err("\"density\": the weighed mass is one factor for all regions"),
        // The weighed mass will set it; any positive number is as good.
        (Some(_), None) => Ok(1.0),
    };
    let node = root.require("material", "a material")?;
    let without_modulus = match (weighed.first_bending, root.get("regions")) {
        (None, _) => {
            Err("\"youngs_modulus\", such as \"18.1 GPa\", or \"first_bending_hz\" in \"weighed\"")
        }
        (Some(_), Some(_)) => {
            Err("\"youngs_modulus\": the tapped frequency is one factor for all regions")
        }
        // The tap will set it; a wood's is a good beginning.
        (Some(_), None) => Ok(1e10),
    };
    let material = material_file::read(node, without_density, without_modulus)?;
    let profile = profile(root.require("profile", "a profile")?, folder)?;
    let fixtures = fixtures_file::read(&root, &material, profile.length())?;
    let name = root.string("name")?.unwrap_or_else(|| "unnamed bat".to_owned());
    let bat = Bat::with_fixtures(name, profile, material, fixtures, weighed);
    let mut bat = bat.map_err(|error| match error {
        Error::Value(complaint) => root.node.locate(complaint),
        other => other,
    })?;
    bat.source = root.string("source")?.unwrap_or_default();
    Ok(bat)
}

fn profile(node: &Node, folder: &Path) -> Result<Profile> {
    let object = node.object(PROFILE_KEYS)?;
    let from_tip = match object.get("measured_from") {
        Some(node) => node.word(&[("knob", false), ("tip", true)])?,
        None => false,
    };
    let profile = match object.get("pieces") {
        Some(pieces) => formulas(&object, pieces)?,
        None => columns(object, folder)?,
    };
    Ok(if from_tip { profile.reversed() } else { profile })
}

/// Formulas, in the `pieces` of a `profile` object.
fn formulas(object: &Object, node: &Node) -> Result<Profile> {
    for key in PROFILE_KEYS.iter().filter(|key| !["pieces", "measured_from"].contains(key)) {
        if let Some(node) = object.get(key) {
            let expected = "\"pieces\" alone: formulas give the radius in m from x in m";
            return Err(node.error(format!("\"{key}\" beside \"pieces\""), expected));
        }
    }
    let items = node.items()?;
    if items.is_empty() {
        return Err(node.error("an empty list", "one piece at least"));
    }
    let pieces: Vec<FormulaPiece> = items.iter().map(formula_piece).collect::<Result<_>>()?;
    Profile::from_formulas(pieces).map_err(|error| match error {
        Error::Value(mut complaint) => {
            // The field is `pieces[k].key`: its value's place, or that of the piece.
            let field = std::mem::take(&mut complaint.field);
            object.node.nearest(&field).complain(complaint)
        }
        other => other,
    })
}

fn formula_piece(node: &Node) -> Result<FormulaPiece> {
    let piece = node.object(&["from", "to", "formula", "inner_formula"])?;
    let end = |key: &str, expected: &str| piece.require(key, expected)?.quantity(Quantity::Length);
    let formula = |node: &Node| {
        let text = node.string().map_err(|_| {
            node.error(node.shown(), "a formula in quotes, such as \"0.0125 + 0.02*x\"")
        })?;
        Formula::parse(&text).map_err(|complaint| node.complain(complaint))
    };
    Ok(FormulaPiece {
        from: end("from", "\"from\": where the piece begins")?,
        to: end("to", "\"to\": where the piece ends")?,
        outer: formula(piece.require("formula", "\"formula\": the outer radius in m")?)?,
        inner: piece.get("inner_formula").map(formula).transpose()?,
    })
}

/// Columns of stations, in a `profile` object itself or in the CSV file that it names.
fn columns(object: Object, folder: &Path) -> Result<Profile> {
    let unit = match object.get("unit") {
        Some(node) => units::factor(&node.string()?, Quantity::Length)
            .map_err(|complaint| node.complain(complaint))?,
        None => 1.0,
    };
    let interpolation = match object.get("interpolation") {
        Some(node) => node.word(INTERPOLATIONS)?,
        None => Interpolation::Pchip,
    };
    let table = match object.get("csv") {
        Some(node) => {
            let columns = ["x", "radius", "diameter", "inner_radius", "inner_diameter"];
            for key in columns.into_iter().chain(["wall_thickness"]) {
                if let Some(node) = object.get(key) {
                    let expected = "the columns in the csv file alone";
                    return Err(node.error(format!("\"{key}\" beside \"csv\""), expected));
                }
            }
            let path = folder.join(node.string()?);
            Table::from_csv(&path, unit).map_err(|error| match error {
                Error::Read { source, .. } => node.error(
                    format!("{}, which cannot be read ({source})", path.display()),
                    "a CSV file, sought from the folder of this one",
                ),
                other => other,
            })?
        }
        None => Table::from_json(object, unit)?,
    };
    Profile::new(table.stations(interpolation)?).map_err(|e| table.locate(e))
}
