//! Which cases travel with the program, and the built-in bats by their files?

use std::path::Path;

use sweetspot::base::{Error, Result};
use sweetspot::bat::Bat;
use sweetspot::files::built_in::bat_text;
use sweetspot::json_files;

/// The cases that travel with the program: name and text.
pub const CASES: &[(&str, &str)] = json_files! { "../../../validation":
    "absorber" "clamped_clamped" "clamped_free" "clamped_pinned" "clamped_tip_mass" "cone_1_10"
    "cone_1_100" "cone_1_1000" "cone_1_10000" "cone_1_10_60" "cone_1_2p64" "cone_1_2p64_60"
    "cone_complete" "cork" "damped_absorber" "damped_hands" "dowel" "dumbbell" "end_springs"
    "exponential" "grip_bed" "grip_bed_cone_timo" "handle_1mm" "heavy_free" "heavy_tip" "hermite_01"
    "hermite_02" "hermite_04" "hermite_08" "hermite_16" "hermite_32" "hermite_64" "hollow_linear"
    "house_reference" "interior_clamp" "interior_clamp_middle" "joint" "linear_bat" "lossy_dowel"
    "mid_mass" "nafems_fv2_clamped_pinned" "nafems_fv2_pinned_pinned" "nafems_fv5"
    "northwestern_aluminium" "northwestern_aluminium_09" "northwestern_aluminium_20"
    "northwestern_aluminium_40" "northwestern_aluminium_80" "northwestern_aluminium_ansys"
    "northwestern_aluminium_fit" "northwestern_aluminium_measured" "northwestern_wood"
    "northwestern_wood_09" "northwestern_wood_20" "northwestern_wood_40" "northwestern_wood_80"
    "northwestern_wood_above" "northwestern_wood_misprint" "northwestern_wood_side" "offset_mass"
    "pchip_bat" "pin_inside" "pinned_pinned" "r161_hit_cross" "r161_hit_fast" "r161_hit_nathan"
    "r161_hit_slow" "r161_nathan" "r161_nathan_timoshenko" "r161_reference" "r161_rest_free"
    "r161_rest_pivoted" "r161_slices" "r161_wolfish" "rayleigh_cone" "rayleigh_dowel"
    "receptance_dowel" "receptance_timo" "russell_little_league" "russell_usual" "sinusoidal"
    "sleeve" "soft_springs" "squared_up_acuna" "squared_up_larnach" "step_1_3" "step_1_3_60"
    "steps_many" "stiff_springs" "struck_dowel" "struck_lossy_dowel" "tanh_bat" "taped_dowel"
    "thomson_table" "three_supports" "timo_clamped_tip_mass" "timo_cone" "timo_dowel"
    "timo_dowel_60" "timo_pinned_pinned" "timo_slender" "timo_step" "timo_stubby" "timo_tube"
    "torpedo_reference" "torpedo_slices" "torpedo_wolfish" "torpedo_wolfish_later" "two_materials"
    "van_zandt_computed" "van_zandt_measured" "wall_nathan" "wall_times" "weighed_dowel"
};

/// One of the built-in bats, by its path in the package.
///
/// # Errors
///
/// [`Error::Value`] if there is none with that name.
pub fn bundled_bat(path: &str) -> Result<Bat> {
    let name = path.strip_prefix("meshes/").and_then(|file| file.strip_suffix(".json"));
    let text = name
        .and_then(bat_text)
        .ok_or_else(|| Error::value("bat", path, "a bat that travels with the program"))?;
    Bat::from_text(path, text, Path::new(""))
}

/// The text of the file with that name, if it is among these.
fn of(files: &[(&str, &'static str)], name: &str) -> Option<&'static str> {
    files.iter().find(|(other, _)| *other == name).map(|(_, text)| *text)
}

/// The text of the case of that name.
pub(crate) fn text(name: &str) -> Result<&'static str> {
    of(CASES, name)
        .ok_or_else(|| Error::value("case", name, "a case that travels with the program"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::files::built_in::{BATS, bat_names};

    #[test]
    fn every_bat_is_found_by_its_name() {
        for name in bat_names() {
            let bat = Bat::from_text(name, bat_text(name).unwrap(), Path::new("")).unwrap();
            assert_eq!(bat.name(), bundled_bat(&format!("meshes/{name}.json")).unwrap().name());
        }
        assert!(bat_names().contains(&"r161") && bat_text("meshes/r161.json").is_none());
    }

    /// The names of the JSON files of a folder of the package.
    fn files(folder: &str) -> Vec<String> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
        let names = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name());
        let names = names.map(|name| name.into_string().unwrap());
        let mut names: Vec<String> = names.filter(|name| name.ends_with(".json")).collect();
        names.sort();
        names
    }

    #[test]
    fn every_file_of_the_folders_travels_with_the_program() {
        for (known, folder) in [(CASES, "validation"), (BATS, "meshes")] {
            let names: Vec<String> = known.iter().map(|(name, _)| format!("{name}.json")).collect();
            assert_eq!(names, files(folder));
        }
    }
}
