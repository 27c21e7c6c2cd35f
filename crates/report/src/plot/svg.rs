//! Lines, areas and words, kept as a list of shapes and written as plain SVG.
//!
//! Data flow one way: drawing makes shapes, which become text here and pixels in `png`. Coordinates are pixels from the
//! upper left, written to a tenth. A picture needs no other file and no font, and has no names that could conflict with
//! those of another picture in the same page.

use std::fmt::Write;

use crate::plot::route::{Point, px, route};
use crate::plot::sheet::{Paper, Sheet};
use crate::plot::theme::{self, Ink, PAPER};
use crate::plot::words::{Anchor, Type};
use sweetspot::base::xml::escaped;

/// The beginning of the file of every picture, by which it can be recognised.
pub const BEGINNING: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"ss\"";

/// The typeface of the PNG, if the reader has it, and similar ones otherwise, with the size adjusted so that the small
/// letters are as high as in the first.
const FAMILY: &str = "'Ubuntu Light', Ubuntu, 'Noto Sans', 'Segoe UI', system-ui, sans-serif";

/// Height of that typeface's small letters, of its size: `sxHeight` of its table "OS/2".
const X_HEIGHT: f64 = 0.517;

/// A picture in the making.
#[derive(Debug, Clone, PartialEq)]
pub struct Svg {
    /// Width of the paper (px).
    pub width: f64,
    /// Height of the paper (px).
    pub height: f64,
    /// Left, upper, right and lower edge (px) of the frame in which places along the bat can be read
    /// off, from the first place to the last, for a page that does so.
    pub read_off: Option<[f64; 4]>,
    /// Its units and its room.
    pub sheet: Sheet,
    /// Facts beside the title: see [`super::plane::head`].
    pub facts: String,
    shapes: Vec<Shape>,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Colour of the line.
    pub ink: Ink,
    /// Width of the line (px).
    pub width: f64,
    /// Strokes and gaps (px); "" draws a whole line.
    pub dash: &'static str,
}

impl Pen {
    /// A pen of that width (pixels).
    pub const fn new(ink: Ink, width: f64) -> Self {
        Self { ink, width, dash: "" }
    }

    /// The pen of the k-th curve.
    pub fn of(k: usize) -> Self {
        let (ink, dash) = theme::series(k);
        Self { ink, width: 2.0, dash }
    }

    /// This pen with dashes, in the notation of SVG.
    pub const fn dashed(self, dash: &'static str) -> Self {
        Self { dash, ..self }
    }
}

/// How a shape is filled and drawn around.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Colour and opacity of the interior, from 0 to 1; unfilled if none.
    pub fill: Option<(Ink, f64)>,
    /// Pen of the edge, if any.
    pub pen: Option<Pen>,
}

/// A drawn shape. Later shapes cover earlier ones.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Words.
    Words {
        /// The beginning, middle or end of the base line, according to the type.
        at: Point,
        /// Type of the words.
        look: Type,
        /// The words.
        words: String,
    },
    /// A line through points.
    Line {
        /// The points in order, two and more.
        points: Vec<Point>,
        /// Pen of the line.
        pen: Pen,
    },
    /// An outline that closes itself.
    Area {
        /// Its corners in order, three and more.
        outline: Vec<Point>,
        /// Fill and edge.
        look: Look,
    },
    /// A level rectangle.
    Rect {
        /// Its upper left corner.
        corner: Point,
        /// Its width and its height (px).
        sides: [f64; 2],
        /// Fill and edge.
        look: Look,
    },
    /// A circle.
    Circle {
        /// Its middle.
        middle: Point,
        /// Its radius (px).
        radius: f64,
        /// Fill and edge.
        look: Look,
    },
    /// Words that show where a pointer rests; they are not printed.
    Hover(Vec<(Point, String)>),
}

/// Marks of different forms, in the order of use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Round.
    Circle,
    /// Four sides, level.
    Square,
    /// A corner upwards.
    Triangle,
    /// Four sides on a corner.
    Diamond,
    /// Two strokes.
    Cross,
    /// A corner downwards.
    Wedge,
}

/// One for each of six bats.
pub const MARKS: [Mark; 6] =
    [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond, Mark::Cross, Mark::Wedge];

impl Svg {
    /// Empty paper of the given size, for a file.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, ..Self::on(Sheet::file(false)) }
    }

    /// Empty paper as wide as that sheet, its height still open.
    pub fn on(sheet: Sheet) -> Self {
        let (width, height, facts) = (sheet.width(), 0.0, String::new());
        Self { width, height, read_off: None, sheet, facts, shapes: vec![] }
    }

    /// The shapes drawn so far, in order.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// Width and height of the paper in whole pixels.
    pub fn sides(&self) -> [f64; 2] {
        [self.width, self.height].map(f64::ceil)
    }

    /// The picture with its title and a description for readers who cannot see it.
    pub fn finish(&self, title: &str, description: &str) -> String {
        let [width, height] = self.sides().map(px);
        let edges = |edges: [f64; 4]| format!(" data-frame=\"{}\"", edges.map(px).join(" "));
        let read_off = self.read_off.map_or(String::new(), edges);
        let body: String = self.shapes.iter().map(written).collect();
        format!(
            "{BEGINNING} role=\"img\" \
             viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"{FAMILY}\" font-size-adjust=\"{X_HEIGHT}\" fill=\"none\" stroke-linejoin=\"round\" \
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
    pub fn text(&mut self, at: Point, look: Type, words: &str) {
        self.shapes.push(Shape::Words { at, look, words: words.into() });
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point], pen: Pen) {
        if points.len() > 1 {
            self.shapes.push(Shape::Line { points: points.into(), pen });
        }
    }

    /// A closed outline, filled with that opacity and stroked if there is a pen.
    pub fn area(&mut self, outline: &[Point], ink: Ink, opacity: f64, pen: Option<Pen>) {
        if outline.len() > 2 {
            let look = Look { fill: Some((ink, opacity)), pen };
            self.shapes.push(Shape::Area { outline: outline.into(), look });
        }
    }

    /// A rectangle from its upper left to its lower right.
    pub fn rect(&mut self, [from, to]: [Point; 2], ink: Ink, opacity: f64, pen: Option<Pen>) {
        let sides = [to[0] - from[0], to[1] - from[1]];
        let look = Look { fill: Some((ink, opacity)), pen };
        self.shapes.push(Shape::Rect { corner: from, sides, look });
    }

    /// A mark of that half width (px): paper within, or filled.
    pub fn mark(&mut self, mark: Mark, [x, y]: Point, half: f64, ink: Ink, solid: bool) {
        let inner = if solid { ink } else { PAPER };
        let look = Look { fill: Some((inner, 1.0)), pen: Some(Pen::new(ink, 1.8)) };
        let corners: &[Point] = match mark {
            Mark::Circle => {
                self.shapes.push(Shape::Circle { middle: [x, y], radius: half, look });
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
        let outline = corners.iter().map(|[a, b]| [x + a * half, y + b * half]).collect();
        self.shapes.push(Shape::Area { outline, look });
    }

    /// A circle that leaves visible what is under it.
    pub fn ring(&mut self, at: Point, radius: f64, pen: Pen) {
        let look = Look { fill: None, pen: Some(pen) };
        self.shapes.push(Shape::Circle { middle: at, radius, look });
    }

    /// Tooltips at the given number of points at most. Only files have them, because a page reads pictures off with a
    /// movable line.
    pub fn hover(&mut self, points: &[(Point, String)], most: usize) {
        if !points.is_empty() && self.sheet.paper == Paper::File {
            let every = points.len().div_ceil(most.max(1));
            self.shapes.push(Shape::Hover(points.iter().step_by(every).cloned().collect()));
        }
    }
}

/// A shape as a line of SVG, or several.
fn written(shape: &Shape) -> String {
    match shape {
        Shape::Words { at, look, words } => text(*at, *look, words),
        Shape::Line { points, pen } => {
            let look = Look { fill: None, pen: Some(*pen) };
            format!("<path d=\"{}\"{}/>\n", route(points), attributes(look))
        }
        Shape::Area { outline, look } => {
            format!("<path d=\"{}Z\"{}/>\n", route(outline), attributes(*look))
        }
        Shape::Rect { corner: [x, y], sides: [wide, high], look } => {
            let [x, y, wide, high] = [*x, *y, *wide, *high].map(px);
            let look = attributes(*look);
            format!("<rect x=\"{x}\" y=\"{y}\" width=\"{wide}\" height=\"{high}\"{look}/>\n")
        }
        Shape::Circle { middle: [x, y], radius, look } => {
            let [x, y, radius] = [*x, *y, *radius].map(px);
            format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{}/>\n", attributes(*look))
        }
        Shape::Hover(points) => hover(points),
    }
}

fn text([x, y]: Point, look: Type, words: &str) -> String {
    let Type { ink, size, bold, anchor, upwards } = look;
    let anchor = match anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let weight = if bold { " font-weight=\"600\"" } else { "" };
    let [x, y, size] = [x, y, size].map(px);
    let turn = if upwards { format!(" transform=\"rotate(-90 {x} {y})\"") } else { "".into() };
    let fill = attributes(Look { fill: Some((ink, 1.0)), pen: None });
    let words = escaped(words);
    format!(
        "<text x=\"{x}\" y=\"{y}\"{anchor}{turn} font-size=\"{size}\"{weight}{fill}>{words}</text>\n"
    )
}

fn hover(points: &[(Point, String)]) -> String {
    let mut out = String::from("<g class=\"ss-hover\" fill=\"#000\" fill-opacity=\"0\">\n");
    for ([x, y], words) in points {
        let [x, y] = [*x, *y].map(px);
        let words = escaped(words);
        let _ =
            writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"7\"><title>{words}</title></circle>");
    }
    out + "</g>\n"
}

/// Classes for dark paper, colours for light.
fn attributes(look: Look) -> String {
    let (mut classes, mut colours) = (vec![], String::new());
    if let Some((ink, opacity)) = look.fill {
        classes.push(format!("ss-f-{}", ink.name));
        let _ = write!(colours, " fill=\"{}\"", ink.light);
        if opacity < 1.0 {
            let _ = write!(colours, " fill-opacity=\"{opacity}\"");
        }
    }
    if let Some(Pen { ink, width, dash }) = look.pen {
        classes.push(format!("ss-s-{}", ink.name));
        let _ = write!(colours, " stroke=\"{}\" stroke-width=\"{}\"", ink.light, px(width));
        if !dash.is_empty() {
            let _ = write!(colours, " stroke-dasharray=\"{dash}\"");
        }
    }
    format!(" class=\"{}\"{colours}", classes.join(" "))
}
