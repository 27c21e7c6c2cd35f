//! The elements in the textbooks' unknowns: deflections, rotations, bubbles.

use crate::base::dot;
use crate::bat::{Bat, Theory};
use crate::beam::element::{Element, Matrix, Samples, Vector, integrated};
use crate::beam::mesh::{self, Mesh};
use crate::beam::rule::Rule;
use crate::beam::sections::worths;

/// All elements of a mesh, for degree `N − 1` and the theory.
pub fn elements<const N: usize, const W: usize>(
    bat: &Bat,
    mesh: &Mesh,
    theory: Theory,
) -> Vec<Element<f64, N, W>> {
    let rule = Rule::of(bat, mesh.over_stations(), N - 1);
    let mut lists = [const { Vec::new() }; 4];
    let element = |e: &mesh::Element| {
        lists.iter_mut().for_each(Vec::clear);
        worths(bat, e, rule, |_, worth| {
            lists[0].push(worth.bending);
            lists[1].push(worth.mass);
            if theory.turns() {
                lists[2].push(worth.turning);
            }
            if theory.shears() {
                lists[3].push(worth.shear);
            }
        });
        let [bending, mass, turning, shear] = &lists;
        let samples = Samples { bending, mass, turning, shear };
        Element::new(e.length, e.start + 0.5 * e.length, rule, samples)
    };
    mesh.elements.iter().map(element).collect()
}

impl<const N: usize, const W: usize> Element<f64, N, W> {
    /// Strains of the unknowns `[w₁, θ₁, w₂, θ₂, b₂, b₃ …, g₀, g₁ …]`: mean curvature `(θ₂ − θ₁)/h`, its slope
    /// `3[(θ₁ − ψ) + (θ₂ − ψ)]/h` with the chord `ψ = (w₂ − w₁)/h − g₀`, the bubbles, whose amplitude `b_j` is the
    /// coefficient of `P_j` in the curvature, and the shear strains.
    pub fn strains_of_hermite(&self, u: &[f64]) -> Vector<f64, W> {
        let h = self.length;
        let sheared = if W > N { u[N] } else { 0.0 };
        let chord = (u[2] - u[0]) / h - sheared;
        let mut strains = [0.0; W];
        strains[0] = (u[3] - u[1]) / h;
        strains[1] = 3.0 * ((u[1] - chord) + (u[3] - chord)) / h;
        strains[2..W - 2].copy_from_slice(&u[4..W]);
        strains
    }

    /// Stiffness and mass for the unknowns `[w₁, θ₁, w₂, θ₂, b₂, b₃ …, g₀, g₁ …]`.
    ///
    /// The deflection and the rotation of a bubble vanish at both ends, because `P_j` with `j ≥ 2` has zero area and
    /// zero moment.
    pub fn hermite(&self) -> (Matrix<f64, W>, Matrix<f64, W>) {
        let unit =
            |i: usize| -> Vector<f64, W> { std::array::from_fn(|j| f64::from(u8::from(i == j))) };
        let strains: Matrix<f64, W> = std::array::from_fn(|i| self.strains_of_hermite(&unit(i)));
        let shapes: [[Vector<f64, N>; 2]; W] = std::array::from_fn(|i| {
            let (u, [mut shape, mut turn]) = (unit(i), [[0.0; N]; 2]);
            let strains = &strains[i][..W - 2];
            integrated(self.length, strains, [u[0], u[1]], &mut shape, &mut turn);
            [shape, turn]
        });
        let times = |matrix: &Matrix<f64, N>, x: &[f64]| -> Vector<f64, N> {
            std::array::from_fn(|k| dot(&matrix[k][..x.len()], x))
        };
        let (mut stiffness, mut mass) = ([[0.0; W]; W], [[0.0; W]; W]);
        for i in 0..W {
            let bent = times(&self.stiffness, &strains[i][..N - 2]);
            let moved = times(&self.mass, &shapes[i][0]);
            let [turned, sheared] = match &self.beyond {
                Some(beyond) => {
                    let own = if W > N { &strains[i][N - 2..W - 2] } else { &[] };
                    [times(&beyond.turning, &shapes[i][1]), times(&beyond.shear, own)]
                }
                None => [[0.0; N]; 2],
            };
            for j in 0..W {
                stiffness[i][j] = dot(&bent[..N - 2], &strains[j][..N - 2]);
                if W > N {
                    stiffness[i][j] += dot(&sheared[..N - 2], &strains[j][N - 2..W - 2]);
                }
                mass[i][j] = dot(&moved, &shapes[j][0]) + dot(&turned, &shapes[j][1]);
            }
        }
        (stiffness, mass)
    }
}

#[cfg(test)]
mod tests {
    use crate::beam::element::tests::uniform;

    /// The textbook matrices of the uniform Euler–Bernoulli element.
    #[test]
    fn a_uniform_cubic_has_the_matrices_of_the_textbooks() {
        let (h, bending, line) = (0.3, 250.0, 0.9);
        let (k, m) = uniform::<4>(h, bending, line).hermite();
        let stiffness = [
            [12.0, 6.0 * h, -12.0, 6.0 * h],
            [6.0 * h, 4.0 * h * h, -6.0 * h, 2.0 * h * h],
            [-12.0, -6.0 * h, 12.0, -6.0 * h],
            [6.0 * h, 2.0 * h * h, -6.0 * h, 4.0 * h * h],
        ];
        let mass = [
            [156.0, 22.0 * h, 54.0, -13.0 * h],
            [22.0 * h, 4.0 * h * h, 13.0 * h, -3.0 * h * h],
            [54.0, 13.0 * h, 156.0, -22.0 * h],
            [-13.0 * h, -3.0 * h * h, -22.0 * h, 4.0 * h * h],
        ];
        for i in 0..4 {
            for j in 0..4 {
                let (exact, scale) = (bending / h.powi(3) * stiffness[i][j], bending / h.powi(3));
                assert!((k[i][j] - exact).abs() < 1e-13 * scale, "K {i} {j}");
                let (exact, scale) = (line * h / 420.0 * mass[i][j], line * h);
                assert!((m[i][j] - exact).abs() < 1e-14 * scale, "M {i} {j}");
            }
        }
    }

    /// The hierarchical family contains the cubics: the first four rows and columns stay unchanged.
    #[test]
    fn bubbles_leave_the_cubics_as_they_are() {
        let (h, bending, line) = (0.2, 100.0, 1.5);
        let (k4, m4) = uniform::<4>(h, bending, line).hermite();
        let (k, m) = uniform::<9>(h, bending, line).hermite();
        for i in 0..4 {
            for j in 0..4 {
                assert!((k[i][j] - k4[i][j]).abs() < 1e-12 * k4[0][0].abs());
                assert!((m[i][j] - m4[i][j]).abs() < 1e-13 * m4[0][0].abs());
            }
            // Bending a cubic does no work on a bubble of a uniform element.
            for j in 4..9 {
                assert!(k[i][j].abs() < 1e-12 * k4[0][0]);
            }
        }
    }
}
