//! Which ball is meant: a built-in one, or one of a file?

use crate::base::{Complaint, Error, Result, nearest};
use crate::collision::Ball;
use crate::files::ball_file;
use crate::files::folder::Folder;

/// A ball's name and its constructor.
type NamedBall = (&'static str, fn() -> Ball);

/// The built-in balls.
const BALLS: [NamedBall; 3] = [
    ("baseball", Ball::baseball),
    ("humid-baseball", Ball::humid_baseball),
    ("softball", Ball::softball),
];

/// Whether a built-in ball has that name.
pub fn is_built_in(name: &str) -> bool {
    BALLS.iter().any(|(known, _)| *known == name)
}

/// A ball by its name or its file; a linear spring if a stiffness (N/m) is given.
///
/// # Errors
///
/// As [`Ball::from_file`] and [`Ball::linear`], and [`Error::Value`] for a misspelt name.
pub fn ball(name: &str, stiffness: Option<f64>) -> Result<Ball> {
    let ball = match built_in(name) {
        Some(ball) => ball,
        None => Ball::from_file(name).map_err(|error| unknown_ball(name, error))?,
    };
    match stiffness {
        Some(stiffness) => ball.linear(stiffness),
        None => Ok(ball),
    }
}

/// A ball by its name or its file, as named by a file in that folder.
///
/// # Errors
///
/// As [`ball`], and those of `Folder::json`.
pub fn ball_in(name: &str, folder: &Folder) -> Result<Ball> {
    if let Some(ball) = built_in(name) {
        return Ok(ball);
    }
    let document = folder.json(name, "ball").map_err(|error| unknown_ball(name, error))?;
    ball_file::from_document(&document)
}

/// The built-in ball of that name.
pub fn built_in(name: &str) -> Option<Ball> {
    BALLS.iter().find(|(known, _)| *known == name).map(|(_, ball)| ball())
}

/// The error for an unreadable ball: a name near a known one is a misspelling, not a file.
fn unknown_ball(name: &str, error: Error) -> Error {
    let known = BALLS.map(|(name, _)| name);
    match error {
        Error::Read { source, .. } if nearest(name, &known).is_some() => {
            let found = format!("{name}, which cannot be read ({source})");
            let complaint = Complaint::new(
                "`ball`",
                found,
                "baseball, humid-baseball, softball or a ball file",
            );
            Error::Value(complaint.or_nearest(name, &known))
        }
        other => other,
    }
}
