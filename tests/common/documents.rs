//! A document of every format that the program writes, and the commands that make them.

use std::io::BufRead;

use serde_json::Value;

use super::folder::Folder;

/// The repeatability of the numbers of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numbers {
    /// To the requested accuracy.
    Sharp,
    /// To a thousandth: places of flat maxima, motions in time.
    Rough,
    /// Times, and values that follow from times.
    Times,
}

/// One document: its name, its format, the command without the output path, and the repeatability of its numbers.
pub type Written = (&'static str, &'static str, &'static str, Numbers);

/// The written formats, in the folder of [`folder`].
pub const WRITTEN: [Written; 26] = [
    (
        "modes",
        "modes",
        "modes bat-1.json -n 2 --tol 1e-9 --theory timoshenko --shape-points 3",
        Numbers::Sharp,
    ),
    (
        "modes-proven",
        "modes",
        "modes r161.json -n 2 --tol 1e-9 --guarantee --within 0.1mm,2% --shape-points 2",
        Numbers::Sharp,
    ),
    (
        "hit",
        "hit",
        "hit bat-1.json -n 2 --tol 1e-8 --theory timoshenko --from 0.6 --to 0.7 --points 2 --ball ball-1.json --wall-stiffness 5e6 --wall-mass 0.05 --reference-inertia 0.2 --swing-exponent 0.3 --swing-speed 50 --pitch 40.2336",
        Numbers::Sharp,
    ),
    (
        "analysis",
        "analysis",
        "analyze r161.json --tol 1e-3 --reproducible --swing-speed 50 --pitch 40.2336",
        Numbers::Rough,
    ),
    ("bbcor", "bbcor", "bbcor dowel.json --tol 1e-4", Numbers::Rough),
    ("hoop", "hoop", "hoop bbcor_made_up_open.json --shape-points 3 --wall-sweep", Numbers::Rough),
    (
        "lathe",
        "lathe",
        "lathe r161.json --tol 1e-3 --theory timoshenko --bands 0.12 --reference-inertia 0.2 --swing-exponent 0.3 --swing-speed 50 --pitch 40.2336 --outputs mass_kg,f1_hz,node_mode_1_m,exit_speed_max.x_m,exit_speed_m_s@0.7,vibration_min.value",
        Numbers::Rough,
    ),
    (
        "compare",
        "compare",
        "compare r161.json bat-1.json --tol 1e-3 --wall-stiffness 5e6 --reference-inertia 0.2 --swing-exponent 0.3 --swing-speed 50 --pitch 40.2336",
        Numbers::Rough,
    ),
    (
        "measured",
        "measured",
        "compare r161.json --measured lab.csv -n 3 --tol 1e-6",
        Numbers::Rough,
    ),
    (
        "ring",
        "ring",
        "ring bat-1.json --hit 0.6 -n 3 --tol 1e-6 --ball ball-1.json --swing-speed 50 --pitch 40.2336",
        Numbers::Rough,
    ),
    (
        "ring-motion",
        "ring",
        "ring dowel.json --at 0.6 --impulse 1 -n 2 --tol 1e-8 --shape-points 3",
        Numbers::Sharp,
    ),
    (
        "frf",
        "frf",
        "frf dowel.json --at 0.3 --to 0.1 --frequencies 100,200 -n 2 --tol 1e-8",
        Numbers::Sharp,
    ),
    (
        "frf-mobility",
        "frf",
        "frf dowel.json --at 0.3 --to 0.1 --frequencies 100,200 -n 2 --tol 1e-8 --kind mobility",
        Numbers::Sharp,
    ),
    (
        "frf-accelerance",
        "frf",
        "frf dowel.json --at 0.3 --to 0.1 --frequencies 100,200 -n 2 --tol 1e-8 --kind accelerance",
        Numbers::Sharp,
    ),
    (
        "frf-peaks",
        "frf",
        "frf lossy.json --at 0.3 --to 0.1 --from-hz 50 --to-hz 2000 --points 2 -n 3 --tol 1e-8",
        Numbers::Rough,
    ),
    (
        "frf-measured",
        "frf",
        "frf lossy.json --measured tap.uff --points 3 -n 3 --tol 1e-8",
        Numbers::Rough,
    ),
    (
        "frf-set",
        "frf-set",
        "frf lossy.json --measured taps.uff --points 3 -n 3 --tol 1e-8",
        Numbers::Rough,
    ),
    (
        "aimed",
        "aimed",
        "aim r161.json aim-1.json --tol 1e-3 --swing-speed 50 --pitch 40.2336",
        Numbers::Rough,
    ),
    ("calibrate", "calibrate", "calibrate r161.json readings-1.json", Numbers::Rough),
    ("tap", "tap", "tap r161.json taps.wav", Numbers::Rough),
    (
        "identify",
        "identify",
        "identify --simulate lossy.json --points 5 --to-hz 1200 --noise -60",
        Numbers::Rough,
    ),
    (
        "scatter-result",
        "scatter-result",
        "scatter r161.json scatter-1.json --points 64",
        Numbers::Rough,
    ),
    ("advice", "advice", "advise r161.json -n 2 --tol 1%", Numbers::Rough),
    ("trade", "trade", "trade dowel.json -n 2 --budget 200ms", Numbers::Times),
    ("u-curve", "u-curve", "trade dowel.json -n 2 --budget 200ms --u-curve", Numbers::Times),
    ("materials", "materials", "materials", Numbers::Sharp),
];

const MEASURED: &str = "x_in,mode_1,mode_2\nfrequency_hz,178.2,583.0\ndamping_ratio,0.004,0.005\n\
    0,1.00,0.90\n3,0.55,0.12\n15,-0.5,0.3\n33,0.41,0.37\n";

const LOSSY: &str = r#"{ "format": "sweetspot-bat/1", "profile": { "x": [0, 0.8], "radius": [0.02, 0.03] },
    "material": { "density": 700, "youngs_modulus": 14e9, "shear_modulus": 1e9, "loss_factor": 0.02 } }"#;

/// A folder with the files that the commands read.
pub fn folder(test: &str) -> Folder {
    let folder = Folder::new(test);
    folder.write("bat-1.json", include_str!("../golden/bat-1.json"));
    folder.write("ball-1.json", include_str!("../golden/ball-1.json"));
    folder.write("dowel.json", include_str!("../../meshes/dowel.json"));
    let open = include_str!("../../meshes/bbcor_made_up_open.json");
    folder.write("bbcor_made_up_open.json", open);
    folder.write("r161.json", include_str!("../../meshes/r161.json"));
    folder.write("lab.csv", MEASURED);
    folder.write("lossy.json", LOSSY);
    let tap = include_str!("../golden/tap.uff");
    folder.write("tap.uff", tap);
    let begins = tap.rfind("    -1\n    58\n").unwrap();
    folder.write("taps.uff", tap.to_owned() + &tap[begins..]);
    folder.write("aim-1.json", include_str!("../golden/aim-1.json"));
    folder.write("taps.wav", include_bytes!("../golden/taps.wav"));
    folder.write("readings-1.json", include_str!("../golden/readings-1.json"));
    folder.write("scatter-1.json", include_str!("../golden/scatter-1.json"));
    folder.write("study-1.json", include_str!("../golden/study-1.json"));
    folder
}

/// The present output of the program.
pub fn written(folder: &Folder, (_, _, command, _): Written) -> Value {
    let args: Vec<&str> = command.split(' ').chain(["--json", "-"]).collect();
    folder.json(&args)
}

/// The document of the mistakes in a bat, `sweetspot-error/1`: the last line on standard error.
pub fn error(folder: &Folder) -> Value {
    folder.write("wrong.json", WRONG);
    let output = folder.run(&["modes", "wrong.json", "--json", "-"]);
    assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{output:?}");
    serde_json::from_slice(output.stderr.lines().last().unwrap().unwrap().as_bytes()).unwrap()
}

const WRONG: &str = r#"{ "format": "sweetspot-bat/1",
  "profile": { "unit": "in", "x": [0, 33], "diameter": [1.0, "2 lb"] },
  "material": { "density": -5, "youngs_modulos": 14e9 } }"#;

/// The data of a report, `sweetspot-page/1`.
pub fn page(folder: &Folder) -> Value {
    folder.text(&[
        "analyze",
        "r161.json",
        "--tol",
        "1e-3",
        "--report",
        "page.html",
        "--swing-speed",
        "50",
        "--pitch",
        "40.2336",
    ]);
    let page = folder.read("page.html");
    let (_, data) = page.split_once("id=\"data\">").unwrap();
    serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap()
}

/// The manifest of a study, `sweetspot-study-manifest/1`.
pub fn manifest(folder: &Folder) -> Value {
    // It has every possible member, among them some without effect, which cause warnings.
    assert!(folder.run(&["study", "study-1.json", "--out", "study"]).status.success());
    serde_json::from_str(&folder.read("study/manifest.json")).unwrap()
}
