//! Hoop modes as a universal file and as a VTK file.

use crate::exchange::barrel::{BarrelGrid, MovedBarrel};
use crate::exchange::modes_uff::beginning;
use crate::exchange::vtu::Contents;
use uff58::{Analysis, Complex, Dataset, NodalData, Node, Nodes, Stamp, TraceLine};

/// The datasets of a barrel's hoop modes: 151, 164 (SI), 2411, a line 82 around every ring and one along, and 55
/// for each mode, its values being translations x, y, z.
pub fn uff(name: &str, barrel: &BarrelGrid, stamp: &Stamp) -> Vec<Dataset> {
    let nodes = (1..).zip(&barrel.grid.points).map(|(label, at)| Node::new(label, *at)).collect();
    let about = [name, "hoop modes of a barrel"];
    let mut datasets = beginning(about, Nodes { nodes, legacy: false }, stamp);
    datasets.extend(lines(barrel).map(Dataset::TraceLine));
    let shapes = (1..).zip(&barrel.modes).map(|(number, mode)| shape(name, number, mode));
    datasets.extend(shapes.map(Dataset::NodalData));
    datasets
}

/// Closed lines around the rings, in pieces of no more nodes than a line may have, and a line along the barrel.
fn lines(barrel: &BarrelGrid) -> impl Iterator<Item = TraceLine> {
    let (around, rings) = (barrel.around, barrel.x.len());
    let ring = move |k: usize| {
        let nodes: Vec<i64> = (0..=around).map(|j| (1 + k * around + j % around) as i64).collect();
        ("around the barrel", nodes)
    };
    let along = (0..rings).map(|k| (1 + k * around) as i64).collect();
    let all = (0..rings).map(ring).chain([("along the barrel", along)]);
    let pieces = all.flat_map(|(name, nodes)| {
        let step = TraceLine::MOST - 1;
        let starts = (0..nodes.len().saturating_sub(1)).step_by(step);
        let piece = |start: usize| nodes[start..=(start + step).min(nodes.len() - 1)].to_vec();
        starts.map(piece).map(|nodes| (name, nodes)).collect::<Vec<_>>()
    });
    (1..).zip(pieces).map(|(number, (name, nodes))| TraceLine {
        number,
        color: 0,
        name: name.into(),
        nodes,
    })
}

fn shape(name: &str, number: i64, moved: &MovedBarrel) -> NodalData {
    let MovedBarrel { mode, modal_mass, motion } = moved;
    let values = |at: &[f64; 3]| -> Vec<Complex> { at.map(|value| [value, 0.0]).to_vec() };
    NodalData {
        ids: [
            name.into(),
            format!("hoop mode n = {}, m = {}", mode.harmonic, mode.order),
            "largest motion across the surface 1".into(),
            "translations x, y, z; n waves around, m along".into(),
            format!("Mode {number}, frequency {} Hz", mode.frequency_hz),
        ],
        model: 1,
        analysis: Analysis::NormalMode {
            load_case: 1,
            mode: number,
            frequency: mode.frequency_hz,
            modal_mass: *modal_mass,
            viscous: mode.damping_ratio,
            hysteretic: 0.0,
        },
        characteristic: NodalData::TRANSLATIONS,
        quantity: 8,
        complex: false,
        per_node: 3,
        values: (1..).zip(motion.iter().map(values)).collect(),
    }
}

/// One VTK file with all modes, each an array of vectors `hoop_2_1`, … of its waves around and its number.
pub fn vtu(barrel: &BarrelGrid) -> String {
    let of = |of: fn(&MovedBarrel) -> f64| barrel.modes.iter().map(of).collect::<Vec<_>>();
    let named = |moved: &MovedBarrel| {
        let name = format!("hoop_{}_{}", moved.mode.harmonic, moved.mode.order);
        (name, moved.motion.clone())
    };
    Contents {
        about: "a barrel: x along it, hoop modes",
        time: None,
        fields: vec![
            ("frequency_hz", of(|moved| moved.mode.frequency_hz)),
            ("modal_mass_kg", of(|moved| moved.modal_mass)),
            ("damping_ratio", of(|moved| moved.mode.damping_ratio)),
        ],
        scalars: vec![("radius_m", barrel.radius.clone())],
        vectors: barrel.modes.iter().map(named).collect(),
    }
    .file(&barrel.grid)
}
