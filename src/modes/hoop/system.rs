//! What are stiffness and mass of the whole wall in one harmonic? Factors, products, energies.

use std::sync::Arc;

use crate::base::linear::dot;
use crate::beam::wall::cell::energies;
use crate::beam::wall::elastic::Elastic;
use crate::beam::wall::unknowns::{EndHold, Unknowns, WallMesh};
use crate::eigen::fronts::Fronts;

/// The unknowns of one part's functions, all of U, then of V, then of W.
#[derive(Debug, Clone)]
struct Links {
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

impl Links {
    fn of(&self, slot: usize) -> &[(usize, f64)] {
        &self.entries[self.starts[slot]..self.starts[slot + 1]]
    }
}

/// The elements of a wall and their materials.
#[derive(Debug, Clone)]
pub struct Wall {
    /// The elements.
    pub mesh: Arc<WallMesh>,
    /// The materials.
    pub materials: Arc<[Elastic]>,
}

/// The wall in one harmonic.
#[derive(Debug, Clone)]
pub struct System {
    /// Its elements.
    pub mesh: Arc<WallMesh>,
    /// Their materials.
    pub materials: Arc<[Elastic]>,
    /// The harmonic.
    pub n: usize,
    /// Its unknowns.
    pub unknowns: Unknowns,
    links: Vec<Vec<Links>>,
}

impl System {
    /// The wall on that mesh in harmonic n, with these ends.
    pub fn new(wall: &Wall, n: usize, ends: [EndHold; 2]) -> Self {
        Self::with(wall, n, Unknowns::new(&wall.mesh, n, ends))
    }

    /// The wall on that mesh in harmonic n, with these unknowns.
    pub fn with(wall: &Wall, n: usize, unknowns: Unknowns) -> Self {
        let Wall { mesh, materials } = wall.clone();
        let mut links = vec![];
        for (cells, sharing) in mesh.cells.iter().zip(&mesh.sharing) {
            let mut of_column = vec![];
            for (cell, sharing) in cells.iter().zip(sharing) {
                let mut own = Links { starts: vec![0], entries: vec![] };
                for c in 0..3 {
                    for k in 0..cell.count {
                        for (function, share) in sharing.of(k) {
                            if let Some((unknown, sign)) = unknowns.of[*function][c] {
                                own.entries.push((unknown, share * sign));
                            }
                        }
                        own.starts.push(own.entries.len());
                    }
                }
                of_column.push(own);
            }
            links.push(of_column);
        }
        Self { mesh, materials, n, unknowns, links }
    }

    /// The factors of `K + shift M` on the unknowns that are not held, without the factor π.
    pub fn factors(&self, shift: f64) -> Fronts {
        let mesh = &self.mesh;
        let mut fronts = Fronts::new(self.unknowns.count);
        let columns = mesh.columns.len();
        for c in 0..columns {
            let parts = mesh.cells[c].len();
            let inside = &mesh.inside[c];
            let edges = inside[parts].clone();
            let next = mesh.at_border[c + 1].clone();
            let (last, beyond) = if c + 1 == columns { (next, 0..0) } else { (0..0, next) };
            let borders = mesh.at_border[c].clone().chain(last);
            if parts == 1 {
                let all = inside[0].clone().chain(edges).chain(borders);
                let mut unknowns = self.numbers(all);
                let eliminated = unknowns.len();
                unknowns.extend(self.numbers(beyond));
                fronts.add(unknowns, eliminated, true, |places, matrix| {
                    self.assemble(c, 0, shift, places, matrix);
                });
                continue;
            }
            for k in 0..parts {
                let mut unknowns = self.numbers(inside[k].clone());
                let eliminated = unknowns.len();
                let mut touched: Vec<usize> =
                    self.links[c][k].entries.iter().map(|e| e.0).collect();
                touched.retain(|u| *u < self.unknowns.count && !unknowns.contains(u));
                touched.sort_unstable();
                touched.dedup();
                unknowns.extend(touched);
                fronts.add(unknowns, eliminated, false, |places, matrix| {
                    self.assemble(c, k, shift, places, matrix);
                });
            }
            let mut unknowns = self.numbers(edges.chain(borders));
            let eliminated = unknowns.len();
            unknowns.extend(self.numbers(beyond));
            fronts.add(unknowns, eliminated, true, |_, _| {});
        }
        fronts
    }

    /// The unknowns of functions, without those that are held.
    fn numbers(&self, functions: impl Iterator<Item = usize>) -> Vec<usize> {
        let of = |function: usize| {
            let own = self.unknowns.of[function].into_iter().flatten();
            own.filter(|(unknown, sign)| *sign > 0.0 && *unknown < self.unknowns.count)
        };
        functions.flat_map(of).map(|(unknown, _)| unknown).collect()
    }

    /// Adds the stiffness of a part to the upper triangle of its front.
    fn assemble(&self, c: usize, part: usize, shift: f64, places: &[usize], matrix: &mut [f64]) {
        let (cell, links) = (&self.mesh.cells[c][part], &self.links[c][part]);
        let of = &self.materials[self.mesh.columns[c].parts[part].material];
        let k = cell.stiffness(of, self.n, shift);
        let width = 3 * cell.count;
        let size = matrix.len().isqrt();
        let free = self.unknowns.count;
        let plain = |slot: &usize| matches!(links.of(*slot), [] | [(_, 1.0)]);
        if (0..width).all(|slot| plain(&slot)) {
            let of = |slot| links.of(slot).first().filter(|(unknown, _)| *unknown < free);
            let slots = (0..width).filter_map(|slot| Some((slot, places[of(slot)?.0])));
            let slots: Vec<(usize, usize)> = slots.collect();
            for (i, a) in &slots {
                let (row, to) = (&k[i * width..], &mut matrix[a * size..(a + 1) * size]);
                for (j, b) in slots.iter().filter(|(_, b)| b >= a) {
                    to[*b] += row[*j];
                }
            }
            return;
        }
        for i in 0..width {
            for (a, a_share) in links.of(i) {
                if *a >= free {
                    continue;
                }
                let a = places[*a];
                for j in 0..width {
                    let value = a_share * k[i * width + j];
                    for (b, b_share) in links.of(j) {
                        if *b < free && places[*b] >= a {
                            matrix[a * size + places[*b]] += value * b_share;
                        }
                    }
                }
            }
        }
    }

    /// The components of a motion in all functions of a part.
    fn gather(&self, c: usize, part: usize, x: &[f64], own: &mut Vec<f64>) {
        let links = &self.links[c][part];
        own.clear();
        own.extend((0..links.starts.len() - 1).map(|slot| {
            links.of(slot).iter().map(|(unknown, share)| share * x[*unknown]).sum::<f64>()
        }));
    }

    /// `y = M x`, all unknowns, without the factor π.
    pub fn mass(&self, x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        let mut own = vec![];
        for (c, column) in self.mesh.columns.iter().enumerate() {
            for (k, part) in column.parts.iter().enumerate() {
                self.gather(c, k, x, &mut own);
                let cell = &self.mesh.cells[c][k];
                let density = self.materials[part.material].density;
                let links = &self.links[c][k];
                for (component, motion) in own.chunks_exact(cell.count).enumerate() {
                    for (i, row) in cell.mass().chunks_exact(cell.count).enumerate() {
                        let to = links.of(component * cell.count + i);
                        if to.is_empty() {
                            continue;
                        }
                        let product: f64 = density * dot(row, motion);
                        for (unknown, share) in to {
                            y[*unknown] += share * product;
                        }
                    }
                }
            }
        }
    }

    /// Twice the strain energy in each material, and `xᵀMx`, from the strains at the points, without the
    /// factor π.
    pub fn energies(&self, x: &[f64]) -> (Vec<f64>, f64) {
        let mut strain = vec![0.0; self.materials.len()];
        let mut mass = 0.0;
        let mut own = vec![];
        for (c, column) in self.mesh.columns.iter().enumerate() {
            for (k, part) in column.parts.iter().enumerate() {
                self.gather(c, k, x, &mut own);
                let count = self.mesh.cells[c][k].count;
                let motion = [0, 1, 2].map(|m| &own[m * count..(m + 1) * count]);
                let of = &self.materials[part.material];
                let h = column.to - column.from;
                let [stored, moved] = energies(part, &self.mesh.rule, h, of, self.n, motion);
                strain[part.material] += stored;
                mass += moved;
            }
        }
        (strain, mass)
    }

    /// The motion of the outer surface at `x` (m): U, V, W.
    pub fn surface(&self, motion: &[f64], x: f64) -> [f64; 3] {
        let (c, along) = self.place(x);
        let part = self.mesh.cells[c].len() - 1;
        let [p, q] = self.mesh.degrees;
        let links = &self.links[c][part];
        let mut surface = [0.0; 3];
        for (component, value) in surface.iter_mut().enumerate() {
            for (i, f) in along.iter().enumerate().take(p + 1) {
                let slot = component * (p + 1) * (q + 1) + i * (q + 1) + 1;
                let own = links.of(slot).iter().map(|(u, share)| share * motion[*u]);
                *value += f * own.sum::<f64>();
            }
        }
        surface
    }

    /// Outer radius at `x` (m).
    pub fn radius(&self, x: f64) -> f64 {
        let (c, xi) = self.locate(x);
        let parts = &self.mesh.columns[c].parts;
        parts[parts.len() - 1].outer.at(xi)[0]
    }

    /// The column at `x`, and the values of the functions along it there.
    fn place(&self, x: f64) -> (usize, Vec<f64>) {
        let (c, xi) = self.locate(x);
        (c, crate::beam::wall::shapes::at(self.mesh.degrees[0], xi)[0].clone())
    }

    /// The column at `x`, and the position in it, ξ in [−1, 1].
    fn locate(&self, x: f64) -> (usize, f64) {
        let columns = &self.mesh.columns;
        let c = columns.partition_point(|column| column.from <= x).max(1) - 1;
        let column = &columns[c];
        (c, (2.0 * (x - column.from) / (column.to - column.from) - 1.0).clamp(-1.0, 1.0))
    }

    /// Number of eigenvalues below `bound` (1/s²), rigid motions included.
    pub fn count_below(&self, bound: f64) -> usize {
        self.factors(-bound).negative()
    }
}
