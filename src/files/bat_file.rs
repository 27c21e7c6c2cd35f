//! How is a bat written in a file? The `sweetspot-bat/1` format, read and checked.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::base::{Complaint, Error, Mistakes, Quantity, Result, mistakes, units};
use crate::bat::material::{UNTOLD_DENSITY, UNTOLD_MODULUS};
use crate::bat::{Bat, Formula, FormulaPiece, Interpolation, Material, Profile, Weighed};
use crate::files::document::Document;
use crate::files::edits_file;
use crate::files::fixtures_file;
use crate::files::folder::{Folder, Outside};
use crate::files::json_node::{Node, Object};
use crate::files::part_file;
use crate::files::station_table::{COLUMNS, StationTable};

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
    "edits",
    "$schema",
];
/// The members of a profile besides its columns.
const OF_PROFILE: [&str; 5] = ["interpolation", "unit", "measured_from", "csv", "pieces"];
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
    /// [`Error::Read`] if there is no such file; [`Error::Input`] with line and column, or several, if anything in it
    /// is wrong or impossible.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self> {
        Self::with_text(path).map(|(bat, _)| bat)
    }

    /// The bat of a file, and the text of the file: a pipe can be read only once.
    ///
    /// # Errors
    ///
    /// As [`Self::from_file`].
    pub fn with_text(path: impl AsRef<Path>) -> Result<(Self, String)> {
        let path = path.as_ref();
        let document = Document::read(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let bat = from_document(&document, &Folder::closed(folder))?;
        Ok((bat, document.text))
    }

    /// Reads a bat file that a person has named. Its `csv` may be anywhere; if it is outside the bat file's folder, the
    /// caller must inform the person.
    ///
    /// # Errors
    ///
    /// As [`Self::from_file`].
    pub fn named_by_a_person(path: impl AsRef<Path>) -> Result<Named> {
        let path = path.as_ref();
        let document = Document::read(path)?;
        let outside = Outside::default();
        let bat = from_document(&document, &Folder::of(path, &outside))?;
        Ok(Named { bat, text: document.text, outside: outside.paths() })
    }

    /// Reads a bat from text; `file` is its name in messages, and a `csv` is looked up in `folder`.
    ///
    /// ```
    /// use sweetspot::Bat;
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// let text = r#"{ "format": "sweetspot-bat/1", "name": "dowel", "material": "white-ash",
    ///     "profile": { "unit": "in", "x": [0, 33], "diameter": [1.7, 1.7] } }"#;
    /// let bat = Bat::from_text("dowel.json", text, "".as_ref())?;
    /// assert_eq!(bat.length(), 33.0 * 0.0254);
    /// let wrong = Bat::from_text("dowel.json", &text.replace("1.7]", "\"1.7 oz\"]"), "".as_ref());
    /// let said = wrong.unwrap_err().to_string();
    /// assert!(said.starts_with("dowel.json:2:64: profile.diameter[1]: found unit \"oz\""), "{said}");
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::from_file`].
    pub fn from_text(file: &str, text: &str, folder: &Path) -> Result<Self> {
        Self::from_text_in(file, text, &Folder::closed(folder))
    }

    /// Reads a bat from text as [`Self::from_text`]; its `csv` is looked up in `folder`, which may allow files
    /// elsewhere.
    pub fn from_text_in(file: &str, text: &str, folder: &Folder) -> Result<Self> {
        from_document(&Document::new(file.to_owned(), text), folder)
    }
}

/// A bat file that a person has named.
#[derive(Debug, Clone)]
pub struct Named {
    /// The bat.
    pub bat: Bat,
    /// The text of its file.
    pub text: String,
    /// Files outside the bat file's folder that were read for it.
    pub outside: Vec<PathBuf>,
}

/// The profile of a table of stations (CSV), and whether it is in inches; `file` is its name in messages.
///
/// # Errors
///
/// [`Error::Input`] with line and column, or several of them.
pub fn profile_of_table(file: &str, text: &str) -> Result<(Profile, bool)> {
    let table = StationTable::from_csv(Document::new(file.to_owned(), text), 1.0)?;
    let profile = table.stations(Interpolation::Pchip).and_then(Profile::new);
    let inches = table.in_inches();
    profile.map(|profile| (profile, inches)).map_err(|error| table.locate(error))
}

/// A profile of a bat file in `folder`, with the columns of its table in place of the table's name: bare numbers in the
/// unit of the profile.
///
/// # Errors
///
/// [`Error::Value`] for a mistake in the profile, [`Error::Input`] with line and column for one in the table.
pub fn without_table(profile: &Value, folder: &Folder) -> Result<Value> {
    const NAME: &str = "";
    let document = Document::new(NAME.to_owned(), &profile.to_string());
    let mut profile = profile.clone();
    let mut read = || {
        let root = Node::root(&document)?.members()?;
        let (name, factor) = length_unit(&root)?;
        let table = table(root, folder, (&name, factor))?;
        let columns = table.columns().map(|(key, values)| {
            (key.to_owned(), values.iter().map(|value| value / factor).collect::<Value>())
        });
        if let Some(profile) = profile.as_object_mut() {
            profile.remove("csv");
            profile.extend(columns);
        }
        Ok(())
    };
    match read() {
        Ok(()) => Ok(profile),
        Err(Error::Input { place, complaint }) if place.file == NAME => {
            Err(Error::Value(complaint))
        }
        Err(error) => Err(error),
    }
}

/// The unit of a profile's bare numbers, and its length in m.
fn length_unit(object: &Object) -> Result<(String, f64)> {
    let Some(node) = object.get("unit") else { return Ok(("m".to_owned(), 1.0)) };
    let unit = node.string()?;
    let factor = units::factor(&unit, Quantity::Length);
    factor.map_err(|complaint| node.complain(complaint)).map(|factor| (unit, factor))
}

fn from_document(document: &Document, folder: &Folder) -> Result<Bat> {
    let root = Node::root(document)?.members()?;
    // Checked before the keys, because another format may have other keys.
    root.check_format("sweetspot-bat/1")?;
    let mut mistakes = Mistakes::default();
    let root = root.only(KEYS, &mut mistakes);
    mistakes.note(root.require("format", "\"format\": \"sweetspot-bat/1\"").map(|_| ()));
    // This member is for editors.
    mistakes.note(root.string("$schema"));
    let name = mistakes.note(root.string("name"));
    let source = mistakes.note(root.string("source"));
    let node = mistakes.some(root.require("profile", "a profile"));
    let profile = node.and_then(|node| profile(node, folder, &mut mistakes));
    let length = profile.as_ref().map(|(profile, _)| profile.length());
    let weighed = mistakes.some(fixtures_file::weighed(&root, length));
    let material = mistakes.some(material(&root, weighed.as_ref()));
    // A valid stand-in for a material that could not be read; no bat is made of it.
    let sound = || Material::new(700.0, 14e9).expect("both are above 0");
    let material = material.unwrap_or_else(sound);
    let on = fixtures_file::On { material: &material, length };
    let fixtures = fixtures_file::read(&root, &on, &mut mistakes);
    let edits = mistakes.note(edits_file::read(&root));
    let placed = |error: Error| error.placed(|complaint| root.node.locate(complaint));
    let weighed = weighed.unwrap_or_default();
    mistakes.end(())?;
    let (profile, inches) = profile.expect("a profile that could not be read was noted");
    let name = name.unwrap_or_else(|| "unnamed bat".to_owned());
    let bat = Bat::builder(profile, material).name(name).source(source.unwrap_or_default());
    let bat = bat.inches(inches).fixtures(fixtures).weighed(weighed).build();
    bat.and_then(|bat| bat.edited(&edits)).map_err(placed)
}

/// The bat's own material. A weighed mass or a tapped frequency may replace a density or a modulus; if it could not be
/// read, no replacement is demanded.
fn material(root: &Object, weighed: Option<&Weighed>) -> Result<Material> {
    let regions = root.get("regions").is_some();
    let without_density = match (weighed.map(|weighed| weighed.mass), regions) {
        (Some(None), _) => Err("\"density\" here or \"mass\" in \"weighed\""),
        (Some(Some(_)), true) => Err("\"density\": the weighed mass is one factor for all regions"),
        // The weighed mass will set it; any positive number will do.
        (Some(Some(_)), false) | (None, _) => Ok(UNTOLD_DENSITY),
    };
    let without_modulus = match (weighed.map(|weighed| weighed.first_bending), regions) {
        (Some(None), _) => {
            Err("\"youngs_modulus\", such as \"18.1 GPa\", or \"first_bending_hz\" in \"weighed\"")
        }
        (Some(Some(_)), true) => {
            Err("\"youngs_modulus\": the tapped frequency is one factor for all regions")
        }
        // The tap will set it.
        (Some(Some(_)), false) | (None, _) => Ok(UNTOLD_MODULUS),
    };
    part_file::material(root.require("material", "a material")?, without_density, without_modulus)
}

/// The profile, and whether it is in inches; `None` if anything but its keys is wrong.
fn profile(node: &Node, folder: &Folder, mistakes: &mut Mistakes) -> Option<(Profile, bool)> {
    let keys = [&OF_PROFILE[..], &COLUMNS].concat();
    let object = node.object(&keys, mistakes);
    let object = mistakes.some(object)?;
    let from_tip = object.get("measured_from");
    let from_tip = from_tip.map(|node| node.word(&[("knob", false), ("tip", true)])).transpose();
    let from_tip = mistakes.some(from_tip);
    let profile = match object.get("pieces") {
        Some(pieces) => formulas(&object, pieces).map(|profile| (profile, false)),
        None => columns(object, folder),
    };
    let (profile, inches) = mistakes.some(profile)?;
    let from_tip = from_tip?.unwrap_or(false);
    Some((if from_tip { profile.reversed() } else { profile }, inches))
}

/// Formulas, in the `pieces` of a `profile` object.
fn formulas(object: &Object, node: &Node) -> Result<Profile> {
    let mut mistakes = Mistakes::default();
    let own = |key: &&&str| !["pieces", "measured_from"].contains(*key);
    for key in OF_PROFILE.iter().filter(own).chain(&COLUMNS) {
        if let Some(node) = object.get(key) {
            let expected = "\"pieces\" alone: formulas give the radius in m from x in m";
            mistakes.add(node.key().error(format!("\"{key}\" beside \"pieces\""), expected));
        }
    }
    mistakes.and(node.items().and_then(|items| {
        if items.is_empty() {
            return Err(node.error("an empty list", "one piece at least"));
        }
        let pieces: Vec<FormulaPiece> = mistakes::all(items.iter().map(formula_piece))?;
        let placed = |mut complaint: Complaint| {
            // The field is `pieces[k].key`: the place of its value, or of the piece.
            let field = std::mem::take(&mut complaint.field);
            object.node.nearest(&field).complain(complaint)
        };
        Profile::from_formulas(pieces).map_err(|error| error.placed(placed))
    }))
}

fn formula_piece(node: &Node) -> Result<FormulaPiece> {
    let mut mistakes = Mistakes::default();
    let piece = node.object(&["from", "to", "formula", "inner_formula"], &mut mistakes)?;
    let end = |key: &str, expected: &str| piece.require(key, expected)?.quantity(Quantity::Length);
    let formula = |node: &Node| {
        let text = node.string().map_err(|_| {
            node.error(node.shown(), "a formula in quotes, such as \"0.0125 + 0.02*x\"")
        })?;
        Formula::parse_in_place(&text).map_err(|(said, part)| node.complain_of(part, said))
    };
    let from = mistakes.note(end("from", "\"from\": where the piece begins"));
    let to = mistakes.note(end("to", "\"to\": where the piece ends"));
    let outer = piece.require("formula", "\"formula\": the outer radius in m");
    let outer = outer.and_then(formula);
    let inner = mistakes.note(piece.get("inner_formula").map(formula).transpose());
    mistakes.and(outer.map(|outer| FormulaPiece { from, to, outer, inner }))
}

/// Columns of stations, in a `profile` object itself or in the CSV file that it names, and whether they are in inches.
fn columns(object: Object, folder: &Folder) -> Result<(Profile, bool)> {
    let mut mistakes = Mistakes::default();
    let unit = length_unit(&object);
    let interpolation = match object.get("interpolation") {
        Some(node) => node.word(INTERPOLATIONS),
        None => Ok(Interpolation::Pchip),
    };
    // Straight lines demand least of the stations.
    let interpolation = mistakes.some(interpolation).unwrap_or(Interpolation::Linear);
    let table = mistakes.some(table(
        object,
        folder,
        unit.as_ref().map_or(("m", 1.0), |unit| (&unit.0, unit.1)),
    ));
    // Without a unit, places and radii cannot be checked.
    let profile = unit.and_then(|_| {
        let Some(table) = table else { return Ok(None) };
        let profile = table.stations(interpolation).and_then(Profile::new);
        let inches = table.in_inches();
        profile.map(|profile| Some((profile, inches))).map_err(|error| table.locate(error))
    });
    mistakes.and(profile).map(|profile| profile.expect("a table that could not be read was noted"))
}

/// The columns that a `profile` object has, or the CSV file that it names.
fn table<'a>(object: Object<'a>, folder: &Folder, unit: (&str, f64)) -> Result<StationTable<'a>> {
    let Some(node) = object.get("csv") else { return StationTable::from_json(object, unit) };
    let mut mistakes = Mistakes::default();
    for key in COLUMNS {
        if let Some(node) = object.get(key) {
            let found = format!("\"{key}\" beside \"csv\"");
            mistakes.add(node.key().error(found, "the columns in the csv file alone"));
        }
    }
    mistakes.and(node.string().and_then(|name| {
        let document = folder.table(&name, &COLUMNS).map_err(|error| match error {
            Error::Read { path, source } => node.error(
                format!("{}, which cannot be read ({source})", path.display()),
                "a CSV file, sought from the folder of this one",
            ),
            error => error.placed(|complaint| node.complain(complaint)),
        })?;
        StationTable::from_csv(document, unit.1)
    }))
}
