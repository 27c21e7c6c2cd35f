//! Ten thousand random impacts satisfy the conservation of energy, and the ball never gains more energy than there was.
//! Their exit speeds are compared with a reference in `tests/hit_promise.rs`.

use sweetspot::bat::theory::Theory;
use sweetspot::beam::dowel::{Ends, beta_l};
use sweetspot::collision::contact::collider::Collider;
use sweetspot::collision::contact::force_law::ForceLaw;
use sweetspot::collision::contact::power_law::PowerLaw;
use sweetspot::collision::contact::touch::DrivingPoint;
use sweetspot::collision::struck::Struck;
use sweetspot::{Request, solve};
use sweetspot_proof::bundled::bundled_bat;

/// Random-looking numbers, the same in every run.
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
    felt: DrivingPoint,
    mass: f64,
}

/// Two bats, for the number of modes of a case.
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
    let shape = |n: usize| {
        sweetspot::collision::energy_loss::wpi_shape(n, at)
            / sweetspot::collision::energy_loss::wpi_alpha(n)
    };
    let modes: Vec<[f64; 2]> = (1..=count).map(|n| [omega(n), 0.0]).collect();
    let gain = |n: usize| shape(n).powi(2) / mass;
    let gains = (1..=count).map(gain).collect();
    let all = |n: usize| gain(n) / omega(n).powi(2);
    let rest = if random.whether(0.5) { 0.0 } else { (count + 1..30).map(all).sum() };
    let inverse_mass = 1.0 / ball + (1.0 + 12.0 * (at - 0.5).powi(2)) / mass;
    Place { modes, felt: DrivingPoint { inverse_mass, gains, rest }, mass }
}

#[test]
fn ten_thousand_impacts_keep_their_energy() {
    const CASES: usize = 10_000;
    const ACCURACIES: [f64; 3] = [1e-3, 1e-5, 1e-8];
    let (mut random, bats) = (Random(1), Bats::new());
    let struck = Struck::new(&bats.r161.0, &bats.r161.1);
    let (mut reloaded, mut late, mut second, mut plain) = (0, 0, 0, 0);
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
        // A stiffness with which a wall at 45 m/s compresses the ball by 4 to 30 mm.
        let (exponent, deep) = (random.within(1.2, 2.0), random.scaled(0.004, 0.03));
        let stiffness =
            0.5 * (1.0 + exponent) * ball * 45.0_f64.powi(2) / deep.powf(1.0 + exponent);
        let law = PowerLaw::new(stiffness, exponent, random.scaled(0.02, 1.0));
        let speed = random.scaled(1.0, 80.0);
        // Steps of the length used for hits along a bat.
        let reduced = 1.0 / (1.0 / ball + 1.0 / mass);
        let touching = law.compression(0.5 * reduced * speed * speed) / speed;
        let collider = Collider::new(&modes, 0.28 * touching);
        for accuracy in ACCURACIES {
            // Where the steps do not end, finer ones do.
            let found = (0..12).find_map(|k| {
                let met = collider.meet(&felt, &law, speed, 0.2_f64.powi(k) * accuracy);
                met.is_sound(&felt, speed).then_some(met)
            });
            let met =
                found.unwrap_or_else(|| panic!("{case}, {accuracy:e}: {law:?} {speed} {felt:?}"));
            let most = 2.0 * speed / felt.inverse_mass;
            assert!(met.impulse > 0.0 && met.impulse <= most, "{case} {accuracy:e}");
            assert!(met.in_modes.iter().all(|energy| *energy >= 0.0));
            assert!(met.lost_in_bat >= -1e-12 * speed * speed && met.first_end <= met.end);
            reloaded += usize::from(met.reloads > 0);
            late += usize::from(met.late);
            second += usize::from(met.again());
            plain += usize::from(met.reloads == 0 && !met.late && !met.again());
        }
    }
    // The test includes delicate hits and others.
    println!("{reloaded} reloads, {late} late, {second} second contacts, {plain} plain");
    assert!(reloaded > 150 && late > 1500 && second > 600 && plain > 5000);
}
