//! The JSON file of a hit, in SI, the unit in every key's name.

use crate::schema::hit as file;
use sweetspot::Bat;
use sweetspot::collision::figures::{BarrelSpeed, Figures};
use sweetspot::collision::hit::Wall;
use sweetspot::collision::{Impact, Model, Scene, SweetSpot, columns};
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot_study::ignored;

/// The `sweetspot-hit/1` document, without the figures.
pub fn hit(
    bat: &Bat,
    model: Model,
    scene: &Scene,
    impacts: &[Impact],
    spot: &SweetSpot,
) -> file::HitFile {
    file::HitFile {
        format: Format::new(),
        generator: Generator::this(),
        edits: bat.edits().to_vec(),
        model: model.name().to_owned(),
        scene: scene_out(bat, scene),
        impacts: impacts.iter().map(|at| impact(bat, at)).collect(),
        sweet_spot: spot.clone(),
        ignored: ignored::in_hit(bat, scene),
        figures: None,
    }
}

/// From where the energies of hits on that bat are seen.
pub fn seen_from(bat: &Bat) -> &'static str {
    if bat.fixtures().holding() { "hands" } else { "ground" }
}

/// Swing, pitch and ball.
pub fn scene_out(bat: &Bat, scene: &Scene) -> file::Scene {
    file::Scene {
        bat_pivot_m: scene.pivot,
        swing_rad_s: scene.swing,
        ball: scene.ball.clone(),
        ball_speed_m_s: scene.ball_speed,
        cor: scene.cor,
        hands_m: scene.hands,
        energies_seen_from: seen_from(bat).to_owned(),
        wall: wall(bat, scene),
    }
}

/// The compliance of the wall, if any.
fn wall(bat: &Bat, scene: &Scene) -> Option<file::Wall> {
    if let Some(Wall { stiffness, mass }) = scene.wall {
        return Some(file::Wall { stiffness_n_m: stiffness, mass_kg: mass, hoop: None });
    }
    let wall = scene.hoop.wall()?;
    let x = bat.length() - BarrelSpeed::BROADCAST;
    let compression = scene.ball.patch_compression();
    let [soft, slow] = wall.somewhere(x, compression);
    Some(file::Wall {
        stiffness_n_m: 1.0 / soft,
        mass_kg: slow / (soft * soft),
        hoop: Some(file::HoopInHit {
            harmonics: wall.harmonics(),
            modes: wall.modes().len(),
            frequency_error: wall.off(),
            stretch_m: wall.ends(),
            patch_compression_m: compression,
        }),
    })
}

/// The standard figures, for the document of the impacts.
pub fn figures(figures: &Figures) -> file::Figures {
    let best = figures.best.as_ref().and_then(|best| best.outcome.as_ref());
    file::Figures {
        certified: false,
        bat_ball_speed_m_s: best.map(|o| o.exit_speed),
        collision_efficiency: best.map(|o| o.collision_efficiency),
        bbcor: best.map(|o| o.bbcor),
        bbcor_pivoted: best.map(|o| o.bbcor_pivoted),
        others: figures.clone(),
    }
}

/// One impact.
pub fn impact(bat: &Bat, impact: &Impact) -> file::Impact {
    let outcome = impact.outcome.as_ref();
    file::Impact {
        x_m: impact.x,
        from_tip_m: bat.length() - impact.x,
        bat_speed_m_s: impact.bat_speed,
        exit_speed_m_s: columns::EXIT_SPEED.at(impact),
        rigid_exit_speed_m_s: columns::RIGID_EXIT_SPEED.at(impact),
        cor: columns::COR.at(impact),
        impulse_n_s: columns::IMPULSE.at(impact),
        contact_time_s: columns::CONTACT_TIME.at(impact),
        first_separation: outcome.and_then(|o| o.first_separation),
        peak_force_n: columns::PEAK_FORCE.at(impact),
        peak_compression_m: columns::PEAK_COMPRESSION.at(impact),
        collision_efficiency: columns::EFFICIENCY.at(impact),
        bbcor: columns::BBCOR.at(impact),
        bbcor_pivoted: columns::BBCOR_PIVOTED.at(impact),
        modes_used: outcome.map(|o| o.energy.vibration_by_mode.len()),
        flags: impact.flags.iter().map(|flag| (*flag).to_owned()).collect(),
        energy_j: outcome.map(|o| o.energy.clone()),
        error: file::HitError { exit_speed: outcome.map(|o| o.error) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema;
    use sweetspot::collision::hit::Effort;
    use sweetspot::collision::hitter::Hitter;
    use sweetspot::{Request, solve};
    use sweetspot_proof::bundled::bundled_bat;

    /// Members of the document correspond to columns by name; those of the energies to the ledger.
    #[test]
    fn every_column_is_a_member_of_an_impact() {
        let bat = bundled_bat("meshes/r161.json").unwrap();
        let solution = solve(&bat, &Request { modes: 6, ..Request::plain() }).unwrap();
        let scene = Scene::default();
        let effort = Effort::default();
        let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
        let hit = hitter.strike(0.7);
        let mut document = schema::value(&impact(&bat, &hit));
        document["vibration_j"] = document["energy_j"]["vibration"].clone();
        for column in columns::ALL {
            assert!(column.at(&hit).is_some(), "{}", column.name);
            assert_eq!(document[column.name].as_f64(), column.at(&hit), "{}", column.name);
        }
    }
}
