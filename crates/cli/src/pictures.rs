//! Pictures into a folder.

use std::path::Path;

use sweetspot::base::error::Result;
use sweetspot_report::plot::picture::{self, Picture};

use crate::common::{printed, warn};

/// Writes them, and says which of an earlier run still lie beside them, or that there are none.
pub fn write(folder: &Path, pictures: &[Picture], quiet: bool) -> Result<()> {
    if pictures.is_empty() {
        warn("note: there is nothing to draw, and no pictures were written", quiet);
        return Ok(());
    }
    let others = picture::write(folder, pictures)?;
    if !others.is_empty() {
        let (folder, names) = (printed(folder), others.join(", "));
        warn(&format!("note: {folder} still holds pictures of an earlier run: {names}"), quiet);
    }
    Ok(())
}
