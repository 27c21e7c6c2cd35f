//! Pictures of bats side by side, and of a bat compared with its measurement.
#![cfg(feature = "png")]

use crate::common;

use crate::pictures::{check, number, scale, texts, ticks};
use common::folder::Folder;
use resvg::usvg::roxmltree::Document;
use sweetspot::bat::profile::Interpolation;
use sweetspot::collision::hit::{Impact, Model, Scene};
use sweetspot::collision::sweet_spot::FINE;
use sweetspot::{Bat, Request, solve};
use sweetspot_proof::bundled::bundled_bat;
use sweetspot_report::plot::picture::Picture;
use sweetspot_report::plot::sheet::Sheet;
use sweetspot_report::plot::{self, compared};
use sweetspot_study::comparison::contender::{Contender, Terms};
use sweetspot_study::comparison::table::{Comparison, Entry};
use sweetspot_study::files::measured;
use sweetspot_study::measured::place::{End, ToldPoints};
use sweetspot_study::measured::study::Study;

fn bat(name: &str) -> Bat {
    bundled_bat(&format!("meshes/{name}.json")).unwrap()
}

/// A bat of that length (m) that widens evenly.
fn even(length: f64) -> Bat {
    common::bat(&[0.0, length], &[0.02, 0.06], &[0.0; 2], Interpolation::Linear)
}

/// Bats side by side, with that number of modes each.
fn side_by_side(bats: &[Bat], model: Model) -> Comparison {
    let request = Request { modes: 6, ..Request::plain() };
    let entry = |bat: &Bat| Entry { bat: bat.clone(), scene: Scene::default(), law: None, request };
    let terms = Terms { model, exactly: false, every: 0.0254, look: FINE, barrel: None };
    Comparison::new(bats.iter().map(entry).collect(), terms).unwrap()
}

#[test]
fn compared_bats_have_the_same_pictures_as_one() {
    let r161 = bat("r161");
    let long = even(3.0);
    let six = ["r161", "torpedo", "house", "cone", "two_piece", "northwestern_aluminium"].map(bat);
    let along = ["sweet_spot", "profile", "shapes", "exit_speed"];
    let hit = ["contact", "hysteresis", "hands"];
    for (bats, model, has_force) in [
        (vec![r161.clone(), bat("torpedo")], Model::Contact, true),
        (vec![r161.clone(), long.clone()], Model::Contact, true),
        (vec![long, r161.clone()], Model::Contact, true),
        (six.to_vec(), Model::Contact, true),
        (vec![r161, bat("cone")], Model::Rigid, false),
    ] {
        let all = compared::pictures(Sheet::file(false), &side_by_side(&bats, model)).unwrap();
        let ledgers = ('A'..).take(bats.len()).map(|letter| format!("ledger_{letter}"));
        let mut wanted: Vec<String> = along.map(str::to_owned).into_iter().chain(ledgers).collect();
        wanted.extend(hit.into_iter().filter(|_| has_force).map(str::to_owned));
        wanted.push("difference".into());
        assert_eq!(all.iter().map(|p| p.name.clone()).collect::<Vec<_>>(), wanted);
        for picture in &all {
            check(picture, &format!("{} compared", bats.len()));
            let document = Document::parse(&picture.svg).unwrap();
            let whole = |name: &str| texts(&document).iter().any(|(words, _)| words.contains(name));
            let told =
                (0..bats.len()).filter(|k| whole(&format!("{}: ", char::from(b'A' + *k as u8))));
            let one = picture.name.starts_with("ledger");
            assert_eq!(told.count(), if one { 1 } else { bats.len() }, "{}", picture.name);
        }
    }
}

/// Counted from the tip, there is no place beyond the tip.
#[test]
fn a_tip_axis_has_no_place_off_the_bat() {
    let bats = [0.5, 3.0].map(even);
    let all = compared::pictures(Sheet::file(false), &side_by_side(&bats, Model::Contact)).unwrap();
    for picture in all.into_iter().filter(|picture| picture.name != "difference") {
        let document = Document::parse(&picture.svg).unwrap();
        let label = texts(&document)
            .into_iter()
            .find(|(words, _)| words.starts_with("from the tip") && words.ends_with("(cm)"));
        let Some((_, [_, top, _, bottom])) = label else { continue };
        let below = |y: f64| (top..bottom + 20.0).contains(&y);
        let values = ticks(&document, "middle", |_, y| below(y), false);
        let rising = values.values().all(|place| *place >= 0.0);
        assert!(rising && !values.is_empty(), "{}: {values:?}", picture.name);
    }
}

#[test]
fn whoever_reads_the_difference_off_the_axes_finds_who_is_faster() {
    let both = side_by_side(&[bat("r161"), bat("torpedo")], Model::Contact);
    let all = compared::pictures(Sheet::file(false), &both).unwrap();
    let picture = all.iter().find(|picture| picture.name == "difference").unwrap();
    let document = Document::parse(&picture.svg).unwrap();
    let height = number(document.root_element(), "height");
    let value = scale(ticks(&document, "end", |x, _| x < 70.0, true));
    let tip = scale(ticks(&document, "middle", |_, y| y > height - 40.0, false));
    let points = document.descendants().filter(|node| node.has_tag_name("circle"));
    let seen: Vec<[f64; 2]> = points
        .filter(|node| node.attribute("r") == Some("7"))
        .map(|node| [0.01 * tip(number(node, "cx")), value(number(node, "cy"))])
        .collect();
    assert!(seen.len() > 20, "{}", seen.len());
    for [from_tip, read] in seen {
        let [one, other] = [0, 1].map(|k| {
            let Contender { bat, sweep, .. } = &both.bats[k];
            let near = |i: &&Impact| (bat.length() - i.x - from_tip).abs() < 5e-4;
            sweep.impacts.iter().find(near).unwrap().outcome.as_ref().unwrap().exit_speed
        });
        // A pixel is about 0.05 m/s.
        assert!((read - (other - one)).abs() < 0.02, "{from_tip}: {read}, {one}, {other}");
    }
}

/// Pictures of modes as a laboratory names them: their frequencies (Hz), and their deflections at even
/// places from the knob end to the tip.
fn of_laboratory(bat: &Bat, hertz: &[f64], shapes: &[Vec<f64>]) -> Vec<Picture> {
    let mut text = String::new();
    let mut row = |name: &str, of: &dyn Fn(usize) -> String| {
        let cells: Vec<String> = (0..hertz.len()).map(of).collect();
        text += &format!("{name},{}\n", cells.join(","));
    };
    row("x_m", &|k| format!("mode number {} of the hammer test", k + 1));
    row("frequency_hz", &|k| hertz[k].to_string());
    let last = shapes[0].len() - 1;
    let places = (0..=last).map(|k| bat.length() * k as f64 / last as f64);
    places.enumerate().for_each(|(i, x)| row(&x.to_string(), &|k| shapes[k][i].to_string()));
    let folder = Folder::new("plots-measured");
    folder.write("measured.csv", text);
    let measured = measured::read(&folder.0.join("measured.csv"), &Default::default()).unwrap();
    let told = ToldPoints { first: Some(End::Knob), origin: None };
    let study = Study::new(bat, measured, &Request::plain(), false, told).unwrap();
    plot::measured::pictures(Sheet::file(false), bat.name(), &study)
}

#[test]
fn measured_modes_of_long_names_have_numbers_in_their_matrix() {
    let bat = bat("r161");
    let solution = solve(&bat, &Request { modes: 12, ..Request::plain() }).unwrap();
    let places: Vec<f64> = (0..=30).map(|k| bat.length() * f64::from(k) / 30.0).collect();
    let at_places = |of: &dyn Fn(f64) -> f64| places.iter().map(|x| of(*x)).collect::<Vec<_>>();
    let shapes = solution.modes.iter().map(|mode| at_places(&|x| mode.shape.deflection(x)));
    let hertz: Vec<f64> = solution.modes.iter().map(|mode| mode.frequency()).collect();
    let all = of_laboratory(&bat, &hertz, &shapes.collect::<Vec<_>>());
    for (picture, name) in all.iter().zip(["mac", "mass_orthogonality"]) {
        assert_eq!(picture.name, name);
        check(picture, "measured");
        let document = Document::parse(&picture.svg).unwrap();
        assert!(texts(&document).iter().any(|(words, _)| *words == "12"), "{name}");
    }
    let document = Document::parse(&all[1].svg).unwrap();
    let begins = |with: &str| texts(&document).iter().any(|(words, _)| words.starts_with(with));
    assert!(begins("12: mode number 12") && !begins("mode n"));
    let rigid = [at_places(&|_| 1.0), at_places(&|x| x - 0.4)];
    assert!(of_laboratory(&bat, &[2.0, 4.0], &rigid).is_empty());
}
