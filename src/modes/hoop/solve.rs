//! What are the hoop modes of a bat, as accurately as asked?

use std::f64::consts::TAU;

use serde::Serialize;

use crate::base::error::{Error, Result};
use crate::base::golden;
use crate::base::threads;
use crate::bat::body::Bat;
use crate::beam::wall::extent::{Extent, Limit};
use crate::beam::wall::layers::Layers;
use crate::beam::wall::unknowns::EndHold;
use crate::modes::hoop::climb::{Climb, thinnest};
use crate::modes::hoop::request::{HoopRequest, KnobSide};
use crate::modes::hoop::spectrum::Spectrum;

/// A mode of the wall.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HoopMode {
    /// Waves around the barrel, n: the motion is proportional to cos nθ.
    pub harmonic: usize,
    /// Index of the mode among those of its harmonic, from 1.
    pub order: usize,
    /// Angular frequency (rad/s).
    #[serde(skip)]
    pub omega: f64,
    /// Natural frequency (Hz).
    pub frequency_hz: f64,
    /// Share of critical damping.
    // Half the loss factor of the wall.
    pub damping_ratio: f64,
    /// Possible relative error of the frequency.
    pub error: f64,
    /// Place of the largest radial motion of the outer surface (m).
    pub largest_at_m: f64,
}

/// Motion of the outer surface along the barrel, scaled to a largest radial motion of 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Outline {
    /// Places (m), rising.
    pub x_m: Vec<f64>,
    /// Outwards, times cos nθ.
    pub radial: Vec<f64>,
    /// Around the barrel, times sin nθ.
    pub around: Vec<f64>,
    /// Towards the tip, times cos nθ.
    pub along: Vec<f64>,
}

/// Assumptions and warnings.
#[derive(Debug, Clone, PartialEq)]
pub enum Note {
    /// The wall is so thin that round-off matters.
    ThinWall {
        /// Place where it is thinnest relative to its radius (m).
        at: f64,
        /// Thickness there (m).
        thickness: f64,
        /// Radius there (m).
        radius: f64,
    },
    /// The model begins beyond a step at which the walls do not meet.
    BeginsBeyondStep {
        /// Place of the step (m).
        at: f64,
    },
    /// The model begins where the wood ends.
    BeginsBeyondWood {
        /// Place where the wood ends (m).
        at: f64,
    },
    /// The bore is open at the tip: the file has no end cap.
    OpenTip,
    /// Tape or weights on the modelled stretch, whose mass is not included in the wall.
    WithoutMasses,
}

/// Hoop modes of a bat.
#[derive(Debug, Clone)]
pub struct Hoop {
    from: f64,
    to: f64,
    spectra: Vec<Spectrum>,
    modes: Vec<HoopMode>,
    notes: Vec<Note>,
    met: bool,
}

/// Highest frequency up to which modes may be asked for (Hz).
const MOST_HZ: f64 = 1e6;
/// Walls thinner than this share of their radius get a warning.
const THIN: f64 = 1.0 / 300.0;

impl Hoop {
    /// The hoop modes of a hollow bat.
    ///
    /// The stretch from the handle to the tip is a solid of revolution. Its modes in the handle depend on the cut and
    /// are omitted. Every harmonic is solved on two meshes, the second with a higher degree along and across and finer
    /// towards ends, kinks and corners. The result is that of the second mesh, and the difference is its stated error.
    /// While the error exceeds the tolerance, both meshes are refined.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a solid bat, a wall of wood, walls that do not meet in the barrel, and an impossible
    /// request; [`Error::NotConverged`] if an iteration fails.
    pub fn of(bat: &Bat, request: &HoopRequest) -> Result<Self> {
        let tol = request.tol;
        if !(tol > 0.0 && tol < 1.0) {
            return Err(Error::value("tol", tol, "a number above 0 and below 1"));
        }
        if !(0.0..=MOST_HZ).contains(&request.up_to_hz) {
            let expected = format!("0 to {MOST_HZ:e} Hz");
            return Err(Error::value("up_to_hz", request.up_to_hz, expected));
        }
        // The error of the cut in the handle falls by a factor of ten about every two radii.
        let lead = 2.5 * (1e-4 / tol).log10().max(0.0);
        let mut extent = Extent::of(bat, lead)?;
        let cut = extent.limit == Limit::Handle;
        let (mut hoop, cut_off) = Self::solved(bat, [extent.from, extent.to], cut, request)?;
        if cut && cut_off > 0.5 {
            // High modes may reach far into a thin handle; then all of it is modelled.
            extent = Extent::of(bat, f64::INFINITY)?;
            hoop = Self::solved(bat, [extent.from, extent.to], false, request)?.0;
        }
        match extent.limit {
            Limit::Step => hoop.notes.push(Note::BeginsBeyondStep { at: extent.from }),
            Limit::Wood => hoop.notes.push(Note::BeginsBeyondWood { at: extent.from }),
            Limit::Handle | Limit::Knob => {}
        }
        let (fixtures, from) = (bat.fixtures(), extent.from);
        let on_it = fixtures.attachments.iter().any(|a| a.mass > 0.0 && a.x > from);
        if on_it || fixtures.tapes.iter().any(|tape| tape.mass > 0.0 && tape.to > from) {
            hoop.notes.push(Note::WithoutMasses);
        }
        Ok(hoop)
    }

    /// The `count` lowest modes of n ≥ 2 within `tol`, with all other modes of their harmonics below the highest of
    /// them, and at least three of each.
    ///
    /// # Errors
    ///
    /// As [`Self::of`].
    pub fn first(bat: &Bat, count: usize, tol: f64) -> Result<Self> {
        const LAST: usize = 20;
        // A coarse mesh shows which harmonics have one of them.
        let rough = |n: usize, least: usize, up_to_hz: f64| -> Result<Vec<f64>> {
            let harmonics = vec![n];
            let request =
                HoopRequest { tol: 0.1, harmonics, up_to_hz, least, ..HoopRequest::default() };
            Ok(Self::of(bat, &request)?.modes.iter().map(|mode| mode.frequency_hz).collect())
        };
        let mut known = rough(2, count, 0.0)?;
        let mut harmonics = vec![2];
        let mut top = known.get(count.saturating_sub(1)).copied().unwrap_or(0.0);
        for n in 3..=LAST {
            let own = rough(n, 1, top)?;
            if own.first().is_none_or(|lowest| *lowest > top) {
                break;
            }
            harmonics.push(n);
            known.extend(own);
            known.sort_by(f64::total_cmp);
            known.truncate(count);
            top = known[known.len() - 1];
        }
        let (up_to_hz, least) = ((1.01 * top).min(MOST_HZ), 3);
        Self::of(bat, &HoopRequest { tol, harmonics, up_to_hz, least, ..HoopRequest::default() })
    }

    /// The hoop modes of a stretch of a bat (m), cut off at both ends.
    ///
    /// # Errors
    ///
    /// As [`Self::of`].
    pub fn between(bat: &Bat, stretch: [f64; 2], request: &HoopRequest) -> Result<Self> {
        Ok(Self::solved(bat, stretch, stretch[0] > 0.0, request)?.0)
    }

    /// The modes of a stretch. If it is `cut` off in the handle, modes that ring there are omitted. Also returns the
    /// error of the cut as a share of the allowed error.
    fn solved(
        bat: &Bat,
        [from, to]: [f64; 2],
        cut: bool,
        request: &HoopRequest,
    ) -> Result<(Self, f64)> {
        let layers = Layers::of(bat, from, to)?;
        let ends = match request.end {
            KnobSide::Free => [EndHold::Free; 2],
            KnobSide::Clamped => [EndHold::Clamped, EndHold::Free],
        };
        let climb = Climb::new(&layers, ends, cut, request);
        let solved =
            threads::map(request.harmonics.len(), |k| climb.harmonic(request.harmonics[k]));
        let solved = solved.into_iter().collect::<Result<Vec<_>>>()?;
        let met = solved.iter().all(|of| of.met);
        let modes = solved.iter().flat_map(|of| modes(&of.spectrum, &of.errors)).collect();
        let cut_off = solved.iter().map(|of| of.cut).fold(0.0, f64::max);
        let notes = notes(&layers);
        let spectra = solved.into_iter().map(|of| of.spectrum).collect();
        Ok((Self { from, to, spectra, modes, notes, met }, cut_off))
    }

    /// All modes that were kept, by harmonic, then order.
    pub fn modes(&self) -> &[HoopMode] {
        &self.modes
    }

    /// The lowest modes of n ≥ 2, by rising frequency.
    pub fn lowest(&self, count: usize) -> Vec<&HoopMode> {
        let mut lowest: Vec<&HoopMode> = self.modes.iter().filter(|m| m.harmonic >= 2).collect();
        lowest.sort_by(|a, b| a.omega.total_cmp(&b.omega));
        lowest.truncate(count);
        lowest
    }

    /// Whether every stated error is within the tolerance.
    pub fn met(&self) -> bool {
        self.met
    }

    /// Where the modelled stretch begins (m).
    pub fn from(&self) -> f64 {
        self.from
    }

    /// Where it ends (m).
    pub fn to(&self) -> f64 {
        self.to
    }

    /// Assumptions and warnings.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Modal mass of mode `mode` of [`Self::modes`] (kg), for a largest radial motion of the outer surface of 1:
    /// `M = π ∫∫ρ(U² + V² + W²) r dr dx`, with 2π in place of π for n = 0.
    pub fn modal_mass(&self, mode: usize) -> f64 {
        let asked = &self.modes[mode];
        let of_harmonic = |spectrum: &&Spectrum| spectrum.system.n == asked.harmonic;
        let spectrum = self.spectra.iter().find(of_harmonic).expect("every mode has its harmonic");
        let [largest, ..] =
            spectrum.system.surface(&spectrum.motions[asked.order - 1], asked.largest_at_m);
        let turn = if asked.harmonic == 0 { TAU } else { 0.5 * TAU };
        turn / (largest * largest)
    }

    /// The motion of the outer surface in mode `mode` of [`Self::modes`] at the given number of even places.
    pub fn outline(&self, mode: usize, points: usize) -> Outline {
        let asked = &self.modes[mode];
        let of_harmonic = |spectrum: &&Spectrum| spectrum.system.n == asked.harmonic;
        let spectrum = self.spectra.iter().find(of_harmonic).expect("every mode has its harmonic");
        let motion = &spectrum.motions[asked.order - 1];
        let scale = 1.0 / spectrum.system.surface(motion, asked.largest_at_m)[0];
        let mut outline = Outline { x_m: vec![], radial: vec![], around: vec![], along: vec![] };
        for k in 0..points {
            let share = k as f64 / (points.max(2) - 1) as f64;
            let x = self.from + (self.to - self.from) * share;
            let [u, v, w] = spectrum.system.surface(motion, x);
            outline.x_m.push(x);
            outline.radial.push(scale * u);
            outline.around.push(scale * v);
            outline.along.push(scale * w);
        }
        outline
    }
}

/// The modes of a harmonic with their stated errors.
fn modes(spectrum: &Spectrum, errors: &[f64]) -> Vec<HoopMode> {
    let each = spectrum.omegas.iter().zip(&spectrum.losses).zip(errors).enumerate();
    let modes = each.map(|(k, ((omega, loss), error))| HoopMode {
        harmonic: spectrum.system.n,
        order: k + 1,
        omega: *omega,
        frequency_hz: omega / TAU,
        damping_ratio: 0.5 * loss,
        error: *error,
        largest_at_m: largest_at(spectrum, k),
    });
    modes.collect()
}

/// Number of samples per column of elements among which the largest motion is sought.
const SAMPLES: usize = 8;

/// Place where the outer surface moves most radially (m).
fn largest_at(spectrum: &Spectrum, mode: usize) -> f64 {
    let motion = &spectrum.motions[mode];
    let size = |x: f64| spectrum.system.surface(motion, x)[0].abs();
    let columns = &spectrum.system.mesh.columns;
    let mut places: Vec<f64> = columns
        .iter()
        .flat_map(|c| (0..SAMPLES).map(|k| c.from + (c.to - c.from) * k as f64 / SAMPLES as f64))
        .collect();
    places.push(columns[columns.len() - 1].to);
    let sizes: Vec<f64> = places.iter().map(|x| size(*x)).collect();
    let k = (0..places.len()).max_by(|&a, &b| sizes[a].total_cmp(&sizes[b])).expect("some place");
    let (low, high) = (places[k.saturating_sub(1)], places[(k + 1).min(places.len() - 1)]);
    let x = golden::least(low, high, |x| -size(x));
    if size(x) > sizes[k] { x } else { places[k] }
}

fn notes(layers: &Layers) -> Vec<Note> {
    let mut notes = vec![];
    let (at, thickness, radius) = thinnest(layers);
    if thickness < THIN * radius {
        notes.push(Note::ThinWall { at, thickness, radius });
    }
    let last = &layers.stretches[layers.stretches.len() - 1];
    if last.radii(last.to)[0] > 0.0 {
        notes.push(Note::OpenTip);
    }
    notes
}
