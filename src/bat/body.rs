//! What bat is this, is it possible, and what are its mass, balance point and swing weight?
//!
//! [`Bat::builder`] from a profile and a material, [`Bat::from_file`] from a bat file, [`Bat::inertia`]
//! for the rigid body; `about(`[`STANDARD_PIVOT`]`)` of it is the swing weight.

use std::sync::Arc;

use serde::Serialize;

use crate::base::error::{Error, Result};
use crate::base::mistakes::Mistakes;
use crate::base::number::significant;
use crate::base::quadrature::{RunningSum, converged, gauss};
use crate::base::units::{ounce_square_inches, shown_length};
use crate::bat::edit::{Change, Edit};
use crate::bat::fixtures::Fixtures;
use crate::bat::layup::{Layup, Worth};
use crate::bat::material::{Material, UNTOLD_DENSITY};
use crate::bat::part::Part as _;
use crate::bat::profile::{Piece, Profile, Radii, Section};
use crate::bat::weighed::Weighed;

/// Where standards hold a bat to measure its swing weight: 6 in from the knob end (m).
pub const STANDARD_PIVOT: f64 = 0.1524;

/// A bat: a shape, materials, and what is on it. One that exists is valid, so that no later stage checks
/// again: it is made by [`Bat::builder`], and a change makes another one ([`Bat::with`]).
#[derive(Debug, Clone, PartialEq)]
pub struct Bat {
    name: String,
    source: String,
    inches: bool,
    profile: Profile,
    layups: Vec<Layup>,
    fixtures: Fixtures,
    weighed: Weighed,
    factors: [f64; 2],
    /// Whether the moduli follow from the tap.
    heard: bool,
    edits: Vec<Edit>,
    /// The bat before its edits, where it has any.
    unedited: Option<Arc<Bat>>,
}

/// What a bat is made of, before it is one.
///
/// ```
/// use crate::bat::profile::{Interpolation, Stations};
/// use sweetspot::{Bat, Material, Profile};
///
/// # fn main() -> crate::Result<()> {
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
    /// Whether its lengths are counted in inches, as its file has them: what is said of the bat to
    /// people is said in that unit first.
    pub inches: bool,
    /// Shape of the bat.
    pub profile: Profile,
    /// The bat's own material.
    pub material: Material,
    /// What is on it and what holds it.
    pub fixtures: Fixtures,
}

/// What a bat is as a rigid body; positions from the knob end, inertias transverse.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Inertia {
    /// Mass M (kg).
    pub mass: f64,
    /// Centre of mass (m).
    pub balance_point: f64,
    /// The body's moment of inertia about the balance point (kg m²), as a pendulum measures it.
    pub about_balance: f64,
    /// Moment of inertia about the balance point of the bat as a line of mass, without the sections' own
    /// `∫ρI dx` (kg m²): what an Euler–Bernoulli beam swings with.
    pub line_about_balance: f64,
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

    /// Counted in inches, as in a file in inches: see [`Bat::inches`].
    pub fn inches(mut self, inches: bool) -> Self {
        self.parts.inches = inches;
        self
    }

    /// What is on it and what holds it.
    pub fn fixtures(mut self, fixtures: Fixtures) -> Self {
        self.parts.fixtures = fixtures;
        self
    }

    /// What the bat weighs with everything attached (kg), if it was weighed: see [`Self::weighed`].
    pub fn mass(mut self, mass: Option<f64>) -> Self {
        self.weighed.mass = mass;
        self
    }

    /// What a scale and a tap said. The mass includes what is attached; it sets one factor on all
    /// densities. A tapped frequency is kept for [`crate::modes::tuned`].
    pub fn weighed(mut self, weighed: Weighed) -> Self {
        self.weighed = weighed;
        self
    }

    /// The bat.
    ///
    /// # Errors
    ///
    /// [`Error::Value`], its field the path of a key in a bat file, or several of them.
    pub fn build(self) -> Result<Bat> {
        let mut mistakes = Mistakes::default();
        mistakes.note(self.weighed.check("weighed", self.parts.profile.length()));
        let bat = mistakes.some(Bat::of(self.parts, self.weighed, [1.0; 2]));
        mistakes.end(())?;
        let mut bat = bat.expect("what could not be made was noted");
        if let Some(mass) = self.weighed.mass {
            let attached = bat.fixtures.attached_mass();
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
    /// A bat of a shape and a material, to which more can be told before it is built.
    pub fn builder(profile: Profile, material: Material) -> Builder {
        let (name, source, fixtures) = (String::new(), String::new(), Fixtures::default());
        let parts = Parts { name, source, inches: false, profile, material, fixtures };
        Builder { parts, weighed: Weighed::default() }
    }

    /// A bat like this one with something changed. What was weighed stays as it led to densities and moduli: it
    /// was said of the bat before the change, and is not asked again. Its edits stay on its list.
    ///
    /// # Errors
    ///
    /// As [`Builder::build`].
    pub fn with(&self, change: impl FnOnce(&mut Parts)) -> Result<Self> {
        let mut parts = self.parts();
        change(&mut parts);
        let bat = Self::of(parts, self.weighed, self.factors)?;
        let (edits, unedited) = (self.edits.clone(), self.unedited.clone());
        Ok(Self { edits, unedited, heard: self.heard, ..bat })
    }

    fn parts(&self) -> Parts {
        Parts {
            name: self.name.clone(),
            source: self.source.clone(),
            inches: self.inches,
            profile: self.profile.clone(),
            material: self.material().clone(),
            fixtures: self.fixtures.clone(),
        }
    }

    /// The bat with these parts, which one more edit has made of its own.
    pub(crate) fn after(
        &self,
        edit: &Edit,
        change: impl FnOnce(&mut Parts) -> Result<()>,
    ) -> Result<Self> {
        let mut parts = self.parts();
        change(&mut parts)?;
        // Another wood is not the one that was weighed and tapped.
        let (weighed, factors) = match edit.change {
            Change::Wood(_) => (Weighed::default(), [1.0; 2]),
            _ => (self.weighed, self.factors),
        };
        let bat = Self::of(parts, weighed, factors)?;
        let edits = self.edits.iter().chain([edit]).cloned().collect();
        let unedited = self.unedited.clone().unwrap_or_else(|| Arc::new(self.clone()));
        Ok(Self { edits, unedited: Some(unedited), heard: self.heard, ..bat })
    }

    /// What was changed after it was weighed, in the order in which it was done.
    pub fn edits(&self) -> &[Edit] {
        &self.edits
    }

    /// The bat as it was weighed, before its edits; the bat itself where it has none.
    pub fn unedited(&self) -> &Self {
        self.unedited.as_deref().unwrap_or(self)
    }

    fn of(parts: Parts, weighed: Weighed, factors: [f64; 2]) -> Result<Self> {
        let Parts { name, source, inches, profile, material, mut fixtures } = parts;
        let layups = vec![Layup::of(material)];
        fixtures.check(profile.length())?;
        fixtures.settle(&profile.borders());
        let (edits, unedited) = (vec![], None);
        let mut bat = Self {
            name,
            source,
            inches,
            profile,
            layups,
            fixtures,
            weighed,
            factors,
            heard: false,
            edits,
            unedited,
        };
        bat.lay_out();
        bat.check_range()?;
        Ok(bat)
    }

    /// Whether the bat's file has its lengths in inches: people who measure so are answered so.
    pub fn inches(&self) -> bool {
        self.inches
    }

    /// Name of the bat.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where the numbers of the bat come from.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Shape of the bat; its pieces end wherever a material or a fixture begins.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// What the pieces of the profile are made of; the first is the bat's own material.
    pub fn layups(&self) -> &[Layup] {
        &self.layups
    }

    /// What is on it and what holds it.
    pub fn fixtures(&self) -> &Fixtures {
        &self.fixtures
    }

    /// Mass, balance point and first frequency as they were measured, of the bat before its edits;
    /// nothing of a bat that was made of another wood since.
    pub fn weighed(&self) -> Weighed {
        self.weighed
    }

    /// The tapped frequency (Hz) by which the moduli are still to be found; None where there is none, or
    /// where they follow from it already ([`crate::modes::tuned`]).
    pub fn tap(&self) -> Option<f64> {
        self.unedited().weighed.first_bending.filter(|_| !self.heard)
    }

    /// Notes that the moduli follow from the tap.
    pub(crate) fn heard(&mut self) {
        self.heard = true;
    }

    /// Factors on all densities and on all moduli that weighing and tapping led to.
    pub fn factors(&self) -> [f64; 2] {
        self.factors
    }

    /// Cuts the profile where a material or a fixture begins, and tells every piece its layup.
    fn lay_out(&mut self) {
        self.layups.truncate(1);
        self.profile.pieces.iter_mut().for_each(|piece| piece.layup = 0);
        self.profile.cut(self.fixtures.borders());
        for region in &self.fixtures.regions {
            self.layups.push(region.layup.clone());
            for piece in &mut self.profile.pieces {
                if piece.is_within(region.from, region.to) {
                    piece.layup = self.layups.len() - 1;
                }
            }
        }
        for tape in &self.fixtures.tapes {
            let per_length = tape.mass / (tape.to - tape.from);
            // Each layup under it once more, with the tape.
            let bare = self.layups.len();
            let mut taped: Vec<Option<usize>> = vec![None; bare];
            for piece in &mut self.profile.pieces {
                if piece.is_within(tape.from, tape.to) {
                    let layups = &mut self.layups;
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

    /// One factor on every density and one on every modulus of the bat.
    pub fn scale(&mut self, density: f64, modulus: f64) {
        self.layups.iter_mut().for_each(|layup| layup.scaled(density, modulus));
        for region in &mut self.fixtures.regions {
            region.layup.scaled(density, modulus);
        }
        self.factors[0] *= density;
        self.factors[1] *= modulus;
    }

    /// The bat's own material; its density is the weighed one where a weighed mass was given.
    pub fn material(&self) -> &Material {
        &self.layups[0].outer
    }

    /// Length from the knob end to the tip (m).
    pub fn length(&self) -> f64 {
        self.profile.length()
    }

    /// What a piece of the profile is made of.
    #[inline]
    pub fn layup(&self, piece: &Piece) -> &Layup {
        &self.layups[piece.layup]
    }

    /// What the section at `x` is worth, at a border the one to its right.
    pub fn worth_at(&self, x: f64) -> Worth {
        self.layup(self.profile.piece_at(x)).worth(self.profile.at(x))
    }

    /// Whether a material of the bat has a loss factor.
    pub fn lossy(&self) -> bool {
        let mut layups = self.profile.pieces.iter().map(|piece| self.layup(piece));
        layups.any(|layup| layup.materials().any(|material| material.loss_factor > 0.0))
    }

    /// The bat with materials that lose nothing.
    ///
    /// # Errors
    ///
    /// Those of [`Self::with`].
    pub fn lossless(&self) -> Result<Self> {
        self.with(|parts| {
            parts.material.loss_factor = 0.0;
            let layups = parts.fixtures.regions.iter_mut().map(|region| &mut region.layup);
            let materials = layups.flat_map(|layup| layup.materials_mut());
            materials.for_each(|material| material.loss_factor = 0.0);
        })
    }

    /// Whether anything damps the bat; else it rings without end after a hit.
    pub fn damped(&self) -> bool {
        self.lossy() || self.fixtures.damping()
    }

    /// Whether every stretch of the bat has a shear modulus.
    pub fn knows_shear(&self) -> bool {
        let known = |piece: &Piece| {
            self.layup(piece).materials().all(|material| material.shear_modulus.is_some())
        };
        self.profile.pieces.iter().all(known)
    }

    /// The materials of the regions, each with what a bat file calls it.
    pub fn regional(&self) -> impl Iterator<Item = (String, &Material)> {
        // An edit makes regions of its own, which no file knows.
        let of_file = self.edits.is_empty();
        self.fixtures.regions.iter().enumerate().flat_map(move |(k, region)| {
            let name = move |part: &str| match of_file {
                true => format!("regions[{k}].{part}"),
                false => format!("a {part} of regions or edits"),
            };
            let Layup { outer, core, sleeves, .. } = &region.layup;
            let core = core.iter().map(move |core| (name("core"), core));
            let layer = move |m: usize| {
                if of_file { name(&format!("layers[{m}].material")) } else { name("sleeve") }
            };
            let sleeves = sleeves.iter().enumerate().map(move |(m, own)| (layer(m), &own.material));
            std::iter::once((name("material"), outer)).chain(core).chain(sleeves)
        })
    }

    /// The first material whose shear modulus is not known, as the bat file calls it.
    pub fn without_shear(&self) -> String {
        let unknown = |material: &Material| material.shear_modulus.is_none();
        let region = self.regional().find(|(_, material)| unknown(material));
        match region {
            Some((name, _)) if !unknown(self.material()) => name,
            _ => "material".to_owned(),
        }
    }

    /// Mass, balance point and moments of inertia with everything attached, exact by quadrature.
    ///
    /// `M = ∫ρA dx`, `x_b = ∫ρA x dx / M`, `I = ∫ρA (x − x_b)² dx + ∫ρI dx`; cubic radii make
    /// the integrands of degree 8 and 12, which five and seven Gauss points integrate exactly.
    /// Formulas take as many points as agree to 2e-14.
    pub fn inertia(&self) -> Inertia {
        let attached = |f: &dyn Fn([f64; 3]) -> f64| self.fixtures.masses().map(f).sum::<f64>();
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

    /// `∫ f dx` over the bat of something about the section at `x`.
    fn integrals<const N: usize>(&self, f: impl Fn(f64, &Layup, Section) -> [f64; N]) -> [f64; N] {
        let rule = gauss(7);
        let mut totals = [RunningSum::<f64>::default(); N];
        for piece in &self.profile.pieces {
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

    /// Possible but strange for a bat: one sentence each, to be shown and not to stop anybody.
    pub fn warnings(&self) -> Vec<String> {
        let Inertia { mass, balance_point, .. } = self.inertia();
        let length = self.length();
        let widest = self.profile.stations.outer.iter().fold(0.0_f64, |a, b| a.max(*b));
        let checks = [
            ("length", length, "m", 0.3, 1.2, " (bare numbers are in m: \"unit\": \"in\"?)"),
            ("largest radius", widest, "m", 0.01, 0.05, " (a diameter given as radius?)"),
            ("mass", mass, "kg", 0.2, 2.0, " (bare numbers are in kg: \"31 oz\"?)"),
            ("balance point", balance_point, "m", 0.0, length, ""),
        ];
        let checks = checks.into_iter();
        let strange = checks.filter_map(|(what, value, unit, low, high, hint)| {
            strange(what, value, unit, [low, high], hint)
        });
        let mut warnings: Vec<String> = strange.collect();
        warnings.extend(strange_material("", self.material(), WALL));
        warnings.extend(self.density_off());
        self.warn_of_regions(&mut warnings);
        let attached = self.fixtures.attached_mass();
        if attached > mass - attached {
            let [attached, own] = [attached, mass - attached].map(plain);
            warnings.push(format!("{attached} kg are attached to a bat of {own} kg"));
        }
        for (k, a) in self.fixtures.attachments.iter().enumerate() {
            let center = a.x + a.offset;
            if a.mass > 0.0 && !(0.0..=length).contains(&center) {
                let [center, length] = [center, length].map(plain);
                let offset = format!("attachments[{k}].offset puts the mass at {center} m");
                warnings.push(format!("{offset}, outside the bat, 0 to {length} m"));
            }
        }
        warnings
    }

    /// What there is to say of a density that no such material has: that which the mass on the scale asks for, far
    /// from the file's, or one in the file that does not go with the stiffness.
    ///
    /// Wood is within 0.8 to 1.25 of its kind's density, a metal within a tenth of its own.
    pub fn density_off(&self) -> Option<String> {
        let before = self.unedited();
        let (material, factor) = (before.material(), before.factors[0]);
        let own = Material { density: material.density / factor, ..material.clone() };
        // A material without a density of its own has the one that it weighs.
        if (own.density / UNTOLD_DENSITY - 1.0).abs() < 1e-9 {
            return None;
        }
        // A tap sets the stiffness; the file's is the material's own.
        let own = Material { youngs_modulus: own.youngs_modulus / before.factors[1], ..own };
        let usual = if own.is_metal() { 0.9..1.1 } else { 0.8..1.25 };
        if usual.contains(&factor) {
            return own.no_material();
        }
        let hollow = before.profile.pieces.iter().any(|piece| piece.at(0.5).inner > 0.0);
        let [needed, has] = [material.density, own.density].map(plain);
        let of = own.name.map_or(String::new(), |name| format!(" of {name}"));
        let hint = match (factor < 1.0, hollow) {
            (true, false) => {
                "is the bat hollow? its wall goes into the file: \"wall_thickness\" in \"profile\""
            }
            (true, true) => "is the wall thinner, or the mass or a diameter off?",
            (false, true) => {
                "is the wall thicker, or a plug, a cap, a knob or a tape not in the file?"
            }
            (false, false) => "is it another material, or the mass or a diameter off?",
        };
        Some(format!(
            "to weigh so much it must have {needed} kg/m³, far from the {has} kg/m³{of}: {hint}"
        ))
    }

    /// What there is to say of a balance point that was measured far from where the profile has it.
    pub fn balance_off(&self) -> Option<String> {
        /// Beyond what a rule and an edge of a table tell (m).
        const FAR: f64 = 0.01;
        let measured = self.weighed.balance_point?;
        let computed = self.unedited().inertia().balance_point;
        ((computed - measured).abs() > FAR).then(|| {
            let [computed, measured] = [computed, measured].map(shown_length);
            format!(
                "the balance point was measured at {measured}, and is at {computed} by the profile: the \
                 diameters, the mass or the measured place is off, or the wood is not alike everywhere"
            )
        })
    }

    /// The swing weight that was measured (kg m², about 6 in from the knob end), as such or by a pendulum:
    /// `I = m g d T²/4π²` about its pivot, d from there to the balance point, with mass and balance point as
    /// they were measured, or else as computed.
    pub fn measured_swing_weight(&self) -> Option<f64> {
        const GRAVITY: f64 = 9.806_65;
        let weighed = self.weighed;
        let of_pendulum = || {
            let computed = self.unedited().inertia();
            let mass = weighed.mass.unwrap_or(computed.mass);
            let balance_point = weighed.balance_point.unwrap_or(computed.balance_point);
            let arm = balance_point - weighed.pendulum_pivot.unwrap_or(STANDARD_PIVOT);
            let turns = weighed.pendulum_period? / std::f64::consts::TAU;
            let about_pivot = mass * GRAVITY * arm.abs() * turns.powi(2);
            let other = balance_point - STANDARD_PIVOT;
            Some(about_pivot + mass * (other.powi(2) - arm.powi(2)))
        };
        weighed.swing_weight.or_else(of_pendulum)
    }

    /// What there is to say of a swing weight that was measured far from what the profile has.
    pub fn swing_weight_off(&self) -> Option<String> {
        /// Beyond what a pendulum and a table of diameters tell (share).
        const FAR: f64 = 0.02;
        let measured = self.measured_swing_weight()?;
        let computed = self.unedited().inertia().about(STANDARD_PIVOT);
        ((computed / measured - 1.0).abs() > FAR || measured <= 0.0).then(|| {
            let told = |value: f64| format!("{:.0} oz in²", ounce_square_inches(value));
            let [computed, measured] = [computed, measured].map(told);
            format!(
                "the swing weight (6 in from the knob) was measured as {measured}, and is {computed} by the \
                 profile: the diameters, the mass or what was measured is off, or the wood is not alike \
                 everywhere"
            )
        })
    }

    fn warn_of_regions(&self, warnings: &mut Vec<String>) {
        for (k, region) in self.fixtures.regions.iter().enumerate() {
            let name = |key: &str| format!("regions[{k}].{key}.");
            let Layup { outer, core, .. } = &region.layup;
            if outer != self.material() {
                warnings.extend(strange_material(&name("material"), outer, WALL));
            }
            let Some(core) = core else { continue };
            warnings.extend(strange_material(&name("core"), core, CORE));
            let solid = |piece: &Piece| [0.0, 0.5, 1.0].iter().all(|s| piece.at(*s).inner == 0.0);
            let here = |piece: &&Piece| piece.is_within(region.from, region.to);
            if self.profile.pieces.iter().filter(here).all(solid) {
                warnings.push(format!("regions[{k}].core fills nothing: the bat is solid there"));
            }
        }
    }

    /// Layers are thinner than the wall they are part of; where it comes to a point they are as thick.
    fn check_layers(&self) -> Result<()> {
        /// As a share of the wall.
        const ROOM: f64 = 1e-6;
        for piece in &self.profile.pieces {
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
            let regions = self.fixtures.regions.iter();
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

    /// Mass, stiffness and the frequencies they make must be numbers a computer can hold.
    fn check_range(&self) -> Result<()> {
        let Inertia { mass, balance_point, about_balance, line_about_balance } = self.inertia();
        in_range("mass", mass, "kg")?;
        // Masses beside the bat may put it anywhere.
        in_range("balance point", balance_point.abs().max(1.0), "m")?;
        in_range("moment of inertia", about_balance, "kg m²")?;
        in_range("moment of inertia as a line", line_about_balance, "kg m²")?;
        let outer = self.profile.stations.outer.iter().fold(0.0_f64, |a, b| a.max(*b));
        let widest = Section { outer, inner: 0.0 };
        self.check_layers()?;
        for (k, layup) in self.layups.iter().enumerate() {
            let name = |what: &str| match k {
                k if (1..=self.fixtures.regions.len()).contains(&k) => {
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
                    return Err(Error::value(
                        name("shear_modulus"),
                        format!("{shear:e} Pa"),
                        expected,
                    ));
                }
            }
        }
        Ok(())
    }
}

/// Usual densities (kg/m³) and Young's moduli (Pa) of what bats are made of, and of what fills
/// them.
const WALL: [[f64; 2]; 2] = [[50.0, 20e3], [1e9, 1e12]];
const CORE: [[f64; 2]; 2] = [[5.0, 20e3], [1e4, 1e12]];

/// What is strange in a material; `of` is the path that leads to it.
fn strange_material(
    of: &str,
    material: &Material,
    usual: [[f64; 2]; 2],
) -> impl Iterator<Item = String> {
    let Material { density, youngs_modulus, .. } = *material;
    let hint = " (wood is 400 to 900: g/cm³ or lb/in³?)";
    let heavy = strange(&format!("{of}density"), density, "kg/m³", usual[0], hint);
    let hint = " (wood is 8e9 to 20e9: GPa?)";
    let stiff = strange(&format!("{of}youngs_modulus"), youngs_modulus, "Pa", usual[1], hint);
    // Along the grain of wood 0.05 to 0.11, of metals 0.38.
    let shear = material.shear_modulus.map(|shear| shear / youngs_modulus);
    let shear = shear.and_then(|share| {
        strange(&format!("{of}shear_modulus"), share, "times youngs_modulus", [0.01, 0.6], "")
    });
    let kappa = material
        .shear_coefficient
        .and_then(|kappa| strange(&format!("{of}shear_coefficient"), kappa, "", [0.3, 1.2], ""));
    heavy.into_iter().chain(stiff).chain(shear).chain(kappa)
}

/// A sentence about a value that is outside the usual range.
fn strange(what: &str, value: f64, unit: &str, usual: [f64; 2], hint: &str) -> Option<String> {
    if value >= usual[0] && value <= usual[1] {
        return None;
    }
    let [value, low, high] = [value, usual[0], usual[1]].map(plain);
    let value = format!("{value} {unit}");
    Some(format!("{what} is {}; a bat's is {low} to {high}{hint}", value.trim_end()))
}

/// Far enough inside the range of numbers for products of two such values.
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

/// Four digits, with a power of ten where the plain number would be a row of zeros.
fn plain(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().expect("it was written as a number");
    if rounded == 0.0 || (1e-3..1e5).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

impl Inertia {
    /// The body's moment of inertia about the point `x` (kg m²).
    pub fn about(&self, x: f64) -> f64 {
        self.about_balance + self.mass * (self.balance_point - x).powi(2)
    }

    /// The centre of percussion of a bat swung about the point `pivot`: `pivot + I/(M d)`,
    /// `d` from the pivot to the balance point. None if the pivot is the balance point.
    pub fn center_of_percussion(&self, pivot: f64) -> Option<f64> {
        let arm = self.balance_point - pivot;
        let center = pivot + self.about(pivot) / (self.mass * arm);
        center.is_finite().then_some(center)
    }

    /// The bat as a line of mass: what an Euler–Bernoulli beam has for a rigid body.
    pub fn as_line(self) -> Self {
        Self { about_balance: self.line_about_balance, ..self }
    }
}
