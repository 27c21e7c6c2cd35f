//! A picture as pixels, with a font of its own: nothing is asked of the system.
//!
//! The font is Ubuntu Light, under the Ubuntu Font Licence 1.0, as the crate `epaint_default_fonts`
//! carries it. It has the letters of Latin, Greek and Cyrillic scripts; in other names of bats the SVG
//! is whole and the PNG leaves gaps.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};

/// The one font there is.
static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    Arc::new(fonts)
});

/// The fonts that words are drawn with.
pub fn fonts() -> Arc<Database> {
    Arc::clone(&FONTS)
}

/// One of our own pictures as PNG, on light paper, so many pixels for each of its own.
pub fn png(svg: &str, scale: f32) -> Vec<u8> {
    let options = Options { font_family: "Ubuntu".into(), fontdb: fonts(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).expect("our own pictures are well-formed");
    let size = tree.size();
    let [width, height] = [size.width(), size.height()].map(|side| (side * scale).ceil() as u32);
    let mut pixels = Pixmap::new(width, height).expect("our own pictures have a size");
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().expect("pixels in memory are whole")
}
