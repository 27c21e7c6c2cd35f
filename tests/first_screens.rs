//! No first screen is more certain than the full output.

use crate::common;

use common::commands::{wider, words};
use common::folder::Folder;
use serde_json::Value;

const EXACT: &str = "far more exact";

/// The built-in bats by their names.
fn built_in() -> Vec<String> {
    let meshes = concat!(env!("SWEETSPOT_TOP"), "/meshes");
    let name = |entry: std::io::Result<std::fs::DirEntry>| {
        entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned()
    };
    std::fs::read_dir(meshes).unwrap().map(name).collect()
}

/// An answer in `open`: its value and deviation.
fn answer(analysis: &Value, name: &str) -> [f64; 2] {
    let all = analysis["open"]["answers"].as_array().unwrap();
    let one = all.iter().find(|one| one["answer"] == name).unwrap();
    ["value", "standard_deviation"].map(|member| one[member].as_f64().unwrap())
}

fn plain(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Any doubt that `--full` or `hit` reports is also on the first screen, whose ± includes the uncertainty of the ball
/// patch; and nothing doubtful is called exact.
#[test]
fn no_first_screen_is_more_certain_than_full_or_hit() {
    let folder = Folder::new("first-screens");
    for bat in built_in() {
        let of = |args: &[&str]| plain(&folder.text(&[args, &["--quiet"]].concat()));
        let screen = of(&["analyze", &bat, "--json", "analysis.json"]);
        let others = [of(&["analyze", &bat, "--full"]), of(&["hit", &bat, "--points", "5"])];
        assert!(!screen.contains("adds nothing") && screen.contains("f1, "), "{bat}: {screen}");
        for last in &others {
            for (said, also) in [
                ("this theory ends", "this theory ends"),
                ("is rigid here", "hollow barrel's wall gives way"),
                ("no material of bats", "no material of bats"),
            ] {
                let small = last.contains("less than the");
                let missing = last.contains(said) && !small && !screen.contains(also);
                assert!(!missing, "{bat}: {said}\n{screen}");
            }
            let doubted = ["this theory ends", "is rigid here", "NOT met"];
            let doubted =
                doubted.iter().any(|doubt| last.contains(doubt)) && !last.contains("less than the");
            assert!(!(doubted && screen.contains(EXACT)), "{bat}: {screen}");
        }
        let analysis: Value = serde_json::from_str(&folder.read("analysis.json")).unwrap();
        for name in ["best_place_m", "exit_speed_m_s", "frequency_1_hz", "mass_kg"] {
            let [value, deviation] = answer(&analysis, name);
            assert!(deviation > 0.0 && deviation < value, "{bat}: {name} {deviation}");
        }
        let wall = &analysis["hit"]["figures"]["wall"];
        if wall.is_object() {
            // v = e_A (v_bat + v_ball) + v_bat, BBCOR = e_A (1 + r) + r: a range of BBCOR gives a range of the speed.
            let best = &analysis["hit"]["sweet_spot"]["exit_speed_max"];
            let impacts = analysis["hit"]["impacts"].as_array().unwrap();
            let x = best["x_m"].as_f64().unwrap();
            let off = |impact: &Value| (impact["x_m"].as_f64().unwrap() - x).abs();
            let near = impacts.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
            let [bbcor, e] = ["bbcor", "collision_efficiency"].map(|of| near[of].as_f64().unwrap());
            let r = (bbcor - e) / (1.0 + e);
            let bat_speed = near["bat_speed_m_s"].as_f64().unwrap();
            let closing = bat_speed + analysis["hit"]["scene"]["ball_speed_m_s"].as_f64().unwrap();
            let range = wall["bbcor"]["range"].as_array().unwrap();
            let [low, high] = [0, 1].map(|k| range[k].as_f64().unwrap());
            let half = 0.5 * (high - low) / (1.0 + r) * closing;
            let [_, open] = answer(&analysis, "exit_speed_m_s");
            assert!(open > 0.9 * half, "{bat}: {open} {half}");
        }
    }
}

fn aluminium(weighed: &str, wall: &str) -> String {
    format!(
        r#"{{ "format": "sweetspot-bat/1", "material": "aluminium-7075", {weighed}
            "profile": {{ "unit": "in", "x": [0, 12, 23, 33], "diameter": [0.9, 0.9, 2.6, 2.6]{wall} }} }}"#
    )
}

#[test]
fn a_density_far_from_its_material_s_is_said_by_every_verb_and_asks_for_the_wall() {
    let folder = Folder::new("density");
    folder.write("solid.json", aluminium(r#""weighed": { "mass": "30 oz" },"#, ""));
    let wood = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "weighed": { "mass": "8 kg" }, "profile": { "x": [0, 0.84], "diameter": [0.05, 0.05] } }"#;
    folder.write("heavy.json", wood);
    let own = r#"{ "format": "sweetspot-bat/1", "material": { "density": 4790, "youngs_modulus": 12e9 },
        "profile": { "x": [0, 0.84], "diameter": [0.03, 0.03] } }"#;
    folder.write("own.json", own);
    let tube = r#", "wall_thickness": ["3 mm", "3 mm", "3 mm", "3 mm"]"#;
    folder.write("hollow.json", aluminium("", tube));
    // On the screen, or beside it.
    let said = |args: &[&str]| {
        let output = folder.run(args);
        plain(&String::from_utf8_lossy(&[output.stdout, output.stderr].concat()))
    };
    for (bat, word) in [
        ("solid.json", "\"wall_thickness\" in \"profile\""),
        ("heavy.json", "far from the 649 kg/m³"),
        ("own.json", "no material of bats"),
    ] {
        for args in [
            &["analyze", bat][..],
            &["modes", bat],
            &["hit", bat, "--points", "3"],
            &["compare", bat, "r161"],
            &["ring", bat, "--at", "0.6", "--impulse", "1", "--json", "-"],
        ] {
            let told = said(args);
            assert!(told.contains(word), "{args:?}: {told}");
        }
        let screen =
            plain(&String::from_utf8_lossy(&folder.run(&["analyze", bat, "--quiet"]).stdout));
        assert!(screen.contains("Look at the file: ") && screen.contains(word), "{screen}");
        assert!(!screen.contains(EXACT), "{screen}");
    }
    // A metal tube and wood of usual scatter cause no message.
    let beside = |args: &[&str]| plain(&String::from_utf8_lossy(&folder.run(args).stderr));
    assert_eq!(beside(&["modes", "hollow.json"]), "");
    for mass in ["26 oz", "33 oz"] {
        let wood = format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "weighed": {{ "mass": "{mass}" }},
                "profile": {{ "unit": "in", "x": [0, 6, 20, 27, 33],
                    "diameter": [1.0, 0.9, 1.6, 2.45, 2.55] }} }}"#
        );
        folder.write("wood.json", wood);
        assert_eq!(beside(&["modes", "wood.json"]), "", "{mass}");
    }
}

/// A reading rounded to a step is uniformly distributed within half of it: `step/√12`.
#[test]
fn diameters_read_to_a_sixteenth_are_off_by_its_share_and_a_person_may_say_otherwise() {
    let folder = Folder::new("sixteenths");
    let bat = |diameters: &str| {
        format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "weighed": {{ "mass": "31 oz" }},
                "profile": {{ "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [{diameters}] }} }}"#
        )
    };
    let fractions = r#""1 3/4 in", "15/16 in", "1 9/16 in", "2 7/16 in", "2 9/16 in""#;
    for (diameters, step, name) in [
        (fractions, 0.0254 / 16.0, "1/16 in"),
        ("1.75, 0.9375, 1.5625, 2.4375, 2.5625", 0.0254 / 16.0, "1/16 in"),
        (
            r#""1.75 in", "31/32 in", "1 9/16 in", "2 7/16 in", "2 9/16 in""#,
            0.0254 / 32.0,
            "1/32 in",
        ),
        (r#""44 mm", "24 mm", "40 mm", "62 mm", "65 mm""#, 1e-3, "1 mm"),
        ("1.752, 0.941, 1.571, 2.443, 2.559", 1e-4 * 12f64.sqrt(), ""),
    ] {
        folder.write("bat.json", bat(diameters));
        let json = folder.json(&["analyze", "bat.json", "--json", "-", "--quiet"]);
        let sources = json["open"]["sources"].as_array().unwrap();
        let of = sources.iter().find(|source| source["input"] == "diameters").unwrap();
        let found = of["standard_deviation"].as_f64().unwrap();
        assert!((found / (step / 12f64.sqrt()) - 1.0).abs() < 1e-9, "{diameters}: {found}");
        let screen = plain(&folder.text(&["analyze", "bat.json", "--quiet"]));
        let word =
            if name.is_empty() { "calipers are off by 0.0039 in" } else { "diameters read to " };
        assert!(screen.contains(word) && screen.contains(name), "{screen}");
    }
    folder.write("bat.json", bat(fractions));
    let told = folder.text(&["analyze", "bat.json", "--quiet", "--calipers", "0.05 mm"]);
    assert!(plain(&told).contains("calipers are off by 0.0020 in"), "{told}");
}

const LOOSE: &str = r#"{ "format": "sweetspot-study/1", "bat": "r161", "points": 8,
    "vary": { "bat.material.density": { "lognormal": [650, 0.04] } }, "outputs": ["f1_hz", "mass_kg"] }"#;

/// Verbs with screens of 40 lines.
const TALL: [&str; 5] = ["hit", "modes", "lathe", "frf", "validate"];

/// Requests for each of two bats; `BAT` stands for the name.
const OF_BATS: [&str; 23] = [
    "hit BAT",
    "hit BAT --model pulse",
    "hit BAT --model energy-loss",
    "hit BAT --wall off",
    r#"hit BAT --hands "6 in" --units us"#,
    r#"hit BAT --pitch "95 mph""#,
    "modes BAT",
    "modes BAT -n 20",
    "modes BAT -n 60",
    "lathe BAT",
    r#"frf BAT --at "28 in" --to "2 in""#,
    "bbcor BAT",
    "identify --simulate BAT",
    r#"ring BAT --hit "60 cm""#,
    r#"ring BAT --hit "60 cm" --watch "2 in,4 in,6 in,8 in""#,
    "advise BAT",
    "advise BAT -n 10",
    r#"trade BAT --budget "300 ms""#,
    r#"trade BAT --u-curve --budget "300 ms""#,
    r#"aim BAT --target "mass -2 %" --rules ncaa"#,
    "compare BAT torpedo --units si",
    "analyze BAT",
    "analyze BAT --report page.md --plots pictures --out files",
];

/// Requests for other bats.
const OF_OTHERS: [&str; 38] = [
    "analyze cone --report page.md",
    "analyze corked --model pulse",
    "analyze two_piece --model rigid --report page.md",
    "analyze r161 --guarantee",
    "analyze long.json",
    "modes r161 --guarantee",
    "modes two_piece --guarantee",
    "modes composite_made_up",
    "modes long.json",
    r#"hit corked --swing-speed "55 rad/s""#,
    "hit dowel",
    "hit two_piece -n 3",
    "lathe torpedo",
    "lathe house",
    "lathe two_piece --units si",
    "lathe r161 --outputs f1_hz",
    r#"lathe r161 --depth "1 mm" --units us"#,
    "advise two_piece -n 10",
    "hoop bbcor_made_up",
    "hoop two_piece -n 10",
    "hoop two_piece -n 10 --wall-sweep",
    r#"ring corked --hit "65 cm""#,
    "scatter r161 --points 64",
    r#"aim northwestern_aluminium --target "swing weight -3 %""#,
    r#"aim bbcor_made_up_open --target "mass -2 %""#,
    "compare r161 bbcor_made_up_open",
    r#"compare house corked --hands "6 in""#,
    "compare northwestern_aluminium northwestern_wood",
    "compare r161 torpedo house",
    "compare cone tanh dowel --units us",
    "compare r161 bbcor_made_up_open softball_made_up two_piece",
    "compare r161 torpedo house corked cone --model pulse",
    "compare r161 northwestern_aluminium northwestern_wood dowel cone tanh",
    "compare r161 bbcor_made_up_open composite_made_up two_piece softball_made_up_open corked",
    "compare long.json r161 torpedo",
    "compare r161 --measured modes.uff",
    "compare torpedo --measured modes.uff",
    "calibrate torpedo modes.uff",
];

/// The violation of a screen: lines, columns, no reference to `--full`, or, where it is asked for, a `--full` without
/// more.
fn over(folder: &Folder, command: &str, full: bool) -> Option<String> {
    let args = words(command);
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let text = |more: &[&str]| {
        let output = folder.run(&[&args[..], &["--quiet"], more].concat());
        assert!(output.status.code().is_some_and(|code| code < 2), "{command}: {output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let screen = text(&[]);
    let most = if TALL.contains(&args[0]) { 40 } else { 24 };
    let (lines, wide) = (screen.lines().count(), wider(&screen, 80));
    let said = screen.contains("verything else: --full") || screen.contains("All else: --full");
    let more = || !full || text(&["--full"]).lines().count() >= lines;
    let good = lines <= most && wide.is_empty() && said && more();
    (!good).then(|| format!("{command}: {lines} lines, {most} at most\n{screen}"))
}

/// A verb has at most 24 lines of 80 columns, or 40 for five of them, and says where the rest is.
#[test]
fn a_screen_is_a_screen_and_full_has_the_rest() {
    let folder = Folder::new("screens");
    let named =
        "A bat of an ash that somebody turned in a barn on a winter day, and that nobody has swung";
    let text = std::fs::read_to_string(concat!(env!("SWEETSPOT_TOP"), "/meshes/r161.json"));
    folder.write("long.json", text.unwrap().replace("Louisville Slugger R161", named));
    folder.text(&["modes", "r161", "--json", "modes.json", "--quiet"]);
    folder.run(&["convert", "modes.json", "--to", "uff", "--out", "modes.uff"]);
    let of_bats = ["r161", "bbcor_made_up"]
        .into_iter()
        .flat_map(|bat| OF_BATS.map(|command| command.replace("BAT", bat)));
    // The omitted parts are checked on one bat of each kind.
    let commands = of_bats.map(|command| (command, true));
    let commands = commands.chain(OF_OTHERS.map(|command| (command.to_owned(), false)));
    let faults = commands.filter_map(|(command, full)| over(&folder, &command, full));
    let faults: Vec<String> = faults.collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The parts omitted from a screen are named where it refers to `--full`, which has them in full.
#[test]
fn what_is_cut_short_is_named_and_full_has_it() {
    let folder = Folder::new("cut-short");
    for (args, named, cut) in [
        (&["modes", "composite_made_up", "-n", "20"][..], "nodes, damping. ", "    20       17720"),
        (&["hit", "corked"], "modes left out", "20 modes; what is left out"),
        (&["compare", "cone", "tanh", "dowel"], "where along the barrel, trust. ", "By distance"),
        (&["hoop", "two_piece", "--wall-sweep"], "what the wall does. ", "Barrel compression"),
        (&["aim", "northwestern_aluminium", "--target", "mass -2 %"], "cuts. ", "--cuts FILE"),
    ] {
        let screen = folder.text(&[args, &["--quiet"]].concat());
        let last = screen.lines().last().unwrap();
        let told = format!("Cut short: {named}");
        assert!(last.starts_with(&told) && last.ends_with("Everything else: --full"), "{screen}");
        let full = folder.text(&[args, &["--quiet", "--full"]].concat());
        assert!(full.contains(cut) && !full.contains("Cut short"), "{args:?}: {full}");
    }
}

#[test]
fn what_was_asked_for_is_all_there() {
    let folder = Folder::new("asked");
    let lines = |args: &[&str]| folder.text(args).lines().count();
    let rows = |points: &str| lines(&["hit", "r161", "--points", points]);
    assert_eq!(rows("90") - rows("80"), 10);
    let rows = |points: &str| lines(&["frf", "r161", "--at", "0.6", "--points", points]);
    assert_eq!(rows("90") - rows("80"), 10);
    let ten = folder.text(&["hoop", "bbcor_made_up", "-n", "10"]);
    assert_eq!(ten.lines().filter(|line| line.contains("within")).count(), 10);
    assert!(lines(&["bats"]) <= 24);
    assert!(lines(&["compare", "r161", "torpedo", "house", "two_piece"]) <= 24);
    folder.write("loose.json", LOOSE);
    assert!(lines(&["study", "loose.json", "--out", "loose"]) <= 24);
    assert!(lines(&["study", "loose.json", "--out", "loose", "--summary"]) <= 24);
    for mass in ["31 oz", "8 oz"] {
        let made =
            ["new", "made.json", "--force", "--name", "M", "--length", "33 in", "--mass", mass];
        let args = [&made[..], &["--material", "white-ash", "--like", "r161"]].concat();
        assert!(lines(&args) <= 24, "{mass}");
    }
}

/// Known answers: counts, every miss and the worst of each kind on a screen, every number with `--full`.
#[test]
fn known_answers_have_a_screen_and_full_has_every_one() {
    let folder = Folder::new("known");
    let screen = folder.text(&["validate"]);
    assert!(screen.lines().count() <= 40 && screen.ends_with("--full\n"), "{screen}");
    assert!(screen.contains(" rows, 0 missed; ") && screen.contains("\nf… Hz "), "{screen}");
    let full = folder.text(&["validate", "--full"]);
    assert!(full.lines().count() > 3000 && full.contains("(r161_nathan)"));
    let counts = |text: &str| text.lines().find(|line| line.contains(" rows, ")).map(str::to_owned);
    assert_eq!(counts(&screen), counts(&full));
}

/// A note of another octave or mode, or a misplaced decimal point: a doubt about the resulting stiffness is reported. A
/// stiffness that wood might almost have (3.8 GPa) leaves the density as uncertain as before; above 60 GPa the scatter
/// of the density is unknown.
#[test]
fn a_note_that_no_wood_of_its_kind_has_is_doubted() {
    let folder = Folder::new("wrong-note");
    let text =
        std::fs::read_to_string(concat!(env!("SWEETSPOT_TOP"), "/meshes/r161.json")).unwrap();
    let mass = |hertz: &str| {
        let weighed = format!(r#"{{ "weighed": {{ "first_bending_hz": {hertz} }},"#);
        folder.write("noted.json", text.replacen('{', &weighed, 1));
        let screen = plain(&folder.text(&["analyze", "noted.json", "--quiet", "--json", "a.json"]));
        let analysis: Value = serde_json::from_str(&folder.read("a.json")).unwrap();
        let [value, deviation] = answer(&analysis, "mass_kg");
        (deviation / value, screen)
    };
    let (usual, screen) = mass("174.5");
    assert!(!screen.contains("Young's modulus must be"), "{screen}");
    for hertz in ["80", "349", "581.3"] {
        let (share, screen) = mass(hertz);
        assert!(
            screen.contains("Young's modulus must be") && !screen.contains(EXACT),
            "{hertz}: {screen}"
        );
        assert!((share / usual - 1.0).abs() < 0.05 || hertz != "80", "{hertz}: {share} {usual}");
    }
}

/// A bat that flies turns ever further from the swing: at its ends the largest displacement is the last one.
#[test]
fn a_displacement_that_still_grows_has_no_largest() {
    let folder = Folder::new("growing");
    let hit = ["ring", "r161", "--hit", "70 cm", "--watch"];
    let of = |place: &str| folder.text(&[&hit[..], &[place]].concat());
    assert!(of("84 cm").contains(") and growing\n"), "{}", of("84 cm"));
    assert!(!of("15.24 cm").contains("growing"));
}
