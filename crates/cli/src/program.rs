//! What does the program do with what was typed? It parses, calls the library and prints.

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use crate::done::{Done, NOT_REACHED};
use crate::output::warn;
use crate::{diagnostic, style, verbs};
use sweetspot::Error;
use sweetspot_report::report::mistakes;

/// Runs the verb on the command line; what it answers goes to standard output, what is wrong to
/// standard error. 0 is an answer as accurate as asked, 2 a mistake in what came in, 3 an accuracy
/// that was not reached.
pub fn run() -> ExitCode {
    let Done { text, code, warning } = match verbs::run() {
        Ok(done) => done,
        Err(error) => {
            // If standard error is closed, the message is lost.
            let mut err = io::stderr();
            let coloured = style::coloured(err.is_terminal());
            let _ = write!(err, "{}", diagnostic::render(&error, coloured));
            diagnostic::as_json(|| mistakes::document(&error));
            // Modes that do not converge are an accuracy not reached; all else is the input.
            let code = if matches!(error, Error::NotConverged { .. }) { NOT_REACHED } else { 2 };
            return ExitCode::from(code);
        }
    };
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // Whoever closed the pipe has read enough.
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
