//! How is a force in time written in a file?
//!
//! [`read`] reads a CSV file: straight lines between its rows, 0 before and after. For
//! [`crate::motion::ringing::Ringing::pushed`].

use std::path::Path;

use crate::base::{Complaint, Quantity, Result, mistakes};
use crate::files::csv_file::Csv;
use crate::files::document::Document;
use crate::motion::force::ForceHistory;

/// Reads columns `t_…` and `force_…` with units in the header; times begin at 0 or later.
///
/// # Errors
///
/// [`crate::base::error::Error::Read`] or [`crate::base::error::Error::Input`] with the line.
pub fn read(path: &Path) -> Result<ForceHistory> {
    const MOST: f64 = 1e9;
    let document = Document::table(path)?;
    let columns = [("t", Quantity::Time, 1.0), ("force", Quantity::Force, 1.0)];
    let csv = Csv::read_columns(&document, &columns)?;
    let error = |row: usize, field: &str, found: String, expected: &str| -> Result<()> {
        Err(csv.error(&document, field, Some(row), Complaint::new(field, found, expected)))
    };
    let (Some(t), Some(force)) = (csv.column("t"), csv.column("force")) else {
        let complaint = Complaint::new(
            "header",
            "a column missing",
            "columns t and force, such as t_ms,force_n",
        );
        return Err(csv.error(&document, "", None, complaint));
    };
    if t.len() < 2 {
        error(0, "t", format!("{} row(s)", t.len()), "two at least")?;
    }
    if t[0] < 0.0 {
        error(0, "t", format!("{} s", t[0]), "0 or later")?;
    }
    let wrong = |k: usize| match force[k].abs() < MOST {
        _ if k > 0 && t[k] <= t[k - 1] => error(k, "t", format!("{} s", t[k]), "rising times"),
        true => Ok(()),
        false => error(k, "force", format!("{:e} N", force[k]), "less than 1e9 N"),
    };
    mistakes::all((0..t.len()).map(wrong))?;
    Ok(ForceHistory { t: t.to_vec(), force: force.to_vec() })
}
