//! Colours on light and on dark paper, and how curves are distinguished without colours.
//!
//! A colour appears twice in a picture: as an attribute for light paper, which every program reads, and as a rule for
//! dark paper, which is applied by programs that know the preference of the reader. Texts and thin lines have a
//! contrast of 4.5 or more to their paper, frames of 3. Only the grid is fainter, because no information depends on it.
//!
//! # Source
//!
//! The hues are those of M. Okabe and K. Ito, "Color Universal Design" (2008), which colour-blind people can
//! distinguish; darkened for light paper and lightened for dark. Contrast: Web Content Accessibility Guidelines 2.1,
//! 1.4.3 and 1.4.11.

use std::fmt::Write;

/// A colour on both papers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ink {
    /// Its name in the rules.
    pub name: &'static str,
    /// On light paper.
    pub light: &'static str,
    /// On dark paper.
    pub dark: &'static str,
}

const fn ink(name: &'static str, light: &'static str, dark: &'static str) -> Ink {
    Ink { name, light, dark }
}

/// The paper of a picture.
pub const PAPER: Ink = ink("paper", "#ffffff", "#15181c");
/// Titles and numbers.
pub const TEXT: Ink = ink("text", "#1a1d21", "#eceef1");
/// Muted elements: labels of axes, remarks, outlines.
pub const MUTED: Ink = ink("muted", "#595f69", "#a9b0ba");
/// Frames and ticks.
pub const FRAME: Ink = ink("frame", "#848a93", "#7d848e");
/// Lines to count along.
pub const GRID: Ink = ink("grid", "#e3e5e8", "#31363d");

/// Colours of curves, in the order of use.
pub const SERIES: [Ink; 6] = [
    ink("blue", "#0072b2", "#56b4e9"),
    ink("vermilion", "#bd4a00", "#f08c4a"),
    ink("green", "#007a5a", "#2fc296"),
    ink("purple", "#a8487f", "#e292bf"),
    ink("ochre", "#8a6300", "#e6b33c"),
    ink("grey", "#5f6670", "#a4acb6"),
];

/// All colours.
pub const ALL: [Ink; 11] = [
    PAPER, TEXT, MUTED, FRAME, GRID, SERIES[0], SERIES[1], SERIES[2], SERIES[3], SERIES[4],
    SERIES[5],
];

/// Strokes and gaps (px) of the curves, in the same order; empty for a solid line.
pub const DASHES: [&str; 6] = ["", "9 4", "2 3", "10 3 2 3", "5 3", "12 3 2 3 2 3"];

/// The colour of the k-th curve, and its strokes and gaps: the same pair comes back after thirty.
pub fn series(k: usize) -> (Ink, &'static str) {
    // After six curves the same colours come with other strokes.
    (SERIES[k % 6], DASHES[(k + k / 6) % 6])
}

/// Opacity of filled areas behind curves.
pub const TINT: f64 = 0.14;

/// The rules for dark paper on a screen. They are the same in every picture, so that one page can hold many.
pub fn rules() -> String {
    let mut out = String::from("@media screen and (prefers-color-scheme:dark){");
    for Ink { name, dark, .. } in ALL {
        let _ = write!(out, ".ss-f-{name}{{fill:{dark}}}.ss-s-{name}{{stroke:{dark}}}");
    }
    out + "}"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirty_curves_look_different() {
        let all: Vec<_> = (0..30).map(series).map(|(ink, dash)| (ink.name, dash)).collect();
        for (k, one) in all.iter().enumerate() {
            assert!(!all[..k].contains(one), "{k}: {one:?}");
        }
    }
}
