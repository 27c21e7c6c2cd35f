//! How it is written down what a bat carries, what holds it and what was measured on it.

use crate::bat::Weighed;
use crate::document::{Node, Object};
use crate::error::Result;
use crate::fixtures::{Absorber, Attachment, Fixtures, Grip, Held, Joint, Region, Support, Tape};
use crate::layup::Layup;
use crate::material::Material;
use crate::material_file;
use crate::units::Quantity;

/// The fixtures of a bat file; the bat is of that material and length (m).
pub(crate) fn read(root: &Object, material: &Material, length: f64) -> Result<Fixtures> {
    Ok(Fixtures {
        regions: list(root, "regions", |node| region(node, material, length))?,
        attachments: list(root, "attachments", |node| attachment(node, length))?,
        tapes: list(root, "tapes", |node| tape(node, length))?,
        absorbers: list(root, "absorbers", |node| absorber(node, length))?,
        joints: list(root, "joints", |node| joint(node, length))?,
        supports: list(root, "supports", |node| support(node, length))?,
        grip: root.get("grip").map(|node| grip(node, length)).transpose()?,
    })
}

/// What a scale and a tap said, as far as the file tells.
pub(crate) fn weighed(root: &Object) -> Result<Weighed> {
    let Some(node) = root.get("weighed") else { return Ok(Weighed::default()) };
    let keys = ["mass", "balance_point", "first_bending_hz"];
    let object = node.object(&keys)?;
    object.require_some(&keys)?;
    Ok(Weighed {
        mass: object.quantity("mass", Quantity::Mass)?,
        balance_point: object.quantity("balance_point", Quantity::Length)?,
        first_bending: object.quantity("first_bending_hz", Quantity::Frequency)?,
    })
}

fn list<T>(root: &Object, key: &str, read: impl Fn(&Node) -> Result<T>) -> Result<Vec<T>> {
    let Some(node) = root.get(key) else { return Ok(vec![]) };
    node.items()?.iter().map(read).collect()
}

fn region(node: &Node, own: &Material, length: f64) -> Result<Region> {
    let object = node.object(&["from", "to", "material", "core"])?;
    object.require_some(&["material", "core"])?;
    let material = |key: &str| {
        let density = Err("\"density\", such as \"0.6 g/cm^3\"");
        let modulus = Err("\"youngs_modulus\", such as \"18.1 GPa\"");
        let read = |node| material_file::read(node, density, modulus);
        object.get(key).map(read).transpose()
    };
    let outer = material("material")?.unwrap_or_else(|| own.clone());
    Ok(Region {
        from: place(&object, "from", length)?,
        to: place(&object, "to", length)?,
        layup: Layup { core: material("core")?, ..Layup::of(outer) },
    })
}

fn attachment(node: &Node, length: f64) -> Result<Attachment> {
    let object = node.object(&[
        "x",
        "mass",
        "offset",
        "rotary_inertia",
        "stiffness",
        "rotational_stiffness",
    ])?;
    object.require_some(&["mass", "rotary_inertia", "stiffness", "rotational_stiffness"])?;
    if object.get("offset").is_some() {
        object.require("mass", "the \"mass\" whose centre has that \"offset\"")?;
    }
    Ok(Attachment {
        x: place(&object, "x", length)?,
        mass: or_zero(&object, "mass", Quantity::Mass)?,
        offset: or_zero(&object, "offset", Quantity::Length)?,
        rotary_inertia: or_zero(&object, "rotary_inertia", Quantity::Inertia)?,
        stiffness: or_zero(&object, "stiffness", Quantity::Stiffness)?,
        rotational_stiffness: or_zero(
            &object,
            "rotational_stiffness",
            Quantity::RotationalStiffness,
        )?,
    })
}

fn tape(node: &Node, length: f64) -> Result<Tape> {
    let object = node.object(&["from", "to", "mass"])?;
    let mass = object.require("mass", "the \"mass\" that is spread there")?;
    Ok(Tape {
        from: place(&object, "from", length)?,
        to: place(&object, "to", length)?,
        mass: mass.quantity(Quantity::Mass)?,
    })
}

fn absorber(node: &Node, length: f64) -> Result<Absorber> {
    let object = node.object(&["x", "mass", "stiffness", "frequency", "damping"])?;
    let mass = object.require("mass", "the \"mass\" that hangs there")?.quantity(Quantity::Mass)?;
    let stiffness = match object.one_of(&["stiffness", "frequency"])? {
        Some(("stiffness", node)) => node.quantity(Quantity::Stiffness)?,
        Some((_, node)) => {
            let frequency = node.quantity(Quantity::Frequency)?;
            if frequency <= 0.0 {
                return Err(node.error(node.shown(), "a frequency above 0"));
            }
            mass * (std::f64::consts::TAU * frequency).powi(2)
        }
        None => {
            let found = "no \"stiffness\" and no \"frequency\"";
            return Err(node.error(found, "one of them: the spring, or how fast it swings alone"));
        }
    };
    let damping = or_zero(&object, "damping", Quantity::Damping)?;
    Ok(Absorber { x: place(&object, "x", length)?, mass, stiffness, damping })
}

fn joint(node: &Node, length: f64) -> Result<Joint> {
    let object = node.object(&["x", "rotational_stiffness"])?;
    let expected = "\"rotational_stiffness\": the bending moment per angle";
    let node = object.require("rotational_stiffness", expected)?;
    let rotational_stiffness = node.quantity(Quantity::RotationalStiffness)?;
    Ok(Joint { x: place(&object, "x", length)?, rotational_stiffness })
}

fn support(node: &Node, length: f64) -> Result<Support> {
    let object = node.object(&["x", "type"])?;
    let kinds = [("pinned", Held::Pinned), ("clamped", Held::Clamped)];
    let kind = object.require("type", "\"type\": \"pinned\" or \"clamped\"")?.word(&kinds)?;
    Ok(Support { x: place(&object, "x", length)?, kind })
}

fn grip(node: &Node, length: f64) -> Result<Grip> {
    let object = node.object(&["from", "to", "stiffness", "damping"])?;
    object.require_some(&["stiffness", "damping"])?;
    Ok(Grip {
        from: place(&object, "from", length)?,
        to: place(&object, "to", length)?,
        stiffness: or_zero(&object, "stiffness", Quantity::BedStiffness)?,
        damping: or_zero(&object, "damping", Quantity::BedDamping)?,
    })
}

/// A place on the bat; the tip in other digits than the profile's is the tip.
fn place(object: &Object, key: &str, length: f64) -> Result<f64> {
    let expected = format!("\"{key}\": a place on the bat, from the knob end");
    let x = object.require(key, &expected)?.quantity(Quantity::Length)?;
    Ok(if (x - length).abs() <= 1e-12 * length { length } else { x })
}

fn or_zero(object: &Object, key: &str, quantity: Quantity) -> Result<f64> {
    Ok(object.quantity(key, quantity)?.unwrap_or(0.0))
}
