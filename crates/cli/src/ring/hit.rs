//! `ring --hit`: motion and strain of the bat after a hit.

use sweetspot::base::units::shown_length;
use sweetspot::collision::aftermath::{Aftermath, Instant};
use sweetspot::collision::strength::breaking_swing;
use sweetspot::collision::{Effort, Hitter, Model};
use sweetspot::{Bat, Error, Result, Solution, solve};
use sweetspot_report::parts::{LINES, wrapped};
use sweetspot_report::plot::ringing;
use sweetspot_report::report::{aftermath, hit_json, hit_text};
use sweetspot_report::schema::ring::AfterHit;
use sweetspot_study::ignored;

use crate::common::{Prepared, as_options, on_the_bat};
use crate::done::Done;
use crate::output::put;
use crate::ring::args::{Args, csv, period, places, times, write_sound};
use crate::scene;

/// A hit and its results.
pub fn run(args: &Args, bat: Bat, x: f64) -> Result<Done> {
    let x = on_the_bat(&bat, "--hit", x)?;
    let count = asked(args, &bat)?;
    let (setup, model) = args.scene.setup()?;
    if model != Model::Contact {
        let expected = "contact, the model with a force in time";
        return Err(Error::value("--model", model.name(), expected));
    }
    let prepared = args.bat.prepare(bat, count, &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let tolerance = (!args.bat.asked()).then_some(request.tolerance);
    let (scene, _) = setup.scene(&bat, tolerance).map_err(as_options)?;
    scene::warn(&setup, [&bat], &args.output);
    let solution = solve(&bat, &request)?;
    args.solve.say_raised(&solution, &args.output);
    let effort = Effort { completed: !args.bat.asked(), ..Effort::default() };
    let hitter = Hitter::new(model, &scene, &bat, &solution, effort)?;
    let impact = hitter.strike(x);
    let Some(force) = hitter.force(x) else {
        let found = format!("no contact at {} ({})", shown_length(x), impact.flags.join(", "));
        return Err(Error::value("--hit", found, "a place where ball and bat meet"));
    };
    let after = Aftermath::new(&bat, &solution, x, force);
    let until = args.until.unwrap_or(3.0 * period(&solution));
    if !(until > 0.0 && until < 1e3) {
        return Err(Error::value("--until", format!("{until:?} s"), "above 0 and below 1000 s"));
    }
    let watched = if args.watch.is_empty() { vec![scene.hands] } else { args.watch.clone() };
    let mut report = AfterHit::new(&bat, &after, &watched, until);
    for load in &mut report.strength {
        load.reached_at_swing_rad_s =
            breaking_swing(&bat, &solution, (&scene, effort), (x, until), load.limit);
    }
    let sound = args.wav.as_ref().map(|path| {
        write_sound(path, (&bat, &solution), &scene.ball, |of, wall| after.sound(of, wall))
    });
    let heard = sound.transpose()?.into_iter().flatten();
    let heard: String = heard.map(|told| wrapped(&format!("Sound: {told}"), 2)).collect();
    let code = args.solve.verdict(&solution, &args.output);
    let text = args.output.screen(LINES, |full| {
        let units = args.output.units(&bat);
        let scene = hit_text::scene(&bat, &scene, model, units);
        let hit = aftermath::impact(&impact, after.end(), units);
        let text = scene + &hit + &aftermath::text(&bat, &report, units, full);
        [(1, "motion and strength", text), (0, "", heard.clone())]
    });
    let document = || {
        let ignored = ignored::in_hit(&bat, &scene);
        aftermath::document(report.clone(), hit_json::impact(&bat, &impact), ignored)
    };
    let drawn = |sheet| Ok(ringing::after_hit(sheet, &after, &report));
    let frames = || frames_after(args, &bat, &solution, &after);
    let text = args.output.answer((&bat, text), drawn, document, frames)?;
    let text = put(&args.history, text, || Ok(aftermath::history(&report)))?;
    Ok(Done::new(text, code).with(warning))
}

/// Number of requested modes; checks that the options are possible together.
fn asked(args: &Args, bat: &Bat) -> Result<usize> {
    /// Number of modes whose sum gives a bat's strain to a few per cent.
    const ENOUGH: usize = 40;
    if let Some(place) = args.watch.iter().find(|x| !(0.0..=bat.length()).contains(*x)) {
        on_the_bat(bat, "--watch", *place)?;
    }
    args.solve.refuse_budget("ring --hit")?;
    let count = if args.bat.asked() { args.bat.count() } else { ENOUGH };
    Ok(args.solve.modes_within(count, bat.profile().pieces.len()))
}

/// The bat's deflections after a hit as CSV, the instants in their order.
fn frames_after(args: &Args, bat: &Bat, solution: &Solution, after: &Aftermath) -> String {
    let places = places(args, bat);
    let mut times = times(args, solution);
    times.sort_by(f64::total_cmp);
    let deflections = |now: &Instant| places.iter().map(|x| after.motion(*x, now)[0]).collect();
    let frames: Vec<Vec<f64>> = after.at(&times).iter().map(deflections).collect();
    csv(&places, &times, &frames)
}
