//! How is a bat exported: its file, a table, a template, the command with the same numbers?

use serde_json::{Value, json};
use sweetspot::base::error::Result;
use sweetspot::base::number::{rounded, shortest};
use sweetspot::base::units::inches;
use sweetspot::bat::body::Bat;
use sweetspot_report::template::pages::pages;
use sweetspot_report::template::sheet::PAPERS;

use crate::asked::{BAT, Question};
use crate::open::in_stations;

pub fn answer(of: &Question) -> Result<Value> {
    let paper = PAPERS[usize::from(of.bat.inches())];
    let pages: Vec<String> = pages(&of.bat, &of.bat, paper).iter().map(|page| page.svg()).collect();
    Ok(json!({
        "bat_file": of.text, "csv": csv(&of.bat), "template": pages, "command": command(of),
    }))
}

/// The stations as a table that `open` reads.
fn csv(bat: &Bat) -> String {
    let stations = in_stations(bat.unedited().profile());
    let (unit, per) = if bat.inches() { ("in", inches(1.0)) } else { ("mm", 1e3) };
    let hollow = stations.inner.iter().any(|r| *r > 0.0);
    let number = |value: f64| shortest(rounded(per * value, 9));
    let mut out = format!("x_{unit},diameter_{unit}");
    out += &if hollow { format!(",inner_diameter_{unit}\n") } else { "\n".to_owned() };
    for ((x, outer), inner) in stations.x.iter().zip(&stations.outer).zip(&stations.inner) {
        out += &format!("{},{}", number(*x), number(2.0 * outer));
        out += &if hollow { format!(",{}\n", number(2.0 * inner)) } else { "\n".to_owned() };
    }
    out
}

/// The command that prints the same numbers, for a shell.
fn command(of: &Question) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,%+".contains(c);
    let quoted = |text: &str| match !text.is_empty() && text.chars().all(plain) {
        true => text.to_owned(),
        false => format!("'{}'", text.replace('\'', "'\\''")),
    };
    let mut line = format!("sweetspot analyze {}", quoted(of.said("name").unwrap_or(BAT)));
    for (member, value) in &of.scene {
        let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        line += &format!(" --{} {}", member.replace('_', "-"), quoted(&value));
    }
    if let Some(traced) = of.traced() {
        line += &format!(" --calipers '{} mm'", rounded(1e3 * traced, 4));
    }
    line + if of.units.us_first() { " --units us" } else { " --units si" }
}
