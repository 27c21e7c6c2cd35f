//! Intervals, tables and series against arithmetic of twice the digits.

use sweetspot::base::interval::{Interval, down, up};
use sweetspot_proof::gauss::Gauss;
use sweetspot_proof::gauss::{GAUSS_24, GAUSS_40};
use sweetspot_proof::series::{Series, Values};

use crate::twofold::{Twofold, legendre, number, two_product, two_sum};

/// Random-looking numbers in [0, 1).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn share(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In (−1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.share() - 1.0
    }

    /// A number of any size whose products neither overflow nor underflow.
    fn any(&mut self) -> f64 {
        let special = [0.0, 1.0, -1.0, 1.0 + f64::EPSILON, 1.0 - 0.5 * f64::EPSILON, 3.0, 1e-100];
        match (self.share() * 8.0) as usize {
            0 => special[(self.share() * special.len() as f64) as usize],
            _ => self.signed() * 2f64.powi((200.0 * self.signed()) as i32),
        }
    }
}

/// The exact result lies in the interval, and each end is at most the double beyond the rounded one.
fn holds(found: Interval, [rounded, off]: [f64; 2], told: &str) {
    let exact = |end: f64| (rounded - end) + off;
    assert!(
        exact(found.low) >= 0.0 && exact(found.high) <= 0.0,
        "{told} {found:?} {rounded} {off}"
    );
    let near =
        found.low >= rounded.next_down().next_down() && found.high <= rounded.next_up().next_up();
    assert!(near, "{told} {found:?} {rounded}");
}

#[test]
fn every_operation_of_intervals_holds_the_exact_result() {
    let mut random = Random::new(1);
    for _ in 0..10_000_000 {
        let (a, b) = (random.any(), random.any());
        let (x, y) = (Interval::point(a), Interval::point(b));
        holds(x + y, two_sum(a, b), "sum");
        holds(x - y, two_sum(a, -b), "difference");
        holds(x * y, two_product(a, b), "product");
        let square = x.square();
        holds(square, two_product(a, a), "square");
        assert!(square.low >= 0.0);
        if b != 0.0 {
            let over = y.reciprocal().unwrap();
            // 1 − b q is exact in a fused operation, and has the sign of 1/b − q times that of b.
            let sign = b.signum();
            assert!(sign * (-b).mul_add(over.low, 1.0) >= 0.0, "{b} {over:?}");
            assert!(sign * (-b).mul_add(over.high, 1.0) <= 0.0, "{b} {over:?}");
        }
        if a > 0.0 {
            let root = x.sqrt();
            assert!((-root.low).mul_add(root.low, a) >= 0.0, "{a} {root:?}");
            assert!((-root.high).mul_add(root.high, a) <= 0.0, "{a} {root:?}");
        }
        assert!(down(a) < a && up(a) > a && down(a) <= a.next_down() && up(a) >= a.next_up());
    }
}

#[test]
fn what_underflows_or_overflows_is_still_held() {
    let tiny = Interval::point(1e-200);
    let product = tiny * tiny;
    assert!(product.low < 0.0 && product.high > 0.0);
    assert!(tiny.square().high > 0.0 && tiny.square().low == 0.0);
    let huge = Interval::point(1e300) * Interval::point(1e300);
    assert!(huge.low <= f64::MAX && huge.high == f64::INFINITY);
    assert!((Interval::point(f64::MAX) + Interval::point(f64::MAX)).low <= f64::MAX);
    let mixed = Interval { low: -2.0, high: 3.0 } * Interval { low: -5.0, high: 7.0 };
    assert!(mixed.low <= -15.0 && mixed.low > -15.1 && mixed.high >= 21.0 && mixed.high < 21.1);
}

/// Half a unit in the last place of a double, a little more.
fn half_a_unit(value: f64) -> f64 {
    0.500_001 * (value.abs().next_up() - value.abs())
}

fn table<const N: usize>(gauss: &Gauss<N>) {
    for g in 0..N {
        // The zero of P_N, by Newton's method from the table's.
        let mut x = number(gauss.points[g]);
        let one = number(1.0);
        for _ in 0..3 {
            let p = legendre(N + 1, x);
            let slope = number(N as f64) * (p[N - 1] - x * p[N]) / (one - x * x);
            x = x - p[N] / slope;
        }
        let p = legendre(N + 1, x);
        let below = number(N as f64) * p[N - 1];
        let weight = number(2.0) * (one - x * x) / (below * below);
        assert!(x.less(gauss.points[g]).abs() <= half_a_unit(gauss.points[g]), "point {g}");
        assert!(weight.less(gauss.weights[g]).abs() <= half_a_unit(gauss.weights[g]), "weight {g}");
        for (j, p) in p[..N].iter().enumerate() {
            let (own, to) = (gauss.legendre[j][g], gauss.to_series[j][g]);
            // Near a zero of P_j twice the digits are digits of 1, not of the value.
            assert!(p.less(own).abs() <= half_a_unit(own) + 1e-28, "P {j} {g}");
            let exact = number(0.5 * (2 * j + 1) as f64) * weight * *p;
            assert!(exact.less(to).abs() <= half_a_unit(to) + 1e-28, "to series {j} {g}");
        }
    }
}

#[test]
fn every_number_of_the_tables_is_the_nearest_double() {
    table(&GAUSS_24);
    table(&GAUSS_40);
}

/// A value of a series in twice the digits.
pub fn exact(coefficients: &[Twofold], x: Twofold) -> Twofold {
    let p = legendre(coefficients.len(), x);
    coefficients.iter().zip(p).fold(number(0.0), |sum, (c, p)| sum + *c * p)
}

fn random_series(random: &mut Random, terms: usize) -> Vec<f64> {
    (0..terms).map(|j| random.signed() * 0.7f64.powi(j as i32)).collect()
}

fn value(series: &Series, x: f64) -> Twofold {
    let all: Vec<Twofold> = (0..=series.degree()).map(|j| number(series.coefficient(j))).collect();
    exact(&all, number(x))
}

/// The polynomial is within the radius of the series at the points examined, and the radius is at most some thousands
/// of u.
fn within(series: &Series, of: impl Fn(Twofold) -> Twofold, told: &str) {
    let mut worst = 0.0_f64;
    for k in 0..=40 {
        let x = f64::from(k - 20) / 20.0;
        let off = (of(number(x)) - value(series, x)).high.abs();
        assert!(off <= series.radius() + 1e-29, "{told} at {x}: {off:e} {:e}", series.radius());
        worst = worst.max(off);
    }
    assert!(series.radius() < 1e-11, "{told} {:e}", series.radius());
}

#[test]
fn every_operation_of_series_holds_the_exact_polynomial() {
    let mut random = Random::new(5);
    for terms in (1..=12).cycle().take(600) {
        let [a, b] = [0, 1].map(|_| random_series(&mut random, terms));
        let [of_a, of_b] = [&a, &b].map(|c| {
            let c: Vec<Twofold> = c.iter().map(|c| number(*c)).collect();
            move |x: Twofold| exact(&c, x)
        });
        let (s, t) = (Series::exact(&a), Series::exact(&b));
        within(&(s + t), |x| of_a(x) + of_b(x), "sum");
        within(&(s - t), |x| of_a(x) - of_b(x), "difference");
        let factor = random.signed();
        within(&s.times(Interval::point(factor)), |x| of_a(x) * number(factor), "times");
        within(&s.plus(Interval::point(factor)), |x| of_a(x) + number(factor), "plus");
        // ∫ from −1, by Gauss's rule in twice the digits.
        let integral = |x: Twofold| {
            let half = (x + number(1.0)) / number(2.0);
            let mut sum = number(0.0);
            for (xi, w) in gauss_in_two().iter().copied() {
                sum = sum + w * of_a(half * (xi + number(1.0)) - number(1.0));
            }
            sum * half
        };
        within(&s.integrated(), integral, "integral");
        let whole = integral(number(1.0));
        let found = s.integral();
        assert!(whole.less(found.low) >= 0.0 && whole.less(found.high) <= 0.0);
        // Values and back, products, and integrals of products.
        let [va, vb]: [Values<24>; 2] = [s.values(&GAUSS_24), t.values(&GAUSS_24)];
        let product = va.product(&vb);
        within(&Series::through(&GAUSS_24, &product), |x| of_a(x) * of_b(x), "product");
        within(&Series::through(&GAUSS_24, &va.sum(&vb)), |x| of_a(x) + of_b(x), "values");
        let mut both = number(0.0);
        let mut square = number(0.0);
        for (xi, w) in gauss_in_two().iter().copied() {
            both = both + w * of_a(xi) * of_b(xi);
            square = square + w * of_a(xi) * of_a(xi);
        }
        for found in [product.integral(&GAUSS_24), s.inner(&t)] {
            assert!(
                both.less(found.low) >= 0.0 && both.less(found.high) <= 0.0,
                "{found:?} {both:?}"
            );
            assert!(found.high - found.low < 1e-13);
        }
        assert!(square.less(s.square_at_most()) <= 0.0);
        for (g, (xi, _)) in gauss_in_two().iter().enumerate() {
            // Twice the digits, of numbers about 1.
            let off = of_a(*xi).less(va.at[g]).abs();
            assert!(off <= va.radius + 1e-29, "{off:e} {:e}", va.radius);
            assert!(of_a(*xi).high.abs() <= s.largest());
        }
    }
}

/// 24 Gauss points and weights in twice the digits.
pub fn gauss_in_two() -> &'static [(Twofold, Twofold)] {
    static POINTS: std::sync::OnceLock<Vec<(Twofold, Twofold)>> = std::sync::OnceLock::new();
    POINTS.get_or_init(|| {
        let (n, one) = (24, number(1.0));
        let of = |start: f64| {
            let mut x = number(start);
            for _ in 0..3 {
                let p = legendre(n + 1, x);
                let slope = number(n as f64) * (p[n - 1] - x * p[n]) / (one - x * x);
                x = x - p[n] / slope;
            }
            let below = number(n as f64) * legendre(n + 1, x)[n - 1];
            (x, number(2.0) * (one - x * x) / (below * below))
        };
        GAUSS_24.points.iter().map(|x| of(*x)).collect()
    })
}

/// A missing bound is detected where every value is wrong by a whole radius.
#[test]
fn radii_go_through_every_operation() {
    let mut random = Random::new(9);
    for _ in 0..300 {
        let a = random_series(&mut random, 8);
        let off = 1e-6;
        let wide = Series::exact(&a).plus(Interval::within(off));
        let (high, exact_series) =
            (Series::exact(&a).plus(Interval::point(off)), Series::exact(&a));
        let to = |series: &Series| -> Vec<f64> {
            (0..=20).map(|k| value(series, f64::from(k - 10) / 10.0).high).collect()
        };
        let inside = |wide: Series, moved: Series| {
            let far = to(&wide).into_iter().zip(to(&moved)).map(|(a, b)| (a - b).abs());
            let far = far.fold(0.0, f64::max);
            assert!(far <= wide.radius() * (1.0 + 1e-6), "{far:e} {:e}", wide.radius());
        };
        inside(wide, high);
        inside(wide.integrated(), high.integrated());
        inside(wide.times(Interval::point(3.0)), high.times(Interval::point(3.0)));
        inside(wide + exact_series, high + exact_series);
        let (vw, vh) = (wide.values(&GAUSS_24), high.values(&GAUSS_24));
        inside(Series::through(&GAUSS_24, &vw), Series::through(&GAUSS_24, &vh));
        inside(
            Series::through(&GAUSS_24, &vw.product(&vw)),
            Series::through(&GAUSS_24, &vh.product(&vh)),
        );
        let (iw, ih) = (vw.product(&vw).integral(&GAUSS_24), vh.product(&vh).integral(&GAUSS_24));
        assert!(iw.low <= ih.low && ih.high <= iw.high + 1e-12);
        let (iw, ih) = (wide.inner(&wide), high.inner(&high));
        assert!(iw.low <= ih.low && ih.high <= iw.high + 1e-12);
        assert!(wide.square_at_most() >= high.inner(&high).low);
        assert!(wide.largest() >= high.largest() - 1e-12);
        assert!(wide.integral().high >= high.integral().low);
    }
}

#[test]
#[should_panic(expected = "do not integrate degree")]
fn points_do_not_integrate_what_is_beyond_them() {
    let values = Values { at: [1.0; 24], radius: 0.0, degree: 48 };
    let _ = values.integral(&GAUSS_24);
}

#[test]
#[should_panic(expected = "do not tell polynomials of degree 24 apart")]
fn points_do_not_tell_apart_what_is_beyond_them() {
    let values = Values { at: [1.0; 24], radius: 0.0, degree: 24 };
    let _ = Series::through(&GAUSS_24, &values);
}
