//! How a material is written down: a name, or an object of numbers.

use crate::base::error::{Complaint, Result};
use crate::base::mistakes::Mistakes;
use crate::base::units::Quantity;
use crate::bat::material::{BUILT_IN, Material};
use crate::files::json_node::Node;

/// A default for a value that the file does not give, or the words for what is expected.
pub(crate) type Without<'a> = std::result::Result<f64, &'a str>;

/// A material by name or by numbers, and what it is without a density or without a modulus.
pub(crate) fn read(node: &Node, density: Without, modulus: Without) -> Result<Material> {
    if !node.is_object() {
        let named: Vec<(&str, &str)> = BUILT_IN.iter().map(|m| (m.name, m.name)).collect();
        let name = node.word(&named)?;
        return Ok(Material::named(name).expect("the list holds its own names"));
    }
    let keys = [
        "density",
        "youngs_modulus",
        "shear_modulus",
        "poisson_ratio",
        "shear_coefficient",
        "loss_factor",
        "strength",
        "strain_to_failure",
    ];
    let mut mistakes = Mistakes::default();
    let object = node.object(&keys, &mut mistakes)?;
    let or =
        |key: &str, quantity, without: Without| match (object.quantity(key, quantity)?, without) {
            (Some(value), _) | (None, Ok(value)) => Ok(value),
            (None, Err(expected)) => Err(object.node.error(format!("no \"{key}\""), expected)),
        };
    let density = mistakes.some(or("density", Quantity::Density, density));
    // A shear modulus would grow with one that is only a beginning.
    let modulus = match object.get("shear_modulus") {
        Some(_) => Err("\"youngs_modulus\" beside \"shear_modulus\", such as \"18.1 GPa\""),
        None => modulus,
    };
    let youngs_modulus = mistakes.some(or("youngs_modulus", Quantity::Pressure, modulus));
    let poisson_ratio = mistakes.note(object.number("poisson_ratio"));
    // What was not read must not be found wrong besides.
    let (e, rho) = (youngs_modulus.unwrap_or(1.0), density.unwrap_or(1.0));
    let material = Material {
        name: None,
        density: rho,
        youngs_modulus: e,
        shear_modulus: mistakes
            .note(object.quantity("shear_modulus", Quantity::Pressure))
            .or(poisson_ratio.map(|nu| e / (2.0 * (1.0 + nu)))),
        poisson_ratio,
        shear_coefficient: mistakes.note(object.number("shear_coefficient")),
        loss_factor: mistakes.note(object.number("loss_factor")).unwrap_or(0.0),
        strength: mistakes.note(object.quantity("strength", Quantity::Pressure)),
        strain_to_failure: mistakes.note(object.number("strain_to_failure")),
    };
    let placed = |complaint: Complaint| {
        // A value that is not in the file was made from others.
        let place = object.get(&complaint.field);
        let found = place.map_or(complaint.found, Node::shown);
        let field = format!("{}.{}", node.path, complaint.field);
        place.unwrap_or(node).complain(Complaint { field, found, ..complaint })
    };
    mistakes.note(material.check().map_err(|error| error.placed(placed)));
    mistakes.end(material)
}
