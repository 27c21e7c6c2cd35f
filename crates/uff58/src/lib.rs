//! Universal files: the ASCII format in which modal test programs exchange geometry, mode shapes and measured
//! functions. The crate uses only errors and file reading of `sweetspot`.
//!
//! A universal file is a list of datasets. Each is enclosed in two fences, lines with `-1` in columns 5 and 6. Its
//! first line is its number, followed by Fortran records, which have fields of fixed widths:
//!
//! ```text
//!     -1
//!     82
//!          1         3         0
//! bat
//!          1         2         3
//!     -1
//! ```
//!
//! | dataset | holds | here |
//! |---|---|---|
//! | 151 | header: files, programs, dates | [`Header`] |
//! | 164 | units | [`Units`] |
//! | 15, 2411 | nodes, in six digits or in all | [`Nodes`] |
//! | 82 | a line through nodes | [`TraceLine`] |
//! | 55, 2414 | data at nodes: mode shapes; the newer form is read only | [`NodalData`] |
//! | 58, 58b | functions at a node: frequency responses, records in time | [`Function`] |
//!
//! Other datasets are skipped on reading, with a note. A file whose dataset 164 gives units other than SI is converted
//! to SI; without this dataset the numbers are not changed.
//!
//! # Digits
//!
//! Dataset 2411 has 17 significant digits, 15 and 55 have six, 58 in double precision has 13 for
//! its values and six for its abscissa ([`six_digits`]).
//!
//! # Source
//!
//! The dataset descriptions of SDRC I-DEAS as the University of Cincinnati's Structural Dynamics
//! Research Laboratory keeps them and `pyuff` 2.5.8 repeats them (`pyuff.UFF` and the structure
//! texts of its datasets); the byte layout of 58b from the same place.

#![forbid(unsafe_code)]

pub mod number;
mod stamp;
mod lines;
mod units;
mod read_function;
mod read;
mod write;

pub use lines::at_line;
pub use read::{parse, parse_in, read};
pub use stamp::Stamp;
pub use units::Units;
pub use write::write;

/// A real and an imaginary part.
pub type Complex = [f64; 2];

/// A universal file that was read, in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Universal {
    /// Datasets, in the order of the file.
    pub datasets: Vec<Dataset>,
    /// The line of each dataset's number in the file, from 1.
    pub lines: Vec<usize>,
    /// Datasets that this crate does not read.
    pub skipped: Vec<Skipped>,
    /// The units the file was written in, if they were not SI.
    pub converted_from: Option<Units>,
}

impl Universal {
    /// Whether the file names its units.
    pub fn names_units(&self) -> bool {
        self.datasets.iter().any(|dataset| matches!(dataset, Dataset::Units(_)))
    }

    /// The nodes of all datasets.
    pub fn nodes(&self) -> impl Iterator<Item = &Node> {
        let lists = self.datasets.iter().filter_map(|dataset| match dataset {
            Dataset::Nodes(nodes) => Some(&nodes.nodes),
            _ => None,
        });
        lists.flatten()
    }

    /// The data at nodes.
    pub fn nodal_data(&self) -> impl Iterator<Item = &NodalData> {
        self.datasets.iter().filter_map(|dataset| match dataset {
            Dataset::NodalData(data) => Some(data),
            _ => None,
        })
    }

    /// The functions, each with the index of its dataset.
    pub fn functions(&self) -> impl Iterator<Item = (usize, &Function)> {
        self.datasets.iter().enumerate().filter_map(|(k, dataset)| match dataset {
            Dataset::Function(function) => Some((k, &**function)),
            _ => None,
        })
    }
}

/// A dataset that was not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Skipped {
    /// Number of the dataset.
    pub number: i64,
    /// The line of that number in the file, from 1.
    pub line: usize,
}

/// One dataset.
#[derive(Debug, Clone, PartialEq)]
pub enum Dataset {
    /// 151.
    Header(Header),
    /// 164.
    Units(Units),
    /// 2411 or 15.
    Nodes(Nodes),
    /// 82.
    TraceLine(TraceLine),
    /// 55, or 2414 with data at nodes.
    NodalData(NodalData),
    /// 58.
    Function(Box<Function>),
}

/// Dataset 151: the content of the file and its author.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Header {
    /// The model file.
    pub model: String,
    /// Description of the model.
    pub description: String,
    /// The program that made the model.
    pub made_by: String,
    /// When the model was made.
    pub created: Stamp,
    /// When the model was last changed.
    pub saved: Stamp,
    /// When this file was written.
    pub written: Stamp,
    /// Version of the model's database, in two parts.
    pub version: [i64; 2],
    /// The program that wrote this file.
    pub written_by: String,
}

/// Dataset 2411, or 15 with six digits.
#[derive(Debug, Clone, PartialEq)]
pub struct Nodes {
    /// Nodes, in the order of the file.
    pub nodes: Vec<Node>,
    /// Whether this is dataset 15, obsolete and read by older programs, in place of 2411.
    pub legacy: bool,
}

/// A node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Number of the node, by which other datasets name it.
    pub label: i64,
    /// Coordinate systems of `at` and of displacements; 0 is the global one.
    pub systems: [i64; 2],
    /// Number of a colour; programs differ in which.
    pub color: i64,
    /// Position of the node (m).
    pub at: [f64; 3],
}

impl Node {
    /// A node in the global system.
    pub fn new(label: i64, at: [f64; 3]) -> Self {
        Self { label, systems: [0; 2], color: 0, at }
    }
}

/// Dataset 82: a line through nodes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TraceLine {
    /// Number of the line.
    pub number: i64,
    /// Number of a colour; programs differ in which.
    pub color: i64,
    /// Name of the line.
    pub name: String,
    /// Labels of nodes; 0 lifts the pen. At most [`TraceLine::MOST`].
    pub nodes: Vec<i64>,
}

impl TraceLine {
    /// The most nodes of a line.
    pub const MOST: usize = 250;
}

/// Dataset 55: data at nodes, of one mode or one step.
#[derive(Debug, Clone, PartialEq)]
pub struct NodalData {
    /// Five lines of text.
    pub ids: [String; 5],
    /// Type of the model: 0 unknown, 1 structural.
    pub model: i64,
    /// Of which mode, frequency or step the values are.
    pub analysis: Analysis,
    /// 1 a scalar, 2 translations x, y, z, 3 translations and rotations about x, y, z, 4 a
    /// symmetric and 5 a general tensor.
    pub characteristic: i64,
    /// The quantity of the values: 8 displacement, 11 velocity, 12 acceleration, …
    pub quantity: i64,
    /// Whether the file has imaginary parts.
    pub complex: bool,
    /// Numbers per node.
    pub per_node: usize,
    /// Label and values of every node; the imaginary parts of real data are 0. A node that is missing has zeros.
    pub values: Vec<(i64, Vec<Complex>)>,
}

impl NodalData {
    /// Translations in x, y, z.
    pub const TRANSLATIONS: i64 = 2;
    /// Translations in and rotations about x, y, z.
    pub const MOTIONS: i64 = 3;
}

/// The kind of analysis in dataset 55.
#[derive(Debug, Clone, PartialEq)]
pub enum Analysis {
    /// 2: a real mode.
    NormalMode {
        /// Number of the load case.
        load_case: i64,
        /// Number of the mode.
        mode: i64,
        /// Frequency (Hz).
        frequency: f64,
        /// Modal mass of the shape with the scale in the file (kg m², or kg where displacements are numbers).
        modal_mass: f64,
        /// Damping ratio of dashpots.
        viscous: f64,
        /// Damping ratio of hysteresis.
        hysteretic: f64,
    },
    /// 3, and 7 where `second_order`: a complex mode.
    ComplexMode {
        /// Whether it is of type 7, of a system of second order.
        second_order: bool,
        /// Number of the load case.
        load_case: i64,
        /// Number of the mode.
        mode: i64,
        /// Eigenvalue (rad/s).
        eigenvalue: Complex,
        /// Modal A of the state space, as in the file except for units.
        modal_a: Complex,
        /// Modal B of the state space, as in the file except for units.
        modal_b: Complex,
    },
    /// 5: the answer at one frequency.
    FrequencyResponse {
        /// Number of the load case.
        load_case: i64,
        /// Number of the frequency.
        step: i64,
        /// Frequency (Hz).
        frequency: f64,
    },
    /// Any other type, with its integers and reals unchanged.
    Other {
        /// Number of the type.
        kind: i64,
        /// Integers of the record, the load case first.
        integers: Vec<i64>,
        /// Reals of the record.
        reals: Vec<f64>,
    },
}

/// Dataset 58: a function at a degree of freedom.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// Five lines of text.
    pub ids: [String; 5],
    /// 0 unknown, 1 record in time, 2 auto and 3 cross spectrum, 4 frequency response, 6
    /// coherence, 9 power spectral density, …
    pub kind: i64,
    /// Number of the function.
    pub number: i64,
    /// Version of the function.
    pub version: i64,
    /// Number of the load case; 0 for a force at one point.
    pub load_case: i64,
    /// Node and direction of the response.
    pub response: Dof,
    /// Node and direction of the force.
    pub reference: Dof,
    /// The abscissae of its values, such as frequencies (Hz) or times (s).
    pub abscissa: Abscissa,
    /// The values, one for each abscissa.
    pub values: Values,
    /// Whether values have 13 digits in the file instead of six.
    pub double: bool,
    /// Value on the third axis.
    pub z: f64,
    /// Abscissa, ordinate (numerator), denominator of the ordinate, third axis.
    pub axes: [Axis; 4],
}

/// A node and one of its directions.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Dof {
    /// Name of the component.
    pub entity: String,
    /// Label of the node.
    pub node: i64,
    /// 0 scalar, 1 to 3 along x, y, z, 4 to 6 about them; negative: against it.
    pub direction: i64,
}

/// The abscissae of a function; six digits in the file.
#[derive(Debug, Clone, PartialEq)]
pub enum Abscissa {
    /// At even steps.
    Even {
        /// The first place, in the unit of its axis.
        start: f64,
        /// Distance from one place to the next, in the unit of the axis.
        step: f64,
    },
    /// Each place by itself.
    Uneven(Vec<f64>),
}

impl Abscissa {
    /// Place of value `k` on the axis.
    pub fn at(&self, k: usize) -> f64 {
        match self {
            Self::Even { start, step } => start + k as f64 * step,
            Self::Uneven(places) => places[k],
        }
    }
}

/// The values of a function.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Such as a record in time or a power spectrum.
    Real(Vec<f64>),
    /// Such as a frequency response.
    Complex(Vec<Complex>),
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Real(values) => values.len(),
            Self::Complex(values) => values.len(),
        }
    }

    /// Whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The quantity of an axis of a function.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Axis {
    /// 0 unknown, 1 general, 8 displacement, 11 velocity, 12 acceleration, 13 force, 17 time, 18
    /// frequency, …
    pub quantity: i64,
    /// Exponents of length, force and temperature, of a general quantity.
    pub exponents: [i64; 3],
    /// Label of the axis, such as `force`.
    pub label: String,
    /// Name of the unit, such as `N`; the numbers are in SI regardless of it.
    pub unit: String,
}

/// The nearest number that an abscissa, or a value of dataset 55, can be in a file.
pub fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
