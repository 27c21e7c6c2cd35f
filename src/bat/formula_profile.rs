//! A profile from formulas: it is cut at corners and features, and checked everywhere.

use crate::base::{Complaint, Error, Result, golden, shortened};
use crate::bat::formula::Formula;
use crate::bat::formula_bounds::Bounds;
use crate::bat::profile::{
    Curves, FormulaPiece, Formulas, Interpolation, Piece, Profile, Radii, Section, Stations,
};
use crate::bat::tip::{NEVER_BACK, sends_back};

/// Samples of one written piece, at which its radii are checked.
const SAMPLES: f64 = 1000.0;
/// Samples of the shortest stretch between two corners.
const LEAST_SAMPLES: f64 = 50.0;
/// Ends closer than this share of the position touch: `"10 in"` and 0.254.
const TOUCHING: f64 = 1e-12;
/// Corners closer than this share of their piece are one.
const ONE_CORNER: f64 = 1e-9;
/// A value this small, as a share of the largest radius, is the round-off of 0.
const ROUND_OFF: f64 = 1e-15;
/// A stretch between two cuts is smooth if polynomials approximate its sections within this, relative.
const SMOOTH: f64 = 1e-3;
/// Round-off of a section, relative, beyond which a formula has lost its digits.
const LOST: f64 = 1e-8;
/// The share of a bat at either end on which digits may be lost. There ε of the bat's length is `LOST` of the distance
/// from the end, with a margin for four factors of the radius. Such a tip neither weighs nor bends.
pub(crate) const LAST: f64 = 32.0 * f64::EPSILON / LOST;
/// Most halvings of a stretch; the last halves are as short as two corners may be apart.
const MOST_HALVINGS: usize = 30;
/// Sections of the shortest stretch may vary by this share without a further check.
const MOST_VARIATION: f64 = 1.0;
/// A formula that needs more stretches than this varies too fast and is refused.
const MOST_STRETCHES: usize = 4096;

impl Profile {
    /// The profile of these formulas, whose pieces follow each other from 0.
    ///
    /// A piece is cut where an `abs`, a `min` or a `max` in it has a corner, and halved until bounds from the parse
    /// tree exclude a feature between two cuts ([`crate::base::interval`]). These bounds also prove that both radii are
    /// possible everywhere.
    ///
    /// ```
    /// use sweetspot::Profile;
    /// use sweetspot::bat::formula::Formula;
    /// use sweetspot::bat::profile::FormulaPiece;
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// let outer = Formula::parse("0.012 + 0.025*x").expect("it is a formula");
    /// let cone = Profile::from_formulas(vec![FormulaPiece { from: 0.0, to: 0.84, outer, inner: None }])?;
    /// assert!((cone.at(0.84).outer - 0.033).abs() < 1e-15);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Value`] whose field is `pieces`, or `pieces[k].from`, `to`, `formula` or
    /// `inner_formula` of piece `k`: a gap, an overlap, a radius that is not a number, is not above
    /// 0 (0 is possible at an end of the bat), is not above the inner one, or jumps.
    pub fn from_formulas(mut written: Vec<FormulaPiece>) -> Result<Self> {
        let length = check_places(&mut written)?;
        let mut pieces = Vec::new();
        let mut stations = Stations {
            x: vec![],
            outer: vec![],
            inner: vec![],
            interpolation: Interpolation::Linear,
        };
        for (k, piece) in written.iter().enumerate() {
            let named = NamedPiece { k, piece, length };
            let floor = ROUND_OFF * named.largest()?;
            for (from, to) in named.smooth_parts()? {
                let (outer, inner) = (piece.outer.clone(), piece.inner.clone());
                let curves = Curves { outer, inner, from, to, floor };
                let mut samples = named.samples(&curves);
                named.check(&curves, &samples)?;
                named.check_tips(&curves)?;
                let mut stretches = Vec::new();
                named.halve(&curves, MOST_HALVINGS, &mut stretches)?;
                for stretch in stretches {
                    let (start, length) = (stretch.from, stretch.to - stretch.from);
                    let s = (start + 0.5 * length - from) / (to - from);
                    samples.push((s, curves.at(s)));
                    let radii = Radii::Formula(stretch);
                    pieces.push(Piece { start, length, radii, layup: 0 });
                }
                samples.sort_by(|a, b| a.0.total_cmp(&b.0));
                // A place that occurs twice but for rounding would look like a peak.
                samples.dedup_by(|b, a| b.0 - a.0 < TOUCHING);
                add_stations(&mut stations, &curves, &samples);
            }
        }
        let formulas = Some(Formulas { pieces: written, from_tip: false });
        Ok(Self { pieces, stations, formulas, turned: false })
    }
}

/// Pieces must follow each other; ends that touch but for rounding are made equal. Returns the length of the whole (m).
fn check_places(written: &mut [FormulaPiece]) -> Result<f64> {
    if written.is_empty() {
        return Err(Error::value("pieces", "no piece", "one piece at least"));
    }
    let mut end = 0.0_f64;
    for (k, piece) in written.iter_mut().enumerate() {
        let apart = piece.from - end;
        if apart.is_nan() || apart.abs() > TOUCHING * end {
            let (what, expected) = match k {
                0 => ("", "0: x counts from the end named in \"measured_from\"".to_owned()),
                _ if apart < 0.0 => (", an overlap", before_ends(end)),
                _ => (", which leaves a gap", before_ends(end)),
            };
            let found = format!("{}{what}", metres(piece.from));
            return Err(Error::value(format!("pieces[{k}].from"), found, expected));
        }
        piece.from = end;
        if !(piece.to > end && piece.to.is_finite()) {
            let expected = format!("a position beyond {}, where the piece begins", metres(end));
            return Err(Error::value(format!("pieces[{k}].to"), metres(piece.to), expected));
        }
        end = piece.to;
    }
    Ok(end)
}

fn before_ends(end: f64) -> String {
    format!("{}, where the piece before ends", metres(end))
}

/// A length to nine digits, if it is finite.
fn metres(value: f64) -> String {
    if value.is_nan() {
        return "no number".to_owned();
    }
    match format!("{value:.8e}").parse::<f64>() {
        Ok(rounded) if rounded.is_finite() => format!("{rounded} m"),
        _ => "an infinite value".to_owned(),
    }
}

/// A written piece and its name in messages.
struct NamedPiece<'a> {
    k: usize,
    piece: &'a FormulaPiece,
    /// Length of the whole bat (m).
    length: f64,
}

/// Places along a smooth piece, `s` in [0, 1], and the sections there.
type PieceSamples = Vec<(f64, Section)>;

impl NamedPiece<'_> {
    fn formulas(&self) -> impl Iterator<Item = (&'static str, &Formula)> {
        let inner = self.piece.inner.iter().map(|inner| ("inner_formula", inner));
        [("formula", &self.piece.outer)].into_iter().chain(inner)
    }

    fn error(&self, key: &str, found: impl std::fmt::Display, expected: &str) -> Error {
        Error::value(format!("pieces[{}].{key}", self.k), found, expected)
    }

    /// The largest outer radius among the samples (m); all values must be numbers.
    fn largest(&self) -> Result<f64> {
        let FormulaPiece { from, to, .. } = *self.piece;
        let mut largest = 0.0_f64;
        for (key, formula) in self.formulas() {
            for j in 0..=SAMPLES as usize {
                let s = j as f64 / SAMPLES;
                let x = (1.0 - s) * from + s * to;
                let value = formula.at(x);
                if !value.is_finite() {
                    let found = found(value, x, formula);
                    let (from, to) = (metres(from), metres(to));
                    let expected = format!("a radius in m at every x from {from} to {to}");
                    return Err(self.error(key, found, &expected));
                }
                if key == "formula" {
                    largest = largest.max(value.abs());
                }
            }
        }
        Ok(largest)
    }

    /// The corners of both radii between these places (m), rising.
    fn corners(&self, from: f64, to: f64) -> Result<Vec<f64>> {
        let mut corners = Vec::new();
        for (key, formula) in self.formulas() {
            corners.extend(
                formula.corners(from, to).map_err(|Complaint { found, expected, .. }| {
                    self.error(key, found, &expected)
                })?,
            );
        }
        corners.sort_by(f64::total_cmp);
        Ok(corners)
    }

    /// Where the piece is cut at corners: from and to of each part (m).
    fn smooth_parts(&self) -> Result<Vec<(f64, f64)>> {
        let FormulaPiece { from, to, .. } = *self.piece;
        let corners = self.corners(from, to)?;
        let least = ONE_CORNER * (to - from);
        let mut cuts = vec![from];
        for corner in corners {
            if corner - cuts[cuts.len() - 1] > least && to - corner > least {
                cuts.push(corner);
            }
        }
        cuts.push(to);
        Ok(cuts.windows(2).map(|pair| (pair[0], pair[1])).collect())
    }

    fn samples(&self, curves: &Curves) -> PieceSamples {
        let share = (curves.to - curves.from) / (self.piece.to - self.piece.from);
        let count = (SAMPLES * share).ceil().max(LEAST_SAMPLES);
        (0..=count as usize).map(|j| (j as f64 / count, curves.at(j as f64 / count))).collect()
    }

    /// Both radii must be possible at the samples and at the minima between them.
    fn check(&self, curves: &Curves, samples: &PieceSamples) -> Result<()> {
        let places = samples.iter().copied();
        let bottoms = [
            bottom(curves, samples, |section| section.outer),
            bottom(curves, samples, |section| section.inner),
            bottom(curves, samples, |section| section.outer - section.inner),
        ];
        for (s, section) in bottoms.into_iter().flatten().chain(places) {
            self.check_section(curves.x(s), section)?;
        }
        Ok(())
    }

    /// A pointed end of the bat must reflect waves.
    fn check_tips(&self, curves: &Curves) -> Result<()> {
        let knob = curves.from != 0.0 || sends_back(|t| curves.at(t).outer);
        let tip = curves.to != self.length || sends_back(|t| curves.at(1.0 - t).outer);
        let [found, expected] = NEVER_BACK;
        if knob && tip { Ok(()) } else { Err(self.error("formula", found, expected)) }
    }

    /// Cuts a stretch at corners and in the middle until all parts are possible and smooth.
    fn halve(&self, curves: &Curves, halvings: usize, parts: &mut Vec<Curves>) -> Result<()> {
        let Curves { from, to, .. } = *curves;
        let bounds = curves.bounds(0.0, 1.0);
        let possible = |bounds: &Bounds| bounds.possible([from == 0.0, to == self.length]);
        let short = halvings == 0;
        // The last part of a point neither weighs nor bends.
        let at_end = from == 0.0 || to == self.length;
        // Near the tip, a distance from the tip has fewer digits than a distance from the knob near the knob; yet the
        // reversed bat must be the same bat.
        let last = to <= LAST * self.length || from >= (1.0 - LAST) * self.length;
        let smooth = |bounds: &Bounds| {
            bounds.missed(0.0) <= SMOOTH && (bounds.round_off() <= LOST || last)
                || short && (at_end || bounds.variation(0.0) <= MOST_VARIATION)
        };
        if bounds.as_ref().is_some_and(|bounds| possible(bounds) && smooth(bounds)) {
            parts.push(curves.clone());
            return Ok(());
        }
        if short && bounds.is_none() && self.is_level(curves)? {
            parts.push(curves.clone());
            return Ok(());
        }
        if short || parts.len() > MOST_STRETCHES {
            return Err(self.rough(curves));
        }
        let corner = if bounds.is_none() { self.corner(from, to)? } else { None };
        let middle = corner.unwrap_or(0.5 * (from + to));
        self.halve(&Curves { to: middle, ..curves.clone() }, halvings - 1, parts)?;
        self.halve(&Curves { from: middle, ..curves.clone() }, halvings - 1, parts)
    }

    /// A corner that lies strictly between these places.
    fn corner(&self, from: f64, to: f64) -> Result<Option<f64>> {
        let least = ONE_CORNER * (self.piece.to - self.piece.from);
        let inside = |corner: &f64| corner - from > least && to - corner > least;
        Ok(self.corners(from, to)?.into_iter().find(inside))
    }

    /// Whether the sections at three places of a short stretch are possible and nearly equal.
    fn is_level(&self, curves: &Curves) -> Result<bool> {
        let sections = [0.0, 0.5, 1.0].map(|s| curves.at(s));
        let places = sections.iter().zip([0.0, 0.5, 1.0]);
        places.into_iter().try_for_each(|(at, s)| self.check_section(curves.x(s), *at))?;
        let stiffness = sections.map(Section::second_moment);
        let most = stiffness.into_iter().fold(0.0, f64::max);
        Ok(most <= (1.0 + MOST_VARIATION) * stiffness.into_iter().fold(most, f64::min))
    }

    /// The error for a stretch with a feature that no halving resolves.
    fn rough(&self, curves: &Curves) -> Error {
        let [first, last] = [0.0, 1.0].map(|s| self.check_section(curves.x(s), curves.at(s)));
        if let Err(error) = first.and(last) {
            return error;
        }
        let found = format!(
            "a radius that jumps, varies too fast or loses its digits between x = {} and {}, {}",
            metres(curves.from),
            metres(curves.to),
            quoted(&self.piece.outer),
        );
        self.error("formula", found, "a smooth radius; a jump is the end of a piece")
    }

    fn check_section(&self, x: f64, section: Section) -> Result<()> {
        let Section { outer, inner } = section;
        let at_end = x == 0.0 || x == self.length;
        let of_outer =
            |expected| Err(self.error("formula", found(outer, x, &self.piece.outer), expected));
        if !(outer >= 0.0 && outer.is_finite()) {
            return of_outer("a radius above 0");
        }
        if outer == 0.0 && !at_end {
            return of_outer("a radius above 0 (only an end of the bat may come to a point)");
        }
        let of_inner = |expected| {
            let formula = self.piece.inner.as_ref().unwrap_or(&self.piece.outer);
            Err(self.error("inner_formula", found(inner, x, formula), expected))
        };
        if !(inner >= 0.0 && inner.is_finite()) {
            return of_inner("0 or more");
        }
        if inner >= outer && (outer, inner) != (0.0, 0.0) {
            return of_inner(&format!("less than the outer radius there, {}", metres(outer)));
        }
        let stiffness = section.second_moment();
        let in_range = stiffness > f64::MIN_POSITIVE && stiffness < f64::MAX;
        if !at_end && !in_range {
            return of_outer("a radius whose fourth power is within the range of numbers");
        }
        Ok(())
    }
}

/// The lowest place between the samples and its section, by golden sections around every sample that is lower than its
/// neighbours; `None` if no sample is.
fn bottom(
    curves: &Curves,
    samples: &PieceSamples,
    of: impl Fn(Section) -> f64,
) -> Option<(f64, Section)> {
    let lows = samples.windows(3).filter(|w| of(w[1].1) < of(w[0].1) && of(w[1].1) <= of(w[2].1));
    let places = lows.map(|w| golden::least(w[0].0, w[2].0, |s| of(curves.at(s))));
    let found = places.map(|s| (s, curves.at(s)));
    found.min_by(|a, b| of(a.1).total_cmp(&of(b.1)))
}

/// Both ends of a smooth piece and its widest place.
fn add_stations(stations: &mut Stations, curves: &Curves, samples: &PieceSamples) {
    let widest = bottom(curves, samples, |section| -section.outer);
    let places = [Some((0.0, curves.at(0.0))), widest, Some((1.0, curves.at(1.0)))];
    for (s, Section { outer, inner }) in places.into_iter().flatten() {
        let x = curves.x(s);
        let same = |column: &[f64], value: f64| column.last() == Some(&value);
        // A corner is not a step.
        if same(&stations.x, x) && same(&stations.outer, outer) && same(&stations.inner, inner) {
            continue;
        }
        stations.x.push(x);
        stations.outer.push(outer);
        stations.inner.push(inner);
    }
}

/// Words for a wrong value: its place and the formula that gave it.
fn found(value: f64, x: f64, formula: &Formula) -> String {
    format!("{} at x = {} from {}", metres(value), metres(x), quoted(formula))
}

fn quoted(formula: &Formula) -> String {
    format!("{:?}", shortened(formula.text(), 100))
}
