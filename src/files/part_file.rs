//! How is a material or a fixture written in a file? Reading follows its list of members.

use crate::base::{Error, Mistakes, Result, mistakes};
use crate::bat::part::{Field, Instead, MemberKind, Part, Slot};
use crate::bat::{BUILT_IN, Held, Layer, Material, PoissonRatios, ShearModuli};
use crate::files::json_node::{Node, Object};

/// The names of the kinds of supports.
const HELD: [(&str, Held); 2] = [("pinned", Held::Pinned), ("clamped", Held::Clamped)];

/// A stand-in for a number that the file omits, or the expected text.
pub(crate) type Without<'a> = std::result::Result<f64, &'a str>;

/// A part on a bat of that length (m), if that is known; a member that the file omits is as in `start`.
///
/// # Errors
///
/// The mistakes in its keys and its values; if all values could be read, also the mistakes of the part as a whole.
pub(crate) fn part<P: Part>(node: &Node, start: P, length: Option<f64>) -> Result<P> {
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let object = node.object(&known::<P>(), &mut keys)?;
    if !P::SOME.is_empty() {
        values.note(object.require_some(P::SOME));
    }
    let part = filled(&object, start, length, &mut values);
    let part = values.end(part).and_then(|part| match length {
        Some(length) => checked(node, part, length),
        None => Ok(part),
    });
    keys.and(part)
}

/// A material by name, by numbers, or by name with other numbers; `density` and `modulus` apply if the file omits them.
pub(crate) fn material(node: &Node, density: Without, modulus: Without) -> Result<Material> {
    if !node.is_object() {
        return named(node);
    }
    let (mut keys, mut values) = (Mistakes::default(), Mistakes::default());
    let own: Vec<&str> = known::<Material>().into_iter().chain(["name"]).collect();
    let object = node.object(&own, &mut keys)?;
    let start = match object.get("name") {
        Some(name) => values.some(named(name)),
        None => {
            values.note(needed(&object, "density", density));
            // A shear modulus would scale with a modulus that is only a start value.
            let modulus = match object.get("shear_modulus") {
                Some(_) => Err("\"youngs_modulus\" beside \"shear_modulus\", such as \"18.1 GPa\""),
                None => modulus,
            };
            values.note(needed(&object, "youngs_modulus", modulus));
            None
        }
    };
    // A value that could not be read must not be reported a second time.
    let blank = || Material::new(density.unwrap_or(1.0), modulus.unwrap_or(1.0));
    let start = start.unwrap_or_else(|| blank().expect("both are above 0"));
    let material = filled(&object, start, None, &mut values);
    // A value that could not be read still has its start value, which is possible.
    let material = checked(node, material, 0.0);
    keys.and(values.and(material).map(|mut material| {
        let (e, nu) = (material.youngs_modulus, material.poisson_ratio);
        let made = nu.map(|nu| e / (2.0 * (1.0 + nu)));
        material.shear_modulus = material.shear_modulus.or(made);
        // With other numbers it is no longer the built-in material of that name.
        let changed = Material::FIELDS.iter().any(|field| object.get(field.key).is_some());
        material.name = material.name.filter(|_| !changed);
        material
    }))
}

/// A material whose numbers may not be replaced by measured values.
pub fn whole_material(node: &Node) -> Result<Material> {
    let density = Err("\"density\", such as \"0.6 g/cm^3\"");
    let modulus = Err("\"youngs_modulus\", such as \"18.1 GPa\"");
    material(node, density, modulus)
}

/// A material of the built-in list.
fn named(node: &Node) -> Result<Material> {
    let names: Vec<(&str, &str)> = BUILT_IN.iter().map(|m| (m.name, m.name)).collect();
    let name = node.word(&names)?;
    Ok(Material::named(name).expect("the list holds its own names"))
}

fn needed(object: &Object, key: &str, without: Without) -> Result<()> {
    match without {
        Err(expected) => object.require(key, expected).map(|_| ()),
        Ok(_) => Ok(()),
    }
}

/// The keys of a part.
fn known<P: Part>() -> Vec<&'static str> {
    let fields = P::FIELDS.iter().map(|field| field.key);
    fields.chain(P::INSTEAD.map(|instead| instead.key)).collect()
}

/// The part with every member that the file has.
fn filled<P: Part>(
    object: &Object,
    mut part: P,
    length: Option<f64>,
    mistakes: &mut Mistakes,
) -> P {
    for field in P::FIELDS {
        mistakes.note(member(object, field, length, &mut part));
        if let Some((other, expected)) = field.with.filter(|_| object.get(field.key).is_some()) {
            mistakes.note(object.require(other, expected).map(|_| ()));
        }
    }
    if let Some(instead) = P::INSTEAD {
        mistakes.note(replaced(object, &instead, &mut part));
    }
    part
}

/// The part, if it is possible on a bat of that length (m).
fn checked<P: Part>(node: &Node, part: P, length: f64) -> Result<P> {
    let placed = |error: Error| error.placed(|complaint| node.locate(complaint));
    part.check(&node.path, length).map_err(placed).map(|()| part)
}

/// Reads one member, if the file has it.
fn member<P>(object: &Object, field: &Field<P>, length: Option<f64>, part: &mut P) -> Result<()> {
    let node = match (object.get(field.key), field.needed) {
        (Some(node), _) => node,
        (None, None) => return Ok(()),
        (None, Some(expected)) if field.is_place() => {
            return object
                .require(field.key, &format!("\"{}\": {expected}", field.key))
                .map(|_| ());
        }
        (None, Some(expected)) => return object.require(field.key, expected).map(|_| ()),
    };
    match (field.of)(part) {
        Slot::Number(value) => *value = number(node, field, length)?,
        Slot::Unknown(value) => *value = Some(number(node, field, length)?),
        Slot::Held(held) => *held = node.word(&HELD)?,
        Slot::Material(outer) => *outer = whole_material(node)?,
        Slot::Core(core) => *core = Some(whole_material(node)?),
        Slot::ShearModuli(moduli) => {
            *moduli = Some(self::part(node, ShearModuli::default(), None)?)
        }
        Slot::PoissonRatios(ratios) => {
            *ratios = Some(self::part(node, PoissonRatios::default(), None)?);
        }
        Slot::Layers(layers) => {
            let blank = || Material::new(1.0, 1.0).expect("both are above 0");
            let start = || Layer { thickness: 0.0, material: blank() };
            let items = node.items()?;
            if items.is_empty() {
                return Err(node.error(node.shown(), "one layer at least"));
            }
            *layers = mistakes::all(items.iter().map(|item| self::part(item, start(), None)))?;
        }
    }
    Ok(())
}

/// A number; a place that equals the tip to round-off is the tip.
fn number<P>(node: &Node, field: &Field<P>, length: Option<f64>) -> Result<f64> {
    let MemberKind::Number(Some(quantity), _) = field.kind else { return node.number() };
    let value = node.quantity(quantity)?;
    let near = |length: &f64| field.is_place() && (value - length).abs() <= 1e-12 * length;
    Ok(length.filter(near).unwrap_or(value))
}

/// Sets the number from its replacement, if the file has that.
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
