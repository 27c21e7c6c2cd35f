//! How it is written down what a bat carries, what holds it and what was measured on it.

use crate::base::error::{Error, Result};
use crate::base::mistakes::{self, Mistakes};
use crate::base::units::Quantity;
use crate::bat::body::Weighed;
use crate::bat::fixtures::{
    Absorber, Attachment, Fixtures, Grip, Held, Joint, Region, Support, Tape,
};
use crate::bat::layup::Layup;
use crate::bat::material::Material;
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
        attachments: mistakes.note(list(root, "attachments", |node| attachment(node, on))),
        tapes: mistakes.note(list(root, "tapes", |node| tape(node, on))),
        absorbers: mistakes.note(list(root, "absorbers", |node| absorber(node, on))),
        joints: mistakes.note(list(root, "joints", |node| joint(node, on))),
        supports: mistakes.note(list(root, "supports", |node| support(node, on))),
        grip: mistakes.note(root.get("grip").map(|node| grip(node, on)).transpose()),
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

fn attachment(node: &Node, on: &On) -> Result<Attachment> {
    let kinds = ["mass", "rotary_inertia", "stiffness", "rotational_stiffness"];
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let object = node.object(&[&["x", "offset"], &kinds[..]].concat(), &mut keys)?;
    values.note(object.require_some(&kinds));
    if object.get("offset").is_some() {
        let mass = object.require("mass", "the \"mass\" whose centre has that \"offset\"");
        values.note(mass.map(|_| ()));
    }
    let mut or_zero = |key, quantity| values.note(or_zero(&object, key, quantity));
    let mut attachment = Attachment {
        x: 0.0,
        mass: or_zero("mass", Quantity::Mass),
        offset: or_zero("offset", Quantity::Length),
        rotary_inertia: or_zero("rotary_inertia", Quantity::Inertia),
        stiffness: or_zero("stiffness", Quantity::Stiffness),
        rotational_stiffness: or_zero("rotational_stiffness", Quantity::RotationalStiffness),
    };
    attachment.x = values.note(place(&object, "x", on));
    keys.and(values.end(attachment).and_then(|a| on.checked(node, a, Attachment::check)))
}

fn tape(node: &Node, on: &On) -> Result<Tape> {
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let object = node.object(&["from", "to", "mass"], &mut keys)?;
    let mass = object.require("mass", "the \"mass\" that is spread there");
    let tape = Tape {
        from: values.note(place(&object, "from", on)),
        to: values.note(place(&object, "to", on)),
        mass: values.note(mass.and_then(|mass| mass.quantity(Quantity::Mass))),
    };
    keys.and(values.end(tape).and_then(|tape| on.checked(node, tape, Tape::check)))
}

fn absorber(node: &Node, on: &On) -> Result<Absorber> {
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let object = node.object(&["x", "mass", "stiffness", "frequency", "damping"], &mut keys)?;
    let mass = object.require("mass", "the \"mass\" that hangs there");
    let mass = values.note(mass.and_then(|mass| mass.quantity(Quantity::Mass)));
    let absorber = Absorber {
        x: values.note(place(&object, "x", on)),
        mass,
        stiffness: values.note(spring(&object, mass)),
        damping: values.note(or_zero(&object, "damping", Quantity::Damping)),
    };
    keys.and(values.end(absorber).and_then(|a| on.checked(node, a, Absorber::check)))
}

/// The stiffness under a mass (kg), or that with which it swings as fast as it is said to.
fn spring(object: &Object, mass: f64) -> Result<f64> {
    match object.one_of(&["stiffness", "frequency"])? {
        Some(("stiffness", node)) => node.quantity(Quantity::Stiffness),
        Some((_, node)) => {
            let frequency = node.quantity(Quantity::Frequency)?;
            if frequency <= 0.0 {
                return Err(node.error(node.shown(), "a frequency above 0"));
            }
            Ok(mass * (std::f64::consts::TAU * frequency).powi(2))
        }
        None => {
            let found = "no \"stiffness\" and no \"frequency\"";
            let expected = "one of them: the spring, or how fast it swings alone";
            Err(object.node.error(found, expected))
        }
    }
}

fn joint(node: &Node, on: &On) -> Result<Joint> {
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let object = node.object(&["x", "rotational_stiffness"], &mut keys)?;
    let expected = "\"rotational_stiffness\": the bending moment per angle";
    let spring = object.require("rotational_stiffness", expected);
    let spring = spring.and_then(|node| node.quantity(Quantity::RotationalStiffness));
    let joint = Joint {
        x: values.note(place(&object, "x", on)),
        rotational_stiffness: values.note(spring),
    };
    keys.and(values.end(joint).and_then(|joint| on.checked(node, joint, Joint::check)))
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

fn grip(node: &Node, on: &On) -> Result<Grip> {
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let object = node.object(&["from", "to", "stiffness", "damping"], &mut keys)?;
    values.note(object.require_some(&["stiffness", "damping"]));
    let grip = Grip {
        from: values.note(place(&object, "from", on)),
        to: values.note(place(&object, "to", on)),
        stiffness: values.note(or_zero(&object, "stiffness", Quantity::BedStiffness)),
        damping: values.note(or_zero(&object, "damping", Quantity::BedDamping)),
    };
    keys.and(values.end(grip).and_then(|grip| on.checked(node, grip, Grip::check)))
}

/// A place on the bat; the tip in other digits than the profile's is the tip.
fn place(object: &Object, key: &str, on: &On) -> Result<f64> {
    let expected = format!("\"{key}\": a place on the bat, from the knob end");
    let x = object.require(key, &expected)?.quantity(Quantity::Length)?;
    let tip = on.length.filter(|length| (x - length).abs() <= 1e-12 * length);
    Ok(tip.unwrap_or(x))
}

fn or_zero(object: &Object, key: &str, quantity: Quantity) -> Result<f64> {
    Ok(object.quantity(key, quantity)?.unwrap_or(0.0))
}
