//! What is the cross-section at `x`: outer and inner radius along the bat?
//!
//! [`Profile::new`] lays curves through [`Stations`]; [`Profile::at`] gives the [`Section`].

use crate::base::{Complaint, Error, Mistakes, Result};
use crate::bat::formula::Formula;
use crate::bat::pchip::{bernstein, cubics, subdivide};
pub use crate::bat::stations::{Interpolation, Section, Stations};
use crate::bat::stations::{check_positions, check_radii, held};
use crate::bat::tip::{NEVER_BACK, sends_back};

/// Places closer than this share of the bat's length are one place, given in different digits.
pub const SAME_PLACE: f64 = 1e-12;

/// Formulas of both radii (m) on a stretch of the bat, as written in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct FormulaPiece {
    /// Where the piece begins (m).
    pub from: f64,
    /// Where the piece ends (m).
    pub to: f64,
    /// Formula of the outer radius.
    pub outer: Formula,
    /// Formula of the inner radius; None where the bat is solid.
    pub inner: Option<Formula>,
}

/// A whole profile in formulas.
#[derive(Debug, Clone, PartialEq)]
pub struct Formulas {
    /// Pieces, touching end to end from 0.
    pub pieces: Vec<FormulaPiece>,
    /// Whether `x` in the formulas counts from the tip.
    pub from_tip: bool,
}

/// A stretch of the bat where both radii are smooth.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Where the piece begins (m).
    pub start: f64,
    /// Length of the piece (m).
    pub length: f64,
    /// Both radii along the piece.
    pub radii: Radii,
    /// Index of the bat's layup that the piece is made of; 0 is the bat's own material.
    pub layup: usize,
}

/// Both radii along a piece.
#[derive(Debug, Clone, PartialEq)]
pub enum Radii {
    /// Cubics through stations.
    Cubic(Cubics),
    /// Formulas.
    Formula(Curves),
}

/// Both radii as one cubic each, in Bernstein form.
///
/// With `s` from 0 to 1 along the piece, `r(s) = Σ bᵢ Bᵢ(s)`, `Bᵢ` the cubic Bernstein
/// polynomials. All `bᵢ` of a monotone cubic between radii are positive, so nothing cancels,
/// not even at the thin end of a 1:10 000 cone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubics {
    /// Coefficients `b₀ … b₃` of the outer radius (m).
    pub outer: [f64; 4],
    /// Coefficients of the inner radius (m).
    pub inner: [f64; 4],
    /// Degree of the radii as polynomials: 0, 1 or 3. Quadrature rules follow from it.
    pub degree: usize,
}

/// Both radii as smooth formulas of `x = from + (to − from) s`.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// The outer radius.
    pub outer: Formula,
    /// None where the bat is solid.
    pub inner: Option<Formula>,
    /// The formulas' `x` at the beginning of the piece (m); it falls along a piece that is
    /// measured from the tip.
    pub from: f64,
    /// The formulas' `x` at the end (m).
    pub to: f64,
    /// Radii (m) up to this are the round-off of 0.
    pub floor: f64,
}

/// The shape of a bat, checked: positive length, positive wall, radius 0 at most at an end.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Knob first, each beginning where the last ends.
    pub pieces: Vec<Piece>,
    /// The stations it was made from, knob first. Where it was made from formulas: the ends and
    /// the widest place of every piece.
    pub stations: Stations,
    /// The formulas it was made from, if it was.
    pub formulas: Option<Formulas>,
    /// Whether it was reversed an odd number of times: its places are then differences from the length.
    pub turned: bool,
}

impl Profile {
    /// The profile through the stations.
    ///
    /// ```
    /// use sweetspot::Profile;
    /// use sweetspot::bat::profile::{Interpolation, Stations};
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// let (x, outer) = (vec![0.0, 0.4, 0.84], vec![0.012, 0.015, 0.033]); // in m
    /// let (inner, interpolation) = (vec![0.0; 3], Interpolation::Pchip);
    /// let profile = Profile::new(Stations { x, outer, inner, interpolation })?;
    /// assert_eq!(profile.at(0.4).outer, 0.015);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Value`] whose field is `x[k]`, `outer[k]` or `inner[k]`, `k` the station, or several
    /// of them.
    pub fn new(stations: Stations) -> Result<Self> {
        for (role, column) in [("outer", &stations.outer), ("inner", &stations.inner)] {
            if column.len() != stations.x.len() {
                let expected = format!("{}, one for each x", stations.x.len());
                return Err(Error::value(role, format!("{} values", column.len()), expected));
            }
        }
        let mut mistakes = Mistakes::default();
        mistakes.note(check_positions(&stations.x));
        mistakes.note(check_radii(&stations));
        mistakes.end(())?;
        let stations = match stations.interpolation {
            Interpolation::Constant => held(&stations)?,
            _ => stations,
        };
        let pieces = pieces(&stations)?;
        pieces.iter().try_for_each(|piece| check_wall(piece, &stations))?;
        check_tips(&pieces, stations.x.len() - 1)?;
        Ok(Self { pieces, stations, formulas: None, turned: false })
    }

    /// Length from the knob end to the tip (m).
    pub fn length(&self) -> f64 {
        *self.stations.x.last().expect("a profile has stations")
    }

    /// The largest outer radius of its stations (m).
    pub fn widest(&self) -> f64 {
        self.stations.outer.iter().fold(0.0, |most, r| most.max(*r))
    }

    /// This profile reversed end for end.
    pub fn reversed(mut self) -> Self {
        let length = self.length();
        let Stations { x, outer, inner, .. } = &mut self.stations;
        x.iter_mut().for_each(|x| *x = length - *x);
        [x, outer, inner].into_iter().for_each(|column| column.reverse());
        let mut end = length;
        for piece in self.pieces.iter_mut().rev() {
            let start = std::mem::replace(&mut piece.start, length - end);
            end = start;
            piece.radii.reverse();
        }
        self.pieces.reverse();
        self.formulas.iter_mut().for_each(|formulas| formulas.from_tip ^= true);
        self.turned ^= true;
        self
    }

    /// The section at `x`; at a step, the one to its right. `x` outside is taken to the near end.
    pub fn at(&self, x: f64) -> Section {
        let piece = self.piece_at(x);
        piece.at(((x - piece.start) / piece.length).clamp(0.0, 1.0))
    }

    /// The piece at `x`, at a border the one to its right.
    pub fn piece_at(&self, x: f64) -> &Piece {
        let k = self.pieces.partition_point(|piece| piece.start <= x).max(1) - 1;
        &self.pieces[k]
    }

    /// The shape with borders between two pieces at these places (m), where there are none yet.
    pub fn cut(&mut self, places: impl IntoIterator<Item = f64>) {
        let same = SAME_PLACE * self.length();
        let mut places: Vec<f64> = places.into_iter().collect();
        places.sort_by(f64::total_cmp);
        let mut places = places.into_iter().peekable();
        let mut pieces = Vec::with_capacity(self.pieces.len() + places.len());
        for mut piece in std::mem::take(&mut self.pieces) {
            let end = piece.start + piece.length;
            while let Some(x) = places.next_if(|x| *x < end - same) {
                if x <= piece.start + same {
                    continue;
                }
                let s = (x - piece.start) / piece.length;
                let [mut left, mut right] = [piece.part(0.0, s), piece.part(s, 1.0)];
                // Exactly where asked and exactly as long as before.
                (left.length, right.start) = (x - piece.start, x);
                right.length = end - x;
                pieces.push(left);
                piece = right;
            }
            pieces.push(piece);
        }
        self.pieces = pieces;
    }

    /// Where pieces begin and where the last one ends (m), rising.
    pub fn borders(&self) -> Vec<f64> {
        self.pieces.iter().map(|piece| piece.start).chain([self.length()]).collect()
    }
}

impl Piece {
    /// Whether it lies between these places (m); pieces end at both.
    pub fn is_within(&self, from: f64, to: f64) -> bool {
        let middle = self.start + 0.5 * self.length;
        middle > from && middle < to
    }

    /// The sections at both ends.
    pub fn ends(&self) -> [Section; 2] {
        match &self.radii {
            Radii::Cubic(Cubics { outer, inner, .. }) => {
                [0, 3].map(|k| Section { outer: outer[k], inner: inner[k] })
            }
            Radii::Formula(curves) => [0.0, 1.0].map(|s| curves.at(s)),
        }
    }

    /// The section at `s` in [0, 1] along the piece.
    pub fn at(&self, s: f64) -> Section {
        match &self.radii {
            Radii::Cubic(cubics) => cubics.at(s),
            Radii::Formula(curves) => curves.at(s),
        }
    }

    /// The part from `s0` to `s1` as a separate piece.
    pub fn part(&self, s0: f64, s1: f64) -> Self {
        let radii = match &self.radii {
            Radii::Cubic(cubics) => Radii::Cubic(cubics.part(s0, s1)),
            Radii::Formula(curves) => Radii::Formula(curves.part(s0, s1)),
        };
        let (start, length) = (self.start + self.length * s0, self.length * (s1 - s0));
        Self { start, length, radii, layup: self.layup }
    }
}

impl Radii {
    /// Reverses the radii along their piece, as seen from its other end.
    fn reverse(&mut self) {
        match self {
            Self::Cubic(cubics) => {
                cubics.outer.reverse();
                cubics.inner.reverse();
            }
            Self::Formula(curves) => std::mem::swap(&mut curves.from, &mut curves.to),
        }
    }
}

impl Cubics {
    /// The section at `s` in [0, 1] along the piece.
    #[inline]
    pub fn at(&self, s: f64) -> Section {
        let inner = if self.inner == [0.0; 4] { 0.0 } else { bernstein(&self.inner, s) };
        Section { outer: bernstein(&self.outer, s), inner }
    }

    /// Where between its ends, in (0, 1), the wall vanishes because its two cubics cross.
    pub(crate) fn no_wall_at(&self) -> Option<f64> {
        let wall: [f64; 4] = std::array::from_fn(|i| self.outer[i] - self.inner[i]);
        if wall[1] > 0.0 && wall[2] > 0.0 {
            return None;
        }
        let step = |i: usize| wall[i + 1] - wall[i];
        // Wall thickness is least where its derivative, a quadratic in Bernstein form, is 0.
        let (a, b, c) = (step(0) - 2.0 * step(1) + step(2), step(1) - step(0), step(0));
        let root = (b * b - a * c).max(0.0).sqrt();
        let places = [(-b + root) / a, (-b - root) / a, -c / (2.0 * b)];
        places.into_iter().find(|s| *s > 0.0 && *s < 1.0 && bernstein(&wall, *s) <= 0.0)
    }

    /// The part of these cubics between `s0` and `s1` in [0, 1], by de Casteljau's subdivision.
    #[inline]
    pub fn part(&self, s0: f64, s1: f64) -> Self {
        if self.degree == 0 {
            return *self;
        }
        Self {
            outer: subdivide(&self.outer, s0, s1),
            inner: if self.inner[0] == 0.0 && self.inner == [0.0; 4] {
                [0.0; 4]
            } else {
                subdivide(&self.inner, s0, s1)
            },
            degree: self.degree,
        }
    }
}

impl Curves {
    /// The section at `s` in [0, 1] along the piece.
    pub fn at(&self, s: f64) -> Section {
        let x = self.x(s);
        let radius = |formula: &Formula| {
            let radius = formula.at(x);
            if radius.abs() <= self.floor { 0.0 } else { radius }
        };
        Section { outer: radius(&self.outer), inner: self.inner.as_ref().map_or(0.0, radius) }
    }

    /// The formulas' `x` at `s` in [0, 1] along the piece; at both ends to the last bit.
    pub fn x(&self, s: f64) -> f64 {
        (1.0 - s) * self.from + s * self.to
    }

    fn part(&self, s0: f64, s1: f64) -> Self {
        Self { from: self.x(s0), to: self.x(s1), ..self.clone() }
    }
}

/// One piece per interval between stations, steps left out.
fn pieces(stations: &Stations) -> Result<Vec<Piece>> {
    let Stations { x, outer, inner, interpolation } = stations;
    let mut pieces = Vec::with_capacity(x.len());
    let mut first = 0;
    while first < x.len() {
        let steps = (first + 1..x.len()).find(|&k| x[k] == x[k - 1]);
        let end = steps.unwrap_or(x.len());
        if end - first < 2 {
            let expected = "another station between two steps";
            return Err(Error::value(format!("x[{first}]"), format!("{} m", x[first]), expected));
        }
        let run = first..end;
        let bezier = |y: &[f64]| match interpolation {
            Interpolation::Pchip => cubics(&x[run.clone()], &y[run.clone()]),
            _ => lines(&y[run.clone()]),
        };
        for (k, (outer, inner)) in bezier(outer).into_iter().zip(bezier(inner)).enumerate() {
            let k = first + k;
            let flat = |b: &[f64; 4]| b.iter().all(|v| *v == b[0]);
            let degree = match interpolation {
                _ if flat(&outer) && flat(&inner) => 0,
                Interpolation::Pchip => 3,
                _ => 1,
            };
            let radii = Radii::Cubic(Cubics { outer, inner, degree });
            pieces.push(Piece { start: x[k], length: x[k + 1] - x[k], radii, layup: 0 });
        }
        first = end;
    }
    Ok(pieces)
}

fn lines(y: &[f64]) -> Vec<[f64; 4]> {
    let line = |a: f64, b: f64| {
        if a == b { [a; 4] } else { [a, (2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0, b] }
    };
    y.windows(2).map(|w| line(w[0], w[1])).collect()
}

/// The wall must not vanish between stations either, where two cubics may cross.
fn check_wall(piece: &Piece, stations: &Stations) -> Result<()> {
    let Radii::Cubic(cubics) = &piece.radii else { return Ok(()) };
    if cubics.no_wall_at().is_none() {
        return Ok(());
    }
    let k = stations.x.partition_point(|at| *at <= piece.start) - 1;
    let found = format!("a wall that vanishes between x[{k}] and x[{}]", k + 1);
    let expected = "inner radius below outer radius there too: add a station";
    Err(Error::Value(Complaint::new(format!("inner[{k}]"), found, expected)))
}

/// Both ends of the bat, the latter at that station, must send waves back.
fn check_tips(pieces: &[Piece], last_station: usize) -> Result<()> {
    let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
    let back = [sends_back(|t| first.at(t).outer), sends_back(|t| last.at(1.0 - t).outer)];
    let Some(end) = back.into_iter().position(|back| !back) else { return Ok(()) };
    let [found, expected] = NEVER_BACK;
    Err(Error::value(format!("outer[{}]", end * last_station), found, expected))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reversed_profile_has_its_stations_from_the_other_end() {
        let (x, inner) = (vec![0.0, 0.5, 0.75], vec![0.0; 3]);
        let outer = vec![0.01, 0.02, 0.04];
        let one = Profile::new(Stations { x, outer, inner, interpolation: Interpolation::Linear });
        let other = one.unwrap().reversed();
        assert_eq!(other.stations.x, [0.0, 0.25, 0.75]);
        assert_eq!(other.stations.outer, [0.04, 0.02, 0.01]);
    }

    #[test]
    fn columns_of_unequal_length_are_an_error() {
        let new = |outer: usize, inner: usize| {
            let (outer, inner) = (vec![0.02; outer], vec![0.0; inner]);
            let x = vec![0.0, 0.4, 0.8];
            Profile::new(Stations { x, outer, inner, interpolation: Interpolation::Linear })
        };
        assert!(new(3, 3).is_ok());
        for (outer, inner, role) in [(2, 3, "outer"), (4, 3, "outer"), (3, 0, "inner")] {
            let said = new(outer, inner).unwrap_err().to_string();
            assert!(said.starts_with(&format!("{role}: found ")), "{said}");
        }
    }
}
