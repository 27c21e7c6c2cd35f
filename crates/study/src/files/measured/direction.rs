//! Directions in space: the axis of a bat from points on it, and the normals to it.

use faer::{Mat, Side};

use crate::engine::dot;

/// A direction or a place.
pub type Vector = [f64; 3];

/// A direction this near to an axis of coordinates is that axis.
const ALONG: f64 = 0.9999;

/// The direction in which places are farthest apart, its largest part positive.
pub fn axis(at: &[Vector]) -> Vector {
    let mean = |k: usize| at.iter().map(|x| x[k]).sum::<f64>() / at.len().max(1) as f64;
    let middle = [mean(0), mean(1), mean(2)];
    let entry = |i: usize, j: usize| -> f64 {
        at.iter().map(|x| (x[i] - middle[i]) * (x[j] - middle[j])).sum()
    };
    let spread = Mat::from_fn(3, 3, entry);
    let Ok(found) = spread.self_adjoint_eigen(Side::Lower) else { return [1.0, 0.0, 0.0] };
    let mut axis = [0, 1, 2].map(|k| found.U()[(k, 2)]);
    if let Some(k) = (0..3).find(|k| axis[*k].abs() > ALONG) {
        axis = [0, 1, 2].map(|j| if j == k { axis[k].signum() } else { 0.0 });
    }
    positive(axis)
}

/// This direction or its opposite, whichever has its largest component positive.
pub fn positive(direction: Vector) -> Vector {
    let larger = |most: f64, v: f64| if v.abs() > most.abs() { v } else { most };
    let largest = direction.into_iter().fold(0.0, larger);
    // Nothing is 0, not −0.
    direction.map(|v| v * largest.signum() + 0.0)
}

/// Two directions normal to an axis and to each other; axes of coordinates where it is one.
pub fn normals(axis: Vector) -> [Vector; 2] {
    let least = (0..3).min_by(|a, b| axis[*a].abs().total_cmp(&axis[*b].abs())).unwrap_or(0);
    let unit: Vector = [0, 1, 2].map(|k| if k == least { 1.0 } else { 0.0 });
    let off = dot(&unit, &axis);
    let one = [0, 1, 2].map(|k| unit[k] - off * axis[k]);
    let size = dot(&one, &one).sqrt();
    let one = one.map(|v| v / size);
    let other = [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        axis[i] * one[j] - axis[j] * one[i]
    });
    [one, other]
}

/// A direction in words: an axis of coordinates, or its parts.
pub fn named(direction: Vector) -> String {
    match (0..3).find(|k| direction[*k].abs() > ALONG) {
        Some(k) => ["x", "y", "z"][k].to_owned(),
        None => {
            // Round-off of zero has no sign.
            let [x, y, z] = direction.map(|v| (1e3 * v).round() / 1e3 + 0.0);
            format!("({x:.3}, {y:.3}, {z:.3})")
        }
    }
}
