//! Reading a universal file.

use std::path::Path;

use super::lines::{Line, Lines, SINGLES};
use super::read_function::{Binary, function};
use super::{
    Analysis, Complex, Dataset, Header, NodalData, Node, Nodes, Skipped, Stamp, TraceLine, Units,
    Universal,
};
use sweetspot::base::{Result, file};

/// Columns of eight integers, of coordinates.
const INTEGERS: [usize; 8] = [10; 8];
const DOUBLES: [usize; 3] = [25; 3];

/// Reads a universal file into SI.
///
/// # Errors
///
/// [`Error::Read`](sweetspot::Error) if there is no such file; those of [`parse`].
pub fn read(path: &Path) -> Result<Universal> {
    parse(&path.display().to_string(), &file::read(path)?)
}

/// Reads the bytes of a universal file into SI; `file` is its name in messages.
///
/// # Errors
///
/// [`Error::Input`](sweetspot::Error) with line and column for text in place of a number, for a dataset that ends too
/// early, and for anything outside a dataset.
pub fn parse(file: &str, bytes: &[u8]) -> Result<Universal> {
    parse_in(file, bytes, None)
}

/// As [`parse`], for a file without units that is in these units.
///
/// # Errors
///
/// Those of [`parse`]; [`Error::Input`](sweetspot::Error) for a dataset 164 in addition to given units.
pub fn parse_in(file: &str, bytes: &[u8], given: Option<&Units>) -> Result<Universal> {
    let mut lines = Lines::new(file, bytes);
    let mut read = Universal {
        datasets: Vec::new(),
        lines: Vec::new(),
        skipped: Vec::new(),
        converted_from: given.filter(|units| !units.are_si()).cloned(),
    };
    let mut units = given.cloned().unwrap_or_else(Units::si);
    while let Some(fence) = lines.next() {
        if fence.is_blank() {
            continue;
        }
        if !fence.is_fence() {
            return Err(fence.wrong(fence.shown(), "-1 in columns 5 and 6: a dataset begins"));
        }
        let head = lines.record("the number of a dataset")?;
        let (number, binary) = numbered(head)?;
        match dataset(number, binary.as_ref(), &mut lines)? {
            Some(Dataset::Units(_)) if given.is_some() => {
                let expected = "no unit given beside it: the file names its own";
                return Err(head.wrong("units in dataset 164", expected));
            }
            Some(Dataset::Units(found)) => {
                if !found.are_si() {
                    read.converted_from = Some(found.clone());
                }
                let si = if found.are_si() { found.clone() } else { Units::si() };
                read.datasets.push(Dataset::Units(si));
                read.lines.push(head.number);
                units = found;
            }
            Some(mut dataset) => {
                if !units.into_si(&mut dataset) {
                    return Err(head.wrong(
                        "a number that in SI is beyond the largest one",
                        "units in dataset 164 that fit the numbers",
                    ));
                }
                read.datasets.push(dataset);
                read.lines.push(head.number);
            }
            None => read.skipped.push(Skipped { number, line: head.number }),
        }
        close(number, &mut lines)?;
    }
    if read.datasets.is_empty() && read.skipped.is_empty() {
        return Err(lines.ended("a universal file: -1 in columns 5 and 6, then a dataset"));
    }
    Ok(read)
}

/// The number of a dataset, and for 58b the description of its bytes.
fn numbered(line: Line) -> Result<(i64, Option<Binary>)> {
    let expected = "the number of a dataset in columns 1 to 6";
    let word = line.text(0, 7);
    if word == "58b" {
        return Ok((58, Some(Binary::of(line)?)));
    }
    let number = super::number::whole(&word).filter(|n| *n > 0);
    Ok((number.ok_or_else(|| line.wrong(line.shown(), expected))?, None))
}

/// The fence at the end of a dataset.
fn close(number: i64, lines: &mut Lines) -> Result<()> {
    let expected = format!("-1 in columns 5 and 6: the end of dataset {number}");
    loop {
        match lines.next() {
            Some(line) if line.is_fence() => return Ok(()),
            Some(line) if line.is_blank() => {}
            Some(line) => return Err(line.wrong(line.shown(), expected)),
            None => return Err(lines.ended(&expected)),
        }
    }
}

/// The dataset up to the closing fence; none for an unknown one.
fn dataset(number: i64, binary: Option<&Binary>, lines: &mut Lines) -> Result<Option<Dataset>> {
    Ok(Some(match number {
        15 => Dataset::Nodes(nodes_15(lines)?),
        55 => Dataset::NodalData(nodal_data(lines)?),
        58 => Dataset::Function(Box::new(function(lines, binary)?)),
        82 => Dataset::TraceLine(trace_line(lines)?),
        151 => Dataset::Header(header(lines)),
        164 => Dataset::Units(units(lines)?),
        2411 => Dataset::Nodes(nodes_2411(lines)?),
        2414 => match analysis_data(lines)? {
            Some(data) => Dataset::NodalData(data),
            None => return Ok(None),
        },
        _ => {
            while body(lines).is_some() {}
            return Ok(None);
        }
    }))
}

/// The next line if it still belongs to the dataset.
fn body<'a>(lines: &mut Lines<'a>) -> Option<Line<'a>> {
    lines.peek().filter(|line| !line.is_fence())?;
    lines.next()
}

/// As [`body`], blank lines passed over.
fn entry<'a>(lines: &mut Lines<'a>) -> Option<Line<'a>> {
    loop {
        match body(lines)? {
            line if line.is_blank() => {}
            line => return Some(line),
        }
    }
}

/// As much of a header as exists.
fn header(lines: &mut Lines) -> Header {
    let mut rows = [None; 7];
    for row in &mut rows {
        *row = lines.text();
    }
    while body(lines).is_some() {}
    let text = |k: usize| rows[k].map_or(String::new(), |line: Line| line.name(0, 80));
    let stamp = |k: usize| Stamp {
        date: rows[k].map_or(String::new(), |line| line.text(0, 10)),
        time: rows[k].map_or(String::new(), |line| line.text(10, 10)),
    };
    // Some programs put words there.
    let version = |at| rows[3].and_then(|line| line.integer(at, 10, "").ok()).unwrap_or_default();
    Header {
        model: text(0),
        description: text(1),
        made_by: text(2),
        created: stamp(3),
        saved: stamp(4),
        written: stamp(6),
        version: [version(20), version(30)],
        written_by: text(5),
    }
}

fn units(lines: &mut Lines) -> Result<Units> {
    let first = lines.record("a code of units")?;
    let code = first.integer(0, 10, "a code of units")?;
    let temperature_mode = first.integer(30, 10, "a temperature mode")?;
    let mut factors = Vec::new();
    while let Some(line) = entry(lines) {
        let expected = "a factor of units above 0";
        for value in line.numbers(&DOUBLES, super::number::real, expected)? {
            if factors.len() < 2 && value <= 0.0 {
                return Err(line.wrong(value, expected));
            }
            factors.push(value);
        }
    }
    let [length, force, ..] = factors[..] else {
        let found = format!("{} factors of units", factors.len());
        return Err(first.wrong(found, "those of length, force and temperature"));
    };
    Ok(Units {
        code,
        description: first.text(10, 20),
        temperature_mode,
        length,
        force,
        temperature: factors.get(2).copied().unwrap_or(1.0),
        temperature_offset: factors.get(3).copied().unwrap_or_default(),
    })
}

fn nodes_15(lines: &mut Lines) -> Result<Nodes> {
    let widths = [10, 10, 10, 10, 13, 13, 13];
    let mut nodes = Vec::new();
    while let Some(line) = entry(lines) {
        let expected = "label, two coordinate systems, color, x, y, z of a node";
        let numbers = line.numbers(&widths, super::number::real, expected)?;
        let [label, definition, displacement, color, x, y, z] = numbers[..] else {
            return Err(line.wrong(format!("{} numbers", numbers.len()), expected));
        };
        let integer = |value: f64| {
            super::number::whole(&value.to_string()).ok_or_else(|| line.wrong(value, expected))
        };
        nodes.push(Node {
            label: integer(label)?,
            systems: [integer(definition)?, integer(displacement)?],
            color: integer(color)?,
            at: [x, y, z],
        });
    }
    Ok(Nodes { nodes, legacy: true })
}

fn nodes_2411(lines: &mut Lines) -> Result<Nodes> {
    let mut nodes = Vec::new();
    while let Some(line) = entry(lines) {
        let expected = "label, two coordinate systems and color of a node";
        let integers = line.integers(&INTEGERS[..4], expected)?;
        let [label, definition, displacement, color] = integers[..] else {
            return Err(line.wrong(format!("{} numbers", integers.len()), expected));
        };
        let at = lines.reals(3, &DOUBLES, "the coordinates x, y, z of a node")?;
        let (systems, at) = ([definition, displacement], [at[0], at[1], at[2]]);
        nodes.push(Node { label, systems, color, at });
    }
    Ok(Nodes { nodes, legacy: false })
}

fn trace_line(lines: &mut Lines) -> Result<TraceLine> {
    let expected = "number, count of nodes and color of a line";
    let first = lines.record(expected)?;
    let integers = first.integers(&INTEGERS[..3], expected)?;
    let (Some(number), Some(count)) = (integers.first(), integers.get(1)) else {
        return Err(first.wrong(first.shown(), expected));
    };
    let name = lines.name("the name of the line")?;
    let mut nodes = Vec::new();
    while let Some(line) = entry(lines) {
        nodes.extend(line.integers(&INTEGERS, "labels of nodes")?);
    }
    if i64::try_from(nodes.len()).is_ok_and(|found| found < *count) {
        let found = format!("{} nodes of a line", nodes.len());
        return Err(first.wrong(found, format!("{count}, as this record says")));
    }
    let color = integers.get(2).copied().unwrap_or_default();
    Ok(TraceLine { number: *number, color, name, nodes })
}

fn nodal_data(lines: &mut Lines) -> Result<NodalData> {
    let ids = lines.ids()?;
    let expected = "model, analysis, characteristic, kind of data, 2 or 5, count of values";
    let form = form(lines, expected, (&[2], &[5], "2 (real) or 5 (complex)"))?;
    let analysis = analysis(lines, form.kind)?;
    form.data(lines, ids, analysis)
}

/// Dataset 2414, the newer form of 55; None where its data are on elements, not at nodes.
///
/// # Source
///
/// Universal dataset 2414, "Analysis Data", of SDRC I-DEAS as the University of Cincinnati's Structural
/// Dynamics Research Laboratory keeps it (ceas3.uc.edu/sdrluff).
fn analysis_data(lines: &mut Lines) -> Result<Option<NodalData>> {
    lines.record("a label of the dataset")?;
    lines.name("the name of the dataset")?;
    let expected = "a location of the data: 1 (at nodes), 2, 3 or 5";
    let location = lines.record(expected)?.integer(0, 10, expected)?;
    if location != 1 {
        while body(lines).is_some() {}
        return Ok(None);
    }
    let ids = lines.ids()?;
    let expected = "model, analysis, characteristic, kind of result, data type, count of values";
    let form = form(lines, expected, (&[1, 2, 4], &[5, 6], "1, 2, 4, 5 or 6"))?;
    let expected = "eight integers of the analysis";
    let mut whole = lines.record(expected)?.integers(&INTEGERS, expected)?;
    whole.resize(8, 0);
    let expected = "the creation option and the number retained";
    lines.record(expected)?.integers(&INTEGERS, expected)?;
    let figures = |lines: &mut Lines| -> Result<Vec<f64>> {
        let expected = "six figures of the analysis";
        let mut values =
            lines.record(expected)?.numbers(&SINGLES, super::number::real, expected)?;
        values.resize(6, 0.0);
        Ok(values)
    };
    let (r, s) = (figures(lines)?, figures(lines)?);
    // Design set, iteration, solution set, boundary condition, load set, mode, time step, frequency;
    // time, frequency, eigenvalue, modal mass, viscous, hysteretic; eigenvalue, modal A, modal B.
    let numbers = [whole[4], whole[5], whole[7]];
    let (normal, pole) = ([r[1], r[3], r[4], r[5]], std::array::from_fn(|k| s[k]));
    let others = (whole, [r, s].concat());
    let analysis = analysis_of(form.kind, numbers, normal, pole, others);
    Ok(Some(form.data(lines, ids, analysis)?))
}

/// The record of datasets 55 and 2414 that describes their data.
struct DataForm {
    model: i64,
    kind: i64,
    characteristic: i64,
    quantity: i64,
    complex: bool,
    per_node: usize,
}

/// Reads that record, of which the data types for real and for complex values are given, and in words.
fn form(
    lines: &mut Lines,
    expected: &str,
    (real, imaginary, types): (&[i64], &[i64], &str),
) -> Result<DataForm> {
    let form = lines.record(expected)?;
    let integers = form.integers(&INTEGERS[..6], expected)?;
    let [model, kind, characteristic, quantity, data_type, count] = integers[..] else {
        return Err(form.wrong(format!("{} numbers", integers.len()), expected));
    };
    let complex = imaginary.contains(&data_type);
    if !complex && !real.contains(&data_type) {
        return Err(form.wrong(format!("data type {data_type}"), types));
    }
    let per_node = usize::try_from(count).ok().filter(|n| (1..=1000).contains(n));
    let unusual = || form.wrong(format!("{count} values per node"), "1 to 1000");
    let per_node = per_node.ok_or_else(unusual)?;
    Ok(DataForm { model, kind, characteristic, quantity, complex, per_node })
}

impl DataForm {
    /// The dataset, with the values that follow to its end.
    fn data(self, lines: &mut Lines, ids: [String; 5], analysis: Analysis) -> Result<NodalData> {
        let Self { model, characteristic, quantity, complex, per_node, .. } = self;
        let values = values_at_nodes(lines, (per_node, complex))?;
        Ok(NodalData { ids, model, analysis, characteristic, quantity, complex, per_node, values })
    }
}

/// A label and its values, node by node, to the end of the dataset.
fn values_at_nodes(
    lines: &mut Lines,
    (per_node, complex): (usize, bool),
) -> Result<Vec<(i64, Vec<Complex>)>> {
    let mut values = Vec::new();
    while let Some(line) = entry(lines) {
        let label = line.integers(&INTEGERS[..1], "the label of a node")?;
        let [label] = label[..] else {
            return Err(line.wrong(line.shown(), "the label of a node"));
        };
        let parts = if complex { 2 } else { 1 };
        let numbers = lines.reals(per_node * parts, &SINGLES, "the values at a node")?;
        let pair = |part: &[f64]| -> Complex { [part[0], part.get(1).copied().unwrap_or(0.0)] };
        values.push((label, numbers.chunks(parts).map(pair).collect()));
    }
    Ok(values)
}

/// Records 7 and 8 of dataset 55.
fn analysis(lines: &mut Lines, kind: i64) -> Result<Analysis> {
    let expected = "counts of integers and of reals, and these integers";
    let line = lines.record(expected)?;
    let mut integers = line.integers(&INTEGERS, expected)?;
    let count = |k: usize, most: usize| {
        let count = integers.get(k).and_then(|n| usize::try_from(*n).ok());
        count.filter(|n| *n <= most).ok_or_else(|| line.wrong(line.shown(), expected))
    };
    let (whole, real) = (count(0, 10)?, count(1, 12)?);
    while integers.len() < 2 + whole {
        let next = lines.record(expected)?;
        integers.extend(next.integers(&INTEGERS, expected)?);
    }
    let reals = lines.reals(real, &SINGLES, "the figures of the mode or step")?;
    // Numbers that a program left out are 0.
    let r = |k: usize| reals.get(k).copied().unwrap_or_default();
    let i = |k: usize| integers.get(2 + k).copied().unwrap_or_default();
    let (normal, pole) = ([0, 1, 2, 3].map(r), [0, 1, 2, 3, 4, 5].map(r));
    let others = (integers.get(2..).unwrap_or_default().to_vec(), reals.clone());
    Ok(analysis_of(kind, [i(0), i(1), i(1)], normal, pole, others))
}

/// The analysis of that kind: its load case and its mode or step; frequency, modal mass, viscous and hysteretic damping
/// of a normal mode; eigenvalue, modal A and modal B of a complex one; all numbers of any other analysis.
fn analysis_of(
    kind: i64,
    [load_case, mode, step]: [i64; 3],
    [frequency, modal_mass, viscous, hysteretic]: [f64; 4],
    pole: [f64; 6],
    (integers, reals): (Vec<i64>, Vec<f64>),
) -> Analysis {
    match kind {
        2 => Analysis::NormalMode { load_case, mode, frequency, modal_mass, viscous, hysteretic },
        3 | 7 => Analysis::ComplexMode {
            second_order: kind == 7,
            load_case,
            mode,
            eigenvalue: [pole[0], pole[1]],
            modal_a: [pole[2], pole[3]],
            modal_b: [pole[4], pole[5]],
        },
        5 => Analysis::FrequencyResponse { load_case, step, frequency },
        _ => Analysis::Other { kind, integers, reals },
    }
}
