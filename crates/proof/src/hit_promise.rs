//! Are the stated errors of exit speeds correct?
//!
//! [`rows`] computes the random hits of `validation/hits/hits.json`, which were drawn and integrated by `search/hits/`
//! (Taylor series, no code in common with [`sweetspot::collision`]), and compares the stated error of each with the
//! true one. The promise is the same as for frequencies:
//!
//! ```text
//! true error ≤ 3 × stated error                                always
//! stated error ≤ 30 × true error, where that is visible        in nine cases of ten
//! ```
//!
//! relative to the closing speed. An error is visible above 1e-13 and above three times the possible error of the
//! reference.

use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use crate::promise::{ALWAYS, MOSTLY, VISIBLE};
use sweetspot::base::{Error, Result, Tell, threads};
use sweetspot::bat::{Bat, Theory};
use sweetspot::collision::hit::Wall;
use sweetspot::collision::sweep::{Trial, sweep};
use sweetspot::collision::{Ball, Model, Scene};
use sweetspot::modes::solve::Request;

/// The path of the hits in the project.
const FILE: &str = "validation/hits/hits.json";
/// The text of the hits.
const TEXT: &str = include_str!("../../../validation/hits/hits.json");

/// Bats and their hits (SI).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct DrawnHits {
    #[serde(rename = "source")]
    _source: String,
    bats: Vec<Value>,
    hits: Vec<DrawnHit>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct DrawnHit {
    bat: usize,
    theory: String,
    x: f64,
    swing: f64,
    pivot: f64,
    pitch: f64,
    mass: f64,
    stiffness: f64,
    exponent: f64,
    cor: f64,
    tolerance: f64,
    /// The exact number of modes, without any correction for others.
    modes: Option<usize>,
    wall_stiffness: Option<f64>,
    wall_mass: Option<f64>,
    /// Once the ball is gone for good.
    exit_speed: f64,
    first_exit_speed: f64,
    /// Possible error of the reference, relative to the closing speed.
    known_to: f64,
    /// Effect of a relative change of the closing speed beyond the proportional one.
    sensitivity: f64,
    contacts: usize,
    reloads: usize,
}

/// The course of a hit in the reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReferenceCourse {
    /// Ball and bat touch once.
    Single,
    /// The ball is compressed again before it leaves.
    Reload,
    /// The bat catches up with the ball.
    Later,
}

impl ReferenceCourse {
    /// All courses, with their names.
    pub const ALL: [(Self, &str); 3] =
        [(Self::Single, "one touch"), (Self::Reload, "reload"), (Self::Later, "later touches")];
}

/// One hit: the promise and the truth.
#[derive(Debug, Clone)]
pub struct CheckedHit {
    /// Position of the hit in the file, from 0.
    pub number: usize,
    /// Name of the bat.
    pub bat: String,
    /// How ball and bat meet.
    pub course: ReferenceCourse,
    /// Wanted accuracy of the exit speed, relative to the closing speed.
    pub tolerance: f64,
    /// Whether the tolerance is claimed.
    pub met: bool,
    /// The true error.
    pub truth: f64,
    /// The stated error; infinite without an answer.
    pub stated: f64,
    /// Error bound of the reference.
    pub known_to: f64,
    /// Factor by which the answer magnifies changes of the closing speed, as stated.
    pub sensitivity: f64,
    /// Change of the exit speed by later touches, relative to the closing speed.
    pub later: f64,
}

impl CheckedHit {
    /// True error divided by stated error, as far as the truth is known.
    pub fn ratio(&self) -> f64 {
        // An error that is not a number counts as the worst.
        let off = if self.truth.is_nan() { f64::INFINITY } else { self.truth - self.known_to };
        if self.stated.is_infinite() { 0.0 } else { off.max(0.0) / self.stated }
    }

    /// Whether the true error can be distinguished from that of the reference.
    pub fn visible(&self) -> bool {
        self.stated.is_finite() && self.truth > VISIBLE.max(ALWAYS * self.known_to)
    }

    /// Whether the error is stated within 30 times.
    pub fn close(&self) -> bool {
        self.stated <= MOSTLY * self.truth
    }

    /// Whether every stated error is true and every claim to meet the tolerance is correct.
    pub fn holds(&self) -> bool {
        self.ratio() <= ALWAYS && !(self.met && self.stated > self.tolerance)
    }
}

/// The promise over several hits.
#[derive(Debug, Clone, Copy, Default)]
pub struct Summary {
    /// Number of hits.
    pub hits: usize,
    /// The worst true over stated error.
    pub ratio: f64,
    /// Hits with a visible true error.
    pub visible: usize,
    /// Visible errors that are stated within 30 times the true error.
    pub close: usize,
    /// Hits that claim their tolerance.
    pub met: usize,
    /// Hits with a false claim.
    pub broken: usize,
}

impl Summary {
    /// The summary of those rows.
    pub fn of<'a>(rows: impl IntoIterator<Item = &'a CheckedHit>) -> Self {
        rows.into_iter().fold(Self::default(), |sum, row| Self {
            hits: sum.hits + 1,
            ratio: sum.ratio.max(row.ratio()),
            visible: sum.visible + usize::from(row.visible()),
            close: sum.close + usize::from(row.visible() && row.close()),
            met: sum.met + usize::from(row.met),
            broken: sum.broken + usize::from(!row.holds()),
        })
    }

    /// The share of visible errors that are stated within 30 times.
    pub fn share_close(&self) -> f64 {
        if self.visible == 0 { 1.0 } else { self.close as f64 / self.visible as f64 }
    }

    /// Whether both lines of the promise hold.
    pub fn holds(&self) -> bool {
        self.broken == 0 && 10 * self.close >= 9 * self.visible
    }
}

/// All hits, in the order of the file.
///
/// # Errors
///
/// [`Error::Input`] for a file that contains no hits, and as [`sweep`].
pub fn rows(tell: Tell) -> Result<Vec<CheckedHit>> {
    tell(0.0, "random hits");
    let drawn: DrawnHits = serde_json::from_str(TEXT).map_err(|error| {
        Error::value(FILE, error.to_string(), "hits as search/hits writes them")
    })?;
    let read = |bat: &Value| Bat::from_text(FILE, &bat.to_string(), Path::new(""));
    let bats: Vec<Bat> = drawn.bats.iter().map(read).collect::<Result<_>>()?;
    let checked = |k: usize| row(k, &bats[drawn.hits[k].bat], &drawn.hits[k]);
    threads::map(drawn.hits.len(), checked).into_iter().collect()
}

fn row(number: usize, bat: &Bat, hit: &DrawnHit) -> Result<CheckedHit> {
    let scene = hit.scene();
    let trial = Trial { model: Model::Contact, scene: &scene };
    let accuracy = trial.accuracy(&hit.request()?, hit.modes.is_some());
    let swept = sweep(bat, Model::Contact, &scene, &accuracy, &[hit.x])?;
    let closing = hit.swing * (hit.x + hit.pivot) + hit.pitch;
    let outcome = swept.impacts[0].outcome.as_ref();
    let off = |speed: f64| (speed - hit.exit_speed).abs() / closing;
    Ok(CheckedHit {
        number,
        bat: bat.name().to_owned(),
        course: match (hit.contacts, hit.reloads) {
            (1, 0) => ReferenceCourse::Single,
            (1, _) => ReferenceCourse::Reload,
            _ => ReferenceCourse::Later,
        },
        tolerance: hit.tolerance,
        met: swept.met(),
        truth: outcome.map_or(0.0, |outcome| off(outcome.exit_speed)),
        stated: outcome.map_or(f64::INFINITY, |outcome| outcome.error),
        known_to: hit.known_to,
        sensitivity: hit.sensitivity,
        later: off(hit.first_exit_speed),
    })
}

impl DrawnHit {
    fn scene(&self) -> Scene {
        let ball = Ball {
            mass_kg: self.mass,
            stiffness: Some(self.stiffness),
            exponent: Some(self.exponent),
            cor: self.cor,
            ..Ball::baseball()
        };
        let wall = |stiffness: f64| Wall { stiffness, mass: self.wall_mass.unwrap_or_default() };
        Scene {
            pivot: self.pivot,
            swing: self.swing,
            ball,
            ball_speed: self.pitch,
            cor: self.cor,
            wall: self.wall_stiffness.map(wall),
            ..Scene::default()
        }
    }

    fn request(&self) -> Result<Request> {
        let known = Theory::ALL.into_iter().find(|theory| theory.name() == self.theory);
        let theory = known.ok_or_else(|| Error::value("theory", &self.theory, "a theory"))?;
        let asked = Request { tolerance: self.tolerance, theory, ..Request::default() };
        Ok(Request { modes: self.modes.unwrap_or(asked.modes), ..asked })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(truth: f64, stated: f64) -> CheckedHit {
        CheckedHit {
            number: 0,
            bat: "dowel".into(),
            course: ReferenceCourse::Single,
            tolerance: 1e-3,
            met: true,
            truth,
            stated,
            known_to: 1e-12,
            sensitivity: 1.0,
            later: 0.0,
        }
    }

    #[test]
    fn a_false_statement_breaks_the_promise() {
        assert!(row(2e-6, 1e-6).holds() && row(0.0, f64::INFINITY).stated.is_infinite());
        assert!(!row(4e-6, 1e-6).holds());
        assert!(!row(f64::NAN, 1e-6).holds());
        assert!(!row(1e-6, 2e-3).holds(), "a claim beyond the stated error");
    }

    #[test]
    fn estimates_from_far_above_break_the_second_line() {
        let far = [row(1e-6, 4e-5)];
        assert!(far[0].holds() && !Summary::of(&far).holds());
        let unseen = [row(2e-12, 4e-5)];
        assert!(Summary::of(&unseen).holds());
    }
}
