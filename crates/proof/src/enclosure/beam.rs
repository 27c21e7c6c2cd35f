//! How is a bat represented, cell by cell, for proofs of its frequencies?
//!
//! [`Proven::of`] divides the bat into the stretches of a mesh, each within one piece of the profile, with all data for
//! the energies of a motion. Features without a proof are refused with the reason.

use std::ops::Range;

use crate::enclosure::contacts::{Bed, Contact, base, bed, contacts};
use crate::enclosure::gives::{Give, YieldingPart, stretch};
use crate::enclosure::radii::{Curved, NUMBER, curved, place};
use crate::enclosure::sections::Rings;
use crate::gauss::GAUSS_24;
use crate::series::{Series, Values};
use sweetspot::base::{Error, Interval, Result};
use sweetspot::bat::{Absorber, Attachment, Bat, Fixtures, Joint, Piece, Theory};
use sweetspot::beam::Mesh;

/// Points of the energies: they determine polynomials of degree 23 and integrate those of degree 47 exactly.
pub const POINTS: usize = 24;

/// A stretch of the bat in one piece of the profile.
#[derive(Debug, Clone)]
pub struct BeamCell {
    /// Half its length (m).
    pub half: Interval,
    /// Its middle, from the origin of the arms (m).
    pub middle: Interval,
    /// EI (N m²) at the points.
    pub bending: Values<POINTS>,
    /// EI at least.
    pub bending_least: f64,
    /// ρA (kg/m) at the points.
    pub mass: Values<POINTS>,
    /// ρA, and ρA times the arm.
    pub mass_series: [Series; 2],
    /// ρI (kg m) at the points, where sections turn.
    pub turning: Option<(Values<POINTS>, Series)>,
    /// κGA (N) of a theory with shear.
    pub shear: Option<Shear>,
}

/// κGA along a cell.
#[derive(Debug, Clone)]
pub struct Shear {
    /// The polynomial that approximates κGA (N), at the points.
    pub values: Values<POINTS>,
    /// Largest relative difference between κGA and the polynomial.
    pub share: f64,
    /// κGA at least.
    pub least: f64,
}

/// A point mass, or a joint, whose mass is 0.
#[derive(Debug, Clone, Copy)]
pub struct Mass {
    /// It is at the border before the cell of this number.
    pub border: usize,
    /// Its mass (kg).
    pub mass: Interval,
    /// Its own moment of inertia (kg m²).
    pub inertia: Interval,
    /// How far its centre is beyond the border (m).
    pub offset: Interval,
    /// Position of the border: its arm (m).
    pub arm: Interval,
    /// The compliant part there: the spring that carries the mass, or the joint.
    pub give: Option<Give>,
}

/// The bat that is proven of.
#[derive(Debug, Clone)]
pub struct Proven {
    /// The beam theory.
    pub theory: Theory,
    /// Its cells from knob to tip.
    pub cells: Vec<BeamCell>,
    /// The masses on it, by rising border.
    pub masses: Vec<Mass>,
    /// The contacts that hold it at places.
    pub contacts: Vec<Contact>,
    /// The bed that holds it.
    pub bed: Option<Bed>,
    /// The two contacts whose reactions follow from equilibrium.
    pub base: Option<[usize; 2]>,
    /// The cell at whose left end outward sums begin.
    pub root: usize,
    /// Mass (kg), first moment (kg m) and moment of inertia (kg m²) about the origin of the arms, which is near the
    /// balance point.
    pub gram: [Interval; 3],
    /// That place from the knob end (m).
    pub origin: f64,
}

/// Checks that the frequencies of a bat can be proven.
///
/// # Errors
///
/// [`Error::Value`] that names the feature without a proof.
pub fn carried(bat: &Bat, theory: Theory) -> Result<()> {
    let refuse = |field: &str, found: &str, expected: &str| {
        Err(Error::value(field, found.to_owned(), expected.to_owned()))
    };
    let fixtures = bat.fixtures();
    if fixtures.holding() && fixtures.rigid_modes() > 0 {
        let field = if fixtures.supports.is_empty() { "attachments" } else { "supports" };
        let expected = "a free bat, or one that is held against moving sideways and turning";
        return refuse(field, "a held bat with a rigid motion that is free", expected);
    }
    if bat.profile().formulas.is_some() {
        let expected = "a profile of stations: what is proven is proven of polynomials";
        return refuse("profile.pieces", "formulas", expected);
    }
    if !bat.edits().is_empty() {
        return refuse("edits", "a bat with edits", "a bat as it stands in its file");
    }
    if bat.factors()[1] != 1.0 || bat.weighed().first_bending.is_some() {
        let expected = "moduli that stand in the file";
        return refuse("weighed.first_bending_hz", "moduli that follow from a tap", expected);
    }
    let stations = &bat.profile().stations;
    let last = stations.outer.len() - 1;
    if stations.outer[0] == 0.0 || stations.outer[last] == 0.0 {
        return refuse("profile", "a bat that comes to a point", "a radius above 0 at both ends");
    }
    if theory.shears() && !bat.knows_shear() {
        return refuse("theory", "timoshenko without a shear modulus", "a shear modulus");
    }
    // In other layups the quantity in place of m² in κ is a quotient of polynomials for which there is no bound here.
    let plain = |piece: &Piece| match bat.layup(piece).sleeves.len() {
        0 => true,
        1 => piece.ends().iter().all(|end| end.inner == 0.0),
        _ => false,
    };
    if theory.shears() && !bat.profile().pieces.iter().all(plain) {
        let expected = "rayleigh or euler-bernoulli, or one layer at most, around a solid wall";
        return refuse("theory", "timoshenko with layers around a hollow wall", expected);
    }
    Ok(())
}

/// The bat in intervals, before it is divided into cells.
#[derive(Debug, Clone)]
pub struct Layout {
    /// The pieces of its profile.
    pub curves: Vec<Curved>,
    /// The factor on densities due to a weighed mass, in addition to the factors already in the densities of the bat.
    pub heavier: Interval,
    /// The attached masses by rising place, with joints last at equal places.
    pub masses: Vec<PlacedMass>,
    /// The contacts, each at the border before a piece.
    pub contacts: Vec<Contact>,
    /// The bed that holds it, between borders of pieces.
    pub bed: Option<Bed>,
    /// Length (m).
    pub length: Interval,
}

/// A point mass at its place on the bat, or a joint, whose mass is 0.
#[derive(Debug, Clone, Copy)]
pub struct PlacedMass {
    /// The piece of the profile that begins there.
    pub piece: usize,
    /// Its mass (kg).
    pub mass: Interval,
    /// Its own moment of inertia (kg m²).
    pub inertia: Interval,
    /// Position of its centre (m).
    pub centre: Interval,
    /// How far that is beyond where it is fixed (m).
    pub offset: Interval,
    /// The compliant part there: the spring that carries the mass, or the joint.
    pub give: Option<Give>,
}

fn data(value: f64) -> Interval {
    Interval::around(value, NUMBER)
}

impl Layout {
    /// That of a bat.
    ///
    /// # Errors
    ///
    /// As [`carried`] and [`curved`].
    pub fn of(bat: &Bat, theory: Theory) -> Result<Self> {
        carried(bat, theory)?;
        let curves = curved(bat)?;
        let heavier = heavier(bat, &curves)?;
        let length = bat.length();
        let turned = bat.profile().turned.then_some(length);
        let borders = bat.profile().borders();
        let border_at = |x: f64| {
            let near = |k: &usize| (borders[*k] - x).abs();
            let border = (0..borders.len()).min_by(|a, b| near(a).total_cmp(&near(b)));
            border.expect("a bat has borders")
        };
        let placed = |on: &Attachment, give: Option<Give>| PlacedMass {
            piece: border_at(on.x),
            mass: data(on.mass),
            inertia: data(on.rotary_inertia),
            centre: place(on.x, turned) + data(on.offset),
            offset: data(on.offset),
            give,
        };
        let Fixtures { attachments, absorbers, joints, .. } = bat.fixtures();
        // Strains have the same order as in the solver: joints, then springs that carry masses.
        let hung = |(number, absorber): (usize, &Absorber)| {
            let Absorber { x, mass, stiffness, .. } = *absorber;
            let give = Give { number, way: YieldingPart::Hung, stiffness: data(stiffness) };
            placed(&Attachment { x, mass, ..Attachment::default() }, Some(give))
        };
        let joint = |(number, joint): (usize, &Joint)| {
            let stiffness = data(joint.rotational_stiffness);
            let give = Give { number, way: YieldingPart::Joint, stiffness };
            placed(&Attachment { x: joint.x, ..Attachment::default() }, Some(give))
        };
        let fixed = attachments.iter().map(|on| placed(on, None));
        let hung = (joints.len()..).zip(absorbers).map(hung);
        let joints = joints.iter().enumerate().map(joint);
        let mut masses: Vec<PlacedMass> = fixed.chain(hung).chain(joints).collect();
        masses.sort_by_key(|placed| placed.piece);
        let whole = place(length, turned);
        let (contacts, bed) = (contacts(bat, border_at), bed(bat, border_at));
        Ok(Self { curves, heavier, masses, contacts, bed, length: whole })
    }
}

/// [`Layout::heavier`].
fn heavier(bat: &Bat, curves: &[Curved]) -> Result<Interval> {
    let Some(weighed) = bat.weighed().mass else { return Ok(Interval::point(1.0)) };
    let gauss = &GAUSS_24;
    let (mut own, mut other) = (Interval::point(0.0), Interval::point(0.0));
    for (curve, piece) in curves.iter().zip(&bat.profile().pieces) {
        let rings = Rings::of(bat.layup(piece), curve, Interval::point(1.0));
        let half = Interval::point(0.5) * curve.length;
        let tape = curve.length * data(bat.layup(piece).tape);
        own = own + half * rings.mass::<POINTS>(gauss).integral(gauss) - tape;
        other = other + tape;
    }
    for [mass, ..] in bat.fixtures().masses() {
        other = other + data(mass);
    }
    let over = own.reciprocal().filter(|over| over.low > 0.0);
    over.map(|over| (data(weighed) - other) * over).ok_or_else(|| {
        Error::value("weighed.mass", format!("{weighed} kg"), "a bat whose own mass is known")
    })
}

impl Proven {
    /// Whether anything holds it.
    pub fn is_held(&self) -> bool {
        !self.contacts.is_empty() || self.bed.is_some()
    }

    /// The cells on the bed.
    pub fn in_bed(&self) -> Range<usize> {
        self.bed.map_or(0..0, |bed| bed.borders[0]..bed.borders[1])
    }

    /// The bat on the stretches of that mesh.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] where the sections of the bat have values too far from 1 to be bounded.
    pub fn of(bat: &Bat, layout: &Layout, mesh: &Mesh, theory: Theory) -> Result<Self> {
        let origin = bat.inertia().balance_point;
        let (mut cells, mut begin) =
            (Vec::with_capacity(mesh.len()), vec![usize::MAX; layout.curves.len()]);
        // Cells lie end to end from knob to tip: a gap would be another bat.
        let mut before = (0, 0.0);
        for part in mesh.elements.iter().flat_map(|element| element.parts(bat)) {
            let [from, to] = part.of_piece;
            let (piece, at) = if before.1 < 1.0 { before } else { (before.0 + 1, 0.0) };
            if (part.piece, from) != (piece, at) || to <= from {
                return Err(Error::value("mesh", "elements with a gap between them", "none"));
            }
            before = (part.piece, to);
            begin[part.piece] = begin[part.piece].min(cells.len());
            let curve = layout.curves[part.piece].part(from, to);
            cells.push(cell(bat, part.piece, &curve, layout.heavier, theory, origin)?);
        }
        if before != (layout.curves.len() - 1, 1.0) {
            return Err(Error::value("mesh", "elements that end before the bat", "all of the bat"));
        }
        let border = |piece: usize| begin.get(piece).copied().unwrap_or(cells.len());
        let mass = |placed: &PlacedMass| Mass {
            border: border(placed.piece),
            mass: placed.mass,
            inertia: placed.inertia,
            offset: placed.offset,
            arm: placed.centre - placed.offset - Interval::point(origin),
            give: placed.give,
        };
        let masses: Vec<Mass> = layout.masses.iter().map(mass).collect();
        let held = layout.contacts.iter();
        let held = held.map(|contact| Contact { border: border(contact.border), ..*contact });
        let contacts: Vec<Contact> = held.collect();
        let bed = layout.bed.map(|bed| Bed { borders: bed.borders.map(border), ..bed });
        let root = root(&cells);
        let (length, stiff) = (bat.length(), cells[root].bending.at[0]);
        let arm = |contact: &Contact| {
            cells.get(contact.border).map_or(length - origin, |cell| cell.begin().middle())
        };
        let base = base(&contacts, arm, length, stiff / length.powi(3));
        let gram = gram(&cells, &masses);
        Ok(Self { theory, cells, masses, contacts, bed, base, root, gram, origin })
    }
}

impl Mass {
    /// Displacement of its centre (m), where the bat has that deflection and rotation and the compliant parts have
    /// these strains.
    pub fn at(&self, [w, turn]: [Interval; 2], strains: &[Interval]) -> Interval {
        w + self.offset * turn + stretch(self.give, strains)
    }
}

impl BeamCell {
    /// The arm at its left end (m).
    pub fn begin(&self) -> Interval {
        self.middle - self.half
    }

    /// The arm at the points (m).
    pub fn arm(&self) -> Values<POINTS> {
        Series::of(&[self.middle, self.half]).values(&GAUSS_24)
    }
}

/// [`Proven::gram`].
fn gram(cells: &[BeamCell], masses: &[Mass]) -> [Interval; 3] {
    let gauss = &GAUSS_24;
    let mut gram = [Interval::point(0.0); 3];
    for cell in cells {
        let arm = cell.arm();
        let own = cell.mass.product(&arm).product(&arm).integral(gauss);
        let turning = cell.turning.as_ref().map(|(turning, _)| turning.integral(gauss));
        let parts = [
            cell.mass_series[0].integral(),
            cell.mass_series[1].integral(),
            own + turning.unwrap_or(Interval::point(0.0)),
        ];
        gram.iter_mut().zip(parts).for_each(|(sum, part)| *sum = *sum + cell.half * part);
    }
    for Mass { mass, inertia, offset, arm, .. } in masses {
        let arm = *arm + *offset;
        gram[0] = gram[0] + *mass;
        gram[1] = gram[1] + *mass * arm;
        gram[2] = gram[2] + *mass * arm.square() + *inertia;
    }
    gram
}

fn cell(
    bat: &Bat,
    piece: usize,
    curve: &Curved,
    heavier: Interval,
    theory: Theory,
    origin: f64,
) -> Result<BeamCell> {
    let gauss = &GAUSS_24;
    let rings = Rings::of(bat.layup(&bat.profile().pieces[piece]), curve, heavier);
    let half = Interval::point(0.5) * curve.length;
    let middle = curve.start + half - Interval::point(origin);
    let mass = rings.mass(gauss);
    let arm = Series::of(&[middle, half]).values(gauss);
    let mass_series = [Series::through(gauss, &mass), Series::through(gauss, &mass.product(&arm))];
    let turning = theory.turns().then(|| {
        let turning = rings.turning(gauss);
        (turning, Series::through(gauss, &turning))
    });
    let unbounded = || {
        let found = format!("sections near {:.4} m that nothing bounds", origin + middle.middle());
        Error::value("profile", found, "a wall that is not thinner than round-off")
    };
    let shear = if theory.shears() {
        let nearly = rings.shear().ok_or_else(unbounded)?;
        let least = rings.shear_at_least().filter(|least| *least > 0.0);
        let least = least.ok_or_else(unbounded)?;
        Some(Shear { values: nearly.series.values(gauss), share: nearly.share, least })
    } else {
        None
    };
    let bending_least = rings.bending_at_least();
    if !(bending_least > 0.0 && half.low > 0.0) {
        return Err(unbounded());
    }
    let bending = rings.bending(gauss);
    Ok(BeamCell { half, middle, bending, bending_least, mass, mass_series, turning, shear })
}

/// The middle one of the cells whose bending stiffness is at least half the largest.
fn root(cells: &[BeamCell]) -> usize {
    let greatest = cells.iter().map(|cell| cell.bending.at[0]).fold(0.0, f64::max);
    let stiff = |k: &usize| cells[*k].bending.at[0] >= 0.5 * greatest;
    let count = (0..cells.len()).filter(stiff).count();
    (0..cells.len()).filter(stiff).nth(count / 2).unwrap_or(0)
}
