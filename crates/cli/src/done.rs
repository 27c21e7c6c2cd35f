//! What a verb leaves: text, exit code, warning.

pub use sweetspot::base::marks::written_out as printable;

/// What is left to do when a verb is done.
pub struct Done {
    /// What to print on standard output.
    pub text: String,
    /// The exit code.
    pub code: u8,
    /// What to say on standard error when everything else is written.
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
/// The asked accuracy could not be reached; the best answer, if there is one, is given.
pub const NOT_REACHED: u8 = 3;
