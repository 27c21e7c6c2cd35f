//! A struck bat as a sound file: it reads as WAV and sounds at the bat's own frequencies.

use crate::common;

use std::f64::consts::PI;

use common::folder::Folder;
use serde_json::Value;

fn mesh(name: &str) -> String {
    format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP"))
}

/// The samples of a WAV file, after a check of its header.
fn samples(bytes: &[u8]) -> Vec<f64> {
    let long = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let short = |at: usize| u16::from_le_bytes(bytes[at..at + 2].try_into().unwrap());
    assert_eq!((&bytes[..4], &bytes[8..16]), (&b"RIFF"[..], &b"WAVEfmt "[..]));
    assert_eq!((long(4), long(16)), (bytes.len() - 8, 16));
    // Plain numbers, one channel, 44100 of two bytes in a second, 16 bits each.
    assert_eq!((short(20), short(22), long(24), long(28)), (1, 1, 44_100, 88_200));
    assert_eq!((short(32), short(34)), (2, 16));
    assert_eq!((&bytes[36..40], long(40)), (&b"data"[..], bytes.len() - 44));
    let samples = bytes[44..].chunks_exact(2);
    samples.map(|two| f64::from(i16::from_le_bytes([two[0], two[1]]))).collect()
}

/// The amplitude of a frequency (Hz) in samples.
fn strength(samples: &[f64], hertz: f64) -> f64 {
    let mut sum = [0.0; 2];
    for (k, sample) in samples.iter().enumerate() {
        let (sine, cosine) = (2.0 * PI * hertz * k as f64 / 44_100.0).sin_cos();
        sum[0] += sample * cosine;
        sum[1] += sample * sine;
    }
    sum[0].hypot(sum[1])
}

fn frequencies(folder: &Folder, bat: &str) -> Vec<f64> {
    let told: Value = serde_json::from_str(&folder.text(&["modes", bat, "--json", "-"])).unwrap();
    let modes = told["modes"].as_array().unwrap().iter();
    modes.map(|mode| mode["frequency_hz"].as_f64().unwrap()).collect()
}

#[test]
fn a_struck_bat_sounds_at_its_own_frequencies() {
    let folder = Folder::new("sound");
    let bat = mesh("r161");
    let hertz = frequencies(&folder, &bat);
    let blow =
        ["ring", &bat, "--at", "0.84 m", "--impulse", "1 N s", "--csv", "blow.csv", "--quiet"];
    folder.text(&[&blow[..], &["--wav", "blow.wav"]].concat());
    folder.text(&["ring", &bat, "--hit", "60 cm", "--wav", "hit.wav", "--quiet"]);
    // The outer half is loudest where it begins; a blow on the handle is even louder, and is not clipped.
    let blow = ["ring", &bat, "--impulse", "1 N s", "--csv", "blow.csv", "--quiet"];
    folder.text(&[&blow[..], &["--at", "0.42 m", "--wav", "loud.wav"]].concat());
    folder.text(&[&blow[..], &["--at", "0.25 m", "--wav", "louder.wav"]].concat());
    for name in ["blow.wav", "hit.wav", "loud.wav", "louder.wav"] {
        let samples = samples(&std::fs::read(folder.0.join(name)).unwrap());
        let largest = samples.iter().fold(0.0_f64, |most, sample| most.max(sample.abs()));
        let least = if name.starts_with("loud") { 29_000.0 } else { 1000.0 };
        assert!((least..=32_767.0).contains(&largest), "{name}: {largest}");
        assert!(samples.len() > 10_000, "{name}");
        // There is a peak at the first mode, the highest around it.
        let first = strength(&samples, hertz[0]);
        for off in [0.9, 0.95, 1.05, 1.1, 1.5] {
            assert!(first > 2.0 * strength(&samples, off * hertz[0]), "{name} {off}");
        }
    }
}

/// Hit at the node of mode 1, the bat is silent at its frequency.
#[test]
fn the_first_mode_is_not_heard_of_a_blow_at_its_node() {
    let folder = Folder::new("sound-node");
    let bat = mesh("r161");
    let told: Value = serde_json::from_str(&folder.text(&["modes", &bat, "--json", "-"])).unwrap();
    let node = told["modes"][0]["nodes_m"][1].as_f64().unwrap();
    let hertz = told["modes"][0]["frequency_hz"].as_f64().unwrap();
    let strong = |x: f64, name: &str| {
        let at = format!("{x} m");
        folder.text(&["ring", &bat, "--at", &at, "--impulse", "1 N s", "--wav", name, "--quiet"]);
        let samples = samples(&std::fs::read(folder.0.join(name)).unwrap());
        strength(&samples, hertz) / samples.len() as f64
    };
    let [at, off] = [strong(node, "node.wav"), strong(node - 0.2, "off.wav")];
    assert!(at < 0.2 * off, "{at} {off}");
}

#[test]
fn what_was_assumed_for_a_sound_is_told_and_a_sound_needs_a_blow() {
    let folder = Folder::new("sound-told");
    let bat = mesh("r161");
    let told = folder.text(&["ring", &bat, "--hit", "60 cm", "--wav", "a.wav"]);
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("the sound alone takes an assumed 0.01"), "{told}");
    folder.write("shape.csv", "x_m,w_m\n0,0\n0.84,0.01\n");
    let output = folder.run(&["ring", &bat, "--initial", "shape.csv", "--wav", "b.wav"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!folder.0.join("b.wav").exists());
}

/// The first hoop mode is the loudest sound of an aluminium barrel after a hit, as in D. A. Russell, Acoustics Today
/// 13(4) (2017), and is still audible when wood is silent.
#[test]
fn the_ping_of_an_aluminium_barrel_is_loudest_and_outlasts_the_tones_of_wood() {
    let folder = Folder::new("sound-ping");
    let sound = |bat: &str| {
        let bat = mesh(bat);
        folder.text(&["ring", &bat, "--hit", "70 cm", "--wav", "hit.wav", "--quiet"]);
        samples(&std::fs::read(folder.0.join("hit.wav")).unwrap())
    };
    let loud = |samples: &[f64]| samples.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
    // A twentieth of a second, from 1 s on.
    let late = |samples: &[f64]| loud(&samples[44_100..46_305]);
    for bat in ["northwestern_aluminium", "bbcor_made_up"] {
        let told = folder.text(&["hoop", &mesh(bat), "-n", "1", "--json", "-", "--quiet"]);
        let told: Value = serde_json::from_str(&told).unwrap();
        let ping = told["modes"][0]["frequency_hz"].as_f64().unwrap();
        let metal = sound(bat);
        let strong = |hertz: u32| strength(&metal[..4410], f64::from(hertz));
        let loudest = (100..12_000).step_by(5).max_by(|a, b| strong(*a).total_cmp(&strong(*b)));
        assert!((f64::from(loudest.unwrap()) - ping).abs() <= 5.0, "{bat}: {loudest:?} {ping}");
        assert!(late(&metal) > 0.1 * loud(&metal), "{bat}: {} {}", late(&metal), loud(&metal));
    }
    let wood = sound("r161");
    assert!(late(&wood) < 0.01 * loud(&wood), "{} {}", late(&wood), loud(&wood));
}

#[test]
fn assumed_damping_is_that_of_a_metal_and_is_named_and_wood_has_none() {
    let folder = Folder::new("sound-assumed");
    let (metal, wood) = (mesh("bbcor_made_up"), mesh("r161"));
    let modes = |more: &[&str]| -> Value {
        serde_json::from_str(
            &folder.text(&[&["modes", &metal, "--json", "-", "--quiet"], more].concat()),
        )
        .unwrap()
    };
    let [plain, assumed] = [modes(&[]), modes(&["--damping", "assumed"])];
    let ratio = |told: &Value| told["modes"][0]["damping_ratio"].as_f64().unwrap();
    // Half the loss factor, except for the share of the plastic plug in the strain energy.
    assert_eq!(ratio(&plain), 0.0);
    assert!((0.99 * 0.5e-4..0.5e-4).contains(&ratio(&assumed)), "{}", ratio(&assumed));
    let named = |told: &Value| told["model"]["ignored"].to_string().contains("0.0001 of the metal");
    assert!(!named(&plain) && named(&assumed));
    // The other verbs with damping in their answers name it too.
    for (verb, place) in [
        ("hit --points 1", "/ignored"),
        ("hoop", "/notes"),
        ("frf --at 0.7", "/ignored"),
        ("lathe --bands 0.4m", "/ignored"),
        ("compare softball_made_up", "/bats/0/ignored"),
    ] {
        let words: Vec<&str> = verb.split(' ').collect();
        let told = |more: &[&str]| {
            let args =
                [&[words[0], &metal], &words[1..], &["--json", "-", "--quiet"], more].concat();
            let told: Value = serde_json::from_str(&folder.text(&args)).unwrap();
            told.pointer(place).map_or(String::new(), Value::to_string)
        };
        let [plain, assumed] = [told(&[]), told(&["--damping", "assumed"])];
        assert!(!plain.contains("0.0001 of the metal"), "{verb}: {plain}");
        assert!(assumed.contains("0.0001 of the metal"), "{verb}: {assumed}");
    }
    let output = folder.run(&["modes", &wood, "--damping", "assumed"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("loss_factor"));
    let output = folder.run(&["modes", &metal, "--damping", "measured"]);
    assert_eq!(output.status.code(), Some(2));
    let output = folder.run(&["frf", &metal, "--at", "0.7 m", "--damping", "measured"]);
    assert_eq!(output.status.code(), Some(2));
}
