//! The content of a page, in mm from its upper left corner; the page as SVG.

use std::fmt::Write;

use sweetspot::base::xml::escaped;

/// A size of paper, lying (mm).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// Name of the paper.
    pub name: &'static str,
    /// Width (mm).
    pub width: f64,
    /// Height (mm).
    pub height: f64,
}

/// A4 and the American letter, lying.
pub const PAPERS: [Paper; 2] = [
    Paper { name: "a4", width: 297.0, height: 210.0 },
    Paper { name: "letter", width: 279.4, height: 215.9 },
];

/// Something on a page.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawn {
    /// A line through points, that wide, in dashes of that length if not 0.
    Line {
        /// Points (mm).
        points: Vec<[f64; 2]>,
        /// Width (mm).
        width: f64,
        /// Length of a dash (mm), 0 for a solid line.
        dash: f64,
    },
    /// Words that begin at a place, letters so high.
    Words {
        /// Beginning of the base line (mm).
        at: [f64; 2],
        /// Height of the letters (mm).
        size: f64,
        /// The words.
        text: String,
    },
}

/// A page.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// Its paper.
    pub paper: Paper,
    /// The drawing.
    pub drawn: Vec<Drawn>,
}

impl Page {
    /// An empty page.
    pub fn new(paper: Paper) -> Self {
        Self { paper, drawn: vec![] }
    }

    /// A line.
    pub fn line(&mut self, points: Vec<[f64; 2]>, width: f64, dash: f64) {
        if points.len() > 1 {
            self.drawn.push(Drawn::Line { points, width, dash });
        }
    }

    /// Words.
    pub fn words(&mut self, at: [f64; 2], size: f64, text: impl Into<String>) {
        self.drawn.push(Drawn::Words { at, size, text: text.into() });
    }

    /// The page as an SVG file in full size.
    pub fn svg(&self) -> String {
        let Paper { width, height, .. } = self.paper;
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
             viewBox=\"0 0 {width} {height}\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
        );
        for drawn in &self.drawn {
            let _ = match drawn {
                Drawn::Line { points, width, dash } => {
                    let points: Vec<String> =
                        points.iter().map(|[x, y]| format!("{x:.3},{y:.3}")).collect();
                    let dash = match *dash > 0.0 {
                        true => format!(" stroke-dasharray=\"{dash} {dash}\""),
                        false => String::new(),
                    };
                    writeln!(
                        out,
                        "<polyline points=\"{}\" fill=\"none\" stroke=\"#000\" stroke-width=\"{width}\"{dash}/>",
                        points.join(" ")
                    )
                }
                Drawn::Words { at: [x, y], size, text } => writeln!(
                    out,
                    "<text x=\"{x:.3}\" y=\"{y:.3}\" font-size=\"{size}\" font-family=\"Helvetica, Arial, \
                     sans-serif\">{}</text>",
                    escaped(text)
                ),
            };
        }
        out + "</svg>\n"
    }
}
