//! Which functions of the mesh move the outer surface, and how does a ball's patch load them?

use std::f64::consts::PI;
use std::ops::Range;

use crate::base::linear::dot;
use crate::base::quadrature::gauss;
use crate::beam::wall::layers::Radius;
use crate::beam::wall::shapes;
use crate::beam::wall::unknowns::{Unknowns, WallMesh};
use crate::modes::hoop::patch::{Patch, Share};
use crate::modes::hoop::spectrum::Spectrum;

/// The outer surface of a wall, without the elements below it.
#[derive(Debug, Clone)]
pub struct Surface {
    strips: Vec<Strip>,
    /// Degree along the bat.
    degree: usize,
    /// The functions of the mesh that move it, from the knob side on.
    pub functions: Vec<usize>,
}

/// The surface of a column of elements.
#[derive(Debug, Clone)]
struct Strip {
    /// Beginning and end (m).
    ends: [f64; 2],
    radius: Radius,
    /// The surface's functions, with their shares, that make up each shape function along it.
    made_of: Vec<Vec<(usize, f64)>>,
}

impl Surface {
    /// The surface of the elements of that mesh.
    pub fn of(mesh: &WallMesh) -> Self {
        let [degree, across] = mesh.degrees;
        let mut surface = Self { strips: vec![], degree, functions: vec![] };
        for (column, sharing) in mesh.columns.iter().zip(&mesh.sharing) {
            let (Some(part), Some(sharing)) = (column.parts.last(), sharing.last()) else {
                continue;
            };
            // Function 1 across is 1 on the outside, all others are 0 there.
            let along = (0..=degree).map(|i| {
                let own = sharing.of(i * (across + 1) + 1).iter();
                own.map(|(function, share)| (surface.index(*function), *share)).collect()
            });
            let made_of = along.collect();
            let (ends, radius) = ([column.from, column.to], part.outer.clone());
            surface.strips.push(Strip { ends, radius, made_of });
        }
        surface
    }

    /// The index of a mesh function among those of the surface. It occurred at most one column before.
    fn index(&mut self, function: usize) -> usize {
        let known = self.functions.iter().rposition(|known| *known == function);
        known.unwrap_or_else(|| {
            self.functions.push(function);
            self.functions.len() - 1
        })
    }

    /// Beginning and end of the modelled stretch (m).
    pub fn ends(&self) -> [f64; 2] {
        [self.strips[0].ends[0], self.strips[self.strips.len() - 1].ends[1]]
    }

    /// Distance between the strips of some functions and those of a later one (m); 0 if they share a strip.
    pub fn gap(&self, some: Range<usize>, later: usize) -> f64 {
        let has = |strip: &Strip, k: &Range<usize>| {
            strip.made_of.iter().flatten().any(|(of, _)| k.contains(of))
        };
        let end = self.strips.iter().rfind(|strip| has(strip, &some)).map(|strip| strip.ends[1]);
        let later = later..later + 1;
        let start = self.strips.iter().find(|strip| has(strip, &later)).map(|strip| strip.ends[0]);
        start.zip(end).map_or(0.0, |(start, end)| (start - end).max(0.0))
    }

    /// Outer radius at `x` (m).
    pub fn radius(&self, x: f64) -> f64 {
        let (strip, xi) = self.strip(x);
        strip.radius.at(xi)[0]
    }

    /// The strip at `x`, and the position in it, ξ in [−1, 1].
    fn strip(&self, x: f64) -> (&Strip, f64) {
        let strip = self.strips.partition_point(|strip| strip.ends[0] <= x).max(1) - 1;
        let strip = &self.strips[strip];
        let [from, to] = strip.ends;
        (strip, (2.0 * (x - from) / (to - from) - 1.0).clamp(-1.0, 1.0))
    }

    /// The load of a patch with resultant 1 on the functions of the surface: their indices and loads. Beyond an end
    /// there is nothing to press on, so the remaining part carries all.
    pub fn load(&self, patch: &Patch) -> Vec<(usize, f64)> {
        let (from, to) = (patch.x - patch.half_length, patch.x + patch.half_length);
        let weight = |x: f64| 1.0 - ((x - patch.x) / patch.half_length).powi(2);
        let mut load = vec![0.0; self.functions.len()];
        let mut add = |strip: &Strip, xi: f64, weight: f64| {
            for (value, made_of) in shapes::at(self.degree, xi)[0].iter().zip(&strip.made_of) {
                made_of.iter().for_each(|(k, share)| load[*k] += weight * value * share);
            }
        };
        let mut total = 0.0;
        let rule = gauss(self.degree + 3);
        for strip in &self.strips {
            let [start, end] = strip.ends;
            let (a, b) = (start.max(from), end.min(to));
            if b > a {
                for (s, w) in &rule {
                    let x = a + (b - a) * s;
                    let pressed = w * (b - a) * weight(x);
                    total += pressed;
                    add(strip, 2.0 * (x - start) / (end - start) - 1.0, pressed);
                }
            }
        }
        if total <= 0.0 {
            let (strip, xi) = self.strip(patch.x);
            add(strip, xi, 1.0);
            total = 1.0;
        }
        let load = load.into_iter().enumerate().filter(|(_, load)| *load != 0.0);
        load.map(|(k, load)| (k, load / total)).collect()
    }

    /// The unknown of the radial motion of each function, and its sign; `None` if it is held.
    pub fn radial<'a>(
        &'a self,
        unknowns: &'a Unknowns,
    ) -> impl Iterator<Item = Option<(usize, f64)>> + 'a {
        self.functions.iter().map(|function| unknowns.of[*function][0])
    }

    /// The compliance of a harmonic under a patch, by a solve.
    pub fn under(&self, spectrum: &Spectrum, patch: &Patch) -> Share {
        let system = &spectrum.system;
        let (n, unknowns) = (system.n, &system.unknowns);
        let radial: Vec<Option<(usize, f64)>> = self.radial(unknowns).collect();
        let g = patch.share(n, self.radius(patch.x));
        let mut load = vec![0.0; unknowns.all()];
        for (k, weight) in self.load(patch) {
            if let Some((unknown, sign)) = radial[k] {
                load[unknown] += g * sign * weight;
            }
        }
        let mut given = load.clone();
        spectrum.factors.solve(&mut given[..unknowns.count]);
        let mut moved = vec![0.0; load.len()];
        system.mass(&given, &mut moved);
        if let Some((rigid, _)) = &spectrum.rigid {
            let part = dot(rigid, &moved);
            given.iter_mut().zip(rigid).for_each(|(x, r)| *x -= part * r);
            system.mass(&given, &mut moved);
        }
        let turn = if n == 0 { 2.0 * PI } else { PI };
        Share {
            harmonic: n,
            gains: spectrum
                .motions
                .iter()
                .map(|motion| dot(&load, motion).powi(2) / turn)
                .collect(),
            flexibility: dot(&load, &given) / turn,
            slowness: dot(&given, &moved) / turn,
        }
    }
}
