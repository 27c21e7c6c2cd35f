//! Modes that measured responses share as a universal file.

use faer::c64;

use crate::exchange::modes_uff::beginning;
use sweetspot_study::identify::modes::{SharedMode, placed};
use sweetspot_study::identify::set::ResponseSet;
use uff58::{Analysis, Dataset, NodalData, Node, Nodes, Stamp};

/// The datasets of identified modes: 151, 164 (SI), 2411, and 55 for each mode: complex, with its pole
/// `λ = −ζω + iω√(1 − ζ²)`, Modal A `2iωm` and Modal B `−λA`, the deflection in y. A modal mass that is not known is 1
/// there.
pub fn modes(set: &ResponseSet, modes: &[SharedMode], stamp: &Stamp) -> Vec<Dataset> {
    let nodes = set.points.iter().map(|place| Node::new(place.node, [place.x, 0.0, 0.0])).collect();
    let about = ["responses", "modes identified from responses"];
    let mut datasets = beginning(about, Nodes { nodes, legacy: false }, stamp);
    let shapes = (1..).zip(modes).map(|(number, mode)| shape(set, number, mode));
    datasets.extend(shapes.map(Dataset::NodalData));
    datasets
}

fn shape(set: &ResponseSet, number: i64, mode: &SharedMode) -> NodalData {
    let (omega, zeta) = (std::f64::consts::TAU * mode.frequency.value, mode.damping.value);
    let pole = c64::new(-zeta * omega, omega * (1.0 - zeta * zeta).sqrt());
    let a = c64::new(0.0, 2.0 * omega * mode.modal_mass.unwrap_or(1.0));
    let pair = |v: c64| [v.re, v.im];
    let value = |value: c64| vec![[0.0; 2], pair(value), [0.0; 2]];
    let values = placed(&set.points, &mode.shape).map(|(place, v)| (place.node, value(v)));
    NodalData {
        ids: [
            format!("mode {number}"),
            format!("frequency {} Hz", mode.frequency.value),
            format!("damping ratio {zeta}"),
            "largest deflection 1, in y".into(),
            String::new(),
        ],
        model: 1,
        analysis: Analysis::ComplexMode {
            second_order: false,
            load_case: 1,
            mode: number,
            eigenvalue: pair(pole),
            modal_a: pair(a),
            modal_b: pair(-pole * a),
        },
        characteristic: NodalData::TRANSLATIONS,
        quantity: 8,
        complex: true,
        per_node: 3,
        values: values.collect(),
    }
}
