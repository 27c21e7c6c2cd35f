//! The changes to a bat after it was weighed, in the notation of the command line.

use crate::parts::Units;
use sweetspot::base::marks::written_out;
use sweetspot::base::number::significant;
use sweetspot::base::units::{self, ounces};
use sweetspot::bat::edit::{Change, Edit};
use sweetspot::{Bat, Material};

/// Significant digits of a length or a mass.
const DIGITS: usize = 4;

/// The edits of a bat, one after the other. Where both systems of units are shown, each edit is in the one in which it
/// was given.
pub fn listed(bat: &Bat, units: Units) -> String {
    let edits: Vec<String> =
        bat.edits().iter().map(|edit| named(edit, units, bat.inches())).collect();
    edits.join("; ")
}

/// A note of the edits of a bat; None for a bat without any.
pub fn noted(bat: &Bat, units: Units) -> Option<String> {
    (!bat.edits().is_empty()).then(|| format!("edited: {}", listed(bat, units)))
}

fn named(edit: &Edit, units: Units, inches: bool) -> String {
    match &edit.name {
        Some(name) => format!("{} ({})", written_out(name), words(&edit.change, units, inches)),
        None => words(&edit.change, units, inches),
    }
}

/// Whether these values are shown in US units: as requested, else in the system with the shorter numbers, in which they
/// were probably typed.
fn in_us(units: Units, inches: bool, si: &[f64], us: &[f64]) -> bool {
    let long = |values: &[f64]| values.iter().map(|value| digits(*value)).sum::<usize>();
    match units {
        Units::Si => false,
        Units::Us => true,
        Units::Both | Units::BothUsFirst if long(si) == long(us) => inches,
        Units::Both | Units::BothUsFirst => long(us) < long(si),
    }
}

/// How many digits a number has without the zeros at its ends.
fn digits(value: f64) -> usize {
    let text = format!("{value:.8e}");
    let (mantissa, _) = text.split_once('e').unwrap_or_default();
    mantissa.trim_end_matches('0').bytes().filter(u8::is_ascii_digit).count()
}

/// A change in the notation of `compare --edit`.
pub fn words(change: &Change, shown: Units, inches: bool) -> String {
    let us = |lengths: &[f64]| {
        let both: Vec<[f64; 2]> = lengths.iter().map(|x| [1e3 * x, units::inches(*x)]).collect();
        let of = |k: usize| both.iter().map(|both| both[k]).collect::<Vec<_>>();
        in_us(shown, inches, &of(0), &of(1))
    };
    let told = |x: f64, us: bool| match us {
        true => format!("{} in", significant(units::inches(x), DIGITS)),
        false => format!("{} mm", significant(1e3 * x, DIGITS)),
    };
    let length = |x: f64| told(x, us(&[x]));
    let stretch = |from: f64, to: f64| {
        let us = us(&[from, to]);
        format!("{} to {}", told(from, us), told(to, us))
    };
    let blend =
        |blend: Option<f64>| blend.map_or(String::new(), |b| format!(", {} blend", length(b)));
    let said = match change {
        Change::Cut(cut) => {
            format!("{}, {}{}", stretch(cut.from, cut.to), length(cut.depth), blend(cut.blend))
        }
        Change::Knob(mass) => match in_us(shown, inches, &[1e3 * mass], &[ounces(*mass)]) {
            true => format!("{} oz", significant(ounces(*mass), DIGITS)),
            false => format!("{} g", significant(1e3 * mass, DIGITS)),
        },
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
