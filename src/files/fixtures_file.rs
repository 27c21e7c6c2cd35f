//! How it is written down what a bat carries, what holds it and what was measured on it.

use crate::base::error::{Error, Result};
use crate::base::mistakes::{self, Mistakes};
use crate::base::units::Quantity;
use crate::bat::body::Weighed;
use crate::bat::fixtures::{Fixtures, Held, Region, Support};
use crate::bat::layup::Layup;
use crate::bat::material::Material;
use crate::bat::part::{Field, Instead, Part};
use crate::files::json_node::{Node, Object};
use crate::files::material_file;

/// What a fixture is on: the bat's material, and its length (m) if that could be read.
pub(crate) struct On<'a> {
    pub material: &'a Material,
    pub length: Option<f64>,
}

impl On<'_> {
    /// A fixture that was read, if it can be there.
    fn checked<T>(
        &self,
        node: &Node,
        item: T,
        check: impl Fn(&T, &str, f64) -> Result<()>,
    ) -> Result<T> {
        if let Some(length) = self.length {
            let placed = |error: Error| error.placed(|complaint| node.locate(complaint));
            check(&item, &node.path, length).map_err(placed)?;
        }
        Ok(item)
    }
}

/// The fixtures of a bat file.
pub(crate) fn read(root: &Object, on: &On, mistakes: &mut Mistakes) -> Fixtures {
    Fixtures {
        regions: mistakes.note(list(root, "regions", |node| region(node, on))),
        attachments: mistakes.note(list(root, "attachments", |node| part(node, on))),
        tapes: mistakes.note(list(root, "tapes", |node| part(node, on))),
        absorbers: mistakes.note(list(root, "absorbers", |node| part(node, on))),
        joints: mistakes.note(list(root, "joints", |node| part(node, on))),
        supports: mistakes.note(list(root, "supports", |node| support(node, on))),
        grip: mistakes.note(root.get("grip").map(|node| part(node, on)).transpose()),
    }
}

/// What a scale and a tap said, as far as the file tells.
pub(crate) fn weighed(root: &Object) -> Result<Weighed> {
    let Some(node) = root.get("weighed") else { return Ok(Weighed::default()) };
    let keys = ["mass", "balance_point", "first_bending_hz"];
    let mut mistakes = Mistakes::default();
    let object = node.object(&keys, &mut mistakes)?;
    mistakes.note(object.require_some(&keys));
    let weighed = Weighed {
        mass: mistakes.note(object.quantity("mass", Quantity::Mass)),
        balance_point: mistakes.note(object.quantity("balance_point", Quantity::Length)),
        first_bending: mistakes.note(object.quantity("first_bending_hz", Quantity::Frequency)),
    };
    mistakes.end(weighed)
}

fn list<T>(root: &Object, key: &str, read: impl Fn(&Node) -> Result<T>) -> Result<Vec<T>> {
    let Some(node) = root.get(key) else { return Ok(vec![]) };
    mistakes::all(node.items()?.iter().map(read))
}

// Each of these tells what is wrong with its keys and with its values; only where all values could
// be read it tells whether the whole can be there.

fn region(node: &Node, on: &On) -> Result<Region> {
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let object = node.object(&["from", "to", "material", "core"], &mut keys)?;
    values.note(object.require_some(&["material", "core"]));
    let material = |key: &str| {
        let density = Err("\"density\", such as \"0.6 g/cm^3\"");
        let modulus = Err("\"youngs_modulus\", such as \"18.1 GPa\"");
        let read = |node| material_file::read(node, density, modulus);
        object.get(key).map(read).transpose()
    };
    let outer = values.note(material("material")).unwrap_or_else(|| on.material.clone());
    let region = Region {
        from: values.note(place(&object, "from", on)),
        to: values.note(place(&object, "to", on)),
        layup: Layup { core: values.note(material("core")), ..Layup::of(outer) },
    };
    keys.and(values.end(region).and_then(|region| on.checked(node, region, Region::check)))
}

/// A part that is a list of numbers.
fn part<P: Part>(node: &Node, on: &On) -> Result<P> {
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let known = P::FIELDS.iter().map(|field| field.key);
    let known: Vec<&str> = known.chain(P::INSTEAD.map(|instead| instead.key)).collect();
    let object = node.object(&known, &mut keys)?;
    if !P::SOME.is_empty() {
        values.note(object.require_some(P::SOME));
    }
    let mut part = P::default();
    for field in P::FIELDS {
        *(field.of)(&mut part) = values.note(number(&object, field, on));
        if let Some((other, expected)) = field.with.filter(|_| object.get(field.key).is_some()) {
            values.note(object.require(other, expected).map(|_| ()));
        }
    }
    if let Some(instead) = P::INSTEAD {
        values.note(replaced(&object, &instead, &mut part));
    }
    keys.and(values.end(part).and_then(|part| on.checked(node, part, P::check)))
}

fn number<P>(object: &Object, field: &Field<P>, on: &On) -> Result<f64> {
    let Field { key, quantity, .. } = *field;
    match field.needed {
        _ if field.is_place() => place(object, key, on),
        Some(expected) => object.require(key, expected)?.quantity(quantity),
        None => Ok(object.quantity(key, quantity)?.unwrap_or(0.0)),
    }
}

/// Sets the number that is given by something else, if it is.
fn replaced<P>(object: &Object, instead: &Instead<P>, part: &mut P) -> Result<()> {
    let Instead { key, of, quantity, .. } = *instead;
    match object.one_of(&[of, key])? {
        Some((found, node)) if found == key => {
            let value = node.quantity(quantity)?;
            if value <= 0.0 {
                return Err(node.error(node.shown(), format!("{} above 0", quantity.name())));
            }
            (instead.set)(part, value);
            Ok(())
        }
        Some(_) => Ok(()),
        None => {
            let found = format!("no \"{of}\" and no \"{key}\"");
            Err(object.node.error(found, instead.expected))
        }
    }
}

fn support(node: &Node, on: &On) -> Result<Support> {
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let object = node.object(&["x", "type"], &mut keys)?;
    let kinds = [("pinned", Held::Pinned), ("clamped", Held::Clamped)];
    let kind = object.require("type", "\"type\": \"pinned\" or \"clamped\"");
    let kind = values.some(kind.and_then(|node| node.word(&kinds))).unwrap_or(Held::Pinned);
    let support = Support { x: values.note(place(&object, "x", on)), kind };
    keys.and(values.end(support).and_then(|support| on.checked(node, support, Support::check)))
}

/// A place on the bat; the tip in other digits than the profile's is the tip.
fn place(object: &Object, key: &str, on: &On) -> Result<f64> {
    let expected = format!("\"{key}\": a place on the bat, from the knob end");
    let x = object.require(key, &expected)?.quantity(Quantity::Length)?;
    let tip = on.length.filter(|length| (x - length).abs() <= 1e-12 * length);
    Ok(tip.unwrap_or(x))
}
