//! Tables for the terminal. Every column defines its width, its alignment and its head once.

/// Columns of a screen.
pub const WIDE: usize = 80;

/// A column of a table.
#[derive(Clone)]
pub struct TextColumn {
    head: String,
    width: usize,
    gap: &'static str,
    left: bool,
}

/// Words, as wide as that, after two spaces.
pub fn labels(width: usize, head: impl Into<String>) -> TextColumn {
    TextColumn { gap: "  ", ..first(width, head) }
}

/// Words at the beginning of the line.
pub fn first(width: usize, head: impl Into<String>) -> TextColumn {
    TextColumn { head: head.into(), width, gap: "", left: true }
}

/// Numbers, as wide as that with the space before them.
pub fn numbers(width: usize, head: impl Into<String>) -> TextColumn {
    TextColumn { left: false, ..first(width, head) }
}

/// A column, and its text for a row.
pub type Shown<'a, T> = (TextColumn, &'a dyn Fn(&T) -> String);

/// The line of the heads, and a line for every row.
pub fn table<'r, T: 'r>(rows: impl IntoIterator<Item = &'r T>, columns: &[Shown<T>]) -> String {
    let layout = Columns::new(columns.iter().map(|(column, _)| column.clone()));
    let line = |row: &T| layout.row(columns.iter().map(|(_, of)| of(row)));
    layout.heads() + &rows.into_iter().map(line).collect::<String>()
}

/// The columns of a table, from left to right.
pub struct Columns(Vec<TextColumn>);

impl Columns {
    /// A table of these columns.
    pub fn new(columns: impl IntoIterator<Item = TextColumn>) -> Self {
        Self(columns.into_iter().collect())
    }

    /// The line above the rows.
    pub fn heads(&self) -> String {
        self.row(self.0.iter().map(|column| &column.head))
    }

    /// One line, without blanks at its end. A cell that is too wide uses the blanks after it; a line of more than 80
    /// columns uses all that can be spared.
    pub fn row<S: AsRef<str>>(&self, cells: impl IntoIterator<Item = S>) -> String {
        let (mut line, mut end) = (String::new(), 0);
        for (TextColumn { width, gap, left, .. }, cell) in self.0.iter().zip(cells) {
            let (from, cell) = (end + gap.len(), cell.as_ref());
            end = from + width;
            let spare = if *left { 0 } else { width.saturating_sub(cell.chars().count()) };
            // Two numbers do not touch, even where one is too wide.
            let apart = usize::from(!left && !line.is_empty() && !line.ends_with(' '));
            let blanks =
                (from + spare).saturating_sub(line.chars().count()).max(gap.len()).max(apart);
            line += &format!("{:blanks$}{cell}", "");
        }
        line.truncate(line.trim_end().len());
        while let Some(at) = line.rfind("  ").filter(|_| line.chars().count() > WIDE) {
            line.remove(at);
        }
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
        assert_eq!(columns.row(["willow", "174", "met"]), "willow 174  met\n");
    }

    #[test]
    fn a_row_of_more_than_80_columns_spares_its_blanks() {
        let columns = Columns::new([first(40, ""), numbers(30, ""), numbers(10, "")]);
        let row = columns.row(["  name", "174.5", "+0.02295 kg m²"]);
        assert_eq!(row, format!("  name{:54}174.5 +0.02295 kg m²\n", ""));
        assert_eq!(row.trim_end().chars().count(), WIDE);
    }
}
