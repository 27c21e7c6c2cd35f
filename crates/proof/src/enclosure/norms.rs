//! What are upper bounds of the trace and the Hilbert-Schmidt norm of the compliance of the bat?
//!
//! A unit kink (χ) or jump (γ) at `s` moves the bat on its left by `(s − x, −1)` or `(−1, 0)` in `(w, θ)`, and the bat
//! on its right not at all. Its loads on the two rigid motions `(1, 0)` and `(x, 1)` are running sums,
//!
//! ```text
//! u_χ(s) = ∫₀^s (A, B − ρI) dx,   u_γ(s) = −(A, B),   A = ∫₀^s ρA dx,   B = ∫₀^s ρA x dx
//! v_χ(t) = (t, −1) − G u_χ(t),    v_γ(t) = (−1, 0) − G u_γ(t)
//! G = [1/M + d²/I, −d/I; −d/I, 1/I],   M the mass, I the moment of inertia about the balance point at x = d
//! ```
//!
//! Left of a unit strain at `t` the bat lies on the line `v(t)` after removal of the rigid motions, so the kernel of T
//! is `k_ab(s, t) = u_a(s)·v_b(t)` for `s ≤ t`. With `C_χ = EI`, `C_γ = κGA`,
//!
//! ```text
//! trace T = ∫ Σ_b u_b·v_b/C_b dt        |T|² = Σ τ² = 2 ∫ Σ_b v_bᵀ U v_b/C_b dt,   U′ = Σ_a u_a u_aᵀ/C_a
//! ```
//!
//! A compliant part ([`super::gives`]) acts like a strain at its place with `C = K`: a joint has the `u_χ` and `v_χ` of
//! its place, and a spring under a mass has `u = μ (1, x)`, `v = −G u`, with `μ + u·v` in place of `u·v` for itself. It
//! adds `(u·v/C)²` to `|T|²`.
//!
//! Sums run over each side of the balance point from its end, with `x` counted anew from the beginning of every
//! stretch, so that nothing cancels at thin ends and little elsewhere. Pairs of strains on different sides have
//! separate motions and add `2 tr(U_l G U_r G)`. Every integrand with `1/C` is non-negative and increases with `1/C`,
//! so a polynomial above `1/C` gives an upper bound.
//!
//! # Source
//!
//! G. Fichera, Numerical and Quantitative Analysis (1978): orthogonal invariants of a compact operator. The kernel is
//! derived here.

use crate::enclosure::beam::{Layout, PlacedMass};
use crate::enclosure::contacts::{Bed, Contact};
use crate::enclosure::gives::{Give, YieldingPart, softness};
use crate::enclosure::holding::{Hold, Holding, OF_A_BED};
use crate::enclosure::stretches::{Met, Rigid, Stretch, rigid, stretches};
use crate::gauss::GAUSS_40;
use crate::series::{Series, Values};
use sweetspot::base::{Error, Interval, Result};
use sweetspot::bat::{Bat, Theory};

/// Trace (s²) and square of the Hilbert-Schmidt norm (s⁴) of T.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Norms {
    /// `Σ τ_n`, at most.
    pub trace: f64,
    /// `Σ τ_n²`, at most.
    pub square: f64,
    /// Γ (m²/J) of [`super::nodes`]: upper bound of the square of the motion of any place by a strain of unit energy.
    pub reach: f64,
    /// The largest relative increase with which 1/EI and 1/κGA were bounded.
    pub above: f64,
    /// Number of stretches that it took.
    pub stretches: usize,
}

const ZERO: Interval = Interval { low: 0.0, high: 0.0 };

/// Sums from one end of the bat.
#[derive(Clone, Copy)]
struct Sums {
    /// A and B.
    line: [Interval; 2],
    /// `u_χ`.
    kink: [Interval; 2],
    /// U: its entries 11, 12 and 22.
    outer: [Interval; 3],
}

fn point(value: f64) -> Interval {
    Interval::point(value)
}

impl Norms {
    /// Those of a bat.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] where no short stretch has a polynomial near 1/EI.
    pub fn of(bat: &Bat, layout: &Layout, theory: Theory) -> Result<Self> {
        let (mut stretches, borders) = stretches(bat, layout, theory)?;
        let met = |placed: &PlacedMass| {
            let PlacedMass { piece, mass, inertia, centre, give, .. } = *placed;
            Met { before: borders[piece], centre, mass, inertia, give }
        };
        let masses: Vec<Met> = layout.masses.iter().map(met).collect();
        let length = layout.length;
        let rigid = rigid(&stretches, &masses);
        let balance = (rigid[1] * point(1.0 / rigid[0].middle())).middle();
        let split = stretches.partition_point(|stretch| stretch.middle.middle() <= balance);
        let unbounded = || {
            let found = "a bat whose rigid motions nothing tells apart";
            Error::value("profile", found, "numbers nearer to 1 in SI units")
        };
        let unheld = || {
            let found = "contacts of which it is not sure that they hold the bat";
            Error::value("supports", found, "supports and springs apart from each other")
        };
        let rigid = Rigid::of(rigid, length).ok_or_else(unbounded)?;
        let knob: Vec<Met> = masses.iter().filter(|mass| mass.before <= split).copied().collect();
        let holding = Holding { stretches: &stretches, masses: &masses, split, rigid: &rigid };
        let holds = holds(layout, &borders);
        let less =
            if holds.is_empty() { [ZERO; 2] } else { holding.less(&holds).ok_or_else(unheld)? };
        let count = stretches.len();
        let border = stretches.get(split).map_or(length, Stretch::begin);
        let (parts_l, outer_l) = from_end(&stretches[..split], &knob, &rigid, border);
        let mirrored: Vec<Stretch> =
            stretches.drain(split..).rev().map(|stretch| stretch.mirrored(length)).collect();
        // Seen from the tip, where x′ = L − x.
        let tip: Vec<Met> = masses
            .iter()
            .filter(|mass| mass.before > split)
            .map(|mass| Met { before: count - mass.before, centre: length - mass.centre, ..*mass })
            .rev()
            .collect();
        let turned = Rigid { balance: length - rigid.balance, ..rigid };
        let (parts_r, outer_r) = from_end(&mirrored, &tip, &turned, length - border);
        let [trace, square, reach] = std::array::from_fn(|k| parts_l[k] + parts_r[k]);
        // Both about the border between them, moments the other way round.
        let [a, b, c] = outer_r;
        let outer_r = [a, -b, c];
        let inverse = full(rigid.inverse(border));
        let both = times(times(full(outer_l), inverse), times(full(outer_r), inverse));
        let across = both[0][0] + both[1][1];
        let shares = stretches.iter().chain(&mirrored).map(|stretch| stretch.above);
        let norm = square + square + across + across;
        // The largest motion of a bat that is held or has compliant parts is not derived here, so none of its nodes is
        // proven.
        let bare = holds.is_empty() && masses.iter().all(|mass| mass.give.is_none());
        let reach = if bare { reach.high } else { f64::INFINITY };
        Ok(Self {
            trace: (trace - less[0]).high,
            square: (norm - less[1]).high,
            reach,
            above: shares.fold(0.0, f64::max),
            stretches: count,
        })
    }

    /// Upper bounds of the eigenvalues besides some that are at least `known`: by the trace and by the norm.
    pub fn others(&self, known: &[f64]) -> [f64; 2] {
        let sum: Interval = known.iter().map(|tau| point(*tau)).sum();
        let squares: Interval = known.iter().map(|tau| point(*tau).square()).sum();
        let positive = |of: Interval| Interval { low: 0.0, high: of.high.max(0.0) };
        [positive(point(self.trace) - sum).high, positive(point(self.square) - squares).sqrt().high]
    }
}

/// The restrained quantities of a bat whose pieces begin at these borders of its stretches.
fn holds(layout: &Layout, borders: &[usize]) -> Vec<Hold> {
    let at = |contact: &Contact| Contact { border: borders[contact.border], ..*contact };
    let mut holds: Vec<Hold> = layout.contacts.iter().map(at).map(Hold::Place).collect();
    if let Some(bed) = layout.bed {
        let bed = Bed { borders: bed.borders.map(|piece| borders[piece]), ..bed };
        holds.extend((0..OF_A_BED).map(|term| Hold::Bed(bed, term)));
    }
    holds
}

fn full([a, b, c]: [Interval; 3]) -> [[Interval; 2]; 2] {
    [[a, b], [b, c]]
}

fn times(a: [[Interval; 2]; 2], b: [[Interval; 2]; 2]) -> [[Interval; 2]; 2] {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

/// Trace, half the square of the norm, Γ, and U at the inner end, over stretches from an end of the bat.
fn from_end(
    stretches: &[Stretch],
    masses: &[Met],
    rigid: &Rigid,
    inner: Interval,
) -> ([Interval; 3], [Interval; 3]) {
    let mut parts = [ZERO; 3];
    let mut sums = Sums { line: [ZERO; 2], kink: [ZERO; 2], outer: [ZERO; 3] };
    // The masses passed so far, as `u` of a strain beyond them includes them: `Σμ`, `Σμc`, `Σμc² + J`.
    let mut masses = masses.iter().peekable();
    let mut add = |own: [Interval; 3]| {
        parts.iter_mut().zip(own).for_each(|(sum, part)| *sum = *sum + part);
    };
    for k in 0..=stretches.len() {
        let stretch = stretches.get(k);
        let begin = stretch.map_or(inner, Stretch::begin);
        while let Some(met) = masses.next_if(|met| met.before <= k) {
            // `(s − c) μ` and `(s − c) μ c − J` at the place where it is passed, and their slopes.
            let centre = met.centre - begin;
            let push = -(met.mass * centre);
            sums.kink[0] = sums.kink[0] + push;
            sums.kink[1] = sums.kink[1] + push * centre - met.inertia;
            sums.line[0] = sums.line[0] + met.mass;
            sums.line[1] = sums.line[1] + met.mass * centre;
            met.give.into_iter().for_each(|give| add(sums.given(give, met, begin, rigid)));
        }
        stretch.into_iter().for_each(|stretch| add(sums.over(stretch, rigid)));
    }
    (parts, sums.outer)
}

impl Sums {
    /// Passes a compliant part at a place and returns its parts of trace and half the square of the norm, without Γ.
    fn given(&mut self, give: Give, met: &Met, at: Interval, rigid: &Rigid) -> [Interval; 3] {
        let [g11, g12, g22] = rigid.inverse(at);
        // Counted from the place itself.
        let (u, own) = match give.way {
            YieldingPart::Joint => (self.kink, [ZERO, point(-1.0)]),
            YieldingPart::Hung => ([met.mass, met.mass * (met.centre - at)], [ZERO; 2]),
        };
        let v = [own[0] - g11 * u[0] - g12 * u[1], own[1] - g12 * u[0] - g22 * u[1]];
        // The stretch of a spring moves only the mass, apart from rigid motion.
        let alone = if give.way == YieldingPart::Hung { met.mass } else { ZERO };
        let soft = softness(&give);
        let trace = soft * (alone + u[0] * v[0] + u[1] * v[1]);
        let [o11, o12, o22] = self.outer;
        let before = o11 * v[0].square() + point(2.0) * o12 * v[0] * v[1] + o22 * v[1].square();
        let products = [u[0].square(), u[0] * u[1], u[1].square()];
        self.outer = std::array::from_fn(|k| self.outer[k] + soft * products[k]);
        [trace, soft * before + point(0.5) * trace.square(), ZERO]
    }

    /// Goes over a stretch: its parts of `∫Σ u·v/C`, `∫Σ vᵀUv/C` and Γ.
    fn over(&mut self, stretch: &Stretch, rigid: &Rigid) -> [Interval; 3] {
        let gauss = &GAUSS_40;
        let half = stretch.half;
        // Counted from the beginning of the stretch.
        let x = Series::of(&[half, half]).values(gauss);
        let run = |slope: &Series, begin: Interval| {
            let series = slope.integrated().times(half).plus(begin);
            (series, begin + half * slope.integral())
        };
        let mass = Series::through(gauss, &stretch.mass);
        let first = Series::through(gauss, &stretch.mass.product(&x));
        let (a, a_end) = run(&mass, self.line[0]);
        let (b, b_end) = run(&first, self.line[1]);
        let pulled = match &stretch.turning {
            Some(turning) => b - Series::through(gauss, turning),
            None => b,
        };
        let (u1, u1_end) = run(&a, self.kink[0]);
        let (u2, u2_end) = run(&pulled, self.kink[1]);
        let [a, b, u1, u2] = [a, b, u1, u2].map(|series| series.values(gauss));
        let strains = strains(stretch, rigid, &x, [u1, u2], [a, b]);
        let mut trace = Values::constant(ZERO);
        let mut slopes = [Values::constant(ZERO); 3];
        for ([u1, u2], [v1, v2], soft) in &strains {
            let (s1, s2) = (u1.product(soft), u2.product(soft));
            trace = trace.sum(&s1.product(v1).sum(&s2.product(v2)));
            let parts = [s1.product(u1), s1.product(u2), s2.product(u2)];
            slopes.iter_mut().zip(parts).for_each(|(sum, part)| *sum = sum.sum(&part));
        }
        let [(o11, e11), (o12, e12), (o22, e22)] =
            std::array::from_fn(|k| run(&Series::through(gauss, &slopes[k]), self.outer[k]));
        let [o11, o12, o22] = [o11, o12, o22].map(|series| series.values(gauss));
        let mut square = Values::constant(ZERO);
        for (_, [v1, v2], soft) in &strains {
            let twice = o12.times(point(2.0)).product(v1).product(v2);
            let form = o11.product(v1).product(v1).sum(&twice).sum(&o22.product(v2).product(v2));
            square = square.sum(&form.product(soft));
        }
        let reach = reach(&strains, &x, [-stretch.begin(), rigid.length - stretch.begin()]);
        // About the end of the stretch from here on.
        let h = half + half;
        *self = Self {
            line: [a_end, b_end - h * a_end],
            kink: [u1_end, u2_end - h * u1_end],
            outer: [e11, e12 - h * e11, e22 - h * (e12 + e12) + h.square() * e11],
        };
        [trace, square, reach].map(|of| half * of.integral(gauss))
    }
}

/// A strain at the points of a stretch: `u`, `v` and the upper bound of `1/C`.
type Strain<'a> = ([Values<40>; 2], [Values<40>; 2], &'a Values<40>);

/// The strains χ and, in a theory with shear, γ at the places `x` from the beginning of a stretch, of `u_χ` and
/// `(A, B)`.
fn strains<'a>(
    stretch: &'a Stretch,
    rigid: &Rigid,
    x: &Values<40>,
    [u1, u2]: [Values<40>; 2],
    [a, b]: [Values<40>; 2],
) -> Vec<Strain<'a>> {
    let one = Values::constant(point(1.0));
    let [g11, g12, g22] = rigid.inverse(stretch.begin());
    let of = |[u, w]: [&Values<40>; 2]| {
        let v1 = u.times(g11).sum(&w.times(g12));
        let v2 = u.times(g12).sum(&w.times(g22));
        [v1, v2]
    };
    let [k1, k2] = of([&u1, &u2]);
    let kink = [x.difference(&k1), one.times(point(-1.0)).difference(&k2)];
    let mut strains = vec![([u1, u2], kink, &stretch.soft)];
    if let Some(slip) = &stretch.slip {
        let [j1, j2] = of([&a, &b]);
        // u_γ is the opposite of (A, B).
        let minus = |values: &Values<40>| values.times(point(-1.0));
        strains.push(([minus(&a), minus(&b)], [j1.difference(&one), j2], slip));
    }
    strains
}

/// Γ at these places, with the ends of the bat as far from the beginning of the stretch.
fn reach(strains: &[Strain], x: &Values<40>, [knob, tip]: [Interval; 2]) -> Values<40> {
    let one = Values::constant(point(1.0));
    let mut reach = Values::constant(ZERO);
    for ((_, [v1, v2], soft), kinks) in strains.iter().zip([true, false]) {
        // Beyond the strain the bat lies on the other line, which differs by the unit strain's own motion.
        let [w1, w2] = if kinks { [v1.difference(x), v2.sum(&one)] } else { [v1.sum(&one), *v2] };
        let ends = [
            v1.sum(&v2.times(knob)),
            v1.sum(&v2.product(x)),
            w1.sum(&w2.product(x)),
            w1.sum(&w2.times(tip)),
        ];
        let squares = ends.map(|end| end.product(&end));
        let sum = squares.into_iter().reduce(|a, b| a.sum(&b)).expect("four of them");
        reach = reach.sum(&sum.product(soft));
    }
    reach
}
