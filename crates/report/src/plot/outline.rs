//! A bat from the side: outline, bore and materials.

use crate::plot::plane::Plane;
use crate::plot::route::Point;
use crate::plot::svg::{Mark, Pen, Svg};
use crate::plot::theme::{FRAME, Ink, MUTED, PAPER, SERIES, TEXT, TINT};
use sweetspot::bat::body::Bat;
use sweetspot::bat::fixtures::Held;
use sweetspot::bat::profile::{Profile, Section};

/// The position of an outline in the drawing, and its thickness.
#[derive(Debug, Clone, Copy)]
pub struct Lying<'a> {
    /// For positions.
    pub plane: &'a Plane,
    /// The height of the axis, and the scale of radii (px/m).
    pub axis: f64,
    /// Pixels of a metre along the bat.
    pub per_metre: f64,
}

/// Sections from knob to tip, about the given number at most, including both sides of each step and the ends.
pub fn sections(profile: &Profile, most: usize) -> Vec<(f64, Section)> {
    let length = profile.length();
    if 3 * profile.pieces.len() > most {
        // More pieces than pixels.
        let at = |k: usize| length * k as f64 / most as f64;
        return (0..=most).map(|k| (at(k), profile.at(at(k)))).collect();
    }
    let along = |piece: &sweetspot::bat::profile::Piece| {
        let parts = (most as f64 * piece.length / length).ceil().max(1.0) as usize;
        let at = |k: usize| k as f64 / parts as f64;
        let of = |k: usize| (piece.start + at(k) * piece.length, piece.at(at(k)));
        (0..=parts).map(of).collect::<Vec<_>>()
    };
    profile.pieces.iter().flat_map(along).collect()
}

impl Lying<'_> {
    /// The point at a place (m) and a radius (m, negative below the axis).
    fn at(&self, x: f64, radius: f64) -> Point {
        [self.plane.across(x), self.axis - self.per_metre * radius]
    }

    /// The closed line around the sections' outer radius, or inner.
    fn around(&self, all: &[(f64, Section)], radius: impl Fn(&Section) -> f64) -> Vec<Point> {
        let upper = all.iter().map(|(x, section)| self.at(*x, radius(section)));
        let lower = all.iter().rev().map(|(x, section)| self.at(*x, -radius(section)));
        upper.chain(lower).collect()
    }

    /// An outline alone, through these sections.
    pub fn outline(&self, svg: &mut Svg, all: &[(f64, Section)], pen: Pen) {
        let mut closed = self.around(all, |section| section.outer);
        closed.extend(closed.first().copied());
        svg.line(&closed, pen);
    }

    /// The bat: its wall, its bore, its hatched regions, its joints and its fixtures.
    pub fn draw(&self, svg: &mut Svg, bat: &Bat, ink: Ink) {
        const MOST: usize = 300;
        let all = sections(bat.profile(), MOST);
        let pen = Some(Pen::new(ink, 1.5));
        svg.area(&self.around(&all, |section| section.outer), ink, TINT, pen);
        self.regions(svg, bat);
        // The bore is as empty as the paper, or as full as its core.
        for run in all.split(|(_, section)| section.inner <= 0.0).filter(|run| run.len() > 1) {
            let bore = self.around(run, |section| section.inner);
            svg.area(&bore, PAPER, 1.0, Some(Pen::new(MUTED, 0.9)));
        }
        self.cores(svg, bat);
        self.fixtures(svg, bat);
    }

    /// A stretch (m) of the bat filled in that colour, from side to side.
    pub fn stretch(&self, svg: &mut Svg, bat: &Bat, (ends, ink): ([f64; 2], Ink)) {
        const DARK: f64 = 0.4;
        const POINTS: usize = 60;
        let at = |k: usize| {
            let x = ends[0] + (ends[1] - ends[0]) * k as f64 / POINTS as f64;
            (x, bat.profile().at(x))
        };
        let all: Vec<(f64, Section)> = (0..=POINTS).map(at).collect();
        self.filled(svg, &all, (ink, DARK));
    }

    /// These sections filled from side to side, as dark as that.
    pub fn filled(&self, svg: &mut Svg, all: &[(f64, Section)], (ink, opacity): (Ink, f64)) {
        svg.area(&self.around(all, |section| section.outer), ink, opacity, None);
    }

    /// Lines across a stretch (m), between two radii of either side.
    fn hatched(&self, svg: &mut Svg, bat: &Bat, stretch: [f64; 2], bore: bool) {
        const APART: f64 = 5.0;
        let [from, to] = stretch.map(|x| self.plane.across(x));
        let count = ((to - from) / APART).ceil().max(1.0) as usize;
        for k in 0..count {
            let x = stretch[0] + (stretch[1] - stretch[0]) * (k as f64 + 0.5) / count as f64;
            let Section { outer, inner } = bat.profile().at(x);
            let pen = Pen::new(if bore { SERIES[4] } else { FRAME }, 0.8);
            if bore {
                svg.line(&[self.at(x, inner), self.at(x, -inner)], pen);
            } else if inner <= 0.0 {
                svg.line(&[self.at(x, outer), self.at(x, -outer)], pen);
            } else {
                svg.line(&[self.at(x, outer), self.at(x, inner)], pen);
                svg.line(&[self.at(x, -inner), self.at(x, -outer)], pen);
            }
        }
    }

    /// Stretches of another material.
    fn regions(&self, svg: &mut Svg, bat: &Bat) {
        for region in &bat.fixtures().regions {
            if region.layup.surface() != bat.material() {
                self.hatched(svg, bat, [region.from, region.to], false);
            }
        }
    }

    /// The filling of the bore.
    fn cores(&self, svg: &mut Svg, bat: &Bat) {
        for region in bat.fixtures().regions.iter().filter(|region| region.layup.core.is_some()) {
            self.hatched(svg, bat, [region.from, region.to], true);
        }
    }

    /// Joints, weights and supports.
    fn fixtures(&self, svg: &mut Svg, bat: &Bat) {
        let radius = |x: f64| bat.profile().at(x).outer;
        for joint in &bat.fixtures().joints {
            let ends = [1.15, -1.15].map(|side| self.at(joint.x, side * radius(joint.x)));
            svg.line(&ends, Pen::new(TEXT, 2.0));
        }
        for tape in &bat.fixtures().tapes {
            for side in [1.0, -1.0] {
                let ends = [tape.from, tape.to].map(|x| self.at(x, side * radius(x)));
                svg.line(&ends, Pen::new(TEXT, 2.4).dashed("2 2"));
            }
        }
        if let Some(grip) = bat.fixtures().grip {
            let [from, to] = [grip.from, grip.to].map(|x| self.at(x, -radius(x))[0]);
            let y = self.axis + self.per_metre * radius(grip.from).max(radius(grip.to)) + 4.0;
            svg.line(&[[from, y], [to, y]], Pen::new(TEXT, 3.0));
        }
        let weights = bat.fixtures().attachments.iter().map(|a| a.x);
        let mut weights: Vec<f64> =
            weights.chain(bat.fixtures().absorbers.iter().map(|a| a.x)).collect();
        weights.sort_by(f64::total_cmp);
        // Closer ones cannot be distinguished.
        weights.dedup_by(|next, last| self.at(*next, 0.0)[0] - self.at(*last, 0.0)[0] < 3.0);
        for x in weights {
            svg.mark(Mark::Diamond, self.at(x, 0.0), 4.5, TEXT, true);
        }
        for support in &bat.fixtures().supports {
            let [x, y] = self.at(support.x, -radius(support.x));
            let mark = if support.kind == Held::Pinned { Mark::Triangle } else { Mark::Square };
            svg.mark(mark, [x, y + 6.0], 5.0, TEXT, true);
        }
    }
}
