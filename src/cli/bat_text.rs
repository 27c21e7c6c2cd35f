//! A bat file written for a person: commented, its columns under each other.

use std::fmt::Write;

use crate::base::number::rounded;

/// What a bat maker measures; lengths in `unit`.
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
    /// With its unit, if it was measured.
    pub balance: Option<String>,
    /// First bending frequency with its unit, if the bat was tapped.
    pub tap: Option<String>,
    /// A tape as the file has it, if there is one.
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
    let [x, diameter] = columns(&bat.stations);
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
    let _ = writeln!(out, "    \"x\":        [{x}],\n    \"diameter\": [{diameter}]\n  }}\n}}");
    out
}

/// Both columns, each number above the other of its station.
fn columns(stations: &[[f64; 2]]) -> [String; 2] {
    let mut out = [String::new(), String::new()];
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
    use crate::Bat;

    #[test]
    fn the_file_reads_back_with_the_mass_that_was_weighed() {
        let measured = Measured {
            name: "Mine, 33.5\" \\ maple".into(),
            source: "calipers".into(),
            material: "sugar-maple-dynamic".into(),
            mass: Some("31.5 oz".into()),
            unit: "in",
            stations: vec![[0.0, 1.9], [1.25, 1.0], [15.0, 1.1], [33.5, 2.5]],
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
}
