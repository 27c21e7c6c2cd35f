//! The report as one HTML page that needs nothing beside it.

use std::fmt::Write;

use crate::show::page::content::{Part, Report, Section};
use crate::show::page::data::Data;
use crate::show::page::escape::{html as escaped, script};
use crate::show::page::inputs::Input;
use crate::show::page::players;
use crate::show::page::summary::{Fact, NO_HIT};
use crate::show::plot::picture::Picture;

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Nothing may be fetched from anywhere, whatever a bat is called.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; \
                      img-src data:; base-uri 'none'; form-action 'none'";

/// The whole page.
pub fn page(report: &Report) -> String {
    let sections = report.sections();
    let name = escaped(report.analysis.bat.name());
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <meta name=\"generator\" content=\"sweetspot {}\">\n\
         <title>{name}: what it does to a ball</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <a class=\"skip\" href=\"#main\">To the report</a>\n",
        env!("CARGO_PKG_VERSION")
    );
    out += &header(report);
    out += &contents(&sections);
    out += "<main id=\"main\">\n";
    out += &summary(report);
    for part in &sections {
        out += &section(report, part);
    }
    out += "</main>\n";
    let _ = writeln!(
        out,
        "<footer><p>sweetspot {}: computed, not certified.</p></footer>",
        env!("CARGO_PKG_VERSION")
    );
    let data = Data::new(report.analysis, &report.summary, &report.moments);
    let data = serde_json::to_string(&data).expect("numbers and words, all of which JSON can hold");
    let _ = write!(
        out,
        "<script type=\"application/json\" id=\"data\">{}</script>\n<script>\n{SCRIPT}</script>\n\
         </body>\n</html>\n",
        script(&data)
    );
    out
}

fn header(report: &Report) -> String {
    let bat = &report.analysis.bat;
    /// Longer ones are folded, so that the summary is near.
    const SHORT: usize = 200;
    let source = escaped(bat.source());
    let source = match bat.source().chars().count() {
        0 => String::new(),
        1..=SHORT => format!("<p class=\"source\">{source}</p>\n"),
        _ => format!(
            "<details class=\"source\">\n<summary>Where its numbers come from</summary>\n\
             <p>{source}</p>\n</details>\n"
        ),
    };
    format!(
        "<header>\n<p class=\"kind\">Bat report</p>\n<h1>{}</h1>\n{source}</header>\n",
        escaped(bat.name())
    )
}

/// Links to the sections.
fn contents(sections: &[Section]) -> String {
    let mut out = String::from(
        "<nav aria-label=\"Contents\"><ul>\n<li><a href=\"#summary\">Summary</a></li>\n",
    );
    for Section { id, title, .. } in sections {
        let _ = writeln!(out, "<li><a href=\"#{id}\">{}</a></li>", escaped(title));
    }
    out + "</ul></nav>\n"
}

/// The card with the numbers that are asked for first.
fn summary(report: &Report) -> String {
    let mut out = String::from(
        "<section id=\"summary\" aria-labelledby=\"summary-title\">\n<h2 id=\"summary-title\">Summary</h2>\n",
    );
    let headline = report.summary.headline();
    if headline.is_empty() {
        let _ = writeln!(out, "<p class=\"missing\">{}</p>", escaped(NO_HIT));
    } else {
        out += &facts("headline", report.us_first, &headline);
    }
    out += &facts("facts", report.us_first, &report.summary.facts());
    out + "</section>\n"
}

/// The numbers at the top, in the unit that was asked for and beside it in the other.
fn facts(class: &str, us_first: bool, facts: &[Fact]) -> String {
    let mut out = format!("<dl class=\"{class}\">\n");
    for Fact { key, label, values: [si, us], note } in facts {
        let [first, beside] = if us_first && !us.is_empty() { [us, si] } else { [si, us] };
        let beside = match beside.is_empty() {
            true => String::new(),
            false => format!("<span class=\"beside\">{}</span>", escaped(beside)),
        };
        let note = match note.is_empty() {
            true => String::new(),
            false => format!("<dd class=\"note\">{}</dd>", escaped(note)),
        };
        let _ = writeln!(
            out,
            "<div><dt>{}</dt><dd data-key=\"{key}\"><span class=\"first\">{}</span>{beside}</dd>{note}</div>",
            escaped(label),
            escaped(first)
        );
    }
    out + "</dl>\n"
}

fn section(report: &Report, section: &Section) -> String {
    let Section { id, title, parts } = section;
    let mut out = format!(
        "<section id=\"{id}\" aria-labelledby=\"{id}-title\">\n<h2 id=\"{id}-title\">{}</h2>\n",
        escaped(title)
    );
    for one in parts {
        out += &part(report, one);
    }
    out + "</section>\n"
}

fn part(report: &Report, one: &Part) -> String {
    match one {
        Part::Heading(title) => format!("<h3>{}</h3>\n", escaped(title)),
        Part::Text(text) => format!("<p>{}</p>\n", escaped(text)),
        Part::Missing(why) => format!("<p class=\"missing\">{}</p>\n", escaped(why)),
        Part::List(items) => list(items),
        Part::Table(table) => table.html(),
        Part::Picture(picture) => figure(picture, ["", ""]),
        Part::Hovered(picture) => figure(picture, [&players::hair_line(picture), players::READING]),
        Part::Command(command) => format!("<p>Made with <code>{}</code></p>\n", escaped(command)),
        Part::File(input) => file(input),
        Part::Folded(title, parts) => {
            let inner: String = parts.iter().map(|inner| part(report, inner)).collect();
            format!("<details>\n<summary>{}</summary>\n{inner}</details>\n", escaped(title))
        }
        Part::Modes => players::modes(report.analysis),
        Part::Moment => players::moment(&report.moments),
    }
}

fn list(items: &[String]) -> String {
    let items: Vec<String> =
        items.iter().map(|item| format!("<li>{}</li>\n", escaped(item))).collect();
    format!("<ul>\n{}</ul>\n", items.concat())
}

/// A picture with what belongs to it on its sheet and below.
fn figure(picture: &Picture, [within, below]: [&str; 2]) -> String {
    let Picture { name, title, svg, .. } = picture;
    let title = escaped(title);
    format!(
        "<figure id=\"plot-{name}\">\n<p class=\"swipe\" aria-hidden=\"true\">↔ Swipe sideways to see \
         all of it.</p>\n<div class=\"scroll plot\" tabindex=\"0\" role=\"region\" \
         aria-label=\"{title}\">\n<div class=\"sheet\">\n{svg}{within}</div>\n</div>\n{below}</figure>\n"
    )
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
