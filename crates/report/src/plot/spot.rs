//! Bats drawn large with their sweet spots on them.

use crate::plot::profile::widest;
use crate::plot::subject::{Subject, lengths, longest, names};
use crate::plot::{
    Anchor, Frame, LABEL, Lying, Mark, NUMBERS, PAPER, Paper, Pen, Picture, Plane, SERIES, Sheet,
    Svg, Type, fitted, head, place, series, width,
};
use sweetspot::collision::SweetSpot;

/// A bat with its sweet spot by every definition.
pub type SpotMarks<'a> = Subject<'a, &'a SweetSpot>;

/// Room above a bat for the place of its sweet spot, and below it for the zone (px).
const ABOVE: f64 = 36.0;
const BELOW: f64 = 38.0;
/// Height of the name of a bat, where there are several (px).
const NAME: f64 = 20.0;
/// From the edges of the picture to the ends of the longest bat (px).
const SIDE: f64 = 16.0;
/// The type of the most important words.
const LARGE: Type = Type { size: 15.0, ..LABEL };

/// The bats one below the other, to one scale and with their true thickness; picture `sweet_spot`. None where no bat
/// has a sweet spot.
pub fn picture(sheet: Sheet, subjects: &[SpotMarks]) -> Option<Picture> {
    subjects.iter().find_map(|s| s.drawn.exit_speed_max)?;
    let longest = longest(subjects);
    let [knob, _] = place::axes(sheet, [0.0, longest], &lengths(subjects));
    let per_metre = (sheet.width() - 2.0 * SIDE) / longest;
    let mut svg = Svg::on(sheet);
    let title = if subjects.len() == 1 { "The sweet spot" } else { "The sweet spots" };
    let (name, facts) = words(sheet, subjects);
    head(&mut svg, title, [name, &facts]);
    let first = if sheet.paper == Paper::File { sheet.head() } else { 2.0 };
    let mut top = first;
    for (k, subject) in subjects.iter().enumerate() {
        let named = if subjects.len() > 1 { NAME } else { 0.0 };
        let axis = top + named + ABOVE + per_metre * widest(subject.bat);
        let bottom = axis + per_metre * widest(subject.bat) + BELOW;
        let frame = Frame { left: SIDE, top, right: sheet.width() - SIDE, bottom };
        let plane = Plane::strip(frame, &knob);
        if named > 0.0 {
            let words = fitted(subject.name, LABEL, sheet.width() - 2.0 * SIDE);
            svg.text([SIDE, top + 14.0], LABEL.ink(series(k).0), &words);
        }
        Lying { plane: &plane, axis, per_metre }.spotted(&mut svg, (k, subject));
        top = bottom;
    }
    let frame = Frame { left: SIDE, top: first, right: sheet.width() - SIDE, bottom: top };
    Plane::strip(frame, &knob).below(&mut svg);
    svg.height = top + NUMBERS;
    let alt = format!("{title} drawn on {}. {facts}", names(subjects).join(", "));
    Some(Picture::new("sweet_spot", title, &alt, svg))
}

fn words<'a>(sheet: Sheet, subjects: &[SpotMarks<'a>]) -> (&'a str, String) {
    let told = |s: &SpotMarks| {
        let x = s.drawn.exit_speed_max?.x;
        Some(format!("{} from the knob end", place::along(sheet, x)))
    };
    match subjects {
        [one] => (one.name, told(one).unwrap_or_default()),
        _ => ("", "dot: where the ball leaves fastest; dark: within 1 % of that speed".to_owned()),
    }
}

impl Lying<'_> {
    /// The bat with its zone darker, a dot on its sweet spot, the place above and the zone below.
    fn spotted(&self, svg: &mut Svg, (k, subject): (usize, &SpotMarks)) {
        let (bat, ink) = (subject.bat, series(k).0);
        self.draw(svg, bat, ink);
        let (radius, sheet) = (self.per_metre * widest(bat), svg.sheet);
        if let Some([from, to]) = subject.drawn.zone {
            self.stretch(svg, bat, ([from, to], ink));
            let [a, b] = [from, to].map(|x| self.plane.across(x));
            let y = self.axis + radius + 8.0;
            let corners = [[a, y - 4.0], [a, y], [b, y], [b, y - 4.0]];
            svg.line(&corners, Pen::new(ink, 1.5));
            let unit = sheet.length();
            let [from, to] = [from, to].map(|x| place::tenths(unit.per * x));
            let words = format!("within 1 %: {from} to {to} {}", unit.name);
            centred(svg, [0.5 * (a + b), y + 18.0], LABEL, &words);
        }
        if let Some(peak) = subject.drawn.exit_speed_max {
            let x = self.plane.across(peak.x);
            let top = self.axis - radius;
            svg.line(&[[x, top - 14.0], [x, self.axis]], Pen::new(ink, 1.5));
            svg.mark(Mark::Circle, [x, self.axis], 6.0, PAPER, true);
            svg.mark(Mark::Circle, [x, self.axis], 4.0, SERIES[1], true);
            let words = format!("sweet spot {}", place::along(sheet, peak.x));
            centred(svg, [x, top - 19.0], LARGE, &words);
        }
    }
}

/// Words centred there, or as near as the paper allows.
fn centred(svg: &mut Svg, [x, y]: [f64; 2], look: Type, words: &str) {
    let half = 0.5 * width(words, look) + 2.0;
    let x = x.min(svg.width - half).max(half);
    svg.text([x, y], look.at(Anchor::Middle), words);
}
