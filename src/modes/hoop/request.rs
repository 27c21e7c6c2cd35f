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

/// Which hoop modes, and how accurately.
#[derive(Debug, Clone, PartialEq)]
pub struct HoopRequest {
    /// Largest relative error of any frequency.
    pub tol: f64,
    /// The harmonics.
    pub harmonics: Vec<usize>,
    /// Every mode below this frequency is kept (Hz), up to 200 of a harmonic.
    pub up_to_hz: f64,
    /// At least this many modes of every harmonic are kept.
    pub least: usize,
    /// How the knob side is held.
    pub end: KnobSide,
}

impl Default for HoopRequest {
    /// Modes of n = 0 and 2 to 8 up to 12 kHz to 1e-4: these have 99.7 % of the wall's effect on a hit.
    fn default() -> Self {
        let harmonics = [0].into_iter().chain(2..=8).collect();
        let (tol, end) = (1e-4, KnobSide::Free);
        Self { tol, harmonics, up_to_hz: 12_000.0, least: 3, end }
    }
}
