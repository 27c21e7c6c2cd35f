//! The bats of a picture.

use sweetspot::Bat;

/// A bat of a picture, and what is drawn of it.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a, T> {
    /// Name of the bat in the picture.
    pub name: &'a str,
    /// The bat.
    pub bat: &'a Bat,
    /// What is drawn of it.
    pub drawn: T,
}

/// Their names.
pub fn names<'a, T>(subjects: &[Subject<'a, T>]) -> Vec<&'a str> {
    subjects.iter().map(|s| s.name).collect()
}

/// Their names and lengths (m).
pub fn lengths<'a, T>(subjects: &[Subject<'a, T>]) -> Vec<(&'a str, f64)> {
    subjects.iter().map(|s| (s.name, s.bat.length())).collect()
}

/// The length of the longest (m).
pub fn longest<T>(subjects: &[Subject<T>]) -> f64 {
    subjects.iter().map(|s| s.bat.length()).fold(0.0, f64::max)
}
