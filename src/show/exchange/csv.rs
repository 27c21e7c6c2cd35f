//! Mode shapes as a table for spreadsheets.

use crate::show::exchange::modes_file::ModeTable;

/// A row for each place: `x_m`, both radii, and deflection and rotation of every mode. The header
/// names the columns with their units, there are no comments, and numbers read back to the same
/// bits.
pub fn modes(table: &ModeTable) -> String {
    let mut out = String::from("x_m,radius_m,inner_radius_m");
    for mode in &table.modes {
        let n = mode.order;
        out += &format!(",mode_{n}_deflection,mode_{n}_rotation_rad_per_m");
    }
    out.push('\n');
    let [outer, inner] = table.radii();
    for (k, x) in table.x.iter().enumerate() {
        let shapes = table.modes.iter().flat_map(|mode| [mode.deflection[k], mode.rotation[k]]);
        let cells = [*x, outer[k], inner[k]].into_iter().chain(shapes);
        let cells: Vec<String> = cells.map(|value| format!("{value:?}")).collect();
        out += &cells.join(",");
        out.push('\n');
    }
    out
}
