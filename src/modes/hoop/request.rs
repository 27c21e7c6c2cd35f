//! What is asked of the wall?

/// How the knob side of the modelled stretch is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum KnobSide {
    /// Free: frequencies are then no higher than the bat's.
    #[default]
    Free,
    /// Clamped: frequencies are then no lower than the bat's.
    Clamped,
}

/// Which hoop modes, how accurate.
#[derive(Debug, Clone, PartialEq)]
pub struct HoopRequest {
    /// Largest relative error of any frequency.
    pub tol: f64,
    /// The harmonics.
    pub harmonics: Vec<usize>,
    /// Every mode below this frequency is kept (Hz), up to 200 of a harmonic.
    pub up_to_hz: f64,
    /// At least the given number of modes of every harmonic are kept.
    pub least: usize,
    /// How the knob side is held.
    pub end: KnobSide,
    /// Whether a mode may be off by more the less it gives way under a ball, as [`Self::allowed`] says.
    pub eased: bool,
}

/// No mode may be off by more than this, unless all may.
const ROUGHEST: f64 = 1e-2;
/// By this power of n what a harmonic has of the giving way under a ball falls: n = 3 to 8 of [`super::patch`]
/// on a barrel of 3 mm, and n = 0 as n = 6.
const FALLS: f64 = 3.6;

impl HoopRequest {
    /// Largest relative error of a mode of harmonic n that is this many times as high as the first of its harmonic.
    ///
    /// Under a ball the mode gives way by `c/ω²`: an eased request allows an error that is as much larger as this
    /// is smaller than that of the first mode of n = 2.
    pub fn allowed(&self, n: usize, times: f64) -> f64 {
        if !self.eased {
            return self.tol;
        }
        let waves = if n == 0 { 6.0 } else { n as f64 };
        let less = (0.5 * waves).powf(FALLS) * times * times;
        (self.tol * less).min(ROUGHEST).max(self.tol)
    }
}

impl Default for HoopRequest {
    /// Modes of n = 0 and 2 to 8 up to 12 kHz within 1e-4: they hold 99.7 % of what the wall adds to a hit.
    fn default() -> Self {
        let harmonics = [0].into_iter().chain(2..=8).collect();
        let (tol, end) = (1e-4, KnobSide::Free);
        Self { tol, harmonics, up_to_hz: 12_000.0, least: 3, end, eased: false }
    }
}
