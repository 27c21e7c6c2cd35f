//! The request: the scene, the files as written, the bat as the program understood it.

use serde_json::Value;

use crate::analysis::Analysis;
use crate::parts::Quantity::{Inertia, Length, Mass, Speed, Stiffness};
use crate::parts::{Table, Units};
use crate::report::resolved::resolved;
use crate::report::tables::NONE;
use crate::report::wall_text::by;
use crate::schema;
use sweetspot::collision::figures::BarrelSpeed;
use sweetspot::collision::{Model, Scene};

/// Swing, pitch and ball.
pub fn scene(analysis: &Analysis, units: Units) -> Table {
    let scene = &analysis.task.scene;
    let mut table = Table::of_words("The scene", &["What", "Value"]);
    let mut line = |(what, value): (&str, String)| table.row([what.to_owned(), value]);
    model(analysis).into_iter().for_each(&mut line);
    swing(analysis, units).into_iter().for_each(&mut line);
    line(("pitch", Speed.said(units, scene.ball_speed)));
    ball(scene, units).into_iter().for_each(&mut line);
    line(("hands feel the hit at", format!("{} from the knob", Length.said(units, scene.hands))));
    if let Some(wall) = scene.wall {
        line(("the barrel's wall, stiffness", Stiffness.said(units, wall.stiffness)));
        line(("  its mass", Mass.said(units, wall.mass)));
    }
    if let Some(wall) = scene.hoop.wall() {
        line(("the barrel's wall gives way", by(wall)));
    }
    if analysis.bat.fixtures().holding() {
        line(("the bat is held", "energies are as its hands see them".to_owned()));
    }
    table
}

/// A name and a value.
type SceneRow = (&'static str, String);

fn model(analysis: &Analysis) -> Vec<SceneRow> {
    let model = analysis.task.model;
    let mut lines = vec![("model of the collision", model.name().to_owned())];
    match model {
        Model::EnergyLoss(loss) => lines.extend([
            ("size of the empirical loss, γ", plain(loss.gamma)),
            ("its decay with the mode, p", plain(loss.decay)),
        ]),
        Model::Pulse(pulse) => lines.extend([
            ("duration of the force", format!("{} ms", digits(1e3 * pulse.duration))),
            ("share of the vibration that the ball does not lose", plain(pulse.loss_share)),
        ]),
        Model::Rigid | Model::Contact => {}
    }
    lines
}

fn swing(analysis: &Analysis, units: Units) -> Vec<SceneRow> {
    let scene = &analysis.task.scene;
    let mut lines = vec![("swing", format!("{:.2} rad/s", scene.swing))];
    if let Some(law) = analysis.task.law {
        lines.extend([
            ("  of the reference bat", format!("{:.2} rad/s", law.of_reference)),
            ("  which has a swing weight of", Inertia.said(units, law.reference)),
            ("  speed against swing weight, exponent", plain(law.exponent)),
        ]);
    }
    let side = if scene.pivot < 0.0 { "inside" } else { "beyond" };
    let pivot = Length.said(units, scene.pivot.abs());
    lines.push(("rotation centre of the swing", format!("{pivot} {side} the knob end")));
    let barrel = BarrelSpeed::of(&analysis.bat, scene, BarrelSpeed::BROADCAST);
    lines.push(("speed of the bat 6 in from the tip", Speed.said(units, barrel.speed)));
    lines
}

fn ball(scene: &Scene, units: Units) -> Vec<SceneRow> {
    let ball = &scene.ball;
    let mut lines = vec![
        ("ball", ball.name.clone()),
        ("  its mass", Mass.said(units, ball.mass_kg)),
        ("  its radius", Length.said(units, ball.radius_m)),
    ];
    if let (Some(stiffness), Some(exponent)) = (ball.stiffness, ball.exponent) {
        let [k, alpha] = [stiffness, exponent].map(plain);
        lines.push(("  its force, k·u^α", format!("k = {k} N/m^α, α = {alpha}")));
    }
    let cor = match ball.cor_by_speed.is_empty() {
        true => plain(scene.cor),
        false => "by its speed, see the ball's file".to_owned(),
    };
    lines.push(("  coefficient of restitution", cor));
    if !ball.source.is_empty() {
        lines.push(("  source", ball.source.clone()));
    }
    lines
}

/// A value as it was read, with as few digits as needed to read back the same bits.
fn plain(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-3..1e6 => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// A value with seven digits, without zeros at its end.
fn digits(value: f64) -> String {
    plain(format!("{value:.6e}").parse().unwrap_or(value))
}

/// Longer tables are cut.
const MOST: usize = 400;

/// The bat as understood: every value in SI except the columns of the profile, limited to the first ones.
pub fn values(analysis: &Analysis) -> Table {
    let head = ["Key", "Value", "Unit"];
    let mut table = Table::new("The bat as it was understood, in SI", &head);
    let bat = schema::value(&resolved(&analysis.bat));
    for (key, value) in bat.as_object().into_iter().flatten() {
        if !matches!(key.as_str(), "format" | "name" | "source" | "profile") {
            flat(key, value, &mut table);
        }
    }
    let count = table.rows.len();
    if count > MOST {
        table.rows.truncate(MOST);
        table.caption += &format!(": the first {MOST} of {count} values");
    }
    if let Some(interpolation) = bat["profile"]["interpolation"].as_str() {
        table.row(["profile.interpolation", interpolation, ""]);
    }
    let [density, modulus] = analysis.bat.factors();
    if analysis.bat.factors() != [1.0; 2] {
        table.row(["factor on all densities, as weighed", &plain(density), ""]);
        table.row(["factor on all moduli, as tapped", &plain(modulus), ""]);
    }
    table
}

/// A value and all that is within it.
fn flat(path: &str, value: &Value, table: &mut Table) {
    match value {
        Value::Object(map) => {
            map.iter().for_each(|(key, value)| flat(&format!("{path}.{key}"), value, table));
        }
        Value::Array(items) => {
            let items = items.iter().enumerate();
            items.for_each(|(k, item)| flat(&format!("{path}[{k}]"), item, table));
        }
        Value::Number(number) => {
            let shown = number.as_f64().map_or(number.to_string(), digits);
            table.row([path, &shown, unit(path)]);
        }
        Value::String(text) => table.row([path, text.as_str(), ""]),
        Value::Bool(_) | Value::Null => table.row([path, NONE, ""]),
    }
}

/// The SI unit of a key of a bat file.
fn unit(path: &str) -> &'static str {
    let grip = path.starts_with("grip");
    match path.rsplit('.').next().unwrap_or_default() {
        "x" | "from" | "to" | "offset" | "balance_point" => "m",
        "depth" | "diameter" | "thickness" | "blend" | "tip" => "m",
        "knob" if path.ends_with("shorten.knob") => "m",
        "mass" | "knob" => "kg",
        "density" => "kg/m³",
        "youngs_modulus" | "shear_modulus" => "Pa",
        "rotary_inertia" => "kg m²",
        "rotational_stiffness" => "N m/rad",
        "stiffness" if grip => "N/m²",
        "damping" if grip => "N s/m²",
        "stiffness" => "N/m",
        "damping" => "N s/m",
        "first_bending_hz" => "Hz",
        _ => "",
    }
}

/// The columns of the profile in SI, limited to the first ones; formulas as written.
pub fn profile(analysis: &Analysis) -> Table {
    // Edits change it piece by piece, and no column has them.
    let profile = analysis.bat.unedited().profile();
    let before = if analysis.bat.edits().is_empty() { "" } else { ", before its edits" };
    if let Some(formulas) = &profile.formulas {
        let mut table = Table::of_words(
            format!("The profile{before}"),
            &["From, m", "To, m", "Radius", "Bore"],
        );
        for piece in &formulas.pieces {
            let bore = piece.inner.as_ref().map_or("none", |inner| inner.text());
            let [from, to] = [piece.from, piece.to].map(plain);
            table.row([&from, &to, piece.outer.text(), bore]);
        }
        return table;
    }
    let stations = &profile.stations;
    let count = stations.x.len();
    let caption = match count > MOST {
        true => format!("The profile{before}: the first {MOST} of {count} stations"),
        false => format!("The profile{before}"),
    };
    let mut table = Table::new(caption, &["x, m", "Radius, m", "Inner radius, m"]);
    let metres = |x: f64| format!("{:.5}", x);
    for k in 0..count.min(MOST) {
        table.row([stations.x[k], stations.outer[k], stations.inner[k]].map(metres));
    }
    table
}
