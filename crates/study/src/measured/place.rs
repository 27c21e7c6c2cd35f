//! Where on the bat are the measured points?
//!
//! A file's coordinates have their own origin and direction. The end that comes first is given, or it is the one that
//! makes the shapes most similar to computed ones. The position of the first point is given, or it follows from the
//! coordinates: if they lie within the bat they count from its end, otherwise the points are assumed to be centred.

use faer::c64;
use serde::Serialize;

use crate::engine::{Error, Result, significant};
use crate::measured::data::Measured;
use crate::named::named;

named! {
    /// An end of the bat.
    #[derive(schemars::JsonSchema)]
    pub enum End {
        /// The knob end, where the hands are.
        Knob = "knob",
        /// The end of the barrel.
        Tip = "tip",
    }
}

/// Given facts about the points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToldPoints {
    /// The end that the first point is near, the one with the lowest coordinate.
    pub first: Option<End>,
    /// Position of that point (m from the knob end).
    pub origin: Option<f64>,
}

/// The points on the bat.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Placed {
    /// Assumptions in placing the points on the bat, a sentence each.
    pub assumed: Vec<String>,
    /// The end near the first point of the file.
    #[serde(rename = "first_end")]
    pub first: End,
    /// Positions of the points (m).
    // From the knob end, rising.
    #[serde(rename = "x_m")]
    pub x: Vec<f64>,
    /// The measured shapes at these points; empty for a mode without one.
    #[serde(skip)]
    pub shapes: Vec<Vec<c64>>,
    /// How well the shapes fit this way and turned end for end, where either can be.
    #[serde(skip)]
    pub fits: [Option<f64>; 2],
    /// Whether the reversed order would fit clearly better, although the file says otherwise.
    #[serde(skip)]
    pub turned_fits_better: bool,
}

/// Points up to this far beyond an end (as a share of the length) are at the end.
const BEYOND: f64 = 0.01;
/// Least difference by which one fit counts as better.
const BETTER: f64 = 0.02;

/// Finds the points' places on a bat of that length (m). `fit` gives the similarity of shapes at such places to
/// computed ones, at most 1.
///
/// # Errors
///
/// [`Error::Value`] if the points extend beyond the bat.
pub fn place(
    measured: &Measured,
    length: f64,
    told: ToldPoints,
    fit: impl Fn(&[f64], &[Vec<c64>]) -> f64,
) -> Result<Placed> {
    fits_on(measured, length)?;
    let shapes: Vec<Vec<c64>> = measured.modes.iter().map(|mode| mode.shape.clone()).collect();
    let way = |first: End| -> Result<Placed> {
        let (places, how) = places(measured, length, told.origin, first);
        let mut x = on_the_bat(places, length)?;
        let mut shapes = shapes.clone();
        if first == End::Tip {
            x.reverse();
            shapes.iter_mut().for_each(|shape| shape.reverse());
        }
        let fits = [Some(fit(&x, &shapes)), None];
        Ok(Placed { assumed: vec![how], first, x, shapes, fits, turned_fits_better: false })
    };
    let wanted = told.first.or(measured.from_knob.then_some(End::Knob));
    let (mut placed, other, reason) = choose(wanted, way(End::Knob), way(End::Tip))?;
    let fit = placed.fit();
    if let Some(reason) = reason {
        let turned = other.map_or(String::new(), |other| format!(", turned round {other:.3}"));
        let first = placed.first.name();
        placed.assumed.push(format!(
            "the first is nearest the {first}: {reason} (mean MAC {fit:.3}{turned})"
        ));
    }
    placed.fits[1] = other;
    placed.turned_fits_better = other.is_some_and(|other| other > fit + BETTER);
    Ok(placed)
}

/// The points in one of two orders, the fit of the other one if it is possible, and the reason for the choice if the
/// file does not decide.
type ChosenOrder = (Placed, Option<f64>, Option<&'static str>);

impl Placed {
    /// How well the shapes fit this way.
    fn fit(&self) -> f64 {
        self.fits[0].unwrap_or(0.0)
    }
}

fn choose(wanted: Option<End>, knob: Result<Placed>, tip: Result<Placed>) -> Result<ChosenOrder> {
    let fits = [&knob, &tip].map(|way| way.as_ref().ok().map(Placed::fit));
    Ok(match (wanted, knob, tip) {
        (Some(End::Knob), knob, _) => (knob?, fits[1], None),
        (Some(End::Tip), _, tip) => (tip?, fits[0], None),
        (None, Ok(knob), Ok(tip)) => match tip.fit() - knob.fit() {
            d if d > BETTER => (tip, fits[0], Some("so the shapes fit better")),
            d if d < -BETTER => (knob, fits[1], Some("so the shapes fit better")),
            _ => {
                let alike = "both ways fit alike, and the knob end is taken (say that the tip comes first to turn it)";
                (knob, fits[1], Some(alike))
            }
        },
        (None, knob, tip) => {
            let either = knob.or_else(|error| tip.map_err(|_| error))?;
            (either, None, Some("the other way points are off the bat"))
        }
    })
}

/// Places from the knob end (m) with that end first, and how they were found.
fn places(measured: &Measured, length: f64, origin: Option<f64>, first: End) -> (Vec<f64>, String) {
    let along = &measured.along;
    let (low, high) = (along[0], along[along.len() - 1]);
    let turned = |x: f64| if first == End::Tip { length - x } else { x };
    let margin = BEYOND * length;
    let from = |places: &dyn Fn(f64) -> f64| along.iter().map(|s| places(*s)).collect();
    if let Some(origin) = origin {
        let sign = if first == End::Tip { -1.0 } else { 1.0 };
        let how = format!("the first point is {origin} m from the knob end, as told");
        return (from(&|s| origin + sign * (s - low)), how);
    }
    if measured.from_knob || (low >= -margin && high <= length + margin) {
        let end = match first {
            End::Knob => "knob end",
            End::Tip => "tip",
        };
        return (from(&|s| turned(s)), format!("places count from the {end}"));
    }
    let before = 0.5 * (length - (high - low));
    let how = format!(
        "the coordinates, {low:.4} to {high:.4} m, do not count from an end of a bat of {length:.4} m: \
         the points are taken as in its middle (--origin says where the first is)"
    );
    (from(&|s| turned(s - low + before)), how)
}

/// Points that span less of a bat than this share are in another unit: an inch is a fortieth of a metre.
const LEAST_SPAN: f64 = 0.05;

/// Checks the span: points farther apart than the bat's length do not fit on it, and several within a twentieth of it
/// determine no shape.
fn fits_on(measured: &Measured, length: f64) -> Result<()> {
    let many = measured.along.len();
    let span = measured.along[many - 1] - measured.along[0];
    let least = if many > 1 { LEAST_SPAN * length } else { 0.0 };
    if (least..=length * (1.0 + 2.0 * BEYOND)).contains(&span) {
        return Ok(());
    }
    let found = format!("{many} points that span {} m", significant(span, 3));
    let limit = if span < least { "at least a twentieth of" } else { "at most" };
    let expected = format!("{limit} the bat's {length:.4} m: is the unit right?");
    Err(Error::value(&measured.source, found, expected))
}

/// Places a little beyond an end are at the end; farther out there is no bat.
fn on_the_bat(places: Vec<f64>, length: f64) -> Result<Vec<f64>> {
    let margin = BEYOND * length;
    match places.iter().find(|x| !(-margin..=length + margin).contains(*x)) {
        Some(x) => Err(Error::value(
            "measured points",
            format!("one at {x:.4} m from the knob end"),
            format!("places on the bat, 0 to {length:.4} m: is the unit right, and the origin?"),
        )),
        None => Ok(places.into_iter().map(|x| x.clamp(0.0, length)).collect()),
    }
}
