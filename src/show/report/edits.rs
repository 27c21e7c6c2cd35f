//! What was changed about a bat after it was weighed, in the words of the command line.

use crate::base::number::significant;
use crate::base::units::{inches, ounces};
use crate::bat::body::Bat;
use crate::bat::edit::{Change, Edit};
use crate::bat::material::Material;

/// Digits that are shown of a length or a mass.
const DIGITS: usize = 4;

/// The edits of a bat, one after the other.
pub fn listed(bat: &Bat, us: bool) -> String {
    let edits: Vec<String> = bat.edits().iter().map(|edit| named(edit, us)).collect();
    edits.join("; ")
}

fn named(edit: &Edit, us: bool) -> String {
    match &edit.name {
        Some(name) => format!("{name} ({})", words(&edit.change, us)),
        None => words(&edit.change, us),
    }
}

/// A change as `compare --edit` reads it, in US units or in SI.
pub fn words(change: &Change, us: bool) -> String {
    let length = |x: f64| match us {
        true => format!("{} in", significant(inches(x), DIGITS)),
        false => format!("{} mm", significant(1e3 * x, DIGITS)),
    };
    let stretch = |from: f64, to: f64| format!("{} to {}", length(from), length(to));
    let blend =
        |blend: Option<f64>| blend.map_or(String::new(), |b| format!(", {} blend", length(b)));
    let said = match change {
        Change::Cut(cut) => {
            format!("{}, {}{}", stretch(cut.from, cut.to), length(cut.depth), blend(cut.blend))
        }
        Change::Knob(mass) if us => format!("{} oz", significant(ounces(*mass), DIGITS)),
        Change::Knob(mass) => format!("{} g", significant(1e3 * mass, DIGITS)),
        Change::Cup(cup) => format!("{} deep, {}", length(cup.depth), length(cup.diameter)),
        Change::Bore(bore) => format!("{}, {}", stretch(bore.from, bore.to), length(bore.diameter)),
        Change::Cork(cork) => {
            let (on, wide) = (stretch(cork.from, cork.to), length(cork.diameter));
            format!("{on}, {wide}, {}", made_of(&cork.material))
        }
        Change::Sleeve(sleeve) => {
            let (on, thick) = (stretch(sleeve.from, sleeve.to), length(sleeve.thickness));
            format!("{on}, {thick}, {}", made_of(&sleeve.material))
        }
        Change::Shorten(shorten) => {
            let ends = [("knob", shorten.knob), ("tip", shorten.tip)];
            let ends = ends.into_iter().filter_map(|(end, off)| Some((end, off?)));
            let ends: Vec<String> =
                ends.map(|(end, off)| format!("{end} {}", length(off))).collect();
            ends.join(", ")
        }
        Change::ScaleDiameter(scale) => {
            let by = significant(scale.by, 6);
            format!("{}, {by}{}", stretch(scale.from, scale.to), blend(scale.blend))
        }
        Change::Wood(material) => made_of(material),
    };
    format!("{} {said}", change.verb().replace('_', "-"))
}

/// A material by its name, else by its numbers.
fn made_of(material: &Material) -> String {
    let pascals = |modulus: f64| format!("{} MPa", significant(1e-6 * modulus, DIGITS));
    let Material { name, density, youngs_modulus, shear_modulus, .. } = material;
    name.clone().unwrap_or_else(|| {
        let shear = shear_modulus.map_or(String::new(), |shear| format!(", {}", pascals(shear)));
        let density = significant(*density, DIGITS);
        format!("{density} kg/m^3, {}{shear}", pascals(*youngs_modulus))
    })
}
