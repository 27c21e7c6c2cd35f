//! What does the bat do during and after the contact: motion, strain and stress anywhere, at any time?
//!
//! The recorded force drives every mode. Its pieces are polynomials, so the motion is exact at any instant. Deflections
//! are relative to the swing, and positive in its direction: the ball drives the bat back, into −.
//!
//! ```text
//! v(t) = ∫ e^{s(t−τ)} F dτ,  s = −ζω + iω_d       w = −Σ φ(x) φ(a)/(m ω_d) Im v
//! ε = r θ′,  σ = E ε                              at the outermost fibre
//! ```
//!
//! Dashpots are treated mode by mode. The mass of the hands is not part of the bat.

use faer::c64;

use serde::Serialize;

use crate::bat::Bat;
use crate::collision::contact::collocation::polynomial;
use crate::collision::contact::table::ForcePiece;
use crate::collision::struck::Struck;
use crate::modes::compliance::RigidMotion;
use crate::modes::mode::Mode;
use crate::modes::solve::Solution;
use crate::motion::phi::exponential;
use crate::motion::sound::{Sound, WallTones};

/// A bat driven by a recorded force.
pub struct Aftermath<'a> {
    bat: &'a Bat,
    /// Position at which the force acts (m).
    pub place: f64,
    pieces: Vec<ForcePiece>,
    rigid: Vec<Pushed>,
    modes: Vec<Rung<'a>>,
}

struct Pushed {
    motion: RigidMotion,
    /// `φ(a)/m`.
    gain: f64,
}

struct Rung<'a> {
    mode: &'a Mode,
    s: c64,
    /// `φ(a)/(m ω_d)`.
    gain: f64,
}

/// One instant: displacement, velocity and acceleration of every rigid motion and of every mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    /// Time since the first touch (s).
    pub time: f64,
    /// Force of the ball on the bat (N).
    pub force: f64,
    rigid: Vec<[f64; 3]>,
    modes: Vec<[f64; 3]>,
}

/// A strain, with its place and its instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Strained {
    /// The place (m).
    pub x_m: f64,
    /// The instant (s).
    pub time_s: f64,
    /// Strain of the surface.
    // Without its sign.
    pub strain: f64,
    /// Stress of the surface (Pa).
    pub stress_pa: f64,
}

/// Amplitude of one mode at a place.
// Just after the ball has left.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Line {
    /// Frequency (Hz).
    // Of the undamped mode.
    pub frequency_hz: f64,
    /// Displacement (m).
    pub displacement_m: f64,
    /// Velocity (m/s).
    pub velocity_m_s: f64,
    /// Acceleration (m/s²).
    pub acceleration_m_s2: f64,
}

/// A watched place.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Watched {
    /// The place (m).
    pub x_m: f64,
    /// Time at which it begins to move (s).
    // The velocity first reaches a twentieth of its largest.
    pub begins_s: f64,
    /// The largest motion over the whole time.
    pub peak: PeakMotion,
    /// Times of the largest displacement, velocity and acceleration (s).
    #[serde(skip)]
    pub when: [f64; 3],
    /// The modes at this place when the ball has left.
    pub spectrum: Vec<Line>,
    /// Displacement at every instant (m).
    pub displacement_m: Vec<f64>,
    /// Velocity at every instant (m/s).
    pub velocity_m_s: Vec<f64>,
    /// Acceleration at every instant (m/s²).
    pub acceleration_m_s2: Vec<f64>,
    /// Strain of the surface at every instant.
    pub strain: Vec<f64>,
}

/// The largest motion of a place.
// Without sign.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PeakMotion {
    /// Displacement (m).
    pub displacement_m: f64,
    /// Velocity (m/s).
    pub velocity_m_s: f64,
    /// Acceleration (m/s²).
    pub acceleration_m_s2: f64,
}

impl<'a> Aftermath<'a> {
    /// The solution's bat under that force at `place` (m). Every mode must oscillate.
    pub fn new(bat: &'a Bat, solution: &'a Solution, place: f64, pieces: Vec<ForcePiece>) -> Self {
        let struck = Struck::new(bat, solution);
        let rigid = struck
            .rigid()
            .iter()
            .map(|motion| Pushed { motion: *motion, gain: motion.deflection(place) / motion.mass });
        let modes = solution.modes.iter().zip(struck.modes()).map(|(mode, [omega, ratio])| {
            let swings = omega * ((1.0 - ratio) * (1.0 + ratio)).sqrt();
            let gain = mode.shape.deflection(place) / (mode.modal_mass * swings);
            Rung { mode, s: c64::new(-ratio * omega, swings), gain }
        });
        Self { bat, place, rigid: rigid.collect(), modes: modes.collect(), pieces }
    }

    /// Time at which the ball leaves (s).
    pub fn end(&self) -> f64 {
        self.pieces.last().map_or(0.0, ForcePiece::end)
    }

    /// The bat at those times (s), which must rise.
    pub fn at(&self, when: &[f64]) -> Vec<Instant> {
        let mut instants: Vec<Instant> = when.iter().map(|t| self.still(*t)).collect();
        let driven_by_force = self.pushed(when);
        for (k, pushed) in self.rigid.iter().enumerate() {
            for (instant, [moved, speed]) in instants.iter_mut().zip(&driven_by_force) {
                instant.rigid[k] = [*moved, *speed, instant.force].map(|v| -pushed.gain * v);
            }
        }
        for (k, rung) in self.modes.iter().enumerate() {
            let (mut memory, mut next, s) = (c64::default(), 0, rung.s);
            for instant in &mut instants {
                while let Some(piece) = self.pieces.get(next).filter(|p| p.end() <= instant.time) {
                    memory = piece.drive(s, memory);
                    next += 1;
                }
                let rest = instant.time - self.start_of(next);
                let v = match self.pieces.get(next) {
                    Some(piece) => piece.first(rest.max(0.0)).drive(s, memory),
                    None => exponential(s * rest) * memory,
                };
                let rate = s * v;
                let turned = s * (rate + instant.force);
                instant.modes[k] = [v.im, rate.im, turned.im].map(|value| -rung.gain * value);
            }
        }
        instants
    }

    /// `∫∫F dt²` (N s²) and `∫F dt` (N s) up to those times (s), which must rise: the effect of the force on a unit
    /// mass, such as the ball's.
    pub fn pushed(&self, when: &[f64]) -> Vec<[f64; 2]> {
        let (mut moved, mut speed, mut next) = (0.0, 0.0, 0);
        let until = |time: &f64| {
            while let Some(piece) = self.pieces.get(next).filter(|p| p.end() <= *time) {
                let [by, faster] = piece.push();
                moved += speed * piece.length + by;
                speed += faster;
                next += 1;
            }
            let rest = time - self.start_of(next);
            let [by, faster] = match self.pieces.get(next) {
                Some(piece) if rest > 0.0 => piece.first(rest).push(),
                _ => [0.0; 2],
            };
            [moved + speed * rest + by, speed + faster]
        };
        when.iter().map(until).collect()
    }

    /// Displacement (m), velocity (m/s) and acceleration (m/s²) at `x` (m).
    pub fn motion(&self, x: f64, now: &Instant) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let rigid = self.rigid.iter().map(|pushed| pushed.motion.deflection(x)).zip(&now.rigid);
        let modes = self.modes.iter().map(|rung| rung.mode.shape.deflection(x)).zip(&now.modes);
        for (shape, part) in rigid.chain(modes) {
            sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += shape * part);
        }
        sum
    }

    /// The motion at `x` (m) at those instants.
    pub fn watched(&self, x: f64, instants: &[Instant]) -> Watched {
        let motions: Vec<[f64; 3]> = instants.iter().map(|now| self.motion(x, now)).collect();
        let [mut peak, mut when] = [[0.0; 3]; 2];
        for (motion, now) in motions.iter().zip(instants) {
            for (k, value) in motion.iter().enumerate() {
                if value.abs() > peak[k] {
                    (peak[k], when[k]) = (value.abs(), now.time);
                }
            }
        }
        let [displacement_m, velocity_m_s, acceleration_m_s2] = peak;
        let first = motions.iter().position(|motion| motion[1].abs() >= 0.05 * velocity_m_s);
        let column = |k: usize| motions.iter().map(|motion| motion[k]).collect();
        Watched {
            x_m: x,
            begins_s: first.map_or(0.0, |k| instants[k].time),
            peak: PeakMotion { displacement_m, velocity_m_s, acceleration_m_s2 },
            when,
            spectrum: self.lines(x),
            displacement_m: column(0),
            velocity_m_s: column(1),
            acceleration_m_s2: column(2),
            strain: instants.iter().map(|now| self.strains(&[x], now, self.count())[0]).collect(),
        }
    }

    /// The strain at the outermost fibre at every place (m) at an instant, positive where the side that the ball hits
    /// is stretched.
    pub fn strains(&self, places: &[f64], now: &Instant, count: usize) -> Vec<f64> {
        let bent = |x: &f64| {
            let modes = self.modes.iter().zip(&now.modes).take(count);
            let sum: f64 = modes.map(|(rung, part)| rung.mode.shape.curvature(*x) * part[0]).sum();
            // Avoids −0 at rest.
            0.0 - self.bat.profile().at(*x).outer * sum
        };
        places.iter().map(bent).collect()
    }

    /// The largest strain at those places (m) and instants, with the given number of modes.
    pub fn worst(&self, places: &[f64], instants: &[Instant], count: usize) -> Option<Strained> {
        let envelope = self.envelope(places, instants, count);
        // The first of equal ones.
        envelope.into_iter().reduce(|worst, at| if at.strain > worst.strain { at } else { worst })
    }

    /// The largest strain of every place (m) among those instants, with the given number of modes.
    pub fn envelope(&self, places: &[f64], instants: &[Instant], count: usize) -> Vec<Strained> {
        let at = |x: &f64| {
            let modes = self.modes.iter().take(count);
            let curvature: Vec<f64> = modes.map(|r| r.mode.shape.curvature(*x)).collect();
            let radius = self.bat.profile().at(*x).outer;
            let mut worst = Strained { x_m: *x, time_s: 0.0, strain: 0.0, stress_pa: 0.0 };
            for now in instants {
                let sum: f64 = curvature.iter().zip(&now.modes).map(|(c, part)| c * part[0]).sum();
                let strain = (radius * sum).abs();
                if strain > worst.strain {
                    (worst.time_s, worst.strain) = (now.time, strain);
                }
            }
            Strained { stress_pa: self.modulus(*x) * worst.strain, ..worst }
        };
        places.iter().map(at).collect()
    }

    /// Young's modulus (Pa) of the material at the surface at `x` (m).
    pub fn modulus(&self, x: f64) -> f64 {
        self.bat.layup(self.bat.profile().piece_at(x)).surface().youngs_modulus
    }

    /// The bat that was hit.
    pub fn bat(&self) -> &Bat {
        self.bat
    }

    /// Number of modes.
    pub fn count(&self) -> usize {
        self.modes.len()
    }

    /// The amplitude of every mode at `x` (m) when the ball leaves.
    pub fn lines(&self, x: f64) -> Vec<Line> {
        let Some(now) = self.at(&[self.end()]).pop() else { return vec![] };
        let line = |(rung, part): (&Rung, &[f64; 3])| {
            let omega = rung.mode.omega;
            let amplitude = rung.mode.shape.deflection(x).abs() * part[0].hypot(part[1] / omega);
            Line {
                frequency_hz: rung.mode.frequency(),
                displacement_m: amplitude,
                velocity_m_s: omega * amplitude,
                acceleration_m_s2: omega * omega * amplitude,
            }
        };
        self.modes.iter().zip(&now.modes).map(line).collect()
    }

    /// The sound of the hit at the impact point, including the wall of a hollow barrel; `solution` is the one this was
    /// made from.
    pub fn sound(&self, solution: &Solution, wall: Option<WallTones>) -> Sound {
        let lines = self.lines(self.place);
        let amplitudes = lines.iter().map(|line| line.acceleration_m_s2);
        let blow = [self.pushed(&[self.end()])[0][1], self.end()];
        Sound::of_modes(solution, amplitudes, self.place, blow, wall)
    }

    /// The bat before any motion.
    fn still(&self, time: f64) -> Instant {
        let piece = self.pieces.iter().find(|piece| piece.end() > time && piece.start <= time);
        let force = piece
            .map_or(0.0, |piece| polynomial(&piece.powers, (time - piece.start) / piece.length));
        let (rigid, modes) = (vec![[0.0; 3]; self.rigid.len()], vec![[0.0; 3]; self.modes.len()]);
        Instant { time, force, rigid, modes }
    }

    /// Time at which a piece begins; after the last piece, its end.
    fn start_of(&self, k: usize) -> f64 {
        self.pieces.get(k).map_or(self.end(), |piece| piece.start)
    }
}
