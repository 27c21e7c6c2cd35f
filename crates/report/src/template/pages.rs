//! The bat on as many pages as needed, with a bar to check the scale of the print.
//!
//! Each page has a stretch of the outline in full size, the old outline in dashes, positions and diameters every 10 mm
//! or half inch, and a mark at both ends to align the next page.

use crate::template::sheet::{Page, Paper};
use sweetspot::Bat;
use sweetspot::base::number::rounded;
use sweetspot::base::units::inches;

/// Distance of the drawing from the edge of the paper (mm).
const MARGIN: f64 = 12.0;
/// Distance of the points of an outline (mm).
const STEP: f64 = 0.5;

/// Pages of a bat, and of the bat that it was, on that paper.
pub fn pages(new: &Bat, old: &Bat, paper: Paper) -> Vec<Page> {
    let length = 1e3 * new.length();
    // A whole number of ticks, so that no tick is on two pages.
    let (tick, unit) = if new.inches() { (12.7, "in") } else { (10.0, "mm") };
    let stretch = ((paper.width - 2.0 * MARGIN) / tick).floor() * tick;
    let count = (length / stretch).ceil().max(1.0) as usize;
    (0..count)
        .map(|k| {
            let from = k as f64 * stretch;
            let stretch =
                PaperStretch { new, old, from, to: (from + stretch).min(length), tick, unit };
            stretch.page(paper, [k + 1, count])
        })
        .collect()
}

/// The stretch of a bat on one page (mm).
struct PaperStretch<'a> {
    new: &'a Bat,
    old: &'a Bat,
    from: f64,
    to: f64,
    tick: f64,
    unit: &'static str,
}

impl PaperStretch<'_> {
    fn page(&self, paper: Paper, [number, count]: [usize; 2]) -> Page {
        let mut page = Page::new(paper);
        let axis = 0.5 * paper.height;
        let x = |place: f64| MARGIN + place - self.from;
        for (bat, width, dash) in [(self.new, 0.25, 0.0), (self.old, 0.15, 1.5)] {
            for side in [-1.0, 1.0] {
                let points =
                    self.outline(bat).into_iter().map(|[place, r]| [x(place), axis + side * r]);
                page.line(points.collect(), width, dash);
            }
        }
        page.line(vec![[x(self.from), axis], [x(self.to), axis]], 0.1, 3.0);
        self.ticks(&mut page, axis);
        self.ends(&mut page, axis);
        let title = format!("{}: page {number} of {count}", self.new.name());
        page.words([MARGIN, MARGIN + 4.0], 4.0, title);
        let said = "Print in its own size (100 %, no fitting) and measure the bars. Dashes: before. Numbers: \
                    place from the knob end, diameter.";
        page.words([MARGIN, MARGIN + 9.0], 2.8, format!("{said} In {}.", self.unit));
        bars(&mut page);
        page
    }

    /// Places and radii along the stretch (mm), both sides of a step.
    fn outline(&self, bat: &Bat) -> Vec<[f64; 2]> {
        let (profile, to) = (bat.profile(), self.to.min(1e3 * bat.length()));
        let mut points = vec![];
        for piece in &profile.pieces {
            let [start, end] = [piece.start, piece.start + piece.length].map(|x| 1e3 * x);
            let [first, last] = [start.max(self.from), end.min(to)];
            if last <= first {
                continue;
            }
            let steps = ((last - first) / STEP).ceil().max(1.0) as usize;
            points.extend((0..=steps).map(|k| {
                let place = first + (last - first) * k as f64 / steps as f64;
                [place, 1e3 * piece.at(((place - start) / (end - start)).clamp(0.0, 1.0)).outer]
            }));
        }
        points
    }

    /// A tick at every place, its place and its diameter.
    fn ticks(&self, page: &mut Page, axis: f64) {
        let first = (self.from / self.tick - 1e-9).ceil() as usize;
        let last = (self.to / self.tick + 1e-9).floor() as usize;
        for k in first..=last {
            let place = k as f64 * self.tick;
            let x = MARGIN + place - self.from;
            let r = 1e3 * self.new.profile().at(1e-3 * place).outer;
            page.line(vec![[x, axis - r - 3.0], [x, axis - r]], 0.15, 0.0);
            page.line(vec![[x, axis + r], [x, axis + r + 3.0]], 0.15, 0.0);
            page.line(vec![[x, axis - 1.0], [x, axis + 1.0]], 0.15, 0.0);
            let (at, across) = match self.unit {
                "in" => (rounded(inches(1e-3 * place), 1), rounded(inches(2e-3 * r), 3)),
                _ => (rounded(place, 0), rounded(2.0 * r, 1)),
            };
            page.words([x - 2.5, axis - r - 4.5], 2.2, format!("{at}"));
            page.words([x - 3.2, axis + r + 6.0], 2.2, format!("{across}"));
        }
    }

    /// Marks for aligning the next page.
    fn ends(&self, page: &mut Page, axis: f64) {
        for place in [self.from, self.to] {
            let x = MARGIN + place - self.from;
            page.line(vec![[x, axis - 45.0], [x, axis + 45.0]], 0.1, 1.0);
        }
    }
}

/// Bars of 100 mm and of 4 in.
fn bars(page: &mut Page) {
    let bottom = page.paper.height - MARGIN;
    for (k, (length, parts, words)) in
        [(100.0, 10, "100 mm"), (101.6, 4, "4 in")].into_iter().enumerate()
    {
        let (x, y) = (MARGIN + 125.0 * k as f64, bottom);
        page.line(vec![[x, y], [x + length, y]], 0.3, 0.0);
        for part in 0..=parts {
            let at = x + length * f64::from(part) / f64::from(parts);
            page.line(vec![[at, y - 3.0], [at, y]], 0.2, 0.0);
        }
        page.words([x + length + 2.0, y], 3.0, words);
    }
}
