//! The figures of several bats side by side, and their differences.

use serde::Serialize;

use crate::comparison::contender::{Contender, Figure};
use crate::engine::STANDARD_PIVOT;
use crate::named::named;

named! {
    /// The unit of a row, in SI, as keys of JSON and CSV end.
    pub enum Unit {
        /// Metres (m).
        Metres = "_m",
        /// Kilograms (kg).
        Kilograms = "_kg",
        /// Kilograms times square metres (kg m²).
        KilogramSquareMetres = "_kg_m2",
        /// Hertz (Hz).
        Hertz = "_hz",
        /// Radians per second (rad/s).
        RadiansPerSecond = "_rad_s",
        /// Metres per second (m/s).
        MetresPerSecond = "_m_s",
        /// Joules (J).
        Joules = "_j",
        /// A pure number.
        One = "",
    }
}

/// The end from which a place is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum From {
    /// The value is not a position.
    Nowhere,
    /// The knob end.
    Knob,
    /// The tip.
    Tip,
}

/// One figure of all the bats.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedFigure {
    /// Key in JSON and CSV without the unit, such as `node_1_of_mode_2`.
    pub key: String,
    /// Name for people, without the unit.
    pub name: String,
    /// Unit of the values.
    pub unit: Unit,
    /// The end from which places are measured, if the values are places.
    pub from: From,
    /// A value for each bat that has one.
    pub values: Vec<Option<Compared>>,
}

/// A figure of a bat; its difference is left out for the first bat, and if the first has no such figure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Compared {
    /// The value.
    pub value: f64,
    /// Error of the value.
    pub error: f64,
    /// The difference from the first bat.
    #[serde(flatten)]
    pub difference: Option<Difference>,
    /// One standard deviation of the difference between two pieces of wood, this bat's and the first one's; left out if
    /// it is not known, and if both are one piece.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub between_pieces: Option<f64>,
}

/// How a bat differs from the reference.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Difference {
    /// The value less that of the first bat.
    #[serde(rename = "difference")]
    pub by: f64,
    /// Error of the difference.
    // The errors of both values added.
    #[serde(rename = "difference_error")]
    pub within: f64,
    /// Whether the difference is larger than its error.
    pub beyond_errors: bool,
}

impl ComparedFigure {
    /// The figures of all bats, compared with those of the first.
    pub(crate) fn new(
        (key, name): (&str, &str),
        unit: Unit,
        from: From,
        values: &[Option<Figure>],
    ) -> Self {
        let compared = |(k, other): (usize, &Option<Figure>)| {
            let Figure { value, error } = (*other)?;
            let difference = values[0].filter(|_| k > 0).map(|first| {
                let (by, within) = (value - first.value, first.error + error);
                Difference { by, within, beyond_errors: by.abs() > within }
            });
            Some(Compared { value, error, difference, between_pieces: None })
        };
        let values = values.iter().enumerate().map(compared).collect();
        Self { key: key.to_owned(), name: name.to_owned(), unit, from, values }
    }

    /// Its key with the unit at the end.
    pub fn key_with_unit(&self) -> String {
        format!("{}{}", self.key, self.unit.name())
    }

    /// Difference of a bat from the first; `None` for the first, and if one of them has no value.
    pub fn difference(&self, bat: usize) -> Option<Difference> {
        self.values[bat]?.difference
    }
}

/// Number of modes whose frequencies and nodes are compared.
const MODES: usize = 3;

/// All rows, the bat's body first. Places are there twice: from the knob end and from the tip.
pub fn figures(bats: &[Contender]) -> Vec<ComparedFigure> {
    let mut rows = FigureRows { bats, all: vec![] };
    rows.exact("length", "length", Unit::Metres, |c| c.bat.length());
    rows.exact("mass", "mass", Unit::Kilograms, |c| c.inertia.mass);
    rows.place("balance_point", "balance point", |c| Some(Figure::exact(c.inertia.balance_point)));
    rows.exact("swing_weight", "swing weight (6 in)", Unit::KilogramSquareMetres, |c| {
        c.swing_weight()
    });
    rows.place("center_of_percussion", "percussion centre (6 in)", |c| {
        c.inertia.center_of_percussion(STANDARD_PIVOT).map(Figure::exact)
    });
    for order in 1..=MODES {
        let name = format!("frequency of mode {order}");
        rows.add(&format!("frequency_{order}"), &name, Unit::Hertz, |c| c.frequency(order));
    }
    for order in 1..=MODES {
        let count =
            |c: &Contender| c.sweep.solution.modes.get(order - 1).map_or(0, |m| m.nodes.len());
        for node in 1..=bats.iter().map(count).max().unwrap_or(0) {
            let name = format!("mode {order}, node {node}");
            rows.place(&format!("node_{node}_of_mode_{order}"), &name, |c| c.node(order, node));
        }
    }
    rows.exact("swing", "swing", Unit::RadiansPerSecond, |c| c.scene.swing);
    rows.add("best_exit_speed", "best exit speed", Unit::MetresPerSecond, |c| c.best_speed);
    rows.place("best_place", "  where", |c| c.best_place);
    rows.place("zone_from", "  within 1 % of it from", |c| Some(c.zone?[0]));
    rows.place("zone_to", "  to", |c| Some(c.zone?[1]));
    rows.energy("vibration_at_best", "vibration at the best place", |c| c.vibration);
    rows.energy("least_vibration", "least vibration", |c| c.least_vibration);
    rows.place("least_vibration_place", "  where", |c| c.least_place);
    rows.add("largest_bbcor", "largest BBCOR, free or as held", Unit::One, |c| c.bbcor[0]);
    let name = "largest BBCOR, held at 6 in";
    rows.add("largest_bbcor_pivoted", name, Unit::One, |c| c.bbcor[1]);
    rows.all
}

/// Whether the energies of all bats are relative to the ground, or those of all relative to hands or a clamp; otherwise
/// they belong to different motions.
pub fn energies_compare(bats: &[Contender]) -> bool {
    let held = |c: &Contender| c.bat.fixtures().holding();
    bats.windows(2).all(|pair| held(&pair[0]) == held(&pair[1]))
}

/// The exit speeds at the same distances (m) from the tip, or from the knob end.
pub fn speeds(bats: &[Contender], from: From, distances: &[f64]) -> Vec<ComparedFigure> {
    let row = |distance: &f64| {
        let place = |c: &Contender| match from {
            From::Tip => c.bat.length() - distance,
            _ => *distance,
        };
        let values: Vec<_> = bats.iter().map(|c| c.speed(place(c))).collect();
        let names = ("exit_speed", "exit speed");
        ComparedFigure::new(names, Unit::MetresPerSecond, from, &values)
    };
    distances.iter().map(row).collect()
}

struct FigureRows<'a> {
    bats: &'a [Contender],
    all: Vec<ComparedFigure>,
}

impl FigureRows<'_> {
    fn add(
        &mut self,
        key: &str,
        name: &str,
        unit: Unit,
        of: impl Fn(&Contender) -> Option<Figure>,
    ) {
        let values: Vec<_> = self.bats.iter().map(of).collect();
        self.all.push(ComparedFigure::new((key, name), unit, From::Nowhere, &values));
    }

    fn exact(&mut self, key: &str, name: &str, unit: Unit, of: impl Fn(&Contender) -> f64) {
        self.add(key, name, unit, |c| Some(Figure::exact(of(c))));
    }

    /// An energy, if the energies of all bats are relative to the same frame.
    fn energy(&mut self, key: &str, name: &str, of: impl Fn(&Contender) -> Option<Figure>) {
        let same = energies_compare(self.bats);
        self.add(key, name, Unit::Joules, |c| of(c).filter(|_| same));
    }

    /// A place, in two rows: from the knob end and from the tip.
    fn place(&mut self, key: &str, name: &str, of: impl Fn(&Contender) -> Option<Figure>) {
        self.add(key, name, Unit::Metres, &of);
        self.add(&format!("{key}_from_tip"), name, Unit::Metres, |c| {
            let figure = of(c)?;
            let error = figure.error + Figure::exact(c.bat.length()).error;
            Some(Figure::new(c.bat.length() - figure.value, error))
        });
        let last = self.all.len() - 1;
        self.all[last - 1].from = From::Knob;
        self.all[last].from = From::Tip;
    }
}
