//! The bat in the JSON files: as it was understood, and a bat file in its own right.

use crate::bat::body::{Bat, Weighed};
use crate::bat::fixtures::{Attachment, Grip, Held, Region};
use crate::bat::material::Material;
use crate::bat::profile::{FormulaPiece, Formulas, Interpolation, Profile, Stations};
use crate::files::schema::document::Format;
use crate::files::schema::resolved as file;
use crate::files::schema::resolved::ResolvedBat;

/// The bat as it was understood: SI, defaults filled in, materials as they were weighed. Read as a
/// bat file it is the same bat.
pub fn resolved(bat: &Bat) -> ResolvedBat {
    let fixtures = &bat.fixtures;
    ResolvedBat {
        format: Format::new(),
        name: bat.name.clone(),
        source: bat.source.clone(),
        material: material(bat.material()),
        profile: profile(&bat.profile),
        regions: fixtures.regions.iter().map(region).collect(),
        attachments: fixtures.attachments.iter().map(attachment).collect(),
        tapes: fixtures
            .tapes
            .iter()
            .map(|tape| file::Tape { from: tape.from, to: tape.to, mass: tape.mass })
            .collect(),
        absorbers: fixtures
            .absorbers
            .iter()
            .map(|a| file::Absorber {
                x: a.x,
                mass: a.mass,
                stiffness: a.stiffness,
                damping: a.damping,
            })
            .collect(),
        joints: fixtures
            .joints
            .iter()
            .map(|joint| file::Joint {
                x: joint.x,
                rotational_stiffness: joint.rotational_stiffness,
            })
            .collect(),
        supports: fixtures
            .supports
            .iter()
            .map(|support| file::Support { x: support.x, kind: held(support.kind) })
            .collect(),
        grip: fixtures.grip.map(grip),
        weighed: (bat.weighed != Weighed::default()).then(|| weighed(&bat.weighed)),
    }
}

fn material(material: &Material) -> file::Material {
    file::Material {
        density: material.density,
        youngs_modulus: material.youngs_modulus,
        loss_factor: material.loss_factor,
        shear_modulus: material.shear_modulus,
        poisson_ratio: material.poisson_ratio,
        shear_coefficient: material.shear_coefficient,
        strength: material.strength,
        strain_to_failure: material.strain_to_failure,
    }
}

fn profile(profile: &Profile) -> file::Profile {
    match &profile.formulas {
        Some(formulas) => file::Profile::Pieces(pieces(formulas)),
        None => file::Profile::Columns(columns(&profile.stations)),
    }
}

fn columns(stations: &Stations) -> file::Columns {
    let hollow = stations.inner.iter().any(|r| *r > 0.0);
    file::Columns {
        interpolation: match stations.interpolation {
            Interpolation::Pchip => file::Interpolation::Pchip,
            // What is constant has become steps between straight lines.
            Interpolation::Linear | Interpolation::Constant => file::Interpolation::Linear,
        },
        unit: "m".to_owned(),
        x: stations.x.clone(),
        radius: stations.outer.clone(),
        inner_radius: hollow.then(|| stations.inner.clone()),
    }
}

fn pieces(formulas: &Formulas) -> file::Pieces {
    let piece = |piece: &FormulaPiece| file::Piece {
        from: piece.from,
        to: piece.to,
        formula: piece.outer.text().to_owned(),
        inner_formula: piece.inner.as_ref().map(|inner| inner.text().to_owned()),
    };
    file::Pieces {
        measured_from: if formulas.from_tip { file::End::Tip } else { file::End::Knob },
        pieces: formulas.pieces.iter().map(piece).collect(),
    }
}

fn region(region: &Region) -> file::Region {
    file::Region {
        from: region.from,
        to: region.to,
        material: material(&region.layup.outer),
        core: region.layup.core.as_ref().map(material),
    }
}

fn attachment(a: &Attachment) -> file::Attachment {
    file::Attachment {
        x: a.x,
        mass: a.mass,
        rotary_inertia: a.rotary_inertia,
        offset: a.offset,
        stiffness: a.stiffness,
        rotational_stiffness: a.rotational_stiffness,
    }
}

fn held(kind: Held) -> file::Held {
    match kind {
        Held::Pinned => file::Held::Pinned,
        Held::Clamped => file::Held::Clamped,
    }
}

fn grip(grip: Grip) -> file::Grip {
    let Grip { from, to, stiffness, damping } = grip;
    file::Grip { from, to, stiffness, damping }
}

fn weighed(weighed: &Weighed) -> file::Weighed {
    file::Weighed {
        mass: weighed.mass,
        balance_point: weighed.balance_point,
        first_bending_hz: weighed.first_bending,
    }
}
