//! How a material is written down: a name, or an object of numbers.

use crate::document::Node;
use crate::error::{Error, Result};
use crate::material::{BUILT_IN, Material};
use crate::units::Quantity;

/// A material by name or by numbers; where it has no density, that one or the words for what is
/// expected.
pub(crate) fn read(
    node: &Node,
    without_density: std::result::Result<f64, &str>,
) -> Result<Material> {
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
    let density = match (object.quantity("density", Quantity::Density)?, without_density) {
        (Some(density), _) | (None, Ok(density)) => density,
        (None, Err(expected)) => return Err(object.node.error("no \"density\"", expected)),
    };
    let modulus = object.require("youngs_modulus", "\"youngs_modulus\", such as \"18.1 GPa\"")?;
    let youngs_modulus = modulus.quantity(Quantity::Pressure)?;
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
            // A value that is not in the file was made from others.
            let place = object.get(&complaint.field);
            complaint.found = place.map_or(complaint.found, Node::shown);
            complaint.field = format!("{}.{}", node.path, complaint.field);
            place.unwrap_or(node).complain(complaint)
        }
        other => other,
    })?;
    Ok(material)
}
