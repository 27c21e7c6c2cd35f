//! A clock that stands still: what is timed takes no time.

#![forbid(unsafe_code)]

pub use std::time::Duration;

/// The one instant there is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instant;

impl Instant {
    /// The one instant there is.
    #[must_use]
    pub fn now() -> Self {
        Self
    }

    /// No time at all.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
}
