//! What does the picture `docs/r161_hit.svg` show?
//!
//! Exit speeds along an R161, ours beside what others measured and computed; [`svg`] draws it anew.

use crate::error::Result;
use crate::known_hits::Seen;
use crate::report::svg::{Axis, Drawn, Panel, Series, picture};
use crate::solve::{Request, solve};
use crate::validation::{Case, Known, bundled_case};

/// Its name beside the page.
pub const FILE: &str = "r161_hit.svg";

/// What Cross's error bars in the figure are in the mean, from 0.012 to 0.02 (m/s).
const CROSS: f64 = 0.015;
/// How well the other figure can be read (m/s).
const READ: f64 = 0.4;
/// Modes in the WPI report's loss.
const REPORT_MODES: usize = 10;

const OURS: &str = "#0b5fa5";
const RIGID: &str = "#777777";
const LOSS: &str = "#c46a00";
const THEIRS: &str = "#b00020";

/// The picture.
///
/// # Errors
///
/// What the two hits raise.
pub fn svg() -> Result<String> {
    let tap = bundled_case("r161_hit_cross")?;
    let mut slow = curves(&tap)?;
    // The empirical loss depends on who is looking: no curve for a bat at rest.
    slow.truncate(2);
    slow.push(known(&tap, "measured by Cross", CROSS));
    let game = bundled_case("r161_hit_nathan")?;
    let mut fast = curves(&game)?;
    fast.push(known(&game, "Nathan's Fig. 10, read off", READ));
    let place = || Axis { label: "from the knob end (cm)".into(), from: 40.0, to: 85.0, tick: 5.0 };
    let speed = |to, tick| Axis { label: "exit speed (m/s)".into(), from: 0.0, to, tick };
    Ok(picture(&[
        Panel {
            title: "R161 at rest, ball at 1 m/s".into(),
            x: place(),
            y: speed(0.5, 0.1),
            series: slow,
        },
        Panel {
            title: "R161 at game speed, ball at 40 m/s".into(),
            x: place(),
            y: speed(50.0, 10.0),
            series: fast,
        },
    ]))
}

/// Ours, the rigid bat's and the WPI report's loss.
fn curves(case: &Case) -> Result<Vec<Series>> {
    let bat = case.bat()?;
    let request = case.request()?;
    let solution = solve(&bat, &request)?;
    let ten = solve(&bat, &Request { modes: REPORT_MODES, ..request })?;
    let places: Vec<f64> = (80..168).map(|k| 0.005 * k as f64).collect();
    let [ours, rigid, loss] = match &case.hit {
        Some(throw) => throw.curves(&bat, [&solution, &ten], &places)?,
        None => Default::default(),
    };
    let series = |name: &str, color, dashed, points: Vec<[f64; 2]>| Series {
        name: name.into(),
        color,
        drawn: Drawn::Line { dashed },
        points: points.iter().map(|[x, v]| [100.0 * x, *v]).collect(),
    };
    Ok(vec![
        series("ours, contact, with shear", OURS, false, ours),
        series("the same bat, rigid", RIGID, true, rigid),
        series("WPI report's energy loss", LOSS, true, loss),
    ])
}

/// The exit speeds that the case knows.
fn known(case: &Case, name: &str, error: f64) -> Series {
    let wanted = Known::Hit(Seen::ExitSpeedMPerS);
    let checks = case.checks.iter().filter(|check| check.quantity == wanted);
    Series {
        name: name.into(),
        color: THEIRS,
        drawn: Drawn::Dots { error },
        points: checks.filter_map(|check| Some([100.0 * check.at?, check.expected])).collect(),
    }
}
