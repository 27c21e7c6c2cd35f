//! Everything a user asked for, ready to print or to write.

pub mod json;
pub mod text;
pub mod curve;
pub mod file;

use crate::bat::Bat;
use crate::plan::Solution;
use crate::theory;

/// What the model leaves out and what it costs, a sentence each.
pub fn ignored(bat: &Bat, solution: &Solution) -> Vec<String> {
    let modes = &solution.modes[..solution.modes.len().min(4)];
    let percents = |f: &dyn Fn(&theory::Shift) -> f64| {
        let shifts = modes.iter().map(|mode| theory::shift(bat, mode));
        let shown: Vec<String> = shifts.map(|s| format!("{:.1} %", 100.0 * f(&s))).collect();
        format!("modes 1 to {} by about {}", modes.len(), shown.join(", "))
    };
    let mut ignored = Vec::new();
    if !modes.is_empty() {
        let rotary = percents(&|s| s.rotary_inertia);
        ignored.push(format!("rotary inertia of the sections: would change {rotary}"));
        ignored.push(match bat.material.shear_modulus {
            Some(_) => {
                let shear = percents(&|s| s.shear.unwrap_or(0.0));
                format!("shear: would change {shear} (first order, too large where it is large)")
            }
            None => {
                "shear: not known, the material has no shear modulus; in wooden bats it lowers \
                     mode 1 by 1 to 2 %, mode 2 by about 5 %, mode 4 by about 15 %"
                    .to_owned()
            }
        });
    }
    ignored.push("hands: the bat is free; they damp it and hardly move a frequency".to_owned());
    ignored.push("hoop modes of hollow barrels: not a beam's, and not modelled".to_owned());
    ignored
}
