//! Measured modes compared with computed ones, for known measurements: the closed form of the dowel, scaled, rotated,
//! shifted, and with known faults.

use crate::common;

use std::f64::consts::TAU;

use common::diagnostic::in_lines;
use common::folder::Folder;
use common::{DENSITY, LENGTH, MODULUS, RADIUS, dowel, dowel_frequency};
use faer::c64;
use serde_json::Value;
use sweetspot::Bat;
use sweetspot::bat::fixtures::{Fixtures, Held, Support};
use sweetspot::bat::material::Material;
use sweetspot::beam::dowel::{Dowel, Ends, UniformMode};
use sweetspot::modes::solve::Request;
use sweetspot_report::parts::units::Units;
use sweetspot_report::report::measured;
use sweetspot_study::files::measured::{table, universal};
use sweetspot_study::measured::data::{Measured, MeasuredMode};
use sweetspot_study::measured::place::{End, ToldPoints};
use sweetspot_study::measured::study::Study;
use sweetspot_study::measured::words::words;
use uff58::{Analysis, Dataset, NodalData, Node, Nodes, Universal, parse};

/// Even points from end to end.
fn points(count: usize) -> Vec<f64> {
    (0..count).map(|k| LENGTH * k as f64 / (count - 1) as f64).collect()
}

/// The exact shape of mode n, `∫W² dX = 1`, at those places.
fn exact(ends: Ends, n: usize, x: &[f64]) -> Vec<c64> {
    let mode = UniformMode::new(ends, n);
    x.iter().map(|x| c64::new(mode.deflection(x / LENGTH), 0.0)).collect()
}

fn mode(name: &str, frequency: f64, shape: Vec<c64>) -> MeasuredMode {
    MeasuredMode { name: name.into(), order: None, frequency, damping_ratio: None, shape }
}

/// The first modes of the free dowel at those places, each through `change`.
fn free(count: usize, x: &[f64], change: impl Fn(usize, usize, c64) -> c64) -> Measured {
    let changed = |n: usize| {
        let shape = exact(Ends::FreeFree, n, x).into_iter().enumerate();
        shape.map(|(k, v)| change(n, k, v)).collect()
    };
    let one = |n: usize| mode(&format!("m{n}"), dowel_frequency(n), changed(n));
    let modes = (1..=count).map(one).collect();
    Measured { modes, along: x.to_vec(), from_knob: true, ..Measured::default() }
}

fn study(bat: &Bat, measured: Measured, told: ToldPoints) -> Study {
    let request = Request { tolerance: 1e-9, ..Request::plain() };
    Study::new(bat, measured.sorted(), &request, false, told).unwrap()
}

/// Numbers from −1 to 1 without order, the same every time.
fn noise(n: usize, k: usize) -> f64 {
    let bits = (n as u64 * 1000 + k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let bits = (bits ^ (bits >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((bits >> 11) as f64 / (1u64 << 52) as f64) - 1.0
}

#[test]
fn exact_shapes_are_paired_whatever_their_order_scale_and_sign() {
    let x = points(12);
    let factor = |n: usize| if n.is_multiple_of(2) { -2.5e-3 } else { 40.0 };
    let mut measured = free(5, &x, |n, _, v| v * factor(n));
    measured.modes.reverse();
    // The points in another order, their values with them.
    measured.along.swap(2, 9);
    measured.modes.iter_mut().for_each(|mode| mode.shape.swap(2, 9));
    let study = study(&dowel(), measured, ToldPoints::default());
    assert_eq!(study.pairs.len(), 5);
    for (k, pair) in study.pairs.iter().enumerate() {
        assert_eq!((pair.measured, pair.computed), (k, k));
        assert!(1.0 - pair.mac.unwrap() < 1e-12);
        assert!(pair.difference.unwrap().abs() < 3.0 * pair.within + 1e-15);
        // The closed form moves by 2 at its ends, the computed shape by 1.
        let (scale, known) = (pair.scale.unwrap(), 2.0 * factor(k + 1));
        assert!((scale.norm() / known.abs() - 1.0).abs() < 1e-6 && scale.im == 0.0);
        assert_eq!(study.name(k), format!("m{}", k + 1));
    }
    assert!(study.lone_measured.is_empty() && study.lone_computed.is_empty());
    let said = words(&study).join(" ");
    assert!(said.contains("sound in this") && said.contains("are the measured ones"), "{said}");
}

#[test]
fn one_per_cent_of_noise_leaves_the_pairs_alone() {
    let x = points(12);
    let study =
        study(&dowel(), free(5, &x, |n, k, v| v + 0.02 * noise(n, k)), ToldPoints::default());
    for (k, pair) in study.pairs.iter().enumerate() {
        assert_eq!((pair.measured, pair.computed), (k, k));
        // Σ noise² / Σ W² is 4e-4/3 over about 1.3.
        let mac = pair.mac.unwrap();
        assert!(mac > 0.9996 && mac < 1.0 - 1e-6, "{mac}");
    }
    let rigid = study.shapes.unwrap().rigid_share.unwrap();
    assert!(rigid.iter().all(|share| *share < 0.03), "{rigid:?}");
}

#[test]
fn a_phase_of_the_whole_shape_changes_nothing_and_a_part_out_of_phase_is_measured() {
    let (x, phase) = (points(30), c64::from_polar(3.0, 0.7));
    let alone = study(&dowel(), free(3, &x, |_, _, v| v * phase), ToldPoints::default());
    let shapes = alone.shapes.as_ref().unwrap();
    for (k, pair) in alone.pairs.iter().enumerate() {
        assert!(1.0 - pair.mac.unwrap() < 1e-12 && shapes.out_of_phase[k] < 1e-12);
        let sign = if pair.scale.unwrap().re < 0.0 { -1.0 } else { 1.0 };
        assert!((pair.scale.unwrap().arg() - (sign * phase).arg()).abs() < 1e-9);
    }
    // A tenth of another shape, delayed by a quarter period.
    let other = exact(Ends::FreeFree, 5, &x);
    let whirling = free(3, &x, |_, k, v| (v + c64::new(0.0, 0.1) * other[k]) * phase);
    let study = study(&dowel(), whirling, ToldPoints::default());
    let shapes = study.shapes.unwrap();
    for (n, share) in shapes.out_of_phase.iter().enumerate() {
        let size = |v: &[c64]| v.iter().map(|v| v.norm_sqr()).sum::<f64>();
        let (own, late) = (size(&exact(Ends::FreeFree, n + 1, &x)), 0.01 * size(&other));
        // At the points the two shapes are slightly similar, and the sum is in phase with neither.
        assert!((share / (late / (own + late)) - 1.0).abs() < 0.1, "{share}");
    }
}

#[test]
fn rigid_motion_in_a_shape_is_found_as_large_as_it_is() {
    let x = points(60);
    // ∫W² dX = 1: a shift by a has a² of the mass, a turn by b (X − ½) has b²/12.
    for (a, b) in [(0.2, 0.0), (0.0, 0.9), (0.1, -0.4)] {
        let shifted = free(4, &x, |_, k, v| v + a + b * (x[k] / LENGTH - 0.5));
        let study = study(&dowel(), shifted, ToldPoints::default());
        let shapes = study.shapes.as_ref().unwrap();
        let rigid: f64 = a * a + b * b / 12.0;
        let known = (rigid / (1.0 + rigid)).sqrt();
        for share in shapes.rigid_share.as_ref().unwrap() {
            assert!((share / known - 1.0).abs() < 2e-3, "{share} {known}");
        }
        for share in shapes.sampled_rigid_share.as_ref().unwrap() {
            assert!(share.unwrap() < 1e-3);
        }
        assert!(words(&study).iter().any(|line| line.contains("carry rigid motion")));
    }
}

/// The remainder is the error of the spline between the points, which falls as the fourth power.
#[test]
fn exact_shapes_have_nothing_in_common_but_what_the_points_cost() {
    let worst = |count: usize| {
        let study = study(&dowel(), free(4, &points(count), |_, _, v| v), ToldPoints::default());
        let shapes = study.shapes.unwrap();
        let mut worst: f64 = 0.0;
        let common = shapes.common.unwrap();
        for (i, (row, sampled)) in common.iter().zip(&shapes.sampled_common).enumerate() {
            assert!((row[i] - 1.0).abs() < 1e-14);
            for (j, (value, sampled)) in
                row.iter().zip(sampled).enumerate().filter(|(j, _)| *j != i)
            {
                assert!((value - sampled.unwrap()).abs() < 1e-6, "{i} {j}");
                worst = worst.max(*value);
            }
        }
        worst
    };
    let [coarse, fine] = [worst(20), worst(39)];
    assert!(coarse < 3e-3 && coarse / fine > 8.0, "{coarse:e} {fine:e}");
}

#[test]
fn slow_straight_motions_are_rigid_and_crooked_ones_are_told() {
    let x = points(12);
    let mut measured = free(3, &x, |_, _, v| v);
    let line = |a: f64, b: f64| x.iter().map(|x| c64::new(a + b * x, 0.0)).collect::<Vec<_>>();
    measured.modes.push(mode("bounce", 2.0, line(1.0, 0.1)));
    measured.modes.push(mode("pitch", 3.5, line(-0.4, 1.0)));
    let mut crooked = line(1.0, 0.0);
    crooked[4] = c64::new(2.0, 0.0);
    measured.modes.push(mode("crooked", 4.0, crooked));
    let study = study(&dowel(), measured, ToldPoints::default());
    assert_eq!(study.rigid.len(), 3);
    let [bounce, pitch, crooked] = [0, 1, 2].map(|k| study.rigid[k].bent);
    assert!(bounce < 1e-14 && pitch < 1e-14);
    // One point of twelve is off by 1; the mean has 1/12 of its square, the slope 1.5²/143.
    let left = 1.0 - 1.0 / 12.0 - 1.5 * 1.5 / 143.0;
    assert!((crooked - f64::sqrt(left / 15.0)).abs() < 1e-12, "{crooked}");
    assert_eq!(study.pairs.iter().map(|p| p.computed).collect::<Vec<_>>(), [0, 1, 2]);
    let said = words(&study).join(" ");
    assert!(said.contains("crooked by 25 %") && !said.contains("bounce"), "{said}");
}

/// The ends of a clamped dowel can be distinguished.
#[test]
fn the_end_that_comes_first_is_found_and_so_is_the_origin() {
    let fixtures =
        Fixtures { supports: vec![Support { x: 0.0, kind: Held::Clamped }], ..Fixtures::default() };
    let material = Material::new(DENSITY, MODULUS).unwrap();
    let profile = dowel().profile().clone();
    let bat = Bat::builder(profile, material).name("held").fixtures(fixtures).build().unwrap();
    let form = Dowel { length: LENGTH, radius: RADIUS, youngs_modulus: MODULUS, density: DENSITY };
    // Twelve points from 5 cm to the tip.
    let x: Vec<f64> = (0..12).map(|k| 0.05 + (LENGTH - 0.05) * f64::from(k) / 11.0).collect();
    let modes = |x: &[f64]| -> Vec<MeasuredMode> {
        let shape = |n: usize| exact(Ends::ClampedFree, n, x);
        let one = |n: usize| mode(&n.to_string(), form.frequency(Ends::ClampedFree, n), shape(n));
        (1..=4).map(one).collect()
    };
    let from_tip: Vec<f64> = x.iter().map(|x| LENGTH - x).collect();
    let far: Vec<f64> = from_tip.iter().map(|x| x + 7.0).collect();
    let told = ToldPoints { origin: Some(LENGTH), ..ToldPoints::default() };
    for (along, told, first) in [
        (&x, ToldPoints::default(), End::Knob),
        (&from_tip, ToldPoints::default(), End::Tip),
        (&far, told, End::Tip),
    ] {
        let measured = Measured { modes: modes(&x), along: along.clone(), ..Measured::default() };
        let study = study(&bat, measured, told);
        let shapes = study.shapes.as_ref().unwrap();
        assert_eq!(shapes.placed.first, first);
        for (placed, x) in shapes.placed.x.iter().zip(&x) {
            assert!((placed - x).abs() < 1e-12, "{placed} {x}");
        }
        assert!(
            study.pairs.iter().all(|p| p.measured == p.computed && p.mac.unwrap() > 1.0 - 1e-9)
        );
        // Its supports push it.
        assert!(shapes.rigid_share.is_none());
    }
    // Wrong information is used as given, with a remark.
    let measured =
        Measured { modes: modes(&x), along: from_tip, from_knob: true, ..Measured::default() };
    let wrong = study(&bat, measured, ToldPoints::default());
    assert!(wrong.shapes.as_ref().unwrap().placed.turned_fits_better);
    assert!(words(&wrong).iter().any(|line| line.starts_with("Turned end for end")));
}

#[test]
fn a_symmetric_bat_fits_both_ways_and_that_is_said() {
    let along: Vec<f64> = points(12).iter().map(|x| 0.9 * x - 3.0).collect();
    let inside: Vec<f64> = points(12).iter().map(|x| 0.05 * LENGTH + 0.9 * x).collect();
    let measured = Measured { along, from_knob: false, ..free(3, &inside, |_, _, v| v) };
    let study = study(&dowel(), measured, ToldPoints::default());
    let placed = study.shapes.unwrap().placed;
    assert!(placed.x.iter().zip(&inside).all(|(a, b)| (a - b).abs() < 1e-12));
    let said = placed.assumed.join(" ");
    assert!(said.contains("in its middle") && said.contains("both ways fit alike"), "{said}");
}

#[test]
fn a_mode_that_was_missed_and_one_measured_twice_stay_alone() {
    let x = points(12);
    let mut measured = free(4, &x, |_, _, v| v);
    measured.modes[1] =
        mode("m1 again", 1.01 * dowel_frequency(1), measured.modes[0].shape.clone());
    let study = study(&dowel(), measured, ToldPoints::default());
    let names: Vec<&str> = study.lone_measured.iter().map(|k| study.name(*k)).collect();
    assert_eq!(names, ["m1 again"]);
    assert_eq!(study.lone_computed, [1]);
    // It is similar to mode 1, which has its partner, and this similarity is not a fault.
    let text = measured::text(&dowel(), &study, Units::Si, true);
    assert!(text.contains("like mode 1, but m1 is more so"), "{text}");
    let said = words(&study).join(" ");
    assert!(said.contains("sound in this") && !said.contains("m1 again"), "{said}");
}

/// Without a computed partner the effect of the points on a shape is unknown.
#[test]
fn exact_shapes_of_modes_that_were_not_computed_are_no_fault() {
    let request = Request { modes: 2, tolerance: 1e-9, ..Request::plain() };
    let measured = free(4, &points(5), |_, _, v| v).sorted();
    let study = Study::new(&dowel(), measured, &request, true, ToldPoints::default()).unwrap();
    let shapes = study.shapes.as_ref().unwrap();
    assert_eq!(study.pairs.len(), 2);
    // The spline through five points adds rigid motion that the exact shapes do not have.
    assert!(shapes.rigid_share.as_ref().unwrap().iter().any(|share| *share > 0.1));
    let said = words(&study).join(" ");
    assert!(!said.contains("rigid motion") && !said.contains("are off"), "{said}");
}

/// A shape at a third of the frequency, however similar, belongs to another mode or is a mistake.
#[test]
fn modes_more_than_an_octave_apart_are_not_paired() {
    let x = points(12);
    let mut measured = free(1, &x, |_, _, v| v);
    measured.modes.push(mode("far", 0.3 * dowel_frequency(4), exact(Ends::FreeFree, 4, &x)));
    let study = study(&dowel(), measured, ToldPoints::default());
    assert_eq!(study.pairs.len(), 1);
    let text = measured::text(&dowel(), &study, Units::Si, true);
    assert!(text.contains("like no computed mode within an octave"), "{text}");
}

/// Correct shapes are distinguished from wrong ones, and both from an insufficient number of points.
#[test]
fn what_shapes_have_in_common_is_judged_by_what_the_points_do() {
    let verdict = |measured: Measured| {
        let study = study(&dowel(), measured, ToldPoints::default());
        let said = words(&study);
        said.iter().find(|line| line.contains("orthogonal in the bat's mass")).unwrap().clone()
    };
    let right = verdict(free(4, &points(20), |_, _, v| v));
    assert!(right.ends_with("they are sound in this."), "{right}");
    // At four points even the exact shapes have much in common, the computed ones as much.
    let few = verdict(free(3, &points(4), |_, _, v| v));
    assert!(few.ends_with("with so few points that proves nothing."), "{few}");
    // Three tenths of another mode: 0.3/√1.09 in common with it.
    let x = points(20);
    let first = exact(Ends::FreeFree, 1, &x);
    let wrong = verdict(free(3, &x, |n, k, v| if n == 2 { v + 0.3 * first[k] } else { v }));
    assert!(
        wrong.contains("m1 and m2 are the least orthogonal in the bat's mass, 0.287"),
        "{wrong}"
    );
    assert!(wrong.ends_with("the shapes, or the masses in the bat file, are off."), "{wrong}");
}

/// A bat of two materials with a weight beyond its tip: its modes have no rigid motion, and the apparent one due to the
/// points decreases with the distance between points.
#[test]
fn the_modes_of_a_bat_with_regions_and_weights_carry_no_rigid_motion() {
    let folder = Folder::new("measured-own");
    let weight = r#"{ "x": "33 in", "mass": "4 oz", "offset": "2 in", "rotary_inertia": 2e-4 }"#;
    let region = r#"{ "from": 0, "to": "15 in", "material": "aluminium-7075" }"#;
    let more = format!(r#""attachments": [{weight}], "regions": [{region}], "profile""#);
    let slim = BAT.replace("0.0213, 0.0213", "0.0113, 0.0313").replace(r#""profile""#, &more);
    folder.write("bat.json", slim);
    let solve = ["bat.json", "--theory", "rayleigh", "--tol", "1e-6", "--quiet"];
    let shares = |points: &str| -> Vec<f64> {
        let modes = ["-n", "6", "--shape-points", points, "--json", "m.json"];
        folder.text(&[&["modes"], &solve[..], &modes].concat());
        folder.text(&["convert", "m.json", "--to", "uff"]);
        let args = [&["compare"], &solve[..], &["--measured", "m.uff", "--json", "-"]].concat();
        let json = folder.json(&args);
        let share = |mode: &Value| mode["rigid_share"].as_f64().unwrap();
        json["measured"].as_array().unwrap().iter().map(share).collect()
    };
    let [coarse, fine] = ["51", "101"].map(shares);
    assert_eq!(fine.len(), 6);
    for (coarse, fine) in coarse.iter().zip(&fine) {
        assert!(*fine < 0.01 && *fine < 0.55 * coarse, "{fine} {coarse}");
    }
}

/// The motion of an absorber is many times that of the bat beneath it, and no shape shows it.
#[test]
fn of_a_bat_with_an_absorber_rigid_motion_is_not_judged() {
    let folder = Folder::new("measured-absorber");
    let more =
        r#""absorbers": [ { "x": "10 in", "mass": "1 oz", "frequency": "250 Hz" } ], "profile""#;
    folder.write("bat.json", BAT.replace(r#""profile""#, more));
    let modes = ["-n", "4", "--shape-points", "101", "--json", "m.json"];
    folder.text(&[&["modes", "bat.json"], &modes[..]].concat());
    folder.text(&["convert", "m.json", "--to", "uff"]);
    let args = ["compare", "bat.json", "--measured", "m.uff"];
    let text = folder.text(&[&args[..], &["--plots", "p", "--full"]].concat());
    assert!(text.contains("an absorber moves more than the bat beneath it"), "{text}");
    assert!(
        !text.contains("carry rigid motion") && !text.contains("are the least orthogonal"),
        "{text}"
    );
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    assert!(!folder.0.join("p/mass_orthogonality.svg").exists());
    let json = folder.json(&[&args[..], &["--json", "-"]].concat());
    assert_eq!(json["pairs"].as_array().unwrap().len(), 4);
    assert!(json["shapes"]["common_in_mass"].is_null());
    assert!(json["measured"][0]["rigid_share"].is_null());
}

#[test]
fn a_bat_that_only_moves_on_its_supports_has_no_table_of_bending_shapes() {
    let folder = Folder::new("measured-rigid");
    folder.write("bat.json", BAT);
    folder.write("m.csv", "x_m,a,b\nfrequency_hz,2,3\n0,1,-1\n0.4,1,0\n0.8,1,1\n");
    let text =
        folder.text(&["compare", "bat.json", "--measured", "m.csv", "--plots", "p", "--quiet"]);
    assert_eq!(text.matches("rigid on its supports, 0.0 % off a straight line").count(), 2);
    assert!(!text.contains("\nShapes ") && !text.contains("MAC, computed"), "{text}");
}

/// The file of a laboratory may have any number of modes and points; a picture shows as many as paper allows.
#[test]
fn pictures_of_very_many_modes_and_points_are_no_larger_than_paper_needs() {
    let folder = Folder::new("measured-many");
    folder.write("bat.json", BAT);
    let table = |modes: usize, points: usize| {
        let row = |first: String, of: &dyn Fn(usize) -> f64| {
            (0..modes).fold(first, |line, k| format!("{line},{}", of(k))) + "\n"
        };
        let names = (0..modes).fold("x_m".to_owned(), |line, k| format!("{line},m{k}")) + "\n";
        let frequencies = row("frequency_hz".into(), &|k| 100.0 + k as f64);
        let at = |i: usize| 0.8 * i as f64 / (points - 1) as f64;
        let rows = (0..points).map(|i| row(at(i).to_string(), &|k| ((i * (k + 3)) as f64).cos()));
        names + &frequencies + &rows.collect::<String>()
    };
    for (modes, points) in [(300, 5), (2, 20_000)] {
        folder.write("m.csv", table(modes, points));
        let drawn = format!("p{modes}");
        folder.text(&["compare", "bat.json", "--measured", "m.csv", "--plots", &drawn]);
        for name in folder.read_names(&drawn) {
            let size = std::fs::metadata(folder.0.join(&drawn).join(&name)).unwrap().len();
            assert!(size < 3_000_000, "{modes} {points} {name} {size}");
        }
    }
}

/// Millimetres read as metres, and an origin for which the points do not fit on the bat in any way.
#[test]
fn points_that_are_not_on_the_bat_are_told_by_numbers_that_were_given() {
    let wrong = |along: &[f64], origin: Option<f64>| {
        let measured = Measured {
            source: "m.uff".into(),
            along: along.to_vec(),
            from_knob: false,
            ..free(2, &points(along.len()), |_, _, v| v)
        };
        let told = ToldPoints { origin, ..ToldPoints::default() };
        let request = Request { tolerance: 1e-3, ..Request::plain() };
        Study::new(&dowel(), measured, &request, false, told).unwrap_err().to_string()
    };
    assert_eq!(
        wrong(&[0.0, 420.0, 840.0], None),
        "m.uff: found 3 points that span 840 m, expected at most the bat's 0.8382 m: is the unit \
         right?"
    );
    assert_eq!(
        wrong(&[0.0, 4.2e-4, 8.4e-4], None),
        "m.uff: found 3 points that span 8.4e-4 m, expected at least a twentieth of the bat's 0.8382 m: is the \
         unit right?"
    );
    let error = wrong(&[0.0, 0.4, 0.8], Some(0.5));
    assert!(error.contains("found one at 0.9000 m from the knob end"), "{error}");
}

/// Modes 2, 3 and 4 of an R161 with the numbers 1, 2 and 3.
#[test]
fn numbers_that_do_not_fit_the_frequencies_are_doubted() {
    let folder = Folder::new("measured_numbers");
    let said = |table: &str| {
        folder.write("m.csv", table);
        let text = folder.text(&["compare", "r161", "--measured", "m.csv"]);
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let shifted = said("mode,frequency_hz\n1,581.3\n2,1187\n3,1854.8\n");
    assert!(shifted.contains("with every number one higher it would be 0 %"), "{shifted}");
    let missing = said("mode,frequency_hz\n1,174.5\n2,1187\n3,1854.8\n");
    assert!(missing.contains("a number may be wrong, or the bat is another one"), "{missing}");
    let right = said("mode,frequency_hz\n1,170.5\n2,581.3\n3,1187\n");
    assert!(!right.contains("paired by their numbers, and"), "{right}");
}

/// The shapes of the modes of a whip are not those of a bat, whatever their frequencies.
#[test]
fn shapes_that_are_like_no_mode_are_no_readings_of_the_wood() {
    let folder = Folder::new("measured_unlike");
    let x = points(12);
    let wild = |k: usize, n: usize| if (k * k * (n + 3)) % 7 < 3 { 1.0 } else { -1.0 };
    let mut table = String::from("x_m,a,b,c,d\nfrequency_hz,174.5,581.3,1187,1854.8\n");
    for (k, place) in x.iter().enumerate() {
        let values: Vec<String> = (0..4).map(|n| wild(k, n).to_string()).collect();
        table += &format!("{place},{}\n", values.join(","));
    }
    folder.write("m.csv", table);
    let found = folder.run(&["calibrate", "r161", "m.csv"]);
    let text =
        String::from_utf8_lossy(&found.stdout).split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(found.status.code(), Some(1), "{text}");
    assert!(text.contains("Half of what was measured or more is no bending mode"), "{text}");
}

#[test]
fn few_points_that_do_not_tell_modes_apart_are_told() {
    let few = study(&dowel(), free(4, &points(4), |_, _, v| v), ToldPoints::default());
    assert!(words(&few).iter().any(|line| line.starts_with("At these 4 points")));
    let enough = study(&dowel(), free(4, &points(12), |_, _, v| v), ToldPoints::default());
    assert!(!words(&enough).iter().any(|line| line.starts_with("At these")));
}

/// The exact modes as a table a person would type.
fn table(unit: f64, places: &[f64], shapes: &[f64]) -> String {
    let modes: Vec<usize> = (1..=3).collect();
    let line = |first: &str, cells: Vec<String>| format!("{first},{}\n", cells.join(","));
    let frequency = |n: &usize| format!("{}", 0.98 * dowel_frequency(*n));
    let mut text = line("frequency_hz", modes.iter().map(frequency).collect());
    text += &line("damping_percent", vec!["0.4".into(), String::new(), "0.6".into()]);
    for (place, x) in places.iter().zip(shapes) {
        let value = |n: &usize| exact(Ends::FreeFree, *n, &[*x])[0].re.to_string();
        text += &line(&(place / unit).to_string(), modes.iter().map(value).collect());
    }
    text
}

const BAT: &str = r#"{ "format": "sweetspot-bat/1", "name": "dowel", "material": {
    "density": 711, "youngs_modulus": 13.9e9 },
    "profile": { "interpolation": "linear", "x": [0, 0.8382], "radius": [0.0213, 0.0213] } }"#;

#[test]
fn a_table_of_shapes_goes_from_a_spreadsheet_to_a_table_and_to_json() {
    let folder = Folder::new("measured-csv");
    folder.write("bat.json", BAT);
    let x = points(12);
    folder.write("m.csv", format!("x_in,a,b,c\n{}# a remark\n,,,\n", table(0.0254, &x, &x)));
    let from_tip: Vec<f64> = x.iter().map(|x| LENGTH - x).collect();
    folder.write("tip.csv", format!("x_cm,a,b,c\n{}", table(0.01, &from_tip, &x)));
    let ask = ["compare", "bat.json", "--theory", "euler-bernoulli", "--measured"];
    for (file, more) in [("m.csv", None), ("tip.csv", Some("--tip-first"))] {
        let args: Vec<&str> = ask.into_iter().chain([file]).chain(more).collect();
        let json = folder.json(&[&args[..], &["--json", "-"]].concat());
        assert_eq!(json["format"], "sweetspot-measured/1");
        for (k, pair) in json["pairs"].as_array().unwrap().iter().enumerate() {
            assert_eq!(pair["computed"], k + 1);
            assert!(pair["mac"].as_f64().unwrap() > 1.0 - 1e-9);
            let off = pair["frequency_difference"].as_f64().unwrap();
            assert!((off - (1.0 / 0.98 - 1.0)).abs() < 1e-4);
        }
        let damping = |k: usize| &json["measured"][k]["damping_ratio"];
        assert_eq!((damping(0).as_f64(), damping(1).as_f64()), (Some(0.004), None));
        assert_eq!(json["shapes"]["mac"].as_array().unwrap().len(), 3);
        let text = folder.text(&[&args[..], &["--plots", "p"]].concat());
        for (name, told) in [
            ("mac", "computed mode"),
            ("mass_orthogonality", "measured below the diagonal"),
            ("measured_shapes", "MAC 1.000"),
        ] {
            let svg = folder.read(&format!("p/{name}.svg"));
            assert!(svg.starts_with("<svg") && svg.contains(told), "{name}");
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
        }
        assert!(text.lines().all(|line| line.chars().count() <= 80));
        assert!(text.contains("0.40 %") && text.contains("4.0 % softer"), "{text}");
    }
}

#[test]
fn frequencies_alone_are_paired_by_their_number() {
    let folder = Folder::new("measured-frequencies");
    folder.write("bat.json", BAT);
    folder.write("f.csv", "mode,frequency_khz,damping_ratio\n3,1.3,\n1,0.24,0.004\n");
    let args = ["compare", "bat.json", "--theory", "euler-bernoulli", "--measured", "f.csv"];
    let json = folder.json(&[&args[..], &["--json", "-"]].concat());
    for (pair, (order, frequency)) in
        json["pairs"].as_array().unwrap().iter().zip([(1, 240.0), (3, 1300.0)])
    {
        assert_eq!(pair["computed"], order);
        let off = dowel_frequency(order) / frequency - 1.0;
        assert!((pair["frequency_difference"].as_f64().unwrap() - off).abs() < 1e-4);
        assert!(pair["mac"].is_null());
    }
    assert_eq!(json["unpaired_computed"][0], 2);
    let text = folder.text(&args);
    assert!(text.contains("paired by their numbers") && !text.contains("MAC, computed"));
    // There are no shapes to draw.
    let output = folder.run(&[&args[..], &["--plots", "drawn"]].concat());
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && told.contains("no pictures were written"), "{told}");
    assert!(!folder.0.join("drawn").exists());
    folder.write("f.csv", "mode,frequency_hz\n1,240\n12,15000\n");
    let text = folder.text(&[&args[..], &["-n", "4"]].concat());
    assert!(text.contains("mode 12 was not computed"), "{text}");
}

#[test]
fn a_bad_table_is_refused_with_the_place() {
    let folder = Folder::new("measured-bad");
    folder.write("bat.json", BAT);
    let good = "x_m,a,b\nfrequency_hz,100,200\n0,1,1\n0.4,-1,0\n0.8,1,-1\n";
    let swap = |from: &str, to: &str| good.replacen(from, to, 1);
    let cases = [
        (String::new(), "m.csv:1:1: found no header"),
        (swap("x_m", "x"), "m.csv:1:1: found \"x\", expected its unit too"),
        (swap("x_m", "x_kg"), "m.csv:1:1: x_kg: found"),
        (swap("x_m", "y_m"), "m.csv:1:1: header: found column \"y_m\""),
        (swap("a,b", "a,a"), "m.csv:1:7: header: found \"a\", expected a name of its own"),
        (swap("x_m,a,b", "x_m"), "m.csv:2:1: found 3 cells in this row, expected 1"),
        (swap("frequency_hz,100,200\n", ""), "m.csv:1:1: found no frequencies"),
        (swap("100,200", "100,fast"), "m.csv:2:18: frequency_hz: found \"fast\""),
        (swap("100,200", "-1,200"), "m.csv:2:14: frequency_hz: found -1, expected 0.0 to"),
        (swap("0.4,-1,0", "0.4,-1"), "m.csv:4:1: found 2 cells in this row, expected 3"),
        (swap("0.4,-1,0", "0.4,-1,inf"), "m.csv:4:8: b: found \"inf\""),
        (swap("0.4,-1,0", "0.4,-1, "), "m.csv:4:9: b: found \"\""),
        (swap("0.4", "0.8"), "m.csv:5:1: x_m: found 0.8 a second time"),
        (swap("0.4,-1,0\n", ""), "m.csv:4:1: x_m: found 2 places, expected 3 at least"),
        (swap("0.4", "damped"), "m.csv:4:1: x_m: found \"damped\", expected a place"),
        (swap("0.4,-1,0", "damping_ratio,2,0"), "m.csv:4:15: a: found 2, expected 0.0 to 1.0"),
        (swap("0.4,-1,0", "damping,0,0"), "m.csv:4:1: found \"damping\", expected damping_ratio"),
        (swap("0.4,-1,0", "frequency_hz,1,2"), "m.csv:4:1: found frequency a second time"),
        (good.replace("1\n", "0\n").replace("1,-1", "1,0"), "b: found nothing but 0"),
        (
            swap("0.8", "1.8"),
            "m.csv: found 3 points that span 1.8 m, expected at most the bat's 0.8382 m",
        ),
        ("mode,hz\n1,100\n".into(), "m.csv:1:6: header: found column \"hz\""),
        ("mode,damping_ratio\n1,0.1\n".into(), "m.csv:1:1: header: found no frequency_hz"),
        ("mode,frequency_hz\n".into(), "m.csv:1:1: found no mode"),
        ("mode,frequency_hz\n1,100\n1,200\n".into(), "m.csv:3:1: mode: found 1 a second time"),
        ("mode,frequency_hz\nfirst,100\n".into(), "m.csv:2:1: mode: found \"first\""),
    ];
    for (text, told) in cases {
        folder.write("m.csv", &text);
        let output = folder.run(&["compare", "bat.json", "--measured", "m.csv"]);
        let error = in_lines(&output.stderr);
        assert!(error.contains(told), "{text}\n{error}");
        assert!(output.status.code() == Some(2) && output.stdout.is_empty());
    }
}

#[test]
fn options_that_would_do_nothing_are_refused() {
    let folder = Folder::new("measured-options");
    folder.write("bat.json", BAT);
    folder.write("f.csv", "frequency_hz\n240\n660\n");
    let measured = ["bat.json", "--measured", "f.csv"];
    let cases: [(&[&str], &str); 7] = [
        (&["--pitch", "80 mph"], "cannot be used with"),
        (&["--swing-speed", "40 rad/s"], "cannot be used with"),
        (&["--every", "2 in"], "cannot be used with"),
        (&["--csv", "out.csv"], "cannot be used with"),
        (&["bat.json"], "found 2 bats beside measured modes, expected one bat file"),
        (&["--tip-first"], "found frequencies alone"),
        (&["--tip-first", "--knob-first"], "cannot be used with"),
    ];
    for (more, told) in cases {
        let output = folder.run(&[&["compare"], &measured[..], more].concat());
        let error = in_lines(&output.stderr);
        assert!(output.status.code() == Some(2) && error.contains(told), "{more:?}: {error}");
    }
    let output = folder.run(&["compare", "bat.json", "bat.json", "--origin", "2 in"]);
    assert_eq!(output.status.code(), Some(2));
}

/// The exact free modes on nodes along any line, moving in any direction normal to it, `around` of
/// them side by side at every place.
fn universal_file(x: &[f64], [axis, normal]: [[f64; 3]; 2], around: usize) -> Universal {
    let along = |x: f64, off: f64| [0, 1, 2].map(|k| 2.0 + x * axis[k] + off * normal[k]);
    let label = |k: usize, turn: usize| (100 * turn + k + 1) as i64;
    let places = || (0..around).flat_map(|turn| (0..x.len()).map(move |k| (turn, k)));
    let node = |(turn, k)| Node::new(label(k, turn), along(x[k], 0.02 * turn as f64));
    let nodes = Nodes { nodes: places().map(node).collect(), legacy: false };
    let shape = |n: usize| {
        let w = exact(Ends::FreeFree, n, x);
        let value = |(turn, k): (usize, usize)| {
            let moved = normal.map(|part| [part * w[k].re * 0.1, 0.0]);
            (label(k, turn), moved.to_vec())
        };
        let omega = TAU * dowel_frequency(n);
        Dataset::NodalData(NodalData {
            ids: Default::default(),
            model: 1,
            analysis: match n {
                2 => Analysis::ComplexMode {
                    second_order: false,
                    load_case: 0,
                    mode: 2,
                    eigenvalue: [-0.01 * omega, (1.0 - 1e-4_f64).sqrt() * omega],
                    modal_a: [1.0, 0.0],
                    modal_b: [1.0, 0.0],
                },
                _ => Analysis::NormalMode {
                    load_case: 0,
                    mode: n as i64,
                    frequency: dowel_frequency(n),
                    modal_mass: 1.0,
                    viscous: if n == 1 { 0.004 } else { 0.0 },
                    hysteretic: if n == 3 { 0.01 } else { 0.0 },
                },
            },
            characteristic: NodalData::TRANSLATIONS,
            quantity: 12,
            complex: n == 2,
            per_node: 3,
            values: places().map(value).collect(),
        })
    };
    let datasets = [Dataset::Nodes(nodes)].into_iter().chain((1..=3).map(shape)).collect();
    Universal { datasets, lines: vec![], skipped: vec![], converted_from: None }
}

#[test]
fn a_universal_file_may_have_the_bat_in_any_direction() {
    let x = points(12);
    let slanted = [[0.6, 0.0, -0.8], [0.8, 0.0, 0.6]];
    let plain = [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
    for (directions, around, axis, moving) in [
        (plain, 1, "axis is z", "along y"),
        (slanted, 1, "axis is (-0.600, 0.000, 0.800)", "(0.800, 0.000, 0.600)"),
        (slanted, 3, "36 nodes are taken as 12 points", "(0.800, 0.000, 0.600)"),
    ] {
        let measured = universal::of(&universal_file(&x, directions, around), "m.uff").unwrap();
        let said = measured.assumed.join("; ");
        assert!(said.contains(axis) && said.contains(moving), "{said}");
        let ratios: Vec<_> =
            measured.modes.iter().map(|mode| mode.damping_ratio.unwrap()).collect();
        for (ratio, known) in ratios.iter().zip([0.004, 0.01, 0.005]) {
            assert!((ratio - known).abs() < 1e-12);
        }
        let study = study(&dowel(), measured, ToldPoints::default());
        for (k, pair) in study.pairs.iter().enumerate() {
            assert_eq!((pair.measured, pair.computed), (k, k));
            assert!(1.0 - pair.mac.unwrap() < 1e-9);
            assert!(pair.difference.unwrap().abs() < 1e-8);
            assert!((pair.scale.unwrap().norm() - 0.2).abs() < 1e-6);
        }
    }
}

/// The assumptions of a reader may be wrong, so they are stated.
#[test]
fn what_is_assumed_of_a_universal_file_is_said() {
    let x = points(12);
    let mut file = universal_file(&x, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 1);
    let plain = universal::of(&file, "m.uff").unwrap().assumed;
    assert_eq!(plain, ["the bat's axis is x", "deflections are those along y"]);
    for dataset in &mut file.datasets {
        match dataset {
            Dataset::Nodes(nodes) => {
                nodes.nodes.iter_mut().for_each(|node| node.at = node.at.map(|x| 1000.0 * x));
                nodes.nodes[4].systems = [3, 0];
            }
            Dataset::NodalData(data) if data.complex => data.values.truncate(6),
            _ => {}
        }
    }
    let mm = uff58::Units { length: 1000.0, description: "mm".into(), ..uff58::Units::si() };
    file.datasets.insert(0, Dataset::Units(mm));
    let text = uff58::write(&file.datasets).unwrap() + "    -1\n  2420\nany\n    -1\n";
    let measured = universal::of(&parse("m.uff", text.as_bytes()).unwrap(), "m.uff").unwrap();
    for said in [
        "dataset 2420 is left out",
        "the file's unit of length is 0.001 m, as its dataset 164 says",
        "the nodes' places are taken as in the file's global system",
        "mode_2 lists 6 of the 12 nodes that move, the others are taken at rest",
    ] {
        assert!(measured.assumed.iter().any(|line| line == said), "{:?}", measured.assumed);
    }
    assert!((measured.along[11] - measured.along[0] - LENGTH).abs() < 1e-12);
}

/// Modes that the program wrote as a universal file are its modes, to six digits.
#[test]
fn what_convert_writes_is_measured_as_the_same_bat() {
    let folder = Folder::new("measured-uff");
    folder.write(
        "r161.json",
        std::fs::read_to_string(concat!(env!("SWEETSPOT_TOP"), "/meshes/r161.json")).unwrap(),
    );
    let modes = ["modes", "r161.json", "-n", "5", "--shape-points", "25", "--json", "m.json"];
    let fine = ["--tol", "1e-8"];
    folder.text(&[&modes[..], &fine].concat());
    folder.text(&["convert", "m.json", "--to", "uff", "--out", "m.uff"]);
    let compared = ["compare", "r161.json", "--measured", "m.uff", "--json", "-"];
    let json = folder.json(&[&compared[..], &fine].concat());
    let pairs = json["pairs"].as_array().unwrap();
    assert_eq!(pairs.len(), 5);
    for (k, pair) in pairs.iter().enumerate() {
        assert_eq!(pair["computed"], k + 1);
        assert!(pair["mac"].as_f64().unwrap() > 1.0 - 1e-9);
        assert!(pair["frequency_difference"].as_f64().unwrap().abs() < 1e-5);
        assert!((pair["scale"]["real"].as_f64().unwrap() - 1.0).abs() < 1e-4);
    }
    assert_eq!(json["shapes"]["first_end"], "knob");
    let text = folder.text(&["compare", "r161.json", "--measured", "m.uff"]);
    assert!(text.lines().all(|line| line.chars().count() <= 80));
    // Reversed on request, it fits badly, and the output says so.
    let args = ["compare", "r161.json", "--measured", "m.uff", "--tip-first"];
    assert!(folder.text(&args).contains("Turned end for end the shapes fit better"));
}

#[test]
fn a_universal_file_without_what_is_needed_is_refused() {
    let x = points(5);
    let good = universal_file(&x, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 1);
    let said = |datasets: Vec<Dataset>| {
        let bad = Universal { datasets, ..good.clone() };
        universal::of(&bad, "m.uff").unwrap_err().to_string()
    };
    let changed = |change: &dyn Fn(&mut NodalData)| {
        let mut datasets = good.datasets.clone();
        if let Some(Dataset::NodalData(data)) = datasets.last_mut() {
            change(data);
        }
        said(datasets)
    };
    assert_eq!(said(vec![]), "m.uff: found no modes, expected shapes in datasets 55 or 2414");
    let text = b"    -1\n  2412\n    -1\n    -1\n  2420\n    -1\n    -1\n  2412\n    -1\n";
    let unread = universal::of(&parse("m.uff", text).unwrap(), "m.uff").unwrap_err().to_string();
    assert!(unread.contains("found no modes; datasets 2412, 2420 are not read"), "{unread}");
    assert!(said(good.datasets[1..].to_vec()).contains("found node 1 in a shape"));
    assert!(changed(&|data| data.values[0].0 = 77).contains("found node 77 in a shape"));
    assert!(changed(&|data| data.characteristic = 4).contains("characteristic 4"));
    assert!(changed(&|data| data.values.clear()).contains("every value 0"));
    let few = universal_file(&x[..2], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 1);
    let error = universal::of(&few, "m.uff").unwrap_err().to_string();
    assert!(error.contains("found 2 moving points"), "{error}");
    // Frequency responses alone: refused, with the advice what to do.
    let folder = Folder::new("measured-frf");
    folder.write("bat.json", BAT);
    let file =
        std::fs::read(concat!(env!("SWEETSPOT_TOP"), "/tests/foreign/functions.uff")).unwrap();
    folder.write("f.uff", &file);
    folder.write("broken.unv", &file[..400]);
    for (name, told) in [
        ("f.uff", "found 4 functions in datasets 58 and no shapes, expected shapes in datasets 55"),
        ("broken.unv", "broken.unv:"),
        ("bat.json", "expected a file whose name ends with .csv, .txt, .uff or .unv"),
    ] {
        let output = folder.run(&["compare", "bat.json", "--measured", name]);
        let error = in_lines(&output.stderr);
        assert!(output.status.code() == Some(2) && error.contains(told), "{error}");
    }
}

/// Every byte of a good table is removed once and changed once.
#[test]
fn a_spoiled_table_is_read_or_refused() {
    let folder = Folder::new("measured-spoiled");
    let good = "x_m,a,b\nfrequency_hz,100,200\ndamping_ratio,0.1,\n0,1,1\n0.4,-1,0\n0.8,1,-1e9\n";
    let path = folder.0.join("m.csv");
    let mut read = 0;
    for k in 0..good.len() {
        for byte in ["", "9", "e", "-", ",", "\n", "\"", "#", "ü"] {
            folder.write("m.csv", format!("{}{byte}{}", &good[..k], &good[k + 1..]));
            let Ok(measured) = table::read(&path) else { continue };
            // Frequencies off by orders of magnitude would need a hundred modes.
            if measured.modes.iter().any(|mode| mode.frequency > 5e3) {
                continue;
            }
            read += 1;
            let request = Request { tolerance: 1e-3, ..Request::plain() };
            let Ok(study) = Study::new(&dowel(), measured, &request, false, ToldPoints::default())
            else {
                continue;
            };
            let text = format!("{:?}{:?}", study.pairs, words(&study));
            assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        }
    }
    assert!(read > 50, "{read}");
}

/// Four modes of the R161, as modal programs and spreadsheets of several countries write them.
#[test]
fn a_table_is_read_as_programs_and_spreadsheets_write_it() {
    let folder = Folder::new("measured-sheets");
    let plain = "mode,frequency_hz,damping_percent\n1,174.51,0.60\n2,581.26,0.70\n3,1187.04,0.90\n\
                 4,1854.83,1.10\n";
    let comma = plain.replace(',', ";").replace('.', ",");
    let wide = |text: &str, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
        "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(bytes).collect()
    };
    let heads = "Mode No.;Frequency [Hz];Damping Ratio (%)";
    let cases: Vec<(&str, Vec<u8>)> = vec![
        ("plain.csv", plain.into()),
        (
            "pulse.csv",
            plain
                .replacen("mode,frequency_hz,damping_percent", "Mode,Frequency (Hz),Damping (%)", 1)
                .into(),
        ),
        ("capitals.CSV", plain.replacen("mode,frequency_hz", "MODE,FREQUENCY_HZ", 1).into()),
        ("comma.csv", comma.clone().into()),
        ("heads.csv", comma.replacen("mode;frequency_hz;damping_percent", heads, 1).into()),
        (
            "thousands.csv",
            comma.replace("1187,04", "1.187,04").replace("1854,83", "1 854,83").into(),
        ),
        ("sep.csv", format!("sep=;\r\n{}", comma.replace('\n', "\r\n")).into()),
        ("tabs.txt", plain.replace(',', "\t").into()),
        ("comma.tsv", comma.replace(';', "\t").into()),
        (
            "quoted.csv",
            comma
                .replace(';', "\";\"")
                .replace('\n', "\"\n\"")
                .replacen("mode", "\"mode", 1)
                .trim_end_matches('"')
                .into(),
        ),
        (
            "quoted_comma.csv",
            plain
                .replace("174.51", "\"174,51\"")
                .replace("581.26", "\"581,26\"")
                .replace("1187.04", "\"1187,04\"")
                .replace("1854.83", "\"1854,83\"")
                .replace("0.", "0")
                .replace("1.10", "1")
                .into(),
        ),
        ("trailing.csv", (plain.replace('\n', ",,\n") + ",,,,\n,,,,\n").into()),
        ("mark.csv", format!("\u{feff}{plain}").into()),
        ("carriage.csv", plain.replace('\n', "\r").into()),
        ("little.csv", wide(&comma, u16::to_le_bytes)),
        ("big.csv", wide(&comma, u16::to_be_bytes)),
        ("percent.csv", comma.replace("0,60", "0,60 %").into()),
        ("slash.csv", plain.replacen("frequency_hz", "Freq / Hz", 1).into()),
        (
            "khz.csv",
            plain
                .replacen("frequency_hz", "Frequency (kHz)", 1)
                .replace("174.51", "0.17451")
                .replace("581.26", "0.58126")
                .replace("1187.04", "1.18704")
                .replace("1854.83", "1.85483")
                .into(),
        ),
    ];
    for (name, bytes) in cases {
        folder.write(name, bytes);
        let json = folder.json(&["compare", "r161", "--measured", name, "--json", "-"]);
        assert_eq!(json["pairs"].as_array().unwrap().len(), 4, "{name}");
        for (k, hz) in [174.51, 581.26, 1187.04, 1854.83].into_iter().enumerate() {
            let measured = json["measured"][k]["frequency_hz"].as_f64().unwrap();
            assert!((measured - hz).abs() < 1e-9 * hz, "{name}: {measured}");
        }
    }
}
