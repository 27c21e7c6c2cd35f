//! A picture as pixels, with its own [`font`](super::font), independent of the system.
//!
//! The same shapes as in SVG are painted on light paper, with coordinates to the same tenth. The font has the letters
//! of Latin, Greek and Cyrillic scripts; names of bats in other scripts leave gaps in the PNG but are complete in the
//! SVG. The font has one weight, so bold words get an outline.

use tiny_skia::{
    Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Shader, Stroke, StrokeDash,
    Transform,
};

use crate::plot::font::{Font, UNITS};
use crate::plot::route::{Point, bends, tenth};
use crate::plot::svg::{Look, Pen, Shape, Svg};
use crate::plot::theme::{Ink, PAPER};
use crate::plot::words::{Anchor, Type};

/// How much wider bold strokes are than the font's (its units).
const BOLDER: f32 = 36.0;

/// A drawing as PNG, on light paper, with the given number of pixels for each unit of the drawing.
pub fn png(drawing: &Svg, scale: f32) -> Vec<u8> {
    let sides = drawing.sides().map(|side| (side as f32 * scale).ceil().max(1.0) as u32);
    let pixels = Pixmap::new(sides[0], sides[1]).expect("our own pictures have a size");
    let mut painter =
        Painter { pixels, font: Font::new(), scale: Transform::from_scale(scale, scale) };
    painter.pixels.fill(colour(PAPER, 1.0));
    drawing.shapes().iter().for_each(|shape| painter.shape(shape));
    painter.pixels.encode_png().expect("pixels in memory are whole")
}

/// A colour on light paper.
fn colour(ink: Ink, opacity: f64) -> Color {
    let hex = ink.light.get(1..7).and_then(|hex| u32::from_str_radix(hex, 16).ok());
    // An invalid colour becomes black.
    let [_, red, green, blue] = hex.unwrap_or(0).to_be_bytes();
    Color::from_rgba8(red, green, blue, (255.0 * opacity.clamp(0.0, 1.0)).round() as u8)
}

/// The paint of a colour with that opacity.
fn paint(ink: Ink, opacity: f64) -> Paint<'static> {
    Paint { shader: Shader::SolidColor(colour(ink, opacity)), ..Paint::default() }
}

/// A path through points, back to the first if it is closed.
fn path(points: &[Point], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (k, point) in points.iter().enumerate() {
        let [x, y] = point.map(|side| tenth(side) as f32);
        if k == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

struct Painter {
    pixels: Pixmap,
    font: Font,
    /// From the drawing to the pixels.
    scale: Transform,
}

impl Painter {
    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Words { at, look, words } => self.words(*at, *look, words),
            Shape::Line { points, pen } => {
                self.drawn(path(&bends(points), false), Look { fill: None, pen: Some(*pen) });
            }
            Shape::Area { outline, look } => self.drawn(path(&bends(outline), true), *look),
            Shape::Rect { corner, sides: [wide, high], look } => {
                let [x, y] = corner.map(tenth);
                let [wide, high] = [*wide, *high].map(tenth);
                let corners = [[x, y], [x + wide, y], [x + wide, y + high], [x, y + high]];
                self.drawn(path(&corners, true), *look);
            }
            Shape::Circle { middle: [x, y], radius, look } => {
                let [x, y, radius] = [*x, *y, *radius].map(|side| tenth(side) as f32);
                self.drawn(PathBuilder::from_circle(x, y, radius), *look);
            }
            Shape::Hover(_) => {}
        }
    }

    /// Fills and strokes a path.
    fn drawn(&mut self, path: Option<Path>, look: Look) {
        let Some(path) = path else { return };
        if let Some((ink, opacity)) = look.fill {
            let paint = paint(ink, opacity);
            self.pixels.fill_path(&path, &paint, FillRule::Winding, self.scale, None);
        }
        if let Some(Pen { ink, width, dash }) = look.pen {
            let dash = dash.split(' ').filter_map(|length| length.parse().ok()).collect();
            let stroke = Stroke {
                width: tenth(width) as f32,
                line_join: LineJoin::Round,
                dash: StrokeDash::new(dash, 0.0),
                ..Stroke::default()
            };
            self.pixels.stroke_path(&path, &paint(ink, 1.0), &stroke, self.scale, None);
        }
    }

    /// Words on a base line.
    fn words(&mut self, at: Point, look: Type, words: &str) {
        let Type { ink, size, bold, anchor, upwards } = look;
        let bolder = if bold { BOLDER } else { 0.0 };
        let (path, width) = self.font.set(words, bolder);
        let Some(path) = path else { return };
        let before = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * width,
            Anchor::End => width,
        };
        let [x, y] = at.map(|side| tenth(side) as f32);
        let unit = tenth(size) as f32 / UNITS;
        let turn = if upwards { Transform::from_rotate(-90.0) } else { Transform::identity() };
        // Read from the last to the first: the font's units, turned and moved, as pixels.
        let place = self.scale.pre_translate(x, y).pre_concat(turn).pre_scale(unit, -unit);
        let place = place.pre_translate(-before, 0.0);
        self.pixels.fill_path(&path, &paint(ink, 1.0), FillRule::Winding, place, None);
        if bold {
            let stroke = Stroke { width: bolder, line_join: LineJoin::Round, ..Stroke::default() };
            self.pixels.stroke_path(&path, &paint(ink, 1.0), &stroke, place, None);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::words::{LABEL, TITLE, width};

    #[test]
    fn words_are_never_wider_than_room_is_left_for() {
        let font = Font::new();
        for c in (' '..='~').chain("µμ·×−–…°²éЖΩ".chars()) {
            for (look, apart) in [(LABEL, 0.0), (TITLE, BOLDER)] {
                let words = format!("x{c}x");
                let wide = f64::from(font.set(&words, apart).1 / UNITS) * look.size;
                assert!(wide <= width(&words, look), "{words}: {wide}");
            }
        }
    }
}
