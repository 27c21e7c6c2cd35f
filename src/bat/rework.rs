//! How do the radii change where wood is turned off, drilled out or sawn off, or where a layer is added?
//!
//! The rest of the curve stays unchanged: the pieces of the profile are cut in two and changed one by one. No new curve
//! is laid through stations.

use std::cmp::Ordering;

use crate::base::{Complaint, Error, Result, units};
use crate::bat::formula::Formula;
use crate::bat::pchip::subdivide;
use crate::bat::profile::{
    Curves, Interpolation, Piece, Profile, Radii, SAME_PLACE, Section, Stations,
};

/// Default length over which a cut runs in and out: 1 in (m).
const BLEND: f64 = 0.0254;
/// The smooth step `3v² − 2v³` in Bernstein form.
const RISING: [f64; 4] = [0.0, 0.0, 1.0, 1.0];
const FALLING: [f64; 4] = [1.0, 1.0, 0.0, 0.0];
const FULL: [f64; 4] = [1.0; 4];
/// Number of places at which the wall of a formula is checked.
const SAMPLES: usize = 128;

/// A surface of the wood.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Surface {
    /// That of the bat.
    Outside,
    /// That of its bore.
    Bore,
}

/// A stretch (m), and the length over which a change runs in and out (m).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Blended {
    pub from: f64,
    pub to: f64,
    pub blend: Option<f64>,
}

impl Blended {
    /// The length of the run-in: at most to the middle of the stretch.
    pub fn blend(&self) -> f64 {
        self.blend.unwrap_or(BLEND.min(0.5 * (self.to - self.from)))
    }

    /// The stretch on which the change applies in full (m), on a bat of that length.
    fn full(&self, length: f64) -> [f64; 2] {
        let same = SAME_PLACE * length;
        let blend = self.blend();
        let inner = |end: f64, toward: f64, at_end: bool| if at_end { end } else { end + toward };
        let full = [
            inner(self.from, blend, self.from <= same),
            inner(self.to, -blend, self.to >= length - same),
        ];
        // Two halves of a stretch meet at one place.
        if full[1] - full[0] <= same { [full[0]; 2] } else { full }
    }
}

impl Profile {
    /// Takes `depth` (m) off the diameter of a stretch.
    ///
    /// With `v` from 0 to 1 along the run-in, the depth follows `3v² − 2v³`, so that the surface has no corner. A cubic
    /// surface stays a cubic.
    pub(crate) fn turned_down(&mut self, on: Blended, depth: f64) -> Result<()> {
        self.reshape(on, |piece, weight| {
            grown(piece, Surface::Outside, weight.map(|w| -0.5 * depth * w))
        })
    }

    /// Moves a surface outwards by `by` (m), in Bernstein form over each piece. `None` leaves a piece as it is; a
    /// missing bore is not moved.
    pub(crate) fn moved(
        &mut self,
        surface: Surface,
        by: impl Fn(&Piece) -> Option<[f64; 4]>,
    ) -> Result<()> {
        let length = self.length();
        for piece in &mut self.pieces {
            if let Some(by) = by(piece) {
                grown(piece, surface, by)?;
                check_wall(piece)?;
            }
        }
        self.survey(length);
        Ok(())
    }

    /// Multiplies the outer radius of a stretch by a factor, which runs in and out like the depth of
    /// [`Self::turned_down`].
    pub(crate) fn scaled_outside(&mut self, on: Blended, by: f64) -> Result<()> {
        if by == 1.0 {
            return Ok(());
        }
        self.reshape(on, |piece, weight| {
            if let (Radii::Cubic(cubics), true) = (&mut piece.radii, flat(&weight)) {
                cubics.outer.iter_mut().for_each(|r| *r *= by);
                return Ok(());
            }
            // A product of two cubics is not a cubic.
            let mut curves = as_formulas(piece)?;
            let factor = polynomial(&weight.map(|w| 1.0 + (by - 1.0) * w), &curves);
            curves.outer = formula(format!("({})*{factor}", curves.outer.text()))?;
            piece.radii = Radii::Formula(curves);
            Ok(())
        })
    }

    /// Puts a layer of that thickness (m) around a stretch.
    pub(crate) fn thickened(&mut self, [from, to]: [f64; 2], thickness: f64) -> Result<()> {
        self.reshape(Blended { from, to, blend: Some(0.0) }, |piece, _| {
            match &mut piece.radii {
                Radii::Cubic(cubics) => cubics.outer.iter_mut().for_each(|r| *r += thickness),
                Radii::Formula(curves) => {
                    curves.outer = formula(format!("({})+{thickness:?}", curves.outer.text()))?;
                }
            }
            Ok(())
        })
    }

    /// Drills a hole of that radius (m) along a stretch.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if the hole there is wider already, or if no wood would be left around it.
    pub(crate) fn drilled(&mut self, ends: [f64; 2], radius: f64) -> Result<()> {
        self.hollowed(ends, |_| [radius; 4])
    }

    /// Hollows out the tip. With `v` from 0 at the bottom to 1 at the tip the radius is `a (1 − (1 − v)³)`, whose
    /// Bernstein form is 0, a, a, a.
    ///
    /// # Errors
    ///
    /// As [`Self::drilled`].
    pub(crate) fn cupped(&mut self, depth: f64, radius: f64) -> Result<()> {
        let length = self.length();
        let from = length - depth;
        self.hollowed([from, length], |piece| {
            let share = |x: f64| ((x - from) / depth).clamp(0.0, 1.0);
            let [start, end] = [piece.start, piece.start + piece.length].map(share);
            // The bottom and the rim themselves, without round-off.
            let start = if start < 1e-9 { 0.0 } else { start };
            let end = if end > 1.0 - 1e-9 { 1.0 } else { end };
            subdivide(&[0.0, radius, radius, radius], start, end)
        })
    }

    /// Sets the inner radius of each piece in a stretch, in Bernstein form.
    fn hollowed(&mut self, [from, to]: [f64; 2], inner: impl Fn(&Piece) -> [f64; 4]) -> Result<()> {
        self.reshape(Blended { from, to, blend: Some(0.0) }, |piece, _| {
            let hole = inner(piece);
            let narrow = hole[0].min(hole[3]);
            let wide = (0..=SAMPLES).map(|k| piece.at(k as f64 / SAMPLES as f64).inner);
            let wide = wide.fold(0.0_f64, f64::max);
            if wide > narrow * (1.0 + 1e-9) && wide > 0.0 {
                let found = format!("a hole of {}", across(narrow));
                let expected = format!(
                    "a wider one: near {} the bat has a hole of {} already",
                    place(piece.start),
                    across(wide)
                );
                return Err(Error::value("diameter", found, expected));
            }
            match &mut piece.radii {
                Radii::Cubic(cubics) => {
                    cubics.inner = hole;
                    cubics.degree = if flat(&hole) { cubics.degree } else { 3 };
                }
                Radii::Formula(curves) => {
                    curves.inner = Some(formula(polynomial(&hole, curves))?);
                }
            }
            Ok(())
        })
    }

    /// Saws these lengths off the knob and off the tip (m).
    pub(crate) fn shortened(&mut self, knob: f64, tip: f64) {
        let length = self.length();
        let end = length - tip;
        self.cut([knob, end]);
        let inside = |piece: &Piece| piece.is_within(knob, end);
        self.pieces.retain(inside);
        if knob > 0.0 {
            self.pieces.iter_mut().for_each(|piece| piece.start -= knob);
            self.pieces[0].start = 0.0;
        }
        self.survey(end - knob);
    }

    /// Changes every piece of a stretch, given the factor of the change over the piece in Bernstein form, 1 for the
    /// full change.
    fn reshape(
        &mut self,
        on: Blended,
        change: impl Fn(&mut Piece, [f64; 4]) -> Result<()>,
    ) -> Result<()> {
        let length = self.length();
        let full = on.full(length);
        self.cut([on.from, full[0], full[1], on.to]);
        let weight = |piece: &Piece| {
            let middle = piece.start + 0.5 * piece.length;
            let (start, run, shape) = match () {
                () if middle < full[0] => (on.from, full[0] - on.from, RISING),
                () if middle > full[1] => (full[1], on.to - full[1], FALLING),
                () => return FULL,
            };
            let share = |x: f64| ((x - start) / run).clamp(0.0, 1.0);
            subdivide(&shape, share(piece.start), share(piece.start + piece.length))
        };
        for piece in self.pieces.iter_mut().filter(|piece| piece.is_within(on.from, on.to)) {
            let weight = weight(piece);
            change(piece, weight)?;
            check_wall(piece)?;
        }
        self.survey(length);
        Ok(())
    }

    /// Recomputes the stations: the ends of every piece, and its widest place if that lies between.
    fn survey(&mut self, length: f64) {
        let (x, outer, inner) = (vec![], vec![], vec![]);
        let mut told = Stations { x, outer, inner, interpolation: Interpolation::Linear };
        let last = self.pieces.len() - 1;
        for (k, piece) in self.pieces.iter().enumerate() {
            let end = if k == last { length } else { self.pieces[k + 1].start };
            let sampled = (1..SAMPLES).map(|k| k as f64 / SAMPLES as f64);
            let widest = sampled.max_by(|a, b| piece.at(*a).outer.total_cmp(&piece.at(*b).outer));
            let [left, right] = piece.ends();
            let widest = widest.filter(|s| piece.at(*s).outer > left.outer.max(right.outer));
            let inside = widest.map(|s| (piece.start + s * piece.length, piece.at(s)));
            let both = [(piece.start, left), (end, right)];
            for (x, section) in [Some(both[0]), inside, Some(both[1])].into_iter().flatten() {
                // A difference in the last digits is not a step.
                let same = |column: &[f64], value: f64| {
                    column.last().is_some_and(|last| (last - value).abs() <= 1e-12 * section.outer)
                };
                let known = told.x.last() == Some(&x);
                if !(known && same(&told.outer, section.outer) && same(&told.inner, section.inner))
                {
                    told.x.push(x);
                    told.outer.push(section.outer);
                    told.inner.push(section.inner);
                }
            }
        }
        self.stations = told;
        self.formulas = None;
    }
}

/// Moves a surface of a piece outwards by `by` (m), in Bernstein form, if the piece has that surface.
fn grown(piece: &mut Piece, surface: Surface, by: [f64; 4]) -> Result<()> {
    match &mut piece.radii {
        Radii::Cubic(cubics) => {
            let radii = match surface {
                Surface::Outside => &mut cubics.outer,
                Surface::Bore if cubics.inner == [0.0; 4] => return Ok(()),
                Surface::Bore => &mut cubics.inner,
            };
            radii.iter_mut().zip(by).for_each(|(r, by)| *r += by);
            cubics.degree = if flat(&by) { cubics.degree } else { 3 };
        }
        Radii::Formula(curves) => {
            let by = polynomial(&by, curves);
            let radius = match surface {
                Surface::Outside => Some(&mut curves.outer),
                Surface::Bore => curves.inner.as_mut(),
            };
            if let Some(radius) = radius {
                *radius = formula(format!("({})+{by}", radius.text()))?;
            }
        }
    }
    Ok(())
}

fn flat(b: &[f64; 4]) -> bool {
    b.iter().all(|v| *v == b[0])
}

/// The wall must be positive everywhere; only an end of the bat may come to a point, if it did before.
fn check_wall(piece: &Piece) -> Result<()> {
    let gone = match &piece.radii {
        Radii::Cubic(cubics) => cubics.no_wall_at(),
        Radii::Formula(_) => None,
    };
    let sampled = (0..=SAMPLES).map(|k| k as f64 / SAMPLES as f64);
    let open = |s: f64| {
        let Section { outer, inner } = piece.at(s);
        // A wall of NaN is refused.
        outer.partial_cmp(&inner) != Some(Ordering::Greater) && (outer, inner) != (0.0, 0.0)
    };
    let gone = gone.filter(|s| open(*s)).or_else(|| sampled.into_iter().find(|s| open(*s)));
    let Some(s) = gone else { return Ok(()) };
    let Section { outer, inner } = piece.at(s);
    let at = place(piece.start + s * piece.length);
    let found = match inner > 0.0 {
        true => format!(
            "no wood left near {at}: a hole of {} in a bat {} across",
            across(inner),
            across(outer.max(0.0))
        ),
        false => format!("no wood left near {at}"),
    };
    Err(Error::value("", found, "a change that leaves wood everywhere"))
}

/// A diameter as text, from a radius (m).
fn across(radius: f64) -> String {
    let diameter = 2.0 * radius;
    format!("{:.2} mm ({:.3} in)", 1e3 * diameter, units::inches(diameter))
}

/// A place or a length as text (m).
pub(crate) fn place(x: f64) -> String {
    format!("{x:.4} m ({:.2} in)", units::inches(x))
}

/// Both radii of a piece as formulas of the position along the bat.
fn as_formulas(piece: &Piece) -> Result<Curves> {
    let cubics = match &piece.radii {
        Radii::Formula(curves) => return Ok(curves.clone()),
        Radii::Cubic(cubics) => cubics,
    };
    let nothing = formula("0".to_owned())?;
    let (from, to) = (piece.start, piece.start + piece.length);
    let mut curves = Curves { outer: nothing, inner: None, from, to, floor: 0.0 };
    curves.outer = formula(polynomial(&cubics.outer, &curves))?;
    if cubics.inner != [0.0; 4] {
        curves.inner = Some(formula(polynomial(&cubics.inner, &curves))?);
    }
    Ok(curves)
}

/// A polynomial in Bernstein form over a stretch of formulas, as a formula of their `x`.
fn polynomial(b: &[f64; 4], over: &Curves) -> String {
    if flat(b) {
        return format!("({:?})", b[0]);
    }
    let s = format!("((x-({:?}))/({:?}))", over.from, over.to - over.from);
    let [b0, b1, b2, b3] = b;
    format!(
        "(({b0:?})*(1-{s})**3+3*({b1:?})*{s}*(1-{s})**2+3*({b2:?})*{s}**2*(1-{s})+({b3:?})*{s}**3)"
    )
}

fn formula(text: String) -> Result<Formula> {
    Formula::parse(&text).map_err(|complaint| {
        let found = format!("a bat whose formula cannot be changed further ({})", complaint.found);
        Error::Value(Complaint::new("", found, "fewer edits at one place, or a shorter formula"))
    })
}
