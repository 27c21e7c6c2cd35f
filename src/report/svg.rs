//! Curves and points as a picture: panels with axes, ticks and a legend, in plain SVG.
//!
//! The picture has a light background of its own, so that it reads on a dark page too, and asks for
//! no font but the viewer's sans-serif.

use std::fmt::Write;

/// What an axis says, from where to where it goes, and how far its ticks are apart.
#[derive(Debug, Clone)]
pub struct Axis {
    /// What stands beside it, with the unit.
    pub label: String,
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// From one tick to the next.
    pub tick: f64,
}

/// How the points of a series are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drawn {
    /// Joined by a line, dashed if so.
    Line {
        /// Whether it is dashed.
        dashed: bool,
    },
    /// As dots, with error bars of that half height if it is above zero.
    Dots {
        /// Half the height of the bars, in the unit of the axis.
        error: f64,
    },
}

/// Points in the units of the axes; what is outside of them is not drawn.
#[derive(Debug, Clone)]
pub struct Series {
    /// What the legend calls it.
    pub name: String,
    /// As SVG has it.
    pub color: &'static str,
    /// By a line or as dots.
    pub drawn: Drawn,
    /// x and y.
    pub points: Vec<[f64; 2]>,
}

/// One diagram.
#[derive(Debug, Clone)]
pub struct Panel {
    /// What stands above it.
    pub title: String,
    /// The axis below.
    pub x: Axis,
    /// The axis to the left.
    pub y: Axis,
    /// The curves and points.
    pub series: Vec<Series>,
}

/// Of a panel with its labels, and of the frame within it (pixels).
const SIZE: [f64; 2] = [520.0, 400.0];
const LEFT: f64 = 62.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 52.0;
const INK: &str = "#222222";

/// The panels side by side.
pub fn picture(panels: &[Panel]) -> String {
    let [width, height] = [SIZE[0] * panels.len() as f64, SIZE[1]];
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"13\" \
         fill=\"{INK}\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for (k, panel) in panels.iter().enumerate() {
        let _ = writeln!(out, "<g transform=\"translate({},0)\">", SIZE[0] * k as f64);
        draw(panel, &mut out);
        out += "</g>\n";
    }
    out + "</svg>\n"
}

fn draw(panel: &Panel, out: &mut String) {
    let Panel { x, y, .. } = panel;
    let (right, bottom) = (SIZE[0] - RIGHT, SIZE[1] - BOTTOM);
    text(out, [0.5 * (LEFT + right), 24.0], "middle", "font-size=\"15\"", &panel.title);
    for value in ticks(x) {
        let at = along(x, value, LEFT, right);
        line(out, [at, TOP], [at, bottom], "#dddddd");
        text(out, [at, bottom + 18.0], "middle", "", &shown(value, x.tick));
    }
    for value in ticks(y) {
        let at = along(y, value, bottom, TOP);
        line(out, [LEFT, at], [right, at], "#dddddd");
        text(out, [LEFT - 7.0, at + 4.5], "end", "", &shown(value, y.tick));
    }
    let (w, h) = (right - LEFT, bottom - TOP);
    let _ = writeln!(
        out,
        "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{w}\" height=\"{h}\" fill=\"none\" \
         stroke=\"{INK}\"/>"
    );
    text(out, [0.5 * (LEFT + right), SIZE[1] - 14.0], "middle", "", &x.label);
    let middle = 0.5 * (TOP + bottom);
    let turned = format!("transform=\"rotate(-90 18 {middle})\"");
    text(out, [18.0, middle], "middle", &turned, &y.label);
    let place = |[a, b]: [f64; 2]| [along(x, a, LEFT, right), along(y, b, bottom, TOP)];
    for series in &panel.series {
        let within =
            |[a, b]: &&[f64; 2]| (x.from..=x.to).contains(a) && (y.from..=y.to).contains(b);
        let points: Vec<[f64; 2]> =
            series.points.iter().filter(within).map(|p| place(*p)).collect();
        marks(series, &points, (bottom - TOP) / (y.to - y.from), out);
    }
    legend(&panel.series, bottom, out);
}

/// A series, its points in pixels and the pixels of a unit upwards.
fn marks(series: &Series, points: &[[f64; 2]], unit: f64, out: &mut String) {
    let color = series.color;
    match series.drawn {
        Drawn::Line { dashed } => {
            let listed: Vec<String> =
                points.iter().map(|[a, b]| format!("{a:.1},{b:.1}")).collect();
            let dash = if dashed { " stroke-dasharray=\"7 5\"" } else { "" };
            let _ = writeln!(
                out,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"{dash}/>",
                listed.join(" ")
            );
        }
        Drawn::Dots { error } => {
            for [a, b] in points {
                let reach = error * unit;
                if reach > 0.0 {
                    line(out, [*a, b - reach], [*a, b + reach], color);
                    for end in [b - reach, b + reach] {
                        line(out, [a - 3.0, end], [a + 3.0, end], color);
                    }
                }
                let _ = writeln!(
                    out,
                    "<circle cx=\"{a:.1}\" cy=\"{b:.1}\" r=\"4\" fill=\"#ffffff\" \
                     stroke=\"{color}\" stroke-width=\"2\"/>"
                );
            }
        }
    }
}

/// The names, at the bottom of the frame and off its corner, where curves of speeds along a bat leave
/// room.
fn legend(series: &[Series], bottom: f64, out: &mut String) {
    const LINE: f64 = 19.0;
    const FIRST: f64 = LEFT + 90.0;
    let first = bottom - 12.0 - LINE * (series.len().max(1) - 1) as f64;
    for (k, series) in series.iter().enumerate() {
        let at = first + LINE * k as f64;
        let sample: [[f64; 2]; 2] = [[FIRST, at - 4.5], [FIRST + 30.0, at - 4.5]];
        match series.drawn {
            Drawn::Line { .. } => marks(series, &sample, 0.0, out),
            Drawn::Dots { .. } => marks(series, &[[FIRST + 15.0, at - 4.5]], 0.0, out),
        }
        text(out, [FIRST + 38.0, at], "start", "", &series.name);
    }
}

/// The values at the ticks.
fn ticks(axis: &Axis) -> impl Iterator<Item = f64> {
    let count = ((axis.to - axis.from) / axis.tick + 1e-9).floor().max(0.0) as usize;
    (0..=count).map(|k| axis.from + axis.tick * k as f64)
}

/// A tick's number, with as many decimals as the ticks have.
fn shown(value: f64, tick: f64) -> String {
    let decimals = (-(tick + 1e-12).log10().floor()).max(0.0) as usize;
    format!("{value:.decimals$}")
}

fn along(axis: &Axis, value: f64, from: f64, to: f64) -> f64 {
    from + (to - from) * (value - axis.from) / (axis.to - axis.from)
}

fn line(out: &mut String, [a, b]: [f64; 2], [c, d]: [f64; 2], color: &str) {
    let _ = writeln!(
        out,
        "<line x1=\"{a:.1}\" y1=\"{b:.1}\" x2=\"{c:.1}\" y2=\"{d:.1}\" stroke=\"{color}\"/>"
    );
}

fn text(out: &mut String, [a, b]: [f64; 2], anchor: &str, more: &str, words: &str) {
    let words = words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let space = if more.is_empty() { "" } else { " " };
    let _ = writeln!(
        out,
        "<text x=\"{a:.1}\" y=\"{b:.1}\" text-anchor=\"{anchor}\"{space}{more}>{words}</text>"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel() -> Panel {
        let axis = |label: &str, to, tick| Axis { label: label.into(), from: 0.0, to, tick };
        let series = |drawn, points: &[[f64; 2]]| Series {
            name: "a < b".into(),
            color: "#0055aa",
            drawn,
            points: points.to_vec(),
        };
        Panel {
            title: "one & two".into(),
            x: axis("x (cm)", 10.0, 5.0),
            y: axis("y (m/s)", 0.4, 0.1),
            series: vec![
                series(Drawn::Line { dashed: true }, &[[0.0, 0.0], [10.0, 0.4]]),
                series(Drawn::Dots { error: 0.1 }, &[[5.0, 0.2], [11.0, 0.2]]),
            ],
        }
    }

    #[test]
    fn the_ends_of_the_axes_are_the_corners_of_the_frame() {
        let picture = picture(&[panel()]);
        let (right, bottom) = (SIZE[0] - RIGHT, SIZE[1] - BOTTOM);
        let whole = format!("points=\"{LEFT:.1},{bottom:.1} {right:.1},{TOP:.1}\"");
        assert!(picture.contains(&whole), "{picture}");
        // The point in the middle, the one in the legend, and none outside.
        assert_eq!(picture.matches("<circle").count(), 2);
        for tick in [">0.0<", ">0.1<", ">0.4<", ">0<", ">5<", ">10<"] {
            assert!(picture.contains(tick), "{tick}");
        }
    }

    #[test]
    fn words_are_escaped_and_every_panel_is_there() {
        let picture = picture(&[panel(), panel()]);
        assert_eq!(picture.matches("one &amp; two").count(), 2);
        assert!(picture.contains("a &lt; b") && !picture.contains("a < b"));
        assert!(picture.contains("viewBox=\"0 0 1040 400\""));
        let opened = picture.matches("<g ").count();
        assert_eq!((opened, picture.matches("</g>").count()), (2, 2));
    }
}
