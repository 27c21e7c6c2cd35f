//! Progress of a long computation and its remaining time, on a terminal and elsewhere.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, sleep};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Shorter work shows no progress.
const PATIENCE: Duration = Duration::from_millis(500);
const TICK: Duration = Duration::from_millis(100);
/// Interval of the lines in a pipe or a file.
const LINE: Duration = Duration::from_secs(30);
/// The whole work in steps of a bar.
const STEPS: u64 = 10_000;

/// One line on standard error, if that is a terminal, after half a second; gone at the end.
pub struct Progress {
    shown: ProgressLook,
    begun: Instant,
    /// How much of the work was done before, 0 to 1.
    before: f64,
}

enum ProgressLook {
    Not,
    Bar(ProgressBar),
    Lines(Mutex<LastLine>),
}

/// The last line, if there was one.
struct LastLine {
    at: Instant,
    any: bool,
}

impl Progress {
    /// Begins; `what` is the first step.
    pub fn new(quiet: bool, what: &str) -> Self {
        let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let hidden = quiet || dumb || !std::io::stderr().is_terminal();
        let shown = if hidden { ProgressLook::Not } else { ProgressLook::bar(what) };
        Self { shown, begun: Instant::now(), before: 0.0 }
    }

    /// Reports the share of the work that is done, 0 to 1, and the next step.
    pub fn say(&self, share: f64, what: &str) {
        let share = share.clamp(0.0, 1.0);
        let left = left(self.begun.elapsed(), self.before, share);
        let said =
            left.map_or(what.to_owned(), |left| format!("{} left  {what}", HumanDuration(left)));
        match &self.shown {
            ProgressLook::Not => {}
            ProgressLook::Bar(bar) => {
                if bar.position() == 0 && share > 0.0 {
                    bar.set_style(style("{spinner} {bar:24} {percent:>3} %, {wide_msg}"));
                }
                bar.set_position((share * STEPS as f64) as u64);
                bar.set_message(said);
            }
            ProgressLook::Lines(last) => {
                let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
                if last.at.elapsed() >= LINE || (last.any && share == 1.0) {
                    eprintln!("{:3.0} %  {said}", (100.0 * share).floor());
                    *last = LastLine { at: Instant::now(), any: true };
                }
            }
        }
    }
}

/// The remaining time when a share of all is done, some of it before the start; `None` if it cannot be estimated.
fn left(elapsed: Duration, before: f64, share: f64) -> Option<Duration> {
    let done = share - before;
    (done > 0.0 && share < 1.0)
        .then(|| Duration::try_from_secs_f64(elapsed.as_secs_f64() * (1.0 - share) / done).ok())?
}

/// Progress of many similar items, of which some were done before. If standard error is not a terminal, a line appears
/// every half minute.
pub struct Counted {
    progress: Progress,
    what: &'static str,
    all: u64,
    before: u64,
    done: AtomicU64,
}

impl Counted {
    /// Reports how many of `all` are done.
    pub fn new(quiet: bool, what: &'static str, all: u64, before: u64) -> Self {
        let mut progress = Progress::new(quiet, what);
        progress.before = before as f64 / all as f64;
        // The work may take days, and a reader of a log needs the progress too.
        if !quiet && matches!(progress.shown, ProgressLook::Not) {
            progress.shown =
                ProgressLook::Lines(Mutex::new(LastLine { at: Instant::now(), any: false }));
        }
        Self { progress, what, all, before, done: AtomicU64::new(before) }
    }

    /// Adds a number of finished items.
    pub fn more(&self, some: u64) {
        let done = self.done.fetch_add(some, Ordering::Relaxed) + some;
        let rate = (done - self.before) as f64 / self.progress.begun.elapsed().as_secs_f64();
        let digits = usize::from(rate < 10.0);
        let (all, what) = (self.all, self.what);
        let said = format!("{done} of {all} {what}, {rate:.digits$} a second");
        self.progress.say(done as f64 / all as f64, &said);
    }
}

impl ProgressLook {
    fn bar(what: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        bar.set_style(style("{spinner} {elapsed}  {wide_msg}"));
        bar.set_message(what.to_owned());
        let shown = bar.clone();
        let wait = move || {
            sleep(PATIENCE);
            let mut last = last();
            // Work that is finished by then shows nothing.
            if !shown.is_finished() {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                *last = Some(shown.clone());
            }
            drop(last);
            // The bar's own thread would end the program if none can be started.
            while !shown.is_finished() {
                shown.tick();
                sleep(TICK);
            }
        };
        // If no thread can be started, nothing is shown.
        let _ = Builder::new().spawn(wait);
        Self::Bar(bar)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        let ProgressLook::Bar(bar) = &self.shown else { return };
        let mut last = last();
        *last = None;
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

/// Clears the line from the terminal, for a program that is told to stop.
pub fn clear() {
    if let Some(bar) = last().take() {
        bar.finish_and_clear();
    }
}

/// Prints a message on standard error, with the progress line below it.
pub fn beside(say: impl FnOnce()) {
    let bar = last().clone();
    match bar {
        Some(bar) => bar.suspend(say),
        None => say(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_done_before_took_no_time() {
        let ten = Duration::from_secs(10);
        assert_eq!(left(ten, 0.0, 0.5), Some(ten));
        // Half was done before, and half of the other half took ten seconds.
        assert_eq!(left(ten, 0.5, 0.75), Some(ten));
        assert_eq!(left(ten, 0.5, 0.5), None);
        assert_eq!(left(ten, 0.0, 1.0), None);
    }
}
