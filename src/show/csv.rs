//! Tables for spreadsheets and other programs: one line of names, then numbers that read back to the
//! same bits, with commas between them and nothing else.

use csv::Writer;

use crate::collision::columns::Column;
use crate::collision::hit::Impact;

/// One cell.
pub struct Cell(String);

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self(crate::base::number::shortest(value))
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Self(value.to_string())
    }
}

impl From<bool> for Cell {
    fn from(value: bool) -> Self {
        Self(value.to_string())
    }
}

impl From<&str> for Cell {
    fn from(value: &str) -> Self {
        Self(value.to_owned())
    }
}

impl From<String> for Cell {
    fn from(value: String) -> Self {
        Self(value)
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self(String::new()), Into::into)
    }
}

/// A table that is being written.
pub struct Csv(Writer<Vec<u8>>);

impl Csv {
    /// A table with these columns, named with their units.
    pub fn new<S: Into<String>>(names: impl IntoIterator<Item = S>) -> Self {
        let mut table = Self(Writer::from_writer(vec![]));
        table.row(names.into_iter().map(|name| Cell(name.into())));
        table
    }

    /// One more row, as many cells as there are columns.
    ///
    /// # Panics
    ///
    /// With more or fewer cells.
    pub fn row(&mut self, cells: impl IntoIterator<Item = Cell>) {
        let cells = cells.into_iter().map(|cell| cell.0);
        self.0.write_record(cells).expect("as many cells as there are columns");
    }

    /// The whole text.
    ///
    /// # Panics
    ///
    /// Never: it is made of strings.
    pub fn text(self) -> String {
        let bytes = self.0.into_inner().expect("memory can be written to");
        String::from_utf8(bytes).expect("it is made of strings")
    }
}

/// A line of those columns for each impact; empty where there is no value.
pub fn impacts(columns: &[Column], impacts: &[Impact]) -> String {
    let mut table = Csv::new(columns.iter().map(|column| column.name));
    for impact in impacts {
        table.row(columns.iter().map(|column| column.at(impact).into()));
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
