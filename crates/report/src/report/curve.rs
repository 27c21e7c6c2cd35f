//! A curve drawn with characters.

/// Two curves over the same places, `*` over `.`, with values on the left and places below.
///
/// The drawing has `width` columns and `height` rows; places without a value stay empty.
pub fn draw(
    places: &[f64],
    curves: [(&[Option<f64>], char); 2],
    labels: [&str; 2],
    [width, height]: [usize; 2],
) -> String {
    let values = || curves.iter().flat_map(|(values, _)| values.iter().flatten().copied());
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    let (Some(first), Some(last)) = (places.first(), places.last()) else { return String::new() };
    if low > high || places.len() < 2 {
        return String::new();
    }
    let span = if high > low { high - low } else { 1.0 };
    let mut rows = vec![vec![' '; width]; height];
    for (values, mark) in curves {
        for (x, value) in places.iter().zip(values) {
            if let Some(value) = value {
                let column = ((x - first) / (last - first) * (width - 1) as f64).round() as usize;
                let row = ((high - value) / span * (height - 1) as f64).round() as usize;
                rows[row][column] = mark;
            }
        }
    }
    let mut out = format!("  {}\n", labels[0]);
    for (k, row) in rows.iter().enumerate() {
        let value = high - span * k as f64 / (height - 1) as f64;
        let line: String = row.iter().collect();
        out += format!("  {value:>7.1} |{line}").trim_end();
        out.push('\n');
    }
    out += &format!("          +{}\n", "-".repeat(width));
    let middle = 0.5 * (first + last);
    let half = width / 2 - 6;
    out += &format!("          {first:<half$.1}{middle:^12.1}{last:>half$.1}\n");
    out += format!("          {:^width$}", labels[1]).trim_end();
    out + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highest_value_is_in_the_first_row_and_the_lowest_in_the_last() {
        let places = [0.0, 1.0, 2.0];
        let (a, b) = ([Some(1.0), None, Some(3.0)], [None, Some(2.0), None]);
        let drawn = draw(&places, [(&a, '*'), (&b, '.')], ["v", "x"], [21, 5]);
        let rows: Vec<&str> = drawn.lines().collect();
        assert!(rows[1].starts_with("      3.0 |") && rows[1].ends_with('*'), "{drawn}");
        assert!(rows[3].ends_with("          ."), "{drawn}");
        assert!(rows[5].starts_with("      1.0 |*"), "{drawn}");
    }

    #[test]
    fn nothing_to_draw_draws_nothing() {
        assert_eq!(draw(&[], [(&[], '*'), (&[], '.')], ["", ""], [20, 5]), "");
        assert_eq!(draw(&[1.0, 2.0], [(&[None, None], '*'), (&[], '.')], ["", ""], [20, 5]), "");
    }
}
