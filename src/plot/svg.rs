//! Lines, areas and words as plain SVG.
//!
//! Coordinates are pixels from the upper left, written to a tenth. No picture needs a file beside
//! it, a font of its own or a name that another picture in the same page might have too.

use std::fmt::Write;

use crate::plot::theme::{self, Ink, MUTED, PAPER, TEXT};

/// A place in pixels.
pub type Point = [f64; 2];

/// A picture in the making.
#[derive(Debug, Clone)]
pub struct Svg {
    pub width: f64,
    pub height: f64,
    /// Left, upper, right and lower edge (px) of the frame in which places along the bat can be read
    /// off, from the first place to the last, for a page that does so.
    pub read_off: Option<[f64; 4]>,
    body: String,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    pub ink: Ink,
    pub width: f64,
    /// Strokes and gaps (px); "" for a whole line.
    pub dash: &'static str,
}

impl Pen {
    pub const fn new(ink: Ink, width: f64) -> Self {
        Self { ink, width, dash: "" }
    }

    /// The pen of the k-th curve.
    pub fn of(k: usize) -> Self {
        let (ink, dash) = theme::series(k);
        Self { ink, width: 2.0, dash }
    }

    pub const fn dashed(self, dash: &'static str) -> Self {
        Self { dash, ..self }
    }
}

/// Which end of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// How words look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Type {
    pub ink: Ink,
    /// px
    pub size: f64,
    pub bold: bool,
    pub anchor: Anchor,
    /// Turned to run upwards.
    pub upwards: bool,
}

/// Numbers at ticks, names of curves.
pub const LABEL: Type =
    Type { ink: TEXT, size: 12.5, bold: false, anchor: Anchor::Start, upwards: false };
/// What stands back.
pub const SMALL: Type = Type { ink: MUTED, ..LABEL };
/// The first line of a picture.
pub const TITLE: Type = Type { size: 20.0, bold: true, ..LABEL };

impl Type {
    pub const fn at(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    pub const fn ink(self, ink: Ink) -> Self {
        Self { ink, ..self }
    }

    pub const fn sized(self, size: f64) -> Self {
        Self { size, ..self }
    }
}

/// Marks that differ in form, in the order in which they are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
    Wedge,
}

pub const MARKS: [Mark; 6] =
    [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond, Mark::Cross, Mark::Wedge];

impl Svg {
    /// Empty paper.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, read_off: None, body: String::new() }
    }

    /// The picture with its title and, for those who cannot see it, what is to be seen.
    pub fn finish(self, title: &str, description: &str) -> String {
        let Self { width, height, read_off, body } = self;
        let [width, height] = [width, height].map(px);
        let read_off = read_off
            .map_or(String::new(), |edges| format!(" data-frame=\"{}\"", edges.map(px).join(" ")));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"ss\" role=\"img\" \
             viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"system-ui, sans-serif\" fill=\"none\" stroke-linejoin=\"round\" \
             stroke-linecap=\"butt\"{read_off}>\n<title>{}</title>\n<desc>{}</desc>\n<style>{}</style>\n\
             <rect class=\"ss-f-paper\" fill=\"{}\" width=\"{width}\" height=\"{height}\"/>\n\
             {body}</svg>\n",
            escaped(title),
            escaped(description),
            theme::rules(),
            PAPER.light,
        )
    }

    /// Words on a base line.
    pub fn text(&mut self, [x, y]: Point, look: Type, words: &str) {
        let Type { ink, size, bold, anchor, upwards } = look;
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let weight = if bold { " font-weight=\"600\"" } else { "" };
        let (x, y) = (px(x), px(y));
        let turn = if upwards { format!(" transform=\"rotate(-90 {x} {y})\"") } else { "".into() };
        let _ = writeln!(
            self.body,
            "<text x=\"{x}\" y=\"{y}\"{anchor}{turn} font-size=\"{}\"{weight}{}>{}</text>",
            px(size),
            fill(ink),
            escaped(words)
        );
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point], pen: Pen) {
        if points.len() > 1 {
            let _ = writeln!(self.body, "<path d=\"{}\"{}/>", route(points), stroke(pen));
        }
    }

    /// A closed outline that is filled, so opaque, and drawn around if there is a pen.
    pub fn area(&mut self, outline: &[Point], ink: Ink, opacity: f64, pen: Option<Pen>) {
        if outline.len() < 3 {
            return;
        }
        let _ =
            writeln!(self.body, "<path d=\"{}Z\"{}/>", route(outline), filled(ink, opacity, pen));
    }

    /// A rectangle from its upper left to its lower right.
    pub fn rect(&mut self, [from, to]: [Point; 2], ink: Ink, opacity: f64, pen: Option<Pen>) {
        let [x, y, w, h] = [from[0], from[1], to[0] - from[0], to[1] - from[1]].map(px);
        let _ = writeln!(
            self.body,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"{}/>",
            filled(ink, opacity, pen)
        );
    }

    /// A mark of that half width (px): paper within, or filled.
    pub fn mark(&mut self, mark: Mark, [x, y]: Point, half: f64, ink: Ink, solid: bool) {
        let inner = if solid { ink } else { PAPER };
        let look = filled(inner, 1.0, Some(Pen::new(ink, 1.8)));
        let shape: &[Point] = match mark {
            Mark::Circle => {
                let [x, y, half] = [x, y, half].map(px);
                let _ = writeln!(self.body, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{half}\"{look}/>");
                return;
            }
            Mark::Square => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
            Mark::Triangle => &[[-1.1, 0.9], [0.0, -1.1], [1.1, 0.9]],
            Mark::Diamond => &[[-1.2, 0.0], [0.0, -1.2], [1.2, 0.0], [0.0, 1.2]],
            Mark::Wedge => &[[-1.1, -0.9], [1.1, -0.9], [0.0, 1.1]],
            Mark::Cross => {
                let pen = Pen::new(ink, 2.2);
                let at = |a: f64, b: f64| [x + a * half, y + b * half];
                self.line(&[at(-1.0, -1.0), at(1.0, 1.0)], pen);
                self.line(&[at(-1.0, 1.0), at(1.0, -1.0)], pen);
                return;
            }
        };
        let shape: Vec<Point> = shape.iter().map(|[a, b]| [x + a * half, y + b * half]).collect();
        let _ = writeln!(self.body, "<path d=\"{}Z\"{look}/>", route(&shape));
    }

    /// A circle that shows what is under it.
    pub fn ring(&mut self, at: Point, radius: f64, pen: Pen) {
        let [x, y, radius] = [at[0], at[1], radius].map(px);
        let look = stroke(pen);
        let _ = writeln!(self.body, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{look}/>");
    }

    /// Words that show where a pointer rests, at so many of the points at most.
    pub fn hover(&mut self, points: &[(Point, String)], most: usize) {
        if points.is_empty() {
            return;
        }
        self.body += "<g class=\"ss-hover\" fill=\"#000\" fill-opacity=\"0\">\n";
        let every = points.len().div_ceil(most.max(1));
        for ([x, y], words) in points.iter().step_by(every) {
            let (x, y) = (px(*x), px(*y));
            let words = escaped(words);
            let _ = writeln!(
                self.body,
                "<circle cx=\"{x}\" cy=\"{y}\" r=\"7\"><title>{words}</title></circle>"
            );
        }
        self.body += "</g>\n";
    }
}

/// A path through points, without those that it passes by anyway.
fn route(points: &[Point]) -> String {
    let mut out = String::new();
    for (k, point) in bends(points).into_iter().enumerate() {
        let verb = if k == 0 { 'M' } else { 'L' };
        let [x, y] = point.map(px);
        let _ = write!(out, "{verb}{x} {y}");
    }
    out
}

/// The first point, the last one, and between them those without which a line would pass another by
/// more than can be seen.
fn bends(points: &[Point]) -> Vec<Point> {
    /// px
    const SEEN: f64 = 0.06;
    /// No more points than this are left out in a row.
    const MOST: usize = 60;
    let Some(first) = points.first() else { return vec![] };
    let (mut kept, mut from) = (vec![*first], 0);
    for to in 2..points.len() {
        let passed = |point: &Point| distance(*point, points[from], points[to]) <= SEEN;
        if to - from > MOST || !points[from + 1..to].iter().all(passed) {
            from = to - 1;
            kept.push(points[from]);
        }
    }
    kept.extend(points.last().filter(|_| points.len() > 1));
    kept
}

/// From a point to a stretch between two (px).
fn distance([x, y]: Point, [a, b]: Point, [c, d]: Point) -> f64 {
    let (along, up) = (c - a, d - b);
    let square = along * along + up * up;
    let share = if square > 0.0 { ((x - a) * along + (y - b) * up) / square } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    (x - a - share * along).hypot(y - b - share * up)
}

fn fill(ink: Ink) -> String {
    format!(" class=\"ss-f-{}\" fill=\"{}\"", ink.name, ink.light)
}

fn stroke(pen: Pen) -> String {
    format!(" class=\"ss-s-{}\"{}", pen.ink.name, line_of(pen))
}

fn line_of(pen: Pen) -> String {
    let dash = match pen.dash {
        "" => String::new(),
        dash => format!(" stroke-dasharray=\"{dash}\""),
    };
    format!(" stroke=\"{}\" stroke-width=\"{}\"{dash}", pen.ink.light, px(pen.width))
}

fn filled(ink: Ink, opacity: f64, pen: Option<Pen>) -> String {
    let faint = if opacity < 1.0 { format!(" fill-opacity=\"{opacity}\"") } else { "".into() };
    let (class, line) = match pen {
        Some(pen) => (format!(" ss-s-{}", pen.ink.name), line_of(pen)),
        None => Default::default(),
    };
    format!(" class=\"ss-f-{}{class}\" fill=\"{}\"{faint}{line}", ink.name, ink.light)
}

/// A coordinate to a tenth of a pixel, as short as it can be; what is none is at 0.
pub fn px(value: f64) -> String {
    if !value.is_finite() {
        return "0".into();
    }
    let rounded = (10.0 * value.clamp(-1e6, 1e6)).round() / 10.0;
    // Not −0.
    format!("{}", rounded + 0.0)
}

/// Words as XML has them, without characters that XML does not.
pub fn escaped(words: &str) -> String {
    let mut out = String::with_capacity(words.len());
    for c in words.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// How wide words are at most (px), in the widest of the usual sans-serif fonts.
pub fn width(words: &str, look: Type) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ' ' | '\'' | '|' | ':' | ';' | 'I' | '·' => 0.34,
        'f' | 't' | 'r' | '(' | ')' | '-' | '/' => 0.42,
        'm' | 'w' | 'M' | 'W' | '%' | '@' | '–' | '…' => 1.0,
        'A'..='Z' | '=' | '+' | '−' | '×' | '±' | '<' | '>' => 0.8,
        c if c.is_ascii() || c < '\u{2000}' => 0.64,
        _ => 1.0,
    };
    let bold = if look.bold { 1.12 } else { 1.0 };
    words.chars().map(em).sum::<f64>() * look.size * bold
}

/// Words cut so that they are no wider than that (px).
pub fn fitted(words: &str, look: Type, most: f64) -> String {
    if width(words, look) <= most {
        return words.to_owned();
    }
    let mut out = words.to_owned();
    while !out.is_empty() && width(&out, look) + width("…", look) > most {
        out.pop();
    }
    out.trim_end().to_owned() + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short_and_always_numbers() {
        let shown = [1.0, 0.25, -0.01, f64::NAN, f64::INFINITY, 12.34].map(px);
        assert_eq!(shown, ["1", "0.3", "0", "0", "0", "12.3"]);
        assert_eq!(route(&[[0.0, 0.0], [0.5, 1.0], [1.0, 2.0], [2.0, 0.0]]), "M0 0L1 2L2 0");
    }

    #[test]
    fn a_line_of_fewer_points_passes_all_of_them() {
        let wave: Vec<Point> =
            (0..500).map(|k| f64::from(k)).map(|x| [x, 40.0 * (0.05 * x).sin()]).collect();
        let kept = bends(&wave);
        assert!(kept.len() < 200, "{}", kept.len());
        for point in &wave {
            let near = kept.windows(2).map(|pair| distance(*point, pair[0], pair[1]));
            assert!(near.fold(f64::INFINITY, f64::min) <= 0.06);
        }
        // A line that turns back on itself keeps its turn.
        assert_eq!(bends(&[[0.0, 0.0], [9.0, 0.0], [4.0, 0.0]]).len(), 3);
        assert!(bends(&[]).is_empty());
        assert_eq!(bends(&[[1.0, 1.0]]).len(), 1);
    }

    #[test]
    fn words_are_escaped_and_cut() {
        assert_eq!(escaped("a<b & \u{1}\"c\""), "a&lt;b &amp;  &quot;c&quot;");
        let cut = fitted("a very long name of a bat", LABEL, 80.0);
        assert!(cut.ends_with('…') && width(&cut, LABEL) <= 80.0, "{cut}");
        assert_eq!(fitted("short", LABEL, 80.0), "short");
        assert_eq!(fitted("wide", LABEL, 0.0), "…");
    }
}
