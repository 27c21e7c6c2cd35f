//! The result of a verb: text, exit code, warning.

pub use sweetspot::base::marks::written_out as printable;

/// The output of a verb.
pub struct Done {
    /// Text for standard output.
    pub text: String,
    /// The exit code.
    pub code: u8,
    /// Warning for standard error, after everything else is written.
    pub warning: Option<String>,
}

impl Done {
    pub fn new(text: String, code: u8) -> Self {
        Self { text, code, warning: None }
    }

    pub fn with(self, warning: Option<String>) -> Self {
        Self { warning, ..self }
    }
}

/// A check or a validation failed.
pub const FAILED: u8 = 1;
/// The accuracy could not be reached; the best answer, if there is one, is given.
pub const NOT_REACHED: u8 = 3;
