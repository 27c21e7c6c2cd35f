//! Which numbers are in the rows that are there?

use std::collections::BTreeMap;

use crate::many::folder::StudyFolder;
use crate::many::part::{number, read};
use sweetspot::Result;
use sweetspot::base::{file, marks};
use sweetspot_study::files::study_rows::Rows;
use sweetspot_study::many::indices::Indices;

/// Number of rows kept in memory. Of more rows, every third, fifth, … is kept: an odd step takes equally many from
/// every part of a Sobol design.
const KEPT: u64 = 100_000;
/// Number of rows from which shares are found.
const FITTED: usize = 8192;

/// A column of numbers.
#[derive(Debug, Clone)]
pub struct NumberColumn {
    /// Its name.
    pub name: String,
    /// Its unit, possibly empty.
    pub unit: String,
    /// Its numbers, NaN for a row without one.
    pub values: Vec<f64>,
}

/// Rows that were read back.
#[derive(Debug, Clone)]
pub struct Table {
    /// Everything that is a number.
    pub columns: Vec<NumberColumn>,
    /// The rows whose values are kept.
    pub kept: Vec<u64>,
    /// One of this number of rows was kept.
    pub every: u64,
    /// Number of rows.
    pub rows: u64,
    /// Number of rows that are as accurate as requested.
    pub met: u64,
    /// Why others have no answer, by the reason without its numbers.
    pub reasons: BTreeMap<String, Reason>,
}

/// Why some rows have no answer.
#[derive(Debug, Clone)]
pub struct Reason {
    /// How many rows.
    pub rows: u64,
    /// The first row with that reason.
    pub first: u64,
    /// The reason in that row.
    pub said: String,
}

impl Table {
    /// Reads all parts of a folder, which must be there.
    ///
    /// # Errors
    ///
    /// [`Error::Read`](sweetspot::Error::Read), and [`Error::Value`](sweetspot::Error::Value) for a part that is not as the study makes it.
    pub fn read(folder: &StudyFolder, rows: &Rows) -> Result<Self> {
        let columns = rows.columns();
        let of = |k: usize| {
            let [name, unit] = columns[k].clone();
            NumberColumn { name, unit, values: vec![] }
        };
        let numbers = rows.numbers();
        let mut table = Self {
            columns: numbers.iter().map(|k| of(*k)).collect(),
            kept: vec![],
            every: rows.count().div_ceil(KEPT) | 1,
            rows: 0,
            met: 0,
            reasons: BTreeMap::new(),
        };
        let division = folder.division();
        for k in 0..division.parts() {
            let path = folder.part(k);
            let part = file::read_plain(&path)?;
            read(rows, division.part(k), (&path, &part), |row| table.add(row, &numbers))?;
        }
        Ok(table)
    }

    fn add(&mut self, row: &csv::StringRecord, numbers: &[usize]) {
        if self.rows.is_multiple_of(self.every) {
            self.kept.push(self.rows);
            for (column, k) in self.columns.iter_mut().zip(numbers) {
                column.values.push(number(&row[*k]));
            }
        }
        self.rows += 1;
        let [why, met] = [1, 2].map(|k| &row[row.len() - k]);
        self.met += u64::from(met == "true");
        if !why.is_empty() {
            let (first, said) = (self.rows - 1, marks::of_cell(why).to_owned());
            let new = || Reason { rows: 0, first, said };
            self.reasons.entry(kind(why)).or_insert_with(new).rows += 1;
        }
    }

    /// The column of that name.
    pub fn column(&self, name: &str) -> Option<&NumberColumn> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// What causes the variation of an answer, for one bat of which only the random inputs vary.
    ///
    /// # Errors
    ///
    /// The reason for which it cannot be determined.
    pub fn shares(&self, rows: &Rows, name: &str) -> std::result::Result<Indices, String> {
        let design = &rows.study.design;
        if rows.several() || design.combinations() > 1 {
            return Err("bats or lists differ too".to_owned());
        }
        let column = self.column(name).ok_or("it is no answer")?;
        let fitted: Vec<(&u64, &f64)> = self.kept.iter().zip(&column.values).take(FITTED).collect();
        // Missing rows lie together, mostly in a tail, and the remaining ones have other distributions.
        let missing = fitted.iter().filter(|(_, y)| !y.is_finite()).count();
        if missing > 0 {
            return Err(format!(
                "{missing} of {} rows have no answer, and shares of the others would be those of other \
                 distributions than the study's",
                fitted.len()
            ));
        }
        let fitted: Vec<_> = fitted.into_iter().map(|(k, y)| (design.numbers(*k), *y)).collect();
        Indices::new(&design.kinds(), &fitted)
            .ok_or_else(|| "too few rows, or it is the same in all".to_owned())
    }
}

/// A reason without its numbers, however they are written.
fn kind(why: &str) -> String {
    let in_number = |c: char| c.is_ascii_digit() || ".+-".contains(c);
    let words = why.split(' ').map(|word| match word.trim_matches(in_number) {
        // The remainder of 1e-5.
        "e" => "",
        _ => word,
    });
    let letters = |word: &str| word.chars().filter(|c| !in_number(*c)).collect::<String>();
    words.map(letters).collect::<Vec<_>>().join(" ")
}
