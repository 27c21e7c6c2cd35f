//! Sizes, stiffnesses and numbers of modes far beyond any bat, in the dowel's closed form.

use crate::bundled::bundled_bat;
use crate::extremes::judge::{against, apart, difference, refusal};
use crate::extremes::{Outcome, Verdict};
use crate::promise::largest;
use crate::validation::Truth;
use sweetspot::base::Result;
use sweetspot::bat::{Bat, Interpolation, Material, Profile, Stations};
use sweetspot::beam::{Dowel, Ends};
use sweetspot::modes::solve::{Request, Solution, solve};

/// A solid round bar in SI units; by default one like a bat.
#[derive(Debug, Clone, Copy)]
pub struct Size {
    pub length: f64,
    pub radius: f64,
    pub modulus: f64,
}

impl Default for Size {
    fn default() -> Self {
        Self { length: 0.8382, radius: 0.0213, modulus: 13.9e9 }
    }
}

const DENSITY: f64 = 711.0;
/// Requested accuracy of ten modes of a dowel of any size.
const ASKED: f64 = 1e-12;
/// Allowed effect of changing a unit by decades: a few roundings.
const DECADES: f64 = 1e-13;

/// The bat that this bar is.
pub fn dowel(size: Size) -> Result<Bat> {
    let profile = Profile::new(Stations {
        x: vec![0.0, size.length],
        outer: vec![size.radius; 2],
        inner: vec![0.0; 2],
        interpolation: Interpolation::Linear,
    })?;
    Bat::builder(profile, Material::new(DENSITY, size.modulus)?).build()
}

fn of_size(size: Size) -> Result<Outcome> {
    let Size { length, radius, modulus: youngs_modulus } = size;
    let exact = Dowel { length, radius, youngs_modulus, density: DENSITY };
    let exact: Vec<f64> = (1..=10).map(|n| exact.frequency(Ends::FreeFree, n)).collect();
    let request = Request { tolerance: ASKED, ..Request::plain() };
    Ok(against(ASKED, &solve(&dowel(size)?, &request)?, &exact))
}

pub fn slenderness(ratio: f64) -> Result<Outcome> {
    let radius = Size::default().length / ratio;
    of_size(Size { radius, ..Size::default() })
}

pub fn modulus(modulus: f64) -> Result<Outcome> {
    of_size(Size { modulus, ..Size::default() })
}

/// A bar of that length and a bat's proportions.
pub fn length(length: f64) -> Result<Outcome> {
    let like = Size::default();
    of_size(Size { length, radius: like.radius * length / like.length, ..like })
}

/// A stiffness whose products exceed the range of numbers.
pub fn out_of_range(modulus: f64) -> Result<Outcome> {
    Ok(refusal(ASKED, dowel(Size { modulus, ..Size::default() })))
}

/// That many modes of the dowel, each with the number of nodes that theory requires.
pub fn modes(count: usize, asked: f64) -> Result<Outcome> {
    let truth = Truth::of_dowel(count)?;
    let request = Request { modes: count, tolerance: asked, ..Request::plain() };
    let solution = solve(&truth.bat, &request)?;
    let outcome = against(asked, &solution, &truth.frequencies);
    let lost = "a mode has not its nodes".to_owned();
    Ok(if solution.complete {
        outcome
    } else {
        Outcome { verdict: Verdict::Wrong(lost), ..outcome }
    })
}

/// The R161 with all lengths, E and ρ multiplied.
fn r161_times(length: f64, modulus: f64, density: f64) -> Result<Bat> {
    let original = bundled_bat("meshes/r161.json")?;
    let times = |values: &[f64]| values.iter().map(|v| v * length).collect::<Vec<f64>>();
    let stations = &original.profile().stations;
    let profile = Profile::new(Stations {
        x: times(&stations.x),
        outer: times(&stations.outer),
        inner: times(&stations.inner),
        interpolation: stations.interpolation,
    })?;
    let material = original.material();
    let material = Material::new(material.density * density, material.youngs_modulus * modulus)?;
    Bat::builder(profile, material).build()
}

fn on_one_mesh(bat: &Bat) -> Result<Solution> {
    solve(bat, &Request { elements: Some(48), degree: Some(6), ..Request::plain() })
}

/// Frequencies are proportional to √(E/ρ)/L. The R161 on one mesh with E, ρ and L by powers of ten.
fn by_decades(scales: impl Iterator<Item = [f64; 3]>) -> Result<Outcome> {
    let plain = on_one_mesh(&r161_times(1.0, 1.0, 1.0)?)?;
    let mut found = Vec::new();
    for [length, modulus, density] in scales {
        let scaled = on_one_mesh(&r161_times(length, modulus, density)?)?;
        found.push(apart(&plain, &scaled, length * (density / modulus).sqrt()));
    }
    Ok(difference(DECADES, largest(found.into_iter()), plain.worst()))
}

/// E from 1 to 1e15 Pa.
pub fn moduli_by_decades() -> Result<Outcome> {
    let own = bundled_bat("meshes/r161.json")?.material().youngs_modulus;
    by_decades((0..=15).map(|decade| [1.0, 10f64.powi(decade) / own, 1.0]))
}

/// The bat from 1 µm to 1 km long, and its density by as much.
pub fn lengths_by_decades() -> Result<Outcome> {
    by_decades((-6..=3).flat_map(|decade| {
        let factor = 10f64.powi(decade);
        [[factor, 1.0, 1.0], [1.0, 1.0, factor]]
    }))
}

/// Powers of two change no digit, so this shows that nothing depends on absolute thresholds.
fn by_twos(solve: impl Fn(&Bat) -> Result<Solution>, step: [i32; 3]) -> Result<Outcome> {
    let plain = solve(&r161_times(1.0, 1.0, 1.0)?)?;
    let mut found = Vec::new();
    for count in [-4, -1, 1, 4] {
        for k in 0..3 {
            let mut scale = [1.0; 3];
            scale[k] = 2f64.powi(count * step[k]);
            let [length, modulus, density] = scale;
            let scaled = solve(&r161_times(length, modulus, density)?)?;
            found.push(apart(&plain, &scaled, length * (density / modulus).sqrt()));
        }
    }
    Ok(difference(0.0, largest(found.into_iter()), plain.worst()))
}

/// On one mesh: lengths by 1/16 to 16, E and density by 1/256 to 256.
pub fn powers_of_two() -> Result<Outcome> {
    by_twos(on_one_mesh, [1, 2, 2])
}

/// With the plan made anew: it takes fourth roots of E/ρ over lengths squared, so the steps are
/// of 4 and of 16.
pub fn powers_of_two_planned() -> Result<Outcome> {
    let request = Request { tolerance: 1e-8, ..Request::plain() };
    by_twos(|bat| solve(bat, &request), [2, 4, 4])
}
