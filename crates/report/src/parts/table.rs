//! A table: each column defines once how it extracts its cell from a row, for every format.

use std::fmt::Write;

use crate::parts::cell::{Cell, Quantity};
use crate::parts::escape;
use crate::parts::typeset::typeset;
use crate::parts::units::Units;

/// A column of a table whose rows are of type `T`.
#[derive(Debug, Clone, Copy)]
pub struct Column<T> {
    /// Its head for people; empty for a column of files only.
    head: &'static str,
    /// Its name in files, which ends in its unit; empty for a column that is not in files.
    name: &'static str,
    quantity: Quantity,
    /// Whether it appears in both systems of units where both are shown.
    both: bool,
    of: fn(&T) -> Cell,
}

impl<T> Column<T> {
    /// A column for screens and files.
    pub const fn new(
        head: &'static str,
        name: &'static str,
        quantity: Quantity,
        of: fn(&T) -> Cell,
    ) -> Self {
        Self { head, name, quantity, both: false, of }
    }

    /// A column of files only.
    pub const fn in_files(name: &'static str, of: fn(&T) -> Cell) -> Self {
        Self::new("", name, Quantity::Ratio(0), of)
    }

    /// A column that appears in both systems of units where both are shown.
    pub const fn both(
        head: &'static str,
        name: &'static str,
        quantity: Quantity,
        of: fn(&T) -> Cell,
    ) -> Self {
        Self { both: true, ..Self::new(head, name, quantity, of) }
    }

    /// Its name in files, and its cell for a row.
    pub fn in_file(&self) -> (&'static str, fn(&T) -> Cell) {
        (self.name, self.of)
    }
}

/// A caption, columns and rows; the first column names the rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    /// The line above the table.
    pub caption: String,
    /// The columns' names, with units where they have one.
    pub head: Vec<String>,
    /// The units of the columns, where they are separate from the names.
    pub units: Vec<&'static str>,
    /// As many cells each as the head has.
    pub rows: Vec<Vec<String>>,
    /// Whether the other columns are words, not numbers.
    pub words: bool,
}

impl Table {
    /// A table of those rows in those units, for people, without columns that are empty in every row.
    pub fn of<T>(
        caption: impl Into<String>,
        columns: &[Column<T>],
        rows: &[T],
        units: Units,
    ) -> Self {
        let lines = vec![vec![]; rows.len()];
        let mut table = Self { caption: caption.into(), rows: lines, ..Self::default() };
        for column in columns.iter().filter(|column| !column.head.is_empty()) {
            let cells: Vec<Cell> = rows.iter().map(column.of).collect();
            if cells.iter().all(|cell| *cell == Cell::Empty) {
                continue;
            }
            for us in if column.both { units.pick(false, true) } else { vec![units.us_first()] } {
                table.head.push(column.head.to_owned());
                table.units.push(column.quantity.scale(us).name);
                let shown = cells.iter().map(|cell| column.quantity.shown(cell, us));
                table.rows.iter_mut().zip(shown).for_each(|(row, cell)| row.push(cell));
            }
        }
        table
    }

    /// A table without rows.
    pub fn new(caption: impl Into<String>, head: &[&str]) -> Self {
        let head = head.iter().map(|cell| (*cell).to_owned()).collect();
        Self { caption: caption.into(), head, ..Self::default() }
    }

    /// A table without rows, for columns of words.
    pub fn of_words(caption: impl Into<String>, head: &[&str]) -> Self {
        Self { words: true, ..Self::new(caption, head) }
    }

    /// One more row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// The columns' names with their units.
    fn heads(&self) -> Vec<String> {
        let unit = |k: usize| self.units.get(k).filter(|unit| !unit.is_empty());
        let named = |(k, head): (usize, &String)| match unit(k) {
            Some(unit) => format!("{head}, {unit}"),
            None => head.clone(),
        };
        self.head.iter().enumerate().map(named).collect()
    }

    /// For a page: the table scrolls separately if it is too wide, also by keyboard. Empty without rows.
    pub fn html(&self) -> String {
        if self.rows.is_empty() {
            return String::new();
        }
        let caption = escape::html(&self.caption);
        let short = self.rows.iter().all(|row| row[0].chars().count() < 8);
        let kind = match (self.words, short) {
            (true, _) => "words",
            (false, true) => "short",
            (false, false) => "numbers",
        };
        let mut out = format!(
            "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{caption}\">\n\
             <table class=\"{kind}\">\n<caption>{caption}</caption>\n<thead><tr>"
        );
        for cell in &self.heads() {
            let _ = write!(out, "<th scope=\"col\">{}</th>", escape::html(&typeset(cell)));
        }
        out += "</tr></thead>\n<tbody>\n";
        for row in &self.rows {
            out += "<tr>";
            for (k, cell) in row.iter().enumerate() {
                let (tag, scope) = if k == 0 { ("th", " scope=\"row\"") } else { ("td", "") };
                let _ = write!(out, "<{tag}{scope}>{}</{tag}>", escape::html(&typeset(cell)));
            }
            out += "</tr>\n";
        }
        out + "</tbody>\n</table>\n</div>\n"
    }

    /// As Markdown; empty without rows.
    pub fn markdown(&self) -> String {
        if self.rows.is_empty() {
            return String::new();
        }
        let line = |cells: &[String]| {
            let cells: Vec<String> =
                cells.iter().map(|cell| escape::markdown(&typeset(cell))).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule: Vec<&str> = (0..self.head.len())
            .map(|k| if k == 0 || self.words { "---" } else { "---:" })
            .collect();
        let mut out = format!("{}:\n\n", escape::markdown(&self.caption));
        out += &line(&self.heads());
        let _ = writeln!(out, "| {} |", rule.join(" | "));
        self.rows.iter().for_each(|row| out += &line(row));
        out.push('\n');
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_say_their_units_whatever_they_are_written_as() {
        let columns: [Column<[f64; 2]>; 3] = [
            Column::both("place", "x_m", Quantity::Length, |at| at[0].into()),
            Column::new("e_A", "e", Quantity::Ratio(2), |at| at[1].into()),
            Column::new("why", "", Quantity::Words, |_| Cell::Empty),
        ];
        let table = Table::of("t", &columns, &[[0.254, 0.125], [0.508, -0.5]], Units::Both);
        let told = table.markdown();
        assert!(told.contains("| place, cm | place, in | e\\_A |\n"), "{told}");
        assert!(told.contains("| 25.40 | 10.00 | 0.13 |") && told.contains("−0.50"), "{told}");
        assert!(table.html().contains(">place, in</th>"));
    }

    #[test]
    fn a_table_is_escaped_and_empty_without_rows() {
        let mut table = Table::new("a < b", &["what", "m"]);
        assert_eq!(table.html() + &table.markdown(), "");
        table.row(["<i>", "1|2"]);
        let page = table.html();
        assert!(page.contains("<th scope=\"row\">&lt;i&gt;</th><td>1|2</td>"), "{page}");
        let told = table.markdown();
        assert!(told.ends_with("| what | m |\n| --- | ---: |\n| \\<i\\> | 1\\|2 |\n\n"), "{told}");
    }
}
