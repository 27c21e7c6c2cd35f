//! Does the physics run in a browser?
//!
//!     cargo build --release -p sweetspot-browser --target wasm32-unknown-unknown
//!     node examples/browser/run.mjs target/wasm32-unknown-unknown/release/browser.wasm meshes/r161.json
//!
//! A page passes the text of a bat file byte by byte, requests the answer, and reads it byte by byte. No memory is
//! shared, and the exported names are the only unsafe part. The answer is JSON: either the first frequencies of the bat
//! and one hit, or an error in the words of the program.

use std::cell::RefCell;
use std::path::Path;

use serde_json::{Value, json};
use sweetspot::collision::sweep::{Accuracy, sweep};
use sweetspot::collision::{Model, Scene};
use sweetspot::{Bat, Request, Result, Theory, solve};

/// Position of the impact, from the knob end (m).
const IMPACT: f64 = 0.7;

thread_local! {
    static ASKED: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Takes the next byte of the bat file.
#[unsafe(no_mangle)]
pub extern "C" fn ask(byte: u8) {
    ASKED.with_borrow_mut(|asked| asked.push(byte));
}

/// Computes the answer and returns its number of bytes.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    let asked = ASKED.take();
    let answer = answered(&String::from_utf8_lossy(&asked))
        .unwrap_or_else(|error| json!({ "error": error.to_string() }));
    ANSWER.replace(answer.to_string().into_bytes());
    ANSWER.with_borrow(Vec::len)
}

/// Byte `at` of the answer, 0 beyond its end.
#[unsafe(no_mangle)]
pub extern "C" fn tell(at: usize) -> u8 {
    ANSWER.with_borrow(|answer| answer.get(at).copied().unwrap_or(0))
}

fn answered(text: &str) -> Result<Value> {
    let bat = Bat::from_text("bat.json", text, Path::new(""))?;
    let theory = Theory::Timoshenko;
    let asked = Request { modes: 5, tolerance: 1e-6, theory, ..Request::default() };
    let solution = solve(&bat, &asked)?;
    let frequencies: Vec<f64> = solution.modes.iter().map(|mode| mode.frequency()).collect();
    let accuracy = Accuracy { exit_speed: 1e-4, theory, ..Accuracy::default() };
    let hits = sweep(&bat, Model::Contact, &Scene::default(), &accuracy, &[IMPACT])?;
    let speed = hits.impacts[0].outcome.as_ref().map(|outcome| outcome.exit_speed);
    Ok(json!({
        "name": bat.name(),
        "frequency_hz": frequencies,
        "met": solution.met() && hits.met(),
        "hit": { "x_m": IMPACT, "exit_speed_m_s": speed },
    }))
}
