//! The distribution of the energy of a hit, along the bat.

use crate::plot::{
    Chart, Ink, MUTED, PAPER, Panel, Pen, Picture, Plane, SERIES, Series, Sheet, Svg, TEXT, Tag,
    Unit, digits, room, short, tags,
};
use sweetspot::Bat;
use sweetspot::collision::Impact;
use sweetspot::collision::hit::Energy;

/// Modes that have a layer each.
const MODES: usize = 3;
/// Height of the diagram (px).
const DIAGRAM: f64 = 300.0;
/// Share of the energy below which a layer is invisible.
const UNSEEN: f64 = 1e-4;

/// A part of the energy along the bat.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Name of the part of the energy.
    pub name: String,
    /// Energy at each impact (J); None where ball and bat did not meet.
    pub energies: Vec<Option<f64>>,
    look: (Ink, f64),
}

/// All parts, from the lowest in the drawing. Their sum is the initial energy unless the model loses some.
pub fn layers(impacts: &[Impact]) -> Vec<Layer> {
    let energies = || impacts.iter().filter_map(|i| Some(&i.outcome.as_ref()?.energy));
    let count = energies().map(|e| e.vibration_by_mode.len()).max().unwrap_or(0);
    let layer = |name: String, look, of: &dyn Fn(&Energy) -> f64| Layer {
        name,
        energies: impacts.iter().map(|i| Some(of(&i.outcome.as_ref()?.energy))).collect(),
        look,
    };
    let [blue, vermilion, green, purple, ochre, grey] = SERIES;
    let shades = [1.0, 0.7, 0.45];
    let mut all = vec![
        layer("ball".into(), (blue, 0.85), &|e| e.ball),
        layer("lost in the ball".into(), (ochre, 0.6), &|e| e.dissipated_ball),
    ];
    for k in 0..MODES.min(count) {
        let name = format!("vibration, mode {}", k + 1);
        let of = move |e: &Energy| e.vibration_by_mode.get(k).copied().unwrap_or(0.0);
        all.push(layer(name, (vermilion, shades[k]), &of));
    }
    if count > MODES {
        let name = match count - MODES {
            1 => format!("vibration, mode {count}"),
            _ => format!("vibration, modes {} to {count}", MODES + 1),
        };
        let of = |e: &Energy| e.vibration_by_mode.iter().skip(MODES).sum();
        all.push(layer(name, (purple, 0.7), &of));
    }
    all.push(layer("damped in the bat".into(), (MUTED, 0.8), &|e| e.dissipated_damping));
    all.push(layer("wall of the barrel".into(), (green, 0.9), &|e| e.wall));
    all.push(layer("bat as a whole".into(), (grey, 0.3), &|e| e.bat_rigid));
    all
}

/// The greatest energy before any of these hits (J).
pub fn greatest(impacts: &[Impact]) -> f64 {
    let initial = impacts.iter().filter_map(|i| Some(i.outcome.as_ref()?.energy.initial));
    initial.fold(0.0, f64::max)
}

/// The stacked energies, picture `ledger`, on a scale up to these (J) at least. None without two adjacent hits.
pub fn picture(
    sheet: Sheet,
    name: &str,
    bat: &Bat,
    impacts: &[Impact],
    up_to: f64,
) -> Option<Picture> {
    let initial: Vec<f64> =
        impacts.iter().filter_map(|i| Some(i.outcome.as_ref()?.energy.initial)).collect();
    let greatest = greatest(impacts);
    let (first, last) = (impacts.first()?.x, impacts.last()?.x);
    if initial.len() < 2 || first >= last || greatest <= 0.0 {
        return None;
    }
    let seen = |layer: &Layer| layer.energies.iter().flatten().any(|e| *e > UNSEEN * greatest);
    let layers: Vec<Layer> = layers(impacts).into_iter().filter(seen).collect();
    let names: Vec<&str> = layers.iter().map(|layer| layer.name.as_str()).collect();
    let stacks = stacked(&layers);
    let unit = sheet.energy();
    let least = initial.iter().copied().fold(f64::INFINITY, f64::min);
    let sum = if greatest - least < 1e-6 * greatest {
        format!("{} {} before the hit", short(unit.per * greatest), unit.name)
    } else {
        let [least, greatest] = [least, greatest].map(|energy| short(unit.per * energy));
        format!("{least} to {greatest} {} before the hit", unit.name)
    };
    let held = if bat.fixtures().holding() { ", as the hands see it" } else { "" };
    let facts = format!("{sum}{held}, {}", books(unit, impacts, greatest));
    let alt =
        format!("{name}: {facts}. Stacked against the place of the hit: {}.", names.join(", "));
    let before = |i: &Impact| Some([i.x, i.outcome.as_ref()?.energy.initial]);
    let before = Series::curve("", 0, impacts.iter().map(before).collect());
    let mut curves = vec![before.pen(Pen::new(TEXT, 1.5)).untold()];
    curves.extend(areas(impacts, &layers, &stacks));
    let (keys, beside) = match sheet.narrow() {
        true => (&curves[1..], 0.0),
        false => (&[][..], room(&names, 220.0) - sheet.right()),
    };
    let ends = ([first, last], &[(name, bat.length())][..]);
    let called = ("ledger", "Where the energy goes");
    let chart = Chart::along(sheet, called, [name, &facts], ends).keys(keys).right(beside);
    let panel = Panel::around(DIAGRAM, ("energy", unit), curves, &[0.0, greatest, up_to]);
    let panel = panel.over(|svg, plane| named(svg, plane, impacts, (&layers, &stacks)));
    Some(chart.read_off().panel(panel).picture(sheet, &alt))
}

/// Whether everything is there after the hit.
fn books(unit: Unit, impacts: &[Impact], greatest: f64) -> String {
    let off = impacts.iter().filter_map(|i| Some(i.outcome.as_ref()?.energy.imbalance.abs()));
    let most = off.fold(0.0, f64::max);
    if most < 1e-3 * greatest {
        "all of it accounted for".into()
    } else {
        let most = digits(unit.per * most, 3);
        format!("the line; the model misplaces up to {most} {}", unit.name)
    }
}

/// The upper edges of the layers, each on the ones below (J).
pub fn stacked(layers: &[Layer]) -> Vec<Vec<Option<f64>>> {
    let mut sum = vec![0.0; layers.first().map_or(0, |layer| layer.energies.len())];
    let on_top = |layer: &Layer| {
        let all = layer.energies.iter().zip(&mut sum).map(|(energy, sum)| {
            *sum += (*energy)?;
            Some(*sum)
        });
        all.collect()
    };
    layers.iter().map(on_top).collect()
}

/// Each layer as a filled outline, wherever there were hits.
fn areas(impacts: &[Impact], layers: &[Layer], stacks: &[Vec<Option<f64>>]) -> Vec<Series> {
    let area = |(layer, above): (&Layer, &Vec<Option<f64>>)| {
        let edge = |k: usize| {
            let (energy, above) = (layer.energies[k]?, above[k]?);
            Some([impacts[k].x, above - energy, above])
        };
        let edges: Vec<Option<[f64; 3]>> = (0..impacts.len()).map(edge).collect();
        let mut points = vec![];
        for run in edges.split(Option::is_none) {
            let lower = run.iter().flatten().map(|[x, low, _]| Some([*x, *low]));
            let upper = run.iter().rev().flatten().map(|[x, _, high]| Some([*x, *high]));
            points.extend(lower.chain(upper).chain([None]));
        }
        let (ink, opacity) = layer.look;
        let area = Series::curve(&layer.name, 0, points).pen(Pen::new(PAPER, 0.8));
        area.filled(ink, opacity).untold()
    };
    layers.iter().zip(stacks).map(area).collect()
}

/// The names of the layers beside the frame, where there is room, and their energies in tooltips.
fn named(
    svg: &mut Svg,
    plane: &Plane,
    impacts: &[Impact],
    (layers, stacks): (&[Layer], &[Vec<Option<f64>>]),
) {
    let unit = svg.sheet.energy();
    let mut names: Vec<Tag> = vec![];
    for (layer, above) in layers.iter().zip(stacks) {
        let middle = |k: usize| {
            let (energy, above) = (layer.energies[k]?, above[k]?);
            Some((plane.at([impacts[k].x, above - 0.5 * energy]), energy))
        };
        let words =
            |energy: f64| format!("{}: {} {}", layer.name, short(unit.per * energy), unit.name);
        let told = (0..impacts.len()).filter_map(middle);
        let told: Vec<_> = told.map(|(at, energy)| (at, words(energy))).collect();
        names.extend(told.last().map(|([_, y], _)| (*y, layer.name.clone(), TEXT)));
        svg.hover(&told, 60 / layers.len().max(1));
    }
    if !svg.sheet.narrow() {
        tags(svg, plane.frame, &names);
    }
}
