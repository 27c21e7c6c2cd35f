//! Walls with known hoop modes, and ways to solve them on one mesh.

pub mod exact;

use std::f64::consts::TAU;
use std::sync::Arc;

use sweetspot::bat::fixtures::{Fixtures, Region};
use sweetspot::bat::formula::Formula;
use sweetspot::bat::layup::Layup;
use sweetspot::bat::profile::{FormulaPiece, Interpolation, Stations};
use sweetspot::beam::wall::columns::{Grading, columns};
use sweetspot::beam::wall::layers::Layers;
use sweetspot::beam::wall::unknowns::{EndHold, WallMesh};
use sweetspot::modes::hoop::spectrum::Spectrum;
use sweetspot::modes::hoop::system::Wall;
use sweetspot::{Bat, Material, Profile};
use sweetspot_proof::bundled::bundled_bat;

/// Nothing holds the wall.
pub const FREE: [EndHold; 2] = [EndHold::Free; 2];

/// An alloy of bats: E 71 GPa, ν 0.33, 2810 kg/m³.
pub fn aluminium() -> Material {
    let mut material = Material::new(2810.0, 71e9).unwrap();
    material.poisson_ratio = Some(0.33);
    material
}

/// A tube of that length, mean radius and thickness (m).
pub fn tube(length: f64, radius: f64, thickness: f64, material: Material) -> Bat {
    let (outer, inner) = (vec![radius + 0.5 * thickness; 2], vec![radius - 0.5 * thickness; 2]);
    let interpolation = Interpolation::Linear;
    let profile = Profile::new(Stations { x: vec![0.0, length], outer, inner, interpolation });
    Bat::builder(profile.unwrap(), material).build().unwrap()
}

/// A made-up baseball bat with that wall (m) in its barrel, open at the tip.
pub fn open_barrel(wall: f64) -> Bat {
    barrel_in_parts(wall, &[0.58, 0.8382])
}

/// The same with the formula of its barrel written again between these places (m), where columns of elements then
/// begin.
pub fn barrel_in_parts(wall: f64, places: &[f64]) -> Bat {
    let taper = "0.0115 + 0.0218*(3*((x - 0.28)/0.3)^2 - 2*((x - 0.28)/0.3)^3)";
    let bore = format!("{taper} - (0.0026 + {}*(x - 0.28)/0.3)", wall - 0.0026);
    let piece = |from, to, outer: &str, inner: &str| FormulaPiece {
        from,
        to,
        outer: Formula::parse(outer).unwrap(),
        inner: Some(Formula::parse(inner).unwrap()),
    };
    let mut pieces =
        vec![piece(0.0, 0.28, "0.0115", "0.0115 - 0.0026"), piece(0.28, 0.58, taper, &bore)];
    for (k, pair) in places.windows(2).enumerate() {
        // The same formula continues beyond a border; another formula with the same values does not.
        let outer = format!("0.0333 + {k}*0*x");
        pieces.push(piece(pair[0], pair[1], &outer, &format!("0.0333 - {wall}")));
    }
    Bat::builder(Profile::from_formulas(pieces).unwrap(), aluminium()).build().unwrap()
}

/// The same with the last 12 mm of its bore filled.
pub fn plugged_barrel(wall: f64) -> Bat {
    let mut plug = Material::new(1150.0, 1e9).unwrap();
    plug.poisson_ratio = Some(0.40);
    let layup = Layup { core: Some(plug), ..Layup::of(aluminium()) };
    let regions = vec![Region { from: 0.8262, to: 0.8382, layup }];
    open_barrel(wall)
        .with(|parts| parts.fixtures = Fixtures { regions, ..Fixtures::default() })
        .unwrap()
}

/// The bat of a students' project, with kinks where its taper begins and ends.
pub fn northwestern() -> Bat {
    bundled_bat("meshes/northwestern_aluminium.json").unwrap()
}

/// The lowest modes of one harmonic on one mesh of a bat from `from` (m) to its tip.
pub fn spectrum(
    bat: &Bat,
    from: f64,
    degrees: [usize; 2],
    grading: Grading,
    n: usize,
    ends: [EndHold; 2],
    count: usize,
) -> Spectrum {
    let layers = Layers::of(bat, from, bat.length()).unwrap();
    let mesh = Arc::new(WallMesh::new(columns(&layers, grading), degrees).unwrap());
    let wall = Wall { mesh, materials: layers.materials.into() };
    Spectrum::of(&wall, n, ends, count, 1e-10).unwrap()
}

/// The same, frequencies only (Hz).
pub fn frequencies(
    bat: &Bat,
    from: f64,
    degrees: [usize; 2],
    grading: Grading,
    n: usize,
    ends: [EndHold; 2],
    count: usize,
) -> Vec<f64> {
    let found = spectrum(bat, from, degrees, grading, n, ends, count);
    found.omegas.iter().map(|omega| omega / TAU).collect()
}
