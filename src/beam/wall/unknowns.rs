//! Which unknowns describe the motion of the wall, and how do unequal neighbours share them?
//!
//! Functions belong to the borders between columns, to the edges between parts, and to the inside of parts. If the
//! columns to the left and right of a border are cut differently, both take the values of polynomials on the border's
//! own intervals: the radii that lie inside no part of either side. The motion is then continuous, however the layers
//! end.

use std::ops::Range;

use crate::base::{Error, Result};
use crate::beam::wall::cell::{WallCell, WallRule};
use crate::beam::wall::columns::WallColumn;
use crate::beam::wall::layers::{SAME_RADIUS, meet};
use crate::beam::wall::shapes::restricted;

/// How an end of the wall is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EndHold {
    /// It is free.
    #[default]
    Free,
    /// It stays round and in place, but may move along the bat.
    Diaphragm,
    /// It does not move.
    Clamped,
}

/// Expresses every function of an element in functions of the mesh, with their shares.
#[derive(Debug, Clone, Default)]
pub struct Sharing {
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

impl Sharing {
    fn push(&mut self, entries: impl IntoIterator<Item = (usize, f64)>) {
        if self.starts.is_empty() {
            self.starts.push(0);
        }
        self.entries.extend(entries);
        self.starts.push(self.entries.len());
    }

    /// The functions of the mesh, with their shares, that make up function `k` of the element.
    pub fn of(&self, k: usize) -> &[(usize, f64)] {
        &self.entries[self.starts[k]..self.starts[k + 1]]
    }
}

/// The elements of a wall, with numbered functions.
#[derive(Debug, Clone)]
pub struct WallMesh {
    /// The columns, from the knob side on.
    pub columns: Vec<WallColumn>,
    /// Degree along the bat and across the wall.
    pub degrees: [usize; 2],
    /// Shape functions and points.
    pub rule: WallRule,
    /// Radii of the intervals of every border (m).
    pub borders: Vec<Vec<f64>>,
    /// Functions of every border.
    pub at_border: Vec<Range<usize>>,
    /// Functions inside the parts of a column, one range for each part, then those on its edges.
    pub inside: Vec<Vec<Range<usize>>>,
    /// Integrals of every part of every column.
    pub cells: Vec<Vec<WallCell>>,
    /// The functions of every part in terms of those of the mesh.
    pub sharing: Vec<Vec<Sharing>>,
    /// Number of functions.
    pub functions: usize,
    /// Which functions are not 0 on the axis.
    pub on_axis: Vec<bool>,
}

impl WallMesh {
    /// The mesh of these columns with polynomials of degree p along and q across.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if two columns do not meet.
    pub fn new(columns: Vec<WallColumn>, [p, q]: [usize; 2]) -> Result<Self> {
        let rule = WallRule::new(p, q);
        let borders = borders(&columns)?;
        let mut mesh = Self {
            degrees: [p, q],
            rule,
            at_border: vec![],
            inside: vec![],
            cells: vec![],
            sharing: vec![],
            functions: 0,
            on_axis: vec![],
            columns: vec![],
            borders,
        };
        mesh.number(&columns);
        for (c, column) in columns.iter().enumerate() {
            let h = column.to - column.from;
            let cell = |part| WallCell::new(part, &mesh.rule, h);
            let cells = column.parts.iter().map(cell).collect();
            let sharing = (0..column.parts.len()).map(|k| mesh.share(column, c, k)).collect();
            mesh.cells.push(cells);
            mesh.sharing.push(sharing);
        }
        mesh.columns = columns;
        Ok(mesh)
    }

    /// Numbers the functions: a border, the column beyond it, the next border.
    fn number(&mut self, columns: &[WallColumn]) {
        let [p, q] = self.degrees;
        let mut next = 0;
        let mut take = |count: usize, axis: bool, on_axis: &mut Vec<bool>, first: usize| {
            // Of consecutive functions, the first `first` are at the innermost radius.
            on_axis.extend((0..count).map(|k| axis && k < first));
            next += count;
            next - count..next
        };
        for (c, border) in self.borders.iter().enumerate() {
            let axis = border[0].abs() <= SAME_RADIUS * border[border.len() - 1];
            let count = (border.len() - 1) * q + 1;
            self.at_border.push(take(count, axis, &mut self.on_axis, 1));
            let Some(column) = columns.get(c) else { continue };
            let parts = column.parts.len();
            let bubbles = (p - 1) * (q - 1);
            let mut ranges: Vec<Range<usize>> =
                (0..parts).map(|_| take(bubbles, false, &mut self.on_axis, 0)).collect();
            let axis = column.parts[0].inner.is_axis();
            ranges.push(take((p - 1) * (parts + 1), axis, &mut self.on_axis, p - 1));
            self.inside.push(ranges);
        }
        self.functions = self.on_axis.len();
    }

    /// The functions of part `k` of column `c` in terms of those of the mesh.
    fn share(&self, column: &WallColumn, c: usize, k: usize) -> Sharing {
        let [p, q] = self.degrees;
        let mut sharing = Sharing::default();
        for end in 0..2 {
            let radii = column.radii(end == 1);
            let border = &self.borders[c + end];
            let first = self.at_border[c + end].start;
            let (a, b) = (radii[k], radii[k + 1]);
            let middle = 0.5 * (a + b);
            let m = border.partition_point(|r| *r < middle).clamp(1, border.len() - 1) - 1;
            let (low, high) = (border[m], border[m + 1]);
            // Nodes first, then the bubbles of every interval.
            let whole = |a: usize| match a {
                0 => first + m,
                1 => first + m + 1,
                _ => first + border.len() + m * (q - 1) + a - 2,
            };
            let same = SAME_RADIUS * border[border.len() - 1];
            if (a - low).abs() <= same && (b - high).abs() <= same {
                (0..=q).for_each(|a| sharing.push([(whole(a), 1.0)]));
                continue;
            }
            let xi = |r: f64| 2.0 * (r - low) / (high - low) - 1.0;
            for row in restricted(q, [xi(a), xi(b)]) {
                let entries = row.into_iter().enumerate().filter(|(_, share)| share.abs() > 1e-15);
                sharing.push(entries.map(|(a, share)| (whole(a), share)));
            }
        }
        let ranges = &self.inside[c];
        let edges = ranges[ranges.len() - 1].start;
        for i in 0..p - 1 {
            for a in 0..=q {
                let function = match a {
                    0 | 1 => edges + (k + a) * (p - 1) + i,
                    _ => ranges[k].start + i * (q - 1) + a - 2,
                };
                sharing.push([(function, 1.0)]);
            }
        }
        sharing
    }
}

/// The intervals of every border: the radii of both sides, except those inside a part of the other side.
fn borders(columns: &[WallColumn]) -> Result<Vec<Vec<f64>>> {
    let mut borders = vec![columns[0].radii(false)];
    for pair in columns.windows(2) {
        let (left, right) = (pair[0].radii(true), pair[1].radii(false));
        if !meet(&left, &right) {
            let found = format!("walls that do not meet at {} m", pair[0].to);
            return Err(Error::value("profile", found, "walls that meet at a step"));
        }
        let same = SAME_RADIUS * left[left.len() - 1];
        let passes = |radii: &[f64], r: f64| {
            let inside = r > radii[0] + same && r < radii[radii.len() - 1] - same;
            inside && radii.iter().all(|other| (other - r).abs() > same)
        };
        let mut both: Vec<f64> = left.iter().chain(&right).copied().collect();
        both.retain(|r| !passes(&left, *r) && !passes(&right, *r));
        both.sort_by(f64::total_cmp);
        both.dedup_by(|a, b| (*a - *b).abs() <= same);
        borders.push(both);
    }
    borders.push(columns[columns.len() - 1].radii(true));
    Ok(borders)
}

/// The unknowns of one harmonic: the index of each component of each function.
#[derive(Debug, Clone)]
pub struct Unknowns {
    /// For U, V, W of every function the unknown and its share; `None` if the component is 0.
    pub of: Vec<[Option<(usize, f64)>; 3]>,
    /// Number of unknowns to solve for.
    pub count: usize,
    /// Number of further unknowns, numbered after these, that are held at 0 to prevent a rigid motion.
    pub held: usize,
}

impl Unknowns {
    /// The unknowns of harmonic n with both ends held so.
    ///
    /// On the axis a motion is one-valued: all is 0 there for n ≥ 2, `V = −U` and `W = 0` for n = 1, `U = V = 0`
    /// for n = 0, whose V is 0 everywhere.
    pub fn new(mesh: &WallMesh, n: usize, ends: [EndHold; 2]) -> Self {
        // Of harmonic 0 with both ends free along the bat, the displacement along it of one function.
        let rigid = n == 0 && ends.iter().all(|end| *end != EndHold::Clamped);
        Self::of(mesh, n, ends, rigid)
    }

    /// The unknowns of harmonic n on that mesh, with nothing held against a rigid motion.
    pub fn free(mesh: &WallMesh, n: usize, ends: [EndHold; 2]) -> Self {
        Self::of(mesh, n, ends, false)
    }

    fn of(mesh: &WallMesh, n: usize, ends: [EndHold; 2], rigid: bool) -> Self {
        let mut of = vec![[None; 3]; mesh.functions];
        let mut count = 0;
        let last = &mesh.at_border[mesh.at_border.len() - 1];
        let intervals = mesh.borders[mesh.borders.len() - 1].len();
        let held_function = rigid.then_some(last.start + intervals - 1);
        let mut held = None;
        for (function, of) in of.iter_mut().enumerate() {
            let mut keep = [true, n > 0, true];
            if mesh.on_axis[function] {
                match n {
                    0 => keep[0] = false,
                    1 => keep = [true, false, false],
                    _ => keep = [false; 3],
                }
            }
            for (range, end) in [(&mesh.at_border[0], ends[0]), (last, ends[1])] {
                if range.contains(&function) {
                    match end {
                        EndHold::Free => {}
                        EndHold::Diaphragm => (keep[0], keep[1]) = (false, false),
                        EndHold::Clamped => keep = [false; 3],
                    }
                }
            }
            for c in 0..3 {
                if c == 2 && held_function == Some(function) {
                    held = Some(function);
                } else if keep[c] {
                    of[c] = Some((count, 1.0));
                    count += 1;
                }
            }
            if n == 1 && mesh.on_axis[function] {
                of[1] = of[0].map(|(unknown, _)| (unknown, -1.0));
            }
        }
        if let Some(function) = held {
            of[function][2] = Some((count, 1.0));
        }
        Self { of, count, held: usize::from(held.is_some()) }
    }

    /// All unknowns, those held at 0 included.
    pub fn all(&self) -> usize {
        self.count + self.held
    }
}
