//! How far long work has come, for whoever waits.

/// Told, again and again, how much of the work is done (0 to 1) and what comes next. It may be
/// called from several threads.
pub type Tell<'a> = &'a (dyn Fn(f64, &str) + Sync);

/// Nobody waits.
pub fn nobody(_: f64, _: &str) {}
