//! How does the bat sound when it is tapped or hit at a place?

use std::cell::RefCell;
use std::rc::Rc;

use serde_json::{Value, json};
use sweetspot::Request;
use sweetspot::base::error::{Error, Result};
use sweetspot::bat::body::Bat;
use sweetspot::bat::fixtures::Grip;
use sweetspot::collision::aftermath::Aftermath;
use sweetspot::collision::ball::Ball;
use sweetspot::collision::hit::Effort;
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::hoop_wall::heard;
use sweetspot::motion::sound::{ASSUMED_LOSS, Sound, TAP, WallTone, WallTones, as_heard};
use sweetspot_study::ignored::damping_in_sound;

use crate::asked::{Question, request};
use crate::hit::Solved;

/// Duration of a push by a finger (s), which excites only the first mode.
const FINGER: f64 = 3e-3;
/// Hands as in `docs/bat-files.md`: over the first 6 in from the knob.
const HANDS: Grip = Grip { from: 0.0, to: 0.1524, stiffness: 3e4, damping: 300.0 };

/// Tones of a wall by place.
type Tones = Rc<dyn Fn(f64) -> Vec<WallTone>>;

thread_local! {
    /// The wall of the last sound, with the bat's text: a bat is tapped often, and its hoop modes take a second.
    static WALL: RefCell<Option<(String, Tones)>> = const { RefCell::new(None) };
}

pub fn answer(of: &Question) -> Result<Value> {
    let x =
        of.more.get("x_m").and_then(Value::as_f64).filter(|x| (0.0..=of.bat.length()).contains(x));
    let x = x.ok_or_else(|| Error::value("x_m", "no place", "a place on the bat, in m"))?;
    let held = match of.said("held") {
        None | Some("free") => of.bat.clone(),
        Some("hands") => of.bat.with(|parts| parts.fixtures.grip = Some(HANDS))?,
        Some(other) => return Err(Error::value("held", other, "free or hands")),
    };
    let asked = Request { tolerance: 1e-3, ..request() };
    let of_held = Question { bat: held, ..of.clone() };
    let solved = Solved::new(&of_held, asked, false)?;
    let Solved { bat, solution, scene, model, .. } = &solved;
    let (_, heard) = as_heard(bat, solution)?;
    let wall = wall(&of.bat, &of.text, &scene.ball)?;
    let wall = wall.as_ref().map(|wall| &**wall as WallTones);
    let sound = match of.said("blow") {
        None | Some("tap") => Sound::of_blow(&heard, x, [1.0, TAP], wall),
        Some("finger") => Sound::of_blow(&heard, x, [1.0, FINGER], wall),
        Some("ball") => {
            let hitter = Hitter::new(*model, scene, bat, solution, Effort::default())?;
            let force = hitter.force(x).ok_or_else(|| {
                Error::value(
                    "blow",
                    "a ball that does not meet the bat there",
                    "a place further out",
                )
            })?;
            Aftermath::new(bat, solution, x, force).sound(&heard, wall)
        }
        Some(other) => return Err(Error::value("blow", other, "tap, finger or ball")),
    };
    let assumed = damping_in_sound(&of.bat).map(|told| format!("Damping: {told}."));
    Ok(json!({ "tones": sound.tones, "loudest_m_s2": sound.loudest_m_s2, "assumed": assumed }))
}

/// The tones of the barrel's wall, if it rings.
fn wall(bat: &Bat, text: &str, ball: &Ball) -> Result<Option<Tones>> {
    let key = format!("{} {text}", ball.name);
    let known = WALL.with_borrow(|wall| wall.clone().filter(|(known, _)| *known == key));
    if let Some((_, tones)) = known {
        return Ok(Some(tones));
    }
    let Some(tones) = heard(&bat.with_losses(ASSUMED_LOSS)?, ball) else { return Ok(None) };
    let tones: Tones = Rc::new(tones);
    WALL.set(Some((key, Rc::clone(&tones))));
    Ok(Some(tones))
}
