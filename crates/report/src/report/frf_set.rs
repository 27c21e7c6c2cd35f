//! The measured responses of one file compared with the computed ones: a row each.

use crate::csv;
use crate::parts::{Column, Quantity, Units, lines, numbers, wrapped};
use crate::report::frf::{FRAC, ToldResponse, damping};
use crate::report::text::edited;
use sweetspot::Bat;
use sweetspot_study::measured::response::{Laid, MeasuredResponse};

/// A measured response compared with the computed one.
pub struct RowOfSet {
    /// Its number in its file, from 1.
    pub number: usize,
    /// Positions of the force and of the response (m from the knob end).
    places: [f64; 2],
    frac: f64,
    /// Level of the computed response relative to the measured one, and the difference between them (dB).
    level: f64,
    apart: f64,
    /// The number of computed peaks that have a measured one, and the mean relative difference of their frequencies;
    /// None without any.
    pairs: [usize; 2],
    frequencies: Option<f64>,
    /// Remarks about the damping of the computed modes.
    damping: String,
    assumed: Vec<String>,
}

impl RowOfSet {
    /// None without a measured response.
    pub fn new(number: usize, told: &ToldResponse) -> Option<Self> {
        let (MeasuredResponse { assumed, .. }, laid) = told.measured?;
        let Laid { frac, level, apart, peaks, .. } = laid;
        let pairs =
            peaks.iter().filter_map(|(computed, measured)| Some((computed, measured.as_ref()?)));
        let all: Vec<f64> =
            pairs.map(|(computed, m)| (computed.frequency / m.frequency - 1.0).abs()).collect();
        let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
        Some(Self {
            number,
            places: told.places,
            frac: *frac,
            level: *level,
            apart: *apart,
            pairs: [all.len(), peaks.len()],
            frequencies: (!all.is_empty()).then_some(mean),
            damping: damping(told.bat, told.frf),
            assumed: assumed.clone(),
        })
    }
}

/// Rows that a screen has.
const FEW: usize = 18;

/// The rows for people; without `full` those of the least similar responses.
pub fn text(bat: &Bat, source: &str, rows: &[RowOfSet], (units, full): (Units, bool)) -> String {
    let units = units.first();
    let title = format!("Measured frequency responses of {source} beside {}", bat.title());
    let mut out = wrapped(&title, 4) + &edited(bat, units);
    out += &rows.first().map_or(String::new(), |row| row.damping.clone());
    let mut shown: Vec<&RowOfSet> = rows.iter().collect();
    shown.sort_by(|a, b| a.frac.total_cmp(&b.frac));
    let more = if full { 0 } else { rows.len().saturating_sub(FEW) };
    shown.truncate(rows.len() - more);
    shown.sort_by_key(|row| row.number);
    out += &lines(
        shown,
        &[
            (numbers(4, "no."), &|row| row.number.to_string()),
            (numbers(10, "force at"), &|row| Quantity::Length.said(units, row.places[0])),
            (numbers(10, "answer at"), &|row| Quantity::Length.said(units, row.places[1])),
            (numbers(7, "FRAC"), &|row| format!("{:.3}", row.frac)),
            (numbers(11, "higher, dB"), &|row| format!("{:+.1}", row.level)),
            (numbers(10, "apart, dB"), &|row| format!("{:.1}", row.apart)),
            (numbers(9, "peaks"), &|row| format!("{} of {}", row.pairs[0], row.pairs[1])),
            (numbers(13, "frequency, %"), &|row| {
                row.frequencies.map_or("-".to_owned(), |apart| format!("{:.2}", 100.0 * apart))
            }),
        ],
    );
    if more > 0 {
        out += &format!("  and {more} more that are more alike\n");
    }
    out += &wrapped(FRAC, 2);
    let rest = "  no.: its number in the file; higher: the computed response above the measured one on average; apart: the mean size of that \
                difference; peaks: those of the computed response that have a measured one, and by how much their \
                frequencies are apart on average. --function N tells all of one, --plots draws them";
    out += &wrapped(rest, 2);
    let mut said: Vec<&String> = vec![];
    for assumed in rows.iter().flat_map(|row| &row.assumed) {
        if !said.contains(&assumed) {
            out += &wrapped(&format!("  {assumed}"), 2);
            said.push(assumed);
        }
    }
    out
}

/// The columns of the responses.
const COLUMNS: [Column<RowOfSet>; 9] = [
    Column::in_files("response", |row| row.number.into()),
    Column::in_files("at_m", |row| row.places[0].into()),
    Column::in_files("to_m", |row| row.places[1].into()),
    Column::in_files("frac", |row| row.frac.into()),
    Column::in_files("level_db", |row| row.level.into()),
    Column::in_files("apart_db", |row| row.apart.into()),
    Column::in_files("peaks_measured", |row| row.pairs[0].into()),
    Column::in_files("peaks", |row| row.pairs[1].into()),
    Column::in_files("frequencies_apart", |row| row.frequencies.into()),
];

/// A row for each response.
pub fn csv(rows: &[RowOfSet]) -> String {
    csv::rows(&COLUMNS, rows)
}
