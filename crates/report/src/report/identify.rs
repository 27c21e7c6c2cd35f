//! Modes that measured responses share: table, JSON, CSV, words.

use crate::csv;
use crate::parts::columns::{Columns, first, numbers};
use crate::parts::table::Column;
use crate::parts::terminal::{Piece, wrapped};
use crate::schema::identify::{
    IdentifyFile, IdentifyMode, IdentifyPlace, IdentifyPoint, IdentifySaid,
};
use sweetspot::base::number::{percent, significant};
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot_study::identify::modes::{Identified, SharedMode, placed};
use sweetspot_study::identify::set::{Place, ResponseSet};
use sweetspot_study::tap::heard::Within;
use sweetspot_tap::resonances::Damping;

/// Below this phase collinearity a shape is reported.
const WHIRLING: f64 = 0.9;

/// A set of responses and its modes.
pub struct IdentifyReport<'a> {
    /// The responses.
    pub set: &'a ResponseSet,
    /// Their modes.
    pub found: &'a Identified,
}

impl IdentifyReport<'_> {
    /// Responses, modes and words, 80 columns wide.
    pub fn text(&self) -> [Piece; 3] {
        let warnings: String =
            self.said().iter().map(|one| wrapped(&one.text, 2)).collect();
        let assumed = self.set.assumed.iter().map(|said| wrapped(&format!("note: {said}"), 2));
        let words = warnings + &assumed.collect::<String>();
        [(0, "", self.head()), (1, "modes", self.table()), (2, "words", words)]
    }

    fn head(&self) -> String {
        let Identified { band: [low, high], damping, .. } = self.found;
        let (count, points) = (self.set.responses.len(), self.set.points.len());
        let places: Vec<String> = self.set.references.iter().map(|one| at(one.x)).collect();
        let (places, roved, fixed) = (places.join(" and "), roved(self.set), self.set.fixed());
        let plural = if count == 1 { "" } else { "s" };
        let damped = match damping {
            Damping::Material => "damped as by a loss factor",
            Damping::Dashpots => "damped as by dashpots",
        };
        let [low, high] = [low, high].map(|f| significant(*f, 4));
        wrapped(
            &format!(
                "{count} response{plural}, {low} to {high} Hz: {fixed} at {places}, {roved} at {points} places; {damped}"
            ),
            2,
        )
    }

    fn table(&self) -> String {
        let columns = Columns::new([
            first(20, "frequency"),
            numbers(20, "damping ratio"),
            numbers(9, "in phase"),
            numbers(13, "modal mass"),
            numbers(14, "stable from"),
        ]);
        let row = |mode: &SharedMode| {
            columns.row([
                frequency(&mode.frequency),
                ratio(&mode.damping),
                significant(mode.collinearity, 3),
                mode.modal_mass.map_or("-".to_owned(), |m| format!("{} kg", significant(m, 3))),
                format!("{} of {}", mode.orders[0], mode.orders[1]),
            ])
        };
        match self.found.modes.as_slice() {
            [] => String::new(),
            modes => columns.heads() + &modes.iter().map(row).collect::<String>(),
        }
    }

    /// What is to be said.
    pub fn said(&self) -> Vec<IdentifySaid> {
        let (set, found) = (self.set, self.found);
        let one = |code: &str, text: String| IdentifySaid { code: code.to_owned(), text };
        let mut all = vec![];
        if found.modes.is_empty() {
            let text = "No mode stands out of the noise: is the band the one in which the bat rings, and is every \
                        response of this bat?";
            return vec![one("no_mode", text.to_owned())];
        }
        if set.points.len() < 3 {
            let text = format!(
                "{} point tells no shape: strike more places, three at least and two more than there are modes.",
                set.points.len()
            );
            all.push(one("no_shape", text.replacen("2 point tells", "2 points tell", 1)));
        }
        if found.modes.iter().all(|mode| mode.modal_mass.is_none()) {
            let text = "No modal masses: they need a response whose hammer and accelerometer are at one place.";
            all.push(one("no_drive_point", text.to_owned()));
        }
        let whirls = found.modes.iter().filter(|mode| mode.collinearity < WHIRLING);
        let list: Vec<String> = whirls.map(|mode| frequency(&mode.frequency)).collect();
        if !list.is_empty() {
            let text = format!("Not all points move in phase: {}. Two modes near each other do that.", list.join(", "));
            all.push(one("out_of_phase", text));
        }
        let lowered = found.modes.iter().filter_map(|mode| mode.lowered).fold(0.0, f64::min);
        if lowered < 0.0 {
            let most = percent(-lowered, 2);
            let text = format!("Without the accelerometers' masses the frequencies are higher by up to {most}: these are.");
            all.push(one("masses", text));
        }
        if !found.coherent {
            let text = "The noise is taken from the responses themselves, as there is no coherence.";
            all.push(one("no_coherence", text.to_owned()));
        }
        if found.grids > 1 {
            let text = format!("The responses are over {} different grids of frequencies.", found.grids);
            all.push(one("grids", text));
        }
        all
    }

    /// The `sweetspot-identify/1` document.
    pub fn document(&self) -> IdentifyFile {
        let (set, found) = (self.set, self.found);
        let place = |place: &Place| IdentifyPlace { node: place.node, x_m: place.x };
        let orders = found.orders.iter().map(|poles| poles.iter().map(|pole| pole.hz).collect());
        IdentifyFile {
            format: Format::new(),
            generator: Generator::this(),
            responses: set.responses.len(),
            roved: roved(set).to_owned(),
            references: set.references.iter().map(place).collect(),
            band_hz: found.band,
            damping: match found.damping {
                Damping::Material => "material".to_owned(),
                Damping::Dashpots => "dashpots".to_owned(),
            },
            modes: self.modes(),
            orders_hz: orders.collect(),
            simulated: None,
            warnings: self.said(),
        }
    }

    fn modes(&self) -> Vec<IdentifyMode> {
        let point = |(place, value): (Place, faer::c64)| IdentifyPoint {
            node: place.node,
            x_m: place.x,
            re: value.re,
            im: value.im,
        };
        let one = |mode: &SharedMode| IdentifyMode {
            frequency_hz: mode.frequency.value,
            frequency_interval95_hz: mode.frequency.interval95,
            damping_ratio: mode.damping.value,
            damping_ratio_interval95: mode.damping.interval95,
            phase_collinearity: mode.collinearity,
            modal_mass_kg: mode.modal_mass,
            found_from_order: mode.orders[0],
            lowered: mode.lowered,
            shape: placed(&self.set.points, &mode.shape).map(point).collect(),
        };
        self.found.modes.iter().map(one).collect()
    }

    /// The modes as CSV.
    pub fn csv(&self) -> String {
        csv::rows(&COLUMNS, &self.modes())
    }
}

/// The columns of the modes in files.
const COLUMNS: [Column<IdentifyMode>; 8] = [
    Column::in_files("frequency_hz", |one| one.frequency_hz.into()),
    Column::in_files("frequency_low95_hz", |one| one.frequency_interval95_hz[0].into()),
    Column::in_files("frequency_high95_hz", |one| one.frequency_interval95_hz[1].into()),
    Column::in_files("damping_ratio", |one| one.damping_ratio.into()),
    Column::in_files("damping_ratio_low95", |one| one.damping_ratio_interval95[0].into()),
    Column::in_files("damping_ratio_high95", |one| one.damping_ratio_interval95[1].into()),
    Column::in_files("phase_collinearity", |one| one.phase_collinearity.into()),
    Column::in_files("modal_mass_kg", |one| one.modal_mass_kg.into()),
];

fn roved(set: &ResponseSet) -> &'static str {
    if set.hammer_roves { "hammer" } else { "accelerometers" }
}

fn at(x: f64) -> String {
    format!("{} m", significant(x, 4))
}

/// A frequency with its 95 % interval.
pub fn frequency(within: &Within) -> String {
    let by = 0.5 * (within.interval95[1] - within.interval95[0]);
    let decimals = (1 - by.max(1e-9).log10().floor() as i32).clamp(0, 4) as usize;
    format!("{:.decimals$} Hz ± {by:.decimals$}", within.value)
}

fn ratio(within: &Within) -> String {
    let by = 0.5 * (within.interval95[1] - within.interval95[0]) / within.value.max(1e-12);
    format!("{} ± {}", significant(within.value, 3), percent(by, 1))
}
