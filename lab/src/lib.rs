//! The program's answers in a page, without a server.
//!
//! A page writes a request into [`room`], calls [`answer`] and reads that many bytes at [`answer_at`]. Both are JSON,
//! see `lab/page/types.js`; a photograph or sound follows the request after a byte 0. The module imports nothing, so it
//! can only compute.
//!
//! | file | question |
//! |---|---|
//! | `shown` | how is a number shown |
//! | `asked` | which question, about which bat, in which scene |
//! | `body` | what are mass and outline of the rigid bat |
//! | `hit` | how does the bat ring, how fast does the ball leave |
//! | `analyze` | what is the uncertainty of the bat in hand |
//! | `lathe`, `aim` | what is the effect of a cut; which cuts meet a wish |
//! | `sound` | how does the bat sound |
//! | `tap` | which tones and modes are in a recording of taps |
//! | `trace` | what is the shape of the bat in a photograph |
//! | `open`, `files` | how is a bat imported and exported |

// Only the exported functions are unsafe.
#![deny(unsafe_code)]

mod shown;
mod asked;
mod body;
mod hit;
mod analyze;
mod lathe;
mod aim;
mod sound;
mod tap;
mod trace;
mod open;
mod files;

use std::cell::RefCell;
use std::panic;
use std::sync::Mutex;

pub use asked::answered;

thread_local! {
    static ASKED: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}
/// The message of the last panic, after which no other part of the instance can be relied on.
static LAST_WORDS: Mutex<String> = Mutex::new(String::new());

/// Room for a request of that many bytes.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    ASKED.with_borrow_mut(|asked| {
        asked.clear();
        asked.resize(bytes, 0);
        asked.as_mut_ptr()
    })
}

/// Answers the request and returns the answer's number of bytes. An empty request is answered by the last panic's
/// message.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    #[cfg(target_arch = "wasm32")]
    pulp_wasm_simd_flag::enable_simd128();
    let asked = ASKED.take();
    let text = match asked.is_empty() {
        true => asked::panicked(&LAST_WORDS.lock().map_or(String::new(), |words| words.clone())),
        false => {
            panic::set_hook(Box::new(|info| {
                if let Ok(mut words) = LAST_WORDS.lock() {
                    *words = info.to_string();
                }
            }));
            let text = asked.split(|byte| *byte == 0).next().unwrap_or_default();
            let bytes = asked.get(text.len() + 1..).unwrap_or_default();
            answered(&String::from_utf8_lossy(text), bytes)
        }
    };
    ANSWER.replace(text.into_bytes());
    ANSWER.with_borrow(Vec::len)
}

/// Where the answer begins.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn answer_at() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}
