//! How a barrel rings and what its wall does to a ball: CSV and JSON.

use std::f64::consts::TAU;

use crate::csv::Csv;
use crate::parts::units::Units;
use crate::report::hoop_notes::notes;
use crate::schema::hoop as file;
use sweetspot::bat::body::Bat;
use sweetspot::collision::wall_figures::WallBbcor;
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot::modes::hoop::{HoopMode, Share};
use sweetspot_study::trampoline::barrel::{Barrel, Rebound};
use sweetspot_study::trampoline::pressed::PressedWall;
use sweetspot_study::trampoline::thickness::WallTried;

/// The `sweetspot-hoop/1` document; of each mode the given number of samples of its shape.
pub fn document(bat: &Bat, barrel: &Barrel, tried: &[WallTried], samples: usize) -> file::HoopFile {
    let modes = barrel.hoop().modes().iter().enumerate();
    file::HoopFile {
        format: Format::new(),
        generator: Generator::this(),
        bat_name: bat.name().to_owned(),
        edits: bat.edits().to_vec(),
        model: file::HoopModel {
            from_m: barrel.hoop().from(),
            to_m: barrel.hoop().to(),
            tolerance: barrel.test.tol,
            clamped_change: barrel.clamped_change,
        },
        modes: modes.map(|(k, mode)| hoop_mode(barrel, (k, mode), samples)).collect(),
        wall: barrel.struck.wall.as_ref().map(|wall| under_ball(bat, barrel, wall)),
        bbcor: barrel.struck.rebound.as_ref().map(|rebound| bbcor(barrel, rebound)),
        compression: barrel
            .compressed()
            .map(|[deflection_m, force_n]| file::BarrelCompression { deflection_m, force_n }),
        wall_sweep: tried.iter().filter_map(thickness).collect(),
        notes: notes(barrel, Units::Si),
        tolerance_met: barrel.met(),
    }
}

fn hoop_mode(barrel: &Barrel, (k, mode): (usize, &HoopMode), samples: usize) -> file::HoopMode {
    let shape = (samples > 0).then(|| {
        let outline = barrel.hoop().outline(k, samples);
        file::HoopShape {
            x_m: outline.x,
            radial: outline.radial,
            around: outline.around,
            along: outline.along,
        }
    });
    file::HoopMode {
        harmonic: mode.harmonic,
        order: mode.order,
        frequency_hz: mode.frequency(),
        damping_ratio: mode.damping_ratio,
        error: mode.error,
        largest_at_m: mode.largest_at,
        shape,
    }
}

fn under_ball(bat: &Bat, barrel: &Barrel, wall: &PressedWall) -> file::PressedWall {
    let share = |share: &Share| file::HarmonicShare {
        harmonic: share.harmonic,
        flexibility_m_n: share.flexibility,
        modes: share.gains.len(),
    };
    file::PressedWall {
        x_m: wall.patch.x,
        from_tip_m: bat.length() - wall.patch.x,
        radius_m: wall.radius,
        thickness_m: wall.thickness,
        stiffness_n_m: wall.stiffness(),
        over_ball: barrel
            .struck
            .rebound
            .as_ref()
            .map(|rebound| rebound.figures.stiffness_over_ball),
        compression_m: barrel.test.ball.patch_compression(),
        patch_half_length_m: wall.patch.half_length,
        patch_half_width_m: wall.patch.half_width,
        by_harmonic: wall.shares.iter().map(share).collect(),
    }
}

fn bbcor(barrel: &Barrel, rebound: &Rebound) -> file::BbcorOfWall {
    let WallBbcor { stiff, with, range } = rebound.bbcor();
    file::BbcorOfWall {
        ball: barrel.test.ball.clone(),
        ball_speed_m_s: barrel.test.ball_speed,
        cor: barrel.test.cor,
        stiff,
        wall: with,
        range,
        error: rebound.error,
        peak_force_n: rebound.peak_force,
        dent_m: rebound.figures.dent_m,
        left_in_wall_j: rebound.left,
        initial_j: rebound.initial,
    }
}

fn thickness(tried: &WallTried) -> Option<file::WallThickness> {
    let (wall, rebound) = (tried.struck.wall.as_ref()?, tried.struck.rebound.as_ref()?);
    let WallBbcor { stiff, with, range } = rebound.bbcor();
    Some(file::WallThickness {
        factor: tried.factor,
        thickness_m: wall.thickness,
        mass_kg: tried.mass,
        frequency_hz: tried.struck.first? / TAU,
        stiffness_n_m: wall.stiffness(),
        stiff,
        wall: with,
        range,
        dent_m: rebound.figures.dent_m,
    })
}

/// A line for each mode, SI.
pub fn csv(bat: &Bat, barrel: &Barrel) -> String {
    let names = ["harmonic", "order", "frequency_hz", "damping_ratio", "error", "largest_at_m"];
    let mut table = Csv::new(names.into_iter().chain(["largest_from_tip_m"]));
    for mode in barrel.hoop().modes() {
        table.row([
            mode.harmonic.into(),
            mode.order.into(),
            mode.frequency().into(),
            mode.damping_ratio.into(),
            mode.error.into(),
            mode.largest_at.into(),
            (bat.length() - mode.largest_at).into(),
        ]);
    }
    table.text()
}
