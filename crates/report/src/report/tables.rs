//! The tables of results, for pages and terminals: modes, sweet spots, energies, figures.

use crate::parts::Quantity::{Energy, Length, Mass, Ratio, Speed, Words};
use crate::parts::{Cell, Column, Part, Quantity, Scale, Table, Units, fixed};
use crate::report::hit_text::{STATED, SpotLine, legend, letters, spot_lines, stated};
use sweetspot::base::number::{signed, significant};
use sweetspot::collision::figures::{Figures, Moved};
use sweetspot::collision::sweet_spot::Peak;
use sweetspot::collision::{Impact, Outcome, SweetSpot, columns};
use sweetspot::modes::damping::Damped;
use sweetspot::modes::hoop::{Hoop, HoopMode};
use sweetspot::{Bat, Mode, Solution};

/// The sign for a missing number.
pub const NONE: &str = "–";

/// A mode, and the frequency of the first (Hz).
type ModeRow<'a> = (&'a Mode, f64);

/// Frequencies with their errors, and modal masses for a largest deflection of 1.
pub fn modes(bat: &Bat, solution: &Solution, units: Units) -> Table {
    let columns: [Column<ModeRow>; 5] = [
        Column::new("mode", "", Ratio(0), |(mode, _)| mode.order.into()),
        Column::new("frequency, Hz", "", Words, |(mode, _)| {
            as_known(mode.frequency(), mode.error.total()).into()
        }),
        Column::new("f/f1", "", Ratio(3), |(mode, first)| (mode.frequency() / first).into()),
        Column::new("relative error", "", Words, |(mode, _)| within(mode.error.total()).into()),
        Column::new("modal mass (largest |w| = 1)", "", Mass, |(mode, _)| mode.modal_mass.into()),
    ];
    let first = solution.modes.first().map_or(1.0, Mode::frequency);
    let rows: Vec<ModeRow> = solution.modes.iter().map(|mode| (mode, first)).collect();
    Table::of(format!("Bending modes ({})", bat.fixtures().freedom()), &columns, &rows, units)
}

/// A relative error.
fn within(error: f64) -> String {
    format!("within {error:.0e}")
}

/// A frequency (Hz) with the digits that are known by its relative error, two decimals at least and nine
/// characters at most.
fn as_known(frequency: f64, error: f64) -> String {
    const LONGEST: usize = 9;
    let known = (-(error * frequency).log10()).floor();
    let whole = format!("{frequency:.0}").len();
    let room = LONGEST.saturating_sub(whole + 1).max(2);
    let decimals = if known > 2.0 { (known.min(room as f64)) as usize } else { 2 };
    fixed(frequency, decimals)
}

fn quality(value: Option<f64>) -> String {
    value.map_or("none".to_owned(), |value| significant(value, 4))
}

/// How the modes die out; without rows for a bat without damping.
pub fn damping(solution: &Solution) -> Table {
    let columns: [Column<(&Mode, &Damped)>; 6] = [
        Column::new("mode", "", Ratio(0), |(mode, _)| mode.order.into()),
        Column::new("damped frequency, Hz", "", Ratio(2), |(_, one)| {
            (one.swinging() / std::f64::consts::TAU).into()
        }),
        Column::new("ratio", "", Words, |(_, one)| significant(one.ratio, 3).into()),
        Column::new("decay, 1/s", "", Words, |(_, one)| significant(one.decay, 3).into()),
        Column::new("Q, width", "", Words, |(_, one)| quality(one.q_half_power()).into()),
        Column::new("Q, amplitude", "", Words, |(_, one)| quality(one.q_amplitude()).into()),
    ];
    let caption =
        "Damping (Q, width: 1/(2 ratio); Q, amplitude, as papers on bats have it: 1/ratio)";
    let rows: Vec<_> = solution.modes.iter().zip(&solution.damping.modes).collect();
    Table::of(caption, &columns, &rows, Units::Si)
}

/// The nodes of at most that number of modes, a line for each.
pub fn nodes(bat: &Bat, solution: &Solution, most: usize, units: Units) -> Vec<String> {
    /// More would be too long.
    const LISTED: usize = 20;
    let line = |mode: &Mode| {
        let from_tip: Vec<f64> = mode.nodes.iter().rev().map(|x| bat.length() - x).collect();
        let ends = [(&mode.nodes, "knob"), (&from_tip, "tip")];
        let ends = ends.into_iter().filter(|(places, _)| !places.is_empty());
        let ends = ends.map(|(x, end)| format!("{} from the {end}", Length.listed(units, x)));
        let untold = mode
            .untold
            .iter()
            .map(|ends| format!("between {} no other can be told", Length.listed(units, ends)));
        let told: Vec<String> = ends.chain(untold).collect();
        let told = if told.is_empty() { "none".to_owned() } else { told.join("; ") };
        format!("mode {}: {told}", mode.order)
    };
    let mut lines: Vec<String> = solution.modes.iter().take(most.min(LISTED)).map(line).collect();
    if most.min(solution.modes.len()) > LISTED {
        lines.push(format!("those of modes above {LISTED} are in the JSON"));
    }
    lines
}

/// A hit, and the distance of its place from the tip (m).
type HitRow<'a> = (&'a Impact, f64);

/// Hits along a bat: exit speeds, efficiency, vibration and flags by place.
pub fn hits(bat: &Bat, impacts: &[Impact], units: Units) -> Table {
    let columns: [Column<HitRow>; 9] = [
        Column::new("from knob", "", Length, |(hit, _)| hit.x.into()),
        Column::new("from tip", "", Length, |(_, x)| (*x).into()),
        Column::new("bat speed", "", Speed, |(hit, _)| columns::BAT_SPEED.at(hit).into()),
        Column::both("exit speed", "", Speed, |(hit, _)| {
            columns::EXIT_SPEED.at(hit).map_or("no value".into(), Cell::from)
        }),
        Column::new("rigid bat", "", Speed, |(hit, _)| columns::RIGID_EXIT_SPEED.at(hit).into()),
        Column::new("e_A", "", Ratio(3), |(hit, _)| columns::EFFICIENCY.at(hit).into()),
        Column::new("vibration", "", Energy, |(hit, _)| columns::VIBRATION.at(hit).into()),
        Column::new("wall", "", Energy, |(hit, _)| {
            let wall = hit.outcome.as_ref().map(|outcome| outcome.energy.wall);
            wall.filter(|wall| *wall > 0.0).into()
        }),
        Column::new("flags", "", Words, |(hit, _)| {
            Some(letters(hit)).filter(|letters| !letters.is_empty()).into()
        }),
    ];
    let rows = impacts.iter().map(|hit| (hit, (bat.length() - hit.x).max(0.0)));
    let rows: Vec<HitRow> = rows.collect();
    Table::of("Hits along the bat", &columns, &rows, units)
}

/// The hits along the barrel, and the meaning of their flags.
pub fn impacts(bat: &Bat, impacts: &[Impact], units: Units) -> Vec<Part<'static>> {
    vec![Part::Table(hits(bat, impacts, units)), Part::List(legend(impacts))]
}

/// A hoop mode, and the distance from the tip where it moves most (m).
pub type HoopRow = (HoopMode, f64);

/// The columns of hoop modes.
pub const HOOP_MODES: [Column<HoopRow>; 8] = [
    Column::new("n", "harmonic", Ratio(0), |(mode, _)| mode.harmonic.into()),
    Column::new("m", "order", Ratio(0), |(mode, _)| mode.order.into()),
    Column::new("frequency, Hz", "frequency_hz", Ratio(2), |(mode, _)| mode.frequency_hz.into()),
    Column::in_files("damping_ratio", |(mode, _)| mode.damping_ratio.into()),
    Column::in_files("error", |(mode, _)| mode.error.into()),
    Column::new("relative error", "", Words, |(mode, _)| within(mode.error).into()),
    Column::in_files("largest_at_m", |(mode, _)| mode.largest_at_m.into()),
    Column::both("from tip", "largest_from_tip_m", Length, |(_, x)| (*x).into()),
];

/// The lowest hoop modes of a barrel: waves around and number along, frequencies with their errors, and where
/// they move most.
pub fn hoop_modes(bat: &Bat, hoop: &Hoop, most: usize, units: Units) -> Table {
    let row = |mode: &&HoopMode| ((*mode).clone(), (bat.length() - mode.largest_at_m).max(0.0));
    let rows: Vec<HoopRow> = hoop.lowest(most).iter().map(row).collect();
    let [from, to] = [hoop.from(), hoop.to()].map(|x| Length.said(units, x));
    let caption = format!(
        "The wall as an elastic solid from {from} to {to} from the knob end; n waves around, m along, where \
         each moves most"
    );
    Table::of(caption, &HOOP_MODES, &rows, units)
}

/// The sweet spot by a definition, and its distance from the tip (m).
type SpotRow = (SpotLine, f64);

const SPOTS: [Column<SpotRow>; 3] = [
    Column::new("by", "", Words, |(line, _)| line.what.as_str().into()),
    Column::both("from knob", "", Length, |(line, _)| line.x.into()),
    Column::both("from tip", "", Length, |(_, x)| (*x).into()),
];

/// The sweet spot by each of its definitions.
pub fn sweet_spots(bat: &Bat, spot: &SweetSpot, units: Units) -> Table {
    let row = |line: SpotLine| {
        let from_tip = bat.length() - line.x;
        (line, from_tip)
    };
    let rows: Vec<SpotRow> = spot_lines(bat, spot, units).into_iter().map(row).collect();
    Table::of("Sweet spot", &SPOTS, &rows, units)
}

/// The sweet spot by each definition, from knob and tip.
pub fn sweet_spot(bat: &Bat, spot: &SweetSpot, units: Units) -> Vec<Part<'static>> {
    let coarse = spot.looked_every.map(|apart| {
        Part::Text(format!(
            "Places were tried every {} only: the bat hits the ball again there, and all places would take more \
             than about ten times as long as a usual hit. A narrower peak may be missed.",
            Quantity::Small.said(units, apart)
        ))
    });
    [Part::Table(sweet_spots(bat, spot, units))].into_iter().chain(coarse).collect()
}

/// The energies of the best hit; empty where no ball is hit.
pub fn ledger(figures: &Figures, units: Units) -> Table {
    const LARGEST: usize = 3;
    let Scale { per, name: unit, .. } = Quantity::Energy.scale(units.us_first());
    let mut table = Table::new("Energy of the hit at the sweet spot", &["Energy", unit, "%"]);
    let best = figures.best.as_ref().and_then(|best| best.outcome.as_ref());
    let Some(Outcome { energy, .. }) = best else { return table };
    let mut line = |what: &str, value: f64| {
        let share = 100.0 * value / energy.initial;
        let hundredths = |value: f64| format!("{:.2}", value + 0.0);
        let share = if share.is_finite() { hundredths(share) } else { NONE.to_owned() };
        table.row([what.to_owned(), hundredths(per * value), share]);
    };
    line("before: ball and bat together", energy.initial);
    line("after: the ball flies on with", energy.ball);
    line("the bat's swing keeps", energy.bat_rigid);
    line("the bat's vibration takes", energy.vibration);
    let (first, others) =
        energy.vibration_by_mode.split_at(energy.vibration_by_mode.len().min(LARGEST));
    for (k, mode) in first.iter().enumerate() {
        line(&format!("  of it mode {}", k + 1), *mode);
    }
    if !others.is_empty() {
        line("  of it all others", others.iter().sum());
    }
    line("lost in the ball", energy.dissipated_ball);
    line("lost by the bat's damping", energy.dissipated_damping);
    if energy.wall != 0.0 {
        line("in the barrel's wall", energy.wall);
    }
    // An empirical model loses some energy; in all others this is round-off and of no interest to readers.
    if energy.imbalance.abs() > 1e-6 * energy.initial {
        line("not accounted for by this model", energy.imbalance);
    }
    table
}

/// The figures by which bats are compared; empty where no ball is hit.
pub fn figures(figures: &Figures, units: Units) -> Table {
    let mut table = Table::of_words(STATED, &["Figure", "Value"]);
    let Some(best) = &figures.best else { return table };
    let Some(outcome) = &best.outcome else { return table };
    table.row(["bat speed there".to_owned(), Speed.said(units, best.bat_speed)]);
    table.row(["impulse on the ball".to_owned(), Quantity::Impulse.said(units, outcome.impulse)]);
    if let Some(time) = outcome.contact_time {
        table.row(["time of contact".to_owned(), format!("{:.3} ms", 1e3 * time)]);
    }
    if let Some(force) = outcome.peak_force {
        table.row(["largest force".to_owned(), Quantity::Force.said(units, force)]);
    }
    stated(figures, units).into_iter().for_each(|(what, value)| table.row([what, value]));
    table
}

/// How the sweet spots and the best speed move with the scene; empty where no ball is hit.
pub fn moves(bat: &Bat, figures: &Figures, units: Units) -> Table {
    let us = units.us_first();
    let Scale { per, decimals, name } = Quantity::Small.scale(us);
    let caption = format!("How the sweet spots move towards the tip, {name}");
    let mut head = vec!["if", "fastest ball", "least vibration", "least hand speed"];
    head.extend(bat.damped().then_some("least hand shaking"));
    head.push("best speed");
    let mut table = Table::new(caption, &head);
    let spot = &figures.spot;
    if spot.exit_speed_max.is_none() {
        return table;
    }
    for Moved { change, sweet_spot: moved } in &figures.moves {
        let by = |of: fn(&SweetSpot) -> Option<Peak>| match (of(spot), of(moved)) {
            (Some(before), Some(after)) => signed(per * (after.x - before.x), decimals),
            _ => NONE.to_owned(),
        };
        let faster = spot.exit_speed_max.zip(moved.exit_speed_max);
        let faster = faster.map(|(a, b)| Quantity::Speed.scale(us).change(b.value - a.value));
        let mut cells = vec![
            change.clone(),
            by(|s| s.exit_speed_max),
            by(|s| s.vibration_min),
            by(|s| s.hands_velocity_min),
        ];
        cells.extend(bat.damped().then(|| by(|s| s.hands_acceleration_min)));
        cells.push(faster.unwrap_or(NONE.to_owned()));
        table.row(cells);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As many digits as are known and fit: at least two decimals, and no wrong digit.
    #[test]
    fn a_frequency_has_the_digits_that_are_known() {
        for (frequency, error, shown) in [
            (174.508_543_21, 1e-5, "174.51"),
            (174.508_543_21, 1e-10, "174.50854"),
            (0.320_123_456_7, 7e-14, "0.3201235"),
            (0.320_123_456_7, 1e-2, "0.32"),
            (1_854.825_6, 1e-12, "1854.8256"),
        ] {
            assert_eq!(as_known(frequency, error), shown, "{frequency} {error}");
        }
    }
}
