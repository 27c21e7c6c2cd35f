//! A frequency response, `sweetspot-frf/1`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::{Written, document};
use sweetspot::Theory;
use sweetspot::bat::edit::Edit;
use sweetspot::motion::frf::ResponseKind;

/// Frequency response of a bat to a harmonic unit force at one place, observed at another; the time dependence is e^(+i
/// omega t). SI units, named at the end of each member; positions count from the knob end. Later versions with the same
/// number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Frequency response file of sweetspot, sweetspot-frf/1")]
pub struct FrfFile {
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// The quantity of the response: deflection, velocity or acceleration.
    #[schemars(extend("enum" = ["receptance", "mobility", "accelerance"]))]
    pub kind: &'static str,
    /// Position of the force (m).
    pub at_m: f64,
    /// Position of the response (m).
    pub to_m: f64,
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
    /// Number of bending modes.
    pub modes: usize,
    /// Number of shapes in the response: the modes, and the shapes that replace all higher modes.
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
    /// A measured response for comparison, where one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<MeasuredAnswer>,
    /// Damping ratio of every mode, where the ratios of the measured peaks are used; left out otherwise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub damping_ratios_as_measured: Vec<f64>,
    /// Largest relative error of a mode's frequency.
    pub frequencies_within: f64,
    /// Neglected effects of an assumed damping; left out where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignored: Vec<String>,
}

document!(FrfFile, "frf");

/// The measured frequency responses of one file, each compared with the computed one. Later versions with the same
/// number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Set of frequency responses of sweetspot, sweetspot-frf-set/1")]
pub struct FrfSetFile {
    /// Number of every response in its file, from 1.
    pub functions: Vec<usize>,
    /// The responses in the same order.
    pub responses: Vec<Written<FrfFile>>,
}

document!(FrfSetFile, "frf-set");

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
    /// The magnitude of the response at a peak, in the unit of its kind; null where it has no bound.
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
    /// Frequencies of half power below and above the peak (Hz); null where the response rises again before it falls to
    /// half power, and without damping.
    pub half_power_hz: Option<[f64; 2]>,
}

/// A measured response laid over the computed one.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MeasuredAnswer {
    /// The file it is from.
    pub source: String,
    /// The assumptions made in reading it, one sentence each.
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
    /// The measured peak. Its frequency is that of the highest value. It has a damping ratio if its half-power band has
    /// three frequency steps or more. Null where there is no such peak.
    pub measured: Option<PeakLine>,
    /// Computed over measured frequency, less 1.
    pub frequency_difference: Option<f64>,
    /// 20 log10 of the computed over the measured height (dB).
    pub level_difference_db: Option<f64>,
}
