//! Which numbers are in the rows that are there?

use std::collections::BTreeMap;
use std::path::Path;

use crate::base::error::{Error, Result};
use crate::files::study_rows::Rows;
use crate::show::many::folder::{StudyFolder, number};
use crate::study::many::indices::Indices;

/// Rows that are kept in memory; of more every third, fifth, … is: an odd step takes as many of every part of
/// a design by Sobol.
const KEPT: u64 = 100_000;
/// Rows that shares are found from.
const FITTED: usize = 8192;

/// A column of numbers.
#[derive(Debug, Clone)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its unit, which may be none.
    pub unit: String,
    /// Its numbers, NaN where a row has none.
    pub values: Vec<f64>,
}

/// Rows that were read back.
#[derive(Debug, Clone)]
pub struct Table {
    /// Everything that is a number.
    pub columns: Vec<Column>,
    /// Which rows their values are of.
    pub kept: Vec<u64>,
    /// How many rows one was kept of.
    pub every: u64,
    /// How many rows there are.
    pub rows: u64,
    /// How many are as accurate as asked.
    pub met: u64,
    /// Why others have no answer, and how many.
    pub reasons: BTreeMap<String, u64>,
}

impl Table {
    /// Reads all parts of a folder, which must be there.
    ///
    /// # Errors
    ///
    /// [`Error::Read`].
    pub fn read(folder: &StudyFolder, rows: &Rows) -> Result<Self> {
        let columns = rows.columns();
        let of = |k: usize| {
            let [name, unit] = columns[k].clone();
            Column { name, unit, values: vec![] }
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
        for k in 0..folder.parts() {
            table.add(&folder.part(k), &numbers)?;
        }
        Ok(table)
    }

    fn add(&mut self, path: &Path, numbers: &[usize]) -> Result<()> {
        let failed =
            |error: csv::Error| Error::Read { path: path.to_owned(), source: error.into() };
        let mut part = csv::Reader::from_path(path).map_err(failed)?;
        for row in part.records() {
            let row = row.map_err(failed)?;
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
                *self.reasons.entry(why.to_owned()).or_default() += 1;
            }
        }
        Ok(())
    }

    /// The column of that name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// What makes an answer vary; None where rows differ by other than what is drawn, or as [`Indices::new`].
    pub fn shares(&self, rows: &Rows, name: &str) -> Option<Indices> {
        let design = &rows.study.design;
        if rows.several() || design.combinations() > 1 {
            return None;
        }
        let column = self.column(name)?;
        let known = self.kept.iter().zip(&column.values).filter(|(_, y)| y.is_finite());
        let fitted: Vec<_> = known.take(FITTED).map(|(k, y)| (design.numbers(*k), *y)).collect();
        Indices::new(&design.kinds(), &fitted)
    }
}
