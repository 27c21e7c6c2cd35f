//! How a barrel rings and how its wall affects a ball: the document, the table, sentences and a summary.

use schemars::JsonSchema;
use serde::Serialize;

use crate::csv::rows;
use crate::parts::{Part, Quantity, Units, labels, lines, numbers, terminal, wrapped};
use crate::report::hoop_notes::notes;
use crate::report::tables::{HOOP_MODES, HoopRow, hoop_modes};
use crate::report::text::edited;
use crate::schema::{Written, document};
use sweetspot::Bat;
use sweetspot::base::number::significant;
use sweetspot::bat::edit::Edit;
use sweetspot::modes::hoop::{HoopMode, Outline};
use sweetspot_study::trampoline::barrel::{Barrel, HoopModel, Rebound};
use sweetspot_study::trampoline::pressed::{BarrelCompression, HarmonicShare, PressedWall};
use sweetspot_study::trampoline::thickness::{FACTORS, WallTried};

/// How the barrel of a hollow bat rings, how its wall deforms under a ball, and how that affects the ball. SI units,
/// named at the end of each member; positions count from the knob end; a value that does not exist is null. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Hoop file of sweetspot, sweetspot-hoop/1")]
pub struct HoopFile {
    /// Name of the bat.
    pub bat_name: String,
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// The model of the modes.
    pub model: HoopModel,
    /// Every mode found, ordered by harmonic and then by frequency.
    pub modes: Vec<ShapedMode>,
    /// The wall under the ball; null where the ball does not meet the stretch that is modelled.
    pub wall: Option<PressedWall>,
    /// How fast the ball comes back; null without a wall under it and for a ball without a force law.
    pub bbcor: Option<Rebound>,
    /// The predicted result of a barrel compression test; null where there is no wall under the ball.
    pub compression: Option<BarrelCompression>,
    /// The bat with thinner and thicker walls and the same outer surface; left out where this was not requested.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wall_sweep: Vec<WallTried>,
    /// Assumptions and limits of the model, one sentence each.
    pub notes: Vec<String>,
    /// Whether every frequency is as accurate as requested.
    pub tolerance_met: bool,
}

document!(HoopFile, "hoop");

/// A mode of the wall, and the motion of the outer surface in it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "HoopMode")]
pub struct ShapedMode {
    /// The mode.
    #[serde(flatten)]
    pub mode: HoopMode,
    /// Motion of the outer surface; left out where no samples were requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<Outline>,
}

/// The `sweetspot-hoop/1` document, with the given number of samples of the shape of each mode.
pub fn document(
    bat: &Bat,
    barrel: &Barrel,
    tried: &[WallTried],
    samples: usize,
) -> Written<HoopFile> {
    let hoop = barrel.hoop();
    let modes = hoop.modes().iter().enumerate().map(|(k, mode)| ShapedMode {
        mode: mode.clone(),
        shape: (samples > 0).then(|| hoop.outline(k, samples)),
    });
    Written::of(HoopFile {
        bat_name: bat.name().to_owned(),
        edits: bat.edits().to_vec(),
        model: barrel.model.clone(),
        modes: modes.collect(),
        wall: barrel.struck.wall.clone(),
        bbcor: barrel.struck.rebound.clone(),
        compression: barrel.compressed(),
        wall_sweep: tried.to_vec(),
        notes: notes(bat, barrel, Units::Si),
        tolerance_met: barrel.met(),
    })
}

/// A line for each mode, SI.
pub fn csv(bat: &Bat, barrel: &Barrel) -> String {
    let placed = |mode: &HoopMode| (mode.clone(), bat.length() - mode.largest_at_m);
    let modes: Vec<HoopRow> = barrel.hoop().modes().iter().map(placed).collect();
    rows(&HOOP_MODES, &modes)
}

/// The lowest modes, at most the given number, and the effect of the wall, for the terminal.
pub fn text(bat: &Bat, barrel: &Barrel, most: usize, units: Units) -> [String; 2] {
    let mut out = format!("Hoop modes of {}\n{}", bat.title(), edited(bat, units));
    out += &terminal::parts(&[Part::Table(hoop_modes(bat, barrel.hoop(), most, units))]);
    [out, sentences(bat, barrel, units)]
}

/// The wall under the ball, the rebound, the compression and the remarks, each broken into lines.
fn sentences(bat: &Bat, barrel: &Barrel, units: Units) -> String {
    let mut out = String::from("\n");
    for line in answers(barrel, units) {
        out += &wrapped(&line, 2);
    }
    // The limits of the answer are last in the document and first here.
    for note in notes(bat, barrel, units).iter().rev() {
        out += &wrapped(&format!("note: {note}"), 2);
    }
    out
}

/// The wall under the ball, the rebound and the compression, a sentence each.
pub fn answers(barrel: &Barrel, units: Units) -> Vec<String> {
    let Some(wall) = &barrel.struck.wall else { return vec![] };
    let mut all = vec![pressed(barrel, wall, units), harmonics(wall)];
    match &barrel.struck.rebound {
        Some(rebound) => all.extend(rebounded(rebound, units)),
        None => all.push(format!(
            "BBCOR there: not known, for {} has no force law; --ball-stiffness gives it one.",
            barrel.test.ball.name
        )),
    }
    let BarrelCompression { deflection_m, force_n } = wall.compressed(&barrel.test.ball);
    all.push(format!(
        "Barrel compression: {} for {} between two opposite sides.",
        Quantity::Force.said(units, force_n),
        small(units, deflection_m)
    ));
    all
}

/// How stiff the wall is.
fn pressed(barrel: &Barrel, wall: &PressedWall, units: Units) -> String {
    let times = |over_ball| format!(" ({} times the ball)", significant(over_ball, 2));
    let ball = wall.over_ball.map_or(String::new(), times);
    let patch = [wall.patch_half_length_m, wall.patch_half_width_m];
    let patch = patch.map(|half| Quantity::Small.said(units, 2.0 * half)).join(" by ");
    format!(
        "Wall under a {}, {} from the tip: {}{ball}; {} thick, patch {}.",
        barrel.test.ball.name,
        Quantity::Length.said(units, wall.from_tip_m),
        Quantity::Stiffness.said(units, wall.stiffness_n_m),
        small(units, wall.thickness_m),
        patch,
    )
}

/// The shares of the harmonics in the compliance of the wall, by name from half a per cent on.
fn harmonics(wall: &PressedWall) -> String {
    const LEAST: f64 = 0.5;
    let percent = |share: &HarmonicShare| 100.0 * share.flexibility_m_n * wall.stiffness_n_m;
    let (named, others): (Vec<&HarmonicShare>, Vec<&HarmonicShare>) =
        wall.by_harmonic.iter().partition(|share| percent(share) >= LEAST);
    let told = |share: &&HarmonicShare| {
        format!("n = {} has {} %", share.harmonic, significant(percent(share), 2))
    };
    let mut all: Vec<String> = named.iter().map(told).collect();
    if !others.is_empty() {
        let rest: f64 = others.into_iter().map(percent).sum();
        all.push(format!("all others {} %", significant(rest, 1)));
    }
    format!("Of its compliance {}.", all.join(", "))
}

/// How the ball comes back.
fn rebounded(rebound: &Rebound, units: Units) -> [String; 2] {
    let Rebound { stiff, wall, range: [low, high], .. } = rebound;
    [
        format!(
            "BBCOR there: {stiff:.3} stiff, {wall:.3} with the wall; {low:.3} to {high:.3} with the patch of a \
             ball squeezed twice or half as much."
        ),
        format!(
            "The ball, with {}, dents the wall by about {}; {} stay in the wall.",
            Quantity::Energy.said(units, rebound.initial_j),
            small(units, rebound.dent_m),
            Quantity::Energy.said(units, rebound.left_in_wall_j)
        ),
    ]
}

/// A small length (m).
fn small(units: Units, length: f64) -> String {
    Quantity::Small.in_both(units, |scale| scale.finer().text(length))
}

/// The end of a short answer for a hollow bat, with the first hoop mode; None without one.
pub fn in_a_line(barrel: &Barrel) -> Option<String> {
    let lowest = barrel.hoop().lowest(1);
    let hertz = lowest.first()?.frequency_hz;
    Some(format!(
        "Hoop modes from {hertz:.0} Hz: sweetspot hoop. All else: --full or --report FILE.html"
    ))
}

/// The first hoop modes, the wall and the rebound, as a part of more.
pub fn in_short(barrel: &Barrel, units: Units) -> String {
    const FEW: usize = 3;
    let named = |mode: &&HoopMode| {
        format!("{:.0} Hz (n = {}, m = {})", mode.frequency_hz, mode.harmonic, mode.order)
    };
    let lowest: Vec<String> = barrel.hoop().lowest(FEW).iter().map(named).collect();
    let mut out = String::from("How the barrel rings\n");
    out += &wrapped(&format!("  hoop modes: {}", lowest.join(", ")), 4);
    for line in answers(barrel, units) {
        out += &wrapped(&format!("  {line}"), 4);
    }
    out + "  More: sweetspot hoop\n"
}

/// The bat with other walls, a line for each.
pub fn sweep(tried: &[WallTried], units: Units) -> String {
    let mut out = String::from("\nBBCOR against wall thickness, the surface where it is\n");
    out += &lines(
        tried,
        &[
            (labels(18, "wall under the ball"), &|one| small(units, one.thickness_m)),
            (numbers(7, "times"), &|one| format!("{:.1}", one.factor)),
            (numbers(11, "n=2, m=1"), &|one| format!("{:.0} Hz", one.frequency_hz)),
            (numbers(15, "stiffness"), &|one| {
                Quantity::Stiffness.said(units.first(), one.stiffness_n_m)
            }),
            (numbers(7, "stiff"), &|one| format!("{:.3}", one.stiff)),
            (numbers(7, "BBCOR"), &|one| format!("{:.3}", one.wall)),
            (labels(15, "range"), &|one| format!("{:.3} to {:.3}", one.range[0], one.range[1])),
        ],
    );
    if tried.len() < FACTORS.len() {
        let missing = "Walls of the other thicknesses cannot be made of this bat: its layers or its bore \
                       leave no room for them.";
        out += &wrapped(missing, 0);
    }
    out
}
