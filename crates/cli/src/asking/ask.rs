//! How are the answers of a person with a ruler, calipers and a scale read?

use sweetspot::base::error::Complaint;
use sweetspot::base::number::rounded;
use sweetspot::base::typed;
use sweetspot::base::units::{self, Quantity, inches};
use sweetspot::bat::material::{BUILT_IN, BuiltIn};
use sweetspot_report::parts::note;

use crate::asking::dialogue::Read;
use crate::value::{BAT_LENGTH, DIAMETER, PLACE, TAP};

/// Suggested places for diameters: close together at the knob, then every few inches, and just before the tip.
pub fn suggested(length: f64, unit: &str) -> Vec<f64> {
    let (near, step): (&[f64], f64) = match unit {
        "in" => (&[0.0, 0.5, 1.0, 1.5, 3.0], 3.0),
        _ => (&[0.0, 1.0, 2.5, 4.0, 7.5], 7.5),
    };
    let rest = (2..).map(|k| f64::from(k) * step).take_while(|x| x + 0.3 * step < length);
    near.iter().copied().filter(|x| *x < length).chain(rest).chain([length]).collect()
}

/// A diameter at the suggested place, or a place and its diameter; `None` for an empty line. Places must rise from
/// those `before`. The first is 0, none is beyond the tip, and two equal places between are a step.
pub fn station(
    text: &str,
    suggested: Option<f64>,
    before: &[[f64; 2]],
    length: f64,
    unit: &str,
) -> Read<Option<[f64; 2]>> {
    let wrong = |found: String, expected: &str| Err(Complaint::new("", found, expected));
    if text.is_empty() {
        let expected = "the knob end's diameter, which begins the bat";
        return if before.is_empty() { wrong("nothing".into(), expected) } else { Ok(None) };
    }
    let (x, diameter) = match (apart(text, suggested.is_some()), suggested) {
        (Some((x, diameter)), _) => (measured(x, unit)?, diameter),
        (None, Some(x)) => (x, text),
        (None, None) => {
            let expected = "a place and its diameter, such as \"3 in, 0.98 in\"";
            return wrong(format!("\"{text}\""), expected);
        }
    };
    DIAMETER.sensible(diameter, unit)?;
    let diameter = measured(diameter, unit)?;
    after(before, x, length, unit)?;
    let metres = in_metres(diameter, unit);
    if !(0.0..=0.1).contains(&metres) || (diameter == 0.0 && 0.0 < x && x < length) {
        let found = format!("a diameter of {diameter} {unit} at {x} {unit}");
        return wrong(found, "that of a bat, above 0 and up to 3.9 in (10 cm)");
    }
    Ok(Some([x, diameter]))
}

/// The stations after the answer for the suggested place or for a place of the person's choice: a diameter, or two for
/// a step. It replaces an earlier answer for that place. `None` for an empty line.
pub fn put(
    text: &str,
    suggested: f64,
    stations: &[[f64; 2]],
    length: f64,
    unit: &str,
) -> Read<Option<Vec<[f64; 2]>>> {
    let step = text.matches(", ").count() == 2;
    let (one, after) = if step { text.rsplit_once(", ").unzip() } else { (Some(text), None) };
    let one = one.unwrap_or(text);
    let place = |text| apart(text, true).map(|(x, _)| measured(x, unit)).transpose();
    let x = if one.is_empty() { suggested } else { place(one)?.unwrap_or(suggested) };
    let at = stations.partition_point(|station| station[0] < x);
    let Some(first) = station(one, Some(suggested), &stations[..at], length, unit)? else {
        return Ok(None);
    };
    let same = stations[at..].iter().take_while(|station| station[0] == x).count();
    let mut all = stations[..at].to_vec();
    all.push(first);
    if let Some(after) = after {
        let text = format!("{x}, {after}");
        all.extend(station(&text, None, &all, length, unit)?);
    }
    all.extend_from_slice(&stations[at + same..]);
    Ok(Some(all))
}

/// Two numbers separated by a comma or blanks. Where a single diameter is possible, 1,5 may mean one and a half.
fn apart(text: &str, one_would_do: bool) -> Option<(&str, &str)> {
    let comma = if one_would_do && !text.contains('.') { ", " } else { "," };
    let number = |text: &str| typed::number(text).is_some();
    let blank = || text.split_once(' ').map(|(x, diameter)| (x, diameter.trim()));
    text.split_once(comma).or_else(|| blank().filter(|(x, d)| number(x) && number(d)))
}

/// Whether a place may follow those before it.
fn after(before: &[[f64; 2]], x: f64, length: f64, unit: &str) -> Read<()> {
    let here = before.iter().filter(|station| station[0] == x).count();
    let (found, expected) = match before.last() {
        None if x != 0.0 => (String::new(), "0, the knob end, as the first place".to_owned()),
        Some([last, _]) if x < *last => {
            (format!(" after {last} {unit}"), "places from knob to tip".to_owned())
        }
        _ if x > length => (String::new(), format!("no place beyond the tip at {length} {unit}")),
        _ if here == 1 && (x == 0.0 || x == length) => {
            (" a second time".to_owned(), "one diameter at an end of the bat".to_owned())
        }
        _ if here > 1 => (" a third time".to_owned(), "two diameters at a step".to_owned()),
        _ => return Ok(()),
    };
    Err(Complaint::new("", format!("{x} {unit}{found}"), expected))
}

fn in_metres(value: f64, unit: &str) -> f64 {
    value * units::factor(unit, Quantity::Length).unwrap_or(1.0)
}

/// A length in the ruler's unit: a bare number is in it, others are converted.
pub fn measured(text: &str, unit: &str) -> Read<f64> {
    let text = text.trim();
    match typed::number(text) {
        Some(value) => Ok(value),
        None => {
            let bare = || units::parse(&format!("{text} {unit}"), Quantity::Length);
            let metres = units::parse_beside(text, Quantity::Length, unit);
            let metres = metres.or_else(|complaint| bare().or(Err(complaint)))?;
            Ok(if unit == "in" { inches(metres) } else { 100.0 * metres })
        }
    }
}

/// The length of a bat in the ruler's unit.
pub fn length(text: &str, unit: &str) -> Read<f64> {
    BAT_LENGTH.sensible(text, unit)?;
    let value = measured(text, unit)?;
    if (0.1..=2.0).contains(&in_metres(value, unit)) {
        return Ok(value);
    }
    let expected = "a bat's length; 24 to 36 in (60 to 92 cm) are usual";
    Err(Complaint::new("", format!("{value} {unit}"), expected))
}

/// Whether the person says that it is not known.
pub fn unknown(text: &str) -> bool {
    let plain = text.to_lowercase().replace(['\'', '’'], "");
    ["dont know", "unknown", "none", "no"].contains(&plain.as_str())
}

/// The unit of a ruler.
pub fn unit(text: &str) -> Read<&'static str> {
    match text {
        "in" => Ok("in"),
        "cm" => Ok("cm"),
        other => Err(Complaint::new("", format!("\"{other}\""), "in or cm")),
    }
}

/// A mass with its unit, as written; `None` if it is not known.
pub fn mass(text: &str) -> Read<Option<String>> {
    if unknown(text) {
        return Ok(None);
    }
    weighed(text).map(Some)
}

/// A balance point for a bat file, on a bat of that length; `None` if it is not known.
pub fn balance(text: &str, length: f64, unit: &str) -> Read<Option<String>> {
    if unknown(text) {
        return Ok(None);
    }
    PLACE.sensible(text, unit)?;
    let place = measured(text, unit)?;
    if 0.0 < place && place < length {
        return Ok(Some(format!("{place} {unit}")));
    }
    let expected = format!("a place between the ends, 0 and {length} {unit}");
    Err(Complaint::new("", format!("{place} {unit}"), expected))
}

/// The frequency of a tap tone, or its note, for a bat file; `None` if it is not known.
pub fn tap(text: &str) -> Read<Option<String>> {
    if unknown(text) {
        return Ok(None);
    }
    let frequency = match note::frequency(text) {
        Some(frequency) => rounded(frequency, 2),
        None => {
            TAP.sensible(text, "Hz")?;
            units::parse_or_si(text, Quantity::Frequency)?
        }
    };
    if TAP.has(frequency) {
        return Ok(Some(format!("{frequency} Hz")));
    }
    let expected = "the lowest tone of a bat; 100 to 250 Hz are usual of wood";
    Err(Complaint::new("", format!("{frequency} Hz"), expected))
}

/// The line of a bat file for tape: its end from the knob, on a bat of that length, and its mass; `None` without tape.
pub fn tape(text: &str, length: f64, unit: &str) -> Read<Option<String>> {
    if unknown(text) {
        return Ok(None);
    }
    let expected = "its length and its mass, such as: 10 in, 0.7 oz";
    let wrong = || Complaint::new("", format!("\"{text}\""), expected);
    let (reach, mass) = text.split_once(", ").ok_or_else(wrong)?;
    PLACE.sensible(reach, unit)?;
    let reach = measured(reach, unit)?;
    let kilograms = units::parse(mass, Quantity::Mass)?;
    if !(0.0 < reach && reach <= length && 0.0 < kilograms && kilograms < 0.5) {
        return Err(wrong());
    }
    let mass = serde_json::Value::from(mass.trim());
    Ok(Some(format!("{{ \"from\": 0, \"to\": \"{reach} {unit}\", \"mass\": {mass} }}")))
}

/// The wall thickness of a hollow bat for a bat file; `None` for a solid one.
pub fn wall(text: &str, stations: &[[f64; 2]], unit: &str) -> Read<Option<String>> {
    if unknown(text) {
        return Ok(None);
    }
    let thickness = measured(text, unit)?;
    let diameters = stations.iter().map(|station| station[1]).filter(|diameter| *diameter > 0.0);
    let most = 0.5 * diameters.fold(f64::INFINITY, f64::min);
    if 0.0 < thickness && thickness < most && (1e-4..=0.02).contains(&in_metres(thickness, unit)) {
        let bare = typed::number(text).is_some();
        return Ok(Some(if bare { format!("{thickness} {unit}") } else { text.to_owned() }));
    }
    let expected = format!(
        "a wall below {} {unit}, half the smallest diameter; 0.06 to 0.2 in (1.5 to 5 mm) are usual",
        rounded(most, 3)
    );
    Err(Complaint::new("", format!("{thickness} {unit}"), expected))
}

/// Depth and diameter of a cup in the tip, in `unit`; `None` without a cup.
pub fn cup(text: &str, stations: &[[f64; 2]], unit: &str) -> Read<Option<[f64; 2]>> {
    /// The deepest (m): deeper is a hollow barrel.
    const DEEPEST: f64 = 0.039;
    if unknown(text) {
        return Ok(None);
    }
    let tip = stations.last().map_or(0.0, |station| station[1]);
    let expected = format!(
        "its depth, up to 1.5 in (3.9 cm), and its diameter, below {tip} {unit}, such as: 1 in, 1.6 in"
    );
    let wrong = |found: String| Complaint::new("", found, expected.clone());
    let (depth, diameter) = apart(text, false).ok_or_else(|| wrong(format!("\"{text}\"")))?;
    let [depth, diameter] = [measured(depth, unit)?, measured(diameter, unit)?];
    if 0.0 < depth && in_metres(depth, unit) <= DEEPEST && 0.0 < diameter && diameter < tip {
        return Ok(Some([depth, diameter]));
    }
    Err(wrong(format!("{depth} {unit} deep and {diameter} {unit} wide")))
}

/// A mass with its unit, as written.
pub fn weighed(text: &str) -> Read<String> {
    let kilograms = match typed::number(text) {
        Some(_) => {
            let expected = format!("its unit, too, such as \"{text} oz\" or \"{text} g\"");
            return Err(Complaint::new("", text, expected));
        }
        None => units::parse(text, Quantity::Mass).map_err(|complaint| Complaint {
            expected: "a mass such as \"31.5 oz\"".into(),
            ..complaint
        })?,
    };
    if (0.1..=5.0).contains(&kilograms) {
        return Ok(text.to_owned());
    }
    Err(Complaint::new("", text, "a bat's mass; 20 to 40 oz (570 to 1130 g) are usual"))
}

/// A built-in material by its name or its number in the list, from 1.
pub fn material(text: &str) -> Read<String> {
    let names: Vec<&str> = BUILT_IN.iter().map(|material| material.name).collect();
    let by_number = text.parse::<usize>().ok().and_then(|k| names.get(k.checked_sub(1)?));
    if let Some(name) = by_number.or_else(|| names.iter().find(|name| **name == text)) {
        return Ok((*name).to_owned());
    }
    let like: Vec<&str> = names.iter().copied().filter(|name| name.contains(text)).collect();
    let complaint =
        Complaint::new("", format!("\"{text}\""), format!("one of {}", names.join(", ")));
    Err(match like[..] {
        [_, ..] if !text.is_empty() => {
            complaint.hinted(format!("did you mean {}?", like.join(" or ")))
        }
        _ => complaint.or_nearest(text, &names),
    })
}

/// A density in the unit that belongs to the ruler's.
pub fn shown_density(density: f64, inches: bool) -> String {
    if inches {
        let pound = units::factor("lb/in^3", Quantity::Density).unwrap_or(1.0);
        format!("{:.4} lb/in³", density / pound)
    } else {
        format!("{density:.0} kg/m³")
    }
}

/// The list that [`material`] counts, a line each, in units that go with the ruler's.
pub fn materials(unit: &str) -> Vec<String> {
    let line = |(k, material): (usize, &BuiltIn)| {
        let BuiltIn { name, density, youngs_modulus, .. } = material;
        let numbers = match unit {
            "in" => {
                let psi = units::factor("psi", Quantity::Pressure).unwrap_or(1.0);
                format!("{:>6.2} million psi", 1e-6 * youngs_modulus / psi)
            }
            _ => format!("{:>6.1} GPa", 1e-9 * youngs_modulus),
        };
        let numbers = format!("{:>12} {numbers}", shown_density(*density, unit == "in"));
        format!("  {} {name:<20} {numbers}{}", k + 1, in_words(material))
    };
    BUILT_IN.iter().enumerate().map(line).collect()
}

/// The origin of a wood's stiffness, in words.
fn in_words(material: &BuiltIn) -> &'static str {
    /// No wood is denser (kg/m³).
    const WOOD: f64 = 1200.0;
    match material.name {
        name if name.ends_with("-dynamic") => "  as bats ring",
        _ if material.density < WOOD => "  as slowly bent",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_read_as_they_are_typed() {
        assert_eq!(measured("2.54 cm", "in").map(|x| (x - 1.0).abs() < 1e-12), Ok(true));
        assert_eq!(length("33 1/2", "in"), Ok(33.5));
        assert!(length("84", "in").unwrap_err().to_string().contains("84 cm or 84 in?"));
        assert!(station("34, 2", None, &[[0.0, 1.9]], 33.0, "in").is_err());
        let thick = station("25", Some(3.0), &[[0.0, 1.9]], 33.0, "in").unwrap_err().to_string();
        assert!(thick.contains("25 mm or 25 in?"), "{thick}");
        assert_eq!(mass("don’t know"), Ok(None));
        assert_eq!(tap("170"), Ok(Some("170 Hz".into())));
        // 164.81 Hz is E3.
        assert_eq!(tap("E3"), Ok(Some("164.81 Hz".into())));
        assert_eq!(tap("e3 +34"), Ok(Some("168.08 Hz".into())));
        assert!(tap("E8").is_err() && tap("H3").is_err());
        assert!(tap("17 kHz").is_err() && balance("40", 33.0, "in").is_err());
        let tape = tape("10 in, 0.7 oz", 33.0, "in").unwrap().unwrap();
        assert_eq!(tape, "{ \"from\": 0, \"to\": \"10 in\", \"mass\": \"0.7 oz\" }");
    }

    #[test]
    fn a_wall_and_a_cup_fit_the_bat() {
        let stations = [[0.0, 1.9], [3.0, 0.9], [33.0, 2.5]];
        assert_eq!(wall("3 mm", &stations, "in"), Ok(Some("3 mm".into())));
        assert_eq!(wall("0.12", &stations, "in"), Ok(Some("0.12 in".into())));
        assert_eq!(wall("no", &stations, "in"), Ok(None));
        assert!(wall("0.5", &stations, "in").is_err() && wall("0", &stations, "in").is_err());
        assert_eq!(cup("1, 1.6", &stations, "in"), Ok(Some([1.0, 1.6])));
        assert_eq!(cup("none", &stations, "in"), Ok(None));
        for wrong in ["1", "2, 1.6", "1, 2.5", "1 in, 0"] {
            assert!(cup(wrong, &stations, "in").is_err(), "{wrong}");
        }
    }

    #[test]
    fn materials_are_in_the_rulers_system_and_say_which_ring_so() {
        let [inches, metres] = ["in", "cm"].map(materials);
        assert!(inches.iter().all(|line| line.contains("lb/in³") && line.chars().count() <= 80));
        assert!(metres.iter().all(|line| line.contains("kg/m³") && line.chars().count() <= 80));
        assert!(metres.iter().any(|line| line.ends_with("as bats ring")));
    }

    #[test]
    fn suggested_places_rise_to_the_tip() {
        for (length, unit) in [(33.5, "in"), (24.0, "in"), (84.0, "cm")] {
            let places = suggested(length, unit);
            assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{places:?}");
            assert_eq!((places[0], places.last()), (0.0, Some(&length)));
        }
    }
}
