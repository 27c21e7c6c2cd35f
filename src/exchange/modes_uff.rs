//! Modes as a universal file for modal test programs.

use crate::exchange::modes_file::{ModeTable, SampledMode};
use crate::exchange::uff::{
    Analysis, Complex, Dataset, Header, NodalData, Node, Nodes, Stamp, TraceLine, Units,
};

/// The datasets of a bat's modes: 151, 164 (SI), 2411 or, for older programs, 15, 82, and 55 for
/// each mode, its values being translations x, y, z and rotations about them, with the deflection
/// in y and the rotation about z.
///
/// A trace line has at most 250 nodes; of more places that many are taken, ends included, and
/// none is moved. All damping stands as viscous, nothing as hysteretic: a reader that adds the two
/// has it once.
pub fn modes(table: &ModeTable, legacy: bool, stamp: &Stamp) -> Vec<Dataset> {
    let kept = thinned(table.x.len(), TraceLine::MOST);
    let label = |k: usize| 1 + k as i64;
    let at = |(k, i): (usize, &usize)| Node::new(label(k), [table.x[*i], 0.0, 0.0]);
    let nodes = kept.iter().enumerate().map(at).collect();
    let line = TraceLine {
        number: 1,
        color: 0,
        name: "axis of the bat, knob to tip".into(),
        nodes: (0..kept.len()).map(label).collect(),
    };
    let mut datasets = vec![
        Dataset::Header(header(&table.bat.name, "bending modes of a bat", stamp)),
        Dataset::Units(Units::si()),
        Dataset::Nodes(Nodes { nodes, legacy }),
        Dataset::TraceLine(line),
    ];
    let shapes = table.modes.iter().map(|mode| shape(&table.bat.name, mode, &kept));
    datasets.extend(shapes.map(Dataset::NodalData));
    datasets
}

/// The head of a universal file that this program writes.
pub(crate) fn header(model: &str, description: &str, stamp: &Stamp) -> Header {
    let program = concat!("sweetspot ", env!("CARGO_PKG_VERSION"));
    Header {
        model: model.into(),
        description: description.into(),
        made_by: program.into(),
        created: stamp.clone(),
        saved: stamp.clone(),
        written: stamp.clone(),
        version: [0; 2],
        written_by: program.into(),
    }
}

fn shape(name: &str, mode: &SampledMode, kept: &[usize]) -> NodalData {
    let number = i64::from(mode.order);
    let motion = |i: usize| -> Vec<Complex> {
        let motions = [0.0, mode.deflection[i], 0.0, 0.0, 0.0, mode.rotation[i]];
        motions.map(|value| [value, 0.0]).to_vec()
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
        values: kept.iter().enumerate().map(|(k, i)| (1 + k as i64, motion(*i))).collect(),
    }
}

/// At most so many of the indices below `count`, evenly, both ends included.
fn thinned(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|k| (k * (count - 1) + (most - 1) / 2) / (most - 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_both_ends_and_no_place_twice() {
        for count in [2, 250, 251, 499, 500, 1001, 100_000] {
            let kept = thinned(count, 250);
            assert_eq!((kept[0], *kept.last().unwrap()), (0, count - 1));
            assert_eq!(kept.len(), count.min(250));
            assert!(kept.windows(2).all(|pair| pair[0] < pair[1]), "{count}");
        }
    }
}
