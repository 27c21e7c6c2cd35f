//! The report: a page that needs no other file, states the results and shows any text as text.

use crate::common;

use std::collections::BTreeSet;

use common::folder::Folder;
use serde_json::{Value, json};

fn mesh(name: &str) -> String {
    format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP"))
}

/// The page of a bat, and standard output.
fn made(folder: &Folder, bat: &str, more: &[&str]) -> (String, String) {
    let args = [&["analyze", bat, "--report", "page.html", "--quiet"], more].concat();
    let told = folder.text(&args);
    (folder.read("page.html"), told)
}

/// The text between two marks, after the first of them.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    let (_, rest) = text.split_once(from).unwrap_or_else(|| panic!("no {from}"));
    rest.split_once(to).unwrap_or_else(|| panic!("no {to}")).0
}

fn data(page: &str) -> Value {
    let block = between(page, "<script type=\"application/json\" id=\"data\">", "</script>");
    assert!(!block.contains('<'));
    serde_json::from_str(block).unwrap()
}

/// A tag: its name, whether it ends or is empty, its attributes.
struct Tag {
    name: String,
    closes: bool,
    empty: bool,
    attributes: Vec<(String, String)>,
    /// The text after it, until the next tag.
    text: String,
}

impl Tag {
    fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }
}

/// The tags of a page, except those within scripts and styles.
fn tags(page: &str) -> Vec<Tag> {
    const VOID: [&str; 5] = ["meta", "input", "br", "img", "link"];
    let mut all = vec![];
    let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("a page of today");
    while let Some(start) = rest.find('<') {
        let end = start + rest[start..].find('>').expect("every tag ends");
        let inner = &rest[start + 1..end];
        let (inner, own) = inner.strip_suffix('/').map_or((inner, false), |inner| (inner, true));
        let closes = inner.starts_with('/');
        let inner = inner.trim_start_matches('/');
        let (name, mut given) = inner.split_once([' ', '\n']).unwrap_or((inner, ""));
        let mut attributes = vec![];
        while let Some((key, more)) = given.split_once("=\"") {
            let (value, more) = more.split_once('"').expect("every value ends");
            let key = key.trim().rsplit(' ').next().unwrap_or_default();
            attributes.push((key.to_owned(), value.to_owned()));
            given = more;
        }
        rest = &rest[end + 1..];
        if !closes && ["script", "style"].contains(&name) {
            rest = &rest[rest.find(&format!("</{name}>")).expect("it ends")..];
        }
        let text = rest.split('<').next().unwrap_or_default().to_owned();
        let empty = own || VOID.contains(&name);
        all.push(Tag { name: name.to_owned(), closes, empty, attributes, text });
    }
    all
}

#[test]
fn the_page_is_one_file_that_fetches_nothing() {
    let folder = Folder::new("page-alone");
    let (page, _) = made(&folder, &mesh("northwestern_aluminium"), &[]);
    assert_eq!(folder.names(), ["page.html"]);
    assert!(page.len() < 700_000, "{} bytes", page.len());
    assert!(page.contains("default-src 'none'"));
    for tag in tags(&page) {
        assert!(!["link", "iframe", "object", "embed", "base", "img"].contains(&tag.name.as_str()));
        for (key, value) in &tag.attributes {
            assert!(!["src", "srcset", "data", "action", "xlink:href"].contains(&key.as_str()));
            assert!(key != "href" || value.starts_with('#'), "{value}");
            assert!(!key.starts_with("on"), "{key}");
        }
    }
    let known = "http://www.w3.org/2000/svg";
    for told in ["http:", "https:", "url(", "@import", "fetch(", "import(", "XMLHttp", "//cdn"] {
        assert_eq!(page.replace(known, "").find(told), None, "{told}");
    }
}

#[test]
fn every_tag_ends_every_name_is_one_and_every_control_is_named() {
    let folder = Folder::new("page-form");
    for (bat, more) in [("two_piece", &[][..]), ("dowel", &["--modes", "0", "--model", "rigid"])] {
        let (page, _) = made(&folder, &mesh(bat), more);
        let tags = tags(&page);
        let (mut open, mut ids, mut level) = (vec![], BTreeSet::new(), 0);
        let mut links = vec![];
        for (k, tag) in tags.iter().enumerate() {
            let name = tag.name.as_str();
            if tag.closes {
                assert_eq!(open.pop(), Some(name), "{bat}");
                continue;
            }
            if let Some(id) = tag.get("id") {
                assert!(ids.insert(id), "{bat}: {id} twice");
            }
            links.extend(tag.get("href").map(|link| link.trim_start_matches('#')));
            links.extend(tag.get("aria-labelledby"));
            if let Some(now) = name.strip_prefix('h').and_then(|n| n.parse::<u32>().ok()) {
                assert!(now <= level + 1, "{bat}: h{now} after h{level}");
                level = now;
            }
            let named = tag.get("aria-label").is_some_and(|label| !label.is_empty());
            match name {
                "input" => assert!(named || open.contains(&"label"), "{bat}"),
                // A section opens by its heading.
                "summary" => assert!(!(tag.text.clone() + &tags[k + 1].text).trim().is_empty()),
                "button" | "a" | "legend" => {
                    assert!(named || !tag.text.trim().is_empty(), "{bat}: {name}")
                }
                "svg" => {}
                _ if tag.get("role").is_some() && name != "svg" => assert!(named, "{bat}: {name}"),
                _ => {}
            }
            if !tag.empty {
                open.push(name);
            }
        }
        assert!(open.is_empty(), "{bat}: {open:?}");
        assert!(links.iter().all(|link| ids.contains(link)), "{bat}: {links:?} {ids:?}");
        assert_eq!(tags.iter().filter(|tag| tag.name == "h1" && !tag.closes).count(), 1);
        assert!(page.contains("<html lang=\"en\">") && page.contains("<title>"));
    }
}

#[test]
fn whatever_a_bat_is_called_it_is_shown_as_text() {
    let folder = Folder::new("page-names");
    let evil = "</script><script>alert(1)</script> \"><img src=x onerror=alert(2)> 'a' ![x](y) |`";
    let mut bat: Value =
        serde_json::from_str(&std::fs::read_to_string(mesh("dowel")).unwrap()).unwrap();
    bat["name"] = json!(evil);
    bat["source"] = json!(evil);
    folder.write("<b>.json", bat.to_string());
    let ball = json!({ "format": "sweetspot-ball/1", "name": evil, "source": evil, "mass": "5 oz",
        "radius": "36 mm", "stiffness": 6.53e7, "exponent": 1.84, "cor": 0.5 });
    folder.write("ball.json", ball.to_string());
    let (page, _) = made(&folder, "<b>.json", &["--ball", "ball.json"]);
    let scripts = tags(&page).iter().filter(|tag| tag.name == "script" && !tag.closes).count();
    assert_eq!(scripts, 2);
    assert!(!page.contains("<script>alert") && !page.contains("<img") && !page.contains("<b>"));
    let shown = "&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;";
    assert!(between(&page, "<h1>", "</h1>").contains(shown));
    assert!(page.matches(shown).count() > 3);
    data(&page);

    folder.text(&["analyze", "<b>.json", "--ball", "ball.json", "--report", "a b.md", "--quiet"]);
    let text = folder.read("a b.md");
    let outside: String = text.split("```").step_by(2).collect();
    assert!(!outside.replace("\\<", "").contains('<'), "{outside}");
    assert!(text.contains("](a%20b_pictures/exit_speed.svg"));
}

#[test]
fn the_summary_has_the_numbers_of_the_analysis() {
    let folder = Folder::new("page-numbers");
    for bat in ["r161", "two_piece"] {
        let (page, told) = made(&folder, &mesh(bat), &["--json", "-"]);
        let told: Value = serde_json::from_str(&told).unwrap();
        let summary = &data(&page)["summary"];
        let (modes, hit) = (&told["modes"], &told["hit"]);
        for key in ["length_m", "mass_kg", "balance_point_m", "inertia_pivot_kg_m2"] {
            assert_eq!(summary[key], modes["summary"][key], "{bat}: {key}");
        }
        let center = &modes["summary"]["center_of_percussion_m"];
        assert_eq!(&summary["center_of_percussion_m"], center);
        for k in 0..3 {
            assert_eq!(summary["frequencies_hz"][k], modes["modes"][k]["frequency_hz"]);
        }
        let spot = &hit["sweet_spot"];
        assert_eq!(summary["sweet_spot_m"], spot["exit_speed_max"]["x_m"]);
        assert_eq!(summary["exit_speed_m_s"], spot["exit_speed_max"]["value"]);
        assert_eq!(summary["zone_m"], spot["zone_m"]);
        assert_eq!(summary["bbcor"], hit["figures"]["bbcor"]);
        assert_eq!(summary["bbcor_pivoted"], hit["figures"]["bbcor_pivoted"]);
        // The number shown is that number, rounded.
        let zone = summary["zone_m"][1].as_f64().unwrap() - summary["zone_m"][0].as_f64().unwrap();
        let number = |key: &str| summary[key].as_f64().unwrap();
        for (key, value, within) in [
            ("length_m", 100.0 * number("length_m"), 0.05),
            ("mass_kg", 1e3 * number("mass_kg"), 0.05),
            ("balance_point_m", 100.0 * number("balance_point_m"), 0.05),
            ("inertia_pivot_kg_m2", number("inertia_pivot_kg_m2"), 5e-5),
            ("center_of_percussion_m", 100.0 * number("center_of_percussion_m"), 0.05),
            ("frequencies_hz", summary["frequencies_hz"][0].as_f64().unwrap(), 0.05),
            ("sweet_spot_m", 100.0 * number("sweet_spot_m"), 0.05),
            ("exit_speed_m_s", number("exit_speed_m_s"), 0.005),
            ("zone_m", 100.0 * zone, 0.05),
            ("bbcor", number("bbcor"), 5e-4),
        ] {
            // SI comes first in the page, regardless of which is shown.
            let shown = between(&page, &format!("data-key=\"{key}\">"), "</dd>");
            let seen: f64 = shown.split(' ').next().unwrap().parse().unwrap();
            assert!((seen - value).abs() <= within * (1.0 + 1e-9), "{key}: {shown}, {value}");
        }
        // The curve too, and the sweet spot is one of its places.
        let curve = &data(&page)["curve"];
        let apart = |a: &Value, b: &Value| (a.as_f64().unwrap() - b.as_f64().unwrap()).abs();
        let places = curve["x_m"].as_array().unwrap();
        let spot = places.iter().position(|x| apart(x, &summary["sweet_spot_m"]) < 1e-7).unwrap();
        assert!(apart(&curve["exit_speed_m_s"][spot], &summary["exit_speed_m_s"]) < 1e-3);
        for impact in hit["impacts"].as_array().unwrap() {
            let near = |x: &Value| apart(x, &impact["x_m"]) < 1e-7;
            let k = places.iter().position(near).unwrap();
            assert!(apart(&curve["exit_speed_m_s"][k], &impact["exit_speed_m_s"]) <= 5.1e-4);
            assert!(apart(&curve["vibration_j"][k], &impact["energy_j"]["vibration"]) <= 5.1e-4);
        }
    }
}

/// Whether US units are the ones that a page shows at first.
fn in_us(page: &str) -> bool {
    let chosen = |k: u8| page.contains(&format!("id=\"units-{k}\" value=\"{k}\" checked"));
    assert_ne!(chosen(0), chosen(1));
    chosen(1)
}

#[test]
fn a_page_is_first_in_the_unit_of_the_bat_file() {
    let folder = Folder::new("page-inches");
    assert!(!in_us(&made(&folder, &mesh("r161"), &[]).0));
    assert!(in_us(&made(&folder, &mesh("two_piece"), &[]).0));
    assert!(in_us(&made(&folder, &mesh("r161"), &["--units", "us"]).0));
    assert!(!in_us(&made(&folder, &mesh("two_piece"), &["--units", "si"]).0));
    // A CSV file has units in its header, and a single value has its unit.
    folder.write("turned.csv", "x_in,diameter_in\n0,1\n17,1.3\n33,2.6\n");
    let start = r#"{ "format": "sweetspot-bat/1", "material": "white-ash", "profile": "#;
    folder.write("csv.json", format!("{start} {{ \"csv\": \"turned.csv\" }} }}"));
    assert!(in_us(&made(&folder, "csv.json", &[]).0));
    let columns = r#"{ "x": ["0 in", "33 in"], "radius": ["1 in", "1 in"] }"#;
    folder.write("strings.json", format!("{start} {columns} }}"));
    assert!(in_us(&made(&folder, "strings.json", &[]).0));
}

/// The visible text of a page: text within elements of the other system is omitted, folded text is included.
fn seen(page: &str, us: bool) -> String {
    const VOID: [&str; 5] = ["meta", "input", "br", "img", "link"];
    let hidden = if us { "si" } else { "us" };
    let (mut open, mut told): (Vec<(String, bool)>, String) = (vec![], String::new());
    for tag in tags(page) {
        if tag.closes {
            open.pop();
        } else if !tag.empty && !VOID.contains(&tag.name.as_str()) {
            let class = tag.get("class").unwrap_or_default();
            let away = class == hidden || class.contains("ss-hover");
            let skipped = ["script", "style", "noscript", "desc", "title"].contains(&&*tag.name);
            open.push((tag.name.clone(), away || skipped));
        }
        if !open.iter().any(|(_, away)| *away) {
            told += &tag.text;
            told.push(' ');
        }
    }
    told
}

#[test]
fn one_switch_changes_every_number_axis_and_caption() {
    let folder = Folder::new("page-switch");
    let (page, _) = made(&folder, &mesh("torpedo"), &[]);
    let [si, us] = [false, true].map(|us| seen(&page, us));
    // The input, and the names of files and bats, are shown as written.
    let cut = |text: &str| {
        let (_, rest) = text.split_once("How fast the ball leaves").unwrap();
        rest.split_once("What went in").unwrap().0.to_owned()
    };
    let words = |text: &str| -> Vec<String> {
        let split = |c: char| c.is_whitespace() || "();,:".contains(c);
        cut(text).split(split).map(str::to_owned).collect()
    };
    for unit in ["in", "mph", "oz", "lbf", "ft·lbf"] {
        let shown = words(&si).windows(2).any(|pair| {
            pair[1] == unit && pair[0].parse::<f64>().is_ok() && pair[0] != "6" && pair[0] != "1"
        });
        assert!(!shown, "{unit} in SI");
    }
    for unit in ["cm", "mm", "m/s", "kg", "g", "kN", "N", "J"] {
        let shown =
            words(&us).windows(2).any(|pair| pair[1] == unit && pair[0].parse::<f64>().is_ok());
        assert!(!shown, "{unit} in US units: {:?}", words(&us));
    }
    for (text, labels) in [
        (&si, ["from the knob end (cm)", "exit speed (m/s)", "from the tip (cm)", "diameter (cm)"]),
        (&us, ["from the knob end (in)", "exit speed (mph)", "from the tip (in)", "diameter (in)"]),
    ] {
        assert!(labels.iter().all(|label| text.contains(label)), "{labels:?}");
    }
}

/// Words that a reader sees before opening anything.
#[test]
fn before_anything_is_opened_there_are_at_most_seven_hundred_words() {
    let folder = Folder::new("page-words");
    for bat in ["r161", "two_piece", "corked"] {
        let (page, _) = made(&folder, &mesh(bat), &[]);
        let (mut rest, mut open) = (page.as_str(), String::new());
        while let Some((before, after)) = rest.split_once("<details") {
            open += before;
            // None of them contains another.
            rest = after.split_once("</summary>").unwrap().1;
            let mut depth = 1;
            while depth > 0 {
                let end = rest.find("</details>").unwrap();
                depth += rest[..end].matches("<details").count();
                depth -= 1;
                rest = &rest[end + "</details>".len()..];
            }
        }
        open += rest;
        let words = seen(&open, false).split_whitespace().count();
        assert!((100..=700).contains(&words), "{bat}: {words} words");
    }
}

#[test]
fn round_off_is_nothing_for_people_to_read() {
    let folder = Folder::new("page-round-off");
    let (page, _) = made(&folder, &mesh("r161"), &[]);
    assert!(!page.contains("not accounted for") && !page.contains("10⁻¹³ J"));
    // A model that does lose energy says so.
    let (page, _) = made(&folder, &mesh("r161"), &["--model", "energy-loss"]);
    assert!(page.contains("not accounted for by this model"));
}

#[test]
fn the_bat_can_be_heard_by_its_own_modes() {
    let folder = Folder::new("page-sound");
    let (page, told) = made(&folder, &mesh("r161"), &["--json", "-"]);
    let told: Value = serde_json::from_str(&told).unwrap();
    let data = data(&page);
    let tones = data["tap"]["tones"].as_array().unwrap();
    for (tone, mode) in tones.iter().zip(told["modes"]["modes"].as_array().unwrap()) {
        assert_eq!(tone["frequency_hz"], mode["frequency_hz"]);
    }
    assert!(page.contains("data-sound=\"tap\"") && page.contains("data-sound=\"hit\""));
    assert!(page.contains("the sound alone takes an assumed 0.01"));
    let (page, _) = made(&folder, &mesh("r161"), &["--model", "rigid"]);
    assert!(page.contains("data-sound=\"tap\"") && !page.contains("data-sound=\"hit\""));
}

#[test]
fn bats_side_by_side_have_a_page_with_what_differs_first() {
    let folder = Folder::new("page-compared");
    let bats = ["r161", "torpedo", "house"].map(mesh);
    let [a, b, c] = bats.each_ref().map(String::as_str);
    let told = folder.text(&["compare", a, b, c, "--report", "page.html", "--csv", "-"]);
    let page = folder.read("page.html");
    assert!(page.len() < 1_200_000 && !page.contains("NaN"));
    for tag in tags(&page) {
        assert!(!["link", "iframe", "object", "base", "img"].contains(&tag.name.as_str()));
    }
    let (first, folded) = page.split_once("class=\"folds screen\"").unwrap();
    assert!(first.contains("best exit speed, mph") && first.contains("best exit speed, m/s"));
    assert!(!first.contains("node 1") && folded.contains("mode 1, node 1"));
    // The speeds are those of the table.
    let row = told.lines().find(|line| line.starts_with("best_exit_speed_m_s")).unwrap();
    let speed: f64 = row.split(',').nth(3).unwrap().parse().unwrap();
    assert!(between(first, "best exit speed, m/s</th>", "</td>").contains(&format!("{speed:.2}")));
    // A bat compared with itself has no differences.
    folder.text(&["compare", a, a, "--report", "same.html"]);
    let page = folder.read("same.html");
    let before = page.split_once("class=\"folds screen\"").unwrap().0;
    assert!(!before.contains("best exit speed") && page.contains("No significant difference"));
    for name in ["page.pdf", "page.md"] {
        let output = folder.run(&["compare", a, b, "--report", name]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(String::from_utf8_lossy(&output.stderr).contains(".html"));
    }
}

#[test]
fn equal_input_gives_equal_bytes() {
    let folder = Folder::new("page-equal");
    let (one, _) = made(&folder, &mesh("cone"), &[]);
    assert_eq!(made(&folder, &mesh("cone"), &[]).0, one);
}

#[test]
fn what_there_is_not_is_told() {
    let folder = Folder::new("page-missing");
    let (page, _) = made(&folder, &mesh("dowel"), &["--model", "rigid", "--modes", "0"]);
    for told in ["gives no force over time", "No bending modes were asked for", "does not bend"] {
        assert!(page.contains(told), "{told}");
    }
    assert!(!page.contains("id=\"modes-player\"") && !page.contains("id=\"moment-player\""));
    let (page, _) =
        made(&folder, &mesh("dowel"), &["--swing-speed", "-50 rad/s", "--pitch", "1 m/s"]);
    assert!(page.contains("There is no sweet spot to show"));
    assert_eq!(data(&page)["summary"]["sweet_spot_m"], Value::Null);
    assert!(!page.contains("NaN") && !page.contains("inf"));
    let (page, _) = made(&folder, &mesh("dowel"), &["--model", "pulse", "--ball", "softball"]);
    assert!(page.contains("softball") && page.contains("id=\"plot-exit_speed\""));
    assert!(
        page.contains("half sine of given duration") && !page.contains("gives no force over time")
    );
}

/// A forgotten unit must be evident without a look at the terminal.
#[test]
fn what_is_unusual_for_a_bat_is_told_first() {
    let folder = Folder::new("page-unusual");
    let text = std::fs::read_to_string(mesh("dowel")).unwrap();
    let text = text.trim_end().trim_end_matches('}').to_owned();
    folder.write("heavy.json", text + ", \"attachments\": [{ \"x\": 0.1, \"mass\": 31.5 }] }");
    let (page, told) = made(&folder, "heavy.json", &[]);
    let (before, after) = page.split_once("Look at this first").expect("it is told");
    assert!(after.contains("a bat&#39;s is 0.2 to 2") || after.contains("a bat's is 0.2 to 2"));
    assert!(!before.contains("The sweet spot</h2>"));
    assert!(told.ends_with("Wrote:\n  page.html\n"), "{told}");
    folder.text(&["analyze", "heavy.json", "--report", "page.md", "--quiet"]);
    assert!(folder.read("page.md").contains("## Look at this first"));
    let (page, _) = made(&folder, &mesh("r161"), &[]);
    assert!(!page.contains("Look at this first"));
}

#[test]
fn the_files_stand_in_the_page_as_they_were_written() {
    let folder = Folder::new("page-files");
    folder.write(
        "bat.json",
        r#"{ "format": "sweetspot-bat/1", "name": "mine",
            "material": "white-ash", "weighed": { "mass": "31.5 oz" },
            "profile": { "csv": "turned.csv" } }"#,
    );
    folder.write("turned.csv", "x_in,diameter_in\n0,1\n17,1.3\n33,2.6\n");
    let (page, _) = made(&folder, "bat.json", &["--theory", "euler-bernoulli"]);
    for told in ["&quot;31.5 oz&quot;", "x_in,diameter_in\n0,1\n17,1.3\n33,2.6"] {
        assert!(page.contains(told), "{told}");
    }
    assert!(page.contains("sweetspot analyze bat.json --report page.html"));
}

#[cfg(unix)]
#[test]
fn a_bat_from_a_pipe_stands_in_the_page_too() {
    use std::process::Command;
    let folder = Folder::new("page-pipe");
    let text = r#"{ "format": "sweetspot-bat/1", "name": "piped", "material": "white-ash",
        "profile": { "x": [0, "33 in"], "radius": ["13 mm", "33 mm"] } }"#;
    let ball = json!({ "format": "sweetspot-ball/1", "name": "hard", "mass": "5 oz",
        "radius": "36 mm", "stiffness": 6.53e7, "exponent": 1.84, "cor": 0.5 });
    for (name, contents) in [("bat", text.to_owned()), ("ball", ball.to_string())] {
        let pipe = folder.0.join(format!("{name}.pipe"));
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        std::thread::spawn(move || std::fs::write(pipe, contents));
    }
    let (page, _) = made(&folder, "bat.pipe", &["--ball", "ball.pipe"]);
    let written = between(&page, "<h3>bat.pipe</h3>\n", "</pre>");
    assert!(written.contains(&text.replace('"', "&quot;")));
    let after = between(&page, "<h3>ball.pipe</h3>\n", "</details>");
    assert!(after.contains("can be read only once"), "{after}");
}

#[test]
fn a_bat_of_very_many_values_has_a_page_of_its_own_size() {
    let folder = Folder::new("page-many");
    let text = std::fs::read_to_string(mesh("dowel")).unwrap();
    let mut bat: Value = serde_json::from_str(&text).unwrap();
    let weight = |k: u32| json!({ "x": 2e-4 * f64::from(k), "mass": 1e-6 });
    bat["attachments"] = (1..3000).map(weight).collect();
    folder.write("bat.json", bat.to_string());
    let (page, _) = made(&folder, "bat.json", &["--modes", "3"]);
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    let count = between(&page, "in SI: the first 400 of ", " values").parse::<usize>().unwrap();
    // A place and a mass at least of each.
    assert!(count > 2 * 2999 && page.contains("attachments[0].mass"), "{count}");
}

#[test]
fn markdown_says_the_same_with_its_pictures_beside_it() {
    let folder = Folder::new("page-markdown");
    folder.text(&["analyze", &mesh("r161"), "--report", "r161.md"]);
    assert_eq!(folder.names(), ["r161.md", "r161_pictures"]);
    let text = folder.read("r161.md");
    let (page, _) = made(&folder, &mesh("r161"), &[]);
    for tag in
        tags(&page).iter().filter(|tag| ["h1", "h2"].contains(&tag.name.as_str()) && !tag.closes)
    {
        let marks = if tag.name == "h1" { "#" } else { "##" };
        assert!(text.contains(&format!("{marks} {}\n", tag.text)), "{}", tag.text);
    }
    let pictures = Folder(folder.0.join("r161_pictures"));
    for name in pictures.names() {
        assert_eq!(text.matches(&format!("](r161_pictures/{name} \"")).count(), 1, "{name}");
        assert!(pictures.read(&name).trim_end().ends_with("</svg>"));
    }
    assert_eq!(text.matches("](r161_pictures/").count(), pictures.names().len());
    // Every row of a table has as many cells as its head.
    let cells = |line: &str| line.replace("\\|", "").matches('|').count();
    let lines: Vec<&str> = text.lines().collect();
    for pair in lines.windows(2).filter(|pair| pair.iter().all(|line| line.starts_with("| "))) {
        assert_eq!(cells(pair[0]), cells(pair[1]), "{pair:?}");
    }
}

#[test]
fn another_kind_of_report_is_refused_before_anything_is_done() {
    let folder = Folder::new("page-kinds");
    for name in ["report.pdf", "report", "html"] {
        let output = folder.run(&["analyze", &mesh("dowel"), "--report", name, "--out", "out"]);
        assert_eq!(output.status.code(), Some(2));
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains(".html or .md"), "{told}");
    }
    folder.write("taken", "");
    for report in ["missing/page.html", "taken/page.html"] {
        let output = folder.run(&["analyze", &mesh("dowel"), "--report", report, "--out", "out"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&output.stderr).contains(report));
    }
    assert_eq!(folder.names(), ["taken"]);
}

/// A program without the live page says how to include it, before any computation; a report without a live page has no
/// button for it.
#[test]
fn the_live_page_beside_a_report_has_to_be_built_in() {
    let folder = Folder::new("page-lab");
    let output = folder.run(&["analyze", &mesh("dowel"), "--report", "page.html", "--lab"]);
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains("lab/build"), "{told}");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
    folder.run(&["analyze", &mesh("dowel"), "--report", "page.html"]);
    assert!(!folder.read("page.html").contains("Open in the lab"));
}
