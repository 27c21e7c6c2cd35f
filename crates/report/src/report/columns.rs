//! Tables for the terminal: every column says once how wide it is, on which side its cells stand, and
//! what its head is.

/// A column of a table.
pub struct Column {
    head: String,
    width: usize,
    gap: &'static str,
    left: bool,
}

/// Words, as wide as that, after two spaces.
pub fn labels(width: usize, head: impl Into<String>) -> Column {
    Column { gap: "  ", ..first(width, head) }
}

/// Words at the beginning of the line.
pub fn first(width: usize, head: impl Into<String>) -> Column {
    Column { head: head.into(), width, gap: "", left: true }
}

/// Numbers, as wide as that with the space before them.
pub fn numbers(width: usize, head: impl Into<String>) -> Column {
    Column { left: false, ..first(width, head) }
}

/// The columns of a table, from left to right.
pub struct Columns(Vec<Column>);

impl Columns {
    /// A table of these columns.
    pub fn new(columns: impl IntoIterator<Item = Column>) -> Self {
        Self(columns.into_iter().collect())
    }

    /// The line above the rows.
    pub fn heads(&self) -> String {
        self.row(self.0.iter().map(|column| &column.head))
    }

    /// One line, without blanks at its end.
    pub fn row<S: AsRef<str>>(&self, cells: impl IntoIterator<Item = S>) -> String {
        let mut line = String::new();
        for (Column { width, gap, left, .. }, cell) in self.0.iter().zip(cells) {
            let cell = cell.as_ref();
            line += gap;
            // Two numbers do not touch, even where one is too wide.
            let touches = !left && cell.chars().count() >= *width && !line.ends_with(' ');
            line += if touches && !line.is_empty() { " " } else { "" };
            line += &if *left { format!("{cell:<width$}") } else { format!("{cell:>width$}") };
        }
        line.truncate(line.trim_end().len());
        line + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_begin_and_numbers_end_where_their_heads_do() {
        let columns = Columns::new([first(4, "bat"), numbers(6, "Hz"), labels(5, "why")]);
        assert_eq!(columns.heads(), "bat     Hz  why\n");
        assert_eq!(columns.row(["ash", "174.5", "met"]), "ash  174.5  met\n");
        assert_eq!(columns.row(["ash", "", ""]), "ash\n");
        assert_eq!(columns.row(["willow", "174.512", "met"]), "willow 174.512  met\n");
    }
}
