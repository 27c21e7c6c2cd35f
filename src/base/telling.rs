//! Progress of a long computation, for the person who waits.

/// A function that a long computation calls with the share of the work done (0 to 1) and the name of the next step,
/// possibly from several threads.
pub type Tell<'a> = &'a (dyn Fn(f64, &str) + Sync);

/// A [`Tell`] that ignores the progress.
pub fn nobody(_: f64, _: &str) {}
