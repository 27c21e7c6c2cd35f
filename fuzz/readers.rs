//! The fuzzed function: it passes the bytes to a reader, and solves the bat if one was read.
//!
//! A reader must answer with a value or an error in one line; anything else is a fault. Used by the targets here and,
//! on the seeds, by `tests/fuzz_corpus.rs`.

use std::fs;
use std::path::{Path, PathBuf};

use sweetspot::bat::formula::Formula;
use sweetspot::collision::ball::Ball;
use sweetspot::files::force_file;
use sweetspot::files::shape_file;
use sweetspot::{Bat, Error, Request, Result, solve};
use sweetspot_report::exchange::modes_file;
use sweetspot_study::files::measured;
use sweetspot_tap::decode::{Part, decode};

/// A reader: whether it took the bytes.
pub type Reader = fn(&[u8]) -> bool;

/// Every reader, by the name of its target and of its seeds.
pub const READERS: [(&str, Reader); 9] = [
    ("bat", bat),
    ("table", table),
    ("formula", formula),
    ("ball", ball),
    ("modes", modes),
    ("force", force),
    ("shape", shape),
    ("measured", measured),
    ("recording", recording),
];

/// Reads a bat file and solves the bat roughly.
pub fn bat(bytes: &[u8]) -> bool {
    let Some(bat) = said(Bat::from_text("bat", &text(bytes), Path::new(""))) else { return false };
    let request = Request { modes: 2, tolerance: 1e-2, ..Request::plain() };
    if let Some(solution) = said(solve(&bat, &request)) {
        assert!(solution.modes.iter().all(|mode| mode.frequency().is_finite()));
    }
    true
}

/// The columns of a bat in a CSV file.
pub fn table(bytes: &[u8]) -> bool {
    const BAT: &str = r#"{ "format": "sweetspot-bat/1", "material": "white-ash",
        "profile": { "csv": "input" } }"#;
    in_file(bytes, "input", |path| {
        Bat::from_text("bat", BAT, path.parent().expect("it is in a folder"))
    })
}

/// A formula, and its values.
pub fn formula(bytes: &[u8]) -> bool {
    let Ok(formula) = Formula::parse(&text(bytes)) else { return false };
    let _ = formula.at(0.3);
    let _ = formula.corners(0.0, 0.84);
    true
}

/// A ball file.
pub fn ball(bytes: &[u8]) -> bool {
    in_file(bytes, "input", |path| Ball::from_file(path))
}

/// A file of modes, as `convert` reads it.
pub fn modes(bytes: &[u8]) -> bool {
    said(modes_file::from_text("modes", &text(bytes))).is_some()
}

/// A force in time.
pub fn force(bytes: &[u8]) -> bool {
    in_file(bytes, "input", force_file::read)
}

/// An initial shape.
pub fn shape(bytes: &[u8]) -> bool {
    in_file(bytes, "input", |path| shape_file::read(path, 0.84))
}

/// Measured modes, in a universal file or a table.
pub fn measured(bytes: &[u8]) -> bool {
    let universal = bytes.starts_with(b"    -1");
    in_file(bytes, if universal { "input.uff" } else { "input.csv" }, |path| {
        measured::read(path, &Default::default())
    })
}

/// A recording of taps.
pub fn recording(bytes: &[u8]) -> bool {
    match decode("input", bytes.to_vec(), Part::default()) {
        Ok(read) => read.samples.iter().all(|x| x.is_finite()) && !read.samples.is_empty(),
        Err(error) => {
            assert!(!error.to_string().contains('\n'), "{error}");
            false
        }
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The value, after a check of the error message if there is none.
fn said<T>(read: Result<T>) -> Option<T> {
    let one_line = |error: &Error| !error.to_string().contains('\n');
    read.inspect_err(|error| assert!(one_line(error), "{error}")).ok()
}

/// Reads a file of these bytes under that name.
fn in_file<T>(bytes: &[u8], name: &str, read: impl Fn(&Path) -> Result<T>) -> bool {
    let thread = format!("{:?}", std::thread::current().id());
    let thread: String = thread.chars().filter(char::is_ascii_digit).collect();
    let folder = format!("sweetspot-fuzz-{}-{thread}", std::process::id());
    let folder: PathBuf = std::env::temp_dir().join(folder);
    fs::create_dir_all(&folder).expect("a temporary folder can be made");
    let path = folder.join(name);
    fs::write(&path, bytes).expect("a temporary file can be written");
    said(read(&path)).is_some()
}
