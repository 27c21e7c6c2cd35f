//! One self-contained HTML page, whose sections exist in both systems of units.
//!
//! Content that is equal in both systems appears once. All other content appears twice, and a switch without any script
//! shows one of them.

use std::fmt::Write;

use crate::page::figure::Figure;
use crate::page::players;
use crate::parts::escape::{html as escaped, script};
use crate::parts::{Fact, Fold, Input, Part, Section, typeset};

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = concat!(include_str!("shared.js"), include_str!("script.js"));

/// The page fetches nothing, whatever the name of a bat contains.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; \
                      img-src data:; base-uri 'none'; form-action 'none'";

/// The content of a page.
#[derive(Debug, Clone)]
pub struct Page<'a> {
    /// What kind of page it is, above its name.
    pub kind: &'static str,
    /// Its name, and the text after it in the browser's title.
    pub name: [&'a str; 2],
    /// Where its numbers come from; may be empty.
    pub source: &'a str,
    /// Whether US units are shown first.
    pub us: bool,
    /// Its sections in SI and in US units, with the same parts in both.
    pub sections: [Vec<Section<'a>>; 2],
    /// The pictures that the parts name.
    pub figures: &'a [Figure],
    /// The data for its script, as JSON; `None` if nothing moves.
    pub data: Option<String>,
    /// The address of the same bat's live page beside it.
    pub lab: Option<&'a str>,
}

impl Page<'_> {
    /// The whole page.
    pub fn text(&self) -> String {
        let [name, about] = self.name.map(escaped);
        let mut out = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <meta name=\"generator\" content=\"sweetspot {0}\">\n\
             <title>{name}{about}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
             <a class=\"skip\" href=\"#main\">To the report</a>\n{1}<main id=\"main\">\n",
            env!("CARGO_PKG_VERSION"),
            self.header(),
        );
        let [si, us] = &self.sections;
        for (si, us) in si.iter().zip(us) {
            out += &self.section([si, us]);
        }
        let _ = writeln!(
            out,
            "</main>\n<footer><p>sweetspot {}: computed, not certified.</p></footer>",
            env!("CARGO_PKG_VERSION")
        );
        if let Some(data) = &self.data {
            let _ = write!(
                out,
                "<script type=\"application/json\" id=\"data\">{}</script>\n<script>\n{SCRIPT}</script>\n",
                script(data)
            );
        }
        out + "</body>\n</html>\n"
    }

    fn header(&self) -> String {
        let [kind, name] = [self.kind, self.name[0]].map(escaped);
        let source = match self.source {
            "" => String::new(),
            source => format!(
                "<details class=\"source screen\">\n<summary>Where its numbers come from</summary>\n\
                 <p>{}</p>\n</details>\n",
                escaped(source)
            ),
        };
        let open = "class=\"button screen\">Open in the lab</a>\n";
        let lab =
            self.lab.map(escaped).map_or_else(String::new, |f| format!("<a href=\"{f}\" {open}"));
        let labels = ["cm, m/s".to_owned(), "in, mph".to_owned()];
        let units = players::choice("units", "Units", &labels, usize::from(self.us));
        format!(
            "<header>\n<div><p class=\"kind\">{kind}</p>\n<h1>{name}</h1>\n{source}{lab}</div>\n{units}</header>\n"
        )
    }

    /// A section; a folded one opens by its heading.
    fn section(&self, [si, us]: [&Section; 2]) -> String {
        let Section { id, title, fold, .. } = si;
        let parts = si.parts.iter().zip(&us.parts);
        let parts: String = parts.map(|(si, us)| self.part([si, us])).collect();
        let heading = format!("<h2 id=\"{id}-title\">{}</h2>", escaped(title));
        let inner = match fold {
            Fold::Open => format!("{heading}\n{parts}"),
            Fold::Folded | Fold::ScreenOnly => {
                format!("<details>\n<summary>{heading}</summary>\n{parts}</details>\n")
            }
        };
        let class = match fold {
            Fold::Open => "",
            Fold::Folded => " class=\"folds\"",
            Fold::ScreenOnly => " class=\"folds screen\"",
        };
        format!("<section id=\"{id}\"{class} aria-labelledby=\"{id}-title\">\n{inner}</section>\n")
    }

    /// A part, once if it is equal in both systems.
    fn part(&self, both: [&Part; 2]) -> String {
        let [si, us] = both.map(|part| self.written(part));
        if si == us {
            si
        } else {
            format!("<div class=\"si\">\n{si}</div>\n<div class=\"us\">\n{us}</div>\n")
        }
    }

    fn written(&self, one: &Part) -> String {
        match one {
            Part::Heading(title) => format!("<h3>{}</h3>\n", escaped(title)),
            Part::Text(text) => format!("<p>{}</p>\n", escaped(&typeset(text))),
            Part::Missing(why) => format!("<p class=\"missing\">{}</p>\n", escaped(why)),
            Part::List(items) => list(items),
            Part::Facts(class, all) => facts(class, all),
            Part::Table(table) => table.html(),
            Part::Picture(name) => self.figures(name, ["", ""]),
            Part::Hovered(name) => {
                self.figures(name, [&players::hair_line(name), players::READING])
            }
            Part::Command(command) => {
                format!("<p>Made with <code>{}</code></p>\n", escaped(command))
            }
            Part::File(input) => file(input),
            Part::Folded(title, parts) => {
                let inner: String = parts.iter().map(|inner| self.written(inner)).collect();
                let title = escaped(title);
                format!("<details>\n<summary>{title}</summary>\n{inner}</details>\n")
            }
            Part::Moving(html) => html.clone(),
        }
    }

    fn figures(&self, name: &str, beside: [&str; 2]) -> String {
        let named = self.figures.iter().filter(|figure| figure.name == name);
        named.map(|figure| figure.html(beside)).collect()
    }
}

fn list(items: &[String]) -> String {
    let items: Vec<String> =
        items.iter().map(|item| format!("<li>{}</li>\n", escaped(&typeset(item)))).collect();
    format!("<ul>\n{}</ul>\n", items.concat())
}

fn facts(class: &str, facts: &[Fact]) -> String {
    let mut out = format!("<dl class=\"{class}\">\n");
    for Fact { key, label, value, note } in facts {
        let [label, value, note] = [*label, value, note].map(|text| escaped(&typeset(text)));
        let note = if note.is_empty() { note } else { format!("<dd class=\"note\">{note}</dd>") };
        let _ =
            writeln!(out, "<div><dt>{label}</dt><dd data-key=\"{key}\">{value}</dd>{note}</div>");
    }
    out + "</dl>\n"
}

fn file(input: &Input) -> String {
    let (text, remark) = input.shown();
    let remark = remark.map_or(String::new(), |remark| format!("<p>{remark}</p>\n"));
    let name = escaped(&input.name);
    format!(
        "<h3>{name}</h3>\n<pre tabindex=\"0\" aria-label=\"{name}\"><code>{}</code></pre>\n{remark}",
        escaped(text)
    )
}
