//! Which bats and cases travel with the program?

use std::path::Path;

use crate::base::error::{Complaint, Error, Result};
use crate::bat::body::Bat;

/// The cases that travel with the program: file name and text.
pub const CASES: &[(&str, &str)] = &[
    ("absorber", include_str!("../../validation/absorber.json")),
    ("clamped_clamped", include_str!("../../validation/clamped_clamped.json")),
    ("clamped_free", include_str!("../../validation/clamped_free.json")),
    ("clamped_pinned", include_str!("../../validation/clamped_pinned.json")),
    ("clamped_tip_mass", include_str!("../../validation/clamped_tip_mass.json")),
    ("cone_1_10", include_str!("../../validation/cone_1_10.json")),
    ("cone_1_100", include_str!("../../validation/cone_1_100.json")),
    ("cone_1_1000", include_str!("../../validation/cone_1_1000.json")),
    ("cone_1_10000", include_str!("../../validation/cone_1_10000.json")),
    ("cone_1_10_60", include_str!("../../validation/cone_1_10_60.json")),
    ("cone_1_2p64", include_str!("../../validation/cone_1_2p64.json")),
    ("cone_1_2p64_60", include_str!("../../validation/cone_1_2p64_60.json")),
    ("cone_complete", include_str!("../../validation/cone_complete.json")),
    ("cork", include_str!("../../validation/cork.json")),
    ("damped_absorber", include_str!("../../validation/damped_absorber.json")),
    ("damped_hands", include_str!("../../validation/damped_hands.json")),
    ("dowel", include_str!("../../validation/dowel.json")),
    ("dumbbell", include_str!("../../validation/dumbbell.json")),
    ("end_springs", include_str!("../../validation/end_springs.json")),
    ("exponential", include_str!("../../validation/exponential.json")),
    ("grip_bed", include_str!("../../validation/grip_bed.json")),
    ("grip_bed_cone_timo", include_str!("../../validation/grip_bed_cone_timo.json")),
    ("handle_1mm", include_str!("../../validation/handle_1mm.json")),
    ("heavy_free", include_str!("../../validation/heavy_free.json")),
    ("heavy_tip", include_str!("../../validation/heavy_tip.json")),
    ("hermite_01", include_str!("../../validation/hermite_01.json")),
    ("hermite_02", include_str!("../../validation/hermite_02.json")),
    ("hermite_04", include_str!("../../validation/hermite_04.json")),
    ("hermite_08", include_str!("../../validation/hermite_08.json")),
    ("hermite_16", include_str!("../../validation/hermite_16.json")),
    ("hermite_32", include_str!("../../validation/hermite_32.json")),
    ("hermite_64", include_str!("../../validation/hermite_64.json")),
    ("hollow_linear", include_str!("../../validation/hollow_linear.json")),
    ("house_reference", include_str!("../../validation/house_reference.json")),
    ("interior_clamp", include_str!("../../validation/interior_clamp.json")),
    ("interior_clamp_middle", include_str!("../../validation/interior_clamp_middle.json")),
    ("joint", include_str!("../../validation/joint.json")),
    ("linear_bat", include_str!("../../validation/linear_bat.json")),
    ("lossy_dowel", include_str!("../../validation/lossy_dowel.json")),
    ("mid_mass", include_str!("../../validation/mid_mass.json")),
    ("nafems_fv2_clamped_pinned", include_str!("../../validation/nafems_fv2_clamped_pinned.json")),
    ("nafems_fv2_pinned_pinned", include_str!("../../validation/nafems_fv2_pinned_pinned.json")),
    ("nafems_fv5", include_str!("../../validation/nafems_fv5.json")),
    ("northwestern_aluminium", include_str!("../../validation/northwestern_aluminium.json")),
    ("northwestern_aluminium_09", include_str!("../../validation/northwestern_aluminium_09.json")),
    ("northwestern_aluminium_20", include_str!("../../validation/northwestern_aluminium_20.json")),
    ("northwestern_aluminium_40", include_str!("../../validation/northwestern_aluminium_40.json")),
    ("northwestern_aluminium_80", include_str!("../../validation/northwestern_aluminium_80.json")),
    (
        "northwestern_aluminium_ansys",
        include_str!("../../validation/northwestern_aluminium_ansys.json"),
    ),
    (
        "northwestern_aluminium_fit",
        include_str!("../../validation/northwestern_aluminium_fit.json"),
    ),
    (
        "northwestern_aluminium_measured",
        include_str!("../../validation/northwestern_aluminium_measured.json"),
    ),
    ("northwestern_wood", include_str!("../../validation/northwestern_wood.json")),
    ("northwestern_wood_09", include_str!("../../validation/northwestern_wood_09.json")),
    ("northwestern_wood_20", include_str!("../../validation/northwestern_wood_20.json")),
    ("northwestern_wood_40", include_str!("../../validation/northwestern_wood_40.json")),
    ("northwestern_wood_80", include_str!("../../validation/northwestern_wood_80.json")),
    ("northwestern_wood_above", include_str!("../../validation/northwestern_wood_above.json")),
    (
        "northwestern_wood_misprint",
        include_str!("../../validation/northwestern_wood_misprint.json"),
    ),
    ("northwestern_wood_side", include_str!("../../validation/northwestern_wood_side.json")),
    ("offset_mass", include_str!("../../validation/offset_mass.json")),
    ("pchip_bat", include_str!("../../validation/pchip_bat.json")),
    ("pin_inside", include_str!("../../validation/pin_inside.json")),
    ("pinned_pinned", include_str!("../../validation/pinned_pinned.json")),
    ("r161_hit_cross", include_str!("../../validation/r161_hit_cross.json")),
    ("r161_hit_fast", include_str!("../../validation/r161_hit_fast.json")),
    ("r161_hit_nathan", include_str!("../../validation/r161_hit_nathan.json")),
    ("r161_hit_slow", include_str!("../../validation/r161_hit_slow.json")),
    ("r161_nathan", include_str!("../../validation/r161_nathan.json")),
    ("r161_nathan_timoshenko", include_str!("../../validation/r161_nathan_timoshenko.json")),
    ("r161_reference", include_str!("../../validation/r161_reference.json")),
    ("r161_rest_free", include_str!("../../validation/r161_rest_free.json")),
    ("r161_rest_pivoted", include_str!("../../validation/r161_rest_pivoted.json")),
    ("r161_slices", include_str!("../../validation/r161_slices.json")),
    ("r161_wolfish", include_str!("../../validation/r161_wolfish.json")),
    ("rayleigh_cone", include_str!("../../validation/rayleigh_cone.json")),
    ("rayleigh_dowel", include_str!("../../validation/rayleigh_dowel.json")),
    ("receptance_dowel", include_str!("../../validation/receptance_dowel.json")),
    ("receptance_timo", include_str!("../../validation/receptance_timo.json")),
    ("russell_little_league", include_str!("../../validation/russell_little_league.json")),
    ("russell_usual", include_str!("../../validation/russell_usual.json")),
    ("sinusoidal", include_str!("../../validation/sinusoidal.json")),
    ("sleeve", include_str!("../../validation/sleeve.json")),
    ("soft_springs", include_str!("../../validation/soft_springs.json")),
    ("squared_up_acuna", include_str!("../../validation/squared_up_acuna.json")),
    ("squared_up_larnach", include_str!("../../validation/squared_up_larnach.json")),
    ("step_1_3", include_str!("../../validation/step_1_3.json")),
    ("step_1_3_60", include_str!("../../validation/step_1_3_60.json")),
    ("steps_many", include_str!("../../validation/steps_many.json")),
    ("stiff_springs", include_str!("../../validation/stiff_springs.json")),
    ("struck_dowel", include_str!("../../validation/struck_dowel.json")),
    ("struck_lossy_dowel", include_str!("../../validation/struck_lossy_dowel.json")),
    ("tanh_bat", include_str!("../../validation/tanh_bat.json")),
    ("taped_dowel", include_str!("../../validation/taped_dowel.json")),
    ("thomson_table", include_str!("../../validation/thomson_table.json")),
    ("three_supports", include_str!("../../validation/three_supports.json")),
    ("timo_clamped_tip_mass", include_str!("../../validation/timo_clamped_tip_mass.json")),
    ("timo_cone", include_str!("../../validation/timo_cone.json")),
    ("timo_dowel", include_str!("../../validation/timo_dowel.json")),
    ("timo_dowel_60", include_str!("../../validation/timo_dowel_60.json")),
    ("timo_pinned_pinned", include_str!("../../validation/timo_pinned_pinned.json")),
    ("timo_slender", include_str!("../../validation/timo_slender.json")),
    ("timo_step", include_str!("../../validation/timo_step.json")),
    ("timo_stubby", include_str!("../../validation/timo_stubby.json")),
    ("timo_tube", include_str!("../../validation/timo_tube.json")),
    ("torpedo_reference", include_str!("../../validation/torpedo_reference.json")),
    ("torpedo_slices", include_str!("../../validation/torpedo_slices.json")),
    ("torpedo_wolfish", include_str!("../../validation/torpedo_wolfish.json")),
    ("torpedo_wolfish_later", include_str!("../../validation/torpedo_wolfish_later.json")),
    ("two_materials", include_str!("../../validation/two_materials.json")),
    ("van_zandt_computed", include_str!("../../validation/van_zandt_computed.json")),
    ("van_zandt_measured", include_str!("../../validation/van_zandt_measured.json")),
    ("wall_nathan", include_str!("../../validation/wall_nathan.json")),
    ("wall_times", include_str!("../../validation/wall_times.json")),
    ("weighed_dowel", include_str!("../../validation/weighed_dowel.json")),
];

/// The bats that travel with the program: path and text.
pub const BATS: &[(&str, &str)] = &[
    ("meshes/bbcor_made_up.json", include_str!("../../meshes/bbcor_made_up.json")),
    ("meshes/bbcor_made_up_open.json", include_str!("../../meshes/bbcor_made_up_open.json")),
    ("meshes/composite_made_up.json", include_str!("../../meshes/composite_made_up.json")),
    ("meshes/cone.json", include_str!("../../meshes/cone.json")),
    ("meshes/corked.json", include_str!("../../meshes/corked.json")),
    ("meshes/dowel.json", include_str!("../../meshes/dowel.json")),
    ("meshes/house.json", include_str!("../../meshes/house.json")),
    (
        "meshes/northwestern_aluminium.json",
        include_str!("../../meshes/northwestern_aluminium.json"),
    ),
    ("meshes/northwestern_wood.json", include_str!("../../meshes/northwestern_wood.json")),
    ("meshes/r161.json", include_str!("../../meshes/r161.json")),
    ("meshes/softball_made_up.json", include_str!("../../meshes/softball_made_up.json")),
    ("meshes/softball_made_up_open.json", include_str!("../../meshes/softball_made_up_open.json")),
    ("meshes/tanh.json", include_str!("../../meshes/tanh.json")),
    ("meshes/torpedo.json", include_str!("../../meshes/torpedo.json")),
    ("meshes/two_piece.json", include_str!("../../meshes/two_piece.json")),
];

/// One of the bats that travel with the program.
///
/// # Errors
///
/// [`Error::Value`] if there is none of that name.
pub fn bundled_bat(path: &str) -> Result<Bat> {
    let (_, text) = BATS
        .iter()
        .find(|(name, _)| *name == path)
        .ok_or_else(|| Error::value("bat", path, "a bat that travels with the program"))?;
    Bat::from_text(path, text, Path::new(""))
}

/// The names of the bats that travel with the program: those of their files.
pub fn bat_names() -> Vec<&'static str> {
    BATS.iter().map(|(path, _)| stem(path)).collect()
}

/// The text of the bat of that name, if it travels with the program.
pub fn bat_text(name: &str) -> Option<&'static str> {
    BATS.iter().find(|(path, _)| stem(path) == name).map(|(_, text)| *text)
}

/// The name of a file without its folder and its ending.
fn stem(path: &'static str) -> &'static str {
    Path::new(path).file_stem().and_then(|stem| stem.to_str()).unwrap_or(path)
}

/// The text of the case of that name.
pub(crate) fn text(name: &str) -> Result<&'static str> {
    let found = CASES.iter().find(|(case, _)| *case == name);
    found
        .map(|(_, text)| *text)
        .ok_or_else(|| Error::value("case", name, "a case that travels with the program"))
}

/// The name and the text of the built-in bat that is meant, if the path is no file's.
///
/// # Errors
///
/// [`Error::Value`] for a name that is neither a file nor built in.
pub fn named(path: &Path) -> Result<Option<(&str, &'static str)>> {
    let one_word = path.components().count() == 1 && path.extension().is_none();
    let is_file = path.exists() && !path.is_dir();
    let Some(name) = path.to_str().filter(|_| one_word && !is_file) else { return Ok(None) };
    if let Some(text) = bat_text(name) {
        return Ok(Some((name, text)));
    }
    if path.exists() {
        return Ok(None);
    }
    let names = bat_names();
    let expected = format!("a bat file, or a built-in bat: {}", names.join(", "));
    let found = format!("{}, which is neither a file nor built in", path.display());
    Err(Error::Value(Complaint::new("", found, expected).or_nearest(name, &names)))
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let names = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name());
        let names = names.map(|name| name.into_string().unwrap());
        let mut names: Vec<String> = names.filter(|name| name.ends_with(".json")).collect();
        names.sort();
        names
    }

    #[test]
    fn every_file_of_the_folders_travels_with_the_program() {
        let cases: Vec<String> = CASES.iter().map(|(name, _)| format!("{name}.json")).collect();
        assert_eq!(cases, files("validation"));
        let bats: Vec<String> = BATS.iter().map(|(name, _)| name.replace("meshes/", "")).collect();
        assert_eq!(bats, files("meshes"));
    }
}
