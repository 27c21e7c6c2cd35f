//! How does another bat differ in one thing, for a central difference?

use crate::engine::{Bat, DiameterChange, Material, Profile, Result, Stations};
use crate::inputs::Input;

/// A property by which another bat, or the ball on its wall, differs.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Which input. A mass on the scale is all densities, a tap the stiffness of all materials.
    pub input: Input,
    /// The only material that differs; `None` for all materials, and for a property that belongs to none.
    pub of: Option<Material>,
}

/// Factor by which the ball may be compressed more or less than the patch assumes, as in
/// [`sweetspot::collision::wall_figures`].
pub const PATCH_FACTOR: f64 = 2.0;

/// Step of a relative input (in its logarithm), and of diameters and length (m).
const RELATIVE_STEP: f64 = 0.05;
const DIAMETER_STEP: f64 = 1e-4;
const LENGTH_STEP: f64 = 1e-3;

impl Parameter {
    /// A property of the whole bat.
    pub fn whole(input: Input) -> Self {
        Self { input, of: None }
    }

    /// The step of a central difference on that bat: a logarithm for relative properties, else m. A patch is halved and
    /// doubled, as in `hit`: its effect is not small.
    pub fn step(&self, bat: &Bat) -> f64 {
        match self.input {
            Input::Stiffness | Input::Density | Input::Mass | Input::Tap => RELATIVE_STEP,
            Input::Diameters | Input::Bores => narrowest(bat.profile()).min(DIAMETER_STEP),
            Input::Length => LENGTH_STEP.min(0.01 * bat.length()),
            Input::Patch => PATCH_FACTOR.ln(),
        }
    }
}

/// The thinnest wall or the smallest bore (m): diameters may differ by less.
fn narrowest(profile: &Profile) -> f64 {
    let Stations { outer, inner, .. } = &profile.stations;
    let walls = outer.iter().zip(inner).map(|(outer, inner)| outer - inner);
    walls.chain(inner.iter().copied()).filter(|size| *size > 0.0).fold(f64::INFINITY, f64::min)
}

/// The bat with one property changed: by a factor `e^by`, or a measure by `by` (m). A point stays a point, and a solid
/// part stays solid.
///
/// # Errors
///
/// [`sweetspot::Error::Value`] if there is no such bat.
pub fn changed(bat: &Bat, parameter: &Parameter, by: f64) -> Result<Bat> {
    let all_along = || DiameterChange::band([0.0, bat.length()], by);
    let formulas = bat.profile().formulas.is_some();
    match parameter.input {
        Input::Patch => Ok(bat.clone()),
        Input::Density | Input::Mass => heavier_and_stiffer(bat, &parameter.of, [by.exp(), 1.0]),
        Input::Stiffness | Input::Tap => heavier_and_stiffer(bat, &parameter.of, [1.0, by.exp()]),
        Input::Diameters if formulas => bat.turned(&all_along()),
        Input::Bores if formulas => bat.bored(&all_along()),
        Input::Diameters => reshaped(bat, |stations| wider(&mut stations.outer, by)),
        Input::Bores => reshaped(bat, |stations| wider(&mut stations.inner, by)),
        Input::Length => {
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

/// The bat with denser and stiffer materials, all or only one, by these factors.
fn heavier_and_stiffer(
    bat: &Bat,
    of: &Option<Material>,
    [denser, stiffer]: [f64; 2],
) -> Result<Bat> {
    let Some(which) = of else {
        let mut other = bat.clone();
        other.scale(denser, stiffer);
        return Ok(other);
    };
    bat.with(|parts| {
        let regions = parts.fixtures.regions.iter_mut();
        let others = regions.flat_map(|region| region.layup.materials_mut());
        let all = std::iter::once(&mut parts.material).chain(others);
        all.filter(|one| **one == *which).for_each(|one| {
            one.density *= denser;
            one.youngs_modulus *= stiffer;
            one.shear_modulus.iter_mut().for_each(|shear| *shear *= stiffer);
        });
    })
}

fn reshaped(bat: &Bat, change: impl Fn(&mut Stations)) -> Result<Bat> {
    let mut stations = bat.profile().stations.clone();
    change(&mut stations);
    let profile = Profile::new(stations)?;
    bat.with(|parts| parts.profile = profile)
}

/// Increases the diameters of radii by this (m).
fn wider(radii: &mut [f64], by: f64) {
    radii.iter_mut().filter(|radius| **radius > 0.0).for_each(|radius| *radius += 0.5 * by);
}
