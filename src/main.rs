//! The `sweetspot` program: parse, call the library, print. No physics here.

mod cli;

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use cli::{diagnostic, style};
use sweetspot::Error;

fn main() -> ExitCode {
    let cli::done::Done { text, code, warning } = match cli::verbs::run() {
        Ok(done) => done,
        Err(error) => {
            // There is nobody left to tell if stderr is closed.
            let mut err = io::stderr();
            let coloured = style::coloured(err.is_terminal());
            let _ = write!(err, "{}", diagnostic::render(&error, coloured));
            // Modes that do not converge are an accuracy not reached; all else is the input.
            let code = if matches!(error, Error::NotConverged { .. }) {
                cli::done::NOT_REACHED
            } else {
                2
            };
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
                // A closed standard error is no reason to fail.
                let _ = writeln!(io::stderr(), "warning: {}", cli::done::printable(&warning));
            }
            ExitCode::from(code)
        }
    }
}
