//! Tables for spreadsheets and other programs: a line of names, then lines of values separated by commas. The numbers
//! read back to the same bits.

use csv::Writer;

use crate::parts::{Cell, table};
use sweetspot::Solution;
use sweetspot::collision::Impact;
use sweetspot::collision::columns::{self, Column};
use sweetspot::modes::mode::ModeError;

/// A table that is being written.
pub struct Csv(Writer<Vec<u8>>);

impl Csv {
    /// A table with these columns, named with their units.
    pub fn new<S: Into<String>>(names: impl IntoIterator<Item = S>) -> Self {
        let mut table = Self(Writer::from_writer(vec![]));
        table.row(names.into_iter().map(|name| Cell::from(name.into())));
        table
    }

    /// Adds a row with as many cells as there are columns.
    ///
    /// # Panics
    ///
    /// If the number of cells differs.
    pub fn row(&mut self, cells: impl IntoIterator<Item = Cell>) {
        let cells = cells.into_iter().map(Cell::in_file);
        self.0.write_record(cells).expect("as many cells as there are columns");
    }

    /// The whole text.
    ///
    /// # Panics
    ///
    /// Never, because the text is made of strings.
    pub fn text(self) -> String {
        let bytes = self.0.into_inner().expect("memory can be written to");
        String::from_utf8(bytes).expect("it is made of strings")
    }
}

/// The rows as lines, with the columns that files have.
pub fn rows<T>(columns: &[table::Column<T>], rows: &[T]) -> String {
    let columns = columns.iter().map(table::Column::in_file);
    let columns: Vec<_> = columns.filter(|(name, _)| !name.is_empty()).collect();
    let mut out = Csv::new(columns.iter().map(|(name, _)| *name));
    rows.iter().for_each(|row| out.row(columns.iter().map(|(_, of)| of(row))));
    out.text()
}

/// A line for each impact with those columns; a cell is empty where there is no value.
pub fn impacts(columns: &[Column], impacts: &[Impact]) -> String {
    let mut table = Csv::new(columns.iter().map(|column| column.name));
    for impact in impacts {
        table.row(columns.iter().map(|column| column.at(impact).into()));
    }
    table.text()
}

/// A line for each hit: every figure, the number of modes, the error of the exit speed, and flags.
pub fn hits(impacts: &[Impact]) -> String {
    let names = columns::ALL.iter().map(|column| column.name);
    let mut table = Csv::new(names.chain(["modes_used", "error.exit_speed", "flags"]));
    for impact in impacts {
        let figures = columns::ALL.iter().map(|column| column.at(impact).into());
        let outcome = impact.outcome.as_ref();
        let error = outcome.map(|outcome| outcome.error).filter(|error| error.is_finite());
        let modes = outcome.map(|outcome| outcome.energy.vibration_by_mode.len());
        let rest = [modes.into(), error.into(), impact.flags.join(" ").into()];
        table.row(figures.chain(rest));
    }
    table.text()
}

/// A line for each mode: its figures with their errors, and its nodes in separate columns.
pub fn modes(solution: &Solution) -> String {
    const FIGURES: [&str; 9] = [
        "order",
        "frequency_hz",
        "damping_ratio",
        "modal_mass_kg",
        "error.discretization",
        "error.round_off",
        "error.residual",
        "error.nodes_m",
        "error.modal_mass",
    ];
    let most = solution.modes.iter().map(|mode| mode.nodes.len()).max().unwrap_or(0);
    let nodes = (1..=most).map(|k| format!("node_{k}_m"));
    let mut table = Csv::new(FIGURES.map(str::to_owned).into_iter().chain(nodes));
    for (k, mode) in solution.modes.iter().enumerate() {
        let ModeError { discretization, round_off, residual, nodes, modal_mass, .. } = mode.error;
        let known = |error: f64| Some(error).filter(|error| error.is_finite()).into();
        let damping = solution.damping.modes.get(k).map_or(0.0, |damped| damped.ratio);
        let figures = [mode.frequency(), damping, mode.modal_mass].map(Cell::from);
        let errors = [discretization, round_off, residual, nodes, modal_mass].map(known);
        let nodes = (0..most).map(|k| mode.nodes.get(k).copied().into());
        table.row([mode.order.into()].into_iter().chain(figures).chain(errors).chain(nodes));
    }
    table.text()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_read_back_to_what_they_were() {
        let mut table = Csv::new(["x_m", "name", "met", "error"]);
        table.row([0.1.into(), "a, \"b\"".into(), true.into(), None::<f64>.into()]);
        table.row([1e-300.into(), 3.into(), false.into(), Some(-0.0).into()]);
        let text = table.text();
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows[0].iter().collect::<Vec<_>>(), ["0.1", "a, \"b\"", "true", ""]);
        assert_eq!(rows[1][0].parse::<f64>().unwrap().to_bits(), 1e-300_f64.to_bits());
        assert_eq!(rows[1][3].parse::<f64>().unwrap().to_bits(), (-0.0_f64).to_bits());
    }
}
