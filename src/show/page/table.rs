//! A table, as a page and as Markdown.

use std::fmt::Write;

use crate::show::page::escape;

/// What it shows, its columns, its rows; the first column names the rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    /// What it shows, as a line above it.
    pub caption: String,
    /// The columns' names, with units where they have one.
    pub head: Vec<String>,
    /// As many cells each as the head has.
    pub rows: Vec<Vec<String>>,
    /// Whether the other columns are words, not numbers.
    pub words: bool,
}

impl Table {
    /// A table without rows.
    pub fn new(caption: impl Into<String>, head: &[&str]) -> Self {
        let head = head.iter().map(|cell| (*cell).to_owned()).collect();
        Self { caption: caption.into(), head, ..Self::default() }
    }

    /// A table without rows whose columns hold words.
    pub fn of_words(caption: impl Into<String>, head: &[&str]) -> Self {
        Self { words: true, ..Self::new(caption, head) }
    }

    /// One more row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// For a page: it scrolls by itself where it is too wide, by keyboard too. Nothing without rows.
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
        for cell in &self.head {
            let _ = write!(out, "<th scope=\"col\">{}</th>", escape::html(cell));
        }
        out += "</tr></thead>\n<tbody>\n";
        for row in &self.rows {
            out += "<tr>";
            for (k, cell) in row.iter().enumerate() {
                let (tag, scope) = if k == 0 { ("th", " scope=\"row\"") } else { ("td", "") };
                let _ = write!(out, "<{tag}{scope}>{}</{tag}>", escape::html(cell));
            }
            out += "</tr>\n";
        }
        out + "</tbody>\n</table>\n</div>\n"
    }

    /// For Markdown; nothing without rows.
    pub fn markdown(&self) -> String {
        if self.rows.is_empty() {
            return String::new();
        }
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| escape::markdown(cell)).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule: Vec<&str> = (0..self.head.len())
            .map(|k| if k == 0 || self.words { "---" } else { "---:" })
            .collect();
        let mut out = format!("{}:\n\n", escape::markdown(&self.caption));
        out += &line(&self.head);
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
