//! How this bat rings: its rigid and bending motions after a blow, under a force or from an initial
//! shape.
//!
//! Without dashpots, or with dashpots that leave the modes as they are, every motion is an
//! [`Oscillator`] with its own damping ratio. Else the damped bat's own complex motions ring: a blow
//! J at a makes `Re Σ 2 v(x) v(a) J e^{st}/norm`, one term for each pair.
//!
//! # Source
//!
//! F. Tisseur, K. Meerbergen, SIAM Review 43 (2001) 235, section 3, on the response of a second-order
//! system in its own vectors.

use faer::c64;

use crate::bat::Bat;
use crate::damping::{Kind, accuracy};
use crate::error::Result;
use crate::flexible::RigidMotion;
use crate::force_file::ForceHistory;
use crate::modes::Shape;
use crate::quadrature::gauss;
use crate::reduced::{Pole, Reduced};
use crate::response::{Oscillator, driven};
use crate::shape_file::InitialShape;
use crate::solve::Solution;

/// How the motion begins: what goes on in every motion.
#[derive(Debug, Clone)]
pub enum Start {
    /// An impulse at a place: impulse (N s) times the motion's deflection there.
    Blow(Vec<c64>),
    /// A force at a place in time: the motion's deflection there.
    Force(Vec<c64>, ForceHistory),
    /// A release from rest: the motion's part in the initial shape.
    Shape(Vec<c64>),
}

/// A bat as its motions, which do not disturb each other.
pub struct Ringing {
    reduced: Reduced,
    /// Whether shear leaves rotations their own inertia, for initial shapes.
    turns: bool,
    motions: Vec<Motion>,
}

/// One motion: how it goes in time, and the deflections that go with it.
struct Motion {
    clock: Clock,
    /// Real part, and imaginary part of a complex one.
    forms: Vec<Form>,
}

enum Clock {
    Oscillator(Oscillator),
    /// Of a complex pair the one with `Im s > 0`.
    Pole(Pole),
}

/// A deflection along the bat.
struct Form {
    rigid: Vec<(f64, RigidMotion)>,
    bent: Option<Shape>,
    /// How far the absorbers' masses move beyond the bat (m).
    hung: Vec<f64>,
}

impl Form {
    fn at(&self, x: f64) -> f64 {
        let rigid: f64 = self.rigid.iter().map(|(part, motion)| part * motion.deflection(x)).sum();
        rigid + self.bent.as_ref().map_or(0.0, |shape| shape.deflection(x))
    }

    fn turned(&self, x: f64) -> f64 {
        let rigid: f64 = self.rigid.iter().map(|(part, motion)| part * motion.turn).sum();
        rigid + self.bent.as_ref().map_or(0.0, |shape| shape.rotation(x))
    }
}

impl Ringing {
    /// The bat's rigid motions that are free, left out if `bending_only`, and as many bending ones as
    /// the solution has modes; complex ones are found for that tolerance.
    ///
    /// # Errors
    ///
    /// As [`Reduced::free_motions`].
    pub fn new(bat: &Bat, solution: &Solution, tolerance: f64, bending_only: bool) -> Result<Self> {
        let (mesh, degree, theory) = (&solution.mesh, solution.degree, solution.theory);
        let wanted = solution.modes.len();
        let mut reduced = Reduced::new(bat, mesh, degree, theory, wanted)?;
        let mut motions = vec![];
        if !bending_only && !reduced.coupled {
            for motion in &reduced.flexible.rigid {
                let clock = Oscillator { omega: 0.0, damping_ratio: 0.0, mass: motion.mass };
                let rigid = vec![(1.0, *motion)];
                let form = Form { rigid, bent: None, hung: vec![0.0; reduced.flexible.hung.len()] };
                motions.push(Motion { clock: Clock::Oscillator(clock), forms: vec![form] });
            }
        }
        if matches!(solution.damping.kind, Kind::Complex(_)) || reduced.coupled {
            let (groups, rigid) = reduced.free_motions(wanted, accuracy(tolerance))?;
            let mut poles: Vec<Pole> = groups.into_iter().flat_map(|group| group.poles).collect();
            if !bending_only {
                poles.extend(rigid);
                poles.extend(reduced.resting());
            }
            motions.extend(poles.into_iter().map(|pole| swinging(&reduced, pole, bending_only)));
        } else {
            for k in 0..wanted {
                let ratio = solution.damping.modes.get(k).map_or(0.0, |damped| damped.ratio);
                let strains = reduced.strains(k);
                let omega = reduced.omega[k];
                let mass = reduced.flexible.energy_unit / (omega * omega);
                let clock = Clock::Oscillator(Oscillator { omega, damping_ratio: ratio, mass });
                let forms = vec![form(&reduced, strains, vec![])];
                motions.push(Motion { clock, forms });
            }
        }
        Ok(Self { reduced, turns: theory.turns(), motions })
    }

    /// Every deflection that takes part, sampled at `x`.
    pub fn shapes(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let forms = self.motions.iter().flat_map(|motion| &motion.forms);
        forms.map(|form| x.iter().map(|x| form.at(*x)).collect()).collect()
    }

    /// How large every one of these is at time `t` (s).
    pub fn amplitudes(&self, start: &Start, t: f64) -> Vec<f64> {
        let (parts, stretches) = match start {
            Start::Blow(parts) | Start::Shape(parts) => (parts, vec![]),
            Start::Force(parts, history) => (parts, history.until(t)),
        };
        let mut all = vec![];
        for (motion, part) in self.motions.iter().zip(parts) {
            match &motion.clock {
                Clock::Oscillator(oscillator) => all.push(match start {
                    Start::Blow(_) => part.re * oscillator.impulse_response(t),
                    Start::Shape(_) => oscillator.free(part.re, 0.0, t)[0],
                    Start::Force(..) => {
                        let go = |state, (h, force): &(f64, [f64; 2])| {
                            oscillator.forced(state, *force, *h)
                        };
                        part.re * stretches.iter().fold([0.0; 2], go)[0]
                    }
                }),
                Clock::Pole(pole) => {
                    let now = match start {
                        Start::Force(..) => {
                            stretches.iter().fold(c64::new(0.0, 0.0), |state, (h, force)| {
                                state * (pole.s * *h).exp() + driven(pole.s, *force, *h)
                            })
                        }
                        _ => (pole.s * t).exp(),
                    };
                    let part = *part * now;
                    match motion.forms.len() {
                        1 => all.push(part.re),
                        // Twice the real part of the product with the complex form.
                        _ => all.extend([2.0 * part.re, -2.0 * part.im]),
                    }
                }
            }
        }
        all
    }

    /// The start by a blow of that impulse (N s) at `x` (m).
    pub fn blow(&self, x: f64, impulse: f64) -> Start {
        Start::Blow(self.at(x).into_iter().map(|part| part * impulse).collect())
    }

    /// A force at `x` (m) on the bat at rest.
    pub fn pushed(&self, x: f64, history: ForceHistory) -> Start {
        Start::Force(self.at(x), history)
    }

    /// What a unit impulse at `x` starts: of an oscillator its deflection there, which its impulse
    /// response divides by the mass.
    fn at(&self, x: f64) -> Vec<c64> {
        let part = |motion: &Motion| {
            let imaginary = motion.forms.get(1).map_or(0.0, |form| form.at(x));
            let here = c64::new(motion.forms[0].at(x), imaginary);
            match &motion.clock {
                Clock::Oscillator(_) => here,
                Clock::Pole(pole) => here / pole.norm,
            }
        };
        self.motions.iter().map(part).collect()
    }

    /// The start at rest from that shape: how much of every motion is in it. What is attached goes
    /// along, absorbers too, and sections are turned by the slope.
    pub fn release(&self, bat: &Bat, shape: &InitialShape) -> Start {
        let points = self.points(bat, shape);
        let product = |form: &Form| self.product(bat, shape, &points, form);
        let hung = || vec![0.0; self.reduced.flexible.hung.len()];
        // The undamped bat's motions, from which those of the damped one follow.
        let complex = self.motions.iter().any(|motion| matches!(motion.clock, Clock::Pole(_)));
        let (mut rigid, mut modes) = (vec![], vec![]);
        if complex {
            for motion in &self.reduced.flexible.rigid {
                let form = Form { rigid: vec![(1.0, *motion)], bent: None, hung: hung() };
                rigid.push(product(&form) / motion.mass);
            }
            for (k, omega) in self.reduced.omega.iter().enumerate() {
                let form = form(&self.reduced, self.reduced.strains(k), vec![]);
                let unit = self.reduced.flexible.energy_unit;
                modes.push(product(&form) * omega * omega / unit);
            }
        }
        let part = |motion: &Motion| match &motion.clock {
            Clock::Oscillator(o) => c64::new(product(&motion.forms[0]) / o.mass, 0.0),
            Clock::Pole(pole) => self.reduced.share(pole, &rigid, &modes),
        };
        Start::Shape(self.motions.iter().map(part).collect())
    }

    /// Gauss points between all places where the bat or the shape has a corner: place, weight (m),
    /// deflection and slope of the shape.
    fn points(&self, bat: &Bat, shape: &InitialShape) -> Vec<[f64; 4]> {
        let rule = gauss(7);
        let starts = bat.profile.pieces.iter().map(|piece| piece.start);
        let mut corners: Vec<f64> = starts.chain(shape.x.iter().copied()).collect();
        corners.extend((0..=200).map(|k| bat.length() * f64::from(k) / 200.0));
        corners.sort_by(f64::total_cmp);
        let mut points = vec![];
        for pair in corners.windows(2).filter(|pair| pair[1] > pair[0]) {
            let length = pair[1] - pair[0];
            let slope = (shape.at(pair[1]) - shape.at(pair[0])) / length;
            for (s, weight) in &rule {
                let x = pair[0] + s * length;
                points.push([x, weight * length, shape.at(x), slope]);
            }
        }
        points
    }

    /// `∫ρA φ w₀ dx + ∫ρI θ w₀′ dx` and the same of what is attached (kg m²).
    fn product(&self, bat: &Bat, shape: &InitialShape, points: &[[f64; 4]], form: &Form) -> f64 {
        let mut sum = 0.0;
        for [x, weight, w, slope] in points {
            let worth = bat.worth_at(*x);
            sum += weight * worth.mass * form.at(*x) * w;
            if self.turns {
                sum += weight * worth.turning * form.turned(*x) * slope;
            }
        }
        for a in &bat.fixtures.attachments {
            let slope = shape.slope(a.x);
            let center = form.at(a.x) + a.offset * form.turned(a.x);
            sum += a.mass * center * (shape.at(a.x) + a.offset * slope);
            sum += a.rotary_inertia * form.turned(a.x) * slope;
        }
        for (a, beyond) in bat.fixtures.absorbers.iter().zip(&form.hung) {
            sum += a.mass * (form.at(a.x) + beyond) * shape.at(a.x);
        }
        sum
    }
}

/// The deflection of strains, with those rigid motions.
fn form(reduced: &Reduced, strains: &[f64], rigid: Vec<(f64, RigidMotion)>) -> Form {
    let hung = reduced.flexible.hung.iter().map(|drawn| drawn.by(strains)).collect();
    Form { rigid, bent: Some(reduced.flexible.shape(strains)), hung }
}

/// A pole as a motion.
fn swinging(reduced: &Reduced, pole: Pole, bending_only: bool) -> Motion {
    let take = |of: &dyn Fn(&c64) -> f64| {
        let mut strains = vec![0.0; reduced.flexible.dimension];
        for (k, part) in pole.parts.iter().enumerate() {
            let part = of(part);
            strains.iter_mut().zip(reduced.strains(k)).for_each(|(sum, v)| *sum += part * v);
        }
        let kept = if bending_only { 0 } else { pole.rigid.len() };
        let rigid = pole.rigid[..kept].iter().map(of);
        let rigid = rigid.zip(reduced.flexible.rigid.iter().copied()).collect();
        match strains.iter().all(|v| *v == 0.0) {
            true => Form { rigid, bent: None, hung: vec![0.0; reduced.flexible.hung.len()] },
            false => form(reduced, &strains, rigid),
        }
    };
    let real = pole.s.im == 0.0;
    let forms = match real {
        true => vec![take(&|part| part.re)],
        false => vec![take(&|part| part.re), take(&|part| part.im)],
    };
    Motion { clock: Clock::Pole(pole), forms }
}
