//! Where is a value greatest, where does it become too low, if several places cost hardly more than one?

/// Rounds after which a search ends in any case.
const MOST: usize = 40;

/// The greatest value on an interval with one maximum, located to that width: each round evaluates, side by side, places
/// about the top of the polynomial through the nearest known ones.
pub fn highest(
    [mut low, mut high]: [f64; 2],
    mut here: [f64; 2],
    mut known: Vec<[f64; 2]>,
    width: f64,
    values: impl Fn(&[f64]) -> Vec<f64>,
) -> [f64; 2] {
    for _ in 0..MOST {
        let curve = through(&known, here[0]);
        let aim = crossing([low, high], |x| curve(x)[1]);
        let places = about(aim, [low, high], width);
        if high - low <= 4.0 * width || places.is_empty() {
            break;
        }
        for (x, value) in places.iter().zip(values(&places)) {
            known.push([*x, value]);
            if value > here[1] {
                here = [*x, value];
            }
        }
        for [x, _] in &known {
            low = if *x < here[0] { x.max(low) } else { low };
            high = if *x > here[0] { x.min(high) } else { high };
        }
    }
    here
}

/// Where values become less than zero, between a place that is not below and one that is or has no value, located to
/// that width: each round evaluates, side by side, places about the zero of the polynomial through the nearest known
/// ones.
pub fn boundary(
    [mut good, mut bad]: [f64; 2],
    mut known: Vec<[f64; 2]>,
    width: f64,
    values: impl Fn(&[f64]) -> Vec<f64>,
) -> f64 {
    for _ in 0..MOST {
        let curve = through(&known, 0.5 * (good + bad));
        let aim = crossing([good, bad], |x| curve(x)[0]);
        let mut places = about(aim, [good.min(bad), good.max(bad)], 0.45 * width);
        if (bad - good).abs() <= width || places.is_empty() {
            return aim;
        }
        places.sort_by(|a, b| (a - good).abs().total_cmp(&(b - good).abs()));
        let values = values(&places);
        known.extend(places.iter().zip(&values).map(|(x, value)| [*x, *value]));
        let last = values.iter().take_while(|value| **value >= 0.0).count();
        bad = places.get(last).copied().unwrap_or(bad);
        good = if last > 0 { places[last - 1] } else { good };
    }
    good
}

/// Value and slope of the polynomial through the known places nearest to `x`, by Newton's divided differences.
fn through(known: &[[f64; 2]], x: f64) -> impl Fn(f64) -> [f64; 2] + use<> {
    const POINTS: usize = 5;
    let mut near: Vec<[f64; 2]> = known.iter().filter(|at| at[1].is_finite()).copied().collect();
    near.sort_by(|[a, _], [b, _]| (a - x).abs().total_cmp(&(b - x).abs()));
    near.truncate(POINTS);
    let mut differences: Vec<f64> = near.iter().map(|[_, value]| *value).collect();
    for order in 1..near.len() {
        for k in (order..near.len()).rev() {
            let by = differences[k] - differences[k - 1];
            differences[k] = by / (near[k][0] - near[k - order][0]);
        }
    }
    move |x| {
        let terms = near.iter().zip(&differences).rev();
        terms.fold([0.0; 2], |[value, slope], ([at, _], difference)| {
            [value * (x - at) + difference, slope * (x - at) + value]
        })
    }
}

/// Where a value is no longer positive, between a place where it is and one where it is not.
fn crossing([mut good, mut bad]: [f64; 2], value: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..50 {
        let middle = 0.5 * (good + bad);
        if value(middle) > 0.0 {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}

/// Places between two others, none of them close to another: an aimed one, one close by on both sides, and the middle of
/// the longer part.
fn about(aim: f64, [low, high]: [f64; 2], width: f64) -> Vec<f64> {
    /// Of the distance of both.
    const NEAR: f64 = 0.005;
    let by = width.max(NEAR * (high - low));
    let middle = if aim - low > high - aim { 0.5 * (low + aim) } else { 0.5 * (aim + high) };
    let mut places: Vec<f64> = vec![];
    for x in [aim, aim - by, aim + by, middle] {
        let apart = |other: &f64| (x - other).abs() > 0.5 * by;
        if x > low && x < high && [low, high].iter().chain(&places).all(apart) {
            places.push(x);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a function says at places.
    fn each(value: impl Fn(f64) -> f64) -> impl Fn(&[f64]) -> Vec<f64> {
        move |places| places.iter().map(|x| value(*x)).collect()
    }

    fn known(places: &[f64], value: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        places.iter().map(|x| [*x, value(*x)]).collect()
    }

    /// `1 − |x − a|^p` has its greatest value at a, smooth or as a kink. A search that starts near it finds it and
    /// evaluates nothing outside the interval.
    #[test]
    fn the_greatest_value_is_found_to_the_width() {
        for (power, a) in [(2.0, 0.61), (1.0, 0.61), (4.0, 0.61), (2.0, 0.5), (1.0, 0.7)] {
            let value = |x: f64| {
                assert!((0.5..=0.7).contains(&x));
                1.0 - (x - a).abs().powf(power)
            };
            let start = [0.6, value(0.6)];
            let known = known(&[0.5, 0.6, 0.7], value);
            let found = highest([0.5, 0.7], start, known, 1e-6, each(value));
            let flat = f64::EPSILON.powf(1.0 / power);
            assert!((found[0] - a).abs() < 3e-6 + 2.0 * flat, "{power} {a} {found:?}");
        }
    }

    #[test]
    fn a_boundary_is_found_to_the_width_where_one_side_has_no_value_too() {
        let value = |x: f64| 0.3 - x * x;
        let exact = 0.3_f64.sqrt();
        let found = boundary([0.0, 1.0], known(&[0.0, 1.0], value), 1e-9, each(value));
        assert!((found - exact).abs() < 1e-9);
        let none_beyond = |x: f64| if x < 0.4 { 1.0 } else { f64::NAN };
        let found = boundary([0.0, 1.0], known(&[0.0, 1.0], none_beyond), 1e-9, each(none_beyond));
        assert!((found - 0.4).abs() < 1e-9);
    }
}
