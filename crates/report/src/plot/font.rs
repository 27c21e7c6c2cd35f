//! The one font of words in PNG: the outlines of its letters, how wide they are, how close they stand.
//!
//! The font is Ubuntu Light, under the Ubuntu Font Licence 1.0, as the crate `epaint_default_fonts`
//! carries it. It has the letters of Latin, Greek and Cyrillic scripts. The font is part of the
//! program, so what is read here is known: letters are found by a table of runs, outlines are lines
//! and parabolas, letters with marks are others laid on each other, and pairs that stand closer or
//! wider are listed by letters and by classes of letters. Lengths are in the font's units, 1000 to
//! the size of the words; y rises upwards.
//!
//! # Source
//!
//! OpenType 1.9.1, tables "cmap" (format 4), "glyf", "loca", "hmtx", "GPOS" (pair adjustment).

use tiny_skia::{Path, PathBuilder};

use crate::plot::route::Point;

/// The font's units in the size of the words.
pub const UNITS: f32 = 1000.0;

/// A stretch of the font's file; numbers are read from the highest byte down.
#[derive(Debug, Clone, Copy)]
struct Bytes(&'static [u8]);

impl Bytes {
    fn from(self, start: usize) -> Self {
        Self(&self.0[start..])
    }

    fn byte(self, at: usize) -> usize {
        self.0[at].into()
    }

    fn whole(self, at: usize) -> usize {
        self.byte(at) << 8 | self.byte(at + 1)
    }

    fn signed(self, at: usize) -> f64 {
        i16::from_be_bytes([self.0[at], self.0[at + 1]]).into()
    }

    fn long(self, at: usize) -> usize {
        self.whole(at) << 16 | self.whole(at + 2)
    }

    /// What lies where the number there says.
    fn follow(self, at: usize) -> Self {
        self.from(self.whole(at))
    }
}

/// A corner of an outline: on it, or beside it and pulling it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Corner {
    at: Point,
    on: bool,
}

/// The font.
#[derive(Debug, Clone)]
pub struct Font {
    letters: Bytes,
    places: Bytes,
    outlines: Bytes,
    widths: Bytes,
    pairs: Vec<Bytes>,
}

impl Default for Font {
    fn default() -> Self {
        Self::new()
    }
}

impl Font {
    /// The one font there is.
    pub fn new() -> Self {
        let file = Bytes(epaint_default_fonts::UBUNTU_LIGHT);
        let entries = (0..file.whole(4)).map(|k| file.from(12 + 16 * k));
        let entries: Vec<Bytes> = entries.collect();
        let table = |name: &[u8; 4]| {
            let entry = entries.iter().find(|entry| entry.0.starts_with(name));
            file.from(entry.expect("the font has all of its tables").long(8))
        };
        let letters = table(b"cmap");
        let adjustments = table(b"GPOS").follow(8);
        let lookups = (0..adjustments.whole(0)).map(|k| adjustments.follow(2 + 2 * k));
        Self {
            // Two lists, which are the same.
            letters: letters.from(letters.long(8)),
            places: table(b"loca"),
            outlines: table(b"glyf"),
            widths: table(b"hmtx"),
            // Each has one part.
            pairs: lookups.map(|lookup| lookup.follow(6)).collect(),
        }
    }

    /// Words on a base line that begins at 0, each letter so much further from the next than the
    /// font has it (units), and how wide they are. What the font has no letter for is a gap, and
    /// blanks in a row are one, as in SVG.
    pub fn set(&self, words: &str, apart: f32) -> (Option<Path>, f32) {
        let blank = |c: char| c == ' ' || c.is_control();
        let words: Vec<&str> = words.split(blank).filter(|word| !word.is_empty()).collect();
        let mut path = PathBuilder::new();
        let (mut right, mut last) = (0.0, None);
        for glyph in words.join(" ").chars().map(|c| self.glyph(c)) {
            right += last.zip(glyph).map_or(0.0, |(one, next)| self.kerning(one, next));
            if let Some(glyph) = glyph {
                self.contours(glyph).iter().for_each(|contour| draw(contour, right, &mut path));
            }
            right += self.width(glyph.unwrap_or(0)) + f64::from(apart);
            last = glyph;
        }
        (path.finish(), right as f32)
    }

    /// The number of a character's outline.
    fn glyph(&self, c: char) -> Option<usize> {
        let code = usize::try_from(u32::from(c)).ok().filter(|code| *code < 0xffff)?;
        let twice = self.letters.whole(6);
        let [ends, starts] = [14, 16 + twice].map(|start| self.letters.from(start));
        let run = (0..twice).step_by(2).find(|run| code <= ends.whole(*run))?;
        let start = starts.whole(run);
        let code = code.checked_sub(start)?;
        let offset = starts.from(2 * twice + run);
        let shift = starts.whole(twice + run);
        let glyph = match offset.whole(0) {
            0 => start + code + shift,
            far => match offset.whole(far + 2 * code) {
                0 => 0,
                glyph => glyph + shift,
            },
        };
        Some(glyph & 0xffff).filter(|glyph| *glyph > 0)
    }

    fn width(&self, glyph: usize) -> f64 {
        self.widths.whole(4 * glyph) as f64
    }

    /// How much further than its width the next letter stands; closer, if it is below 0.
    fn kerning(&self, one: usize, next: usize) -> f64 {
        self.pairs.iter().filter_map(|pairs| adjustment(*pairs, one, next)).sum()
    }

    /// The closed lines of an outline.
    fn contours(&self, glyph: usize) -> Vec<Vec<Corner>> {
        let [start, end] = [0, 4].map(|next| self.places.long(4 * glyph + next));
        if start == end {
            return vec![];
        }
        let outline = self.outlines.from(start);
        match outline.signed(0) {
            ..0.0 => self.laid_together(outline.from(10)),
            count => simple(outline.from(10), count as usize),
        }
    }

    /// An outline of others, each moved. None is turned or enlarged in this font.
    fn laid_together(&self, mut part: Bytes) -> Vec<Vec<Corner>> {
        const WIDE: usize = 0x01;
        const MORE: usize = 0x20;
        let mut all = vec![];
        loop {
            let (flags, glyph) = (part.whole(0), part.whole(2));
            let byte = |at: usize| f64::from(part.0[at] as i8);
            let (by, long) = match flags & WIDE {
                0 => ([byte(4), byte(5)], 6),
                _ => ([part.signed(4), part.signed(6)], 8),
            };
            let moved = |corner: Corner| Corner {
                at: [corner.at[0] + by[0], corner.at[1] + by[1]],
                ..corner
            };
            let contours = self.contours(glyph).into_iter();
            all.extend(contours.map(|contour| contour.into_iter().map(moved).collect::<Vec<_>>()));
            if flags & MORE == 0 {
                return all;
            }
            part = part.from(long);
        }
    }
}

/// The closed lines of an outline that has so many of its own.
fn simple(file: Bytes, count: usize) -> Vec<Vec<Corner>> {
    let ends: Vec<usize> = (0..count).map(|k| file.whole(2 * k) + 1).collect();
    let corners = ends.last().copied().unwrap_or(0);
    // Advice for coarse screens stands before the corners.
    let mut left = file.from(2 * count + 2 + file.whole(2 * count));
    let mut flags = Vec::with_capacity(corners);
    while flags.len() < corners {
        const AGAIN: usize = 0x08;
        let flag = left.byte(0);
        let times = if flag & AGAIN == 0 { 0 } else { left.byte(1) };
        left = left.from(if flag & AGAIN == 0 { 1 } else { 2 });
        flags.extend(std::iter::repeat_n(flag, 1 + times));
    }
    let x = steps(&mut left, &flags, [0x02, 0x10]);
    let y = steps(&mut left, &flags, [0x04, 0x20]);
    let corner = |k: usize| Corner { at: [x[k], y[k]], on: flags[k] & 1 == 1 };
    let starts = [0].into_iter().chain(ends.iter().copied());
    starts.zip(&ends).map(|(start, end)| (start..*end).map(corner).collect()).collect()
}

/// Coordinates from steps: short ones with a sign of their own, none where it is the same, else long.
fn steps(left: &mut Bytes, flags: &[usize], [short, same]: [usize; 2]) -> Vec<f64> {
    let mut at = 0.0;
    let step = |flag: &usize| {
        let (by, long) = match (flag & short > 0, flag & same > 0) {
            (true, true) => (left.byte(0) as f64, 1),
            (true, false) => (-(left.byte(0) as f64), 1),
            (false, true) => (0.0, 0),
            (false, false) => (left.signed(0), 2),
        };
        *left = left.from(long);
        at += by;
        at
    };
    flags.iter().map(step).collect()
}

/// A closed line from corners, so far to the right: straight between those on it, else parabolas.
fn draw(corners: &[Corner], right: f64, path: &mut PathBuilder) {
    let mut all = vec![];
    for (k, corner) in corners.iter().enumerate() {
        let next = corners[(k + 1) % corners.len()];
        all.push(*corner);
        // Halfway between two that pull, the outline passes.
        if !corner.on && !next.on {
            let at = [0, 1].map(|i| 0.5 * (corner.at[i] + next.at[i]));
            all.push(Corner { at, on: true });
        }
    }
    let Some(first) = all.iter().position(|corner| corner.on) else { return };
    all.rotate_left(first);
    let place = |[x, y]: Point| [(x + right) as f32, y as f32];
    let [x, y] = place(all[0].at);
    path.move_to(x, y);
    let mut pull: Option<[f32; 2]> = None;
    for corner in all[1..].iter().chain(&all[..1]) {
        let [x, y] = place(corner.at);
        match (pull.take(), corner.on) {
            (_, false) => pull = Some([x, y]),
            (None, true) => path.line_to(x, y),
            (Some([by_x, by_y]), true) => path.quad_to(by_x, by_y, x, y),
        }
    }
    path.close();
}

/// What a table of pairs has for these two, if it has the first.
fn adjustment(pairs: Bytes, one: usize, next: usize) -> Option<f64> {
    let row = covered(pairs.follow(2), one)?;
    if pairs.whole(0) == 1 {
        let row = pairs.follow(10 + 2 * row);
        let mut listed = (0..row.whole(0)).map(|k| row.from(2 + 4 * k));
        return listed.find(|pair| pair.whole(0) == next).map(|pair| pair.signed(2));
    }
    let [row, column] = [(8, one), (10, next)].map(|(at, glyph)| class(pairs.follow(at), glyph));
    Some(pairs.signed(16 + 2 * (row * pairs.whole(14) + column)))
}

/// Where an outline stands in a list of some.
fn covered(list: Bytes, glyph: usize) -> Option<usize> {
    if list.whole(0) == 1 {
        return (0..list.whole(2)).find(|k| list.whole(4 + 2 * k) == glyph);
    }
    run(list, glyph).map(|run| run.whole(4) + glyph - run.whole(0))
}

/// The class of an outline; most are in none, which is class 0.
fn class(list: Bytes, glyph: usize) -> usize {
    if list.whole(0) == 1 {
        let within = glyph.checked_sub(list.whole(2)).filter(|k| *k < list.whole(4));
        return within.map_or(0, |k| list.whole(6 + 2 * k));
    }
    run(list, glyph).map_or(0, |run| run.whole(4))
}

/// The run, of those in a list, that an outline is in.
fn run(list: Bytes, glyph: usize) -> Option<Bytes> {
    let mut runs = (0..list.whole(2)).map(|k| list.from(4 + 6 * k));
    runs.find(|run| (run.whole(0)..=run.whole(2)).contains(&glyph))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_outline_fills_the_box_that_the_font_states_for_it() {
        let font = Font::new();
        let (mut outlines, mut together) = (0, 0);
        for glyph in 0..1261 {
            let [start, end] = [0, 4].map(|next| font.places.long(4 * glyph + next));
            if start == end {
                continue;
            }
            let head = font.outlines.from(start);
            let mut path = PathBuilder::new();
            font.contours(glyph).iter().for_each(|contour| draw(contour, 0.0, &mut path));
            let path = path.finish().unwrap();
            // A stated box holds the outline, or the corners that pull it as well.
            let [tight, wide] =
                [path.compute_tight_bounds().unwrap(), path.bounds()].map(|bounds| {
                    [bounds.left(), bounds.top(), bounds.right(), bounds.bottom()].map(f64::from)
                });
            for k in 0..4 {
                let stated = head.signed(2 + 2 * k);
                let (least, most) = (tight[k].min(wide[k]), tight[k].max(wide[k]));
                assert!(least - 1.0 <= stated && stated <= most + 1.0, "{glyph}: {stated}");
            }
            // And it stands where its width counts from.
            assert!((head.signed(2) - font.widths.signed(4 * glyph + 2)).abs() <= 1.0, "{glyph}");
            outlines += 1;
            together += usize::from(head.signed(0) < 0.0);
        }
        assert!(outlines > 1200 && together > 300, "{outlines} {together}");
    }

    #[test]
    fn letters_of_three_scripts_are_found_and_others_are_gaps() {
        let font = Font::new();
        let letters = "!~AzŠéßΑωμЖяї–−×·…°²½".chars();
        assert!(letters.clone().all(|c| font.glyph(c).is_some()));
        let unlike: BTreeSet<_> = letters.clone().map(|c| font.glyph(c)).collect();
        assert_eq!(unlike.len(), letters.count());
        assert!("バ\u{7}\u{202e}\u{ffff}🏏".chars().all(|c| font.glyph(c).is_none()));
        let (path, gap) = font.set("バ", 0.0);
        assert!(path.is_none() && gap > 0.0);
        assert_eq!(font.set("aバb", 0.0).1, font.set("a", 0.0).1 + gap + font.set("b", 0.0).1);
        assert_eq!(font.set(" a \t b ", 0.0), font.set("a b", 0.0));
        assert_eq!(font.set("", 0.0), (None, 0.0));
    }

    #[test]
    fn some_pairs_stand_closer() {
        let font = Font::new();
        let closer = |pair: &str| {
            let alone: f32 = pair.chars().map(|c| font.set(&c.to_string(), 0.0).1).sum();
            alone - font.set(pair, 0.0).1
        };
        assert!(["AV", "To", "ΑΥ"].map(closer).iter().all(|by| (10.0..150.0).contains(by)));
        assert_eq!(["HH", "nn", "11"].map(closer), [0.0; 3]);
        assert_eq!(font.set("nn", 36.0).1, font.set("nn", 0.0).1 + 72.0);
    }
}
