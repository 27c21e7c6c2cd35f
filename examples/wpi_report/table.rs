//! Columns of numbers with names, from which a figure is drawn.

/// One figure or table of the report.
pub struct Table {
    pub name: &'static str,
    pub columns: Vec<String>,
    /// A NaN stands for "no value".
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    pub fn new(name: &'static str, columns: &str, rows: Vec<Vec<f64>>) -> Self {
        Self { name, columns: columns.split(',').map(String::from).collect(), rows }
    }

    /// A curve per column over `x`, which becomes the first one.
    pub fn of_curves(name: &'static str, columns: &str, x: &[f64], curves: &[Vec<f64>]) -> Self {
        let row =
            |(i, x): (usize, &f64)| [*x].into_iter().chain(curves.iter().map(|c| c[i])).collect();
        Self::new(name, columns, x.iter().enumerate().map(row).collect())
    }

    /// The values under `name`.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.columns.iter().position(|c| c == name);
        let at = at.unwrap_or_else(|| panic!("{} has no column {name}", self.name));
        self.rows.iter().map(|row| row[at]).collect()
    }

    /// Comma separated, one header line; no value is an empty cell.
    pub fn csv(&self) -> String {
        let cell = |v: &f64| {
            if v.is_nan() { String::new() } else { format!("{v:?}") }
        };
        let line = |row: &Vec<f64>| row.iter().map(cell).collect::<Vec<_>>().join(",") + "\n";
        self.columns.join(",") + "\n" + &self.rows.iter().map(line).collect::<String>()
    }
}

/// `cells + 1` even points from 0 to 1.
pub fn grid(cells: usize) -> Vec<f64> {
    (0..=cells).map(|i| i as f64 / cells as f64).collect()
}

/// `prefix1,prefix2,…` to `count`, for a header.
pub fn numbered(prefix: &str, count: usize) -> String {
    (1..=count).map(|n| format!(",{prefix}{n}")).collect()
}
