//! What are EI, ρA, ρI and κGA of the sections along a cell, as polynomials with bounds?

use crate::enclosure::radii::{Cubic, Curved, NUMBER};
use crate::gauss::{GAUSS_40, Gauss};
use crate::series::{Series, Values};
use sweetspot::base::Interval;
use sweetspot::base::interval::{down, up};
use sweetspot::bat::{Layer, Layup, Material};

/// Degree of the polynomials that approximate 1/EI, κGA of a tube and 1/κGA.
const DEGREE: usize = 12;

/// The rings of a cell, from the bore outwards.
#[derive(Debug, Clone)]
pub struct Rings<'a> {
    layup: &'a Layup,
    /// The factor on densities that is not in the materials.
    heavier: Interval,
    /// Inner and outer radii of the core, the wall and every sleeve, as far as they exist.
    core: Option<Ring<'a>>,
    walls: Vec<Ring<'a>>,
    /// The radius of the surface.
    surface: Border,
}

/// A ring of one material.
#[derive(Debug, Clone)]
struct Ring<'a> {
    material: &'a Material,
    inside: Option<Border>,
    outside: Border,
    /// Hollowness of the ring for κ: 1 with an empty inside, 0 with one that carries shear like the ring.
    empty: Interval,
}

/// A radius along a cell.
#[derive(Debug, Clone, Copy)]
struct Border {
    series: Series,
    /// Its Bernstein coefficients, between which it stays.
    cubic: Cubic,
}

/// A function along a cell that is a polynomial, or nearly one.
#[derive(Debug, Clone)]
pub struct Nearly {
    /// Coefficients of the polynomial.
    pub series: Series,
    /// The function is within this share of the polynomial.
    pub share: f64,
}

/// A number of a bat's file.
fn data(value: f64) -> Interval {
    Interval::around(value, NUMBER)
}

fn number(value: f64) -> Interval {
    Interval::point(value)
}

impl Border {
    fn of(cubic: &Cubic, degree: usize) -> Self {
        let [b0, b1, b2, b3] = *cubic;
        let part = |sum: Interval, by: f64| sum * number(by).reciprocal().expect("not 0");
        let line = number(3.0) * (b3 - b0) + (b2 - b1);
        let terms = [
            part(b0 + b1 + b2 + b3, 4.0),
            part(number(3.0) * line, 20.0),
            part(b0 - b1 - b2 + b3, 4.0),
            part((b3 - b0) - number(3.0) * (b2 - b1), 20.0),
        ];
        let terms = &terms[..=degree.min(3)];
        Self { series: Series::of(terms), cubic: *cubic }
    }

    fn less(self, thickness: Interval) -> Self {
        let cubic = self.cubic.map(|radius| radius - thickness);
        Self { series: self.series.plus(-thickness), cubic }
    }

    /// Between these at every place.
    fn range(&self) -> Interval {
        self.cubic.into_iter().reduce(Interval::hull).expect("four coefficients")
    }
}

impl Ring<'_> {
    /// `b² − a²`.
    fn squares<const N: usize>(&self, gauss: &Gauss<N>) -> Values<N> {
        let b = self.outside.series.values(gauss);
        let Some(inside) = &self.inside else { return b.product(&b) };
        let difference = (self.outside.series - inside.series).values(gauss);
        difference.product(&b.sum(&inside.series.values(gauss)))
    }

    /// `b⁴ − a⁴`.
    fn fourths<const N: usize>(&self, gauss: &Gauss<N>) -> Values<N> {
        let b = self.outside.series.values(gauss);
        let b = b.product(&b);
        let Some(inside) = &self.inside else { return b.product(&b) };
        let a = inside.series.values(gauss);
        self.squares(gauss).product(&b.sum(&a.product(&a)))
    }

    /// `b² − a²` and `b⁴ − a⁴` at least: each factor by its least.
    fn least_powers(&self) -> [f64; 2] {
        let [difference, sum] =
            [self.least(|b, a| b - a), self.least(|b, a| b + a)].map(|of| number(of.max(0.0)));
        let [b, a] = [self.least(|b, _| b), self.least(|_, a| a)].map(|of| number(of.max(0.0)));
        let squares = difference * sum;
        [squares.low.max(0.0), (squares * (b.square() + a.square())).low.max(0.0)]
    }

    /// Lower bound of a sum of multiples of `b` and `a`: the smallest of its Bernstein coefficients.
    fn least(&self, of: impl Fn(Interval, Interval) -> Interval) -> f64 {
        let inside = self.inside.as_ref().map_or([number(0.0); 4], |inside| inside.cubic);
        let both = self.outside.cubic.into_iter().zip(inside);
        both.fold(f64::INFINITY, |least, (b, a)| least.min(of(b, a).low))
    }

    /// Whether κ does not depend on the place.
    fn even(&self) -> bool {
        self.material.shear_coefficient.is_some()
            || self.inside.is_none()
            || self.empty == number(0.0)
    }
}

impl<'a> Rings<'a> {
    /// The rings of a cell of these materials, whose densities are `heavier` times the written ones.
    pub fn of(layup: &'a Layup, curve: &Curved, heavier: Interval) -> Self {
        let surface = Border::of(&curve.outer, curve.degree);
        let bore = curve.inner.map(|inner| Border::of(&inner, curve.degree));
        let mut walls = vec![];
        let (mut outside, mut below) = (surface, vec![]);
        for Layer { thickness, material } in layup.sleeves.iter().rev() {
            let inside = outside.less(data(*thickness));
            below.push((material, inside, outside));
            outside = inside;
        }
        let empty = |of: &Material, inside: Option<&Material>| match (
            inside.and_then(|inside| inside.shear_modulus),
            of.shear_modulus,
        ) {
            // Two numbers of a file with the same double are taken to be the same number.
            (Some(inside), Some(of)) if inside == of => number(0.0),
            (Some(inside), Some(of)) => {
                let ratio = data(of).reciprocal().map_or(number(0.0), |over| data(inside) * over);
                let empty = number(1.0) - ratio;
                Interval { low: empty.low.max(0.0), high: empty.high.max(0.0) }
            }
            _ => number(1.0),
        };
        walls.push(Ring {
            material: &layup.outer,
            inside: bore,
            outside,
            empty: empty(&layup.outer, layup.core.as_ref()),
        });
        for (material, inside, outside) in below.into_iter().rev() {
            let last = walls.last().map(|ring: &Ring| ring.material);
            let empty = empty(material, last);
            walls.push(Ring { material, inside: Some(inside), outside, empty });
        }
        let core = layup.core.as_ref().zip(bore).map(|(material, outside)| Ring {
            material,
            inside: None,
            outside,
            empty: number(1.0),
        });
        Self { layup, heavier, core, walls, surface }
    }

    fn all(&self) -> impl Iterator<Item = &Ring<'a>> {
        self.core.iter().chain(&self.walls)
    }

    fn summed<const N: usize>(&self, of: impl Fn(&Ring<'a>) -> Values<N>) -> Values<N> {
        let parts = self.all().map(of);
        parts.reduce(|sum, part| sum.sum(&part)).expect("there is a wall")
    }

    /// EI (N m²) at the points: `E π/4 (b⁴ − a⁴)` of every ring.
    pub fn bending<const N: usize>(&self, gauss: &Gauss<N>) -> Values<N> {
        let quarter = Interval::pi() * number(0.25);
        self.summed(|ring| ring.fourths(gauss).times(quarter * data(ring.material.youngs_modulus)))
    }

    /// Lower bound of EI (N m²) on the cell.
    pub fn bending_at_least(&self) -> f64 {
        let quarter = Interval::pi() * number(0.25);
        let of = |ring: &Ring| data(ring.material.youngs_modulus) * number(ring.least_powers()[1]);
        (quarter * self.all().map(of).sum::<Interval>()).low
    }

    /// ρA (kg/m) at the points: `ρ π (b² − a²)` of every ring, and tape.
    pub fn mass<const N: usize>(&self, gauss: &Gauss<N>) -> Values<N> {
        let own = self.summed(|ring| {
            ring.squares(gauss).times(Interval::pi() * self.heavier * data(ring.material.density))
        });
        if self.layup.tape == 0.0 { own } else { own.sum(&Values::constant(data(self.layup.tape))) }
    }

    /// ρI (kg m) at the points: `ρ π/4 (b⁴ − a⁴)` of every ring, and of tape on the surface `½ m r²`.
    pub fn turning<const N: usize>(&self, gauss: &Gauss<N>) -> Values<N> {
        let quarter = Interval::pi() * number(0.25) * self.heavier;
        let own =
            self.summed(|ring| ring.fourths(gauss).times(quarter * data(ring.material.density)));
        if self.layup.tape == 0.0 {
            return own;
        }
        let r = self.surface.series.values(gauss);
        own.sum(&r.product(&r).times(number(0.5) * data(self.layup.tape)))
    }

    /// κGA (N): `κ G π (b² − a²)` of every ring, with Cowper's κ of a tube where it varies with the place. None where a
    /// shear modulus is unknown or κGA has no bound.
    pub fn shear(&self) -> Option<Nearly> {
        let gauss = &GAUSS_40;
        let mut sum = Nearly { series: Series::exact(&[]), share: 0.0 };
        for ring in self.all() {
            let part = if ring.even() {
                let modulus = data(ring.material.shear_modulus?) * Interval::pi();
                let area = ring.squares(gauss).times(modulus);
                let kappa = kappa(ring.material, number(0.0));
                let series = Series::through(gauss, &area.times(kappa));
                Nearly { series, share: 0.0 }
            } else {
                of_tube(ring)?
            };
            sum = Nearly { series: sum.series + part.series, share: sum.share.max(part.share) };
        }
        Some(sum)
    }

    /// Lower bound of κGA (N) on the cell, where a ring with varying κ contributes its smallest value.
    pub fn shear_at_least(&self) -> Option<f64> {
        let mut least = number(0.0);
        for ring in self.all() {
            let [squares, _] = ring.least_powers();
            let hole = match (&ring.inside, ring.even()) {
                (Some(inside), false) => {
                    let over = ring.outside.range().reciprocal()?;
                    let most = (ring.empty * (inside.range() * over).square()).high;
                    Interval { low: 0.0, high: most.min(1.0) }
                }
                _ => number(0.0),
            };
            let modulus = data(ring.material.shear_modulus?) * Interval::pi();
            least = least + kappa(ring.material, hole) * modulus * number(squares);
        }
        Some(least.low)
    }
}

/// κ of a ring with `(r_i/r)²` equal to `hole`.
fn kappa(material: &Material, hole: Interval) -> Interval {
    if let Some(kappa) = material.shear_coefficient {
        return data(kappa);
    }
    let nu = data(material.poisson());
    let (top, [below, mixed]) = cowper(nu);
    // Divided by (1 + m²)², so that only the ratio m²/(1 + m²)² varies with the place.
    let square = (number(1.0) + hole).square();
    let ratio = hole * square.reciprocal().expect("1 or more");
    top * (below + mixed * ratio).reciprocal().expect("positive")
}

/// `6 (1 + ν)`, `7 + 6ν` and `20 + 12ν`.
fn cowper(nu: Interval) -> (Interval, [Interval; 2]) {
    let top = number(6.0) * (number(1.0) + nu);
    (top, [number(7.0) + number(6.0) * nu, number(20.0) + number(12.0) * nu])
}

/// κGA of a tube, `G π (b² − a²)` with `m = e a²/b²` and `κ = 6 (1 + ν)(b² + ea²)²/D`,
/// `D = (7 + 6ν)(b² + ea²)² + (20 + 12ν) e a² b²`. It is approximated by a polynomial `c`; `|D c − N|` is bounded on
/// the whole cell, and so is `|c/κGA − 1| = |D c − N|/N`.
///
/// This uses plain numbers in the middle of the intervals. The difference of κGA from the value for these is bounded
/// separately, because in a polynomial of degree d the uncertainty of numbers counts d times.
fn of_tube(ring: &Ring) -> Option<Nearly> {
    let gauss = &GAUSS_40;
    let inside = ring.inside.as_ref()?;
    let nu = data(ring.material.poisson());
    let (top, [below, mixed]) = cowper(nu);
    let modulus = data(ring.material.shear_modulus?) * Interval::pi();
    let sure = Sure::of(ring, inside)?;
    let middle = |of: Interval| number(of.middle());
    let own = Ring {
        outside: Border { series: sure.outside, ..ring.outside },
        inside: Some(Border { series: sure.inside, ..*inside }),
        empty: middle(ring.empty),
        material: ring.material,
    };
    let area = own.squares(gauss).times(middle(modulus));
    let [b, a] = [sure.outside, sure.inside].map(|series| series.values(gauss));
    let (b, a) = (b.product(&b), a.product(&a).times(own.empty));
    let sum = b.sum(&a);
    let square = sum.product(&sum);
    let numerator = square.times(middle(top)).product(&area);
    let denominator = square.times(middle(below)).sum(&a.product(&b).times(middle(mixed)));
    let values = std::array::from_fn(|g| numerator.at[g] / denominator.at[g]);
    let squares = sure.outer.square() + own.empty * sure.inner.square();
    let area_least = sure.wall * (sure.outer + sure.inner);
    let numerator_least = middle(top) * squares.square() * middle(modulus) * area_least;
    // `|c D − N| ≤ β N` bounds `|κGA − c| ≤ β κGA`.
    let nearly = stands_for(&values, &denominator, &numerator, numerator_least.low)?;
    // The ratio `q = m/(1 + m)²` moves by no more than m, and `6 (1 + ν)/κ = (7 + 6ν) + (20 + 12ν) q`.
    let empty = number(ring.empty.distance(ring.empty.middle()));
    let turned = mixed * below.reciprocal()? * (ring.empty * sure.ratio + empty);
    let one = number(1.0);
    let mut factor = one + number(nearly.share);
    for share in [off(top)?, off(modulus)?, off(below)?, off(mixed)?, turned, sure.area] {
        factor = factor * (one + share);
    }
    let share = (factor - one).high;
    (share < 0.5).then_some(Nearly { series: nearly.series, share })
}

/// The share `δ` with which a number is its middle times something in `[1/(1 + δ), 1 + δ]`.
fn off(of: Interval) -> Option<Interval> {
    Some(number(of.distance(of.middle())) * number(of.smallest()).reciprocal()?)
}

/// The radii of a tube as plain polynomials, with the consequences of their errors.
struct Sure {
    outside: Series,
    inside: Series,
    /// `b`, `a` and `b − a` (m) of the plain ones, at least.
    outer: Interval,
    inner: Interval,
    wall: Interval,
    /// Largest difference of `a²/b²`.
    ratio: Interval,
    /// The share `δ` with which `b² − a²` is that of the plain ones times something in `[1/(1 + δ), 1 + δ]`.
    area: Interval,
}

impl Sure {
    /// None where a radius or the wall may be 0.
    fn of(ring: &Ring, inside: &Border) -> Option<Self> {
        let plain = |border: &Border| border.series.lowered(border.series.degree());
        let ((outside, of_outer), (inside, of_inner)) = (plain(&ring.outside), plain(inside));
        let (of_outer, of_inner) = (number(of_outer), number(of_inner));
        let both = of_outer + of_inner;
        // True and plain ones are at least this.
        let least = |of: Interval| number(of.low.max(0.0));
        let outer = least(number(ring.least(|b, _| b)) - of_outer);
        let inner = least(number(ring.least(|_, a| a)) - of_inner);
        let wall = least(number(ring.least(|b, a| b - a)) - both);
        let one = number(1.0);
        let [of_wall, of_sum] = [wall, outer + inner].map(Interval::reciprocal);
        let area = (one + both * of_wall?) * (one + both * of_sum?) - one;
        // `|a/b − a₀/b₀| ≤ (|a − a₀| + |b − b₀|)/b`, both at most 1.
        let ratio = number(2.0) * both * outer.reciprocal()?;
        Some(Self { outside, inside, outer, inner, wall, ratio, area })
    }
}

/// A polynomial close to these values of `N/D`, and its relative error, where `N` is at least `least`.
fn stands_for(
    values: &[f64; 40],
    denominator: &Values<40>,
    numerator: &Values<40>,
    least: f64,
) -> Option<Nearly> {
    let gauss = &GAUSS_40;
    let near = Series::near(gauss, values, DEGREE, 0.0);
    let coefficients: Vec<f64> = (0..=DEGREE).map(|j| near.coefficient(j)).collect();
    let series = Series::exact(&coefficients);
    let product = series.values(gauss).product(denominator);
    let off = Series::through(gauss, &product.difference(numerator)).largest();
    let share = up(off / least);
    (least > 0.0 && share < 0.5).then(|| Nearly { series, share: up(share / down(1.0 - share)) })
}

/// `c` with `1/f ≤ c` on the cell, for a positive polynomial `f` with these values, and the largest relative excess of
/// `c`: with `c₀` near `1/f` and `|1 − c₀ f| ≤ β`, `1/f ≤ c₀/(1 − β)`. None where β is not below 1e-8.
pub fn inverse(values: &Values<40>, most: f64) -> Option<Nearly> {
    let gauss = &GAUSS_40;
    let near = Series::near(gauss, &values.at.map(|value| 1.0 / value), DEGREE, 0.0);
    let coefficients: Vec<f64> = (0..=DEGREE).map(|j| near.coefficient(j)).collect();
    let series = Series::exact(&coefficients);
    let product = series.values(gauss).product(values);
    let one = Values::constant(number(1.0));
    let share = Series::through(gauss, &product.difference(&one)).largest();
    (share < most).then_some(Nearly { series, share })
}
