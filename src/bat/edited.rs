//! How does a list of edits change the bat?
//!
//! The density is that of the bat before the edits, as weighing settled it. Wood that is taken off therefore reduces
//! the mass, and an added weight increases it.

use crate::base::{Complaint, Error, Result};
use crate::bat::body::{Bat, Parts};
use crate::bat::edit::{Change, Edit, Sleeve};
use crate::bat::fixtures::{Attachment, Fixtures, Region, Tape};
use crate::bat::layup::{Layer, Layup};
use crate::bat::material::Material;
use crate::bat::part::{Part as _, shown};
use crate::bat::profile::{Piece, SAME_PLACE};
use crate::bat::rework::{Blended, place};

impl Bat {
    /// Layups of the pieces in a stretch (m).
    fn layups_on(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = &Layup> {
        let same = SAME_PLACE * self.length();
        let here = move |piece: &&Piece| {
            piece.start < to - same && piece.start + piece.length > from + same
        };
        self.profile().pieces.iter().filter(here).map(|piece| self.layup(piece))
    }

    /// Whether there is a sleeve somewhere around a stretch (m).
    pub fn is_sleeved(&self, stretch: [f64; 2]) -> bool {
        self.layups_on(stretch).any(|layup| !layup.sleeves.is_empty())
    }

    /// The bat after these edits, applied in order after those that it has already. Places count from the knob end of
    /// the bat as it is before each edit.
    ///
    /// ```
    /// use sweetspot::bat::body::STANDARD_PIVOT;
    /// use sweetspot::bat::edit::{Change, Edit};
    /// use sweetspot::Bat;
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash", "weighed": { "mass": 0.9 },
    ///     "profile": { "unit": "in", "x": [0, 33], "diameter": [1.7, 1.7] } }"#;
    /// let bat = Bat::from_text("dowel.json", text, "".as_ref())?;
    /// let weighted = bat.edited(&[Edit { name: None, change: Change::Knob(0.05) }])?;
    /// assert!((weighted.inertia().mass - 0.95).abs() < 1e-14);
    /// let more = weighted.inertia().about(STANDARD_PIVOT) - bat.inertia().about(STANDARD_PIVOT);
    /// assert!((more - 0.05 * STANDARD_PIVOT.powi(2)).abs() < 1e-14);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Value`] whose field is `edits[k].` and the key that does not fit the bat; `k` counts from 0 through all
    /// edits of the bat.
    pub fn edited(&self, edits: &[Edit]) -> Result<Self> {
        edits.iter().try_fold(self.clone(), |bat, edit| {
            let path = format!("edits[{}].{}", bat.edits().len(), edit.change.verb());
            applied(&bat, edit, &path).map_err(|error| {
                error.placed(|complaint| Error::Value(about(complaint, &path, edit)))
            })
        })
    }
}

/// Completes a complaint about an edit, or about the bat that it would make.
fn about(mut complaint: Complaint, path: &str, edit: &Edit) -> Complaint {
    if !complaint.field.starts_with(path) {
        complaint.found = format!("a bat whose {} is {}", complaint.field, complaint.found);
        complaint.field = path.to_owned();
    }
    match &edit.name {
        Some(name) => complaint.hinted(format!("this is of the edit \"{name}\"")),
        None => complaint,
    }
}

/// The error with `path` before its field, unless the field begins with `path` already.
fn under(path: &str, error: Error) -> Error {
    error.placed(|mut complaint| {
        if !complaint.field.starts_with(path) {
            let dot = if complaint.field.is_empty() { "" } else { "." };
            complaint.field = format!("{path}{dot}{}", complaint.field);
        }
        Error::Value(complaint)
    })
}

fn applied(bat: &Bat, edit: &Edit, path: &str) -> Result<Bat> {
    let length = bat.length();
    let mut change = edit.change.clone();
    if let Some(ends) = ends(&mut change) {
        // A place that equals the length to round-off is the tip.
        let near = |x: &f64| (*x - length).abs() <= SAME_PLACE * length;
        ends.into_iter().filter(|x| near(x)).for_each(|x| *x = length);
    }
    check(&change, path, bat).map_err(|error| under(path, error))?;
    bat.after(edit, |parts| made(&change, parts).map_err(|error| under(path, error)))
}

/// The ends of the stretch that is changed (m).
fn ends(change: &mut Change) -> Option<[&mut f64; 2]> {
    match change {
        Change::Cut(cut) => Some([&mut cut.from, &mut cut.to]),
        Change::Bore(bore) => Some([&mut bore.from, &mut bore.to]),
        Change::Cork(cork) => Some([&mut cork.from, &mut cork.to]),
        Change::Sleeve(sleeve) => Some([&mut sleeve.from, &mut sleeve.to]),
        Change::ScaleDiameter(scale) => Some([&mut scale.from, &mut scale.to]),
        Change::Knob(_) | Change::Cup(_) | Change::Shorten(_) | Change::Wood(_) => None,
    }
}

/// The stretch of a change that runs in and out.
macro_rules! blended {
    ($change:ident) => {
        Blended { from: $change.from, to: $change.to, blend: $change.blend }
    };
}

/// Whether the change fits the bat.
fn check(change: &Change, path: &str, bat: &Bat) -> Result<()> {
    let length = bat.length();
    match change {
        Change::Cut(cut) => {
            cut.check(path, length)?;
            check_turned(bat, blended!(cut))
        }
        Change::ScaleDiameter(scale) => {
            scale.check(path, length)?;
            check_turned(bat, blended!(scale))
        }
        Change::Knob(mass) => {
            Attachment { mass: *mass, ..Attachment::default() }.check("", length).map_err(
                |_| Error::value("", shown(*mass, "kg"), "the mass of a weight on the knob"),
            )?;
            match *mass > 0.0 {
                true => Ok(()),
                false => Err(Error::value("", shown(*mass, "kg"), "a mass above 0")),
            }
        }
        Change::Cup(cup) => {
            cup.check(path, length)?;
            check_cup(bat, cup.depth)
        }
        Change::Bore(bore) => {
            bore.check(path, length)?;
            check_unfilled(bat, [bore.from, bore.to])
        }
        Change::Cork(cork) => {
            cork.check(path, length)?;
            check_unfilled(bat, [cork.from, cork.to])
        }
        Change::Sleeve(sleeve) => sleeve.check(path, length),
        Change::Shorten(shorten) => {
            shorten.check(path, length)?;
            let off = shorten.knob.unwrap_or(0.0) + shorten.tip.unwrap_or(0.0);
            if off < length * (1.0 - SAME_PLACE) && off > 0.0 {
                Ok(())
            } else {
                let expected = format!("less than the bat's length, {}", place(length));
                Err(Error::value("", format!("{} sawn off", shown(off, "m")), expected))
            }
        }
        Change::Wood(material) => material.check(),
    }
}

/// A cup must be shorter than the bat, and the tip must be solid.
fn check_cup(bat: &Bat, depth: f64) -> Result<()> {
    let length = bat.length();
    let bottom = length - depth;
    if depth >= length {
        let expected = format!("less than the bat's length, {}", place(length));
        return Err(Error::value("depth", shown(depth, "m"), expected));
    }
    check_unfilled(bat, [bottom, length])?;
    let hollow = |piece: &Piece| {
        let overlaps = piece.start < length && piece.start + piece.length > bottom;
        overlaps && [0.0, 0.5, 1.0].iter().any(|s| piece.at(*s).inner > 0.0)
    };
    match bat.profile().pieces.iter().any(hollow) {
        true => Err(Error::value("", "a bat that is hollow there", "a solid end of the bat")),
        false => Ok(()),
    }
}

/// A change of the surface must run in and out within its stretch, away from sleeves.
fn check_turned(bat: &Bat, on: Blended) -> Result<()> {
    let half = 0.5 * (on.to - on.from);
    if let Some(blend) = on.blend.filter(|blend| *blend > half * (1.0 + SAME_PLACE)) {
        let expected = format!("{} at most, half of the stretch", place(half));
        return Err(Error::value("blend", shown(blend, "m"), expected));
    }
    if bat.is_sleeved([on.from, on.to]) {
        let expected = "wood at the surface: let this edit come before the sleeve";
        return Err(Error::value("", "a stretch with a sleeve around it", expected));
    }
    Ok(())
}

/// Refuses to drill where the bore is filled.
fn check_unfilled(bat: &Bat, stretch: [f64; 2]) -> Result<()> {
    match bat.layups_on(stretch).any(|layup| layup.core.is_some()) {
        true => Err(Error::value("", "a bore that is filled there", "a stretch to be drilled")),
        false => Ok(()),
    }
}

/// Applies the change, which must fit the bat.
fn made(change: &Change, parts: &mut Parts) -> Result<()> {
    let length = parts.profile.length();
    match change {
        Change::Cut(cut) => parts.profile.turned_down(blended!(cut), cut.depth),
        Change::ScaleDiameter(scale) => parts.profile.scaled_outside(blended!(scale), scale.by),
        Change::Knob(mass) => {
            parts.fixtures.attachments.push(Attachment { mass: *mass, ..Attachment::default() });
            Ok(())
        }
        Change::Cup(cup) => parts.profile.cupped(cup.depth, 0.5 * cup.diameter),
        Change::Bore(bore) => parts.profile.drilled([bore.from, bore.to], 0.5 * bore.diameter),
        Change::Cork(cork) => {
            let stretch = [cork.from, cork.to];
            layered(parts, stretch, |layup| layup.core = Some(cork.material.clone()));
            parts.profile.drilled(stretch, 0.5 * cork.diameter)
        }
        Change::Sleeve(sleeve) => {
            let stretch = [sleeve.from, sleeve.to];
            let Sleeve { thickness, material, .. } = sleeve;
            let layer = Layer { thickness: *thickness, material: material.clone() };
            layered(parts, stretch, |layup| layup.sleeves.push(layer.clone()));
            parts.profile.thickened(stretch, sleeve.thickness)
        }
        Change::Shorten(shorten) => {
            let [knob, tip] = [shorten.knob, shorten.tip].map(Option::unwrap_or_default);
            saw_off(&mut parts.fixtures, [knob, length - tip])?;
            parts.profile.shortened(knob, tip);
            Ok(())
        }
        Change::Wood(material) => {
            let before = std::mem::replace(&mut parts.material, material.clone());
            let own = parts.fixtures.regions.iter_mut().map(|region| &mut region.layup.outer);
            own.filter(|outer| **outer == before).for_each(|outer| *outer = material.clone());
            Ok(())
        }
    }
}

/// Changes the layup of a stretch (m). Regions are split at its ends, and the part outside all regions becomes a region
/// of the bat's own material.
fn layered(parts: &mut Parts, [from, to]: [f64; 2], change: impl Fn(&mut Layup)) {
    let same = SAME_PLACE * parts.profile.length();
    let own: &Material = &parts.material;
    let (mut regions, mut bare) = (vec![], vec![[from, to]]);
    for region in parts.fixtures.regions.drain(..) {
        let (start, end) = (region.from.max(from), region.to.min(to));
        if end - start <= same {
            regions.push(region);
            continue;
        }
        for [from, to] in [[region.from, start], [end, region.to]] {
            if to - from > same {
                regions.push(Region { from, to, ..region.clone() });
            }
        }
        let mut inside = Region { from: start, to: end, ..region };
        change(&mut inside.layup);
        regions.push(inside);
        let parts = |[from, to]: [f64; 2]| [[from, to.min(start)], [from.max(end), to]];
        bare = bare.into_iter().flat_map(parts).filter(|[from, to]| to - from > same).collect();
    }
    for [from, to] in bare {
        let mut layup = Layup::of(own.clone());
        change(&mut layup);
        regions.push(Region { from, to, layup });
    }
    parts.fixtures.regions = regions;
}

/// Adapts the fixtures after everything but a stretch (m) is sawn off. Tape and regions end where the bat does, and a
/// metre of tape stays as heavy as before. Hands hold the new bat as far from its knob end as the old one.
///
/// # Errors
///
/// [`Error::Value`] where a fixture at one place would be sawn off.
fn saw_off(fixtures: &mut Fixtures, [from, to]: [f64; 2]) -> Result<()> {
    let attachments = fixtures.attachments.iter_mut().map(|a| ("a weight or a spring", &mut a.x));
    let absorbers = fixtures.absorbers.iter_mut().map(|a| ("an absorber", &mut a.x));
    let joints = fixtures.joints.iter_mut().map(|joint| ("a joint", &mut joint.x));
    let supports = fixtures.supports.iter_mut().map(|support| ("a support", &mut support.x));
    for (what, x) in attachments.chain(absorbers).chain(joints).chain(supports) {
        if *x < from || *x > to {
            let found = format!("{what} at {}, on what is sawn off", place(*x));
            return Err(Error::value("", found, "nothing fixed there: saw first, then fix it"));
        }
        *x -= from;
    }
    let left = |start: f64, end: f64| {
        let ends = [start.max(from) - from, end.min(to) - from];
        (ends[1] > ends[0] + SAME_PLACE * to).then_some(ends)
    };
    let region = |region: &Region| {
        let [from, to] = left(region.from, region.to)?;
        Some(Region { from, to, ..region.clone() })
    };
    let tape = |tape: &Tape| {
        let [from, to] = left(tape.from, tape.to)?;
        Some(Tape { from, to, mass: tape.mass * (to - from) / (tape.to - tape.from) })
    };
    fixtures.regions = fixtures.regions.iter().filter_map(region).collect();
    fixtures.tapes = fixtures.tapes.iter().filter_map(tape).collect();
    if let Some(grip) = &mut fixtures.grip {
        grip.to = grip.to.min(to - from);
    }
    Ok(())
}
