//! Pictures: they show the computed values in the right place and are legible.
#![cfg(feature = "png")]

use crate::common;

use crate::pictures::{check, number, scale, texts, ticks};
use common::folder::Folder;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::roxmltree::Document;
use resvg::usvg::{Options, Tree};
use sweetspot::base::xml::escaped;
use sweetspot::collision::Ball;
use sweetspot::collision::aftermath::Aftermath;
use sweetspot::collision::contact::force_law::ForceLaw;
use sweetspot::collision::contact::power_law::PowerLaw;
use sweetspot::collision::history::Moment;
use sweetspot::collision::hit::{Effort, Model, Scene, Wall};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::pulse::Pulse;
use sweetspot::collision::sweep::{Accuracy, Sweep, sweep};
use sweetspot::collision::sweet_spot::SweetSpot;
use sweetspot::motion::frf::{Frf, ResponseKind, Sample};
use sweetspot::{Bat, Request, Solution, solve};
use sweetspot_proof::bundled::bundled_bat;
use sweetspot_report::plot::matrix::{FULL, Matrix};
use sweetspot_report::plot::picture::Picture;
use sweetspot_report::plot::png::png;
use sweetspot_report::plot::sets::{self, Hits};
use sweetspot_report::plot::sheet::{Paper, Sheet};
use sweetspot_report::plot::subject::Subject;
use sweetspot_report::plot::svg::Shape;
use sweetspot_report::plot::theme::{FRAME, GRID, Ink, MUTED, PAPER, SERIES, TEXT, TINT};
use sweetspot_report::plot::{
    exit_speed, front, hoop, lathe, ledger, matrix, profile, response, ringing, shapes,
    wall_sweep as thickness,
};
use sweetspot_report::schema::ring::{AfterHit, Motion};
use sweetspot_study::answers::Answer;
use sweetspot_study::lathe::map::{LatheMap, LatheTerms, bands};
use sweetspot_study::lathe::workpiece::HitTerms;
use sweetspot_study::trade::measure::measure;
use sweetspot_study::trampoline::barrel::{Barrel, BarrelTest};
use sweetspot_study::trampoline::thickness::wall_sweep;

const SHEET: Sheet = Sheet::file(false);

const BATS: [&str; 12] = [
    "bbcor_made_up",
    "cone",
    "corked",
    "dowel",
    "house",
    "northwestern_aluminium",
    "northwestern_wood",
    "r161",
    "softball_made_up_open",
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
    let request = Request { modes: 6, ..Request::plain() };
    let solution = solve(&bat, &request).unwrap();
    let half = 0.5 * bat.length();
    let places: Vec<f64> = (0..=40).map(|k| half * (1.0 + f64::from(k) / 40.0)).collect();
    let sweep = sweep(&bat, model, &scene, &Accuracy::plain(), &places).unwrap();
    let hitter = Hitter::new(model, &scene, &bat, &sweep.solution, sweep.effort).unwrap();
    let spot = SweetSpot::find(&hitter);
    Struck { bat, solution, sweep, spot, scene: scene.clone() }
}

fn pictures(struck: &Struck, model: Model) -> Vec<Picture> {
    pictures_on(SHEET, struck, model)
}

fn pictures_on(sheet: Sheet, struck: &Struck, model: Model) -> Vec<Picture> {
    let Struck { bat, scene, solution, sweep, spot } = struck;
    let mut all = sets::of_modes(sheet, bat, solution, Some(scene.pivot));
    all.extend(Hits { bat, model, scene, sweep, spot }.pictures(sheet, None).unwrap());
    all
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

/// On a page, wide and narrow, in both systems of units.
#[test]
fn every_form_of_a_picture_is_whole_and_none_is_wider_than_its_room() {
    for name in ["r161", "two_piece", "northwestern_aluminium", "corked"] {
        let struck = struck(bat(name), Model::Contact, Scene::default());
        for (us, paper) in [(true, Paper::File), (false, Paper::Page), (true, Paper::Narrow)] {
            let sheet = Sheet { us, paper };
            for picture in pictures_on(sheet, &struck, Model::Contact) {
                check(&picture, name);
                assert_eq!(picture.drawing.width, sheet.width());
                let document = Document::parse(&picture.svg).unwrap();
                let metric = texts(&document).iter().any(|(words, _)| words.contains("(cm)"));
                assert!(!(us && metric), "{name} {}", picture.name);
            }
        }
    }
}

/// The strips of a lathe map, in every form.
#[test]
fn a_lathe_map_is_whole_in_every_form() {
    for name in ["r161", "torpedo", "corked"] {
        let bat = bat(name);
        let (bands, cut) = (bands(bat.length(), 0.0254), 5e-4);
        let answers = vec![
            Answer::Mass,
            Answer::Inertia,
            Answer::Frequency(1),
            Answer::Frequency(2),
            Answer::Node(1),
            Answer::ExitSpeed,
            Answer::ExitSpeedPlace,
            Answer::HandsAccelerationAt(0.7),
        ];
        let terms = LatheTerms { bands, cut, exponent: 0.25, answers };
        let request = Request { tolerance: 1e-3, ..Request::plain() };
        let scene = Scene::default();
        let hit = HitTerms { scene, model: Model::Contact, exactly: false };
        let map = LatheMap::new(&bat, &request, Some(&hit), terms).unwrap();
        for (us, paper) in [(false, Paper::File), (true, Paper::Page), (true, Paper::Narrow)] {
            let sheet = Sheet { us, paper };
            let picture = lathe::picture(sheet, &map).unwrap();
            check(&picture, name);
            assert_eq!(picture.drawing.width, sheet.width());
        }
    }
}

/// The modes of a barrel, and BBCOR against its wall, in every form.
#[test]
fn hoop_modes_and_walls_are_whole_in_every_form() {
    for name in ["bbcor_made_up", "softball_made_up_open", "northwestern_aluminium"] {
        let bat = bat(name);
        let test = BarrelTest::of(&bat, Ball::baseball(), Accuracy::plain());
        let barrel = Barrel::of(&bat, test, None).unwrap();
        let tried = wall_sweep(&bat, &barrel, &|_| {});
        assert!(tried.len() > 3, "{name}");
        for (us, paper) in
            [(false, Paper::File), (true, Paper::File), (true, Paper::Page), (false, Paper::Narrow)]
        {
            let sheet = Sheet { us, paper };
            for picture in [
                hoop::picture(sheet, &bat, &barrel, hoop::MODES).unwrap(),
                thickness::picture(sheet, name, &tried).unwrap(),
            ] {
                check(&picture, name);
                assert_eq!(picture.drawing.width, sheet.width());
            }
        }
    }
}

/// Equal places of several bats are drawn side by side.
#[test]
fn no_mark_of_a_row_hides_another() {
    let bats = ["r161", "r161", "r161", "torpedo"].map(bat);
    let side = |bat| Subject { name: "one of them", bat, drawn: Some(0.06) };
    let side: Vec<_> = bats.iter().map(side).collect();
    for paper in [Paper::File, Paper::Narrow] {
        let picture = profile::picture(Sheet { us: false, paper }, &side);
        check(&picture, "four bats");
        let marks = picture.drawing.shapes().iter().filter_map(|shape| match shape {
            Shape::Circle { middle, .. } => Some(*middle),
            Shape::Area { outline, look } if outline.len() < 5 && look.pen.is_some() => {
                let count = outline.len() as f64;
                Some([0, 1].map(|k| outline.iter().map(|at| at[k]).sum::<f64>() / count))
            }
            _ => None,
        });
        let marks: Vec<[f64; 2]> = marks.collect();
        assert!(marks.len() > 15, "{}", marks.len());
        for (k, one) in marks.iter().enumerate() {
            for other in &marks[..k] {
                assert!((one[0] - other[0]).hypot(one[1] - other[1]) > 6.0, "{one:?} {other:?}");
            }
        }
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
        sweetspot::bat::profile::Interpolation::Linear,
    );
    let thick = common::bat(
        &[0.0, 0.1],
        &[0.05, 0.2],
        &[0.0; 2],
        sweetspot::bat::profile::Interpolation::Linear,
    );
    let long = "<&\"> \u{7} バット ".repeat(30);
    let named = common::dowel().with(|parts| parts.name = long).unwrap();
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
    let side =
        all.iter().map(|s| Subject { name: s.bat.name(), bat: &s.bat, drawn: Some(s.scene.pivot) });
    let bent = all.iter().map(|s| Subject { name: s.bat.name(), bat: &s.bat, drawn: &s.solution });
    let along = all.iter().map(|s| Subject {
        name: s.bat.name(),
        bat: &s.bat,
        drawn: (&s.sweep.impacts[..], &s.spot),
    });
    let side = profile::picture(SHEET, &side.collect::<Vec<_>>());
    let bent = shapes::picture(SHEET, &bent.collect::<Vec<_>>(), 5).unwrap();
    let along = exit_speed::picture(SHEET, &along.collect::<Vec<_>>()).unwrap();
    for picture in [side, bent, along] {
        check(&picture, "three bats");
        for s in &all {
            assert!(picture.svg.contains(&escaped(s.bat.name())), "{}", picture.name);
        }
    }
}

#[test]
fn a_bat_of_less_than_six_inches_has_no_place_of_the_standards() {
    let ends = sweetspot::bat::profile::Interpolation::Linear;
    for (length, rows) in [(0.14, 1), (0.16, 3)] {
        let bat = common::bat(&[0.0, length], &[0.01, 0.02], &[0.0; 2], ends);
        let picture = profile::picture(SHEET, &[Subject { name: "short", bat: &bat, drawn: None }]);
        check(&picture, "short");
        let document = Document::parse(&picture.svg).unwrap();
        let words = ["balance point", "pivot of standards", "centre of percussion of that"];
        let seen =
            words.iter().filter(|row| texts(&document).iter().any(|t| t.0.starts_with(**row)));
        assert_eq!(seen.count(), rows, "{length}");
    }
}

#[test]
fn whoever_reads_the_curve_off_the_axes_finds_the_computed_speeds() {
    let struck = struck(bat("r161"), Model::Contact, Scene::default());
    let name = "R161";
    let (bat, impacts) = (&struck.bat, &struck.sweep.impacts);
    let subject = Subject { name, bat, drawn: (&impacts[..], &struck.spot) };
    let picture = exit_speed::picture(SHEET, &[subject]).unwrap();
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
        assert!((tip(x) - 100.0 * (bat.length() - place)).abs() < 0.02, "{place}");
    }
}

#[test]
fn the_stacked_energies_reach_the_initial_one() {
    for (name, held) in [("r161", false), ("torpedo", false), ("dowel", true)] {
        let mut one = bat(name);
        if held {
            let text =
                std::fs::read_to_string(format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP")))
                    .unwrap();
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
        // The energies of a held bat differ from those seen from the ground.
        let picture =
            ledger::picture(SHEET, name, &struck.bat, &struck.sweep.impacts, 0.0).unwrap();
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
                // The energy that the ball does not return, ∮ F dx, by straight lines.
                let work = |pair: &[Moment]| {
                    let mean = 0.5 * (pair[0].force + pair[1].force);
                    mean * (pair[1].compression - pair[0].compression)
                };
                let area: f64 = moments.windows(2).map(work).sum();
                let off = (area - energy.dissipated_ball) / most;
                assert!(off.abs() < 1e-4, "{name} {k} {share}: {area} {}", energy.dissipated_ball);
                // And until its force first falls the ball is on its law, F = k u^α.
                if energy.wall > 0.0 {
                    continue;
                }
                let falls = moments.windows(2).position(|m| m[1].force < m[0].force).unwrap();
                let [k, alpha] = [scene.ball.stiffness, scene.ball.exponent].map(Option::unwrap);
                let law = PowerLaw::new(k, alpha, scene.cor);
                for m in moments[..falls].iter().filter(|m| m.force > 0.05 * moments[falls].force) {
                    let force = law.force(m.compression, None)[0];
                    assert!((m.force / force - 1.0).abs() < 1e-4, "{name} {k} {share}: {m:?}");
                }
            }
        }
    }
}

#[test]
fn a_png_is_twice_as_large_and_its_paper_white() {
    let struck = struck(bat("two_piece"), Model::Contact, Scene::default());
    for picture in pictures(&struck, Model::Contact) {
        let document = Document::parse(&picture.svg).unwrap();
        let side = |name| 2.0 * number(document.root_element(), name);
        let image = Pixmap::decode_png(&png(&picture.drawing, 2.0)).unwrap();
        let size = [f64::from(image.width()), f64::from(image.height())];
        assert!((size[0] - side("width")).abs() <= 1.0 && (size[1] - side("height")).abs() <= 1.0);
        let blank = image.pixels()[0];
        let drawn = image.pixels().iter().filter(|pixel| **pixel != blank).count();
        assert!(drawn > image.pixels().len() / 100, "{}: {drawn}", picture.name);
        // The background is white and every pixel is opaque.
        assert_eq!([blank.red(), blank.green(), blank.blue(), blank.alpha()], [255; 4]);
        assert!(image.pixels().iter().all(|pixel| pixel.alpha() == 255), "{}", picture.name);
        // The title is drawn: there is ink at its place.
        let title = (0..40).flat_map(|y| (40..200).map(move |x| (x, y + 20)));
        let ink = title.filter(|(x, y)| image.pixel(*x, *y).unwrap().red() < 100).count();
        assert!(ink > 100, "{}: no title", picture.name);
    }
}

/// The SVG of a picture as a program draws it that reads SVG, in the same font and of twice the size.
fn by_others(picture: &Picture) -> Pixmap {
    let mut options = Options { font_family: "Ubuntu".into(), ..Options::default() };
    let fonts = options.fontdb_mut();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    let tree = Tree::from_str(&picture.svg, &options).unwrap();
    let [width, height] = [tree.size().width(), tree.size().height()].map(|side| 2.0 * side);
    let mut pixels = Pixmap::new(width.ceil() as u32, height.ceil() as u32).unwrap();
    resvg::render(&tree, Transform::from_scale(2.0, 2.0), &mut pixels.as_mut());
    pixels
}

/// The largest mean difference of colours, 0 to 255, that squares of eight pixels have below a row.
fn difference(one: &Pixmap, other: &Pixmap, below: u32) -> f64 {
    const SIDE: u32 = 8;
    let colours = |image: &Pixmap, x: u32, y: u32| {
        image.pixel(x, y).map_or([0.0; 3], |p| [p.red(), p.green(), p.blue()].map(f64::from))
    };
    let square = |x: u32, y: u32| {
        let inside = (0..SIDE * SIDE).map(|k| (x + k % SIDE, y + k / SIDE));
        let off = |(x, y)| {
            let (a, b) = (colours(one, x, y), colours(other, x, y));
            (0..3).map(|k| (a[k] - b[k]).abs() / 3.0).sum::<f64>()
        };
        inside.map(off).sum::<f64>() / f64::from(SIDE * SIDE)
    };
    let steps = |from: u32, to: u32| (from..to).step_by(SIDE as usize);
    let all = steps(below, one.height()).flat_map(|y| steps(0, one.width()).map(move |x| (x, y)));
    all.map(|(x, y)| square(x, y)).fold(0.0, f64::max)
}

#[test]
fn a_png_shows_what_others_draw_from_the_svg() {
    let names = ["r161", "torpedo", "northwestern_aluminium", "cone", "dowel", "house"];
    let bats = names.map(bat);
    let side = |bat| Subject { name: "beside others", bat, drawn: Some(0.1) };
    let side: Vec<Subject<Option<f64>>> = bats.iter().map(side).collect();
    let mut all = pictures(&struck(bat("house"), Model::Contact, Scene::default()), Model::Contact);
    all.push(profile::picture(SHEET, &side));
    all.push(matrix::picture(&table()));
    for picture in all {
        let ours = Pixmap::decode_png(&png(&picture.drawing, 2.0)).unwrap();
        let theirs = by_others(&picture);
        assert_eq!([ours.width(), ours.height()], [theirs.width(), theirs.height()]);
        // The other program draws the title in the thin weight of the font, and we do not; it is above this row.
        let off = difference(&ours, &theirs, 72);
        // Letters may be displaced by a sixteenth of a pixel, the resolution of edges.
        assert!(off < 12.0, "{}: {off}", picture.name);
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
        // Words appear on tinted stretches and on the cells of a matrix.
        for series in &SERIES {
            for words in [TEXT, MUTED] {
                assert!(contrast(of(&words), tinted(series, TINT)) >= 4.5, "{series:?} {words:?}");
            }
        }
        for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
            assert!(contrast(of(&TEXT), tinted(&SERIES[0], share * FULL)) >= 4.5, "{share}");
        }
        assert!(contrast(of(&FRAME), of(&PAPER)) >= 3.0);
        // The grid is visible but muted.
        let grid = contrast(of(&GRID), of(&PAPER));
        assert!((1.2..2.0).contains(&grid), "{grid}");
    }
}

/// A small one, with numbers in its cells and gaps.
fn table() -> Matrix {
    let names = |count: usize| (1..=count).map(|k| k.to_string()).collect::<Vec<_>>();
    let value = |i: usize, k: usize| (i != k).then_some(0.1 * (i + k) as f64);
    Matrix {
        name: "mac".into(),
        title: "MAC".into(),
        second: "computed against measured".into(),
        sides: ["computed".into(), "measured".into()],
        rows: names(4),
        columns: names(5),
        values: (0..4).map(|i| (0..5).map(|k| value(i, k)).collect()).collect(),
        scale: "MAC".into(),
    }
}

#[test]
fn a_matrix_has_its_numbers_in_it() {
    let names = |count: usize| (1..=count).map(|k| k.to_string()).collect::<Vec<_>>();
    let table = table();
    let picture = matrix::picture(&table);
    check(&picture, "matrix");
    let document = Document::parse(&picture.svg).unwrap();
    let seen = |words: &str| texts(&document).iter().filter(|(text, _)| *text == words).count();
    assert_eq!((seen("0.30"), seen("0.70"), seen("–")), (4, 1, 4));
    assert_eq!((seen("1"), seen("5")), (2, 1));
    let many = Matrix { columns: names(40), values: vec![vec![Some(0.5); 40]; 4], ..table };
    // There is room for every second name, and none is cut.
    let picture = matrix::picture(&many);
    check(&picture, "many columns");
    let document = Document::parse(&picture.svg).unwrap();
    let seen = |words: &str| texts(&document).iter().filter(|(text, _)| *text == words).count();
    assert_eq!((seen("29"), seen("30"), seen("39"), seen("40")), (0, 1, 0, 1));
}

#[test]
fn the_front_shows_the_solvers_and_the_planners_choices() {
    let bat = bat("cone");
    let theory = sweetspot::bat::theory::Theory::EulerBernoulli;
    let budget = std::time::Duration::from_millis(600);
    let trade = measure(&bat, 3, theory, budget, &sweetspot::base::telling::nobody).unwrap();
    let picture = front::picture(bat.name(), &trade).unwrap();
    assert!(Document::parse(&picture.svg).is_ok() && !picture.svg.contains("NaN"));
    for words in ["statics", "shift-invert", "front", "planner"] {
        assert!(picture.svg.contains(words), "{words}");
    }
    for (k, picture) in sets::of_u_curve(bat.name(), &trade.more_elements, 3).iter().enumerate() {
        assert_eq!(picture.name, ["u_curve", "u_curve_mode_3"][k]);
        check(picture, "cone");
    }
}

#[test]
fn the_program_draws_into_a_folder() {
    let folder = Folder::new("plots");
    let mesh = |name: &str| format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP"));
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
    // Pictures of an earlier run are kept and named; other files are ignored.
    folder.text(&["hit", &r161, "--points", "9", "--plots", "twice"]);
    folder.write("twice/mine.svg", "<svg></svg>");
    let output = folder.run(&["hit", &mesh("dowel"), "--model", "rigid", "--plots", "twice"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(
        told.contains("twice still holds pictures of an earlier run: contact, hands, hysteresis\n")
    );
    assert_eq!(files("twice").len(), 2 * along.len() + 1);
    // A file in place of the folder.
    folder.write("taken", "x");
    let output = folder.run(&["modes", &r161, "--plots", "taken"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("taken"));
    assert_eq!(folder.read("taken"), "x");
}

/// A response with its peaks, alone and under a measured one, damped and not, and the motion after a
/// hit and after a blow.
#[test]
fn responses_and_motions_are_whole_in_every_form() {
    let lossy = r#"{ "format": "sweetspot-bat/1", "name": "lossy", "material":
        { "density": 700, "youngs_modulus": 14e9, "shear_modulus": 1e9, "loss_factor": 0.02 },
        "profile": { "x": [0, 0.8], "radius": [0.02, 0.03] } }"#;
    let lossy = Bat::from_text("lossy.json", lossy, std::path::Path::new("")).unwrap();
    let sheets =
        [(false, Paper::File), (true, Paper::File), (false, Paper::Page), (true, Paper::Narrow)];
    for bat in [lossy, bat("r161")] {
        let request = Request { modes: 5, ..Request::plain() };
        let mut frf = Frf::new(&bat, &request, 0.7, 0.1).unwrap();
        let grid: Vec<f64> =
            [20.0].into_iter().chain(frf.around_modes([21.0, 2999.0])).chain([3000.0]).collect();
        let samples = frf.receptances(&grid).unwrap();
        let peaks = frf.peaks(ResponseKind::Mobility, &grid);
        assert!(peaks.len() > 3);
        let of = |s: &Sample| (s.frequency, s.receptance * ResponseKind::Mobility.of(s.frequency));
        let values: Vec<_> = samples.iter().map(of).collect();
        let solution = solve(&bat, &request).unwrap();
        let scene = Scene::default();
        let hitter =
            Hitter::new(Model::Contact, &scene, &bat, &solution, Effort::default()).unwrap();
        let after = Aftermath::new(&bat, &solution, 0.6, hitter.force(0.6).unwrap());
        let report = AfterHit::new(&bat, &after, &[0.1, 0.2, 0.5], 0.02);
        let motion = Motion {
            edits: vec![],
            modes: 1,
            theory: "timoshenko",
            rigid_motion: true,
            at_m: None,
            impulse_n_s: None,
            x_m: vec![0.0, 0.4, 0.8],
            times_s: (0..9).map(|k| 1e-3 * f64::from(k)).collect(),
            deflection_m: (0..9).map(|k| vec![0.0, 1e-4 * f64::from(k), -2e-4]).collect(),
        };
        for (us, paper) in sheets {
            let sheet = Sheet { us, paper };
            let name = bat.name();
            let mut all = vec![];
            for measured in [&[][..], &values[3..]] {
                let (kind, at, to) = (ResponseKind::Mobility, 0.7, 0.1);
                let (values, peaks) = (&values[..], &peaks[..]);
                let subject =
                    response::ResponseCurves { bat: name, kind, at, to, values, peaks, measured };
                all.push(response::picture(sheet, &subject, "response").unwrap());
            }
            let drawn = ringing::after_hit(sheet, &after, &report);
            let names: Vec<&str> = drawn.iter().map(|picture| picture.name.as_str()).collect();
            assert_eq!(names, ["motion", "spectrum", "strain"]);
            all.extend(drawn);
            all.extend(ringing::moving(sheet, name, &motion));
            for picture in all {
                check(&picture, name);
                assert_eq!(picture.drawing.width, sheet.width());
                let document = Document::parse(&picture.svg).unwrap();
                let metric = texts(&document).iter().any(|(words, _)| words.contains("(cm)"));
                assert!(!(us && metric), "{name} {}", picture.name);
            }
        }
    }
}
