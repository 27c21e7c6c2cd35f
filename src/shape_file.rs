//! What initial shape did somebody write down?
//!
//! [`read`] a CSV file of deflections along the bat, straight lines between, for
//! [`crate::ringing::Ringing::release`].

use std::path::Path;

use crate::csv_file::Csv;
use crate::document::Document;
use crate::error::{Complaint, Result};
use crate::mistakes;
use crate::units::Quantity;

/// Deflections `w` (m) at rising places `x` (m).
#[derive(Debug, Clone, PartialEq)]
pub struct InitialShape {
    /// Places from the knob end (m).
    pub x: Vec<f64>,
    /// Deflections (m).
    pub w: Vec<f64>,
}

impl InitialShape {
    /// The deflection at `x`, linear between the rows and constant beyond them.
    pub fn at(&self, x: f64) -> f64 {
        let k = self.x.partition_point(|at| *at <= x);
        if k == 0 || k == self.x.len() {
            return self.w[k.saturating_sub(1)];
        }
        let s = (x - self.x[k - 1]) / (self.x[k] - self.x[k - 1]);
        (1.0 - s) * self.w[k - 1] + s * self.w[k]
    }

    /// The slope at `x`, at a row the mean of both sides.
    pub fn slope(&self, x: f64) -> f64 {
        let last = self.x.len() - 1;
        let of = |k: usize| (self.w[k] - self.w[k - 1]) / (self.x[k] - self.x[k - 1]);
        let right = self.x.partition_point(|at| *at <= x).clamp(1, last);
        let left = self.x.partition_point(|at| *at < x).clamp(1, last);
        0.5 * (of(left) + of(right))
    }
}

/// Reads columns `x_…` and `w_…` (units in the header) that span a bat of that length (m).
///
/// # Errors
///
/// [`crate::error::Error::Read`] or [`crate::error::Error::Input`] with the line.
pub fn read(path: &Path, length: f64) -> Result<InitialShape> {
    let document = Document::read(path)?;
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
