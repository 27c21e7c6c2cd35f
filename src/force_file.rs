//! What force in time did somebody write down?
//!
//! [`read`] a CSV file: straight lines between its rows, nothing before and after; for
//! [`crate::ringing::Ringing::pushed`].

use std::path::Path;

use crate::csv_file::Csv;
use crate::document::Document;
use crate::error::{Complaint, Result};
use crate::mistakes;
use crate::units::Quantity;

/// Forces (N) at rising times (s).
#[derive(Debug, Clone, PartialEq)]
pub struct ForceHistory {
    /// Times (s).
    pub t: Vec<f64>,
    /// Forces (N).
    pub force: Vec<f64>,
}

impl ForceHistory {
    /// The straight stretches up to a time: how long each lasts (s), and the force at its ends (N);
    /// the pauses before and after are stretches without force.
    pub fn until(&self, t: f64) -> Vec<(f64, [f64; 2])> {
        let mut stretches = vec![(self.t[0].min(t), [0.0; 2])];
        for k in 1..self.t.len() {
            let (from, to) = (self.t[k - 1], self.t[k]);
            if t <= from {
                break;
            }
            let force = [self.force[k - 1], self.force[k]];
            if t >= to {
                stretches.push((to - from, force));
            } else {
                let part = (t - from) / (to - from);
                stretches.push((t - from, [force[0], force[0] + part * (force[1] - force[0])]));
            }
        }
        stretches.push((t - self.t[self.t.len() - 1], [0.0; 2]));
        stretches.retain(|(length, _)| *length > 0.0);
        stretches
    }
}

/// Reads columns `t_…` and `force_…`, units in the header, times from 0 on.
///
/// # Errors
///
/// [`crate::error::Error::Read`] or [`crate::error::Error::Input`] with the line.
pub fn read(path: &Path) -> Result<ForceHistory> {
    const MOST: f64 = 1e9;
    let document = Document::read(path)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_history_is_cut_where_it_is_asked() {
        let history = ForceHistory { t: vec![0.5, 1.0, 2.0], force: vec![4.0, 0.0, 8.0] };
        assert_eq!(history.until(0.25), [(0.25, [0.0; 2])]);
        assert_eq!(history.until(0.75), [(0.5, [0.0; 2]), (0.25, [4.0, 2.0])]);
        let all = [(0.5, [0.0; 2]), (0.5, [4.0, 0.0]), (1.0, [0.0, 8.0])];
        assert_eq!(history.until(2.0), all);
        assert_eq!(history.until(3.0)[..3], all);
        assert_eq!(history.until(3.0)[3], (1.0, [0.0; 2]));
        assert_eq!(history.until(0.0), []);
    }
}
