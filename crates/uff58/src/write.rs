//! Writing a universal file.

use super::number::scientific;
use super::{
    Abscissa, Analysis, Axis, Complex, Dataset, Dof, Function, Header, NodalData, Nodes, Stamp,
    TraceLine, Units, Values,
};
use sweetspot::base::{Error, Result};

/// The text of a universal file of these datasets in ASCII, with lines ended by a line feed.
///
/// # Errors
///
/// [`Error::Value`] for a number that is not finite or does not fit its columns, for a trace line with more than
/// [`TraceLine::MOST`] nodes, and for values with a wrong count.
pub fn write(datasets: &[Dataset]) -> Result<String> {
    let mut out = Out::default();
    for dataset in datasets {
        out.integer(-1, 6).end();
        out.integer(number(dataset), 6).end();
        put(&mut out, dataset);
        out.integer(-1, 6).end();
    }
    match out.wrong {
        None => Ok(out.text),
        Some(error) => Err(error),
    }
}

fn number(dataset: &Dataset) -> i64 {
    match dataset {
        Dataset::Header(_) => 151,
        Dataset::Units(_) => 164,
        Dataset::Nodes(nodes) if nodes.legacy => 15,
        Dataset::Nodes(_) => 2411,
        Dataset::TraceLine(_) => 82,
        Dataset::NodalData(_) => 55,
        Dataset::Function(_) => 58,
    }
}

fn put(out: &mut Out, dataset: &Dataset) {
    match dataset {
        Dataset::Header(header) => put_header(out, header),
        Dataset::Units(units) => put_units(out, units),
        Dataset::Nodes(nodes) => put_nodes(out, nodes),
        Dataset::TraceLine(line) => put_trace_line(out, line),
        Dataset::NodalData(data) => put_nodal_data(out, data),
        Dataset::Function(function) => put_function(out, function),
    }
}

/// The text so far, and the first object that could not be written.
#[derive(Default)]
struct Out {
    text: String,
    wrong: Option<Error>,
}

impl Out {
    fn fail(&mut self, field: &str, found: impl std::fmt::Display, expected: &str) {
        self.wrong.get_or_insert_with(|| Error::value(field, found, expected));
    }

    /// FORMAT Iw.
    fn integer(&mut self, value: i64, width: usize) -> &mut Self {
        let text = value.to_string();
        if text.len() > width {
            self.fail("universal file", value, &format!("a number of {width} columns"));
        }
        self.text += &format!("{text:>width$}");
        self
    }

    fn count(&mut self, value: usize, width: usize) -> &mut Self {
        self.integer(i64::try_from(value).unwrap_or(i64::MAX), width)
    }

    /// FORMAT 1PEw.d, or 1PDw.d by the letter.
    fn real(&mut self, value: f64, width: usize, decimals: usize, letter: char) -> &mut Self {
        if !value.is_finite() {
            self.fail("universal file", value, "a finite number");
        }
        let text = scientific(value, decimals, letter);
        self.text += &format!("{text:>width$}");
        self
    }

    /// FORMAT E13.5.
    fn single(&mut self, value: f64) -> &mut Self {
        self.real(value, 13, 5, 'E')
    }

    /// FORMAT E20.12.
    fn double(&mut self, value: f64) -> &mut Self {
        self.real(value, 20, 12, 'E')
    }

    /// A text in that number of columns of ASCII, cut or padded.
    fn name(&mut self, text: &str, width: usize) -> &mut Self {
        let ascii = |c: char| if matches!(c, ' '..='~') { c } else { '?' };
        let text: String = text.trim().chars().map(ascii).take(width).collect();
        self.text += &format!("{text:<width$}");
        self
    }

    /// As [`Self::name`], but `NONE` for an empty text, because a field may not be blank.
    fn id(&mut self, text: &str, width: usize) -> &mut Self {
        self.name(if text.trim().is_empty() { "NONE" } else { text }, width)
    }

    /// The end of a line.
    fn end(&mut self) {
        let kept = self.text.trim_end_matches(' ').len();
        self.text.truncate(kept);
        self.text.push('\n');
    }

    /// FORMAT(6E13.5).
    fn singles(&mut self, values: impl Iterator<Item = f64>) {
        let values: Vec<f64> = values.collect();
        for line in values.chunks(6) {
            line.iter().for_each(|value| {
                self.single(*value);
            });
            self.end();
        }
    }
}

fn put_header(out: &mut Out, header: &Header) {
    let stamp = |out: &mut Out, stamp: &Stamp| {
        out.name(&stamp.date, 10).name(&stamp.time, 10);
    };
    for text in [&header.model, &header.description, &header.made_by] {
        out.id(text, 80).end();
    }
    stamp(out, &header.created);
    let [major, minor] = header.version;
    out.integer(major, 10).integer(minor, 10).integer(0, 10).end();
    stamp(out, &header.saved);
    out.end();
    out.id(&header.written_by, 80).end();
    stamp(out, &header.written);
    out.end();
}

fn put_units(out: &mut Out, units: &Units) {
    out.integer(units.code, 10).name(&units.description, 20);
    out.integer(units.temperature_mode, 10).end();
    for factor in [units.length, units.force, units.temperature] {
        out.real(factor, 25, 17, 'D');
    }
    out.end();
    out.real(units.temperature_offset, 25, 17, 'D').end();
}

fn put_nodes(out: &mut Out, nodes: &Nodes) {
    for node in &nodes.nodes {
        let [definition, displacement] = node.systems;
        out.integer(node.label, 10).integer(definition, 10).integer(displacement, 10);
        out.integer(node.color, 10);
        if nodes.legacy {
            node.at.iter().for_each(|x| {
                out.single(*x);
            });
        } else {
            out.end();
            node.at.iter().for_each(|x| {
                out.real(*x, 25, 16, 'D');
            });
        }
        out.end();
    }
}

fn put_trace_line(out: &mut Out, line: &TraceLine) {
    if line.nodes.len() > TraceLine::MOST {
        let expected = format!("{} at most", TraceLine::MOST);
        out.fail("trace line", format!("{} nodes", line.nodes.len()), &expected);
    }
    out.integer(line.number, 10).count(line.nodes.len(), 10).integer(line.color, 10).end();
    out.id(&line.name, 80).end();
    for row in line.nodes.chunks(8) {
        row.iter().for_each(|node| {
            out.integer(*node, 10);
        });
        out.end();
    }
}

fn put_nodal_data(out: &mut Out, data: &NodalData) {
    data.ids.iter().for_each(|id| out.id(id, 80).end());
    let (kind, integers, reals) = parameters(&data.analysis);
    for number in [data.model, kind, data.characteristic, data.quantity] {
        out.integer(number, 10);
    }
    out.integer(if data.complex { 5 } else { 2 }, 10).count(data.per_node, 10).end();
    out.count(integers.len(), 10).count(reals.len(), 10);
    for (k, number) in integers.iter().enumerate() {
        if k == 6 {
            out.end();
        }
        out.integer(*number, 10);
    }
    out.end();
    out.singles(reals.into_iter());
    for (label, values) in &data.values {
        if values.len() != data.per_node {
            let found = format!("{} values", values.len());
            out.fail("data at a node", found, &format!("{}", data.per_node));
        }
        out.integer(*label, 10).end();
        if data.complex {
            out.singles(values.iter().flatten().copied());
        } else {
            out.singles(values.iter().map(|value| value[0]));
        }
    }
}

/// Analysis type, integers and reals of records 6 to 8.
fn parameters(analysis: &Analysis) -> (i64, Vec<i64>, Vec<f64>) {
    match analysis {
        Analysis::NormalMode { load_case, mode, frequency, modal_mass, viscous, hysteretic } => {
            (2, vec![*load_case, *mode], vec![*frequency, *modal_mass, *viscous, *hysteretic])
        }
        Analysis::ComplexMode { second_order, load_case, mode, eigenvalue, modal_a, modal_b } => {
            let reals = [eigenvalue, modal_a, modal_b].into_iter().flatten().copied().collect();
            (if *second_order { 7 } else { 3 }, vec![*load_case, *mode], reals)
        }
        Analysis::FrequencyResponse { load_case, step, frequency } => {
            (5, vec![*load_case, *step], vec![*frequency])
        }
        Analysis::Other { kind, integers, reals } => (*kind, integers.clone(), reals.clone()),
    }
}

fn put_function(out: &mut Out, function: &Function) {
    function.ids.iter().for_each(|id| out.id(id, 80).end());
    out.integer(function.kind, 5).integer(function.number, 10);
    out.integer(function.version, 5).integer(function.load_case, 10);
    for Dof { entity, node, direction } in [&function.response, &function.reference] {
        out.text.push(' ');
        out.id(entity, 10).integer(*node, 10).integer(*direction, 4);
    }
    out.end();
    let data_type = match (&function.values, function.double) {
        (Values::Real(_), false) => 2,
        (Values::Real(_), true) => 4,
        (Values::Complex(_), false) => 5,
        (Values::Complex(_), true) => 6,
    };
    let (even, start, step) = match function.abscissa {
        Abscissa::Even { start, step } => (1, start, step),
        Abscissa::Uneven(_) => (0, 0.0, 0.0),
    };
    out.integer(data_type, 10).count(function.values.len(), 10).integer(even, 10);
    out.single(start).single(step).single(function.z).end();
    for Axis { quantity, exponents: [length, force, temperature], label, unit } in &function.axes {
        out.integer(*quantity, 10);
        out.integer(*length, 5).integer(*force, 5).integer(*temperature, 5);
        out.text.push(' ');
        out.id(label, 20).text.push(' ');
        out.id(unit, 20).end();
    }
    put_values(out, function);
}

/// Record 12: the eight cases of data type and spacing.
fn put_values(out: &mut Out, function: &Function) {
    let rows: Vec<Complex> = match &function.values {
        Values::Real(values) => values.iter().map(|value| [*value, 0.0]).collect(),
        Values::Complex(values) => values.clone(),
    };
    let places = match &function.abscissa {
        Abscissa::Uneven(places) => Some(places),
        Abscissa::Even { .. } => None,
    };
    if let Some(places) = places.filter(|places| places.len() != rows.len()) {
        let found = format!("{} places for {} values", places.len(), rows.len());
        out.fail("abscissa of a function", found, "as many");
        return;
    }
    let complex = matches!(function.values, Values::Complex(_));
    let parts = if complex { 2 } else { 1 };
    let per_line = match (function.double, places.is_some(), complex) {
        (false, false, false) => 6,
        (false, false, true) | (false, true, false) => 3,
        (true, false, false) => 4,
        (true, true, true) => 1,
        _ => 2,
    };
    for (line, values) in rows.chunks(per_line).enumerate() {
        for (k, value) in values.iter().enumerate() {
            if let Some(places) = places {
                out.single(places[line * per_line + k]);
            }
            for part in &value[..parts] {
                if function.double {
                    out.double(*part)
                } else {
                    out.single(*part)
                };
            }
        }
        out.end();
    }
}
