//! The ringing barrel of a hollow bat for the script of the page, rounded to what a picture shows.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::Bat;
use sweetspot::base::number::rounded;
use sweetspot::modes::hoop::HoopMode;
use sweetspot_study::trampoline::barrel::Barrel;

/// A barrel and its lowest hoop modes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RingingBarrel {
    /// Places from the knob end (mm), rising.
    pub x_mm: Vec<f64>,
    /// Outer radius there (mm).
    pub radius_mm: Vec<f64>,
    /// The lowest modes, six at most.
    pub modes: Vec<RingingMode>,
}

/// A hoop mode: its motion and its frequency.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RingingMode {
    /// Waves around the barrel, n.
    pub harmonic: usize,
    /// Number of the mode within its harmonic, from 1.
    pub order: usize,
    /// Natural frequency (Hz).
    pub frequency_hz: f64,
    /// At every place the motion outwards, times cos nθ; the largest is 1.
    pub radial: Vec<f64>,
    /// At every place the motion around the barrel, times sin nθ.
    pub around: Vec<f64>,
}

/// Places along the barrel.
const PLACES: usize = 61;
/// Modes that move.
pub const MOVING: usize = 6;

/// The modes that move, with their numbers among all.
pub fn moving(barrel: &Barrel) -> Vec<(usize, &HoopMode)> {
    let all = barrel.hoop().modes();
    let number = |mode: &HoopMode| all.iter().position(|one| std::ptr::eq(one, mode));
    let lowest = barrel.hoop().lowest(MOVING).into_iter();
    lowest.filter_map(|mode| Some((number(mode)?, mode))).collect()
}

impl RingingBarrel {
    /// The barrel of that bat; None where it has no hoop modes.
    pub fn new(bat: &Bat, barrel: &Barrel) -> Option<Self> {
        let round = |all: &[f64]| all.iter().map(|value| rounded(*value, 4)).collect();
        let ringing = |(k, mode): &(usize, &HoopMode)| {
            let outline = barrel.hoop().outline(*k, PLACES);
            let mode = RingingMode {
                harmonic: mode.harmonic,
                order: mode.order,
                frequency_hz: rounded(mode.frequency_hz, 2),
                radial: round(&outline.radial),
                around: round(&outline.around),
            };
            (outline.x_m, mode)
        };
        let (places, modes): (Vec<_>, Vec<_>) = moving(barrel).iter().map(ringing).unzip();
        let x = places.into_iter().next()?;
        let millimetres = |value: f64| rounded(1e3 * value, 2);
        Some(Self {
            radius_mm: x.iter().map(|x| millimetres(bat.profile().at(*x).outer)).collect(),
            x_mm: x.into_iter().map(millimetres).collect(),
            modes,
        })
    }
}
