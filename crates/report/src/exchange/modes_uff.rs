//! Modes as a universal file for modal test programs.

use crate::exchange::modes_file::{ModeTable, SampledMode};
use uff58::{Analysis, Complex, Dataset, Header, NodalData, Node, Nodes, Stamp, TraceLine, Units};

/// The datasets of the modes of a bat: 151, 164 (SI), 2411 or, for older programs, 15, 82, and 55 for each mode. The
/// values of 55 are translations x, y, z and rotations about them, with the deflection in y and the rotation about z.
///
/// A trace line has at most 250 nodes. More places need several lines, each beginning where the previous one ends. All
/// damping is written as viscous and none as hysteretic, so that a reader that adds the two counts it once.
pub fn modes(table: &ModeTable, legacy: bool, stamp: &Stamp) -> Vec<Dataset> {
    let nodes = (1..).zip(&table.x).map(|(label, x)| Node::new(label, [*x, 0.0, 0.0])).collect();
    let about = [table.bat.name(), "bending modes of a bat"];
    let mut datasets = beginning(about, Nodes { nodes, legacy }, stamp);
    datasets.extend(axis(table.x.len()).map(Dataset::TraceLine));
    let shapes = table.modes.iter().map(|mode| shape(table.bat.name(), mode));
    datasets.extend(shapes.map(Dataset::NodalData));
    datasets
}

/// Lines through nodes 1 to `count`.
fn axis(count: usize) -> impl Iterator<Item = TraceLine> {
    let step = TraceLine::MOST - 1;
    let starts = (1..count).step_by(step).map(move |start| start..=(start + step).min(count));
    (1..).zip(starts).map(|(number, nodes)| TraceLine {
        number,
        color: 0,
        name: "axis of the bat, knob to tip".into(),
        nodes: nodes.map(|label| label as i64).collect(),
    })
}

/// The beginning of a universal file that this program writes: 151, 164 (SI), and the nodes.
pub(crate) fn beginning(
    [model, description]: [&str; 2],
    nodes: Nodes,
    stamp: &Stamp,
) -> Vec<Dataset> {
    let program = concat!("sweetspot ", env!("CARGO_PKG_VERSION"));
    let header = Header {
        model: model.into(),
        description: description.into(),
        made_by: program.into(),
        created: stamp.clone(),
        saved: stamp.clone(),
        written: stamp.clone(),
        version: [0; 2],
        written_by: program.into(),
    };
    vec![Dataset::Header(header), Dataset::Units(Units::si()), Dataset::Nodes(nodes)]
}

fn shape(name: &str, mode: &SampledMode) -> NodalData {
    let number = i64::from(mode.order);
    let motion = |(w, turn): (&f64, &f64)| -> Vec<Complex> {
        [0.0, *w, 0.0, 0.0, 0.0, *turn].map(|value| [value, 0.0]).to_vec()
    };
    NodalData {
        ids: [
            name.into(),
            format!("bending mode {number}"),
            "largest deflection 1".into(),
            "y: deflection, rotation about z: rad per m of deflection".into(),
            format!("Mode {number}, frequency {} Hz", mode.frequency),
        ],
        model: 1,
        analysis: Analysis::NormalMode {
            load_case: 1,
            mode: number,
            frequency: mode.frequency,
            modal_mass: mode.modal_mass,
            viscous: mode.damping_ratio,
            hysteretic: 0.0,
        },
        characteristic: NodalData::MOTIONS,
        quantity: 8,
        complex: false,
        per_node: 6,
        values: (1..).zip(mode.deflection.iter().zip(&mode.rotation).map(motion)).collect(),
    }
}
