//! Poles with the residues of every response of a set.

use faer::c64;
use sweetspot_tap::fit::Pole;
use sweetspot_tap::orders::Orders;
use sweetspot_tap::resonances::{POWERS, Projection, Responses};

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
    /// The poles that are modes.
    pub kept: Vec<usize>,
}

/// A part of a response, at a complex square of the frequency.
#[derive(Clone, Copy)]
pub(super) enum Portion {
    /// The residue at a pole.
    Residue(usize),
    /// What rigid motions answer.
    Rigid,
    /// What modes beyond the band, and poles that are no mode, answer.
    Beyond(c64),
    /// All of it.
    All(c64),
}

impl<'a> Fitted<'a> {
    /// The residues at these poles.
    pub fn new(
        set: &'a ResponseSet,
        groups: &'a [Group],
        all: Vec<Responses>,
        found: &'a Orders,
        kept: Vec<usize>,
    ) -> Self {
        let project = |one: &Responses| Projection::new(one, &found.fit.poles, found.damping);
        let projections = all.iter().map(project).collect();
        Self { set, groups, all, projections, found, kept }
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

    /// The weights of a response's coefficients in a part of it.
    fn weights(&self, of: &Responses, part: Portion) -> Vec<c64> {
        let poles = self.poles();
        match part {
            Portion::Residue(p) => Responses::residue(p, poles.len()),
            Portion::Rigid => of.at(poles, c64::ZERO),
            Portion::All(z) => of.at(poles, z),
            Portion::Beyond(z) => {
                let mut weights = of.at(poles, z);
                weights[0] = c64::ZERO;
                self.kept.iter().for_each(|p| weights[POWERS + p] = c64::ZERO);
                weights
            }
        }
    }

    /// A part of response `k` (1/kg).
    pub fn value(&self, k: usize, part: Portion) -> c64 {
        let (g, j) = self.place(k);
        let of = &self.all[g];
        self.projections[g].value(of, j, &self.weights(of, part))
    }

    /// Its standard deviation (1/kg), real and imaginary part together, at known poles.
    pub fn deviation(&self, k: usize, part: Portion) -> f64 {
        let (g, j) = self.place(k);
        let of = &self.all[g];
        self.projections[g].deviation(of, j, &self.weights(of, part))
    }
}
