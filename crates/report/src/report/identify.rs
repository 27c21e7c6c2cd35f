//! Modes that measured responses share: table, JSON, CSV, words.

use crate::csv;
use crate::parts::{Column, Piece, Shown, counted, first, lines, numbers, wrapped};
use crate::schema::identify::{
    IdentifyFile, IdentifyMode, IdentifyPlace, IdentifyPlanned, IdentifyPoint, IdentifySimulated,
};
use crate::schema::{Said, Written};
use sweetspot::Mode;
use sweetspot::base::number::{percent, significant};
use sweetspot_study::identify::modes::{Identified, SharedMode, placed};
use sweetspot_study::identify::set::{Place, ResponseSet};
use sweetspot_study::identify::simulate::{ASSUMED_LOSS, Simulated, VirtualTest};
use sweetspot_study::tap::heard::Within;
use sweetspot_tap::resonances::Damping;

/// Below this phase collinearity a shape is reported.
const WHIRLING: f64 = 0.9;

/// A mode that moves less at a place, over its largest deflection, is hardly seen there.
const DEAF: f64 = 0.1;
/// A hammer whose force spectrum falls by more within the band (dB) is too soft.
const WEAK: f64 = -20.0;

/// A set of responses and its modes.
pub struct IdentifyReport<'a> {
    /// The responses.
    pub set: &'a ResponseSet,
    /// The modes found.
    pub found: &'a Identified,
    /// The virtual test that they are of, and the bat's name; None where they were measured.
    pub simulated: Option<(&'a Simulated, &'a str)>,
}

impl IdentifyReport<'_> {
    /// Responses, modes and words, 80 columns wide; in full a virtual test also has the table of the modes found.
    pub fn text(&self, full: bool) -> [Piece; 3] {
        let warnings: String = self.said().iter().map(|one| wrapped(&one.text, 2)).collect();
        let assumed = self.set.assumed.iter().map(|said| wrapped(&format!("note: {said}"), 2));
        let words = warnings + &assumed.collect::<String>();
        let table = match self.simulated {
            None => self.table(),
            Some((test, _)) if full => self.planned_table(test) + &self.table(),
            Some((test, _)) => self.planned_table(test),
        };
        [(0, "", self.head()), (1, "modes", table), (2, "words", words)]
    }

    fn head(&self) -> String {
        let Identified { band: [low, high], damping, .. } = self.found;
        let (count, points) = (self.set.responses.len(), self.set.points.len());
        let places: Vec<String> = self.set.references.iter().map(|one| at(one.x)).collect();
        let (places, roved, fixed) = (places.join(" and "), roved(self.set), self.set.fixed());
        let damped = match damping {
            Damping::Material => "damped as by a loss factor",
            Damping::Dashpots => "damped as by dashpots",
        };
        let [low, high] = [low, high].map(|f| significant(*f, 4));
        let test = self.simulated.map_or(String::new(), |(test, bat)| tested(&test.test, bat));
        test + &wrapped(
            &format!(
                "{}, {low} to {high} Hz: {fixed} at {places}, {roved} at {}; {damped}",
                counted(count, "response"),
                counted(points, "place")
            ),
            2,
        )
    }

    fn table(&self) -> String {
        if self.found.modes.is_empty() {
            return String::new();
        }
        let weighed = self.found.modes.iter().any(|mode| mode.modal_mass.is_some());
        let scale = "Modal masses are for the largest measured deflection 1.";
        let scale = if weighed { wrapped(scale, 2) } else { String::new() };
        let columns: &[Shown<SharedMode>] = &[
            (first(20, "frequency"), &|mode| frequency(&mode.frequency)),
            (numbers(20, "damping ratio"), &|mode| ratio(&mode.damping)),
            (numbers(9, "in phase"), &|mode| format!("{:.3}", mode.collinearity)),
            (numbers(13, "modal mass"), &|mode| {
                mode.modal_mass.map_or("-".to_owned(), |m| format!("{} kg", significant(m, 3)))
            }),
            (numbers(14, "stable from"), &|mode| {
                format!("{} of {}", mode.orders[0], mode.orders[1])
            }),
        ];
        lines(&self.found.modes, columns) + &scale
    }

    /// The modes of the bat compared with those found in the virtual test.
    fn planned_table(&self, test: &Simulated) -> String {
        type Planned = (IdentifyPlanned, Option<Within>);
        let signed = |share: f64| format!("{:+.3} %", 100.0 * share).replace("-0.000", "+0.000");
        let found = |(k, _): (usize, f64)| self.found.modes[k].frequency;
        let matched = test.matched(self.found).into_iter().map(|one| one.map(found));
        let rows: Vec<Planned> = self.planned(test).into_iter().zip(matched).collect();
        let columns: &[Shown<Planned>] = &[
            (first(6, "mode"), &|(one, _)| one.order.to_string()),
            (numbers(14, "the bat alone"), &|(one, _)| {
                format!("{} Hz", significant(one.frequency_hz, 6))
            }),
            (numbers(14, "by the masses"), &|(one, _)| signed(one.by_masses)),
            (numbers(26, "found, without them"), &|(_, found)| {
                found.as_ref().map_or("missed".to_owned(), frequency)
            }),
            (numbers(10, "off"), &|(one, found)| {
                found.map_or(String::new(), |found| signed(found.value / one.frequency_hz - 1.0))
            }),
            (numbers(8, "MAC"), &|(one, _)| {
                one.mac.map_or(String::new(), |mac| format!("{mac:.3}"))
            }),
        ];
        lines(&rows, columns)
    }

    fn planned(&self, test: &Simulated) -> Vec<IdentifyPlanned> {
        let matched = test.matched(self.found);
        let one =
            |((mode, loaded), matched): ((&Mode, &f64), Option<(usize, f64)>)| IdentifyPlanned {
                order: mode.order,
                frequency_hz: mode.frequency(),
                by_masses: loaded / mode.frequency() - 1.0,
                found_hz: matched.map(|(k, _)| self.found.modes[k].frequency.value),
                mac: matched.map(|(_, mac)| mac),
            };
        test.modes.iter().zip(&test.loaded).zip(matched).map(one).collect()
    }

    /// Where to suspend the bat and where to put the reference.
    fn advice(&self, test: &Simulated) -> Vec<Said> {
        let [hang, other] = test.hang().map(at);
        let [place, least] = test.reference();
        let fixed = self.set.fixed();
        let hang = format!("Hang the bat at {hang} and {other}: the modes move least there.");
        let mut all =
            if test.bat.fixtures().holding() { vec![] } else { vec![Said::new("hang", hang)] };
        let text = format!(
            "Put the {fixed} at {}: every mode has {} of its largest deflection there, or more.",
            at(place),
            percent(least, 0)
        );
        all.push(Said::new("reference", text));
        let known: Vec<usize> =
            test.matched(self.found).iter().flatten().map(|one| one.0).collect();
        let noise = self.found.modes.iter().enumerate().filter(|(k, _)| !known.contains(k));
        let noise = noise.filter(|(_, mode)| mode.frequency.value < test.test.top);
        let noise: Vec<String> = noise.map(|(_, mode)| frequency(&mode.frequency)).collect();
        if !noise.is_empty() {
            let text = format!("No modes of the bat, but of the noise: {}.", noise.join(", "));
            all.push(Said::new("false_modes", text));
        }
        if test.bat.fixtures().damping() {
            let text = "Hands and absorbers with damping make modes complex, which the fit does not describe: no \
                        interval holds.";
            all.push(Said::new("dashpots", text.to_owned()));
        }
        let own = self.set.references[0].x;
        let deaf = test.modes.iter().filter(|mode| mode.shape.deflection(own).abs() < DEAF);
        let deaf: Vec<String> = deaf.map(|mode| mode.order.to_string()).collect();
        if !deaf.is_empty() {
            let text =
                format!("At {} the {fixed} is near a node of mode {}.", at(own), deaf.join(", "));
            all.push(Said::new("near_node", text));
        }
        if test.force_db < WEAK {
            let text = format!(
                "The hammer's force falls by {:.0} dB within the band: take a harder tip or a lighter hammer.",
                -test.force_db
            );
            all.push(Said::new("weak_force", text));
        }
        if !test.bat.lossy() {
            let text = format!("The bat's materials have no loss factor: {ASSUMED_LOSS} is taken.");
            all.push(Said::new("loss_factor", text));
        }
        all
    }

    /// All warnings.
    pub fn said(&self) -> Vec<Said> {
        let (set, found) = (self.set, self.found);
        let test = self.simulated.filter(|(test, _)| !test.modes.is_empty());
        let mut all = test.map_or(vec![], |(test, _)| self.advice(test));
        if found.modes.is_empty() {
            let text = "No mode stands out of the noise: is the band the one in which the bat rings, and is every \
                        response of this bat?";
            all.push(Said::new("no_mode", text));
            return all;
        }
        if set.points.len() < 3 {
            let text = format!(
                "{} point tells no shape: strike more places, three at least and two more than there are modes.",
                set.points.len()
            );
            all.push(Said::new("no_shape", text.replacen("2 point tells", "2 points tell", 1)));
        }
        if let Some(x) = found.opposite {
            let text = format!(
                "Hammer and accelerometer at {} point opposite ways: turn the sign of the responses over for modal masses.",
                at(x)
            );
            all.push(Said::new("opposite_ways", text));
        } else if found.modes.iter().all(|mode| mode.modal_mass.is_none()) {
            let text = "No modal masses: they need a response whose hammer and accelerometer are at one place.";
            all.push(Said::new("no_drive_point", text.to_owned()));
        }
        let whirls = found.modes.iter().filter(|mode| mode.collinearity < WHIRLING);
        let list: Vec<String> = whirls.map(|mode| frequency(&mode.frequency)).collect();
        if !list.is_empty() {
            let text = format!(
                "Not all points move in phase: {}. Two modes near each other do that.",
                list.join(", ")
            );
            all.push(Said::new("out_of_phase", text));
        }
        let lowered = found.modes.iter().filter_map(|mode| mode.lowered).fold(0.0, f64::min);
        if lowered < 0.0 {
            let most = percent(-lowered, 2);
            let alone = set.hammer_roves && set.references.len() == 1;
            let how = if alone { "" } else { "; the intervals count what one column leaves" };
            let text = format!(
                "The accelerometers' masses lowered the frequencies by up to {most}; that is taken off{how}."
            );
            all.push(Said::new("masses", text));
        }
        all.extend(self.of_responses());
        all
    }

    /// Warnings about the responses themselves.
    fn of_responses(&self) -> Vec<Said> {
        let (set, found) = (self.set, self.found);
        let mut all = vec![];
        if found.coherent < set.responses.len() {
            let why = match found.coherent {
                0 => "as there is no coherence".to_owned(),
                some => format!("as {some} of {} have coherence", set.responses.len()),
            };
            let text = format!("The noise is taken from the responses themselves, {why}.");
            all.push(Said::new("no_coherence", text));
        }
        if found.grids > 1 {
            let text =
                format!("The responses are over {} different grids of frequencies.", found.grids);
            all.push(Said::new("grids", text));
        }
        all
    }

    /// The `sweetspot-identify/1` document.
    pub fn document(&self) -> Written<IdentifyFile> {
        let (set, found) = (self.set, self.found);
        let place = |place: &Place| IdentifyPlace { node: place.node, x_m: place.x };
        let orders = found.orders.iter().map(|poles| poles.iter().map(|pole| pole.hz).collect());
        Written::of(IdentifyFile {
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
            simulated: self.simulated.map(|(test, bat)| IdentifySimulated {
                bat: bat.to_owned(),
                hammer_kg: test.test.hammer,
                tip_n_per_m: test.test.tip,
                accelerometer_kg: test.test.accelerometer,
                noise_db: test.test.noise,
                window_s: test.test.window,
                seed: test.test.seed,
                modes: self.planned(test),
                hang_m: if test.bat.fixtures().holding() { vec![] } else { test.hang().to_vec() },
                reference_m: test.reference()[0],
                reference_least: test.reference()[1],
                force_db: test.force_db,
            }),
            warnings: self.said(),
        })
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

/// The subject of a virtual test.
fn tested(test: &VirtualTest, bat: &str) -> String {
    let VirtualTest { hammer, tip, noise, seed, .. } = test;
    let accelerometer = match test.accelerometer {
        0.0 => "no mass on the bat".to_owned(),
        mass => format!("accelerometer {} g", significant(1e3 * mass, 3)),
    };
    let window = test.window.map_or("no window".to_owned(), |tau| format!("window {tau} s"));
    let text = format!(
        "virtual test of {bat}: hammer {} g, tip {tip:e} N/m, {accelerometer}, noise {noise} dB, {window}, seed {seed}",
        significant(1e3 * hammer, 3)
    );
    wrapped(&text, 2)
}

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
    format!("{} ± {} %", significant(within.value, 3), significant(100.0 * by, 1))
}
