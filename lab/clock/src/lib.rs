//! A clock that does not run: every measured duration is 0.

#![forbid(unsafe_code)]

pub use std::time::Duration;

/// The only instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instant;

impl Instant {
    /// The only instant.
    #[must_use]
    pub fn now() -> Self {
        Self
    }

    /// A duration of 0.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
}
