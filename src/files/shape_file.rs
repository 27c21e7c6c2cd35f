//! How is an initial shape written in a file?
//!
//! [`read`] reads a CSV file of deflections along the bat, with straight lines between its rows. For
//! [`crate::motion::ringing::Ringing::release`].

use std::path::Path;

use crate::base::{Complaint, Quantity, Result, mistakes};
use crate::files::csv_file::Csv;
use crate::files::document::Document;
use crate::motion::shape::InitialShape;

/// Reads columns `x_…` and `w_…` (units in the header) that cover a bat of that length (m).
///
/// # Errors
///
/// [`crate::base::error::Error::Read`] or [`crate::base::error::Error::Input`] with the line.
pub fn read(path: &Path, length: f64) -> Result<InitialShape> {
    let document = Document::table(path)?;
    let csv = Csv::read(&document, &["x", "w"], Quantity::Length, 1.0)?;
    let error = |row: usize, found: String, expected: &str| -> Result<()> {
        Err(csv.error(&document, "x", Some(row), Complaint::new("x", found, expected)))
    };
    let (Some(x), Some(w)) = (csv.column("x"), csv.column("w")) else {
        let expected = "columns x and w, such as x_m,w_mm";
        let complaint = Complaint::new("header", "a column missing", expected);
        return Err(csv.error(&document, "", None, complaint));
    };
    if x.len() < 2 {
        error(0, format!("{} row(s)", x.len()), "two at least")?;
    }
    let falling = (1..x.len()).filter(|k| x[*k] <= x[k - 1]);
    mistakes::all(falling.map(|k| error(k, format!("{} m", x[k]), "rising places")))?;
    if x[0].abs() > 1e-9 * length || (x[x.len() - 1] - length).abs() > 1e-9 * length {
        let found = format!("{} to {} m", x[0], x[x.len() - 1]);
        error(0, found, &format!("the whole bat, 0 to {length} m"))?;
    }
    Ok(InitialShape { x: x.to_vec(), w: w.to_vec() })
}
