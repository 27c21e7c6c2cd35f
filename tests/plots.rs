//! Pictures: what is drawn is what was computed, in its place, and can be read.
#![cfg(feature = "png")]

mod common;

use std::collections::BTreeMap;

use common::folder::Folder;
use resvg::tiny_skia::Pixmap;
use resvg::usvg::roxmltree::{Document, Node};
use sweetspot::collision::history::loop_area;
use sweetspot::collision::hit::{Impact, Model, Scene, Wall};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::pulse::Pulse;
use sweetspot::collision::sweep::{Sweep, sweep};
use sweetspot::collision::sweet_spot::SweetSpot;
use sweetspot::comparison::contender::{Contender, Terms};
use sweetspot::comparison::table::{Comparison, Entry};
use sweetspot::measured::place::{End, Told};
use sweetspot::measured::study::Study;
use sweetspot::measured_file;
use sweetspot::plot;
use sweetspot::plot::matrix::{FULL, Matrix};
use sweetspot::plot::picture::Picture;
use sweetspot::plot::sets::{self, Hits};
use sweetspot::plot::theme::{self, FRAME, GRID, Ink, MUTED, PAPER, SERIES, TEXT, TINT};
use sweetspot::plot::words::{LABEL, Type};
use sweetspot::plot::{compared, exit_speed, front, ledger, matrix, png, profile, shapes, words};
use sweetspot::report::xml::escaped;
use sweetspot::trade::measure::measure;
use sweetspot::validation::bundled_bat;
use sweetspot::{Bat, Request, Solution, solve};

const BATS: [&str; 10] = [
    "cone",
    "corked",
    "dowel",
    "house",
    "northwestern_aluminium",
    "northwestern_wood",
    "r161",
    "tanh",
    "torpedo",
    "two_piece",
];

fn bat(name: &str) -> Bat {
    bundled_bat(&format!("meshes/{name}.json")).unwrap()
}

/// A bat that is hit along its outer half.
struct Struck {
    bat: Bat,
    scene: Scene,
    solution: Solution,
    sweep: Sweep,
    spot: SweetSpot,
}

fn struck(bat: Bat, model: Model, scene: Scene) -> Struck {
    let request = Request { modes: 6, ..Request::default() };
    let solution = solve(&bat, &request).unwrap();
    let half = 0.5 * bat.length();
    let places: Vec<f64> = (0..=40).map(|k| half * (1.0 + f64::from(k) / 40.0)).collect();
    let sweep = sweep(&bat, model, &scene, &request, false, &places).unwrap();
    let hitter = Hitter::new(model, &scene, &bat, &sweep.solution, sweep.effort).unwrap();
    let spot = SweetSpot::find(&bat, &scene, &sweep.solution, &hitter);
    Struck { bat, solution, sweep, spot, scene: scene.clone() }
}

fn pictures(struck: &Struck, model: Model) -> Vec<Picture> {
    let Struck { bat, scene, solution, sweep, spot } = struck;
    let mut all = sets::of_modes(bat, solution, Some(scene.pivot));
    all.extend(Hits { bat, model, scene, sweep, spot }.pictures(None).unwrap());
    all
}

/// A rectangle that holds a text: left, top, right, bottom.
type Box = [f64; 4];

fn number(node: Node, name: &str) -> f64 {
    node.attribute(name).map_or(0.0, |value| value.parse().unwrap())
}

/// Where the words of a picture are, as wide as they are in a wide font.
fn texts<'a>(document: &'a Document) -> Vec<(&'a str, Box)> {
    let of = |node: Node<'a, 'a>| {
        let (x, y, size) = (number(node, "x"), number(node, "y"), number(node, "font-size"));
        let words = node.text().unwrap_or_default();
        let look = Type { size, bold: node.has_attribute("font-weight"), ..LABEL };
        let wide = words::width(words, look);
        let before = match node.attribute("text-anchor") {
            Some("end") => wide,
            Some("middle") => 0.5 * wide,
            _ => 0.0,
        };
        let (up, down) = (0.75 * size, 0.2 * size);
        let rect = match node.has_attribute("transform") {
            true => [x - up, y - wide + before, x + down, y + before],
            false => [x - before, y - up, x - before + wide, y + down],
        };
        (words, rect)
    };
    document.descendants().filter(|node| node.has_tag_name("text")).map(of).collect()
}

/// What must hold in every picture.
fn check(picture: &Picture, whose: &str) {
    let what = format!("{whose}: {}", picture.name);
    let text = &picture.svg;
    assert!(text.len() < 60_000, "{what} has {} bytes", text.len());
    assert!(!text.contains("NaN") && !text.contains("inf\"") && !text.contains("id="), "{what}");
    let document = Document::parse(text).unwrap();
    let root = document.root_element();
    assert_eq!(root.attribute("role"), Some("img"), "{what}");
    let child = |name: &str| {
        let mut all = root.children().filter(|node| node.has_tag_name(name));
        all.next().and_then(|node| node.text()).unwrap_or_default().to_owned()
    };
    assert!(!child("title").is_empty() && child("desc").len() > 20, "{what}");
    assert_eq!(child("style"), theme::rules(), "{what}");
    let [width, height] = ["width", "height"].map(|side| number(root, side));
    let all = texts(&document);
    assert!(all.len() > 5, "{what}");
    for (k, (words, [left, top, right, bottom])) in all.iter().enumerate() {
        let inside = *left >= 0.0 && *top >= 0.0 && *right <= width + 0.5 && *bottom <= height;
        assert!(inside, "{what}: {words:?} leaves the picture");
        for (other, [l, t, r, b]) in &all[..k] {
            let apart = right <= l || r <= left || bottom <= t || b <= top;
            assert!(apart, "{what}: {words:?} is on {other:?}");
        }
        for [x, y, end] in guides(&document) {
            let apart = x <= *left || *right <= x || end <= *top || *bottom <= y;
            assert!(apart, "{what}: a dotted line runs through {words:?}");
        }
    }
}

/// The dotted lines down to marked places: where, from, to.
fn guides(document: &Document) -> Vec<[f64; 3]> {
    let dotted = |node: &Node| node.attribute("stroke-dasharray") == Some("1 3");
    let of = |node: Node| {
        let numbers = node.attribute("d").unwrap().split(['M', 'L', ' ']).filter(|n| !n.is_empty());
        let numbers: Vec<f64> = numbers.map(|n| n.parse().unwrap()).collect();
        assert!(numbers.len() == 4 && numbers[0] == numbers[2], "{numbers:?}");
        [numbers[0], numbers[1], numbers[3]]
    };
    document.descendants().filter(dotted).map(of).collect()
}

#[test]
fn pictures_of_all_bats_are_whole_and_no_words_lie_on_others() {
    for name in BATS {
        let struck = struck(bat(name), Model::Contact, Scene::default());
        let all = pictures(&struck, Model::Contact);
        let names: Vec<&str> = all.iter().map(|picture| picture.name.as_str()).collect();
        let wanted =
            ["profile", "shapes", "exit_speed", "ledger", "contact", "hysteresis", "hands"];
        assert_eq!(names, wanted, "{name}");
        all.iter().for_each(|picture| check(picture, name));
    }
}

#[test]
fn every_model_and_strange_bats_have_pictures() {
    let wall = Some(Wall { stiffness: 1e7, mass: 0.05 });
    let scenes = [
        ("rigid", Model::Rigid, Scene::default()),
        ("pulse", Model::Pulse(Pulse::default()), Scene::default()),
        ("energy-loss", Model::EnergyLoss(Default::default()), Scene::default()),
        ("a wall", Model::Contact, Scene { wall, ..Scene::default() }),
        ("an elastic ball", Model::Contact, Scene { cor: 1.0, ..Scene::default() }),
        ("a dead ball", Model::Contact, Scene { cor: 0.0, ..Scene::default() }),
        ("slow", Model::Contact, Scene { swing: 0.0, ball_speed: 0.1, ..Scene::default() }),
    ];
    for (whose, model, scene) in scenes {
        let struck = struck(bat("r161"), model, scene);
        let all = pictures(&struck, model);
        assert!(all.len() >= 4, "{whose}");
        all.iter().for_each(|picture| check(picture, whose));
    }
    let tiny = common::bat(
        &[0.0, 1e-3],
        &[2e-5, 4e-5],
        &[0.0; 2],
        sweetspot::profile::Interpolation::Linear,
    );
    let thick = common::bat(
        &[0.0, 0.1],
        &[0.05, 0.2],
        &[0.0; 2],
        sweetspot::profile::Interpolation::Linear,
    );
    let mut named = common::dowel();
    named.name = "<&\"> \u{7} バット ".repeat(30);
    for (whose, bat) in [("tiny", tiny), ("thick", thick), ("long name", named)] {
        let scene = Scene { hands: 0.0, ..Scene::default() };
        let struck = struck(bat, Model::Contact, scene);
        pictures(&struck, Model::Contact).iter().for_each(|picture| check(picture, whose));
    }
}

#[test]
fn several_bats_fit_into_one_picture() {
    let all: Vec<Struck> = ["r161", "torpedo", "northwestern_aluminium"]
        .map(|name| struck(bat(name), Model::Contact, Scene::default()))
        .into();
    let side = all.iter().map(|s| profile::Subject {
        name: &s.bat.name,
        bat: &s.bat,
        swing_pivot: Some(s.scene.pivot),
    });
    let bent = all.iter().map(|s| shapes::Subject {
        name: &s.bat.name,
        bat: &s.bat,
        solution: &s.solution,
    });
    let along = all.iter().map(|s| exit_speed::Subject {
        name: &s.bat.name,
        length: s.bat.length(),
        impacts: &s.sweep.impacts,
        spot: &s.spot,
    });
    let side = profile::picture(&side.collect::<Vec<_>>());
    let bent = shapes::picture(&bent.collect::<Vec<_>>(), 5).unwrap();
    let along = exit_speed::picture(&along.collect::<Vec<_>>()).unwrap();
    for picture in [side, bent, along] {
        check(&picture, "three bats");
        for s in &all {
            assert!(picture.svg.contains(&escaped(&s.bat.name)), "{}", picture.name);
        }
    }
}

/// Bats side by side, so many modes each.
fn side_by_side(bats: &[Bat], model: Model) -> Comparison {
    let request = Request { modes: 6, ..Request::default() };
    let entry = |bat: &Bat| Entry { bat: bat.clone(), scene: Scene::default(), law: None, request };
    let terms = Terms { model, exactly: false, every: 0.0254 };
    Comparison::new(bats.iter().map(entry).collect(), terms).unwrap()
}

#[test]
fn compared_bats_have_the_same_pictures_as_one() {
    let r161 = bat("r161");
    let long = {
        let ends = sweetspot::profile::Interpolation::Linear;
        common::bat(&[0.0, 3.0], &[0.02, 0.06], &[0.0; 2], ends)
    };
    let six = ["r161", "torpedo", "house", "cone", "two_piece", "northwestern_aluminium"].map(bat);
    let along = ["profile", "shapes", "exit_speed"];
    let hit = ["contact", "hysteresis", "hands"];
    for (bats, model, has_force) in [
        (vec![r161.clone(), bat("torpedo")], Model::Contact, true),
        (vec![r161.clone(), long.clone()], Model::Contact, true),
        (vec![long, r161.clone()], Model::Contact, true),
        (six.to_vec(), Model::Contact, true),
        (vec![r161, bat("cone")], Model::Rigid, false),
    ] {
        let all = compared::pictures(&side_by_side(&bats, model)).unwrap();
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

/// From the tip there is no place beyond it.
#[test]
fn a_tip_axis_has_no_place_off_the_bat() {
    let ends = sweetspot::profile::Interpolation::Linear;
    let bats = [0.5, 3.0].map(|l| common::bat(&[0.0, l], &[0.02, 0.06], &[0.0; 2], ends));
    for picture in compared::pictures(&side_by_side(&bats, Model::Contact)).unwrap() {
        let document = Document::parse(&picture.svg).unwrap();
        let label = texts(&document)
            .into_iter()
            .find(|(words, _)| words.starts_with("from the tip") && words.ends_with("(in)"));
        let Some((_, [_, top, _, bottom])) = label else { continue };
        let below = |y: f64| (top..bottom + 20.0).contains(&y);
        let values = ticks(&document, "middle", |_, y| below(y), false);
        let rising = values.values().all(|inches| *inches >= 0.0);
        assert!(rising && !values.is_empty(), "{}: {values:?}", picture.name);
    }
}

#[test]
fn whoever_reads_the_difference_off_the_axes_finds_who_is_faster() {
    let both = side_by_side(&[bat("r161"), bat("torpedo")], Model::Contact);
    let all = compared::pictures(&both).unwrap();
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

#[test]
fn a_bat_of_less_than_six_inches_has_no_place_of_the_standards() {
    let ends = sweetspot::profile::Interpolation::Linear;
    for (length, rows) in [(0.14, 1), (0.16, 3)] {
        let bat = common::bat(&[0.0, length], &[0.01, 0.02], &[0.0; 2], ends);
        let picture =
            profile::picture(&[profile::Subject { name: "short", bat: &bat, swing_pivot: None }]);
        check(&picture, "short");
        let document = Document::parse(&picture.svg).unwrap();
        let words = ["balance point", "pivot of standards", "its centre of percussion"];
        let seen =
            words.iter().filter(|row| texts(&document).iter().any(|t| t.0.starts_with(**row)));
        assert_eq!(seen.count(), rows, "{length}");
    }
}

/// The ticks of an axis as a reader sees them: from a pixel to a value.
fn scale(ticks: BTreeMap<i64, f64>) -> impl Fn(f64) -> f64 {
    let (first, last) = (ticks.iter().next().unwrap(), ticks.iter().next_back().unwrap());
    let ([a, b], [c, d]) = ([*first.0 as f64 / 10.0, *last.0 as f64 / 10.0], [*first.1, *last.1]);
    assert!(b > a);
    move |pixel| c + (d - c) * (pixel - a) / (b - a)
}

/// Numbers whose texts have that anchor and lie where `keep` says, by a pixel that `along` picks
/// (tenths).
fn ticks(
    document: &Document,
    anchor: &str,
    keep: impl Fn(f64, f64) -> bool,
    up: bool,
) -> BTreeMap<i64, f64> {
    let all = document
        .descendants()
        .filter(|node| node.has_tag_name("text") && node.attribute("text-anchor") == Some(anchor));
    let read = |node: Node| {
        let value: f64 = node.text()?.replace('−', "-").parse().ok()?;
        let (x, y) = (number(node, "x"), number(node, "y"));
        let along = if up { y - 4.4 } else { x };
        keep(x, y).then_some(((10.0 * along).round() as i64, value))
    };
    all.filter_map(read).collect()
}

#[test]
fn whoever_reads_the_curve_off_the_axes_finds_the_computed_speeds() {
    let struck = struck(bat("r161"), Model::Contact, Scene::default());
    let name = "R161";
    let (length, impacts) = (struck.bat.length(), &struck.sweep.impacts);
    let subject = exit_speed::Subject { name, length, impacts, spot: &struck.spot };
    let picture = exit_speed::picture(&[subject]).unwrap();
    let document = Document::parse(&picture.svg).unwrap();
    let height = number(document.root_element(), "height");
    let speed = scale(ticks(&document, "end", |x, y| x < 70.0 && y < 400.0, true));
    let knob = scale(ticks(&document, "middle", |_, y| y > height - 40.0, false));
    let tip = scale(ticks(&document, "middle", |_, y| y < 140.0, false));
    let hover = document.descendants().filter(|node| node.has_tag_name("circle"));
    let seen: Vec<(f64, f64)> = hover
        .filter(|node| {
            node.first_element_child()
                .is_some_and(|t| t.text().unwrap_or_default().starts_with("as it bends"))
        })
        .map(|node| (number(node, "cx"), number(node, "cy")))
        .collect();
    assert!(seen.len() > 15, "{}", seen.len());
    for (x, y) in seen {
        let place = 0.01 * knob(x);
        let near = |i: &&sweetspot::collision::hit::Impact| (i.x - place).abs() < 2e-4;
        let impact = impacts.iter().find(near).unwrap_or_else(|| panic!("{place}"));
        let truth = impact.outcome.as_ref().unwrap().exit_speed;
        // A pixel is about 0.2 m/s.
        assert!((speed(y) - truth).abs() < 0.03, "{place} {} {truth}", speed(y));
        assert!((tip(x) - (length - place) / 0.0254).abs() < 0.01, "{place}");
    }
}

#[test]
fn the_stacked_energies_reach_the_initial_one() {
    for (name, held) in [("r161", false), ("torpedo", false), ("dowel", true)] {
        let mut one = bat(name);
        if held {
            let text = std::fs::read_to_string(format!("meshes/{name}.json")).unwrap();
            let text = text.trim_end().trim_end_matches('}').to_owned()
                + ", \"supports\": [{\"x\": 0.15, \"type\": \"pinned\"}] }";
            let folder = Folder::new("plots-held");
            folder.write("bat.json", text);
            one = Bat::from_file(folder.0.join("bat.json")).unwrap();
        }
        let struck = struck(one, Model::Contact, Scene::default());
        let layers = ledger::layers(&struck.sweep.impacts);
        let stacks = ledger::stacked(&layers);
        for (impact, top) in struck.sweep.impacts.iter().zip(stacks.last().unwrap()) {
            // Where a bat ends in a point there is no hit.
            let Some(outcome) = &impact.outcome else { continue };
            let energy = &outcome.energy;
            assert!((top.unwrap() / energy.initial - 1.0).abs() < 1e-8, "{name} {}", impact.x);
        }
        for pair in stacks.windows(2) {
            let lies = |(low, high): (&Option<f64>, &Option<f64>)| high >= low;
            assert!(pair[0].iter().zip(&pair[1]).all(lies), "{name}");
        }
        // The energies of a held bat are not those that the ground sees.
        let picture = ledger::picture(name, &struck.bat, &struck.sweep.impacts, 0.0).unwrap();
        assert_eq!(picture.svg.contains("as the hands see it"), held, "{name}");
    }
}

/// The loop is drawn from the motions of ball and bat, the loss is the force law's own closed form.
#[test]
fn the_area_of_the_loop_is_the_energy_that_the_ball_loses() {
    let wall = Some(Wall { stiffness: 1e7, mass: 0.05 });
    let scenes = [
        Scene::default(),
        Scene { cor: 0.3, ..Scene::default() },
        Scene { cor: 1.0, ..Scene::default() },
        Scene { wall, ..Scene::default() },
        Scene { swing: 0.0, ball_speed: 1.0, ..Scene::default() },
    ];
    for name in ["r161", "northwestern_aluminium", "dowel"] {
        for (k, scene) in scenes.iter().enumerate() {
            let struck = struck(bat(name), Model::Contact, scene.clone());
            let (solution, effort) = (&struck.sweep.solution, struck.sweep.effort);
            let hitter = Hitter::new(Model::Contact, scene, &struck.bat, solution, effort).unwrap();
            for share in [0.55, 0.7, 0.83, 0.97] {
                let x = share * struck.bat.length();
                let moments = hitter.history(x, 60).unwrap();
                let energy = hitter.strike(x).outcome.unwrap().energy;
                let most = moments.iter().map(|m| m.force * m.compression).fold(0.0, f64::max);
                let area = loop_area(&moments);
                let off = (area - energy.dissipated_ball) / most;
                assert!(off.abs() < 1e-4, "{name} {k} {share}: {area} {}", energy.dissipated_ball);
                // And until its force first falls the ball is on its law, F = k u^α.
                if energy.wall > 0.0 {
                    continue;
                }
                let falls = moments.windows(2).position(|m| m[1].force < m[0].force).unwrap();
                let law = scene.force_law(scene.cor).unwrap();
                for m in moments[..falls].iter().filter(|m| m.force > 0.05 * moments[falls].force) {
                    let force = law.force(m.compression, None)[0];
                    assert!((m.force / force - 1.0).abs() < 1e-4, "{name} {k} {share}: {m:?}");
                }
            }
        }
    }
}

#[test]
fn a_png_is_twice_as_large_and_drawn_with_the_one_font() {
    assert_eq!(png::fonts().len(), 1);
    let struck = struck(bat("two_piece"), Model::Contact, Scene::default());
    for picture in pictures(&struck, Model::Contact) {
        let document = Document::parse(&picture.svg).unwrap();
        let side = |name| 2.0 * number(document.root_element(), name);
        let image = Pixmap::decode_png(&png::png(&picture.svg, 2.0)).unwrap();
        let size = [f64::from(image.width()), f64::from(image.height())];
        assert!((size[0] - side("width")).abs() <= 1.0 && (size[1] - side("height")).abs() <= 1.0);
        let blank = image.pixels()[0];
        let drawn = image.pixels().iter().filter(|pixel| **pixel != blank).count();
        assert!(drawn > image.pixels().len() / 100, "{}: {drawn}", picture.name);
        // The paper is white and no pixel lets another through.
        assert_eq!([blank.red(), blank.green(), blank.blue(), blank.alpha()], [255; 4]);
        assert!(image.pixels().iter().all(|pixel| pixel.alpha() == 255), "{}", picture.name);
        // The title is drawn: there is ink where it stands.
        let title = (0..40).flat_map(|y| (40..200).map(move |x| (x, y + 20)));
        let ink = title.filter(|(x, y)| image.pixel(*x, *y).unwrap().red() < 100).count();
        assert!(ink > 100, "{}: no title", picture.name);
    }
}

/// Red, green and blue, 0 to 1.
fn channels(colour: &str) -> [f64; 3] {
    let part = |k: usize| u8::from_str_radix(&colour[k..k + 2], 16).unwrap();
    [1, 3, 5].map(|k| f64::from(part(k)) / 255.0)
}

/// Relative luminance by WCAG 2.1.
fn luminance(colour: [f64; 3]) -> f64 {
    let linear = |c: f64| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    let [r, g, b] = colour.map(linear);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn contrast(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

#[test]
fn every_colour_reads_on_light_and_on_dark_paper() {
    let papers: [fn(&Ink) -> &'static str; 2] = [|ink| ink.light, |ink| ink.dark];
    for paper in papers {
        let of = |ink: &Ink| channels(paper(ink));
        let tinted = |ink: &Ink, opacity: f64| {
            let (over, under) = (of(ink), of(&PAPER));
            [0, 1, 2].map(|k| opacity * over[k] + (1.0 - opacity) * under[k])
        };
        for ink in [TEXT, MUTED].iter().chain(&SERIES) {
            assert!(contrast(of(ink), of(&PAPER)) >= 4.5, "{ink:?}");
        }
        // Words stand on tinted stretches and on the cells of a matrix.
        for series in &SERIES {
            for words in [TEXT, MUTED] {
                assert!(contrast(of(&words), tinted(series, TINT)) >= 4.5, "{series:?} {words:?}");
            }
        }
        for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
            assert!(contrast(of(&TEXT), tinted(&SERIES[0], share * FULL)) >= 4.5, "{share}");
        }
        assert!(contrast(of(&FRAME), of(&PAPER)) >= 3.0);
        // The grid is there, and stands back.
        let grid = contrast(of(&GRID), of(&PAPER));
        assert!((1.2..2.0).contains(&grid), "{grid}");
    }
}

#[test]
fn a_matrix_has_its_numbers_in_it() {
    let names = |count: usize| (1..=count).map(|k| k.to_string()).collect::<Vec<_>>();
    let value = |i: usize, k: usize| (i != k).then_some(0.1 * (i + k) as f64);
    let table = Matrix {
        name: "mac".into(),
        title: "MAC".into(),
        second: "computed against measured".into(),
        sides: ["computed".into(), "measured".into()],
        rows: names(4),
        columns: names(5),
        values: (0..4).map(|i| (0..5).map(|k| value(i, k)).collect()).collect(),
        scale: "MAC".into(),
    };
    let picture = matrix::picture(&table);
    check(&picture, "matrix");
    let document = Document::parse(&picture.svg).unwrap();
    let seen = |words: &str| texts(&document).iter().filter(|(text, _)| *text == words).count();
    assert_eq!((seen("0.30"), seen("0.70"), seen("–")), (4, 1, 4));
    assert_eq!((seen("1"), seen("5")), (2, 1));
    let many = Matrix { columns: names(40), values: vec![vec![Some(0.5); 40]; 4], ..table };
    // There is room for every second, and none is cut.
    let picture = matrix::picture(&many);
    check(&picture, "many columns");
    let document = Document::parse(&picture.svg).unwrap();
    let seen = |words: &str| texts(&document).iter().filter(|(text, _)| *text == words).count();
    assert_eq!((seen("29"), seen("30"), seen("39"), seen("40")), (0, 1, 0, 1));
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
    let measured = measured_file::read(&folder.0.join("measured.csv")).unwrap();
    let told = Told { first: Some(End::Knob), origin: None };
    let study = Study::new(bat, measured, &Request::default(), false, told).unwrap();
    plot::measured::pictures(&bat.name, &study)
}

#[test]
fn measured_modes_of_long_names_have_numbers_in_their_matrix() {
    let bat = bat("r161");
    let solution = solve(&bat, &Request { modes: 12, ..Request::default() }).unwrap();
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

#[test]
fn the_front_shows_the_solvers_and_the_planners_choices() {
    let bat = bat("cone");
    let theory = sweetspot::theory::Theory::EulerBernoulli;
    let budget = std::time::Duration::from_millis(600);
    let trade = measure(&bat, 3, theory, budget, &sweetspot::telling::nobody).unwrap();
    let picture = front::picture(&bat.name, &trade).unwrap();
    assert!(Document::parse(&picture.svg).is_ok() && !picture.svg.contains("NaN"));
    for words in ["statics", "shift-invert", "front", "planner"] {
        assert!(picture.svg.contains(words), "{words}");
    }
    for (k, picture) in sets::of_u_curve(&bat.name, &trade.columns, 3).iter().enumerate() {
        assert_eq!(picture.name, ["u_curve", "u_curve_mode_3"][k]);
        check(picture, "cone");
    }
}

#[test]
fn the_program_draws_into_a_folder() {
    let folder = Folder::new("plots");
    let mesh = |name: &str| format!("{}/meshes/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let files = |of: &str| Folder(folder.0.join(of)).names();
    let both = |names: &[&str]| {
        let mut all: Vec<String> =
            names.iter().flat_map(|n| [format!("{n}.png"), format!("{n}.svg")]).collect();
        all.sort();
        all
    };
    let r161 = mesh("r161");
    folder.text(&["modes", &r161, "--plots", "a/b"]);
    assert_eq!(files("a/b"), both(&["profile", "shapes"]));
    folder.text(&["modes", &r161, "--modes", "0", "--plots", "none"]);
    assert_eq!(files("none"), both(&["profile"]));
    folder.text(&["hit", &r161, "--points", "9", "--plots", "hit"]);
    let along = ["profile", "exit_speed", "ledger", "contact", "hysteresis", "hands"];
    assert_eq!(files("hit"), both(&along));
    folder.text(&["hit", &r161, "--at", "60 cm", "--plots", "at"]);
    assert_eq!(files("at"), both(&["profile", "contact", "hysteresis", "hands"]));
    folder.text(&["trade", &mesh("dowel"), "--budget", "300 ms", "-n", "2", "--plots", "trade"]);
    assert_eq!(files("trade"), both(&["front"]));
    // What an earlier run drew stays and is named; what others drew is nobody's business.
    folder.text(&["hit", &r161, "--points", "9", "--plots", "twice"]);
    folder.write("twice/mine.svg", "<svg></svg>");
    let output = folder.run(&["hit", &mesh("dowel"), "--model", "rigid", "--plots", "twice"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(
        told.contains("twice still holds pictures of an earlier run: contact, hands, hysteresis\n")
    );
    assert_eq!(files("twice").len(), 2 * along.len() + 1);
    // Where there is a file there is no folder.
    folder.write("taken", "x");
    let output = folder.run(&["modes", &r161, "--plots", "taken"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("taken"));
    assert_eq!(folder.read("taken"), "x");
}
