//! Results of `sweetspot tap` for recordings made by the program or from a closed form, and its refusals.

use std::io::Write;
use std::process::Stdio;

use serde_json::Value;
use sweetspot_report::exchange::wav::{self, RATE};

use crate::common::folder::Folder;

/// Samples of a file of one channel of 16 bits, as the program writes it.
fn samples(file: &[u8]) -> Vec<f64> {
    let pairs = file[44..].chunks_exact(2);
    pairs.map(|b| f64::from(i16::from_le_bytes([b[0], b[1]])) / 32768.0).collect()
}

/// Even noise from -1 to 1.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1_u64 << 30) as f64 - 1.0
    }
}

/// The output of a run, whatever its exit code.
fn heard(folder: &Folder, args: &[&str]) -> (Value, i32) {
    let output = folder.run(&[args, &["--json", "-"]].concat());
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    let code = output.status.code().unwrap();
    (serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{args:?}: {told}")), code)
}

/// Four taps, a second apart, of tones of a loss factor of 0.004.
fn taps(tones: &[f64]) -> Vec<f64> {
    let tap = |n: usize, k: usize| -> f64 {
        let t = n as f64 / f64::from(RATE);
        let one = |(j, hz): (usize, &f64)| {
            let phase = (7 * k + 3 * j) as f64;
            let size = (0.6 + 0.12 * ((k + j) % 3) as f64) / tones.len() as f64;
            size * (-std::f64::consts::PI * hz * 0.004 * t).exp()
                * (std::f64::consts::TAU * hz * t + phase).sin()
        };
        tones.iter().enumerate().map(one).sum()
    };
    let rung = (0..4).flat_map(|k| (0..RATE as usize).map(move |n| (n, k)));
    let mut all = vec![0.0; RATE as usize / 2];
    all.extend(rung.map(|(n, k)| tap(n, k)));
    all
}

const LOSSY: &str = r#"{ "format": "sweetspot-bat/1", "name": "Lossy", "profile": { "unit": "in",
    "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] },
    "material": { "density": 650, "youngs_modulus": 18e9, "shear_modulus": 1.1e9, "loss_factor": 0.01 } }"#;

/// The sound that `ring` makes is recognised: its modes, their frequencies within 0.02 % and their loss factor within 2
/// %. Its moduli are constant, and the intervals hold them. The written bat has no note that was not recorded.
#[test]
fn a_bat_that_rings_is_heard_again() {
    let folder = Folder::new("tap_ring");
    folder.write("bat.json", LOSSY);
    let ring =
        ["ring", "bat.json", "--at", "33in", "--impulse", "0.2", "--wav", "one.wav", "--json", "-"];
    folder.json(&ring);
    let one = samples(&std::fs::read(folder.0.join("one.wav")).unwrap());
    let mut noise = noise(3);
    let mut all: Vec<f64> = (0..4 * RATE as usize).map(|_| 1e-3 * noise()).collect();
    for tap in 0..3 {
        let from = (0.5 * f64::from(RATE)) as usize + tap * RATE as usize;
        let room = RATE as usize - 2000;
        all[from..].iter_mut().zip(one.iter().take(room)).for_each(|(sum, x)| *sum += 0.9 * x);
    }
    folder.write("taps.wav", wav::file(&all));
    let modes = folder.json(&["modes", "bat.json", "-n", "9", "--json", "-"]);
    let (found, _) = heard(&folder, &["tap", "bat.json", "taps.wav", "--out", "mine.json"]);
    let tones = found["tones"].as_array().unwrap();
    for (name, exact) in [("youngs_modulus", 18e9), ("shear_modulus", 1.1e9)] {
        let all = found["wood"]["parameters"].as_array().unwrap();
        let one = all.iter().find(|one| one["name"] == name).unwrap();
        let [low, high] = [0, 1].map(|k| one["interval95"][k].as_f64().unwrap());
        assert!(low < exact && exact < high, "{one:#}");
        let by = 0.5 * (high - low) / one["value"].as_f64().unwrap()
            - 1.96 * one["relative_sd"].as_f64().unwrap();
        assert!(by.abs() < 2e-3, "{one:#}");
    }
    let mine: Value = serde_json::from_str(&folder.read("mine.json")).unwrap();
    if let Some(note) = mine["weighed"]["first_bending_hz"].as_f64() {
        let [low, high] = [0, 1].map(|k| tones[0]["frequency_interval95_hz"][k].as_f64().unwrap());
        assert!(low <= note && note <= high, "{note}: {:#}", tones[0]);
    }
    for mode in modes["modes"].as_array().unwrap() {
        let exact = mode["frequency_hz"].as_f64().unwrap();
        let off = |tone: &&Value| (tone["frequency_hz"].as_f64().unwrap() / exact - 1.0).abs();
        let tone = tones.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
        assert!(off(&tone) < 2e-4, "{exact}: {tone:#}");
        let loss = tone["loss_factor"].as_f64().unwrap();
        assert!((loss / 0.01 - 1.0).abs() < 0.02, "{exact}: {loss}");
    }
}

/// Of twelve modes of a bat ten are labelled, and the others are not called strangers.
#[test]
fn tones_that_were_not_tried_are_not_called_strange() {
    let folder = Folder::new("tap_untried");
    let modes = folder.json(&["modes", "r161", "-n", "12", "--json", "-"]);
    let modes = modes["modes"].as_array().unwrap();
    let tones: Vec<f64> = modes.iter().map(|one| one["frequency_hz"].as_f64().unwrap()).collect();
    folder.write("taps.wav", wav::file(&taps(&tones)));
    let (found, code) = heard(&folder, &["tap", "r161", "taps.wav"]);
    assert_eq!(code, 0, "{found:#}");
    let heard = found["tones"].as_array().unwrap();
    let untried = heard.iter().filter(|tone| tone["tried"] == false).count();
    assert_eq!((heard.len(), untried), (12, 2), "{found:#}");
    let text =
        String::from_utf8(folder.run(&["tap", "r161", "taps.wav", "--full"]).stdout).unwrap();
    assert_eq!(text.matches("not labelled").count(), 2, "{text}");
    assert!(!text.contains("no mode of this bat") && text.contains("Other verbs"), "{text}");
}

/// Tones of the R161 as in its file: labels, E within 2 % of that in the file, and a bat with that wood that can be
/// read back.
#[test]
fn labels_and_wood_follow_from_the_tones() {
    let folder = Folder::new("tap_labels");
    folder.write("taps.wav", include_bytes!("golden/taps.wav"));
    let args = ["tap", "r161", "taps.wav", "--out", "mine.json", "--readings", "lines.json"];
    let (found, code) = heard(&folder, &args);
    assert_eq!(code, 0, "{found:#}");
    let tones = found["tones"].as_array().unwrap();
    assert_eq!(tones.len(), 5, "{found:#}");
    for (k, tone) in tones.iter().enumerate() {
        assert_eq!(tone["mode"]["order"], k + 1, "{tone:#}");
    }
    let modulus = |found: &Value| found["parameters"][0]["value"].as_f64().unwrap();
    assert!((modulus(&found["wood"]) / 18.14e9 - 1.0).abs() < 0.02, "{found:#}");
    let wood =
        folder.json(&["calibrate", "r161", "lines.json", "--hold", "density", "--json", "-"]);
    assert!((modulus(&wood) / modulus(&found["wood"]) - 1.0).abs() < 1e-6);
    let again = folder.json(&["calibrate", "r161", "taps.wav", "--hold", "density", "--json", "-"]);
    assert!((modulus(&again) / modulus(&found["wood"]) - 1.0).abs() < 1e-6);
    let first = folder.json(&["modes", "mine.json", "-n", "1", "--json", "-"]);
    let hz = first["modes"][0]["frequency_hz"].as_f64().unwrap();
    assert!((hz / 174.51 - 1.0).abs() < 5e-3, "{hz}");
    let told = folder.run(&["tap", "r161", "taps.wav", "--mode", "900 = 3"]);
    assert!(String::from_utf8_lossy(&told.stderr).contains("one of the tones"), "{told:?}");
}

#[test]
fn what_is_no_tap_is_refused() {
    let folder = Folder::new("tap_refused");
    let count = 3 * RATE as usize;
    let mut noise = noise(5);
    let hum = |n: usize| 0.3 * (std::f64::consts::TAU * 50.0 * n as f64 / f64::from(RATE)).sin();
    let sounds: [(&str, Vec<f64>); 3] = [
        ("silence.wav", vec![0.0; count]),
        ("noise.wav", (0..count).map(|_| 0.1 * noise()).collect()),
        ("hum.wav", (0..count).map(|n| hum(n) + 1e-3 * (n as f64).sin()).collect()),
    ];
    for (name, sound) in sounds {
        folder.write(name, wav::file(&sound));
        let (found, code) = heard(&folder, &["tap", "r161", name]);
        assert_eq!((code, &found["refused"]["code"]), (1, &Value::from("no_tap")), "{name}");
    }
    // A copy of a recording holds no further taps.
    let one = wav::file(&taps(&[174.0, 581.0, 1187.0, 1858.0]));
    folder.write("one.wav", &one);
    folder.write("copy.wav", &one);
    for again in ["one.wav", "copy.wav"] {
        let told = folder.run(&["tap", "r161", "one.wav", again]);
        let said = String::from_utf8_lossy(&told.stderr);
        assert!(
            told.status.code() == Some(2) && said.contains(&format!("{again}: found the same"))
        );
    }
    folder.write("note.ogg", b"OggS\0\x02..........OpusHead");
    let told = folder.run(&["tap", "r161", "note.ogg"]);
    assert_eq!(told.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&told.stderr).contains("voice note (Opus)"), "{told:?}");
}

/// Two tones in one band, 1.5 to 8 % apart, are both found within 0.02 %, with equal strength.
#[test]
fn neighbours_are_both_heard() {
    let folder = Folder::new("tap_neighbours");
    for apart in [1.015, 1.035, 1.05, 1.08] {
        let tones = [300.0, 900.0, 2462.0, 2462.0 * apart];
        folder.write("taps.wav", wav::file(&taps(&tones)));
        let (found, _) = heard(&folder, &["tap", "r161", "taps.wav", "--only-tones"]);
        let found = found["tones"].as_array().unwrap();
        let found: Vec<f64> = found.iter().map(|t| t["frequency_hz"].as_f64().unwrap()).collect();
        assert_eq!(found.len(), 4, "{apart}: {found:?}");
        for (heard, hz) in found.iter().zip(tones) {
            assert!((heard / hz - 1.0).abs() < 2e-4, "{apart}: {heard} {hz}");
        }
    }
}

#[test]
fn a_part_that_is_none_is_refused_by_name() {
    let folder = Folder::new("tap_part");
    folder.write("taps.wav", include_bytes!("golden/taps.wav"));
    for (args, field) in [
        (["--from", "-1 s"], "--from"),
        (["--from", "1 h"], "s of sound"),
        (["--to", "0 s"], "--to"),
        (["--highest", "30 Hz"], "--highest"),
    ] {
        let told = folder.run(&[&["tap", "r161", "taps.wav"][..], &args].concat());
        let said = String::from_utf8_lossy(&told.stderr);
        assert!(told.status.code() == Some(2) && said.contains(field), "{args:?}: {said}");
    }
}

/// Two recordings in two planes of the grain, whose tones are 4 % apart: the tones of both are found, and a defect of
/// one of the two is reported with its name.
#[test]
fn two_recordings_keep_tones_of_their_own() {
    let folder = Folder::new("tap_planes");
    let one = [320.0, 910.0, 1730.0];
    let two = one.map(|hz| 1.04 * hz);
    folder.write("one.wav", wav::file(&taps(&one)));
    let hum = |n: usize| {
        let wave = |h: usize| (std::f64::consts::TAU * (50 * h * n) as f64 / f64::from(RATE)).sin();
        (1..12).map(|h| 0.01 * wave(h)).sum::<f64>()
    };
    let hummed: Vec<f64> = taps(&two).iter().enumerate().map(|(n, x)| x + hum(n)).collect();
    folder.write("two.wav", wav::file(&hummed));
    let (found, _) = heard(&folder, &["tap", "r161", "one.wav", "two.wav", "--only-tones"]);
    let heard = found["tones"].as_array().unwrap();
    let heard: Vec<f64> = heard.iter().map(|t| t["frequency_hz"].as_f64().unwrap()).collect();
    assert_eq!(heard.len(), 6, "{heard:?}");
    for hz in one.iter().chain(&two) {
        assert!(heard.iter().any(|heard| (heard / hz - 1.0).abs() < 1e-3), "{hz}: {heard:?}");
    }
    let said = found["warnings"].as_array().unwrap().iter();
    let said: Vec<&str> = said.map(|one| one["text"].as_str().unwrap()).collect();
    assert!(said.iter().any(|text| text.starts_with("two.wav: Hum")), "{said:?}");
    assert!(!said.iter().any(|text| text.starts_with("one.wav: Hum")), "{said:?}");
}

/// Tones of two planes of the grain less than 3 % apart, each in a recording of its own, are twins of one mode.
#[test]
fn near_planes_are_twins_of_one_mode() {
    let folder = Folder::new("tap_twins");
    let modes = folder.json(&["modes", "r161", "-n", "4", "--json", "-"]);
    let modes = modes["modes"].as_array().unwrap();
    let one: Vec<f64> = modes.iter().map(|mode| mode["frequency_hz"].as_f64().unwrap()).collect();
    let two: Vec<f64> = one.iter().map(|hz| 1.015 * hz).collect();
    folder.write("one.wav", wav::file(&taps(&one)));
    folder.write("two.wav", wav::file(&taps(&two)));
    let (found, code) = heard(&folder, &["tap", "r161", "one.wav", "two.wav"]);
    assert_eq!(code, 0, "{found:#}");
    let tones = found["tones"].as_array().unwrap();
    assert_eq!(tones.len(), 8, "{tones:#?}");
    for (k, pair) in tones.chunks(2).enumerate() {
        for (tone, hz) in pair.iter().zip([one[k], two[k]]) {
            assert!((tone["frequency_hz"].as_f64().unwrap() / hz - 1.0).abs() < 2e-4, "{tone:#}");
            assert_eq!(tone["mode"]["order"], k + 1);
        }
        assert_eq!(pair[0]["twin_hz"], pair[1]["frequency_hz"]);
    }
    // Taps exactly a second apart are no hum.
    assert_eq!(found["recordings"][0]["hum_hz"], Value::Null);
}

const FOIL: &str = r#"{ "format": "sweetspot-bat/1", "name": "Foil", "profile": { "unit": "in",
    "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5], "wall_thickness": [1e-5, 1e-5, 1e-5, 1e-5, 1e-5] },
    "material": { "density": 2700, "youngs_modulus": 70e9, "poisson_ratio": 0.33 } }"#;

#[test]
fn a_wall_that_cannot_be_solved_is_said() {
    let folder = Folder::new("tap_foil");
    folder.write("foil.json", FOIL);
    folder.write("taps.wav", include_bytes!("golden/taps.wav"));
    let (found, _) = heard(&folder, &["tap", "foil.json", "taps.wav"]);
    let codes: Vec<&Value> =
        found["warnings"].as_array().unwrap().iter().map(|one| &one["code"]).collect();
    assert!(codes.contains(&&Value::from("wall")), "{found:#}");
}

/// Tones of bending modes and of the lowest mode of the wall: a given label is kept, and does not change the others.
#[test]
fn what_is_told_takes_part_in_the_search_of_a_hollow_bat() {
    let folder = Folder::new("tap_told");
    let bat = "bbcor_made_up";
    let hertz = |found: &Value| -> Vec<f64> {
        let modes = found["modes"].as_array().unwrap().iter();
        modes.map(|mode| mode["frequency_hz"].as_f64().unwrap()).collect()
    };
    let bending = hertz(&folder.json(&["modes", bat, "-n", "4", "--json", "-"]));
    let wall = hertz(&folder.json(&["hoop", bat, "-n", "1", "--json", "-"]))[0];
    folder.write("taps.wav", wav::file(&taps(&[&bending[..], &[wall]].concat())));
    let label = |told: &str| {
        let (found, _) = heard(&folder, &["tap", bat, "taps.wav", "--mode", told]);
        let tones = found["tones"].as_array().unwrap().clone();
        move |hz: f64| {
            let off = |tone: &&Value| (tone["frequency_hz"].as_f64().unwrap() / hz - 1.0).abs();
            tones.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap().clone()
        }
    };
    let none = label(&format!("{wall:.1} = none"));
    assert_eq!(none(wall)["mode"], Value::Null);
    let third = label(&format!("{:.1} = 3", bending[2]));
    assert_eq!(third(wall)["mode"]["kind"], "hoop");
    for (k, hz) in bending.iter().enumerate() {
        assert_eq!(none(*hz)["mode"]["order"], k + 1);
        assert_eq!(third(*hz)["mode"]["order"], k + 1);
    }
    assert_eq!(third(bending[2])["sure"], 1.0);
}

/// `new` takes a note, or the recording of a bat whose lowest tone is that of the note.
#[test]
fn a_new_bat_is_tapped_by_a_note_or_a_recording() {
    let folder = Folder::new("tap_new");
    let file = |tone: &str, name: &str| {
        let answers =
            format!("Mine\nin\n33\n25 oz\nwhite-ash\n1.9\n1.2\n\n2.5\nno\nnone\n\n{tone}\n\n");
        let mut command = folder.command(&["new", "--ask", name]);
        let mut child = command.stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let _ = child.stdin.take().unwrap().write_all(answers.as_bytes());
        let told = String::from_utf8(child.wait_with_output().unwrap().stderr).unwrap();
        let first = std::fs::read_to_string(folder.0.join(name)).ok().map(|text| {
            let bat: Value = serde_json::from_str(&text).unwrap();
            let tone = bat["weighed"]["first_bending_hz"].as_str().unwrap_or_default().to_owned();
            tone.trim_end_matches(" Hz").parse::<f64>().unwrap()
        });
        (first, told)
    };
    let (first, told) = file("E3 +34", "noted.json");
    // 164.814 Hz is E3, and a cent is a 1200th of an octave.
    let hz = 164.814 * 2.0_f64.powf(34.0 / 1200.0);
    assert!((first.unwrap() - hz).abs() < 0.02, "{told}");
    let modes = folder.json(&["modes", "noted.json", "-n", "4", "--json", "-"]);
    let modes = modes["modes"].as_array().unwrap();
    let tones: Vec<f64> = modes.iter().map(|one| one["frequency_hz"].as_f64().unwrap()).collect();
    folder.write("taps.wav", wav::file(&taps(&tones)));
    folder.write("quiet.wav", wav::file(&vec![0.0; RATE as usize]));
    let (first, told) = file("taps.wav", "heard.json");
    assert!((first.unwrap() - hz).abs() < 0.1, "{told}");
    for (wrong, said) in [("quiet.wav", "No tap was found"), ("gone.wav", "gone.wav")] {
        let (first, told) = file(wrong, &wrong.replace(".wav", ".json"));
        assert!(first.is_none() && told.contains(said), "{told}");
    }
}

/// A recording says the same on any number of threads.
#[test]
fn threads_change_no_byte() {
    let folder = Folder::new("tap_threads");
    folder.write("taps.wav", wav::file(&taps(&[174.0, 581.0, 1187.0, 1858.0])));
    let heard = |threads: &str| {
        let mut command = folder.command(&["tap", "r161", "taps.wav", "--json", "-"]);
        command.env("RAYON_NUM_THREADS", threads).output().unwrap().stdout
    };
    let one = heard("1");
    assert!(serde_json::from_slice::<Value>(&one).unwrap()["wood"].is_object());
    for threads in ["2", "3", "7"] {
        assert!(heard(threads) == one, "{threads} threads");
    }
}
