//! Pictures of the verbs for makers of bats: each is legible and shows the results.
#![cfg(feature = "png")]

use crate::pictures::{check, number, texts};
use resvg::usvg::roxmltree::Document;
use sweetspot::Bat;
use sweetspot::bat::turned::DiameterChange;
use sweetspot_proof::bundled::bundled_bat;
use sweetspot_report::many::summary::sorted;
use sweetspot_report::many::table::NumberColumn;
use sweetspot_report::plot::sheet::{Paper, Sheet};
use sweetspot_report::plot::{calibrate, change, many};
use sweetspot_report::template::pages::pages;
use sweetspot_report::template::sheet::{Drawn, PAPERS};
use sweetspot_study::calibrate::calibration::{Calibration, CalibrationPlan};
use sweetspot_study::files::readings_file::ReadingsForm;
use sweetspot_study::files::written::WrittenFile;
use sweetspot_study::many::indices::{Indices, VariateKind};
use sweetspot_study::many::sobol::Sobol;

fn bat(name: &str) -> Bat {
    bundled_bat(&format!("meshes/{name}.json")).unwrap()
}

#[test]
fn a_change_of_the_diameter_is_whole_in_every_form() {
    for name in ["r161", "house", "tanh"] {
        let old = bat(name);
        let change = DiameterChange::through(&[0.5, 0.6, 0.7], |x| -0.01 * (x - 0.5) * (0.7 - x));
        let new = old.turned(&change).unwrap();
        for (us, paper) in [(false, Paper::File), (true, Paper::Page), (true, Paper::Narrow)] {
            let sheet = Sheet { us, paper };
            let picture = change::picture(sheet, &old, &new);
            check(&picture, name);
            assert_eq!(picture.drawing.width, sheet.width());
            // At most a tenth of a millimetre is removed, at x = 0.6 m.
            let off = if us { "3.94 mil at most off" } else { "0.10 mm at most off" };
            assert!(picture.svg.contains(off), "{}", &picture.svg[..800]);
        }
        // Two equal bats give a line of zeros.
        check(&change::picture(Sheet::file(false), &old, &old), name);
    }
}

#[test]
fn what_readings_say_of_the_wood_is_drawn_whole() {
    let reading = |lines: &str| {
        let text = format!(
            r#"{{ "format": "sweetspot-readings/1", "mass": "0.869 kg", "balance_point": "56.1 cm",
                "pendulum": {{ "pivot": "6 in", "period": "1.470 s" }}, "lines": [{lines}] }}"#
        );
        ReadingsForm::from_text("readings.json", &text, "".as_ref()).unwrap()
    };
    let few = reading(r#"{ "hz": 174.5, "mode": 1 }"#);
    // The second matches none of its modes.
    let wrong = reading(
        r#"{ "hz": 174.5, "mode": 1 }, { "hz": 540, "mode": 2 }, { "hz": 1187, "mode": 3 }"#,
    );
    for (split, readings) in [(None, few), (Some(0.42), wrong)] {
        let plan = CalibrationPlan { split, held: vec![] };
        let found = Calibration::new(&bat("r161"), readings, &plan).unwrap();
        let all = calibrate::pictures("R161", &found);
        assert_eq!(all.iter().map(|one| &*one.name).collect::<Vec<_>>(), ["wood", "readings"]);
        all.iter().for_each(|picture| check(picture, "R161"));
        // A circle for every reading.
        let document = Document::parse(&all[1].svg).unwrap();
        let small = |node: &resvg::usvg::roxmltree::Node| number(*node, "r") == 4.0;
        let circles = document.descendants().filter(|node| node.has_tag_name("circle"));
        assert_eq!(circles.filter(small).count(), found.data.len());
    }
}

#[test]
fn spreads_of_many_bats_are_drawn_whole() {
    let sobol = Sobol::new(3, 1);
    let row = |k: u64| [0, 1, 2].map(|c| sobol.at(k, c));
    let rows: Vec<[f64; 3]> = (0..512).map(row).collect();
    let answer = |x: &[f64; 3]| 170.0 + 20.0 * x[0] + 5.0 * x[1] * x[1];
    let column = |name: &str, of: &dyn Fn(&[f64; 3]) -> f64| NumberColumn {
        name: name.to_owned(),
        unit: "Hz".to_owned(),
        values: rows.iter().map(of).collect(),
    };
    let (f1, f2) = (column("f1_hz", &answer), column("f2_hz", &|x| 3.0 * answer(x) + x[2]));
    let of_rows: Vec<(Vec<f64>, f64)> = rows.iter().map(|x| (x.to_vec(), answer(x))).collect();
    let indices = Indices::new(&[VariateKind::Share; 3], &of_rows).unwrap();
    let names = ["youngs_modulus given density", "density", "turning"].map(str::to_owned);
    let all = [
        many::histogram(&f1, &sorted(&f1), [171.0, 181.0, 193.0]).unwrap(),
        many::tornado("f1_hz", &names, &indices),
        many::scatter(&f1, &f2).unwrap(),
    ];
    let wanted = ["histogram_f1_hz", "tornado_f1_hz", "scatter_f1_hz_f2_hz"];
    assert_eq!(all.iter().map(|one| &*one.name).collect::<Vec<_>>(), wanted);
    for picture in &all[..2] {
        check(picture, "many");
    }
    // A constant column has no histogram.
    let level = NumberColumn { values: vec![1.0; 512], ..f1.clone() };
    assert!(many::histogram(&level, &sorted(&level), [1.0; 3]).is_none());
    // The largest share comes first.
    let document = Document::parse(&all[1].svg).unwrap();
    let words: Vec<&str> = texts(&document).into_iter().map(|(words, _)| words).collect();
    // A polynomial reproduces this one, except for round-off.
    assert!(words.iter().any(|word| word.ends_with("; 0.00 not followed")), "{words:?}");
    let place = |name: &str| words.iter().position(|word| *word == name).unwrap();
    assert!(place(&names[0]) < place(&names[1]) && place(&names[1]) < place(&names[2]));
}

/// Printers leave some 5 mm of a sheet white.
#[test]
fn all_words_of_a_template_are_on_what_printers_print() {
    const WHITE: f64 = 5.0;
    for name in ["r161", "house", "northwestern_wood"] {
        let bat = bat(name);
        for paper in PAPERS {
            for page in pages(&bat, &bat, paper) {
                for drawn in &page.drawn {
                    let Drawn::Words { at: [x, y], size, text } = drawn else { continue };
                    // A digit of Helvetica is 0.556 of its size wide, and a letter hardly more.
                    let right = x + 0.556 * size * text.chars().count() as f64;
                    let inside = *x >= WHITE && right <= paper.width - WHITE;
                    let tall = *y - size >= WHITE && *y <= paper.height - WHITE;
                    assert!(inside && tall, "{name} {}: {text:?} {x} to {right}", paper.name);
                }
            }
        }
    }
}
