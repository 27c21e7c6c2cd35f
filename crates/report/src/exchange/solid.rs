//! The outer surface of a bat, and how a mode moves it.

use std::f64::consts::TAU;

/// Points and cells of a surface or a line, in the order of their places along the bat.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Grid {
    /// Position of each point (m): x along the bat, y in the direction of deflections.
    pub points: Vec<[f64; 3]>,
    /// Which place along the bat each point belongs to.
    pub places: Vec<usize>,
    /// Points of each cell: two of a line, three or four of a surface, anticlockwise from outside.
    pub cells: Vec<Vec<usize>>,
}

impl Grid {
    /// The axis, a line from each place to the next.
    pub fn line(x: &[f64]) -> Self {
        Self {
            points: x.iter().map(|x| [*x, 0.0, 0.0]).collect(),
            places: (0..x.len()).collect(),
            cells: (1..x.len()).map(|k| vec![k - 1, k]).collect(),
        }
    }

    /// The surface of revolution through radii `r` (m) at places `x` (m), `around` points on each
    /// circle, closed by discs at the ends. A radius of 0 is one point.
    pub fn surface(x: &[f64], r: &[f64], around: usize) -> Self {
        let last = x.len().saturating_sub(1);
        // A disc is closed by a ring of radius 0 at the same place.
        let mut stops: Vec<(usize, f64)> = r.iter().copied().enumerate().collect();
        if r.first().is_some_and(|r| *r > 0.0) {
            stops.insert(0, (0, 0.0));
        }
        if r.last().is_some_and(|r| *r > 0.0) {
            stops.push((last, 0.0));
        }
        Self::through(x, &stops, around)
    }

    /// The surface of a tube of these radii (m) at these places (m), open at both ends.
    pub fn tube(x: &[f64], r: &[f64], around: usize) -> Self {
        let stops: Vec<(usize, f64)> = r.iter().copied().enumerate().collect();
        Self::through(x, &stops, around)
    }

    /// Rings of these radii (m), each with the number of its place, joined one to the next.
    fn through(x: &[f64], stops: &[(usize, f64)], around: usize) -> Self {
        let mut grid = Self::default();
        let mut rings: Vec<Vec<usize>> = Vec::new();
        for &(place, radius) in stops {
            let count = if radius > 0.0 { around } else { 1 };
            let first = grid.points.len();
            for k in 0..count {
                let (sine, cosine) = (TAU * k as f64 / around as f64).sin_cos();
                grid.points.push([x[place], radius * cosine, radius * sine]);
                grid.places.push(place);
            }
            rings.push((first..first + count).collect());
        }
        for pair in rings.windows(2) {
            grid.join(&pair[0], &pair[1], around);
        }
        grid
    }

    /// The cells between two rings, either of which may be a single point.
    fn join(&mut self, left: &[usize], right: &[usize], around: usize) {
        if left.len() + right.len() == 2 {
            return;
        }
        let on = |ring: &[usize], k: usize| ring[if ring.len() == 1 { 0 } else { k % around }];
        for k in 0..around {
            let mut cell = vec![on(left, k), on(left, k + 1), on(right, k + 1), on(right, k)];
            cell.dedup();
            if cell.first() == cell.last() {
                cell.pop();
            }
            self.cells.push(cell);
        }
    }

    /// How a mode moves every point: deflections along y, and x from sections that turn.
    pub fn moved(&self, deflection: &[f64], rotation: &[f64]) -> Vec<[f64; 3]> {
        let points = self.points.iter().zip(&self.places);
        // A zero has no sign.
        points.map(|(at, k)| [0.0 - rotation[*k] * at[1], deflection[*k], 0.0]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume that a closed surface encloses, with the outside of every cell facing outwards.
    fn volume(grid: &Grid) -> f64 {
        let triangles = grid.cells.iter().flat_map(|cell| {
            (2..cell.len()).map(|k| [cell[0], cell[k - 1], cell[k]].map(|p| grid.points[p]))
        });
        let six = triangles.map(|[a, b, c]| {
            a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        });
        six.sum::<f64>() / 6.0
    }

    #[test]
    fn a_surface_encloses_the_volume_of_its_prisms() {
        // A regular polygon of n corners has n/2 sin(2π/n) of the square of its radius.
        let n = 24;
        let polygon = 12.0 * (TAU / 24.0).sin();
        let rod = Grid::surface(&[0.0, 0.3, 1.0], &[0.5; 3], n);
        assert!((volume(&rod) / (0.25 * polygon) - 1.0).abs() < 1e-12);
        assert_eq!((rod.points.len(), rod.cells.len()), (3 * n + 2, 4 * n));
        let cone = Grid::surface(&[0.0, 1.0], &[0.0, 0.5], n);
        assert!((volume(&cone) / (0.25 * polygon / 3.0) - 1.0).abs() < 1e-12);
        assert_eq!((cone.points.len(), cone.cells.len()), (n + 2, 2 * n));
        assert!(cone.cells.iter().all(|cell| cell.len() == 3));
    }

    #[test]
    fn a_rigid_turn_keeps_every_length_to_first_order() {
        let x = [0.0, 0.4, 0.9];
        let grid = Grid::surface(&x, &[0.01, 0.02, 0.03], 8);
        let angle = 1e-6;
        let moved = grid.moved(&x.map(|x| angle * x), &[angle; 3]);
        let distance =
            |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        let shifted: Vec<[f64; 3]> = (0..grid.points.len())
            .map(|p| std::array::from_fn(|i| grid.points[p][i] + moved[p][i]))
            .collect();
        for a in 0..shifted.len() {
            for b in 0..a {
                let before = distance(grid.points[a], grid.points[b]);
                assert!((distance(shifted[a], shifted[b]) - before).abs() < 2.0 * angle * angle);
            }
        }
    }
}
