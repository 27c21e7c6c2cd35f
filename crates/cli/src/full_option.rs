//! `--full`: everything, where one screen is not all.

#[derive(clap::Args)]
pub struct FullArgs {
    /// Everything, not one screen alone
    #[arg(long, help_heading = "Output")]
    pub full: bool,
}

/// The last line of a screen that is not all.
pub const MORE: &str = "Everything else: --full\n";

impl FullArgs {
    /// What is printed: all there is, or what a screen holds, and where the rest is.
    pub fn screen(&self, said: impl Fn(bool) -> String) -> String {
        let all = said(true);
        match (!self.full).then(|| said(false)) {
            Some(first) if first != all => first + MORE,
            _ => all,
        }
    }
}
