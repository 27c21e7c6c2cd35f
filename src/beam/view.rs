//! A bat on its elements, whatever their degree and theory.

use std::ops::{Deref, Range};

use crate::base::Real;
use crate::bat::Theory;
use crate::beam::fixed::Fixed;
use crate::beam::placed::Placed;
use crate::beam::rule::Rule;
use crate::beam::statics::Statics;
use crate::beam::sweep::{Bare, CellView};
use crate::beam::walk::{Run, runs};

/// A bat with elements of any degree and theory. Code that does not step through the strains many times uses this view
/// and is compiled once.
#[derive(Clone, Copy)]
pub struct View<'a, S> {
    /// The bare bat; its fields are read as the view's own.
    pub bare: Bare<'a, S>,
    /// Where the elements are sampled.
    pub rule: &'static Rule,
    /// The beam theory.
    pub theory: Theory,
    /// EI (N m²) at the points of every cell, outwards.
    pub bending_stiffness: &'a [S],
    /// ρA (kg/m) likewise.
    pub mass_per_length: &'a [S],
    /// ρI (kg m) likewise; empty where sections do not turn.
    pub turning_per_length: &'a [S],
    /// κGA (N) likewise; empty without shear.
    pub shear_stiffness: &'a [S],
    /// 1/EI (1/(N m²)) and 1/κGA (1/N) likewise.
    pub softness: [&'a [S]; 2],
    /// Whether elements reach over stations.
    pub over: bool,
    /// Length of the bat (m).
    pub length: S,
    /// The fixtures, if any.
    pub fixed: Option<&'a Fixed<S>>,
}

impl<'a, S> Deref for View<'a, S> {
    type Target = Bare<'a, S>;

    #[inline(always)]
    fn deref(&self) -> &Bare<'a, S> {
        &self.bare
    }
}

impl<'a, S: Real> View<'a, S> {
    /// The cells of one side from stop to stop.
    #[inline(always)]
    pub fn runs(&self, side: usize) -> impl DoubleEndedIterator<Item = Run> + use<'a, S> {
        let stops = self.fixed.map_or(&[][..], |fixed| &fixed.placed.stops[side]);
        runs(self.side(side), stops)
    }

    /// Number of strains, including those of springs.
    pub fn dimension(&self) -> usize {
        self.strains * self.count + self.fixed.map_or(0, |fixed| fixed.placed.springs)
    }

    /// Number of free rigid motions.
    pub fn rigid_modes(&self) -> usize {
        self.fixed.map_or(2, Fixed::rigid_modes)
    }

    /// Number of bending modes of the discrete bat.
    pub fn freedom(&self) -> usize {
        self.dimension() - self.fixed.map_or(0, Fixed::redundant)
    }

    /// The contacts of the bed under a cell.
    #[inline(always)]
    pub fn bed(&self, cell: usize) -> Option<Range<usize>> {
        self.placed()?.bed(cell, self.terms)
    }

    /// The cell with that index, and the indices of its numbers.
    #[inline(always)]
    pub fn at(&self, number: usize) -> Located<'a, S> {
        let of = |each: usize| number * each..(number + 1) * each;
        let (strains, terms, samples) = (of(self.strains), of(self.terms), of(self.rule.count()));
        Located { number, cell: self.cells.at(number), strains, terms, samples }
    }

    /// The fixtures at their places.
    #[inline(always)]
    pub fn placed(&self) -> Option<&'a Placed<S>> {
        self.fixed.map(|fixed| &fixed.placed)
    }
}

/// A cell, and the indices of its numbers among those of all cells.
#[derive(Debug, Clone)]
pub struct Located<'a, S> {
    /// Index of the cell.
    pub number: usize,
    /// The cell itself.
    pub cell: CellView<'a, S>,
    /// Indices of its strains.
    pub strains: Range<usize>,
    /// Indices of its Legendre coefficients.
    pub terms: Range<usize>,
    /// Indices of the values at its Gauss points.
    pub samples: Range<usize>,
}

impl<S: Real, const N: usize, const W: usize> Statics<S, N, W> {
    /// The bare bat without the size of its elements in the type.
    pub fn bare(&self) -> Bare<'_, S> {
        Bare {
            terms: N,
            strains: W - 2,
            count: self.cells.len(),
            split: self.split,
            cells: &self.cells,
            mass: self.mass,
            inertia: self.inertia,
            balance: self.balance,
            energy_unit: self.energy_unit,
        }
    }

    /// The bat without the size of its elements in the type.
    pub fn view(&self) -> View<'_, S> {
        View {
            bare: self.bare(),
            rule: self.rule,
            theory: self.theory,
            bending_stiffness: &self.bending_stiffness,
            mass_per_length: &self.mass_per_length,
            turning_per_length: &self.turning_per_length,
            shear_stiffness: &self.shear_stiffness,
            softness: [&self.softness[0], &self.softness[1]],
            over: self.over,
            length: self.length,
            fixed: self.fixed.as_deref(),
        }
    }
}
