//! How is a number written as text?

/// The fewest digits that read back to the same bits, as in JSON; "null" for NaN and infinity.
pub fn shortest(value: f64) -> String {
    serde_json::Value::from(value).to_string()
}

/// The value to `digits` significant digits, without trailing zeros; with a power of ten where the plain number would
/// be long.
pub fn significant(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    match rounded.abs() {
        0.0 | 1e-3..1e5 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// The value to the given number of decimals; 0 is never −0.
pub fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = 10.0_f64.powi(decimals);
    (scale * value).round() / scale + 0.0
}

/// A change to the given number of decimals, with its sign; no change is +0.
pub fn signed(value: f64, decimals: usize) -> String {
    format!("{:+.decimals$}", rounded(value, decimals as i32))
}

/// A bound to that many significant digits, rounded up.
pub fn bound(value: f64, digits: usize) -> String {
    let near = format!("{value:.*e}", digits - 1);
    match (near.parse::<f64>(), near.split_once('e').and_then(|(_, power)| power.parse().ok())) {
        (Ok(rounded), Some(power)) if rounded < value => {
            let last = 10.0_f64.powi(power) * 10.0_f64.powi(1 - digits as i32);
            format!("{:.*e}", digits - 1, rounded + last)
        }
        _ => near,
    }
}

/// A share in per cent.
pub fn percent(share: f64, decimals: usize) -> String {
    format!("{:.decimals$} %", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_as_many_as_asked_for() {
        assert_eq!(significant(174.512_3, 4), "174.5");
        assert_eq!(significant(0.020_000_01, 3), "0.02");
        assert_eq!(significant(-1.234_56e-7, 3), "-1.23e-7");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(shortest(1e-7), "1e-7");
        assert_eq!((signed(-0.001, 2), signed(1.005, 1)), ("+0.00".into(), "+1.0".into()));
        assert_eq!(percent(0.123, 1), "12.3 %");
        assert_eq!((bound(1.1e-4, 1), bound(1.0e-4, 1)), ("2e-4".into(), "1e-4".into()));
        assert_eq!((bound(9.4e-7, 1), bound(1.02e-4, 2)), ("1e-6".into(), "1.1e-4".into()));
        assert_eq!((bound(0.0, 1), bound(f64::INFINITY, 1)), ("0e0".into(), "inf".into()));
    }
}
