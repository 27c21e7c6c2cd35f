//! Ten thousand random impacts against tight solutions: no exit speed is off by more than ten times
//! the asked tolerance, or the hit says that it is a delicate one.

use sweetspot::collision::contact::{Collider, Encounter};
use sweetspot::collision::force_law::ForceLaw;
use sweetspot::collision::struck::Struck;
use sweetspot::collision::touch::Felt;
use sweetspot::dowel::{Ends, beta_l};
use sweetspot::theory::Theory;
use sweetspot::validation::bundled_bat;
use sweetspot::{Request, solve};

/// Numbers that look random, the same in every run.
///
/// # Source
///
/// G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
struct Random(u64);

impl Random {
    /// Evenly from 0 to 1.
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    }

    fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// Evenly in the logarithm.
    fn scaled(&mut self, from: f64, to: f64) -> f64 {
        from * (to / from).powf(self.unit())
    }

    fn whether(&mut self, share: f64) -> bool {
        self.unit() < share
    }
}

/// A bat at one place: ω, ζ of its modes, and how a ball feels it.
struct Place {
    modes: Vec<[f64; 2]>,
    felt: Felt,
    mass: f64,
}

/// Two bats, for as many modes as a case asks for.
struct Bats {
    r161: (sweetspot::Bat, sweetspot::Solution),
}

impl Bats {
    fn new() -> Self {
        let bat = bundled_bat("meshes/r161.json").unwrap();
        let request = Request {
            modes: 12,
            tolerance: 1e-8,
            theory: Theory::Timoshenko,
            ..Request::default()
        };
        let solution = solve(&bat, &request).unwrap();
        Self { r161: (bat, solution) }
    }

    /// The R161 where a barrel or a handle is hit.
    fn r161(&self, struck: &Struck, random: &mut Random, count: usize, ball: f64) -> Place {
        let x = self.r161.0.length() * random.within(0.1, 0.97);
        let felt = if random.whether(0.5) {
            struck.felt(x, ball, count)
        } else {
            struck.with_modes(x, ball, count)
        };
        Place { modes: struck.modes()[..count].to_vec(), felt, mass: self.r161.0.inertia().mass }
    }
}

/// A uniform dowel that may be stiffer or softer than a bat.
fn dowel(random: &mut Random, count: usize, ball: f64) -> Place {
    let (mass, at) = (0.85, random.within(0.0, 1.0));
    let first = random.scaled(60.0, 400.0);
    let beta = |n: usize| beta_l(Ends::FreeFree, n);
    let omega = |n: usize| std::f64::consts::TAU * first * (beta(n) / beta(1)).powi(2);
    let shape = |n: usize| sweetspot::dowel::wpi_shape(n, at) / sweetspot::dowel::wpi_alpha(n);
    let modes: Vec<[f64; 2]> = (1..=count).map(|n| [omega(n), 0.0]).collect();
    let gain = |n: usize| shape(n).powi(2) / mass;
    let gains = (1..=count).map(gain).collect();
    let all = |n: usize| gain(n) / omega(n).powi(2);
    let rest = if random.whether(0.5) { 0.0 } else { (count + 1..30).map(all).sum() };
    let inverse_mass = 1.0 / ball + (1.0 + 12.0 * (at - 0.5).powi(2)) / mass;
    Place { modes, felt: Felt { inverse_mass, gains, rest }, mass }
}

/// Whether the hit says that a little may change it much.
fn flagged(met: &Encounter) -> bool {
    met.reloaded || met.late || met.second
}

#[test]
fn ten_thousand_impacts_are_as_exact_as_asked_or_flagged() {
    const CASES: usize = 10_000;
    // The sweep takes steps of ten times the tolerance.
    const TOLERANCES: [f64; 3] = [1e-4, 1e-6, 1e-9];
    let (mut random, bats) = (Random(1), Bats::new());
    let struck = Struck::new(&bats.r161.0, &bats.r161.1);
    let (mut reloaded, mut late, mut second, mut plain) = (0, 0, 0, 0);
    let mut failures = Vec::new();
    for case in 0..CASES {
        let ball = random.within(0.1, 0.25);
        let count = 2 + (10.9 * random.unit()) as usize;
        let Place { mut modes, felt, mass } = if random.whether(0.5) {
            dowel(&mut random, count, ball)
        } else {
            bats.r161(&struck, &mut random, count, ball)
        };
        let ratio = if random.whether(0.25) { random.within(0.0, 0.02) } else { 0.0 };
        modes.iter_mut().for_each(|mode| mode[1] = ratio);
        // So stiff that at 45 m/s a wall compresses it by 4 to 30 mm.
        let (exponent, deep) = (random.within(1.2, 2.0), random.scaled(0.004, 0.03));
        let stiffness =
            0.5 * (1.0 + exponent) * ball * 45.0_f64.powi(2) / deep.powf(1.0 + exponent);
        let law = ForceLaw::new(stiffness, exponent, random.within(0.2, 1.0));
        let speed = random.scaled(1.0, 80.0);
        // Steps as long as a hit along a bat has.
        let reduced = 1.0 / (1.0 / ball + 1.0 / mass);
        let touching = law.compression(0.5 * reduced * speed * speed) / speed;
        let collider = Collider::new(&modes, 0.28 * touching);
        let tight = collider.meet(&felt, &law, speed, 1e-11);
        reloaded += usize::from(tight.reloaded);
        late += usize::from(tight.late);
        second += usize::from(tight.second);
        plain += usize::from(!flagged(&tight));
        for tolerance in TOLERANCES {
            let met = collider.meet(&felt, &law, speed, 10.0 * tolerance);
            let off = (met.impulse - tight.impulse).abs() / (ball * speed);
            // An error that is not a number is one.
            if !(flagged(&met) || off <= 10.0 * tolerance) || met.endless {
                failures
                    .push(format!("{case} at {tolerance:e}: {off:e}, {law:?} {speed} {felt:?}"));
            }
            let left = speed - met.impulse * felt.inverse_mass;
            let before = 0.5 * speed * speed / felt.inverse_mass;
            let after = 0.5 * left * left / felt.inverse_mass;
            let lost = met.lost_in_ball + met.lost_in_bat + met.in_modes.iter().sum::<f64>();
            let open = (before - after - lost).abs() / before;
            if !(open < 1e-9 || flagged(&met)) {
                failures.push(format!("{case} at {tolerance:e}: energy off by {open:e}"));
            }
        }
    }
    assert!(failures.is_empty(), "{} of {CASES}: {failures:#?}", failures.len());
    // It is a test of the delicate ones too, and not only of them.
    println!("{reloaded} reloads, {late} late, {second} second contacts, {plain} plain");
    assert!(reloaded > 50 && late > 500 && second > 200 && plain > 5000);
}
