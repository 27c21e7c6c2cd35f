//! What takes long: on a terminal, how far it is and how long it will take.

use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Nobody is told of what is done sooner.
const PATIENCE: Duration = Duration::from_millis(500);
const TICK: Duration = Duration::from_millis(100);
/// The whole work in steps of a bar.
const STEPS: u64 = 10_000;

/// One line on standard error, if that is a terminal, after half a second; gone at the end.
pub struct Progress {
    bar: Option<(ProgressBar, Waiting)>,
}

/// The thread that shows the bar when it is time to.
struct Waiting {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Progress {
    /// Begins to wait; `what` is done first.
    pub fn new(quiet: bool, what: &str) -> Self {
        let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        if quiet || dumb || !std::io::stderr().is_terminal() {
            return Self { bar: None };
        }
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        bar.set_style(style("{spinner} {elapsed}  {wide_msg}"));
        bar.set_message(what.to_owned());
        let (stop, stopped) = channel();
        let shown = bar.clone();
        let wait = move || {
            let mut wait = PATIENCE;
            while stopped.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                if wait == PATIENCE {
                    shown.set_draw_target(ProgressDrawTarget::stderr());
                    *last() = Some(shown.clone());
                }
                shown.tick();
                wait = TICK;
            }
        };
        // Where no thread can be started nothing is shown.
        let thread = Builder::new().spawn(wait).ok();
        Self { bar: Some((bar, Waiting { stop: Some(stop), thread })) }
    }

    /// So much of the work is done, 0 to 1, and this comes next.
    pub fn say(&self, share: f64, what: &str) {
        let Some((bar, _)) = &self.bar else { return };
        if bar.position() == 0 && share > 0.0 {
            bar.set_style(style("{spinner} {bar:24} {percent:>3} %, {eta} left  {wide_msg}"));
        }
        bar.set_position((share.clamp(0.0, 1.0) * STEPS as f64) as u64);
        bar.set_message(what.to_owned());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        let Some((bar, waiting)) = &mut self.bar else { return };
        waiting.stop.take();
        if let Some(thread) = waiting.thread.take() {
            // The thread only draws: its failure is ignored.
            let _ = thread.join();
        }
        *last() = None;
        bar.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the templates of this file are well formed")
}

/// The bar that is on the terminal.
static LAST: Mutex<Option<ProgressBar>> = Mutex::new(None);

fn last() -> MutexGuard<'static, Option<ProgressBar>> {
    LAST.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Takes the line off the terminal, for a program that is told to stop.
pub fn clear() {
    if let Some(bar) = last().take() {
        bar.finish_and_clear();
    }
}

/// Says something on standard error, the line below it.
pub fn beside(say: impl FnOnce()) {
    let bar = last().clone();
    match bar {
        Some(bar) => bar.suspend(say),
        None => say(),
    }
}
