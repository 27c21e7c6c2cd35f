//! The report as Markdown, with its pictures in separate files.

use std::fmt::Write;

use crate::page::content::Report;
use crate::parts::escape::{fence, markdown as escaped, markdown_line};
use crate::parts::{Fact, Input, Part, Section, Table, Units, typeset};
use crate::plot::Picture;

/// Replaces a section in which everything moves or sounds.
const MOVES: &str = "What moves and sounds needs the page: write the report as HTML.\n\n";

/// The whole text; `pictures` is the folder of the pictures as seen from it.
pub fn text(report: &Report, pictures: &str) -> String {
    let bat = &report.analysis.bat;
    let mut out = format!("# {}\n\n", escaped(bat.name()));
    if !bat.source().is_empty() {
        let _ = writeln!(out, "Source: {}\n", escaped(bat.source()));
    }
    let units = Units::one(report.us);
    for Section { title, parts, .. } in report.sections(units) {
        let text: String = parts.iter().map(|one| part(report, one, pictures)).collect();
        let text = if text.is_empty() { MOVES } else { &text };
        let _ = write!(out, "## {title}\n\n{text}");
    }
    out
}

fn part(report: &Report, one: &Part, pictures: &str) -> String {
    match one {
        Part::Heading(title) => format!("### {title}\n\n"),
        Part::Text(text) => format!("{}\n\n", markdown_line(&typeset(text))),
        Part::Missing(why) => format!("{}\n\n", markdown_line(why)),
        Part::List(items) => {
            let items: Vec<String> =
                items.iter().map(|item| format!("- {}\n", markdown_line(&typeset(item)))).collect();
            format!("{}\n", items.concat())
        }
        Part::Facts(_, facts) => {
            let mut table =
                Table::of_words("Computed, not certified", &["What", "Value", "Remark"]);
            for Fact { label, value, note, .. } in facts {
                table.row([*label, value, note]);
            }
            table.markdown()
        }
        Part::Table(table) => table.markdown(),
        Part::Picture(name) | Part::Hovered(name) => image(report, name, pictures),
        Part::Command(command) => {
            let fence = fence(command);
            format!("Made with\n\n{fence}text\n{command}\n{fence}\n\n")
        }
        Part::File(input) => file(input),
        Part::Folded(title, parts) => {
            let inner: String = parts.iter().map(|inner| part(report, inner, pictures)).collect();
            format!("### {title}\n\n{inner}")
        }
        // Moving parts need a page.
        Part::Moving(_) => String::new(),
    }
}

fn image(report: &Report, name: &str, pictures: &str) -> String {
    let Some(figure) = report.figures.iter().find(|figure| figure.name == name) else {
        return String::new();
    };
    let Picture { title, alt, .. } = &figure.forms[0][usize::from(report.us)];
    // Signs that end a link's target are written as in an address.
    let folder: String = pictures.chars().map(address).collect();
    let title = escaped(title).replace('"', "\\\"");
    format!("![{}]({folder}/{name}.svg \"{title}\")\n\n", escaped(alt))
}

/// A character of a relative address.
fn address(c: char) -> String {
    if c.is_alphanumeric() || "-._~/".contains(c) {
        return c.to_string();
    }
    let mut bytes = [0; 4];
    c.encode_utf8(&mut bytes).bytes().map(|byte| format!("%{byte:02X}")).collect()
}

fn file(input: &Input) -> String {
    let (text, remark) = input.shown();
    let fence = fence(text);
    let remark = remark.map_or(String::new(), |remark| format!("{remark}\n\n"));
    format!("{}:\n\n{fence}text\n{}\n{fence}\n\n{remark}", escaped(&input.name), text.trim_end())
}
