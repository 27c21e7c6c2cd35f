//! Trials that are wrong in every way: every interval must still contain its frequency.

use sweetspot::bat::fixtures::{Absorber, Attachment, Fixtures, Grip, Held, Joint, Support};
use sweetspot::bat::profile::{Interpolation, Stations};
use sweetspot::beam::mesh::Mesh;
use sweetspot::modes::plan::Plan;
use sweetspot::{Bat, Profile, Theory};
use sweetspot_proof::enclosure::beam::{Layout, Proven};
use sweetspot_proof::enclosure::conclude::conclude;
use sweetspot_proof::enclosure::moved::Trial;
use sweetspot_proof::enclosure::norms::Norms;
use sweetspot_proof::enclosure::trials::trials;
use sweetspot_proof::validation::Truth;

use crate::arithmetic::Random;
use crate::holds;

/// A bat on a mesh, with its trials.
struct Scene {
    truth: Truth,
    norms: Norms,
    proven: Proven,
    trials: Vec<Trial>,
}

fn plan(bat: &Bat, elements: usize, degree: usize) -> Plan {
    Plan { mesh: Mesh::along(bat, elements), degree, ..Plan::default() }
}

/// A bat turned end for end, with its joints and its masses on springs.
fn reversed(bat: &Bat) -> Bat {
    let length = bat.length();
    bat.with(|parts| {
        let mut stations = parts.profile.stations.clone();
        stations.x.iter_mut().for_each(|x| *x = length - *x);
        for all in [&mut stations.x, &mut stations.outer, &mut stations.inner] {
            all.reverse();
        }
        parts.profile = Profile::new(stations).unwrap();
        parts.fixtures.joints.iter_mut().for_each(|joint| joint.x = length - joint.x);
        parts.fixtures.absorbers.iter_mut().for_each(|hung| hung.x = length - hung.x);
    })
    .unwrap()
}

impl Scene {
    fn new(case: &str, elements: usize, degree: usize) -> Self {
        let (name, turned) = case.split_once(", ").map_or((case, false), |(name, _)| (name, true));
        let mut truth = Truth::of_cases(&[name]).unwrap();
        if turned {
            truth.bat = reversed(&truth.bat);
        }
        let (bat, theory) = (&truth.bat, truth.theory);
        let plan = plan(bat, elements, degree);
        let trials = trials(bat, &plan, 16, theory).unwrap();
        let layout = Layout::of(bat, theory).unwrap();
        let norms = Norms::of(bat, &layout, theory).unwrap();
        let proven = Proven::of(bat, &layout, &plan.mesh, theory).unwrap();
        Self { truth, norms, proven, trials }
    }

    /// The number of modes that these trials prove; each must contain the known frequency.
    fn proven_by(&self, trials: &[Trial], told: &str) -> usize {
        let energies: Vec<_> = trials.iter().map(|trial| self.proven.energies(trial)).collect();
        let found = conclude(&energies, &self.norms);
        for (eigenvalue, known) in found.proven.iter().zip(&self.truth.frequencies) {
            assert!(holds(eigenvalue.hertz(), *known), "{told}: {:?} {known}", eigenvalue.hertz());
        }
        found.proven.len()
    }
}

/// `a` and a part of `b`, strain by strain.
fn with(a: &Trial, part: f64, b: &Trial) -> Trial {
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + part * b).collect();
    Trial {
        terms: a.terms,
        bending: sum(&a.bending, &b.bending),
        shear: sum(&a.shear, &b.shear),
        held: sum(&a.held, &b.held),
        bed: std::array::from_fn(|end| a.bed[end] + part * b.bed[end]),
        gives: sum(&a.gives, &b.gives),
    }
}

/// A trial of the same size whose strains belong to no motion.
fn nonsense(like: &Trial, random: &mut Random) -> Trial {
    let bent = like.bending.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    let mut of = |all: &[f64]| {
        let most = all.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        all.iter().map(|_| most * random.signed()).collect()
    };
    let (bending, shear, gives) = (of(&like.bending), of(&like.shear), of(&like.gives));
    Trial {
        terms: like.terms,
        bending,
        shear,
        // The values at supports are not used at all.
        held: like.held.iter().map(|held| (held.abs() + 0.01 * bent) * random.signed()).collect(),
        bed: like.bed.map(|held| (held.abs() + 0.01 * bent) * random.signed()),
        gives,
    }
}

/// Tens of thousands of corrupted trials: noise, mixtures, one missing, one twice, nonsense; of free and of held bats,
/// on fine and on coarse meshes.
#[test]
fn tens_of_thousands_of_lies_prove_nothing_false() {
    let mut random = Random::new(11);
    let (mut attacks, mut proven) = (0, 0);
    let scenes = [
        ("cone_1_2p64", 8, 12),
        ("cone_1_10", 9, 12),
        ("step_1_3", 8, 10),
        ("pchip_bat", 14, 8),
        ("rayleigh_cone", 9, 11),
        ("timo_dowel", 7, 11),
        ("timo_step", 8, 9),
        ("cone_1_2p64", 20, 3),
        ("timo_dowel", 12, 4),
        ("mid_mass", 8, 10),
        ("offset_mass", 8, 10),
        ("clamped_free", 8, 12),
        ("clamped_clamped", 8, 11),
        ("clamped_pinned", 16, 4),
        ("three_supports", 9, 10),
        ("interior_clamp", 8, 10),
        ("end_springs", 8, 10),
        ("soft_springs", 8, 10),
        ("stiff_springs", 8, 10),
        ("clamped_tip_mass", 8, 10),
        ("timo_pinned_pinned", 8, 10),
        ("timo_clamped_tip_mass", 9, 8),
        ("joint", 9, 10),
        // On the knob side of the root, where it was at the root.
        ("joint", 14, 9),
        ("absorber", 9, 10),
        ("joint, from its tip", 9, 10),
        ("absorber, from its tip", 9, 10),
        ("grip_bed", 9, 10),
        ("grip_bed_cone_timo", 9, 9),
    ];
    for (case, elements, degree) in scenes {
        let scene = Scene::new(case, elements, degree);
        let own = &scene.trials;
        let told = format!("{case} on {elements} of degree {degree}");
        // Motions that are wrong for the attached parts prove little.
        let good = scene.proven_by(own, &told);
        assert!(good >= 8, "{told}: {good}");
        for round in 0..140 {
            let size = 10f64.powf(-12.0 * random.share());
            let mut lies = own.clone();
            let (k, other) = ((random.share() * 16.0) as usize, (random.share() * 16.0) as usize);
            match round % 7 {
                // Noise in all, or in one.
                0 => {
                    for lie in &mut lies {
                        let noise = nonsense(lie, &mut random);
                        *lie = with(lie, size, &noise);
                    }
                }
                1 => lies[k] = with(&own[k], size, &nonsense(&own[k], &mut random)),
                // Mixed among themselves.
                2 => {
                    for lie in &mut lies {
                        let other = (random.share() * 16.0) as usize;
                        *lie = with(lie, size * random.signed(), &own[other]);
                    }
                }
                3 => {
                    lies[k] = with(&own[k], random.signed(), &own[other]);
                    lies[other] = with(&own[other], random.signed(), &own[k]);
                }
                // One missing, one twice, one replaced by another.
                4 => {
                    lies.remove(k);
                    assert!(scene.proven_by(&lies, &told) <= k, "{told}: {k} left out");
                }
                5 => lies[k] = own[other].clone(),
                _ => lies[k] = nonsense(&own[k], &mut random),
            }
            proven += scene.proven_by(&lies, &told);
            attacks += lies.len();
        }
    }
    assert!(attacks > 40_000 && proven > 20_000, "{attacks} {proven}");
}

/// Trials that are zero, infinite or not a number prove nothing, and do not affect others.
#[test]
fn trials_that_are_no_numbers_prove_nothing() {
    let scene = Scene::new("cone_1_2p64", 8, 12);
    let good = scene.proven_by(&scene.trials, "good");
    for value in [0.0, f64::NAN, f64::INFINITY, 1e200, 1e-200] {
        let mut lies = scene.trials.clone();
        lies[12].bending.iter_mut().for_each(|c| *c = value);
        assert!(scene.proven_by(&lies, "spoilt") <= good);
    }
}

/// A random-looking bat: ten stations, some steps, a bore.
fn random_bat(random: &mut Random, fixtures: Fixtures) -> Bat {
    let count = 4 + (random.share() * 6.0) as usize;
    let mut x: Vec<f64> = (0..count).map(|k| k as f64 + 0.7 * random.share()).collect();
    let (first, last) = (x[0], x[count - 1]);
    x.iter_mut().for_each(|x| *x = 0.84 * (*x - first) / (last - first));
    (x[0], x[count - 1]) = (0.0, 0.84);
    let outer: Vec<f64> = (0..count).map(|_| 0.009 * 4f64.powf(random.share())).collect();
    let hollow = random.share() > 0.6;
    let inner = outer.iter().map(|r| if hollow { 0.6 * r } else { 0.0 }).collect();
    let smooth = random.share() > 0.3;
    let interpolation = if smooth { Interpolation::Pchip } else { Interpolation::Linear };
    let profile = Profile::new(Stations { x, outer, inner, interpolation }).unwrap();
    let mut wood = sweetspot::Material::new(650.0, 14e9).unwrap();
    wood.shear_modulus = Some(1e9);
    Bat::builder(profile, wood).fixtures(fixtures).build().unwrap()
}

/// Supports and springs to the ground that hold both rigid motions, and a mass.
fn holding(random: &mut Random) -> Fixtures {
    let mut fixtures = Fixtures::default();
    let (mut places, kind) = ([0.0, 0.0], random.share());
    places[0] = 0.4 * random.share();
    places[1] = 0.5 + 0.34 * random.share();
    if random.share() > 0.5 {
        places[0] = 0.0;
    }
    let mut spring = |x: f64, turns: bool| Attachment {
        x,
        mass: 0.1 * random.share(),
        rotary_inertia: 1e-4 * random.share(),
        offset: 0.02 * random.signed(),
        stiffness: 10f64.powf(2.0 + 6.0 * random.share()),
        rotational_stiffness: if turns { 10f64.powf(4.0 * random.share()) } else { 0.0 },
    };
    fixtures.attachments = match kind {
        k if k < 0.3 => vec![spring(places[0], true)],
        k if k < 0.6 => vec![spring(places[0], false), spring(places[1], true)],
        _ => vec![spring(places[1], true)],
    };
    let support = |x: f64, kind: Held| Support { x, kind };
    fixtures.supports = match kind {
        k if k < 0.6 => vec![],
        k if k < 0.7 => vec![support(places[0], Held::Pinned), support(places[1], Held::Pinned)],
        k if k < 0.85 => vec![support(places[0], Held::Clamped)],
        _ => vec![support(places[0], Held::Clamped), support(places[1], Held::Pinned)],
    };
    fixtures
}

/// Joints, and masses on springs, on a free or a held bat.
fn giving(random: &mut Random, fixtures: Fixtures) -> Fixtures {
    let mut place = || 0.02 + 0.8 * random.share();
    let [first, second] = [place(), place()];
    let mut of = |low: f64, decades: f64| 10f64.powf(low + decades * random.share());
    let joint = |x: f64, rotational_stiffness: f64| Joint { x, rotational_stiffness };
    let joints = vec![joint(first, of(2.0, 4.0)), joint(second, of(3.0, 4.0))];
    let mut hung =
        |x: f64| Absorber { x, mass: of(-2.5, 2.0), stiffness: of(3.0, 4.0), damping: 0.0 };
    // One at the place of a joint, one at the end of the bat or at the knob.
    let absorbers = vec![hung(first), hung(if second > 0.4 { 0.84 } else { 0.0 })];
    Fixtures { joints, absorbers, ..fixtures }
}

/// Any two enclosures of one frequency overlap, regardless of their meshes.
#[test]
fn enclosures_from_different_meshes_overlap() {
    let mut random = Random::new(21);
    let (mut pairs, mut ten) = (0, 0);
    for round in 0..120 {
        let held = (40..80).contains(&round) || round >= 100;
        let fixtures = if held { holding(&mut random) } else { Fixtures::default() };
        let fixtures = if round < 80 { fixtures } else { giving(&mut random, fixtures) };
        // Some bats of every kind have hands.
        let mut grip = || Grip {
            from: 0.05 * random.share(),
            to: 0.1 + 0.2 * random.share(),
            stiffness: 10f64.powf(3.0 + 3.0 * random.share()),
            damping: 0.0,
        };
        let grip = (round % 4 == 3).then(&mut grip);
        let fixtures = Fixtures { grip, ..fixtures };
        let bat = random_bat(&mut random, fixtures);
        let theory = Theory::ALL[round % 3];
        let layout = Layout::of(&bat, theory).unwrap();
        let norms = Norms::of(&bat, &layout, theory).unwrap();
        let of = |elements: usize, degree: usize| -> Vec<[f64; 2]> {
            let plan = plan(&bat, elements, degree);
            let tried = trials(&bat, &plan, 16, theory).unwrap();
            let proven = Proven::of(&bat, &layout, &plan.mesh, theory).unwrap();
            let energies: Vec<_> = tried.iter().map(|trial| proven.energies(trial)).collect();
            conclude(&energies, &norms).proven.iter().map(|mode| mode.hertz()).collect()
        };
        let all = [of(30, 10), of(24, 8), of(40, 5), of(60, 3)];
        ten += usize::from(all[0].len() >= 10);
        for (a, b) in [(0, 1), (0, 2), (0, 3), (1, 2)] {
            for ([low, high], [other_low, other_high]) in all[a].iter().zip(&all[b]) {
                assert!(low <= other_high && other_low <= high, "{round} {a} {b}");
                pairs += 1;
            }
        }
    }
    assert!(pairs > 4500 && ten > 90, "{pairs} {ten}");
}
