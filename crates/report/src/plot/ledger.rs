//! Where the energy of a hit goes, along the bat.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place;
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::route::Point;
use crate::plot::series::{Tag, digits, room, short, tags};
use crate::plot::sheet::{Sheet, Unit};
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::{Ink, MUTED, PAPER, SERIES, TEXT};
use crate::plot::words::{LABEL, width};
use sweetspot::bat::body::Bat;
use sweetspot::collision::hit::{Energy, Impact};

/// Modes that have a layer each.
const MODES: usize = 3;
/// Height of the diagram (px).
const DIAGRAM: f64 = 300.0;
/// Part of the energy below which a layer is not seen anywhere.
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

/// All parts, from the one that is drawn lowest: their sum is the initial energy where the model loses
/// none.
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

/// The energies stacked, picture `ledger`, up to those (J) at least. None without two hits side by
/// side.
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
    let [knob, tip] = place::axes(sheet, [first, last], &[(name, bat.length())]);
    let mut svg = Svg::on(sheet);
    let top = if sheet.narrow() { keys(&mut svg, &layers) } else { sheet.head() } + NUMBERS;
    let frame = Frame::across(sheet, [top, top + DIAGRAM]);
    let beside = sheet.width() - room(&names, 220.0);
    let frame = Frame { right: if sheet.narrow() { frame.right } else { beside }, ..frame };
    let stacks = stacked(&layers);
    let heights = stacks.last()?.iter().flatten().copied().chain([0.0, greatest, up_to]);
    let unit = sheet.energy();
    let y = Axis::around("energy", heights.map(|v| unit.per * v), ticks_up(DIAGRAM));
    let plane = Plane { frame, x: knob, y: y.counted_in(unit) };
    svg.height = frame.bottom + NUMBERS + 4.0;
    svg.read_off = Some([frame.left, frame.top, frame.right, frame.bottom]);
    let least = initial.iter().copied().fold(f64::INFINITY, f64::min);
    let sum = if greatest - least < 1e-6 * greatest {
        format!("{} {} before the hit", short(unit.per * greatest), unit.name)
    } else {
        let [least, greatest] = [least, greatest].map(|energy| short(unit.per * energy));
        format!("{least} to {greatest} {} before the hit", unit.name)
    };
    let title = "Where the energy goes";
    let held = if bat.fixtures().holding() { ", as the hands see it" } else { "" };
    let facts = format!("{sum}{held}, {}", books(unit, impacts, greatest));
    head(&mut svg, title, [name, &facts]);
    plane.draw(&mut svg);
    draw(&mut svg, &plane, impacts, (&layers, &stacks));
    plane.above(&mut svg, &tip);
    plane.below(&mut svg);
    let alt =
        format!("{name}: {facts}. Stacked against the place of the hit: {}.", names.join(", "));
    Some(Picture::new("ledger", title, &alt, svg))
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

/// Lower and upper edge of a layer at every impact (px).
type Edges = Vec<Option<[Point; 2]>>;

fn draw(
    svg: &mut Svg,
    plane: &Plane,
    impacts: &[Impact],
    (layers, stacks): (&[Layer], &[Vec<Option<f64>>]),
) {
    let (floor, unit) = (vec![Some(0.0); impacts.len()], svg.sheet.energy());
    let below = std::iter::once(&floor).chain(stacks);
    let mut names: Vec<Tag> = vec![];
    for (layer, (below, above)) in layers.iter().zip(below.zip(stacks)) {
        let at = |i: &Impact, v: &Option<f64>| Some(plane.at([i.x, (*v)?]));
        let edges: Edges = impacts
            .iter()
            .zip(below.iter().zip(above))
            .map(|(i, (low, high))| Some([at(i, low)?, at(i, high)?]))
            .collect();
        filled(svg, &edges, layer);
        if let Some([low, high]) = edges.iter().flatten().last() {
            names.push((0.5 * (low[1] + high[1]), layer.name.clone(), TEXT));
        }
        let told = |(at, energy): (&Option<[Point; 2]>, &Option<f64>)| {
            let [low, high] = (*at)?;
            let words = format!("{}: {} {}", layer.name, short(unit.per * (*energy)?), unit.name);
            Some(([low[0], 0.5 * (low[1] + high[1])], words))
        };
        let told: Vec<_> = edges.iter().zip(&layer.energies).filter_map(told).collect();
        svg.hover(&told, 60 / layers.len().max(1));
    }
    let before = |i: &Impact| Some(plane.at([i.x, i.outcome.as_ref()?.energy.initial]));
    let line: Vec<Option<Point>> = impacts.iter().map(before).collect();
    for run in line.split(Option::is_none) {
        let run: Vec<Point> = run.iter().flatten().copied().collect();
        svg.line(&run, Pen::new(TEXT, 1.5));
    }
    if !svg.sheet.narrow() {
        tags(svg, plane.frame, &names);
    }
}

/// The layers' names above the diagram, each with its colour; where they end (px).
fn keys(svg: &mut Svg, layers: &[Layer]) -> f64 {
    const SIDE: f64 = 11.0;
    let (mut x, mut y) = (12.0, svg.sheet.head() + 10.0);
    for Layer { name, look: (ink, opacity), .. } in layers {
        let wide = SIDE + 6.0 + width(name, LABEL);
        if x > 12.0 && x + wide > svg.width - 4.0 {
            (x, y) = (12.0, y + 18.0);
        }
        svg.rect([[x, y - SIDE + 1.0], [x + SIDE, y + 1.0]], *ink, *opacity, None);
        svg.text([x + SIDE + 6.0, y], LABEL, name);
        x += wide + 14.0;
    }
    y + 8.0
}

/// A layer wherever there were hits.
fn filled(svg: &mut Svg, edges: &Edges, layer: &Layer) {
    let (ink, opacity) = layer.look;
    for run in edges.split(Option::is_none) {
        let lower = run.iter().flatten().map(|edge| edge[0]);
        let upper = run.iter().flatten().rev().map(|edge| edge[1]);
        let around: Vec<Point> = lower.chain(upper).collect();
        svg.area(&around, ink, opacity, Some(Pen::new(PAPER, 0.8)));
    }
}
