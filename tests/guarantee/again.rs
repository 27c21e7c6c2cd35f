//! The energies of trials computed again, in twice the digits and by sums from the knob end, for solid bats whose
//! radius is linear between stations.

use sweetspot::beam::mesh::Mesh;
use sweetspot::modes::plan::Plan;
use sweetspot::{Bat, Theory};
use sweetspot_proof::enclosure::beam::{Layout, Proven};
use sweetspot_proof::enclosure::moved::Trial;
use sweetspot_proof::enclosure::trials::trials;

use crate::arithmetic::{Random, gauss_in_two};
use crate::common::bat;
use crate::twofold::{Twofold, legendre, number};

/// π in twice the digits.
const PI: Twofold = Twofold { high: std::f64::consts::PI, low: 1.224_646_799_147_353_2e-16 };

/// A polynomial on a cell by its Legendre coefficients.
type Polynomial = Vec<Twofold>;

fn at(polynomial: &[Twofold], x: Twofold) -> Twofold {
    let p = legendre(polynomial.len().max(2), x);
    polynomial.iter().zip(p).fold(number(0.0), |sum, (c, p)| sum + *c * p)
}

fn integrated(polynomial: &[Twofold], half: Twofold) -> Polynomial {
    let mut out = vec![number(0.0); polynomial.len() + 1];
    for (j, c) in polynomial.iter().enumerate() {
        let part = half * *c / number((2 * j + 1) as f64);
        out[j + 1] = out[j + 1] + part;
        let back = if j == 0 { 0 } else { j - 1 };
        out[back] = if j == 0 { out[back] + part } else { out[back] - part };
    }
    out
}

fn plus(mut a: Polynomial, b: &[Twofold]) -> Polynomial {
    a.resize(a.len().max(b.len()), number(0.0));
    a.iter_mut().zip(b).for_each(|(a, b)| *a = *a + *b);
    a
}

/// The polynomial of that degree through the values of a function at the points.
fn through(degree: usize, f: impl Fn(Twofold) -> Twofold) -> Polynomial {
    let mut out = vec![number(0.0); degree + 1];
    for (xi, w) in gauss_in_two() {
        let value = *w * f(*xi);
        for (j, (c, p)) in out.iter_mut().zip(legendre(degree.max(1) + 1, *xi)).enumerate() {
            *c = *c + number(0.5 * (2 * j + 1) as f64) * value * p;
        }
    }
    out
}

fn integral(f: impl Fn(Twofold) -> Twofold) -> Twofold {
    gauss_in_two().iter().fold(number(0.0), |sum, (xi, w)| sum + *w * f(*xi))
}

/// A cell: half its length, its middle, and the radius at its middle and half its change.
struct Cell {
    half: Twofold,
    middle: Twofold,
    radius: [Twofold; 2],
}

impl Cell {
    fn r(&self, xi: Twofold) -> Twofold {
        self.radius[0] + self.radius[1] * xi
    }

    fn area(&self, xi: Twofold) -> Twofold {
        PI * self.r(xi) * self.r(xi)
    }

    fn second(&self, xi: Twofold) -> Twofold {
        let r = self.r(xi);
        self.area(xi) * r * r / number(4.0)
    }

    fn x(&self, xi: Twofold) -> Twofold {
        self.middle + self.half * xi
    }
}

/// `σ` and `ε²`.
fn energies(bat: &Bat, mesh: &Mesh, theory: Theory, trial: &Trial) -> [Twofold; 2] {
    let wood = bat.material();
    let [rho, e] = [wood.density, wood.youngs_modulus].map(number);
    let kg = number(wood.kappa(0.0)) * number(wood.shear_modulus.unwrap_or(0.0));
    let stations = &bat.profile().stations;
    let cells: Vec<Cell> = mesh
        .elements
        .iter()
        .map(|element| {
            let piece = element.piece;
            let [a, b] = [stations.x[piece], stations.x[piece + 1]].map(number);
            let [ra, rb] = [stations.outer[piece], stations.outer[piece + 1]].map(number);
            let [from, to] = [element.from, element.to].map(number);
            let half_share = (to - from) / number(2.0);
            let middle_share = (to + from) / number(2.0);
            Cell {
                half: (b - a) * half_share,
                middle: a + (b - a) * middle_share,
                radius: [ra + (rb - ra) * middle_share, (rb - ra) * half_share],
            }
        })
        .collect();
    let turns = theory.turns();
    let of = |all: &[f64], k: usize| -> Polynomial {
        all.get(k * trial.terms..(k + 1) * trial.terms)
            .map_or(vec![number(0.0)], |c| c.iter().map(|c| number(*c)).collect())
    };
    // The motion from rest at the knob end, then without its rigid part.
    let (mut w0, mut t0) = (number(0.0), number(0.0));
    let mut motion: Vec<[Polynomial; 2]> = vec![];
    for (k, cell) in cells.iter().enumerate() {
        let turn = plus(integrated(&of(&trial.bending, k), cell.half), &[t0]);
        let slope = plus(turn.clone(), &of(&trial.shear, k));
        let w = plus(integrated(&slope, cell.half), &[w0]);
        (w0, t0) = (at(&w, number(1.0)), at(&turn, number(1.0)));
        motion.push([w, turn]);
    }
    let mut gram = [number(0.0); 3];
    let mut load = [number(0.0); 2];
    for (cell, [w, turn]) in cells.iter().zip(&motion) {
        let own = |f: &dyn Fn(Twofold) -> Twofold| cell.half * integral(f);
        let turning = |xi: Twofold| if turns { rho * cell.second(xi) } else { number(0.0) };
        gram[0] = gram[0] + own(&|xi| rho * cell.area(xi));
        gram[1] = gram[1] + own(&|xi| rho * cell.area(xi) * cell.x(xi));
        gram[2] = gram[2] + own(&|xi| rho * cell.area(xi) * cell.x(xi) * cell.x(xi) + turning(xi));
        load[0] = load[0] + own(&|xi| rho * cell.area(xi) * at(w, xi));
        load[1] = load[1]
            + own(&|xi| rho * cell.area(xi) * cell.x(xi) * at(w, xi) + turning(xi) * at(turn, xi));
    }
    let determinant = gram[0] * gram[2] - gram[1] * gram[1];
    let push = (gram[2] * load[0] - gram[1] * load[1]) / determinant;
    let spin = (gram[0] * load[1] - gram[1] * load[0]) / determinant;
    for (cell, [w, turn]) in cells.iter().zip(&mut motion) {
        *w = plus(w.clone(), &[-push - spin * cell.middle, -spin * cell.half]);
        *turn = plus(turn.clone(), &[-spin]);
    }
    let (mut strain, mut kinetic) = (number(0.0), number(0.0));
    let (mut v0, mut m0) = (number(0.0), number(0.0));
    let mut forces: Vec<[Polynomial; 2]> = vec![];
    for (k, (cell, [w, turn])) in cells.iter().zip(&motion).enumerate() {
        let (bend, slip) = (of(&trial.bending, k), of(&trial.shear, k));
        strain = strain
            + cell.half
                * integral(|xi| {
                    let (c, g) = (at(&bend, xi), at(&slip, xi));
                    e * cell.second(xi) * c * c + kg * cell.area(xi) * g * g
                });
        let turning = |xi: Twofold| if turns { rho * cell.second(xi) } else { number(0.0) };
        kinetic = kinetic
            + cell.half
                * integral(|xi| {
                    let (w, t) = (at(w, xi), at(turn, xi));
                    rho * cell.area(xi) * w * w + turning(xi) * t * t
                });
        let load = through(w.len() + 1, |xi| rho * cell.area(xi) * at(w, xi));
        let v = plus(integrated(&load, cell.half), &[v0]);
        let couple = through(turn.len() + 3, |xi| -(turning(xi) * at(turn, xi)));
        let m = plus(integrated(&plus(v.clone(), &couple), cell.half), &[m0]);
        (v0, m0) = (at(&v, number(1.0)), at(&m, number(1.0)));
        forces.push([v, m]);
    }
    let sigma = kinetic / strain;
    let mut left = number(0.0);
    for (k, (cell, [v, m])) in cells.iter().zip(&forces).enumerate() {
        let (bend, slip) = (of(&trial.bending, k), of(&trial.shear, k));
        left = left
            + cell.half
                * integral(|xi| {
                    let stiff = e * cell.second(xi);
                    let off = at(m, xi) - sigma * stiff * at(&bend, xi);
                    let bent = off * off / stiff;
                    if !theory.shears() {
                        return bent;
                    }
                    let stiff = kg * cell.area(xi);
                    let off = at(v, xi) + sigma * stiff * at(&slip, xi);
                    bent + off * off / stiff
                });
    }
    [sigma, left / strain]
}

/// Rayleigh's quotient lies in its interval, and the residual is bounded, whether a trial is a mode or arbitrary; a
/// rounding error that is neglected anywhere puts an arbitrary trial outside.
#[test]
fn quotients_and_residuals_hold_what_twice_the_digits_say() {
    let linear = sweetspot::bat::profile::Interpolation::Linear;
    let mut random = Random::new(31);
    let mut looked = 0;
    for (x, outer) in [
        (vec![0.0, 0.8382], vec![0.0213, 0.0213]),
        (vec![0.0, 0.8382], vec![0.0127, 0.033528]),
        (vec![0.0, 0.3, 0.84], vec![0.012, 0.014, 0.033]),
    ] {
        let mut wood = sweetspot::Material::new(680.0, 15.5e9).unwrap();
        wood.shear_modulus = Some(1.05e9);
        let bare = bat(&x, &outer, &vec![0.0; x.len()], linear);
        let bat = bare.with(|parts| parts.material = wood).unwrap();
        for theory in Theory::ALL {
            let plan = Plan { mesh: Mesh::along(&bat, 6), degree: 9, ..Plan::default() };
            let layout = Layout::of(&bat, theory).unwrap();
            let proven = Proven::of(&bat, &layout, &plan.mesh, theory).unwrap();
            let mut all = trials(&bat, &plan, 6, theory).unwrap();
            for size in [1e-6, 1e-2, 1.0] {
                let mut lie = all[2].clone();
                let most = lie.bending.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
                lie.bending.iter_mut().for_each(|c| *c += size * most * random.signed());
                lie.shear.iter_mut().for_each(|c| *c += 0.01 * size * most * random.signed());
                all.push(lie);
            }
            for trial in &all {
                let found = proven.energies(trial).unwrap();
                let [sigma, residual] = energies(&bat, &plan.mesh, theory, trial);
                let quotient = found.quotient;
                let inside = sigma.less(quotient.low) >= 0.0 && sigma.less(quotient.high) <= 0.0;
                assert!(inside, "{theory:?} {quotient:?} {sigma:?}");
                let width = (quotient.high - quotient.low) / quotient.low;
                assert!(width < 1e-11, "{width:e}");
                let over = found.residual / residual.high;
                assert!(over > 1.0 - 1e-9, "{theory:?} {over}");
                // The least EI of a cell in place of EI, and the bound of a sum: too large by a factor of a few.
                let small = residual.high < 1e-24 * sigma.high * sigma.high;
                assert!(over < 30.0 || small, "{theory:?} {over}");
                looked += 1;
            }
        }
    }
    assert_eq!(looked, 3 * 3 * 9);
}
