//! Units of a universal file: the conversion of its numbers to SI.

use super::{Analysis, Dataset, Function, NodalData, Values};

/// Dataset 164. A number of the file divided by the factor of its unit is that number in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// 1 for SI, 2 foot and pound-force, … 9 the user's own. The factors count, not the code.
    pub code: i64,
    /// The units in words.
    pub description: String,
    /// 1 absolute, 2 relative temperatures.
    pub temperature_mode: i64,
    /// The file's units of length in a metre.
    pub length: f64,
    /// The file's units of force in a newton.
    pub force: f64,
    /// The file's degrees in a kelvin.
    pub temperature: f64,
    /// Offset of the temperatures in the file; they are not converted.
    pub temperature_offset: f64,
}

impl Units {
    /// Metre, newton, kelvin.
    pub fn si() -> Self {
        Self {
            code: 1,
            description: "SI: Meter (newton)".into(),
            temperature_mode: 1,
            length: 1.0,
            force: 1.0,
            temperature: 1.0,
            temperature_offset: 0.0,
        }
    }

    /// A length in that many metres, with the newton, or with the pound-force for inches and feet.
    pub fn of_length(metre: f64, description: &str) -> Self {
        const POUND_FORCE: f64 = 4.448_221_615_260_5;
        let us = [0.0254, 0.3048].contains(&metre);
        let force = if us { 1.0 / POUND_FORCE } else { 1.0 };
        let description = description.to_owned();
        Self { code: 9, description, length: 1.0 / metre, force, ..Self::si() }
    }

    /// Whether no conversion is needed.
    pub fn are_si(&self) -> bool {
        self.length == 1.0 && self.force == 1.0
    }

    /// The divisor of a number with these exponents of length and force.
    fn factor(&self, [length, force]: [i64; 2]) -> f64 {
        let power = |base: f64, n: i64| base.powi(i32::try_from(n).unwrap_or(i32::MAX));
        power(self.length, length) * power(self.force, force)
    }

    /// Converts a dataset in these units to SI, except temperatures. False if a number overflows.
    pub fn into_si(&self, dataset: &mut Dataset) -> bool {
        let mut sound = true;
        let mut divide = |value: &mut f64, factor: f64| {
            *value /= factor;
            sound &= value.is_finite();
        };
        match dataset {
            Dataset::Nodes(nodes) => nodes
                .nodes
                .iter_mut()
                .flat_map(|node| &mut node.at)
                .for_each(|x| divide(x, self.length)),
            Dataset::NodalData(data) => self.nodal(data, &mut divide),
            Dataset::Function(function) => self.function(function, &mut divide),
            Dataset::Header(_) | Dataset::Units(_) | Dataset::TraceLine(_) => {}
        }
        sound
    }

    fn nodal(&self, data: &mut NodalData, divide: &mut impl FnMut(&mut f64, f64)) {
        for (_, values) in &mut data.values {
            for (k, value) in values.iter_mut().enumerate() {
                let rotation = data.characteristic == NodalData::MOTIONS && k >= 3;
                let factor = self.factor(exponents(data.quantity, rotation));
                value.iter_mut().for_each(|part| divide(part, factor));
            }
        }
        // Modal mass is a mass, i.e. force over length, times the shape squared.
        let [length, force] = exponents(data.quantity, false);
        let mass = self.factor([2 * length - 1, 2 * force + 1]);
        match &mut data.analysis {
            Analysis::NormalMode { modal_mass, .. } => divide(modal_mass, mass),
            Analysis::ComplexMode { modal_a, modal_b, .. } => {
                modal_a.iter_mut().chain(modal_b).for_each(|part| divide(part, mass));
            }
            Analysis::FrequencyResponse { .. } | Analysis::Other { .. } => {}
        }
    }

    fn function(&self, function: &mut Function, divide: &mut impl FnMut(&mut f64, f64)) {
        let of = |axis: usize, direction: i64| {
            let axis = &function.axes[axis];
            let [length, force, _] = axis.exponents;
            let stated = axis.quantity == 1 || (direction == 0 && [length, force] != [0, 0]);
            let table = exponents(axis.quantity, direction.abs() > 3);
            self.factor(if stated { [length, force] } else { table })
        };
        let abscissa = of(0, function.response.direction);
        let numerator = of(1, function.response.direction);
        let denominator = of(2, function.reference.direction);
        match &mut function.abscissa {
            super::Abscissa::Even { start, step } => {
                divide(start, abscissa);
                divide(step, abscissa);
            }
            super::Abscissa::Uneven(places) => {
                places.iter_mut().for_each(|x| divide(x, abscissa));
            }
        }
        let factor = numerator / denominator;
        match &mut function.values {
            Values::Real(values) => values.iter_mut().for_each(|v| divide(v, factor)),
            Values::Complex(values) => {
                values.iter_mut().flatten().for_each(|v| divide(v, factor));
            }
        }
    }
}

/// Exponents of length and force of a kind of data, along a direction or about it: the table of
/// dataset 58's addendum A.
fn exponents(quantity: i64, rotation: bool) -> [i64; 2] {
    match (quantity, rotation) {
        (2 | 15, false) => [-2, 1],
        (2 | 15, true) => [-1, 1],
        (6, _) | (9 | 13 | 16, true) => [1, 1],
        (8 | 11 | 12, false) => [1, 0],
        (9 | 13, false) => [0, 1],
        (16, false) => [-1, 1],
        _ => [0, 0],
    }
}
