//! How does another bat differ in one thing, for a central difference?

use sweetspot::base::error::Result;
use sweetspot::bat::body::Bat;
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Profile, Stations};
use sweetspot::bat::turned::DiameterChange;

/// How another bat, or the ball on its wall, differs.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// In a property of one material, wherever the bat has it.
    Of(Box<Material>, Property),
    /// In a property of all materials.
    All(Property),
    /// In all outer diameters, by the same amount.
    Diameters,
    /// In all diameters of bores, by the same amount.
    Bores,
    /// In its length, everything on it moving along.
    Length,
    /// In nothing: the ball presses on another patch of its wall.
    Patch,
}

/// A property of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Property {
    /// E, and G with it.
    Stiffness,
    /// Density.
    Density,
}

/// By what factor the ball may be squeezed more or less than the patch is taken for, as
/// [`sweetspot::collision::wall_figures`] has it.
pub const PATCH_FACTOR: f64 = 2.0;

/// Step of a relative input (in its logarithm), and of diameters and length (m).
const RELATIVE_STEP: f64 = 0.05;
const DIAMETER_STEP: f64 = 1e-4;
const LENGTH_STEP: f64 = 1e-3;

impl Change {
    /// The step of a central difference on that bat: as a logarithm of what is relative, else in m. A patch is
    /// half and twice as large, as `hit` has it: what it does is not small.
    pub fn step(&self, bat: &Bat) -> f64 {
        match self {
            Self::Of(..) | Self::All(_) => RELATIVE_STEP,
            Self::Diameters | Self::Bores => narrowest(bat.profile()).min(DIAMETER_STEP),
            Self::Length => LENGTH_STEP.min(0.01 * bat.length()),
            Self::Patch => PATCH_FACTOR.ln(),
        }
    }
}

/// The thinnest wall or the smallest bore (m): diameters may differ by less.
fn narrowest(profile: &Profile) -> f64 {
    let Stations { outer, inner, .. } = &profile.stations;
    let walls = outer.iter().zip(inner).map(|(outer, inner)| outer - inner);
    walls.chain(inner.iter().copied()).filter(|size| *size > 0.0).fold(f64::INFINITY, f64::min)
}

/// The bat with one thing changed: a property by a factor `e^by`, a measure by so much (m). What comes
/// to a point stays one, and what is solid stays solid.
///
/// # Errors
///
/// [`sweetspot::Error::Value`] where there is no such bat.
pub fn changed(bat: &Bat, change: &Change, by: f64) -> Result<Bat> {
    let scaled = |material: &mut Material, property: Property| match property {
        Property::Density => material.density *= by.exp(),
        Property::Stiffness => {
            material.youngs_modulus *= by.exp();
            material.shear_modulus.iter_mut().for_each(|shear| *shear *= by.exp());
        }
    };
    let all_along = || DiameterChange::band([0.0, bat.length()], by);
    let formulas = bat.profile().formulas.is_some();
    match change {
        Change::Patch => Ok(bat.clone()),
        Change::All(property) => {
            let mut other = bat.clone();
            match property {
                Property::Density => other.scale(by.exp(), 1.0),
                Property::Stiffness => other.scale(1.0, by.exp()),
            }
            Ok(other)
        }
        Change::Of(which, property) => bat.with(|parts| {
            let regions = parts.fixtures.regions.iter_mut();
            let others = regions.flat_map(|region| region.layup.materials_mut());
            let all = std::iter::once(&mut parts.material).chain(others);
            all.filter(|one| **one == **which).for_each(|one| scaled(one, *property));
        }),
        Change::Diameters if formulas => bat.turned(&all_along()),
        Change::Bores if formulas => bat.bored(&all_along()),
        Change::Diameters => reshaped(bat, |stations| wider(&mut stations.outer, by)),
        Change::Bores => reshaped(bat, |stations| wider(&mut stations.inner, by)),
        Change::Length => {
            let ratio = 1.0 + by / bat.length();
            let mut longer = bat.profile().stations.clone();
            longer.x.iter_mut().for_each(|x| *x *= ratio);
            let profile = Profile::new(longer)?;
            bat.with(|parts| {
                parts.profile = profile;
                parts.fixtures.places().for_each(|x| *x *= ratio);
            })
        }
    }
}

fn reshaped(bat: &Bat, change: impl Fn(&mut Stations)) -> Result<Bat> {
    let mut stations = bat.profile().stations.clone();
    change(&mut stations);
    let profile = Profile::new(stations)?;
    bat.with(|parts| parts.profile = profile)
}

/// Radii whose diameters are larger by so much (m).
fn wider(radii: &mut [f64], by: f64) {
    radii.iter_mut().filter(|radius| **radius > 0.0).for_each(|radius| *radius += 0.5 * by);
}
