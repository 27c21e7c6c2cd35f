//! How a bat is written down: the `sweetspot-bat/1` file, read and checked.

use std::path::Path;

use crate::bat::Bat;
use crate::document::{Document, Node, Object};
use crate::error::{Error, Result};
use crate::formula::Formula;
use crate::material::{BUILT_IN, Material};
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
    "supports",
    "grip",
];
/// Keys of the format that this version does not model; refused, never ignored.
const NOT_YET: &[&str] = &["regions", "attachments", "supports", "grip"];
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
    /// anything in it is wrong, impossible or not supported yet.
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
    refuse(&root, NOT_YET)?;
    let weighed = weighed_mass(&root)?;
    let material = material(root.require("material", "a material")?, weighed.is_some())?;
    let profile = profile(root.require("profile", "a profile")?, folder)?;
    let name = root.string("name")?.unwrap_or_else(|| "unnamed bat".to_owned());
    let mut bat = Bat::new(name, profile, material, weighed).map_err(|error| match error {
        Error::Value(complaint) => root.node.complain(complaint),
        other => other,
    })?;
    bat.source = root.string("source")?.unwrap_or_default();
    Ok(bat)
}

fn refuse(object: &Object, keys: &[&str]) -> Result<()> {
    for key in keys {
        if let Some(node) = object.get(key) {
            let found = format!("\"{key}\", which is not supported yet");
            return Err(node.error(found, "a bat without it: nothing is silently ignored"));
        }
    }
    Ok(())
}

fn weighed_mass(root: &Object) -> Result<Option<f64>> {
    let Some(node) = root.get("weighed") else { return Ok(None) };
    let weighed = node.object(&["mass", "balance_point", "first_bending_hz"])?;
    refuse(&weighed, &["balance_point", "first_bending_hz"])?;
    let node = weighed.require("mass", "the mass that a scale shows")?;
    let mass = node.quantity(Quantity::Mass)?;
    if mass > 0.0 { Ok(Some(mass)) } else { Err(node.error(node.shown(), "a mass above 0")) }
}

fn material(node: &Node, weighed: bool) -> Result<Material> {
    if !node.is_object() {
        let named: Vec<(&str, &str)> = BUILT_IN.iter().map(|m| (m.name, m.name)).collect();
        let name = node.word(&named)?;
        return Ok(Material::named(name).expect("the list holds its own names"));
    }
    let object = node.object(&[
        "density",
        "youngs_modulus",
        "shear_modulus",
        "poisson_ratio",
        "shear_coefficient",
        "loss_factor",
    ])?;
    let density = match object.quantity("density", Quantity::Density)? {
        Some(density) => density,
        // The weighed mass will set it; any positive number is as good.
        None if weighed => 1.0,
        None => {
            let expected = "\"density\" here or \"mass\" in \"weighed\"";
            return Err(object.require("density", expected).err().expect("it is not there"));
        }
    };
    let modulus = object.require("youngs_modulus", "\"youngs_modulus\", such as \"18.1 GPa\"")?;
    let youngs_modulus = modulus.quantity(Quantity::Pressure)?;
    object.one_of(&["shear_modulus", "poisson_ratio"])?;
    let poisson_ratio = object.number("poisson_ratio")?;
    let material = Material {
        name: None,
        density,
        youngs_modulus,
        shear_modulus: object
            .quantity("shear_modulus", Quantity::Pressure)?
            .or(poisson_ratio.map(|nu| youngs_modulus / (2.0 * (1.0 + nu)))),
        poisson_ratio,
        shear_coefficient: object.number("shear_coefficient")?,
        loss_factor: object.number("loss_factor")?.unwrap_or(0.0),
    };
    material.check().map_err(|error| match error {
        Error::Value(mut complaint) => {
            // A value that is not in the file was made from others: its name stays then.
            let place = object.get(&complaint.field);
            if let Some(place) = place {
                complaint.field.clear();
                complaint.found = place.shown();
            }
            place.unwrap_or(node).complain(complaint)
        }
        other => other,
    })?;
    Ok(material)
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
            let place = field.strip_prefix("pieces[").and_then(|rest| rest.split_once("]."));
            let item = place.and_then(|(k, key)| Some((items.get(k.parse::<usize>().ok()?)?, key)));
            let Some((item, key)) = item else { return node.complain(complaint) };
            let value = item.members().ok().and_then(|members| members.get(key).cloned());
            value.as_ref().unwrap_or(item).complain(complaint)
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
