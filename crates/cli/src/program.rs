//! How does the program run a command? It parses, calls the library and prints.

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use crate::done::{Done, NOT_REACHED};
use crate::output::warn;
use crate::{diagnostic, style, verbs};
use sweetspot::Error;
use sweetspot_report::report::mistakes;

/// Runs the verb on the command line; results go to standard output, errors to standard error. The exit code is 0 for
/// an answer as accurate as asked, 2 for a mistake in the input, 3 for an accuracy that was not reached.
pub fn run() -> ExitCode {
    let Done { text, code, warning } = match verbs::run() {
        Ok(done) => done,
        Err(error) => {
            // If standard error is closed, the message is lost.
            let mut err = io::stderr();
            let coloured = style::coloured(err.is_terminal());
            let _ = write!(err, "{}", diagnostic::render(&error, coloured));
            diagnostic::as_json(|| mistakes::document(&error));
            // Modes that do not converge are an accuracy not reached; any other error is in the input.
            let code = if matches!(error, Error::NotConverged { .. }) { NOT_REACHED } else { 2 };
            return ExitCode::from(code);
        }
    };
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // A closed pipe is not an error: its reader has read enough.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            let _ = writeln!(io::stderr(), "error: cannot write to standard output: {error}");
            ExitCode::from(2)
        }
        _ => {
            if let Some(warning) = warning {
                warn(&format!("warning: {warning}"), false);
            }
            ExitCode::from(code)
        }
    }
}
