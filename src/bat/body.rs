//! What bat is this, is it possible, and what are its mass, balance point and swing weight?
//!
//! [`Bat::builder`] makes one from a profile and a material, [`Bat::from_file`] from a bat file. [`Bat::inertia`] gives
//! the rigid body, and `about(`[`STANDARD_PIVOT`]`)` of it the swing weight.

use std::sync::Arc;

use crate::base::marks::written_out;
use crate::base::quadrature::converged;
use crate::base::{Error, Mistakes, Result, RunningSum, gauss, shown_length, significant};
use crate::bat::edit::{Change, Edit};
use crate::bat::fixtures::Fixtures;
use crate::bat::inertia::Inertia;
use crate::bat::layup::{Layup, Worth};
use crate::bat::material::Material;
use crate::bat::part::Part as _;
use crate::bat::profile::{Piece, Profile, Radii, Section};
use crate::bat::weighed::Weighed;

/// Pivot of the standard swing weight: 6 in from the knob end (m).
pub const STANDARD_PIVOT: f64 = 0.1524;

/// A bat: a shape, materials and fixtures. [`Bat::builder`] checks it, so that no later stage checks again; a change
/// makes a new bat ([`Bat::with`]).
#[derive(Debug, Clone, PartialEq)]
pub struct Bat {
    /// Its pieces end wherever a material or a fixture begins.
    parts: Parts,
    /// The layups of the pieces, the bat's own material first.
    layups: Vec<Layup>,
    weighed: Weighed,
    factors: [f64; 2],
    /// Whether the moduli already follow from the tapped frequency.
    heard: bool,
    edits: Vec<Edit>,
    /// The bat before its edits, where it has any.
    unedited: Option<Arc<Bat>>,
}

/// The parts of a bat before it is checked.
///
/// ```
/// use sweetspot::bat::profile::{Interpolation, Stations};
/// use sweetspot::{Bat, Material, Profile};
///
/// # fn main() -> sweetspot::Result<()> {
/// let (x, outer, inner) = (vec![0.0, 0.84], vec![0.0152; 2], vec![0.0; 2]);
/// let dowel = Profile::new(Stations { x, outer, inner, interpolation: Interpolation::Linear })?;
/// let maple = Material::named("sugar-maple-dynamic").expect("it is built in");
/// let bat = Bat::builder(dowel, maple).name("a dowel").mass(Some(0.43)).build()?; // weighed, in kg
/// assert!((bat.inertia().mass - 0.43).abs() < 1e-15);
/// let lighter = bat.with(|parts| parts.material.density *= 0.9)?;
/// assert!((lighter.inertia().mass - 0.387).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Builder {
    parts: Parts,
    weighed: Weighed,
}

/// The parts of a bat, as [`Bat::with`] gives them to be changed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Parts {
    /// Name of the bat.
    pub name: String,
    /// Where the numbers of the bat come from.
    pub source: String,
    /// Whether the bat's file gives lengths in inches; messages to people then name inches first.
    pub inches: bool,
    /// Shape of the bat.
    pub profile: Profile,
    /// The bat's own material.
    pub material: Material,
    /// Fixtures on the bat, and what holds it.
    pub fixtures: Fixtures,
}

impl Builder {
    /// Its name.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.parts.name = name.into();
        self
    }

    /// Where its numbers come from.
    pub fn source(mut self, source: impl Into<String>) -> Self {
        self.parts.source = source.into();
        self
    }

    /// Sets whether lengths are counted in inches, as in a file in inches: see [`Bat::inches`].
    pub fn inches(mut self, inches: bool) -> Self {
        self.parts.inches = inches;
        self
    }

    /// Sets the fixtures on the bat and its supports.
    pub fn fixtures(mut self, fixtures: Fixtures) -> Self {
        self.parts.fixtures = fixtures;
        self
    }

    /// Mass with everything attached (kg), if the bat was weighed: see [`Self::weighed`].
    pub fn mass(mut self, mass: Option<f64>) -> Self {
        self.weighed.mass = mass;
        self
    }

    /// Results of weighing and tapping. The mass includes all fixtures; it sets one factor on all densities. A tapped
    /// frequency is kept for [`crate::modes::tuned`].
    pub fn weighed(mut self, weighed: Weighed) -> Self {
        self.weighed = weighed;
        self
    }

    /// The bat.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] with the path of the key in a bat file as its field, or several of them.
    pub fn build(self) -> Result<Bat> {
        let mut mistakes = Mistakes::default();
        mistakes.note(self.weighed.check("weighed", self.parts.profile.length()));
        let bat = mistakes.some(Bat::of(self.parts, self.weighed, [1.0; 2]));
        mistakes.end(())?;
        let mut bat = bat.expect("what could not be made was noted");
        if let Some(mass) = self.weighed.mass {
            let attached = bat.fixtures().attached_mass();
            let own = mass - attached;
            if own <= 0.0 {
                let found = format!("{mass} kg, no more than the {attached} kg attached");
                return Err(Error::value("weighed.mass", found, "the mass of bat and attachments"));
            }
            bat.scale(own / (bat.inertia().mass - attached), 1.0);
            bat.check_range()?;
        }
        Ok(bat)
    }
}

impl Bat {
    /// A builder for a bat of a shape and a material.
    pub fn builder(profile: Profile, material: Material) -> Builder {
        let (name, source, fixtures) = (String::new(), String::new(), Fixtures::default());
        let parts = Parts { name, source, inches: false, profile, material, fixtures };
        Builder { parts, weighed: Weighed::default() }
    }

    /// A copy of this bat with a change. The densities and moduli that weighing led to are kept: the weighed mass
    /// belongs to the bat before the change and is not applied again. The list of edits is kept too.
    ///
    /// # Errors
    ///
    /// As [`Builder::build`].
    pub fn with(&self, change: impl FnOnce(&mut Parts)) -> Result<Self> {
        let mut parts = self.parts.clone();
        change(&mut parts);
        let bat = Self::of(parts, self.weighed, self.factors)?;
        let (edits, unedited) = (self.edits.clone(), self.unedited.clone());
        Ok(Self { edits, unedited, heard: self.heard, ..bat })
    }

    /// The bat with these parts, after one more edit.
    pub(crate) fn after(
        &self,
        edit: &Edit,
        change: impl FnOnce(&mut Parts) -> Result<()>,
    ) -> Result<Self> {
        let mut parts = self.parts.clone();
        change(&mut parts)?;
        // The new wood was not weighed or tapped.
        let (weighed, factors) = match edit.change {
            Change::Wood(_) => (Weighed::default(), [1.0; 2]),
            _ => (self.weighed, self.factors),
        };
        let bat = Self::of(parts, weighed, factors)?;
        let edits = self.edits.iter().chain([edit]).cloned().collect();
        let unedited = self.unedited.clone().unwrap_or_else(|| Arc::new(self.clone()));
        Ok(Self { edits, unedited: Some(unedited), heard: self.heard, ..bat })
    }

    /// Edits made after the bat was weighed, in order.
    pub fn edits(&self) -> &[Edit] {
        &self.edits
    }

    /// The bat as it was weighed, before its edits; the bat itself if it has no edits.
    pub fn unedited(&self) -> &Self {
        self.unedited.as_deref().unwrap_or(self)
    }

    fn of(mut parts: Parts, weighed: Weighed, factors: [f64; 2]) -> Result<Self> {
        let Parts { profile, fixtures, .. } = &mut parts;
        fixtures.check(profile)?;
        fixtures.settle(&profile.borders());
        let (layups, edits) = (vec![Layup::of(parts.material.clone())], vec![]);
        let mut bat = Self { parts, layups, weighed, factors, heard: false, edits, unedited: None };
        bat.lay_out();
        bat.check_range()?;
        Ok(bat)
    }

    /// Whether the bat's file has its lengths in inches; answers are then in inches too.
    pub fn inches(&self) -> bool {
        self.parts.inches
    }

    /// Name of the bat.
    pub fn name(&self) -> &str {
        &self.parts.name
    }

    /// The name as one line, for a screen.
    pub fn title(&self) -> String {
        written_out(self.name())
    }

    /// Where the numbers of the bat come from.
    pub fn source(&self) -> &str {
        &self.parts.source
    }

    /// Shape of the bat; its pieces end wherever a material or a fixture begins.
    pub fn profile(&self) -> &Profile {
        &self.parts.profile
    }

    /// Layups of the pieces of the profile; the first is the bat's own material.
    pub fn layups(&self) -> &[Layup] {
        &self.layups
    }

    /// Fixtures on the bat, and its supports.
    pub fn fixtures(&self) -> &Fixtures {
        &self.parts.fixtures
    }

    /// Mass, balance point and first frequency as they were measured, of the bat before its edits;
    /// empty for a bat that was made of another wood since.
    pub fn weighed(&self) -> Weighed {
        self.weighed
    }

    /// The tapped frequency (Hz) by which the moduli are still to be fitted. `None` if there is none, or if the moduli
    /// follow from it already ([`crate::modes::tuned`]).
    pub fn tap(&self) -> Option<f64> {
        self.unedited().weighed.first_bending.filter(|_| !self.heard)
    }

    /// Notes that the moduli follow from the tap.
    pub(crate) fn heard(&mut self) {
        self.heard = true;
    }

    /// Factors on all densities and on all moduli that follow from weighing and tapping.
    pub fn factors(&self) -> [f64; 2] {
        self.factors
    }

    /// Cuts the profile where a material or a fixture begins, and assigns each piece its layup.
    fn lay_out(&mut self) {
        let Self { parts: Parts { profile, fixtures, .. }, layups, .. } = self;
        layups.truncate(1);
        profile.pieces.iter_mut().for_each(|piece| piece.layup = 0);
        profile.cut(fixtures.borders());
        for region in &fixtures.regions {
            layups.push(region.layup.clone());
            for piece in &mut profile.pieces {
                if piece.is_within(region.from, region.to) {
                    piece.layup = layups.len() - 1;
                }
            }
        }
        for tape in &fixtures.tapes {
            let per_length = tape.mass / (tape.to - tape.from);
            // Under the tape, a piece gets a copy of its layup that includes the tape.
            let bare = layups.len();
            let mut taped: Vec<Option<usize>> = vec![None; bare];
            for piece in &mut profile.pieces {
                if piece.is_within(tape.from, tape.to) {
                    piece.layup = *taped[piece.layup].get_or_insert_with(|| {
                        let mut layup = layups[piece.layup].clone();
                        layup.tape += per_length;
                        layups.push(layup);
                        layups.len() - 1
                    });
                }
            }
        }
    }

    /// Multiplies every density and every modulus of the bat by a factor.
    pub fn scale(&mut self, density: f64, modulus: f64) {
        self.layups.iter_mut().for_each(|layup| layup.scaled(density, modulus));
        for region in &mut self.parts.fixtures.regions {
            region.layup.scaled(density, modulus);
        }
        self.parts.material.clone_from(&self.layups[0].outer);
        self.factors[0] *= density;
        self.factors[1] *= modulus;
    }

    /// The bat's own material; its density is the weighed one where a weighed mass was given.
    pub fn material(&self) -> &Material {
        &self.parts.material
    }

    /// Length from the knob end to the tip (m).
    pub fn length(&self) -> f64 {
        self.parts.profile.length()
    }

    /// The layup of a piece of the profile.
    #[inline]
    pub fn layup(&self, piece: &Piece) -> &Layup {
        &self.layups[piece.layup]
    }

    /// Stiffness and mass of the section at `x`; at a border, of the section to its right.
    pub fn worth_at(&self, x: f64) -> Worth {
        self.layup(self.parts.profile.piece_at(x)).worth(self.parts.profile.at(x))
    }

    /// Whether a material of the bat has a loss factor.
    pub fn lossy(&self) -> bool {
        let mut layups = self.parts.profile.pieces.iter().map(|piece| self.layup(piece));
        layups.any(|layup| layup.materials().any(|m| m.losses() != [0.0; 2]))
    }

    /// The bat with these loss factors of its materials in bending and in shear.
    ///
    /// # Errors
    ///
    /// Those of [`Self::with`].
    pub fn losing(&self, loss: impl Fn(&Material) -> [f64; 2]) -> Result<Self> {
        self.with(|parts| {
            let layups = parts.fixtures.regions.iter_mut().map(|region| &mut region.layup);
            let materials = layups.flat_map(|layup| layup.materials_mut());
            for material in materials.chain([&mut parts.material]) {
                let [bent, sheared] = loss(material);
                material.loss_factor = bent;
                material.shear_loss_factor = (sheared != bent).then_some(sheared);
            }
        })
    }

    /// The bat with a loss factor for every material: its own, else the published one of its kind, else `unknown`.
    /// Errors are those of [`Self::with`].
    pub fn with_losses(&self, unknown: f64) -> Result<Self> {
        self.losing(|m| {
            let known = Some(m.loss_factor).filter(|loss| *loss > 0.0);
            let loss = known.or(m.published_loss()).unwrap_or(unknown);
            [loss, m.shear_loss_factor.unwrap_or(loss)]
        })
    }

    /// Whether anything damps the bat; otherwise it rings for ever after a hit.
    pub fn damped(&self) -> bool {
        self.lossy() || self.parts.fixtures.damping()
    }

    /// Mass, balance point and moments of inertia with everything attached, exact by quadrature.
    ///
    /// `M = ∫ρA dx`, `x_b = ∫ρA x dx / M`, `I = ∫ρA (x − x_b)² dx + ∫ρI dx`. Cubic radii make the integrands of degree
    /// 8 and 12, which five and seven Gauss points integrate exactly. Formulas take as many points as are needed to
    /// agree to 2e-14.
    pub fn inertia(&self) -> Inertia {
        let attached =
            |f: &dyn Fn([f64; 3]) -> f64| self.parts.fixtures.masses().map(f).sum::<f64>();
        let [mass, first, own] = self.integrals(|x, layup, section| {
            let mass = layup.mass(section);
            [mass, x * mass, layup.turning(section)]
        });
        let mass = mass + attached(&|[mass, ..]| mass);
        let first = first + attached(&|[mass, x, _]| mass * x);
        let balance_point = first / mass;
        let arm = |x: f64| (x - balance_point).powi(2);
        let [line] = self.integrals(|x, layup, section| [arm(x) * layup.mass(section)]);
        let line = line + attached(&|[mass, x, own]| mass * arm(x) + own);
        Inertia { mass, balance_point, about_balance: line + own, line_about_balance: line }
    }

    /// `∫ f dx` over the bat, with `f` a function of the section at `x`.
    fn integrals<const N: usize>(&self, f: impl Fn(f64, &Layup, Section) -> [f64; N]) -> [f64; N] {
        let rule = gauss(7);
        let mut totals = [RunningSum::<f64>::default(); N];
        for piece in &self.parts.profile.pieces {
            let layup = self.layup(piece);
            let of = |s: f64, section: Section| f(piece.start + s * piece.length, layup, section);
            let mut add = |weight: f64, values: [f64; N]| {
                let parts = totals.iter_mut().zip(values);
                parts.for_each(|(total, value)| total.add(weight * piece.length * value));
            };
            match &piece.radii {
                Radii::Cubic(cubics) => {
                    rule.iter().for_each(|(s, weight)| add(*weight, of(*s, cubics.at(*s))));
                }
                Radii::Formula(curves) => add(1.0, converged(|s| of(s, curves.at(s))).values),
            }
        }
        totals.map(|total| total.value())
    }

    /// Layers must be thinner than the wall that they are part of; where the wall comes to a point they may be as
    /// thick.
    fn check_layers(&self) -> Result<()> {
        /// As a share of the wall.
        const ROOM: f64 = 1e-6;
        for piece in &self.parts.profile.pieces {
            let layup = self.layup(piece);
            let layers: f64 = layup.sleeves.iter().map(|layer| layer.thickness).sum();
            let too_thick = |(s, room): &(f64, f64)| {
                let section = piece.at(*s);
                layers
                    > (section.outer - section.inner) * (1.0 + room) + room * 1e-6 * section.outer
            };
            let places = [(0.0, ROOM), (0.5, -ROOM), (1.0, ROOM)];
            let Some((s, _)) = places.into_iter().filter(|_| layers > 0.0).find(too_thick) else {
                continue;
            };
            let section = piece.at(s);
            let regions = self.parts.fixtures.regions.iter();
            let own = regions.enumerate().find(|(_, r)| piece.is_within(r.from, r.to));
            let field = own.map_or("layers".to_owned(), |(k, _)| format!("regions[{k}].layers"));
            let found = format!("{} mm in all", significant(1e3 * layers, 4));
            let expected = format!(
                "less than the wall's {} mm at {}: the region's material is what is left inside",
                significant(1e3 * (section.outer - section.inner), 4),
                shown_length(piece.start + s * piece.length)
            );
            return Err(Error::value(field, found, expected));
        }
        Ok(())
    }

    /// Mass, stiffness and frequencies must be within the range of floating-point numbers.
    fn check_range(&self) -> Result<()> {
        let Inertia { mass, balance_point, about_balance, line_about_balance } = self.inertia();
        in_range("mass", mass, "kg")?;
        // Masses off the bat may put the balance point anywhere.
        in_range("balance point", balance_point.abs().max(1.0), "m")?;
        in_range("moment of inertia", about_balance, "kg m²")?;
        in_range("moment of inertia as a line", line_about_balance, "kg m²")?;
        let widest = Section { outer: self.parts.profile.widest(), inner: 0.0 };
        self.check_layers()?;
        for (k, layup) in self.layups.iter().enumerate() {
            let name = |what: &str| match k {
                k if (1..=self.parts.fixtures.regions.len()).contains(&k) => {
                    format!("regions[{}].{what}", k - 1)
                }
                _ => what.to_owned(),
            };
            for material in layup.materials() {
                let stiffness = material.youngs_modulus * widest.second_moment();
                let scale = stiffness / (material.density * widest.area()) / self.length().powi(4);
                in_range(&name("bending stiffness"), stiffness, "N m²")?;
                in_range(&name("frequency scale EI/(ρA L⁴)"), scale, "1/s²")?;
                let softest = 1e-9 * material.youngs_modulus;
                if let Some(shear) = material.shear_modulus.filter(|shear| *shear < softest) {
                    let expected = format!("{softest:e} Pa and more, a billionth of E");
                    let found = format!("{shear:e} Pa");
                    return Err(Error::value(name("shear_modulus"), found, expected));
                }
            }
        }
        Ok(())
    }
}

/// Far enough inside the range of numbers that products of two such values do not overflow.
fn in_range(what: &str, value: f64, unit: &str) -> Result<()> {
    if value > 1e-100 && value < 1e100 {
        return Ok(());
    }
    let found = match value.is_finite() {
        true => format!("{value:e} {unit}"),
        false => "a value beyond the range of numbers".to_owned(),
    };
    Err(Error::value(what, found, "a value between 1e-100 and 1e100: check the units"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bat::profile::{Interpolation, Stations};

    /// A material keeps the loss factor that it has, and gets the assumed one if nothing is known of it.
    #[test]
    fn losses_are_filled_in_where_there_are_none() {
        let (x, outer) = (vec![0.0, 0.8], vec![0.02; 2]);
        let stations =
            Stations { x, outer, inner: vec![0.0; 2], interpolation: Interpolation::Linear };
        let profile = Profile::new(stations).unwrap();
        for (own, filled) in [(0.01, 0.01), (0.0, 0.03)] {
            let mut material = Material::new(700.0, 1e10).unwrap();
            material.loss_factor = own;
            let bat = Bat::builder(profile.clone(), material).build().unwrap();
            assert_eq!(bat.with_losses(0.03).unwrap().material().loss_factor, filled);
        }
    }
}
