//! What happens when the program is stopped? No partly written file and no partial line on the terminal remain.

use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use sweetspot::base::file;

use crate::progress;

/// Removes unfinished files and ends the program with the exit code that shells use for a signal of that number.
fn stop(signal: i32) -> ! {
    file::abandon();
    progress::clear();
    std::process::exit(128 + signal)
}

/// Ends the program when there is no memory left, without asking for more.
pub fn end_without_memory() -> ! {
    const SAID: &[u8] =
        b"error: memory: found none left, of this machine or of a limit such as ulimit -v, \
        expected more for this bat; no half file was left\n";
    static ENDING: AtomicBool = AtomicBool::new(false);
    if ENDING.swap(true, Ordering::Relaxed) {
        // Another thread is ending the program. If it is this one, the message has been printed.
        std::thread::sleep(Duration::from_secs(2));
        std::process::abort();
    }
    let mut errors = std::io::stderr();
    // A progress line is ended first.
    let line: &[u8] = if errors.is_terminal() { b"\n" } else { b"" };
    let _ = errors.write_all(line).and_then(|()| errors.write_all(SAID));
    file::abandon_at_once();
    std::process::exit(2)
}

/// From now on a signal that ends a program ends this one [cleanly](stop), unless the parent process has it ignored, as
/// `nohup` does. Exceeding the limit on the size of files becomes an error of writing.
#[cfg(unix)]
pub fn cleanly() {
    use std::sync::mpsc::channel;

    use signal_hook::consts::*;
    use signal_hook::iterator::Signals;

    const ENDING: [i32; 10] =
        [SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGVTALRM, SIGPROF];
    // Without this the program stops at the limit, and may leave a temporary file.
    let _ = signal_hook::flag::register(SIGXFSZ, std::sync::Arc::default());
    let ignored = ignored();
    let (ready, heard) = channel();
    let wait = move || {
        let heeded = ENDING.iter().filter(|signal| ignored >> (*signal - 1) & 1 == 0);
        let Ok(mut signals) = Signals::new(heeded) else { return };
        let _ = ready.send(());
        if let Some(signal) = signals.forever().next() {
            stop(signal);
        }
    };
    // If no thread can be started, signals end the program as they end any other.
    if std::thread::Builder::new().spawn(wait).is_ok() {
        let _ = heard.recv();
    }
}

/// Signals that were ignored when the program began, a bit for each; 0 if the system does not tell.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    line.and_then(|bits| u64::from_str_radix(bits.trim(), 16).ok()).unwrap_or(0)
}

/// From now on an interrupt ends the program [cleanly](stop).
#[cfg(not(unix))]
pub fn cleanly() {
    const INTERRUPT: i32 = 2;
    // Without a handler the program still stops, and may leave a temporary file.
    let _ = ctrlc::set_handler(|| stop(INTERRUPT));
}
