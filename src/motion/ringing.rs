//! How does this bat ring, after a blow, under a force or from an initial shape?
//!
//! [`Ringing::new`] makes one from a solution. [`Ringing::blow`], [`Ringing::pushed`] or [`Ringing::release`] starts
//! its rigid and bending motions in time.
//!
//! Without dashpots, or with dashpots that leave the modes unchanged, every mode is an [`Oscillator`] with its own
//! damping ratio. Otherwise the complex modes of the damped bat ring: a blow J at a causes
//! `Re Σ 2 v(x) v(a) J e^{st}/norm`, one term for each pair.
//!
//! # Source
//!
//! F. Tisseur, K. Meerbergen, The quadratic eigenvalue problem, SIAM Review 43 (2001) 235.

use faer::c64;

use crate::base::{Result, gauss};
use crate::bat::Bat;
use crate::modes::compliance::RigidMotion;
use crate::modes::damping::{DampingMethod, accuracy};
use crate::modes::mode::Shape;
use crate::modes::pole::Pole;
use crate::modes::reduced::Reduced;
use crate::modes::solve::Solution;
use crate::motion::force::ForceHistory;
use crate::motion::oscillator::Oscillator;
use crate::motion::phi::driven;
use crate::motion::shape::InitialShape;

/// The start of the motion: the excitation of every mode.
#[derive(Debug, Clone)]
pub enum Start {
    /// An impulse at a place: impulse (N s) times the mode's deflection there.
    Blow(Vec<c64>),
    /// A force in time at a place: the mode's deflection there.
    Force(Vec<c64>, ForceHistory),
    /// A release from rest: the mode's part in the initial shape.
    Shape(Vec<c64>),
}

/// A bat as a set of uncoupled modes.
pub struct Ringing {
    reduced: Reduced,
    /// Whether the theory with shear gives rotations their own inertia, for initial shapes.
    turns: bool,
    motions: Vec<ModeInTime>,
}

/// One mode: its time function and its deflections.
struct ModeInTime {
    clock: ModeClock,
    /// Real part of the deflections, and the imaginary part for a complex mode.
    forms: Vec<Deflection>,
}

enum ModeClock {
    Oscillator(Oscillator),
    /// One of a complex pair, the one with `Im s > 0`.
    Pole(Pole),
}

/// A deflection along the bat.
struct Deflection {
    rigid: Vec<(f64, RigidMotion)>,
    bent: Option<Shape>,
    /// Displacement of the absorbers' masses relative to the bat (m).
    hung: Vec<f64>,
}

impl Deflection {
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
    /// The bat's free rigid motions, omitted if `bending_only`, and as many bending modes as the solution has; complex
    /// modes are computed to that tolerance.
    ///
    /// ```
    /// use sweetspot::motion::ringing::Ringing;
    /// use sweetspot::{Bat, Request, solve};
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// # let bat = Bat::builtin("r161")?;
    /// let solution = solve(&bat, &Request::default())?;
    /// let ringing = Ringing::new(&bat, &solution, 1e-4, true)?;
    /// // A blow of 1 N s in the middle, and the displacement of the tip 2 ms later.
    /// let parts = ringing.amplitudes(&ringing.blow(0.42, 1.0), 2e-3);
    /// let tip: f64 = ringing.shapes(&[bat.length()]).iter().zip(&parts).map(|(w, q)| w[0] * q).sum();
    /// assert!(tip.is_finite());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Reduced::free_motions`].
    pub fn new(bat: &Bat, solution: &Solution, tolerance: f64, bending_only: bool) -> Result<Self> {
        let bat = solution.of(bat);
        let wanted = solution.modes.len();
        let mut reduced = Reduced::new(bat, solution.elements(), wanted)?;
        let mut motions = vec![];
        if !bending_only && !reduced.coupled {
            for motion in &reduced.flexible.rigid {
                let clock = Oscillator { omega: 0.0, damping_ratio: 0.0, mass: motion.mass };
                let rigid = vec![(1.0, *motion)];
                let form =
                    Deflection { rigid, bent: None, hung: vec![0.0; reduced.flexible.hung.len()] };
                motions.push(ModeInTime { clock: ModeClock::Oscillator(clock), forms: vec![form] });
            }
        }
        if matches!(solution.damping.kind, DampingMethod::Complex(_)) || reduced.coupled {
            let free = reduced.free_motions(wanted, accuracy(tolerance))?;
            let groups = free.groups.into_iter().flat_map(|group| group.poles);
            let mut poles: Vec<Pole> = groups.chain(free.others).collect();
            if !bending_only {
                poles.extend(free.rigid);
                poles.extend(reduced.resting());
            }
            motions.extend(poles.into_iter().map(|pole| swinging(&reduced, pole, bending_only)));
        } else {
            for k in 0..wanted {
                let ratio = solution.damping.modes.get(k).map_or(0.0, |damped| damped.ratio);
                let strains = reduced.strains(k);
                let omega = reduced.omega[k];
                let mass = reduced.flexible.energy_unit / (omega * omega);
                let clock = ModeClock::Oscillator(Oscillator { omega, damping_ratio: ratio, mass });
                let forms = vec![form(&reduced, strains, vec![])];
                motions.push(ModeInTime { clock, forms });
            }
        }
        Ok(Self { reduced, turns: solution.theory.turns(), motions })
    }

    /// Every deflection that takes part, sampled at `x`.
    pub fn shapes(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let forms = self.motions.iter().flat_map(|motion| &motion.forms);
        forms.map(|form| x.iter().map(|x| form.at(*x)).collect()).collect()
    }

    /// The amplitude of each of these at time `t` (s).
    pub fn amplitudes(&self, start: &Start, t: f64) -> Vec<f64> {
        let (parts, stretches) = match start {
            Start::Blow(parts) | Start::Shape(parts) => (parts, vec![]),
            Start::Force(parts, history) => (parts, history.until(t)),
        };
        let mut all = vec![];
        for (motion, part) in self.motions.iter().zip(parts) {
            match &motion.clock {
                ModeClock::Oscillator(oscillator) => all.push(match start {
                    Start::Blow(_) => part.re * oscillator.impulse_response(t),
                    Start::Shape(_) => oscillator.free(part.re, 0.0, t)[0],
                    Start::Force(..) => {
                        let go = |state, (h, force): &(f64, [f64; 2])| {
                            oscillator.forced(state, *force, *h)
                        };
                        part.re * stretches.iter().fold([0.0; 2], go)[0]
                    }
                }),
                ModeClock::Pole(pole) => {
                    let now = match start {
                        Start::Force(..) => {
                            stretches.iter().fold(c64::new(0.0, 0.0), |state, (h, [from, to])| {
                                driven(pole.s, state, &[*from, to - from], *h)
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

    /// The excitation of every mode by a unit impulse at `x`: for an oscillator its deflection there, which the impulse
    /// response divides by the mass.
    fn at(&self, x: f64) -> Vec<c64> {
        let part = |motion: &ModeInTime| {
            let imaginary = motion.forms.get(1).map_or(0.0, |form| form.at(x));
            let here = c64::new(motion.forms[0].at(x), imaginary);
            match &motion.clock {
                ModeClock::Oscillator(_) => here,
                ModeClock::Pole(pole) => here / pole.norm,
            }
        };
        self.motions.iter().map(part).collect()
    }

    /// The start at rest from that shape: the part of every mode in it. The fixtures move with the bat, absorbers too,
    /// and sections are turned by the slope.
    pub fn release(&self, bat: &Bat, shape: &InitialShape) -> Start {
        let points = self.points(bat, shape);
        let product = |form: &Deflection| self.product(bat, shape, &points, form);
        let hung = || vec![0.0; self.reduced.flexible.hung.len()];
        // The undamped modes, from which those of the damped bat follow.
        let complex = self.motions.iter().any(|motion| matches!(motion.clock, ModeClock::Pole(_)));
        let (mut rigid, mut modes) = (vec![], vec![]);
        if complex {
            for motion in &self.reduced.flexible.rigid {
                let form = Deflection { rigid: vec![(1.0, *motion)], bent: None, hung: hung() };
                rigid.push(product(&form) / motion.mass);
            }
            for (k, omega) in self.reduced.omega.iter().enumerate() {
                let form = form(&self.reduced, self.reduced.strains(k), vec![]);
                let unit = self.reduced.flexible.energy_unit;
                modes.push(product(&form) * omega * omega / unit);
            }
        }
        let part = |motion: &ModeInTime| match &motion.clock {
            ModeClock::Oscillator(o) => c64::new(product(&motion.forms[0]) / o.mass, 0.0),
            ModeClock::Pole(pole) => self.reduced.share(pole, &rigid, &modes),
        };
        Start::Shape(self.motions.iter().map(part).collect())
    }

    /// Gauss points between all corners of the bat and the shape: place, weight (m), deflection and slope of the shape.
    fn points(&self, bat: &Bat, shape: &InitialShape) -> Vec<[f64; 4]> {
        let rule = gauss(7);
        let starts = bat.profile().pieces.iter().map(|piece| piece.start);
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

    /// `∫ρA φ w₀ dx + ∫ρI θ w₀′ dx`, and the same products for the fixtures (kg m²).
    fn product(
        &self,
        bat: &Bat,
        shape: &InitialShape,
        points: &[[f64; 4]],
        form: &Deflection,
    ) -> f64 {
        let mut sum = 0.0;
        for [x, weight, w, slope] in points {
            let worth = bat.worth_at(*x);
            sum += weight * worth.mass * form.at(*x) * w;
            if self.turns {
                sum += weight * worth.turning * form.turned(*x) * slope;
            }
        }
        for a in &bat.fixtures().attachments {
            let slope = shape.slope(a.x);
            let center = form.at(a.x) + a.offset * form.turned(a.x);
            sum += a.mass * center * (shape.at(a.x) + a.offset * slope);
            sum += a.rotary_inertia * form.turned(a.x) * slope;
        }
        for (a, beyond) in bat.fixtures().absorbers.iter().zip(&form.hung) {
            sum += a.mass * (form.at(a.x) + beyond) * shape.at(a.x);
        }
        sum
    }
}

/// The deflection due to strains and rigid motions.
fn form(reduced: &Reduced, strains: &[f64], rigid: Vec<(f64, RigidMotion)>) -> Deflection {
    let hung = reduced.flexible.hung.iter().map(|drawn| drawn.by(strains)).collect();
    Deflection { rigid, bent: Some(reduced.flexible.shape(strains)), hung }
}

/// A pole as a mode in time.
fn swinging(reduced: &Reduced, pole: Pole, bending_only: bool) -> ModeInTime {
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
            true => Deflection { rigid, bent: None, hung: vec![0.0; reduced.flexible.hung.len()] },
            false => form(reduced, &strains, rigid),
        }
    };
    let real = pole.s.im == 0.0;
    let forms = match real {
        true => vec![take(&|part| part.re)],
        false => vec![take(&|part| part.re), take(&|part| part.im)],
    };
    ModeInTime { clock: ModeClock::Pole(pole), forms }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::bat::fixtures::{Absorber, Attachment, Fixtures, Grip, Held, Support};
    use crate::bat::material::Material;
    use crate::bat::profile::{Interpolation, Profile, Stations};
    use crate::bat::theory::Theory;
    use crate::modes::solve::{Request, solve};

    const LENGTH: f64 = 0.8;

    fn bat(fixtures: Fixtures) -> Bat {
        let stations = Stations {
            x: vec![0.0, LENGTH],
            outer: vec![0.014, 0.03],
            inner: vec![0.0; 2],
            interpolation: Interpolation::Linear,
        };
        let mut material = Material::new(700.0, 14e9).unwrap();
        material.shear_modulus = Some(1e9);
        let profile = Profile::new(stations).unwrap();
        Bat::builder(profile, material).name("ringing").fixtures(fixtures).build().unwrap()
    }

    fn solved(bat: &Bat, modes: usize, theory: Theory) -> Solution {
        let request = Request { modes, tolerance: 1e-9, theory, ..Request::default() };
        solve(bat, &request).unwrap()
    }

    fn hands(stiffness: f64, damping: f64) -> Fixtures {
        let grip = Grip { from: 0.02, to: 0.2, stiffness, damping };
        let absorber = Absorber { x: 0.05, mass: 0.03, stiffness: 3e4, damping: 4.0 };
        Fixtures { grip: Some(grip), absorbers: vec![absorber], ..Fixtures::default() }
    }

    /// Displacements of all unknowns and their rates, from the poles alone.
    fn state(ringing: &Ringing, start: &Start, t: f64) -> [Vec<f64>; 2] {
        let (Start::Blow(parts) | Start::Shape(parts) | Start::Force(parts, _)) = start;
        let mut both = [vec![], vec![]];
        for (motion, part) in ringing.motions.iter().zip(parts) {
            let ModeClock::Pole(pole) = &motion.clock else { panic!("no pole") };
            let now = *part * (pole.s * t).exp() * if pole.s.im == 0.0 { 1.0 } else { 2.0 };
            let v: Vec<c64> = pole.rigid.iter().chain(&pole.parts).copied().collect();
            for (sum, factor) in both.iter_mut().zip([now, now * pole.s]) {
                sum.resize(v.len(), 0.0);
                sum.iter_mut().zip(&v).for_each(|(sum, v)| *sum += (*v * factor).re);
            }
        }
        both
    }

    /// Strain and kinetic energy (J).
    fn energy(ringing: &Ringing, mass: &faer::Mat<f64>, [u, v]: &[Vec<f64>; 2]) -> f64 {
        let rigid = u.len() - ringing.reduced.len();
        let moving = |i: usize| (0..v.len()).map(|j| v[i] * mass[(i, j)] * v[j]).sum::<f64>();
        let kinetic: f64 = (0..v.len()).map(moving).sum();
        let strain: f64 = u[rigid..].iter().map(|u| u * u).sum();
        0.5 * ringing.reduced.flexible.energy_unit * (kinetic + strain)
    }

    #[test]
    fn what_rings_freely_loses_energy_all_the_time() {
        for fixtures in [hands(2e5, 300.0), hands(0.0, 300.0)] {
            let bat = bat(fixtures);
            let solution = solved(&bat, 5, Theory::Timoshenko);
            let ringing = Ringing::new(&bat, &solution, 1e-9, false).unwrap();
            let start = ringing.blow(0.6, 1.0);
            let [mass, _] = ringing.reduced.viscous();
            let mut before = f64::INFINITY;
            for k in 0..200 {
                let now = energy(&ringing, &mass, &state(&ringing, &start, 1e-4 * f64::from(k)));
                assert!(now < before, "{k} {now} {before}");
                before = now;
            }
        }
    }

    /// A blow moves nothing at once, whatever the dashpots do to the modes.
    #[test]
    fn a_blow_begins_at_zero() {
        for (stiffness, damping) in [(0.0, 300.0), (3e4, 300.0), (3e4, 3e4), (0.0, 3e4)] {
            let bat = bat(hands(stiffness, damping));
            let solution = solved(&bat, 3, Theory::EulerBernoulli);
            let ringing = Ringing::new(&bat, &solution, 1e-9, false).unwrap();
            let start = ringing.blow(0.6, 1.0);
            let shapes = ringing.shapes(&[0.05, 0.4, 0.6, 0.8]);
            let at = |t: f64, i: usize| -> f64 {
                let parts = ringing.amplitudes(&start, t);
                shapes.iter().zip(parts).map(|(shape, part)| shape[i] * part).sum()
            };
            for i in 0..4 {
                let later = at(1e-3, i).abs().max(1e-3);
                assert!(
                    at(0.0, i).abs() < 1e-8 * later,
                    "{stiffness} {damping} {i} {}",
                    at(0.0, i)
                );
            }
        }
    }

    /// A blow and a very short push with the same impulse agree; a half-sine push by its chords is off by the chords'
    /// deviation.
    #[test]
    fn a_short_push_is_a_blow() {
        let pin = Support { x: 0.3, kind: Held::Pinned };
        let weight = Attachment { x: 0.8, mass: 0.2, offset: 0.05, ..Attachment::default() };
        let pinned =
            Fixtures { supports: vec![pin], attachments: vec![weight], ..Fixtures::default() };
        for fixtures in [Fixtures::default(), pinned, hands(2e5, 300.0), hands(0.0, 300.0)] {
            let bat = bat(fixtures);
            let solution = solved(&bat, 4, Theory::Rayleigh);
            let ringing = Ringing::new(&bat, &solution, 1e-9, false).unwrap();
            let short = 1e-9;
            let history = ForceHistory { t: vec![0.0, short], force: vec![2.0 / short; 2] };
            let (blow, push) = (ringing.blow(0.7, 2.0), ringing.pushed(0.7, history));
            for t in [1e-3, 0.02, 0.3] {
                let [a, b] = [ringing.amplitudes(&blow, t), ringing.amplitudes(&push, t)];
                let shapes = ringing.shapes(&[0.1, 0.4, 0.75]);
                for i in 0..3 {
                    let w = |parts: &[f64]| -> f64 {
                        shapes.iter().zip(parts).map(|(shape, part)| shape[i] * part).sum()
                    };
                    // The push is half of its length late: ω times that, 1e4 × 5e-10.
                    assert!((w(&a) - w(&b)).abs() < 2e-5 * w(&a).abs().max(1e-4), "{t} {i}");
                }
            }
        }
    }

    /// A free bat, bare or with fixtures of every kind, keeps the momentum and the angular momentum of a blow; a pinned
    /// one turns about its pin.
    #[test]
    fn rigid_motions_carry_what_is_attached() {
        let weight = Attachment { x: 0.8, mass: 0.2, offset: 0.05, ..Attachment::default() };
        let weighted = Fixtures { attachments: vec![weight], ..Fixtures::default() };
        let bat = bat(weighted);
        let inertia = bat.inertia();
        let solution = solved(&bat, 3, Theory::Rayleigh);
        let ringing = Ringing::new(&bat, &solution, 1e-9, false).unwrap();
        let (x, t) = (0.7, 0.01);
        let amplitudes = ringing.amplitudes(&ringing.blow(x, 3.0), t);
        let shapes = ringing.shapes(&[0.0, 0.8]);
        let rigid = |i: usize| shapes[0][i] * amplitudes[0] + shapes[1][i] * amplitudes[1];
        let arm = x - inertia.balance_point;
        for (i, at) in [0.0, 0.8].into_iter().enumerate() {
            let turn = arm / inertia.about_balance * (at - inertia.balance_point);
            let exact = 3.0 * t * (1.0 / inertia.mass + turn);
            assert!((rigid(i) / exact - 1.0).abs() < 1e-12, "{}", rigid(i));
        }
    }

    /// Released from the shape of a mode, or from a rigid one, the bat moves in that mode alone.
    #[test]
    fn a_mode_s_own_shape_rings_in_that_mode_alone() {
        let weight = Attachment { x: 0.8, mass: 0.2, offset: 0.05, ..Attachment::default() };
        let pin = Support { x: 0.3, kind: Held::Pinned };
        for supports in [vec![], vec![pin]] {
            let free = Fixtures { attachments: vec![weight], supports, ..Fixtures::default() };
            let bat = bat(free);
            let solution = solved(&bat, 4, Theory::EulerBernoulli);
            let ringing = Ringing::new(&bat, &solution, 1e-9, false).unwrap();
            let rigid = solution.rigid_modes;
            let x: Vec<f64> = (0..=4000).map(|k| LENGTH * f64::from(k) / 4000.0).collect();
            let w = x.iter().map(|x| solution.modes[1].shape.deflection(*x)).collect();
            let start = ringing.release(&bat, &InitialShape { x: x.clone(), w });
            let parts = ringing.amplitudes(&start, 0.0);
            let shapes = ringing.shapes(&[LENGTH]);
            for (k, (part, shape)) in parts.iter().zip(shapes).enumerate() {
                let exact =
                    if k == rigid + 1 { solution.modes[1].shape.deflection(LENGTH) } else { 0.0 };
                // Chords of 0.2 mm are off by h²/8 of the curvature, 5e-9 × 60.
                assert!((part * shape[0] - exact).abs() < 1e-5, "{k} {part}");
            }
        }
    }

    /// With weak dashpots it starts as it does without.
    #[test]
    fn weak_dashpots_change_little() {
        let x: Vec<f64> = (0..=80).map(|k| LENGTH * f64::from(k) / 80.0).collect();
        let w = x.iter().map(|x| 1e-3 * (x - 0.5).powi(2)).collect();
        let shape = InitialShape { x, w };
        let rings = |damping: f64| {
            let mut fixtures = hands(2e5, damping);
            fixtures.absorbers[0].damping = 1e-3 * damping;
            let bat = bat(fixtures);
            let solution = solved(&bat, 4, Theory::Rayleigh);
            let ringing = Ringing::new(&bat, &solution, 1e-9, false).unwrap();
            let start = ringing.release(&bat, &shape);
            let shapes = ringing.shapes(&[0.75]);
            let at = |t: f64| -> f64 {
                let parts = ringing.amplitudes(&start, t);
                shapes.iter().zip(parts).map(|(shape, part)| shape[0] * part).sum()
            };
            [0.0, 1e-3, 5e-3].map(at)
        };
        // Complex motions and oscillators, which differ by about the damping ratio, 1e-5.
        for (a, b) in rings(0.1).into_iter().zip(rings(0.0)) {
            assert!((a - b).abs() < 1e-3 * 1e-4, "{a} {b}");
        }
    }
}
