//! What happens when somebody stops the program: no half file stays, and no half line on the terminal.

use crate::base::file;

use crate::cli::progress;

/// Takes away what is half done and ends the program, as shells count a signal of that number.
fn stop(signal: i32) -> ! {
    file::abandon();
    progress::clear();
    std::process::exit(128 + signal)
}

/// From now on a signal that ends a program ends this one [cleanly](stop), except where whoever
/// started it had it ignored, as `nohup` does. A limit on the size of files is an error of writing.
#[cfg(unix)]
pub fn cleanly() {
    use std::sync::mpsc::channel;

    use signal_hook::consts::*;
    use signal_hook::iterator::Signals;

    const ENDING: [i32; 10] =
        [SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGVTALRM, SIGPROF];
    // Without this the program stops at the limit, and may leave a part beside a file.
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
    // Where no thread can be started, signals end the program as they end any other.
    if std::thread::Builder::new().spawn(wait).is_ok() {
        let _ = heard.recv();
    }
}

/// Signals that were ignored when the program began, a bit for each; 0 where the system does not tell.
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
    // Without a handler the program stops all the same, and may leave a part beside a file.
    let _ = ctrlc::set_handler(|| stop(INTERRUPT));
}
