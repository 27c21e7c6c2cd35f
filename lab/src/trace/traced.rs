//! The question of the page: pictures in, a bat file out.

use serde::Deserialize;
use serde_json::{Value, json};
use sweetspot::base::error::{Error, Result};
use sweetspot::base::number::rounded;
use sweetspot::base::units::inches;
use sweetspot_report::parts::cell::two_digits;
use sweetspot_report::parts::units::Units;

use crate::trace::camera::{Camera, Outline, Told};
use crate::trace::edges::{Edges, edges};
use crate::trace::find::find;
use crate::trace::picture::{Ground, Picture};
use crate::trace::shape::{Seen, Shape};

/// The page's question about a picture.
#[derive(Deserialize)]
struct Asked {
    width: usize,
    height: usize,
    length_m: f64,
    diameter_m: f64,
    #[serde(default)]
    distance_m: Option<f64>,
    #[serde(default)]
    mass_kg: Option<f64>,
    material: String,
    #[serde(default)]
    pins: Vec<[f64; 2]>,
    /// Results of other pictures of this bat.
    #[serde(default)]
    others: Vec<Seen>,
}

/// The edges in one picture, and the bat from all pictures so far.
///
/// # Errors
///
/// [`Error::Value`] for a picture that cannot be traced.
pub fn answer(asked: &Value, bytes: &[u8], units: Units) -> Result<Value> {
    let asked: Asked = Asked::deserialize(asked)
        .map_err(|error| Error::value("the request", error, "a picture with its bat's length"))?;
    let told =
        Told { length: asked.length_m, diameter: asked.diameter_m, distance: asked.distance_m };
    check(told)?;
    let picture = Picture::new(asked.width, asked.height, bytes)?;
    let ground = Ground::of(&picture);
    let found = find(&picture, &ground)?;
    let edges = edges(&picture, &ground, found, &asked.pins);
    let middle = [0.5 * (picture.width - 1) as f64, 0.5 * (picture.height - 1) as f64];
    let outline = Outline::of(&edges, middle);
    let camera = Camera::of(&outline, told)?;
    let seen = Seen::of(&outline.sharpened(&camera), &camera, told, found.contrast);
    let others = asked.others.iter().filter(|one| {
        // Pictures for which another length was given have other places.
        one.x_m == seen.x_m && one.is_whole()
    });
    let (contrast, bow) = (found.contrast, edges.middle()[2] / camera.per_m);
    let all: Vec<Seen> = others.cloned().chain([seen.clone()]).collect();
    let shape = Shape::of(&all)?;
    Ok(json!({
        "seen": seen,
        "edges": [polyline(&edges, 0), polyline(&edges, 1)],
        "ends": edges.axis.ends.map(|u| edges.axis.place(u, edges.middle()[0] + edges.middle()[1] * u)),
        "bat_file": bat_file(&asked, &shape, all.len()),
        "stations": shape.stations.x.len(),
        "pictures": all.len(),
        "diameter_deviation_m": shape.deviation,
        "deviation": small(units, shape.deviation),
        "words": words([contrast.into(), bow], &camera, &shape, told, units),
    }))
}

fn check(told: Told) -> Result<()> {
    let within = |name, value: f64, [least, most]: [f64; 2], expected: &str| match (least..=most)
        .contains(&value)
    {
        true => Ok(()),
        false => Err(Error::value(name, format!("{value} m"), expected)),
    };
    within("length", told.length, [0.3, 1.5], "the bat's own, 0.3 to 1.5 m")?;
    within("diameter", told.diameter, [0.02, 0.1], "the largest one, 20 to 100 mm")?;
    told.distance
        .map_or(Ok(()), |far| within("distance", far, [0.5, 20.0], "0.5 to 20 m from lens to bat"))
}

/// A small length to two digits.
fn small(units: Units, value: f64) -> String {
    let (factor, name) = if units.us_first() { (inches(1.0), "in") } else { (1e3, "mm") };
    format!("{:.*} {name}", two_digits(factor * value), factor * value)
}

/// An edge in pixels of the picture, for display.
fn polyline(edges: &Edges, side: usize) -> Vec<[f64; 2]> {
    /// Number of points of a line.
    const POINTS: usize = 240;
    let last = edges.columns() - 1;
    let columns = (0..=POINTS).map(|k| k * last / POINTS);
    columns
        .map(|k| {
            edges.axis.place(edges.first + k as f64, edges.across[side][k]).map(|at| rounded(at, 4))
        })
        .collect()
}

/// The bat file of a shape.
fn bat_file(asked: &Asked, shape: &Shape, pictures: usize) -> String {
    let column = |values: &[f64], factor: f64| -> Vec<f64> {
        values.iter().map(|value| rounded(factor * value, 6)).collect()
    };
    let source = format!(
        "traced from {pictures} photograph{}; diameters to {:.2} mm (one standard deviation)",
        if pictures == 1 { "" } else { "s" },
        1e3 * shape.deviation
    );
    let mut bat = json!({
        "format": "sweetspot-bat/1",
        "name": "a bat from a photograph",
        "source": source,
        "material": asked.material,
        "profile": {
            "interpolation": "pchip",
            "unit": "mm",
            "x": column(&shape.stations.x, 1e3),
            "diameter": column(&shape.stations.outer, 2e3),
        },
    });
    if let Some(mass) = asked.mass_kg {
        bat["weighed"] = json!({ "mass": mass });
    }
    format!("{bat:#}\n")
}

/// Limits of the result in sentences, given the contrast over the noise and the bend of the middle line (m).
fn words(
    [contrast, bow]: [f64; 2],
    camera: &Camera,
    shape: &Shape,
    told: Told,
    units: Units,
) -> Vec<String> {
    let length = |value: f64| small(units, value);
    let far = match camera.nearness {
        _ if told.distance.is_some() => "as far as was told".to_owned(),
        near if near > 0.05 => format!("about {:.1} m", 1.0 / near),
        _ => "far away".to_owned(),
    };
    let said = [
        (true, format!("The picture was taken from {far}; a pixel is {}.", length(1.0 / camera.per_m))),
        (camera.doubtful(told), "It looks shorter than length and diameter say: one end lies nearer to the lens, or one of them is wrong.".to_owned()),
        (camera.nearness > 0.6, format!("From so near an end looks {} too long, which is counted; from 3 m with the zoom diameters are known better.", length(camera.beyond[0].max(camera.beyond[1])))),
        (true, format!("Behind a step such as the knob's, and at a rounded tip, the picture smears over {}: measure there, and type it.", length(told.length * 0.5 * told.diameter * camera.nearness))),
        (!shape.both, "How level the bat lay one picture does not show. Take a second one with the bat turned end for end: their mean is free of it.".to_owned()),
        (contrast < 12.0, "The bat hardly stands out from the ground: look at the edges, and set them by hand where they are wrong.".to_owned()),
        (bow > 1e-3, format!("The middle line is bent by {}: by the lens, by a shadow, or it is the bat.", length(bow))),
        (shape.apart.is_some(), format!("The pictures differ by {} more than they should: are they of one bat, and its length and diameter right?", length(shape.apart.unwrap_or_default()))),
    ];
    said.into_iter().filter(|(so, _)| *so).map(|(_, text)| text).collect()
}
