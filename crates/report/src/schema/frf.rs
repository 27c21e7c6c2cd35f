//! A frequency response, `sweetspot-frf/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::bat::edit::Edit;
use sweetspot::bat::theory::Theory;
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot::motion::frf::ResponseKind;

/// How a bat answers a unit force that swings at one place, seen at another, over frequency; time goes
/// as e^(+i omega t). SI, the unit in every name; positions count from the knob end. Later versions of
/// the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Frequency response file of sweetspot, sweetspot-frf/1")]
pub struct FrfFile {
    /// Name of the format and its version: sweetspot-frf/1.
    pub format: Format<FrfFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What was changed about the bat after it was weighed; left out where nothing was.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// What is answered: deflection, velocity or acceleration.
    #[schemars(extend("enum" = ["receptance", "mobility", "accelerance"]))]
    pub kind: &'static str,
    /// Where the force is (m).
    pub at_m: f64,
    /// Where the answer is seen (m).
    pub to_m: f64,
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
    /// Number of bending modes.
    pub modes: usize,
    /// Number of shapes in the answer, those of the modes and those that stand for all above.
    pub strains: usize,
    /// Deflection under a constant unit force (m/N); of a free bat that of bending alone.
    pub static_compliance_m_per_n: f64,
    /// How many motions are rigid.
    pub rigid_modes: usize,
    /// Frequencies (Hz).
    pub frequency_hz: Vec<f64>,
    /// The answer at every frequency.
    #[serde(flatten)]
    pub answer: ResponseValues,
    /// The peaks between the lowest and the highest frequency.
    pub peaks: Vec<PeakLine>,
    /// A measured response beside it, where one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<MeasuredAnswer>,
    /// Damping ratio of every mode, where they are those of the measured peaks; left out elsewhere.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub damping_ratios_as_measured: Vec<f64>,
    /// Largest relative error of a mode's frequency.
    pub frequencies_within: f64,
}

impl Document for FrfFile {
    const NAME: &'static str = "frf";
}

/// The measured frequency responses of one file, each laid over the computed one. Later versions of the same
/// number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Set of frequency responses of sweetspot, sweetspot-frf-set/1")]
pub struct FrfSetFile {
    /// Name of the format and its version: sweetspot-frf-set/1.
    pub format: Format<FrfSetFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// Number of every response in its file, from 1.
    pub functions: Vec<usize>,
    /// The responses in the same order.
    pub responses: Vec<FrfFile>,
}

impl Document for FrfSetFile {
    const NAME: &'static str = "frf-set";
}

impl FrfSetFile {
    /// These responses with their numbers.
    pub fn new(functions: Vec<usize>, responses: Vec<FrfFile>) -> Self {
        Self { format: Format::new(), generator: Generator::this(), functions, responses }
    }
}

/// Members of a document that a kind of answer counts in its unit, with which their names end.
macro_rules! by_kind {
    ($(#[$about:meta])* $name:ident {
        $($member:ident: $type:ty, $said:literal, $more:literal,
          $per_n:tt $per_s_n:tt $per_kg:tt;)+
    }) => {
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
        #[serde(untagged)]
        pub enum $name {
            /// Deflection per force.
            Receptance {
                $(#[doc = concat!($said, " (m/N)", $more)] #[serde(rename = $per_n)] $member: $type,)+
            },
            /// Velocity per force.
            Mobility {
                $(#[doc = concat!($said, " (m/(s N))", $more)] #[serde(rename = $per_s_n)] $member: $type,)+
            },
            /// Acceleration per force.
            Accelerance {
                $(#[doc = concat!($said, " (1/kg)", $more)] #[serde(rename = $per_kg)] $member: $type,)+
            },
        }

        impl $name {
            /// Those of that kind.
            pub fn of(kind: ResponseKind, $($member: $type),+) -> Self {
                match kind {
                    ResponseKind::Receptance => Self::Receptance { $($member),+ },
                    ResponseKind::Mobility => Self::Mobility { $($member),+ },
                    ResponseKind::Accelerance => Self::Accelerance { $($member),+ },
                }
            }
        }
    };
}

by_kind! {
    /// The answer at every frequency, in the unit of its kind.
    ResponseValues {
        real: Vec<f64>, "Real part", ".", "real_m_per_n" "real_m_per_s_n" "real_1_per_kg";
        imaginary: Vec<f64>, "Imaginary part", ".",
            "imaginary_m_per_n" "imaginary_m_per_s_n" "imaginary_1_per_kg";
        truncation: Vec<f64>,
            "How far it may be off, for what is left out and for the modes' own errors", ".",
            "truncation_m_per_n" "truncation_m_per_s_n" "truncation_1_per_kg";
    }
}

by_kind! {
    /// The size of the answer at a peak, in the unit of its kind; null where it has no bound.
    Height {
        magnitude: Option<f64>, "Size of the answer", "; null without bound.",
            "magnitude_m_per_n" "magnitude_m_per_s_n" "magnitude_1_per_kg";
    }
}

by_kind! {
    /// The measured answer, in the unit of its kind.
    MeasuredValues {
        real: Vec<f64>, "Real part", ".", "real_m_per_n" "real_m_per_s_n" "real_1_per_kg";
        imaginary: Vec<f64>, "Imaginary part", ".",
            "imaginary_m_per_n" "imaginary_m_per_s_n" "imaginary_1_per_kg";
    }
}

/// A peak of the answer.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ResponsePeak")]
pub struct PeakLine {
    /// Number of the mode, from 1: the one of the nearest natural frequency.
    pub mode: usize,
    /// Undamped natural frequency of that mode (Hz).
    pub natural_frequency_hz: f64,
    /// Frequency at which the answer is largest (Hz).
    pub frequency_hz: f64,
    /// How large it is there.
    #[serde(flatten)]
    pub height: Height,
    /// Damping ratio by the half-power points, (f2^2 - f1^2)/(4 f^2); null without them.
    pub damping_ratio: Option<f64>,
    /// Where the answer has half the power, below and above the peak (Hz); null where it rises again
    /// before, and where nothing damps the bat.
    pub half_power_hz: Option<[f64; 2]>,
}

/// A measured response laid over the computed one.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MeasuredAnswer {
    /// The file it is from.
    pub source: String,
    /// What was assumed to read it, a sentence each.
    pub assumed: Vec<String>,
    /// Measured frequencies (Hz).
    pub frequency_hz: Vec<f64>,
    /// The measured answer at every frequency.
    #[serde(flatten)]
    pub answer: MeasuredValues,
    /// Frequency response assurance criterion, |sum a conj(x)|^2/(sum |a|^2 sum |x|^2) over these
    /// frequencies: 1 where computed a and measured x are alike but for a factor.
    pub frac: f64,
    /// Mean of 20 log10(computed/measured) over these frequencies (dB).
    pub mean_level_difference_db: f64,
    /// Mean size of that difference (dB).
    pub mean_absolute_level_difference_db: f64,
    /// Computed peaks and the measured ones near them.
    pub peaks: Vec<PeakBeside>,
}

/// A computed peak and the measured one near it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PeakBeside {
    /// The computed peak.
    pub computed: PeakLine,
    /// The measured one: its frequency is that of the highest value, and it has a damping ratio where
    /// its half-power band has three steps of the measurement or more; null where there is none.
    pub measured: Option<PeakLine>,
    /// Computed over measured frequency, less 1.
    pub frequency_difference: Option<f64>,
    /// 20 log10 of the computed over the measured height (dB).
    pub level_difference_db: Option<f64>,
}
