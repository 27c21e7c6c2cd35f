//! Progress of a long computation, for the person who waits.

/// Called again and again with the share of the work that is done (0 to 1) and what comes next. It
/// may be called from several threads.
pub type Tell<'a> = &'a (dyn Fn(f64, &str) + Sync);

/// A [`Tell`] that ignores the progress.
pub fn nobody(_: f64, _: &str) {}
