//! The figures and tables of the WPI report, compared with `validation/wpi` (made as its README says).
//!
//! Tolerances: the references have 12 digits, so 5e-12 of a value between 1 and 10 is their rounding. Larger
//! differences are explained where they occur.

#[path = "../examples/wpi_report/table.rs"]
mod table;
#[path = "../examples/wpi_report/sums.rs"]
mod sums;
#[path = "../examples/wpi_report/vibration.rs"]
mod vibration;
#[path = "../examples/wpi_report/hit.rs"]
mod hit;
#[path = "../examples/wpi_report/claims.rs"]
mod claims;

use std::path::Path;
use table::Table;

/// A reference file: names, and cells as text.
struct Reference {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Reference {
    fn read(name: &str) -> Self {
        let folder = Path::new(env!("SWEETSPOT_TOP")).join("validation/wpi");
        let text = std::fs::read_to_string(folder.join(format!("{name}.csv"))).unwrap();
        let mut lines =
            text.lines().map(|line| line.split(',').map(String::from).collect::<Vec<_>>());
        Self { columns: lines.next().unwrap(), rows: lines.collect() }
    }

    fn column(&self, name: &str) -> Vec<&str> {
        let at = self.columns.iter().position(|column| column == name).unwrap();
        self.rows.iter().map(|row| row[at].as_str()).collect()
    }
}

/// Half a unit of the last digit of `text`, as in `1.06e-05` or `1.035942`.
fn half_unit(text: &str) -> f64 {
    let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    0.5 * 10_f64.powi(exponent.parse::<i32>().unwrap() - decimals as i32)
}

/// Compares our `column`, every `step`-th row, with that of the reference, to the rounding of its digits plus
/// `tolerance`. An empty cell requires that there is no value.
fn hold(ours: &Table, column: &str, step: usize, tolerance: f64) {
    hold_rows(ours, column, step, |_| tolerance);
}

/// [`hold`] with a tolerance for each row.
fn hold_rows(ours: &Table, column: &str, step: usize, tolerance: impl Fn(usize) -> f64) {
    let reference = Reference::read(ours.name);
    let ours_sampled: Vec<f64> = ours.column(column).into_iter().step_by(step).collect();
    let cells = reference.column(column);
    assert_eq!(cells.len(), ours_sampled.len(), "{}", ours.name);
    for (row, (cell, value)) in cells.into_iter().zip(ours_sampled).enumerate() {
        if cell.is_empty() {
            assert!(value.is_nan(), "{} {column} row {row}: {value}", ours.name);
            continue;
        }
        let error = value - cell.parse::<f64>().unwrap();
        // Trailing zeros of a cell were dropped; it has 12 digits.
        let rounding = 5.01e-12 * value.abs() + 1e-15;
        assert!(
            error.abs() <= rounding + tolerance(row),
            "{} {column} row {row}: {error:e}",
            ours.name
        );
    }
}

fn hold_all(ours: &Table, step: usize, tolerance: f64) {
    for column in &ours.columns {
        hold(ours, column, step, tolerance);
    }
}

/// Compares `column` to the printed digits wherever the reference says that they are valid.
fn hold_printed(ours: &Table, column: &str) -> usize {
    let reference = Reference::read(ours.name);
    let (printed, holds) = (reference.column("printed"), reference.column("printed_holds"));
    let cells = ours.column(column).into_iter().zip(printed).zip(holds);
    let held = cells.filter(|(_, holds)| *holds == "1").map(|((value, text), _)| {
        let error = value - text.parse::<f64>().unwrap();
        assert!(error.abs() <= half_unit(text) * 1.000_001, "{} {text}: {value:e}", ours.name);
    });
    held.count()
}

#[test]
fn the_stiff_bat_s_speed_and_energy_are_the_reference_ones() {
    hold_all(&hit::rigid_speeds(), 25, 0.0);
    // The mass of the ball in slug was rounded to ten digits: 2e-10 of 12 200 slug in²/s², 115 J.
    let energy = hit::rigid_energies();
    for column in ["X", "omega40", "omega50", "omega60"] {
        hold(&energy, column, 25, 2.5e-6);
    }
    hold(&energy, "omega50_joule", 25, 2.5e-8);
}

#[test]
fn roots_shapes_and_nodes_have_all_twelve_digits() {
    hold_all(&vibration::roots(), 1, 2e-14);
    hold_all(&vibration::frequency_curves(), 25, 0.0);
    hold_all(&vibration::shapes(), 25, 1e-13);
    hold_all(&vibration::nodes(), 1, 0.0);
    hold_all(&vibration::initial_shape(), 25, 0.0);
}

#[test]
fn the_orthogonality_matrix_is_the_printed_one_up_to_its_noise() {
    let ours = vibration::orthogonality_table();
    // Round-off of a sum of 1001 terms of up to 4e-3, and of the reference's own.
    hold(&ours, "trapezoid", 1, 2e-14);
    hold(&ours, "exact", 1, 0.0);
    assert_eq!(hold_printed(&ours, "trapezoid"), 18);
    // The script's hyperbolic form differs by rounding noise: α, near −1, is off by ε/2 and leaves
    // ε/4 e^(bX) of its growing part, which meets an end value 2 over a length 1/b; twice that.
    let (clean, raw, m) = (ours.column("trapezoid"), ours.column("script_form"), ours.column("m"));
    let b = vibration::roots().column("exact");
    for (row, (clean, raw)) in clean.iter().zip(raw).enumerate() {
        let b = b[m[row] as usize - 1];
        let noise = f64::EPSILON * (1.0 + b.exp() / b);
        assert!((clean - raw).abs() < noise, "row {row}: {:e}", clean - raw);
    }
}

/// The measured cancellation error of the shapes of the script in the sum of 1, 2, … 9 modes. It grows like e^b, by 23
/// from mode to mode, unless the error of the seventh root dominates.
const NOISE: [f64; 9] = [0.0, 0.0, 2e-14, 2e-13, 2e-12, 1.2e-11, 6e-10, 2.5e-9, 1.6e-8];

#[test]
fn the_series_of_the_initial_shape_is_the_printed_one_up_to_its_noise() {
    let (steps, coefficients) = (vibration::partial_sum_steps(), vibration::coefficients());
    // Both references take the script's seventh root, (7½)π, which is 1.2e-10 too small.
    hold(&coefficients, "exact", 1, 1e-15);
    hold(&steps, "exact", 1, 2e-14);
    assert_eq!(hold_printed(&steps, "trapezoid"), 3);
    assert_eq!(hold_printed(&coefficients, "trapezoid"), 4);
    hold_rows(&coefficients, "trapezoid", 1, |row| NOISE[row]);
    hold_rows(&steps, "trapezoid", 1, |row| NOISE[row + 1]);
}

/// The references come from the shapes of the script, where each further mode adds its noise.
#[test]
fn released_shapes_agree_to_the_noise_of_the_script_s_highest_mode() {
    let sums = vibration::partial_sums_in_time();
    for n in 1..=9 {
        hold(&sums, &format!("sum{n}"), 25, NOISE[n - 1]);
    }
    let released = vibration::released_over_time();
    for column in &released.columns {
        hold(&released, column, 25, NOISE[6]);
    }
}

#[test]
fn the_struck_dowel_moves_as_the_reference_one() {
    // Phases ω_n t of up to 2e5 rad leave 1e-13 of the sum.
    for eighths in [1, 2, 4] {
        hold_all(&vibration::struck_sums(eighths), 25, 1e-13);
    }
    hold_all(&vibration::struck_at_two_times(), 25, 1e-13);
    hold_all(&vibration::end_point(), 100, 1e-12);
}

#[test]
fn the_empirical_loss_is_the_reference_one_and_has_no_value_where_that_has_none() {
    hold_all(&hit::mode_sums(), 25, 0.0);
    hold_all(&hit::three_speeds(), 25, 0.0);
}

/// The position of a flat maximum found by comparing values is accurate to √ε = 1.5e-8 on either side, and so are
/// quantities that depend on it to first order.
#[test]
fn the_summary_of_figure_18_is_the_reference_one() {
    let ours = hit::summary();
    for column in &ours.columns {
        let place = column.contains("X_peak") || column.contains("shift");
        let at_place = column == "velocity_drop_at_rigid_peak";
        hold(&ours, column, 1, if place || at_place { 3e-8 } else { 1e-13 });
    }
}

#[test]
fn the_claims_stand_or_fall_as_told() {
    let summary = hit::summary();
    let of = |column| claims::ten_modes(&summary, column);
    let near = |value: f64, told: f64, unit: f64| assert!((value - told).abs() <= unit, "{value}");
    near(claims::mean(of("relative_shift")), 0.1077, 5e-5);
    near(claims::mean(of("shift_in_L")), 0.0728, 5e-5);
    near(claims::mean(of("ball_energy_drop_peak_to_peak")), 0.1819, 5e-5);
    near(claims::mean(of("velocity_drop_peak_to_peak")), 0.096, 5e-4);
    assert!(of("X_peak_vib").iter().all(|x| *x < claims::barrel_node(1)));
    near(claims::unconverged(1), 0.052, 5e-4);
    near(claims::unconverged(2), 0.028, 5e-4);
    near(claims::unconverged(4), 0.085, 5e-4);
    near(claims::as_printed(50.0, 1.0), 1.545, 5e-4);
    near(claims::gaining_share(), 0.42, 5e-3);
    near(claims::dowel().frequency(sweetspot::beam::dowel::Ends::FreeFree, 1), 238.907, 5e-4);
    assert!(claims::claims(&summary).iter().chain(&claims::corrections(&summary)).all(told));
}

fn told(claim: &claims::Claim) -> bool {
    let claims::Claim { claim, printed, ours, verdict } = claim;
    let told = [claim, verdict].iter().all(|text| !text.is_empty());
    told && [ours.as_str(), printed].iter().all(|text| !text.contains("NaN"))
}

/// No mode affects the ball at its node, so there the curves of figure 17 touch.
#[test]
fn curves_of_figure_17_touch_at_the_nodes() {
    for x in [0.224_157_522_702, 0.775_842_477_298] {
        assert!((hit::rigid(50.0, x) - hit::curve(50.0, &[x], 1)[0]).abs() < 1e-12);
    }
    for x in [0.132_107_955_163, 0.5, 0.867_892_044_837] {
        let (one, two) = (hit::curve(50.0, &[x], 1), hit::curve(50.0, &[x], 2));
        assert!((one[0] - two[0]).abs() < 1e-12, "{x}");
    }
}

#[test]
fn every_figure_is_written_under_its_own_name() {
    let tables: Vec<_> = vibration::all().into_iter().chain(hit::all()).collect();
    for table in &tables {
        assert!(tables.iter().filter(|other| other.name == table.name).count() == 1);
        let csv = table.csv();
        assert_eq!(csv.lines().count(), table.rows.len() + 1);
        assert!(!csv.contains("NaN"));
    }
    assert_eq!(tables.len(), 20);
}
