//! The font of words in PNG: outlines, widths and kerning of its letters.
//!
//! The font is Ubuntu Light, under the Ubuntu Font Licence 1.0, from the crate `epaint_default_fonts`. It has the
//! letters of Latin, Greek and Cyrillic scripts. The font is part of the program and is read with the crate `skrifa`.
//! Lengths are in font units, 1000 per size of the words; y points upwards.

use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::raw::TableProvider;
use skrifa::raw::tables::gpos::{PairPos, PositionSubtables};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use tiny_skia::{Path, PathBuilder};

/// The font's units in the size of the words.
pub const UNITS: f32 = 1000.0;

/// The font.
#[derive(Clone)]
pub struct Font {
    file: FontRef<'static>,
    /// Kerning of pairs of letters.
    pairs: Vec<PairPos<'static>>,
}

impl Default for Font {
    fn default() -> Self {
        Self::new()
    }
}

/// An outline on a base line, shifted to the right.
struct Moved<'a> {
    path: &'a mut PathBuilder,
    right: f32,
}

impl OutlinePen for Moved<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(x + self.right, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(x + self.right, y);
    }

    fn quad_to(&mut self, by_x: f32, by_y: f32, x: f32, y: f32) {
        self.path.quad_to(by_x + self.right, by_y, x + self.right, y);
    }

    fn curve_to(&mut self, a: f32, b: f32, c: f32, d: f32, x: f32, y: f32) {
        self.path.cubic_to(a + self.right, b, c + self.right, d, x + self.right, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

impl Font {
    /// The font.
    pub fn new() -> Self {
        let file = FontRef::new(epaint_default_fonts::UBUNTU_LIGHT).expect("the font is whole");
        let adjustments = file.gpos().and_then(|table| table.lookup_list());
        let lookups = adjustments.into_iter().flat_map(|list| list.lookups().iter());
        let pairs = lookups.filter_map(|lookup| match lookup.ok()?.subtables().ok()? {
            PositionSubtables::Pair(pairs) => Some(pairs),
            _ => None,
        });
        let pairs = pairs.flat_map(|pairs| pairs.iter().flatten().collect::<Vec<_>>()).collect();
        Self { pairs, file }
    }

    /// Words on a base line that begins at 0, with additional letter spacing (units), and their width. A letter missing
    /// in the font leaves a gap, and consecutive blanks count as one, as in SVG.
    pub fn set(&self, words: &str, apart: f32) -> (Option<Path>, f32) {
        let (size, location) = (Size::unscaled(), LocationRef::default());
        let widths = self.file.glyph_metrics(size, location);
        let outlines = self.file.outline_glyphs();
        let blank = |c: char| c == ' ' || c.is_control();
        let words: Vec<&str> = words.split(blank).filter(|word| !word.is_empty()).collect();
        let mut path = PathBuilder::new();
        let (mut right, mut last) = (0.0, None);
        for glyph in words.join(" ").chars().map(|c| self.glyph(c)) {
            right += last.zip(glyph).map_or(0.0, |(one, next)| self.kerning(one, next));
            if let Some(outline) = glyph.and_then(|glyph| outlines.get(glyph)) {
                let mut moved = Moved { path: &mut path, right };
                // A glyph that cannot be drawn leaves a gap.
                let _ = outline.draw(DrawSettings::unhinted(size, location), &mut moved);
            }
            right += widths.advance_width(glyph.unwrap_or_default()).unwrap_or(0.0) + apart;
            last = glyph;
        }
        (path.finish(), right)
    }

    /// The number of a character's outline.
    fn glyph(&self, c: char) -> Option<GlyphId> {
        self.file.charmap().map(c).filter(|glyph| *glyph != GlyphId::NOTDEF)
    }

    /// Kerning between two letters, negative where they are closer.
    fn kerning(&self, one: GlyphId, next: GlyphId) -> f32 {
        let all = self.pairs.iter().filter_map(|pairs| adjustment(pairs, one, next));
        all.map(f32::from).sum()
    }
}

/// The kerning of these two letters in a table of pairs, if it has the first.
fn adjustment(pairs: &PairPos, one: GlyphId, next: GlyphId) -> Option<i16> {
    match pairs {
        PairPos::Format1(listed) => {
            let row = listed.coverage().ok()?.get(one)?;
            let row = listed.pair_sets().get(row.into()).ok()?;
            let mut all = row.pair_value_records().iter().flatten();
            all.find(|pair| pair.second_glyph() == next)?.value_record1().x_advance()
        }
        PairPos::Format2(classes) => {
            classes.coverage().ok()?.get(one)?;
            let [row, column] = [(classes.class_def1(), one), (classes.class_def2(), next)]
                .map(|(all, glyph)| all.map_or(0, |all| usize::from(all.get(glyph))));
            let row = classes.class1_records().get(row).ok()?;
            row.class2_records().get(column).ok()?.value_record1().x_advance()
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

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
