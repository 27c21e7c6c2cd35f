//! Values on the command line: how they are read, and how they are said.

use std::time::Duration;

use crate::base::units::{self, Quantity};
use crate::bat::theory::Theory;
use crate::modes::solve::Solver;
use crate::show::report::text::Units;
use clap::builder::{PossibleValuesParser, TypedValueParser};

/// A length as it is said in messages, whichever unit it came in.
pub fn shown_length(length: f64) -> String {
    let inches: f64 = format!("{:.5e}", units::inches(length)).parse().unwrap_or(f64::NAN);
    format!("{length:?} m ({inches:?} in)")
}

/// A value with its unit from the command line.
pub fn quantity(text: &str, quantity: Quantity) -> std::result::Result<f64, String> {
    units::parse_or_si(text, quantity).map_err(|complaint| complaint.to_string())
}

/// A relative accuracy from the command line, as a number or in %.
pub fn tolerance(text: &str) -> std::result::Result<f64, String> {
    let (number, scale) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>() {
        Ok(value) if value * scale > 0.0 && value * scale < 1.0 => Ok(value * scale),
        _ => Err("expected a number between 0 and 1, such as 1e-6 or 0.01%".into()),
    }
}

/// How long something may take, from the command line.
pub fn budget(text: &str) -> std::result::Result<Duration, String> {
    let seconds = quantity(text, Quantity::Time)?;
    let expected = "expected a time from 1 us to 1 day, such as \"5 ms\"";
    if (1e-6..=86_400.0).contains(&seconds) {
        Duration::try_from_secs_f64(seconds).map_err(|_| expected.into())
    } else {
        Err(expected.into())
    }
}

/// One of the names, which completions and messages list.
pub fn choice<T: Clone + Send + Sync + 'static>(
    names: &'static [&'static str],
    meant: impl Fn(&str) -> T + Clone + Send + Sync + 'static,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(names).map(move |name| meant(&name))
}

/// One of these by its name, as [`choice`].
pub fn named<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let of_name = move |text: String| all.into_iter().find(|one| name(*one) == text);
    PossibleValuesParser::new(all.map(name))
        .try_map(move |text| of_name(text).ok_or("no such name"))
}

/// A theory, or none: that which the bat needs.
#[derive(Debug, Clone, Copy)]
pub struct TheoryChoice(pub Option<Theory>);

/// `--theory` on the command line.
pub fn theory() -> impl TypedValueParser<Value = TheoryChoice> {
    choice(&["auto", "euler-bernoulli", "rayleigh", "timoshenko"], |name| {
        TheoryChoice(Theory::ALL.into_iter().find(|theory| theory.name() == name))
    })
}

/// `--solver` on the command line.
pub fn solver() -> impl TypedValueParser<Value = Solver> {
    choice(&["auto", "statics", "dense", "shift-invert", "arpack"], |name| match name {
        "dense" => Solver::Dense,
        "shift-invert" => Solver::ShiftInvert,
        "arpack" => Solver::Arpack,
        _ => Solver::Statics,
    })
}

/// `--units` on the command line.
pub fn unit_system() -> impl TypedValueParser<Value = Units> {
    choice(&["si", "us", "both"], |name| match name {
        "si" => Units::Si,
        "us" => Units::Us,
        _ => Units::Both,
    })
}
