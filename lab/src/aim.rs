//! Which least change of the bat meets a wish?

use std::path::Path;

use serde_json::{Value, json};
use sweetspot::Bat;
use sweetspot::base::error::{Error, Result};
use sweetspot_report::report::{aimed, aimed_text};
use sweetspot_study::aim::aimed::Outcome;
use sweetspot_study::aim::bench::Terms;
use sweetspot_study::aim::wish::Wish;
use sweetspot_study::files::aim_text;
use sweetspot_study::lathe::workpiece::HitTerms;

use crate::asked::{Question, request};
use crate::hit::Solved;

/// The most that a pass of the lathe takes off the diameter (m), as in `sweetspot aim`.
const PASS: f64 = 1e-3;

pub fn answer(of: &Question) -> Result<Value> {
    let wish = wish(of)?;
    let Solved { bat, request: asked, scene, law, model, .. } = Solved::new(of, request(), true)?;
    let hit = HitTerms { scene, model, exactly: false };
    let terms = Terms { request: asked, hit, law };
    let outcome = Outcome::of(&bat, &wish, &terms)?;
    // The answer describes the file as it is read again.
    let text = aimed::bat_text(&outcome);
    let written = Bat::from_text("the new bat", &text, Path::new(""))?;
    let outcome =
        outcome.read_back(written.with(|parts| parts.inches = bat.inches())?, &wish, &terms)?;
    let pieces = aimed_text::text(&outcome, (PASS, of.units.us_first(), false));
    let told: String = pieces.into_iter().map(|(_, _, text)| text).collect();
    Ok(json!({ "met": outcome.met, "bat_file": text, "text": told }))
}

/// The wishes, in the notation of `sweetspot aim --target`.
fn wish(of: &Question) -> Result<Wish> {
    let targets = of.more.get("targets").and_then(Value::as_array);
    let expected = "a list of texts, such as [\"swing weight -3 %\"]";
    let targets = targets.ok_or_else(|| Error::value("targets", "no list", expected))?;
    let remove_only = of.more.get("remove_only").is_some_and(|only| only == true);
    let mut wish = Wish { remove_only, ..Wish::default() };
    for target in targets {
        let text = target.as_str().unwrap_or_default();
        wish.targets.push(aim_text::target(text).map_err(Error::Value)?);
    }
    Ok(wish)
}
