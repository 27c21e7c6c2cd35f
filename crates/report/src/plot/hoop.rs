//! Hoop modes of a barrel, along it and around it.

use std::f64::consts::TAU;

use crate::plot::{
    Chart, FRAME, Frame, LABEL, Panel, Pen, Picture, Plane, Point, SERIES, SMALL, Sheet, Svg, TINT,
    place,
};
use sweetspot::Bat;
use sweetspot::modes::hoop::{HoopMode, Outline};
use sweetspot_study::trampoline::barrel::Barrel;

/// Modes of a usual picture.
pub const MODES: usize = 5;
/// Height of a mode (px), and half of the barrel's.
const ROW: f64 = 88.0;
const THICK: f64 = 22.0;
/// Width of the name of a mode at the right edge (px).
const WORDS: f64 = 96.0;
/// Places along a mode and around a ring.
const ALONG: usize = 45;
const AROUND: usize = 48;

/// The lowest modes, at most the given number, a row each; picture `hoop`. None without modes.
pub fn picture(sheet: Sheet, bat: &Bat, barrel: &Barrel, most: usize) -> Option<Picture> {
    let lowest = barrel.hoop().lowest(most);
    if lowest.is_empty() {
        return None;
    }
    let size = Size::on(sheet);
    let modes = barrel.hoop().modes();
    let panel = Panel::plain(ROW * lowest.len() as f64).over(|svg, plane| {
        let Frame { top, right, .. } = plane.frame;
        for (k, mode) in lowest.iter().enumerate() {
            let axis = top + ROW * (k as f64 + 0.5);
            // By its place among all: two modes may be alike in every number.
            let number = modes.iter().position(|one| std::ptr::eq(one, *mode));
            let Some(number) = number else { continue };
            let outline = barrel.hoop().outline(number, ALONG);
            side(svg, plane, (axis, size.moved), (bat, mode, &outline));
            around(svg, [right + 12.0 + 0.5 * size.across(), axis], size, (mode, &outline));
            named(svg, [sheet.width() - WORDS, axis], mode);
        }
    });
    let told = |mode: &&HoopMode| {
        let x = place::shown(sheet, mode.largest_at_m, bat.length());
        let (n, m, hertz) = (mode.harmonic, mode.order, mode.frequency_hz);
        format!("n = {n}, m = {m} at {hertz:.1} Hz, largest {x}")
    };
    let told: Vec<String> = lowest.iter().map(told).collect();
    let alt = format!("{}: {}.", bat.name(), told.join("; "));
    let stretch = [barrel.hoop().from(), barrel.hoop().to()];
    let called = ("hoop", "Hoop modes of the barrel");
    let facts = "along it, and around it where it moves most; dashed: at rest; not to scale";
    let bats = (stretch, &[(bat.name(), bat.length())][..]);
    let chart = Chart::along(sheet, called, [bat.name(), facts], bats);
    let chart = chart.right(WORDS + size.across() + 20.0 - sheet.right());
    Some(chart.panel(panel).picture(sheet, &alt))
}

/// How large a ring is drawn.
#[derive(Clone, Copy)]
struct Size {
    /// Its radius (px).
    ring: f64,
    /// The largest motion of the ring and of the barrel drawn with it (px).
    moved: f64,
}

impl Size {
    fn on(sheet: Sheet) -> Self {
        if sheet.narrow() {
            Self { ring: 17.0, moved: 6.0 }
        } else {
            Self { ring: 24.0, moved: 9.0 }
        }
    }

    /// Width of a ring (px).
    fn across(self) -> f64 {
        2.0 * (self.ring + self.moved)
    }
}

/// The barrel from the side: its upper and its lower line, at rest and at one end of the motion.
fn side(
    svg: &mut Svg,
    plane: &Plane,
    (axis, most): (f64, f64),
    (bat, mode, outline): (&Bat, &HoopMode, &Outline),
) {
    let radius = |x: f64| bat.profile().at(x).outer;
    let widest = outline.x_m.iter().map(|x| radius(*x)).fold(0.0, f64::max);
    // On the lower side the waves have the phase of half a turn.
    let below = if mode.harmonic.is_multiple_of(2) { 1.0 } else { -1.0 };
    let line = |side: f64, moved: f64| -> Vec<Point> {
        let sign = if side < 0.0 { below } else { 1.0 };
        let places = outline.x_m.iter().zip(&outline.radial);
        let at = |(x, radial): (&f64, &f64)| {
            let out = THICK * radius(*x) / widest + most * moved * sign * radial;
            [plane.across(*x), axis - side * out]
        };
        places.map(at).collect()
    };
    let (ink, pen) = (SERIES[0], Pen::new(SERIES[0], 1.5));
    let area: Vec<Point> =
        line(1.0, 1.0).into_iter().chain(line(-1.0, 1.0).into_iter().rev()).collect();
    svg.area(&area, ink, TINT, None);
    for side in [1.0, -1.0] {
        svg.line(&line(side, 0.0), Pen::new(FRAME, 1.0).dashed("3 3"));
        svg.line(&line(side, 1.0), pen);
    }
}

/// The barrel from the tip, at the place where it moves most.
///
/// A point at θ moves by `U cos nθ` outwards and `V sin nθ` around.
fn around(svg: &mut Svg, [x, y]: Point, size: Size, (mode, outline): (&HoopMode, &Outline)) {
    let most = (0..outline.x_m.len())
        .max_by(|a, b| outline.radial[*a].abs().total_cmp(&outline.radial[*b].abs()))
        .unwrap_or(0);
    let (out, turn) = (outline.radial[most], outline.around[most]);
    let ring = |moved: f64| -> Vec<Point> {
        let at = |k: usize| {
            let theta = TAU * k as f64 / AROUND as f64;
            let (sin_n, cos_n) = (mode.harmonic as f64 * theta).sin_cos();
            let radius = size.ring + moved * out * cos_n;
            let along = moved * turn * sin_n;
            let (sine, cosine) = theta.sin_cos();
            [x + radius * sine + along * cosine, y - radius * cosine + along * sine]
        };
        (0..=AROUND).map(at).collect()
    };
    svg.ring([x, y], size.ring, Pen::new(FRAME, 1.0).dashed("3 3"));
    svg.line(&ring(-size.moved), Pen::new(SERIES[0], 0.8));
    svg.line(&ring(size.moved), Pen::new(SERIES[0], 1.5));
}

fn named(svg: &mut Svg, [x, y]: Point, mode: &HoopMode) {
    let (n, m) = (mode.harmonic, mode.order);
    svg.text([x, y - 4.0], SMALL, &format!("n = {n}, m = {m}"));
    let hertz = match mode.frequency_hz {
        f if f < 9_999.5 => format!("{f:.1} Hz"),
        f => format!("{:.2} kHz", 1e-3 * f),
    };
    svg.text([x, y + 14.0], LABEL.ink(SERIES[0]), &hertz);
}
