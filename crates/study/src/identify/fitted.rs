//! Poles with the residues of every response of a set.

use faer::c64;
use sweetspot_tap::fit::Pole;
use sweetspot_tap::orders::Orders;
use sweetspot_tap::resonances::{Projection, Responses};

use crate::identify::set::ResponseSet;

/// Responses over one grid, and their indices in the set.
pub(super) struct Group {
    /// Their places in the set.
    pub which: Vec<usize>,
    /// The responses.
    pub responses: Responses,
}

/// Poles with the residues of every response.
pub(super) struct Fitted<'a> {
    /// The set.
    pub set: &'a ResponseSet,
    groups: &'a [Group],
    all: Vec<Responses>,
    projections: Vec<Projection>,
    /// The poles, and the results for every number of poles.
    pub found: &'a Orders,
}

impl<'a> Fitted<'a> {
    /// The residues at these poles.
    pub fn new(
        set: &'a ResponseSet,
        groups: &'a [Group],
        all: Vec<Responses>,
        found: &'a Orders,
    ) -> Self {
        let project = |one: &Responses| Projection::new(one, &found.fit.poles, found.damping);
        let projections = all.iter().map(project).collect();
        Self { set, groups, all, projections, found }
    }

    /// The poles.
    pub fn poles(&self) -> &[Pole] {
        &self.found.fit.poles
    }

    /// The group of response `k` of the set, and its index in the group.
    fn place(&self, k: usize) -> (usize, usize) {
        let at = |group: &Group| group.which.iter().position(|which| *which == k);
        let place = self.groups.iter().enumerate().find_map(|(g, group)| Some((g, at(group)?)));
        place.expect("every response is in a group")
    }

    /// Residue (1/kg) of response `k` at pole `p`.
    pub fn residue(&self, k: usize, p: usize) -> c64 {
        let (g, j) = self.place(k);
        self.projections[g].value(&self.all[g], j, &Responses::residue(p, self.poles().len()))
    }

    /// Standard deviation (1/kg) of that residue, real and imaginary part together, at known poles.
    pub fn deviation(&self, k: usize, p: usize) -> f64 {
        let (g, j) = self.place(k);
        self.projections[g].deviation(&self.all[g], j, &Responses::residue(p, self.poles().len()))
    }

    /// Standard deviation (1/kg) of response `k` at a complex square of the frequency, likewise.
    pub fn deviation_at(&self, k: usize, z: c64) -> f64 {
        let (g, j) = self.place(k);
        let weights = self.all[g].at(self.poles(), None, z);
        self.projections[g].deviation(&self.all[g], j, &weights)
    }

    /// Response `k` (1/kg) at a complex square of the frequency, without the pole `without`.
    pub fn at(&self, k: usize, without: Option<usize>, z: c64) -> c64 {
        let (g, j) = self.place(k);
        let weights = self.all[g].at(self.poles(), without, z);
        self.projections[g].value(&self.all[g], j, &weights)
    }
}
