//! The bat in the JSON files: as it was understood, and a bat file in its own right.

use serde_json::{Value, json};

use crate::bat::Bat;
use crate::fixtures::{Fixtures, Held, Region};
use crate::material::Material;
use crate::profile::{FormulaPiece, Formulas, Interpolation, Stations};

/// The bat as it was understood: SI, defaults filled in, materials as they were weighed. Read as a
/// bat file it is the same bat.
pub fn resolved(bat: &Bat) -> Value {
    let mut resolved = json!({
        "format": "sweetspot-bat/1",
        "name": bat.name,
        "source": bat.source,
        "material": material(bat.material()),
        "profile": match &bat.profile.formulas {
            Some(formulas) => pieces(formulas),
            None => columns(&bat.profile.stations),
        },
    });
    fixtures(&mut resolved, &bat.fixtures);
    for (key, value) in [
        ("mass", bat.weighed.mass),
        ("balance_point", bat.weighed.balance_point),
        ("first_bending_hz", bat.weighed.first_bending),
    ] {
        if let Some(value) = value {
            resolved["weighed"][key] = json!(value);
        }
    }
    resolved
}

fn material(material: &Material) -> Value {
    let mut numbers = json!({
        "density": material.density,
        "youngs_modulus": material.youngs_modulus,
        "loss_factor": material.loss_factor,
    });
    if let Some(modulus) = material.shear_modulus {
        numbers["shear_modulus"] = json!(modulus);
    }
    if let Some(nu) = material.poisson_ratio {
        numbers["poisson_ratio"] = json!(nu);
    }
    if let Some(kappa) = material.shear_coefficient {
        numbers["shear_coefficient"] = json!(kappa);
    }
    numbers
}

fn fixtures(resolved: &mut Value, fixtures: &Fixtures) {
    let mut list = |key: &str, items: Vec<Value>| {
        if !items.is_empty() {
            resolved[key] = Value::Array(items);
        }
    };
    list("regions", fixtures.regions.iter().map(region).collect());
    let attachments = fixtures.attachments.iter().map(|a| {
        json!({
            "x": a.x,
            "mass": a.mass,
            "rotary_inertia": a.rotary_inertia,
            "offset": a.offset,
            "stiffness": a.stiffness,
            "rotational_stiffness": a.rotational_stiffness,
        })
    });
    list("attachments", attachments.collect());
    let tapes = fixtures.tapes.iter();
    let tapes = tapes.map(|tape| json!({ "from": tape.from, "to": tape.to, "mass": tape.mass }));
    list("tapes", tapes.collect());
    let absorbers = fixtures.absorbers.iter().map(
        |a| json!({ "x": a.x, "mass": a.mass, "stiffness": a.stiffness, "damping": a.damping }),
    );
    list("absorbers", absorbers.collect());
    let joints = fixtures.joints.iter();
    let joints =
        joints.map(|j| json!({ "x": j.x, "rotational_stiffness": j.rotational_stiffness }));
    list("joints", joints.collect());
    let supports = fixtures.supports.iter().map(|support| {
        let kind = match support.kind {
            Held::Pinned => "pinned",
            Held::Clamped => "clamped",
        };
        json!({ "x": support.x, "type": kind })
    });
    list("supports", supports.collect());
    if let Some(grip) = &fixtures.grip {
        resolved["grip"] = json!({
            "from": grip.from,
            "to": grip.to,
            "stiffness": grip.stiffness,
            "damping": grip.damping,
        });
    }
}

fn region(region: &Region) -> Value {
    let mut written = json!({
        "from": region.from,
        "to": region.to,
        "material": material(&region.layup.outer),
    });
    if let Some(core) = &region.layup.core {
        written["core"] = material(core);
    }
    written
}

fn columns(stations: &Stations) -> Value {
    let interpolation =
        if stations.interpolation == Interpolation::Pchip { "pchip" } else { "linear" };
    let mut profile = json!({
        "interpolation": interpolation,
        "unit": "m",
        "x": stations.x,
        "radius": stations.outer,
    });
    if stations.inner.iter().any(|r| *r > 0.0) {
        profile["inner_radius"] = json!(stations.inner);
    }
    profile
}

fn pieces(formulas: &Formulas) -> Value {
    let piece = |piece: &FormulaPiece| {
        let mut written =
            json!({ "from": piece.from, "to": piece.to, "formula": piece.outer.text() });
        if let Some(inner) = &piece.inner {
            written["inner_formula"] = json!(inner.text());
        }
        written
    };
    json!({
        "measured_from": if formulas.from_tip { "tip" } else { "knob" },
        "pieces": formulas.pieces.iter().map(piece).collect::<Vec<_>>(),
    })
}
