//! How much thicker or thinner a bat has become along it.

use crate::plot::{Axis, Chart, Panel, Picture, Series, Sheet, Unit, heights};
use sweetspot::Bat;

/// Height of the diagram (px).
const DIAGRAM: f64 = 230.0;
/// Places along the bat.
const PLACES: usize = 420;

/// The change of the diameter from one bat to the other, place by place as shares of their lengths: `change`.
pub fn picture(sheet: Sheet, old: &Bat, new: &Bat) -> Picture {
    let length = sheet.length();
    // Changes in inches are counted in thousandths of an inch.
    let small =
        if sheet.us { Unit { name: "mil", per: 1e3 * sheet.small().per } } else { sheet.small() };
    let at = |k: usize| {
        let share = (k as f64 + 0.5) / PLACES as f64;
        let [was, is] = [old, new].map(|bat| bat.profile().at(share * bat.length()).outer);
        Some([share * new.length(), 2.0 * (is - was)])
    };
    let curves = vec![Series::curve("change", 0, (0..PLACES).map(at).collect())];
    let alt = format!(
        "Change of the diameter of {} along it: {:.2} {unit} at most off, {:.2} {unit} at most added.",
        old.name(),
        -small.per * heights(&curves).fold(0.0, f64::min),
        small.per * heights(&curves).fold(0.0, f64::max),
        unit = small.name
    );
    let x = Axis::new("from the knob end", [0.0, length.per * new.length()]).counted_in(length);
    let title = "Change of the diameter";
    let chart = Chart::new("change", title, [old.name(), "below the line wood is turned off"], x);
    let panel = Panel::around(DIAGRAM, ("change of the diameter", small), curves, &[0.0]).zero();
    chart.panel(panel).picture(sheet, &alt)
}
