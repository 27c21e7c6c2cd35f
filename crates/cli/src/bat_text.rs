//! A bat file written for a person: commented, its columns under each other.

use std::fmt::Write;

use sweetspot::Profile;
use sweetspot::base::marks;
use sweetspot::base::number::rounded;
use sweetspot::bat::profile::{Interpolation, Stations};

/// Measurements of a bat; lengths in `unit`.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    pub name: String,
    pub source: String,
    /// A built-in name.
    pub material: String,
    /// With its unit, such as "31.5 oz", if it was weighed.
    pub mass: Option<String>,
    /// "in" or "cm".
    pub unit: &'static str,
    /// Place from the knob end and diameter.
    pub stations: Vec<[f64; 2]>,
    /// Thickness of the wall with its unit, if the bat is hollow.
    pub wall: Option<String>,
    /// Depth and diameter of a cup in the tip, if there is one.
    pub cup: Option<[f64; 2]>,
    /// With its unit, if it was measured.
    pub balance: Option<String>,
    /// First bending frequency with its unit, if the bat was tapped.
    pub tap: Option<String>,
    /// The line of the file for tape, if there is any.
    pub tape: Option<String>,
}

const COMMENT: [&str; 4] = [
    "Text beside \"comment\" is for people. Text elsewhere carries its unit, as \"33 in\" or \"31 oz\".",
    "\"material\" may be any name of: sweetspot materials, or your own \"density\" and \"youngs_modulus\".",
    "\"weighed\" sets the density so that the mass is that of the scale, with all that is attached;",
    "a tapped \"first_bending_hz\" in it sets the stiffness, and a \"balance_point\" is compared.",
];

const ON_PROFILE: &str = "From the knob end. More places where it bends more make it truer; the \
                          same x twice is a step; \"wall_thickness\" makes it hollow.";

/// The text of the file.
pub fn text(bat: &Measured) -> String {
    let comment: Vec<String> = COMMENT.iter().map(|line| format!("    {}", quoted(line))).collect();
    let rows = rows(bat);
    let [x, diameter, inner] = columns(&rows);
    let mut out = String::from("{\n  \"format\": \"sweetspot-bat/1\",\n");
    let _ = writeln!(out, "  \"comment\": [\n{}\n  ],", comment.join(",\n"));
    let words = [("name", &bat.name), ("source", &bat.source), ("material", &bat.material)];
    for (key, value) in words {
        let _ = writeln!(out, "  \"{key}\": {},", quoted(value));
    }
    let weighed =
        [("mass", &bat.mass), ("balance_point", &bat.balance), ("first_bending_hz", &bat.tap)];
    let told = |(key, value): &(&str, &Option<String>)| {
        value.as_ref().map(|value| format!("\"{key}\": {}", quoted(value)))
    };
    let told: Vec<String> = weighed.iter().filter_map(told).collect();
    if !told.is_empty() {
        let _ = writeln!(out, "  \"weighed\": {{ {} }},", told.join(", "));
    }
    if let Some(tape) = &bat.tape {
        let _ = writeln!(out, "  \"tapes\": [ {tape} ],");
    }
    let _ = writeln!(out, "  \"profile\": {{\n    \"comment\": {},", quoted(ON_PROFILE));
    let _ = writeln!(out, "    \"unit\": \"{}\",", bat.unit);
    let _ = write!(out, "    \"x\":        [{x}],\n    \"diameter\": [{diameter}]");
    if bat.cup.is_some() {
        let _ = write!(out, ",\n    \"inner_diameter\": [{inner}]");
    }
    if let Some(wall) = &bat.wall {
        let walls = vec![quoted(wall); rows.len()].join(", ");
        let _ = write!(out, ",\n    \"wall_thickness\": [{walls}]");
    }
    marks::json(&(out + "\n  }\n}\n"))
}

/// Place, diameter and diameter of the hole at every station. A cup has its own stations, with the outer diameters of
/// the curve through the measured ones. With `v` from 0 at its bottom to 1 at the rim, its width is `1 − (1 − v)³` of
/// the rim's, as for the edit `cup`.
fn rows(bat: &Measured) -> Vec<[f64; 3]> {
    /// Stations of the cup, as shares of its depth from the rim.
    const SHARES: [f64; 4] = [1.0, 0.75, 0.5, 0.25];
    let mut rows: Vec<[f64; 3]> = bat.stations.iter().map(|[x, d]| [*x, *d, 0.0]).collect();
    let (Some([depth, wide]), Some([end, ..])) = (bat.cup, rows.last().copied()) else {
        return rows;
    };
    let [x, outer] = [0, 1].map(|k| rows.iter().map(|row| row[k]).collect::<Vec<f64>>());
    let inner = vec![0.0; x.len()];
    // An invalid profile is reported when the file is read.
    let curve = Profile::new(Stations { x, outer, inner, interpolation: Interpolation::Pchip });
    let own = SHARES.map(|share| end - share * depth);
    let far = |x: &f64| rows.iter().all(|row| (row[0] - x).abs() > 0.1 * depth);
    let own: Vec<f64> = own.into_iter().filter(|x| *x > 0.0 && far(x)).collect();
    if let Ok(curve) = curve {
        rows.extend(own.into_iter().map(|x| [x, curve.at(x).outer, 0.0]));
    }
    rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
    for [x, _, inner] in &mut rows {
        let v = ((*x - (end - depth)) / depth).clamp(0.0, 1.0);
        *inner = wide * (1.0 - (1.0 - v).powi(3));
    }
    rows
}

/// The columns, the numbers of a station above each other.
fn columns(stations: &[[f64; 3]]) -> [String; 3] {
    let mut out = [const { String::new() }; 3];
    for (k, station) in stations.iter().enumerate() {
        let last = k + 1 == stations.len();
        let cells = station.map(|v| format!("{}{}", rounded(v, 4), if last { "" } else { "," }));
        let width = cells[0].len().max(cells[1].len());
        for (line, cell) in out.iter_mut().zip(&cells) {
            let _ = if last { write!(line, "{cell}") } else { write!(line, "{cell:<width$} ") };
        }
    }
    out
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use sweetspot::Bat;

    #[test]
    fn the_file_reads_back_with_the_mass_that_was_weighed() {
        let measured = Measured {
            name: "Mine, 33.5\" \\ maple".into(),
            source: "calipers".into(),
            material: "sugar-maple-dynamic".into(),
            mass: Some("31.5 oz".into()),
            unit: "in",
            stations: vec![[0.0, 1.9], [1.25, 1.0], [15.0, 1.1], [33.5, 2.5]],
            wall: None,
            cup: None,
            balance: Some("22.5 in".into()),
            tap: None,
            tape: Some("{ \"from\": 0, \"to\": \"10 in\", \"mass\": \"0.7 oz\" }".into()),
        };
        let text = text(&measured);
        let bat = Bat::from_text("mine.json", &text, Path::new("")).unwrap();
        assert_eq!(bat.name(), measured.name);
        assert!((bat.inertia().mass / (31.5 * 0.453_592_37 / 16.0) - 1.0).abs() < 1e-12);
        assert!((bat.length() - 33.5 * 0.0254).abs() < 1e-15);
        assert!((bat.profile().at(15.0 * 0.0254).outer - 0.55 * 0.0254).abs() < 1e-15);
        let place = |key: &str, number: &str| {
            let line = text.lines().find(|line| line.trim_start().starts_with(key)).unwrap();
            line.find(number).unwrap()
        };
        assert_eq!(place("\"x\"", "15"), place("\"diameter\"", "1.1"), "{text}");
    }

    /// `∫ (1 − (1 − v)³)² dv = 1 − 2/4 + 1/7`, over the depth.
    #[test]
    fn a_cup_and_a_wall_are_in_the_file_and_the_bat_weighs_what_the_scale_said() {
        let solid = Measured {
            name: "Cupped".into(),
            source: "calipers".into(),
            material: "sugar-maple-dynamic".into(),
            mass: None,
            unit: "in",
            stations: vec![[0.0, 1.9], [1.25, 1.0], [15.0, 1.1], [26.0, 2.5], [33.5, 2.5]],
            wall: None,
            cup: None,
            balance: None,
            tap: None,
            tape: None,
        };
        let read = |measured: &Measured| {
            Bat::from_text("cupped.json", &text(measured), Path::new("")).unwrap()
        };
        let cupped = Measured { cup: Some([1.0, 1.6]), ..solid.clone() };
        let density = read(&solid).material().density;
        let lost = read(&solid).inertia().mass - read(&cupped).inertia().mass;
        let cup = 0.642_857 * std::f64::consts::PI * 0.8_f64.powi(2) * 0.0254_f64.powi(3) * density;
        assert!((lost / cup - 1.0).abs() < 0.02, "{lost} {cup}");
        let weighed = Measured { mass: Some("31 oz".into()), ..cupped };
        let mass = read(&weighed).inertia().mass / (31.0 * 0.453_592_37 / 16.0);
        assert!((mass - 1.0).abs() < 1e-12, "{mass}");
        let wall = Some("3 mm".to_owned());
        let hollow = read(&Measured { wall, material: "aluminium-7075".into(), ..solid });
        let section = hollow.profile().at(0.7);
        assert!((section.outer - section.inner - 3e-3).abs() < 1e-12);
    }
}
