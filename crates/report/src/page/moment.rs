//! The moment of the hit, picture by picture: how the ball is compressed and the bat bends.
//!
//! During the contact the compression of the ball is that of [`Hitter::history`]. Before and after it, the distance
//! between ball and bat is `∫∫F dt²/m − v t − w(a)`, where v is their closing speed and w the motion of the bat against
//! its swing ([`sweetspot::collision::aftermath`]).

use schemars::JsonSchema;
use serde::Serialize;

use crate::analysis::Analysis;
use sweetspot::base::number::rounded;
use sweetspot::collision::aftermath::{Aftermath, Instant};
use sweetspot::collision::history::Moment as Squeezed;
use sweetspot::collision::{Hitter, Model};
use sweetspot::{Bat, Result};

/// A hit in time as numbers for drawing, rounded to what a picture shows.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Moment {
    /// Name of the place of the hit.
    pub label: String,
    /// Position of the impact (m from the knob end).
    pub x_m: f64,
    /// Time from the first touch to the last (ms).
    pub contact_ms: f64,
    /// Factor by which the drawing enlarges the bending. It is the same in every hit of a page, so that the pictures
    /// can be compared.
    pub factor: u32,
    /// Instants (ms), 0 at the first touch.
    pub times_ms: Vec<f64>,
    /// Force between ball and bat at every instant (kN).
    pub force_kn: Vec<f64>,
    /// How far the ball is from the bat (mm); negative while it is squeezed, by that much.
    pub gap_mm: Vec<f64>,
    /// At every instant the bat's bending at 41 even places from knob to tip, in hundredths
    /// of a millimetre, positive the way the bat swings.
    pub bending_10_um: Vec<Vec<i32>>,
}

/// Number of places along the bat at which its bending is given.
pub const PLACES: usize = 41;
/// Pictures from before the touch to the end.
const PICTURES: usize = 201;
/// How long before the touch it begins (s).
const BEFORE: f64 = 5e-4;
/// Instants in every piece of the recorded force.
const PARTS: usize = 24;
/// How far inside the sweet spot the other hit is (m).
const INSIDE: f64 = 0.1;

/// The hits at the sweet spot and a hand's width, 10 cm, closer to the handle; empty where the model has no force in
/// time or no ball is hit.
///
/// # Errors
///
/// As [`Hitter::new`].
pub fn moments(analysis: &Analysis) -> Result<Vec<Moment>> {
    let Analysis { bat, task, hits, figures, .. } = analysis;
    let (Model::Contact, Some(best)) = (task.model, figures.spot.exit_speed_max) else {
        return Ok(vec![]);
    };
    let hitter = Hitter::new(task.model, &task.scene, bat, &hits.solution, hits.effort)?;
    let inside = best.x - INSIDE;
    let places = [("at the sweet spot", best.x), ("a hand's width closer to the handle", inside)];
    let places = places.into_iter().filter(|(_, x)| *x >= 0.0);
    let mut all: Vec<Moment> =
        places.filter_map(|(label, x)| moment(analysis, &hitter, label, x)).collect();
    let factor = all.iter().map(|moment| moment.factor).min().unwrap_or(1);
    all.iter_mut().for_each(|moment| moment.factor = factor);
    Ok(all)
}

/// One hit in time; None where ball and bat do not meet.
fn moment(analysis: &Analysis, hitter: &Hitter, label: &str, x: f64) -> Option<Moment> {
    let Analysis { bat, task, hits, .. } = analysis;
    let after = Aftermath::new(bat, &hits.solution, x, hitter.force(x)?);
    let closing = hitter.strike(x).bat_speed + task.scene.ball_speed;
    let times = times(analysis, after.end());
    let instants = after.at(&times);
    let flight = Flight {
        after: &after,
        touch: hitter.history(x, PARTS)?,
        ball: task.scene.ball.mass_kg,
        closing,
    };
    let frame = Frame::new(bat);
    let bent: Vec<Vec<f64>> = instants.iter().map(|now| frame.bending(&after, now)).collect();
    let largest = bent.iter().flatten().fold(0.0_f64, |most, w| most.max(w.abs()));
    Some(Moment {
        label: label.to_owned(),
        x_m: x,
        contact_ms: rounded(1e3 * after.end(), 4),
        factor: factor(largest / bat.length()),
        times_ms: times.iter().map(|t| rounded(1e3 * t, 3)).collect(),
        force_kn: instants.iter().map(|now| rounded(1e-3 * now.force, 2)).collect(),
        gap_mm: flight.gaps(&times).iter().map(|gap| rounded(1e3 * gap, 2)).collect(),
        bending_10_um: bent
            .iter()
            .map(|w| w.iter().map(|w| (1e5 * w).round() as i32).collect())
            .collect(),
    })
}

/// Ball and bat as they approach, touch and separate.
struct Flight<'a> {
    after: &'a Aftermath<'a>,
    touch: Vec<Squeezed>,
    /// Mass of the ball (kg).
    ball: f64,
    /// Closing speed of ball and bat (m/s).
    closing: f64,
}

impl Flight<'_> {
    /// The gap between them at those rising times (s), less than 0 while the ball is compressed (m).
    fn gaps(&self, times: &[f64]) -> Vec<f64> {
        let end = self.after.end();
        // The remaining compression of wall and ball at the end of the contact is not part of the flight of the ball.
        let kept = self.apart(&[end])[0] + squeezed(&self.touch, end);
        let gap = |(time, apart): (&f64, f64)| match *time {
            time if time < 0.0 => apart,
            time if time > end => apart - kept,
            time => -squeezed(&self.touch, time),
        };
        times.iter().zip(self.apart(times)).map(gap).collect()
    }

    /// How far apart ball and bat would be if both were rigid where they touch (m).
    fn apart(&self, times: &[f64]) -> Vec<f64> {
        let moved = self.after.pushed(times).into_iter().zip(self.after.at(times));
        let apart = |([ball, _], now): ([f64; 2], Instant)| {
            let bat = self.after.motion(self.after.place, &now)[0];
            ball / self.ball - self.closing * now.time - bat
        };
        moved.map(apart).collect()
    }
}

/// The compression (m) at a time (s) of the touch.
fn squeezed(touch: &[Squeezed], time: f64) -> f64 {
    let next = touch.partition_point(|moment| moment.time < time);
    let Some(before) = touch.get(next.saturating_sub(1)) else { return 0.0 };
    let Some(after) = touch.get(next) else { return before.compression };
    let length = after.time - before.time;
    let share = if length > 0.0 { (time - before.time) / length } else { 0.0 };
    before.compression + share * (after.compression - before.compression)
}

/// From shortly before the touch until the bat has swung to and fro once after it (s).
fn times(analysis: &Analysis, end: f64) -> Vec<f64> {
    /// A picture book of a slow motion would show the hit in a picture or two.
    const LONGEST: f64 = 0.012;
    let period = analysis.solution.modes.first().map_or(0.0, |mode| 1.0 / mode.frequency());
    let last = (4.0 * end).max(LONGEST.min(1.5 * period));
    (0..PICTURES).map(|k| -BEFORE + (last + BEFORE) * k as f64 / (PICTURES - 1) as f64).collect()
}

/// The enlargement factor for a bending of that share of the length.
fn factor(share: f64) -> u32 {
    const SEEN: f64 = 0.1;
    let most = SEEN / share.max(1e-9);
    [100, 50, 20, 10, 5, 4, 3, 2].into_iter().find(|f| f64::from(*f) <= most).unwrap_or(1)
}

/// The bat in a frame that follows its rigid motion: the straight line with its momentum and angular momentum is
/// subtracted.
struct Frame {
    places: Vec<f64>,
    /// Mass at every place (kg); none for a clamped bat, whose frame is that of the clamp.
    masses: Option<Vec<f64>>,
}

impl Frame {
    fn new(bat: &Bat) -> Self {
        let step = bat.length() / (PLACES - 1) as f64;
        let places: Vec<f64> = (0..PLACES).map(|k| step * k as f64).collect();
        let mut masses: Vec<f64> = places.iter().map(|x| step * bat.worth_at(*x).mass).collect();
        (masses[0], masses[PLACES - 1]) = (0.5 * masses[0], 0.5 * masses[PLACES - 1]);
        for [mass, x, _] in bat.fixtures().masses() {
            let nearest = (x / step).round().clamp(0.0, (PLACES - 1) as f64);
            masses[nearest as usize] += mass;
        }
        let free = bat.fixtures().supports.is_empty();
        Self { places, masses: free.then_some(masses) }
    }

    /// The bending at every place (m).
    fn bending(&self, after: &Aftermath, now: &Instant) -> Vec<f64> {
        if now.time <= 0.0 {
            return vec![0.0; PLACES];
        }
        let mut w: Vec<f64> = self.places.iter().map(|x| after.motion(*x, now)[0]).collect();
        let Some(masses) = &self.masses else { return w };
        let sum =
            |of: &dyn Fn(usize) -> f64| -> f64 { (0..PLACES).map(|k| masses[k] * of(k)).sum() };
        let mass = sum(&|_| 1.0);
        let middle = sum(&|k| self.places[k]) / mass;
        let moved = sum(&|k| w[k]) / mass;
        let turned = sum(&|k| w[k] * (self.places[k] - middle))
            / sum(&|k| (self.places[k] - middle).powi(2));
        for (w, x) in w.iter_mut().zip(&self.places) {
            *w -= moved + turned * (x - middle);
        }
        w
    }
}
