//! Which layers does the wall have, from the bore to the surface, and where do they change?

use crate::base::quadrature::legendre;
use crate::base::{Error, Result, gauss};
use crate::bat::{Bat, Material, Piece, Radii, SAME_PLACE};
use crate::beam::wall::elastic::{ASSUMED_POISSON_RATIO, Elastic, poisson_ratio};
use crate::beam::wall::extent::is_wood;

/// Radii that differ by less than this share of the largest are equal.
pub const SAME_RADIUS: f64 = 1e-9;
/// Slopes of a radius that differ by less are equal: the formula continues.
const SAME_SLOPE: f64 = 1e-7;
/// Number of points for the polynomial of a formula on one column of elements.
const FORMULA_POINTS: usize = 16;

/// A stretch where all radii are smooth and the materials do not change.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// Where it begins (m).
    pub from: f64,
    /// Where it ends (m).
    pub to: f64,
    /// Indices of the layers' materials, from the inside out.
    pub materials: Vec<usize>,
    pieces: Vec<Piece>,
    filled: bool,
    sleeves: Vec<f64>,
}

/// The wall between two places of a bat.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    /// The stretches, from the knob on.
    pub stretches: Vec<Stretch>,
    /// The materials of the layers.
    pub materials: Vec<Elastic>,
    /// Indices of the materials whose Poisson's ratio was unknown and was taken as [`ASSUMED_POISSON_RATIO`].
    pub assumed: Vec<usize>,
}

/// A radius along a column of elements, as a series of Legendre polynomials in its ξ.
#[derive(Debug, Clone, PartialEq)]
pub struct Radius(pub Vec<f64>);

impl Radius {
    /// The radius (m) and its derivative by ξ, by Clenshaw's rule in plain sums.
    pub fn at(&self, xi: f64) -> [f64; 2] {
        let p = legendre(self.0.len(), xi);
        let (mut value, mut slope) = (0.0, 0.0);
        // P_k′ = (2k − 1) P_{k−1} + P_{k−2}′.
        let mut slopes = vec![0.0; self.0.len().max(2)];
        slopes[1] = 1.0;
        for k in 0..self.0.len() {
            if k > 1 {
                slopes[k] = (2 * k - 1) as f64 * p[k - 1] + slopes[k - 2];
            }
            value += self.0[k] * p[k];
            slope += self.0[k] * slopes[k];
        }
        [value, slope]
    }

    /// The radius at a `share`, 0 to 1, of the way from this one to another.
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        let between = |(a, b): (&f64, &f64)| (1.0 - share) * a + share * b;
        Self(self.0.iter().zip(&other.0).map(between).collect())
    }

    /// Whether it is 0 everywhere.
    pub fn is_axis(&self) -> bool {
        self.0.iter().all(|coefficient| coefficient.abs() < 1e-15)
    }
}

impl Stretch {
    /// Radii of the layers' borders at `x`, from the inside out (m).
    pub fn radii(&self, x: f64) -> Vec<f64> {
        let k = self.pieces.partition_point(|piece| piece.start <= x).max(1) - 1;
        let piece = &self.pieces[k];
        let section = piece.at(((x - piece.start) / piece.length).clamp(0.0, 1.0));
        let mut radii = if self.filled { vec![0.0, section.inner] } else { vec![section.inner] };
        let mut radius = section.outer - self.sleeves.iter().sum::<f64>();
        radii.push(radius);
        for sleeve in &self.sleeves {
            radius += sleeve;
            radii.push(radius);
        }
        radii
    }

    /// Radii of the layers from the bore out, along a part of the stretch, as polynomials.
    pub fn along(&self, from: f64, to: f64) -> Vec<Radius> {
        let cubic = matches!(self.pieces[0].radii, Radii::Cubic(_));
        let points = gauss(if cubic { 4 } else { FORMULA_POINTS });
        let layers = self.materials.len() + 1;
        let mut radii = vec![Radius(vec![0.0; points.len()]); layers];
        for (s, weight) in &points {
            let p = legendre(points.len(), 2.0 * s - 1.0);
            for (radius, value) in radii.iter_mut().zip(self.radii(from + (to - from) * s)) {
                for (k, coefficient) in radius.0.iter_mut().enumerate() {
                    *coefficient += (2 * k + 1) as f64 * weight * value * p[k];
                }
            }
        }
        // A difference as small as round-off is dropped; a constant radius then stays constant.
        for radius in &mut radii {
            let largest = radius.0[0].abs();
            let small = |c: &&mut f64| c.abs() < f64::EPSILON * largest;
            radius.0.iter_mut().skip(1).filter(small).for_each(|c| *c = 0.0);
        }
        radii
    }

    /// Slopes `dr/dx` of the layers' borders at one end, the end at `to` if `at_end`.
    pub fn slopes(&self, at_end: bool) -> Vec<f64> {
        let part = (self.to - self.from).min(1e-3 * self.to.max(self.to - self.from));
        let part = part.max(0.01 * (self.to - self.from));
        let (from, to, xi) = match at_end {
            true => (self.to - part, self.to, 1.0),
            false => (self.from, self.from + part, -1.0),
        };
        let slope = |radius: &Radius| radius.at(xi)[1] * 2.0 / (to - from);
        self.along(from, to).iter().map(slope).collect()
    }

    /// The largest radius (m) at eleven even places.
    pub fn widest(&self) -> f64 {
        let outer = |k: i32| {
            let x = self.from + (self.to - self.from) * f64::from(k) / 10.0;
            *self.radii(x).last().expect("a wall has a surface")
        };
        (0..=10).map(outer).fold(0.0, f64::max)
    }

    /// Whether the stiffest layer continues into the next stretch between the same radii, and all others are far
    /// softer.
    pub fn stays_stiff(&self, next: &Self, materials: &[Elastic]) -> bool {
        let all = self.materials.iter().chain(&next.materials);
        let Some(stiffest) = stiff_among(all, materials) else { return false };
        let place = |of: &Self, radii: Vec<f64>| {
            let at = of.materials.iter().position(|material| *material == stiffest)?;
            Some([radii[at], radii[at + 1]])
        };
        match (place(self, self.radii(self.to)), place(next, next.radii(next.from))) {
            (Some(a), Some(b)) => a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME_RADIUS * b),
            _ => false,
        }
    }

    /// Whether all its layers except the stiffest are far softer.
    pub fn is_soft_within(&self, materials: &[Elastic]) -> bool {
        stiff_among(self.materials.iter(), materials).is_some()
    }

    /// Change of slope of each border if the next stretch continues with the same layers; otherwise `None`.
    pub fn kinks(&self, next: &Self) -> Option<Vec<f64>> {
        if self.materials != next.materials {
            return None;
        }
        let (left, right) = (self.radii(self.to), next.radii(next.from));
        let size = left.last().expect("a wall has a surface");
        let same = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME_RADIUS * size;
        if !left.iter().zip(&right).all(same) {
            return None;
        }
        let slopes = self.slopes(true).into_iter().zip(next.slopes(false));
        Some(slopes.map(|(a, b)| (a - b).abs()).collect())
    }
}

impl Layers {
    /// The layers of a bat between two places (m).
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if a layer is of wood, which has no symmetry of revolution, or if the walls to the left and
    /// right of a step do not meet.
    pub fn of(bat: &Bat, from: f64, to: f64) -> Result<Self> {
        let mut layers = Self { stretches: vec![], materials: vec![], assumed: vec![] };
        let mut known: Vec<Material> = vec![];
        let same = SAME_PLACE * bat.length();
        for piece in &bat.profile().pieces {
            let (start, end) = (piece.start.max(from), (piece.start + piece.length).min(to));
            if end - start <= same {
                continue;
            }
            let layup = bat.layup(piece);
            let bore = [0.0, 0.5, 1.0].iter().any(|s| piece.at(*s).inner > 0.0);
            let core = layup.core.as_ref().filter(|_| bore);
            let filled = core.is_some();
            let sleeves = layup.sleeves.iter();
            let all = core
                .into_iter()
                .chain([&layup.outer])
                .chain(sleeves.clone().map(|sleeve| &sleeve.material));
            let mut materials = vec![];
            for material in all {
                materials.push(layers.index(material, &mut known)?);
            }
            let sleeves: Vec<f64> = sleeves.map(|sleeve| sleeve.thickness).collect();
            let pieces = vec![piece.clone()];
            let next = Stretch { from: start, to: end, materials, pieces, filled, sleeves };
            layers.add(next);
        }
        if layers.stretches.is_empty() {
            let found = format!("{from} to {to} m");
            return Err(Error::value("from", found, "a stretch of the bat"));
        }
        layers.check_steps()?;
        Ok(layers)
    }

    /// The changes of slope at all places where the layers continue; `None` if layers make a corner.
    pub fn kinks(&self) -> Option<Vec<f64>> {
        let one = |stretch: &Stretch| stretch.materials.windows(2).all(|pair| pair[0] == pair[1]);
        let ends = [&self.stretches[0], &self.stretches[self.stretches.len() - 1]];
        if !ends.into_iter().all(one) {
            return None;
        }
        let each: Option<Vec<Vec<f64>>> =
            self.stretches.windows(2).map(|pair| pair[0].kinks(&pair[1])).collect();
        Some(each?.concat())
    }

    /// Whether all corners belong to layers far softer than the wall that continues beside them.
    pub fn stays_stiff(&self) -> bool {
        let goes_on = |pair: &[Stretch]| {
            pair[0].kinks(&pair[1]).is_some() || pair[0].stays_stiff(&pair[1], &self.materials)
        };
        let ends = [&self.stretches[0], &self.stretches[self.stretches.len() - 1]];
        let soft = ends.into_iter().all(|end| end.is_soft_within(&self.materials));
        soft && self.stretches.windows(2).all(goes_on)
    }

    /// The index of a material.
    fn index(&mut self, material: &Material, known: &mut Vec<Material>) -> Result<usize> {
        if let Some(index) = known.iter().position(|one| one == material) {
            return Ok(index);
        }
        if is_wood(material) {
            let name = material.name.as_deref().unwrap_or("a material like wood");
            let expected = "a metal or a composite: wood differs with the direction of its grain, \
                            so that its wall is no solid of revolution";
            return Err(Error::value("material", name, expected));
        }
        let ratio = poisson_ratio(material);
        let index = known.len();
        known.push(material.clone());
        if let Some(elastic) = Elastic::orthotropic(material)? {
            self.materials.push(elastic);
            return Ok(index);
        }
        if ratio.is_none() {
            self.assumed.push(index);
        }
        let ratio = ratio.unwrap_or(ASSUMED_POISSON_RATIO);
        self.materials.push(Elastic::isotropic(material, ratio));
        Ok(index)
    }

    /// Adds a stretch; extends the last one if both belong to one formula without a kink between them.
    fn add(&mut self, next: Stretch) {
        if let Some(last) = self.stretches.last_mut()
            && let (Some(before), Some(after)) = (last.pieces.last(), next.pieces.first())
            && let (Radii::Formula(a), Radii::Formula(b)) = (&before.radii, &after.radii)
            && a.outer == b.outer
            && a.inner == b.inner
            && last.kinks(&next).is_some_and(|kinks| kinks.iter().all(|kink| *kink < SAME_SLOPE))
        {
            last.to = next.to;
            last.pieces.extend(next.pieces);
            return;
        }
        self.stretches.push(next);
    }

    /// Checks that the walls meet at every step.
    fn check_steps(&self) -> Result<()> {
        for pair in self.stretches.windows(2) {
            let (left, right) = (pair[0].radii(pair[0].to), pair[1].radii(pair[1].from));
            if !meet(&left, &right) {
                let [a, b, c, d] =
                    [left[0], left[left.len() - 1], right[0], right[right.len() - 1]];
                let found = format!(
                    "walls from {:.2} to {:.2} mm and from {:.2} to {:.2} mm of radius at {} m",
                    1e3 * a,
                    1e3 * b,
                    1e3 * c,
                    1e3 * d,
                    pair[0].to
                );
                let expected = "walls that meet at a step";
                return Err(Error::value("profile", found, expected));
            }
        }
        Ok(())
    }
}

/// The stiffest of some layers' materials if all others are far softer.
fn stiff_among<'a>(
    layers: impl Iterator<Item = &'a usize> + Clone,
    materials: &[Elastic],
) -> Option<usize> {
    /// A layer with less than this share of the wall's stiffness makes no corner that matters.
    const SOFT: f64 = 0.1;
    let stiffness = |material: &usize| materials[*material].normal[1][1];
    let stiffest = layers.clone().max_by(|a, b| stiffness(a).total_cmp(&stiffness(b)))?;
    let soft = |one: &usize| one == stiffest || stiffness(one) < SOFT * stiffness(stiffest);
    layers.clone().all(soft).then_some(*stiffest)
}

/// Whether two walls with these radii touch over some of their thickness.
pub fn meet(left: &[f64], right: &[f64]) -> bool {
    let ([a, b], [c, d]) = (ends(left), ends(right));
    b.min(d) - a.max(c) > 1e-3 * (b - a).min(d - c)
}

/// The first and the last of several radii.
fn ends(radii: &[f64]) -> [f64; 2] {
    [radii[0], radii[radii.len() - 1]]
}
