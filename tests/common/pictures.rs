//! Conditions on every picture, and reading values from one.

use std::collections::BTreeMap;

use resvg::usvg::roxmltree::{Document, Node};
use sweetspot_report::plot::picture::Picture;
use sweetspot_report::plot::words::{LABEL, Type};
use sweetspot_report::plot::{theme, words};

/// The rectangle of a text: left, top, right, bottom.
pub type Box = [f64; 4];

pub fn number(node: Node, name: &str) -> f64 {
    node.attribute(name).map_or(0.0, |value| value.parse().unwrap())
}

/// The rectangles of the words of a picture, with the widths of a wide font.
pub fn texts<'a>(document: &'a Document) -> Vec<(&'a str, Box)> {
    let of = |node: Node<'a, 'a>| {
        let (x, y, size) = (number(node, "x"), number(node, "y"), number(node, "font-size"));
        let words = node.text().unwrap_or_default();
        let look = Type { size, bold: node.has_attribute("font-weight"), ..LABEL };
        let wide = words::width(words, look);
        let before = match node.attribute("text-anchor") {
            Some("end") => wide,
            Some("middle") => 0.5 * wide,
            _ => 0.0,
        };
        let (up, down) = (0.75 * size, 0.2 * size);
        let rect = match node.has_attribute("transform") {
            true => [x - up, y - wide + before, x + down, y + before],
            false => [x - before, y - up, x - before + wide, y + down],
        };
        (words, rect)
    };
    document.descendants().filter(|node| node.has_tag_name("text")).map(of).collect()
}

/// The conditions on every picture.
pub fn check(picture: &Picture, whose: &str) {
    let what = format!("{whose}: {}", picture.name);
    let text = &picture.svg;
    assert!(text.len() < 60_000, "{what} has {} bytes", text.len());
    assert!(!text.contains("NaN") && !text.contains("inf\"") && !text.contains("id="), "{what}");
    let document = Document::parse(text).unwrap();
    let root = document.root_element();
    assert_eq!(root.attribute("role"), Some("img"), "{what}");
    let child = |name: &str| {
        let mut all = root.children().filter(|node| node.has_tag_name(name));
        all.next().and_then(|node| node.text()).unwrap_or_default().to_owned()
    };
    assert!(!child("title").is_empty() && child("desc").len() > 20, "{what}");
    assert_eq!(child("style"), theme::rules(), "{what}");
    let [width, height] = ["width", "height"].map(|side| number(root, side));
    let all = texts(&document);
    assert!(all.len() > 5, "{what}");
    for (k, (words, [left, top, right, bottom])) in all.iter().enumerate() {
        let inside = *left >= 0.0 && *top >= 0.0 && *right <= width + 0.5 && *bottom <= height;
        assert!(inside, "{what}: {words:?} leaves the picture");
        for (other, [l, t, r, b]) in &all[..k] {
            let apart = right <= l || r <= left || bottom <= t || b <= top;
            assert!(apart, "{what}: {words:?} is on {other:?}");
        }
        for [x, y, end] in guides(&document) {
            let apart = x <= *left || *right <= x || end <= *top || *bottom <= y;
            assert!(apart, "{what}: a dotted line runs through {words:?}");
        }
    }
}

/// The dotted lines down to marked places: where, from, to.
pub fn guides(document: &Document) -> Vec<[f64; 3]> {
    let dotted = |node: &Node| node.attribute("stroke-dasharray") == Some("1 3");
    let of = |node: Node| {
        let numbers = node.attribute("d").unwrap().split(['M', 'L', ' ']).filter(|n| !n.is_empty());
        let numbers: Vec<f64> = numbers.map(|n| n.parse().unwrap()).collect();
        assert!(numbers.len() == 4 && numbers[0] == numbers[2], "{numbers:?}");
        [numbers[0], numbers[1], numbers[3]]
    };
    document.descendants().filter(dotted).map(of).collect()
}

/// The ticks of an axis as a reader sees them: from a pixel to a value.
pub fn scale(ticks: BTreeMap<i64, f64>) -> impl Fn(f64) -> f64 {
    let (first, last) = (ticks.iter().next().unwrap(), ticks.iter().next_back().unwrap());
    let ([a, b], [c, d]) = ([*first.0 as f64 / 10.0, *last.0 as f64 / 10.0], [*first.1, *last.1]);
    assert!(b > a);
    move |pixel| c + (d - c) * (pixel - a) / (b - a)
}

/// Numbers whose texts have that anchor and a position accepted by `keep`, by the pixel that `along` picks (tenths).
pub fn ticks(
    document: &Document,
    anchor: &str,
    keep: impl Fn(f64, f64) -> bool,
    up: bool,
) -> BTreeMap<i64, f64> {
    let all = document
        .descendants()
        .filter(|node| node.has_tag_name("text") && node.attribute("text-anchor") == Some(anchor));
    let read = |node: Node| {
        let value: f64 = node.text()?.replace('−', "-").parse().ok()?;
        let (x, y) = (number(node, "x"), number(node, "y"));
        let along = if up { y - 4.4 } else { x };
        keep(x, y).then_some(((10.0 * along).round() as i64, value))
    };
    all.filter_map(read).collect()
}
