//! A virtual test of a bat: responses as hammer and accelerometers would give them, for planning a real test.
//!
//! The bat vibrates with the accelerometers' masses on it. A hammer of mass m_h with a tip of stiffness k is in contact
//! for `T = π √(μ/k)`, `1/μ = 1/m_h + 1/m_eff`, with a half-sine force, `F ∝ cos(πfT)/(1 − (2fT)²)`. A double hit
//! multiplies it by `1 + r e^{−2πifτ}`. The accelerometer's noise is white, so a response is `H + N/F` with the
//! coherence `1/(1 + |N/(F H)|²)`. An exponential window adds its decay to every pole: H is that at `ω − i/τ`.

use std::f64::consts::{PI, TAU};

use faer::c64;

use crate::engine::{
    Attachment, Bat, Error, Frf, Mode, Prepared, Request, ResponseKind, Result, RigidBat, prepare,
    solve,
};
use crate::identify::modes::{Identified, SharedMode};
use crate::identify::set::ResponseSet;
use crate::many::hash;
use crate::measured::mac::mac;
use crate::measured::response::MeasuredResponse;

/// A virtual test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualTest {
    /// Whether the hammer moves; otherwise accelerometers stand in a row.
    pub hammer_roves: bool,
    /// Places that are struck, or watched, from end to end.
    pub points: usize,
    /// Number of missing places.
    pub missing: usize,
    /// Number of places where the hammer bounces.
    pub double_hits: usize,
    /// Position of the fixed part (m from the knob end); `None` for the tip, or the last place if it is a point.
    pub reference: Option<f64>,
    /// Mass of each accelerometer (kg).
    pub accelerometer: f64,
    /// Mass of the hammer (kg).
    pub hammer: f64,
    /// Stiffness of its tip (N/m).
    pub tip: f64,
    /// Noise over the root mean square of a response (dB).
    pub noise: f64,
    /// Time in which an exponential window falls to 1/e (s).
    pub window: Option<f64>,
    /// End of the band (Hz).
    pub top: f64,
    /// Which noise.
    pub seed: u64,
}

/// Lines of a response.
const LINES: usize = 1600;
/// A second touch: its strength relative to the first, and its delay (s).
const BOUNCE: [f64; 2] = [0.4, 0.012];
/// Loss factor of a bat whose materials have none, as for its sound.
pub const ASSUMED_LOSS: f64 = 0.01;
/// Accuracy of the bat's frequencies, as that of its responses.
const EXACT: f64 = 1e-8;
/// Share of the force on a line without force.
const SILENT: f64 = 1e-4;
/// Share of the length from an end where a hammer slips.
const EDGE: f64 = 0.02;
/// Places that are tried for the reference and for hanging.
const TRIED: usize = 200;

/// The subject of a virtual test, and its measurements.
pub struct Simulated {
    /// The test.
    pub test: VirtualTest,
    /// The responses.
    pub set: ResponseSet,
    /// The bat's modes in the band, without masses.
    pub modes: Vec<Mode>,
    /// Frequencies with the accelerometers on it (Hz).
    pub loaded: Vec<f64>,
    /// Weakest spectrum of the force in the band, relative to the strongest (dB).
    pub force_db: f64,
    /// The bat, without the masses.
    pub bat: Bat,
}

impl VirtualTest {
    /// Carries out the test.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for an impossible test; those of [`solve`].
    pub fn of(&self, bat: &Bat) -> Result<Simulated> {
        self.check(bat)?;
        let [first, last] = ends(bat);
        let reference = self.reference.unwrap_or(last);
        let step = (last - first) / (self.points - 1) as f64;
        let mut places: Vec<f64> = (0..self.points).map(|k| first + step * k as f64).collect();
        let nearest = |x: &f64| (x - reference).abs();
        places.sort_by(|a, b| nearest(a).total_cmp(&nearest(b)));
        // The drive point stays, and is where the reference is.
        places[0] = reference;
        self.leave_out(&mut places);
        let alone = Request { modes: self.reaching(bat)?, tolerance: EXACT, ..Request::default() };
        let Prepared { bat, request, .. } = prepare(bat, &alone)?;
        let loss = bat.lossy();
        let loaded = bat.with(|parts| {
            let watched: &[f64] = if self.hammer_roves { &[reference] } else { &places };
            let masses = watched.iter().map(|x| Attachment {
                x: *x,
                mass: self.accelerometer,
                ..Default::default()
            });
            parts.fixtures.attachments.extend(masses.filter(|one| one.mass > 0.0));
        })?;
        let solution = solve(&bat, &request)?;
        let body = bat.inertia();
        let body = RigidBat {
            mass: body.mass,
            balance_point: body.balance_point,
            inertia: body.about_balance,
        };
        let mut all = vec![];
        let (mut weakest, mut hz) = (f64::INFINITY, vec![]);
        for (k, x) in places.iter().enumerate() {
            let [at, to] = if self.hammer_roves { [*x, reference] } else { [reference, *x] };
            let frf = Frf::new(&loaded, &request, at, to)?;
            let mut frf = if loss { frf } else { frf.damped_as(&[Some(0.5 * ASSUMED_LOSS)]) };
            let force = self.force(body.recoil_mass(at), k);
            weakest = force.iter().map(|f| f.norm()).fold(weakest, f64::min);
            hz = frf.solution.modes.iter().map(Mode::frequency).collect();
            all.push(self.response(&mut frf, [at, to], &force, k)?);
        }
        let modes: Vec<Mode> =
            solution.modes.into_iter().filter(|mode| mode.frequency() < self.top).collect();
        let set = ResponseSet::of(all)?;
        let force_db = 20.0 * weakest.log10();
        Ok(Simulated { test: *self, set, modes, loaded: hz, force_db, bat: bat.into_owned() })
    }

    fn check(&self, bat: &Bat) -> Result<()> {
        let [first, last] = ends(bat);
        let most = self.points.saturating_sub(3);
        let all = format!("{} at most, as many as there are points", self.points);
        for (option, count, range, expected) in [
            ("--points", self.points, 3..=100, "3 to 100".to_owned()),
            ("--missing", self.missing, 0..=most, format!("{most} at most")),
            ("--double-hits", self.double_hits, 0..=self.points, all),
        ] {
            if !range.contains(&count) {
                return Err(Error::value(option, count, expected));
            }
        }
        for (option, value, unit, [low, high]) in [
            ("--hammer", self.hammer, "kg", [0.01, 2.0]),
            ("--tip", self.tip, "N/m", [1e3, 1e10]),
            ("--to-hz", self.top, "Hz", [10.0, 20_000.0]),
            ("--reference", self.reference.unwrap_or(last), "m", [first, last]),
        ] {
            if !(low..=high).contains(&value) {
                let expected = format!("{low} to {high} {unit}");
                return Err(Error::value(option, format!("{value} {unit}"), expected));
            }
        }
        Ok(())
    }

    /// As many modes as reach beyond the band.
    fn reaching(&self, bat: &Bat) -> Result<usize> {
        const MOST: usize = 40;
        let mut modes = 6;
        loop {
            let found = solve(bat, &Request { modes, tolerance: 1e-2, ..Request::default() })?;
            if modes >= MOST
                || found.modes.last().is_some_and(|mode| mode.frequency() > 1.3 * self.top)
            {
                return Ok(modes);
            }
            modes += 4;
        }
    }

    /// Removes places at random, but never the first.
    fn leave_out(&self, places: &mut Vec<f64>) {
        for k in 0..self.missing {
            let at = 1 + hash::of(self.seed, 1, k as u64) as usize % (places.len() - 1);
            places.remove(at);
        }
    }

    /// Spectrum of the force at every line, over that at 0 Hz, at place `k`.
    fn force(&self, recoil: f64, k: usize) -> Vec<c64> {
        let touch = PI * (1.0 / (1.0 / self.hammer + 1.0 / recoil) / self.tip).sqrt();
        let line = |l: usize| {
            let f = self.line(l);
            let x = 2.0 * f * touch;
            // At x = 1 both vanish; the quotient is π/4.
            let once = if (x - 1.0).abs() < 1e-6 {
                PI / 4.0
            } else {
                (0.5 * PI * x).cos() / (1.0 - x * x)
            };
            let twice = c64::new(1.0, 0.0) + c64::from_polar(BOUNCE[0], -TAU * f * BOUNCE[1]);
            let once = if once.abs() < SILENT { SILENT } else { once };
            if k < self.double_hits { twice * once } else { c64::new(once, 0.0) }
        };
        (0..LINES).map(line).collect()
    }

    fn line(&self, l: usize) -> f64 {
        uff58::six_digits(self.top / LINES as f64) * (l + 1) as f64
    }

    /// The response at place `k`, as measured.
    fn response(
        &self,
        frf: &mut Frf,
        [at, to]: [f64; 2],
        force: &[c64],
        k: usize,
    ) -> Result<MeasuredResponse> {
        let kind = ResponseKind::Accelerance;
        let lines: Vec<f64> = (0..LINES).map(|l| self.line(l)).collect();
        let samples = frf.receptances(&lines)?;
        let exact = |sample: &sweetspot::motion::frf::Sample| {
            sample.receptance * kind.of(sample.frequency)
                + self.windowed(frf, [at, to], sample.frequency)
        };
        let exact: Vec<c64> = samples.iter().map(exact).collect();
        let power = exact.iter().zip(force).map(|(h, f)| (h * f).norm_sqr()).sum::<f64>();
        let noise = (power / LINES as f64).sqrt() * 10f64.powf(self.noise / 20.0);
        let measured = |(l, (h, f)): (usize, (&c64, &c64))| {
            (lines[l], h + normal(self.seed, k, l) * noise / f)
        };
        let values = exact.iter().zip(force).enumerate().map(measured).collect();
        let coherence = |(h, f): (&c64, &c64)| 1.0 / (1.0 + (noise / (h * f).norm()).powi(2));
        let coherence = exact.iter().zip(force).map(coherence).collect();
        let nodes = [at, to].map(|x| 1 + (1e4 * x).round() as i64);
        Ok(MeasuredResponse {
            source: "the virtual test".to_owned(),
            kind,
            at: Some(at),
            to: Some(to),
            nodes,
            coherence: Some(coherence),
            turned: false,
            values,
            assumed: vec![],
        })
    }

    /// Effect of an exponential window on an accelerance: every mode's term at `ω − i/τ` less that at ω.
    fn windowed(&self, frf: &Frf, [at, to]: [f64; 2], f: f64) -> c64 {
        let Some(tau) = self.window else { return c64::new(0.0, 0.0) };
        let damping = &frf.solution.damping.modes;
        let term = |(k, mode): (usize, &Mode), omega: c64| {
            let own = damping.get(k).map_or(0.5 * ASSUMED_LOSS, |d| d.ratio);
            let square = c64::new(1.0, 2.0 * own) * mode.omega.powi(2);
            let residue = mode.shape.deflection(at) * mode.shape.deflection(to) / mode.modal_mass;
            -omega * omega * residue / (square - omega * omega)
        };
        let [still, moved] = [0.0, -1.0 / tau].map(|im| c64::new(TAU * f, im));
        let modes = frf.solution.modes.iter().enumerate();
        modes.map(|one| term(one, moved) - term(one, still)).sum()
    }
}

/// The ends of a bat (m from the knob end), or places near them: a point bears neither hammer nor accelerometer.
fn ends(bat: &Bat) -> [f64; 2] {
    let near = |[end, near]: [f64; 2]| if bat.profile().at(end).outer > 0.0 { end } else { near };
    [[0.0, EDGE], [1.0, 1.0 - EDGE]].map(|places| near(places.map(|x| x * bat.length())))
}

/// A complex normal number of mean square 1.
fn normal(seed: u64, k: usize, l: usize) -> c64 {
    let share = |which: u64| {
        let bits = hash::of(seed, 2 + which, ((k as u64) << 32) + l as u64) >> 11;
        (bits as f64 + 0.5) / (1_u64 << 53) as f64
    };
    c64::from_polar((-share(0).ln()).sqrt(), TAU * share(1))
}

impl Simulated {
    /// For every mode, the index of the mode that was found, and the MAC of its shape.
    pub fn matched(&self, found: &Identified) -> Vec<Option<(usize, f64)>> {
        let mut taken = vec![];
        let one = |mode: &Mode| {
            let like = |(k, other): (usize, &SharedMode)| {
                let near = (other.frequency.value / mode.frequency() - 1.0).abs() < 0.05;
                let both = self.set.points.iter().zip(&other.shape);
                let both = both.filter_map(|(place, v)| {
                    Some((c64::new(mode.shape.deflection(place.x), 0.0), (*v)?))
                });
                let (own, theirs): (Vec<c64>, Vec<c64>) = both.unzip();
                let alike = mac(&own, &theirs);
                (near && alike > 0.5 && !taken.contains(&k)).then_some((k, alike))
            };
            let best =
                found.modes.iter().enumerate().filter_map(like).max_by(|a, b| a.1.total_cmp(&b.1));
            taken.extend(best.map(|(k, _)| k));
            best
        };
        self.modes.iter().map(one).collect()
    }

    /// The place of the reference that shows the faintest wanted mode best, and that mode's share of its largest
    /// deflection there; not at the edge.
    pub fn reference(&self) -> [f64; 2] {
        let least = |x: f64| {
            self.modes.iter().map(|mode| mode.shape.deflection(x).abs()).fold(1.0, f64::min)
        };
        let places = self.places(EDGE).map(|x| [x, least(x)]);
        places.max_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or_default()
    }

    /// The two places, one in each half, at which the wanted modes move least; lower modes count more.
    pub fn hang(&self) -> [f64; 2] {
        let first = self.modes.first().map_or(1.0, |mode| mode.omega);
        let moved = |x: f64| -> f64 {
            let one = |mode: &Mode| first / mode.omega * mode.shape.deflection(x).powi(2);
            self.modes.iter().map(one).sum()
        };
        [0.0, 0.5].map(|from| {
            let half =
                self.places(0.05).filter(|x| (from..from + 0.5).contains(&(x / self.bat.length())));
            half.min_by(|a, b| moved(*a).total_cmp(&moved(*b))).unwrap_or_default()
        })
    }

    fn places(&self, margin: f64) -> impl Iterator<Item = f64> + '_ {
        let at = move |k: usize| margin + (1.0 - 2.0 * margin) * k as f64 / TRIED as f64;
        (0..=TRIED).map(move |k| at(k) * self.bat.length())
    }
}
