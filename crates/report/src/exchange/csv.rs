//! Mode shapes as a table for spreadsheets.

use crate::csv::Csv;
use crate::exchange::modes_file::ModeTable;
use crate::parts::Cell;

/// A row for each place: `x_m`, both radii, and deflection and rotation of every mode. The header names the columns
/// with their units. There are no comments. Numbers read back to the same bits.
pub fn modes(table: &ModeTable) -> String {
    let names = table
        .modes
        .iter()
        .map(|mode| mode.order)
        .flat_map(|n| [format!("mode_{n}_deflection"), format!("mode_{n}_rotation_rad_per_m")]);
    let places = ["x_m", "radius_m", "inner_radius_m"].map(str::to_owned);
    let mut out = Csv::new(places.into_iter().chain(names));
    let [outer, inner] = table.radii();
    for (k, x) in table.x.iter().enumerate() {
        let shapes = table.modes.iter().flat_map(|mode| [mode.deflection[k], mode.rotation[k]]);
        out.row([*x, outer[k], inner[k]].into_iter().chain(shapes).map(Cell::from));
    }
    out.text()
}
