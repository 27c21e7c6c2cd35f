//! Into which stretches is a bat divided, so that 1/EI and 1/κGA are nearly polynomials on each?
//!
//! Trace and norm are those of a beam whose compliance on every stretch is a polynomial of degree 12 nowhere below
//! 1/EI, and another nowhere below 1/κGA. It is softer than the bat, so that none of its `τ_n` is less than that of the
//! bat, for any supports common to both.

use crate::enclosure::beam::Layout;
use crate::enclosure::gives::Give;
use crate::enclosure::radii::Curved;
use crate::enclosure::sections::{Rings, inverse};
use crate::gauss::GAUSS_40;
use crate::series::{Series, Values};
use sweetspot::base::{Error, Interval, Result};
use sweetspot::bat::{Bat, Theory};

const ZERO: Interval = Interval { low: 0.0, high: 0.0 };
/// Largest relative excess of the polynomials over 1/EI; otherwise the stretch is halved.
const ABOVE: f64 = 1e-11;
/// Halvings of a piece of the profile.
const MOST_HALVINGS: usize = 40;
/// Halving reduces the error of the polynomial by 2¹³, unless only rounding is left.
const STALLED: f64 = 0.1;
/// Stretches are at most this share of the bat, so that one ends near the balance point.
const LONGEST: f64 = 0.1;
/// A bat that takes more stretches is refused.
const MOST_STRETCHES: usize = 20_000;
/// A polynomial for 1/EI that is farther above it than this is of no use.
const USELESS: f64 = 1e-3;

/// The data of one stretch.
pub struct Stretch {
    /// Half its length (m).
    pub half: Interval,
    /// Its middle from the end of the bat (m).
    pub middle: Interval,
    /// ρA (kg/m).
    pub mass: Values<40>,
    /// ρI (kg m), where sections turn.
    pub turning: Option<Values<40>>,
    /// An upper bound of 1/EI (1/(N m²)).
    pub soft: Values<40>,
    /// An upper bound of 1/κGA (1/N), in a theory with shear.
    pub slip: Option<Values<40>>,
    /// Largest relative excess of the bounds.
    pub above: f64,
}

/// A mass as encountered from one end, or a joint, whose mass is 0.
#[derive(Clone, Copy)]
pub struct Met {
    /// It is at the border before the stretch of this number.
    pub before: usize,
    /// Position of its centre (m).
    pub centre: Interval,
    /// Its mass (kg).
    pub mass: Interval,
    /// Its own moment of inertia (kg m²).
    pub inertia: Interval,
    /// The compliant part there.
    pub give: Option<Give>,
}

/// The stretches of a bat, and the border at which each piece of its profile begins, the end of the bat last.
///
/// # Errors
///
/// [`Error::Value`] where no short stretch has a polynomial near 1/EI.
pub fn stretches(bat: &Bat, layout: &Layout, theory: Theory) -> Result<(Vec<Stretch>, Vec<usize>)> {
    let (mut stretches, mut borders) = (vec![], vec![]);
    for (piece, curve) in layout.curves.iter().enumerate() {
        borders.push(stretches.len());
        let before = f64::INFINITY;
        let part = PiecePart { piece, curve, of_piece: [0.0, 1.0], halvings: 0, before };
        halved(bat, layout, theory, part, &mut stretches)?;
    }
    borders.push(stretches.len());
    Ok((stretches, borders))
}

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// Masses of the rigid motions `(1, 0)` and `(x, 1)`: entries 11, 12, 22.
pub fn rigid(stretches: &[Stretch], masses: &[Met]) -> [Interval; 3] {
    let gauss = &GAUSS_40;
    let mut gram = [ZERO; 3];
    for stretch in stretches {
        let x = stretch.places();
        let first = stretch.mass.product(&x);
        let turning = stretch.turning.as_ref().map_or(ZERO, |turning| turning.integral(gauss));
        let parts = [
            stretch.mass.integral(gauss),
            first.integral(gauss),
            first.product(&x).integral(gauss) + turning,
        ];
        gram.iter_mut().zip(parts).for_each(|(sum, part)| *sum = *sum + stretch.half * part);
    }
    for Met { centre, mass, inertia, .. } in masses {
        gram[0] = gram[0] + *mass;
        gram[1] = gram[1] + *mass * *centre;
        gram[2] = gram[2] + *mass * centre.square() + *inertia;
    }
    gram
}

/// The bat as a rigid body.
#[derive(Clone, Copy)]
pub struct Rigid {
    /// 1/M (1/kg).
    pub over_mass: Interval,
    /// 1/I (1/(kg m²)).
    pub over_inertia: Interval,
    /// The balance point from the end that sums run from (m).
    pub balance: Interval,
    /// Length of the bat (m).
    pub length: Interval,
}

impl Rigid {
    /// From the masses of rigid motions; None where these cannot be distinguished.
    pub fn of([mass, first, second]: [Interval; 3], length: Interval) -> Option<Self> {
        let over_mass = mass.reciprocal()?;
        let balance = first * over_mass;
        // `∫ρA x² − M x_b²` cancels three quarters of itself at most on a bat.
        let about = second - first * balance;
        let over_inertia = about.reciprocal().filter(|over| over.low > 0.0)?;
        Some(Self { over_mass, over_inertia, balance, length })
    }

    /// G about a place: its entries 11, 12, 22.
    pub fn inverse(&self, place: Interval) -> [Interval; 3] {
        let d = self.balance - place;
        let Self { over_mass, over_inertia, .. } = *self;
        [over_mass + d.square() * over_inertia, -(d * over_inertia), over_inertia]
    }
}

/// A part of a piece of the profile.
#[derive(Clone, Copy)]
struct PiecePart<'a> {
    piece: usize,
    curve: &'a Curved,
    /// Its beginning and end in the piece, in [0, 1].
    of_piece: [f64; 2],
    /// How often the piece was halved for it.
    halvings: usize,
    /// How far above 1/EI the polynomial on twice its length is.
    before: f64,
}

/// A part of a piece, halved until polynomials are close to 1/EI and 1/κGA or stop improving.
fn halved(
    bat: &Bat,
    layout: &Layout,
    theory: Theory,
    part: PiecePart,
    all: &mut Vec<Stretch>,
) -> Result<()> {
    let PiecePart { piece, curve, of_piece: [from, to], halvings, before } = part;
    let whole = curve.part(from, to);
    let short = whole.length.high <= LONGEST * layout.length.low;
    let stretch = short.then(|| Stretch::of(bat, layout, theory, piece, &whole)).flatten();
    let above = stretch.as_ref().map_or(f64::INFINITY, |stretch| stretch.above);
    if let Some(stretch) = stretch
        && (above < ABOVE || above > STALLED * before)
    {
        all.push(stretch);
        return Ok(());
    }
    if halvings == MOST_HALVINGS || all.len() >= MOST_STRETCHES {
        let found = format!("sections near {:.4} m that nothing bounds", curve.start.middle());
        return Err(Error::value("profile", found, "a wall that is not thinner than round-off"));
    }
    let middle = 0.5 * (from + to);
    [[from, middle], [middle, to]].into_iter().try_for_each(|of_piece| {
        let part = PiecePart { of_piece, halvings: halvings + 1, before: above, ..part };
        halved(bat, layout, theory, part, all)
    })
}

impl Stretch {
    /// Its beginning from the end of the bat (m).
    pub fn begin(&self) -> Interval {
        self.middle - self.half
    }

    fn of(
        bat: &Bat,
        layout: &Layout,
        theory: Theory,
        piece: usize,
        curve: &Curved,
    ) -> Option<Self> {
        let gauss = &GAUSS_40;
        let rings = Rings::of(bat.layup(&bat.profile().pieces[piece]), curve, layout.heavier);
        let half = point(0.5) * curve.length;
        let soft = inverse(&rings.bending(gauss), USELESS)?;
        let mut above = soft.share;
        let of = |series: &Series, share: f64| {
            let over = (point(1.0) - point(share)).reciprocal()?;
            Some(series.values(gauss).times(over))
        };
        let soft = of(&soft.series, soft.share)?;
        let slip = if theory.shears() {
            let stiff = rings.shear()?;
            let slip = inverse(&stiff.series.values(gauss), USELESS)?;
            above = above.max(slip.share + stiff.share);
            let over = (point(1.0) - point(stiff.share)).reciprocal()?;
            Some(of(&slip.series, slip.share)?.times(over))
        } else {
            None
        };
        Some(Self {
            half,
            middle: curve.start + half,
            mass: rings.mass(gauss),
            turning: theory.turns().then(|| rings.turning(gauss)),
            soft,
            slip,
            above,
        })
    }

    /// Places from the end of the bat (m), at the points.
    pub fn places(&self) -> Values<40> {
        Series::of(&[self.middle, self.half]).values(&GAUSS_40)
    }

    /// The stretch as seen from the other end of a bat of that length.
    pub fn mirrored(mut self, length: Interval) -> Self {
        self.middle = length - self.middle;
        let all =
            [Some(&mut self.mass), self.turning.as_mut(), Some(&mut self.soft), self.slip.as_mut()];
        all.into_iter().flatten().for_each(|values| values.at.reverse());
        self
    }
}
