//! Reading dataset 58: functions at a degree of freedom, as text or as bytes.

use super::lines::{Line, Lines, SINGLES};
use super::{Abscissa, Axis, Complex, Dof, Function, Values};
use sweetspot::base::Result;

/// How the values of dataset 58b are stored.
pub(super) struct Binary {
    little_endian: bool,
}

impl Binary {
    /// The content of the line `58b …`, FORMAT(I6,1A1,I6,I6,I12,I12,I6,I6,I12,I12).
    pub fn of(line: Line) -> Result<Self> {
        let little_endian = match line.integer(7, 6, "a byte order")? {
            1 => true,
            2 => false,
            other => return Err(line.wrong(format!("byte order {other}"), "1 (little) or 2 (big)")),
        };
        match line.integer(13, 6, "a format of numbers")? {
            2 => Ok(Self { little_endian }),
            other => Err(line.wrong(format!("number format {other}"), "2, IEEE 754")),
        }
    }
}

/// Record 7: number and kind of the values.
struct Form {
    complex: bool,
    double: bool,
    count: usize,
    even: Option<[f64; 2]>,
    z: f64,
}

pub(super) fn function(lines: &mut Lines, binary: Option<&Binary>) -> Result<Function> {
    let ids = lines.ids()?;
    let dofs = lines.record("kind of function, response and reference")?;
    let (header, [response, reference]) = degrees_of_freedom(dofs)?;
    let form = form(lines.record("data type, count of values and spacing")?)?;
    let mut axes: [Axis; 4] = Default::default();
    for axis in &mut axes {
        *axis = self::axis(lines.record("an axis: kind of data, exponents, label, unit")?)?;
    }
    let numbers = match binary {
        Some(binary) => bytes(lines, &form, binary)?,
        None => text(lines, &form)?,
    };
    let (abscissa, values) = form.split(&numbers);
    let [kind, number, version, load_case] = header;
    let (double, z) = (form.double, form.z);
    Ok(Function {
        ids,
        kind,
        number,
        version,
        load_case,
        response,
        reference,
        abscissa,
        values,
        double,
        z,
        axes,
    })
}

/// Kind, number, version, load case, and response and reference.
type Header = ([i64; 4], [Dof; 2]);

/// Record 6, FORMAT(2(I5,I10),2(1X,10A1,I10,I4)), or the same with blanks between.
fn degrees_of_freedom(line: Line) -> Result<Header> {
    let expected = "kind, number, version, load case, and name, node, direction twice";
    let integer = |start, width| line.integer(start, width, expected);
    let dof = |start: usize| -> Result<Dof> {
        let (node, direction) = (integer(start + 10, 10)?, integer(start + 20, 4)?);
        Ok(Dof { entity: line.name(start, 10), node, direction })
    };
    let columns = || -> Result<Header> {
        let header = [integer(0, 5)?, integer(5, 10)?, integer(15, 5)?, integer(20, 10)?];
        Ok((header, [dof(31)?, dof(56)?]))
    };
    columns().or_else(|error| spaced_degrees_of_freedom(line).ok_or(error))
}

fn spaced_degrees_of_freedom(line: Line) -> Option<Header> {
    let words = line.words()?;
    let whole = |k: usize| super::number::whole(words[k]);
    if words.len() != 10 {
        return None;
    }
    let dof = |k: usize| -> Option<Dof> {
        Some(Dof { entity: named(words[k]), node: whole(k + 1)?, direction: whole(k + 2)? })
    };
    Some(([whole(0)?, whole(1)?, whole(2)?, whole(3)?], [dof(4)?, dof(7)?]))
}

/// `NONE` is not a name.
fn named(word: &str) -> String {
    if word.eq_ignore_ascii_case("none") { String::new() } else { word.to_owned() }
}

/// Record 7, FORMAT(3I10,3E13.5).
fn form(line: Line) -> Result<Form> {
    let expected = "data type, count, spacing, first abscissa, step and z";
    let numbers = line.numbers(&[10, 10, 10, 13, 13, 13], super::number::real, expected)?;
    let n = |k: usize| numbers.get(k).copied().unwrap_or_default();
    let (complex, double) = match n(0) {
        2.0 => (false, false),
        4.0 => (false, true),
        5.0 => (true, false),
        6.0 => (true, true),
        other => return Err(line.wrong(format!("data type {other}"), "2, 4, 5 or 6")),
    };
    // Limited to 32 bits; a larger count is found at the end of the file.
    let count = super::number::whole(&n(1).to_string()).and_then(|n| u32::try_from(n).ok());
    let count = count.ok_or_else(|| line.wrong(format!("{} values", n(1)), "a count"))?;
    let even = match n(2) {
        0.0 => None,
        1.0 => Some([n(3), n(4)]),
        other => return Err(line.wrong(format!("spacing {other}"), "0 (uneven) or 1 (even)")),
    };
    Ok(Form { complex, double, count: count as usize, even, z: n(5) })
}

/// Records 8 to 11, FORMAT(I10,3I5,2(1X,20A1)), or the same with blanks between.
fn axis(line: Line) -> Result<Axis> {
    let expected = "kind of data, three exponents, label, unit";
    let integer = |start, width| line.integer(start, width, expected);
    let columns = || -> Result<Axis> {
        let exponents = [integer(10, 5)?, integer(15, 5)?, integer(20, 5)?];
        let (label, unit) = (line.name(26, 20), line.name(47, 20));
        Ok(Axis { quantity: integer(0, 10)?, exponents, label, unit })
    };
    columns().or_else(|error| spaced_axis(line).ok_or(error))
}

fn spaced_axis(line: Line) -> Option<Axis> {
    let words = line.words()?;
    let whole = |k: usize| super::number::whole(words.get(k)?);
    let exponents = [whole(1)?, whole(2)?, whole(3)?];
    let name = |k: usize| words.get(k).map_or(String::new(), |word| named(word));
    Some(Axis { quantity: whole(0)?, exponents, label: name(4), unit: name(5) })
}

impl Form {
    /// Numbers in one value: its abscissa, if it is given, and its parts.
    fn per_value(&self) -> usize {
        usize::from(self.even.is_none()) + if self.complex { 2 } else { 1 }
    }

    /// The columns of a line of record 12.
    fn widths(&self) -> &'static [usize] {
        match (self.double, self.even.is_some(), self.complex) {
            (false, ..) => &SINGLES,
            (true, true, _) => &[20; 4],
            (true, false, false) => &[13, 20, 13, 20],
            (true, false, true) => &[13, 20, 20],
        }
    }

    /// Bytes of a value in dataset 58b, with an abscissa of the given number of bytes.
    fn bytes_per_value(&self, abscissa: usize) -> usize {
        let part = if self.double { 8 } else { 4 };
        let uneven = if self.even.is_none() { abscissa } else { 0 };
        uneven + part * if self.complex { 2 } else { 1 }
    }

    /// Abscissa and values from the numbers in the order of the file.
    fn split(&self, numbers: &[f64]) -> (Abscissa, Values) {
        let rows = || numbers.chunks_exact(self.per_value());
        let first = usize::from(self.even.is_none());
        let abscissa = match self.even {
            Some([start, step]) => Abscissa::Even { start, step },
            None => Abscissa::Uneven(rows().map(|row| row[0]).collect()),
        };
        let pair = |row: &[f64]| -> Complex { [row[first], row[first + 1]] };
        let values = if self.complex {
            Values::Complex(rows().map(pair).collect())
        } else {
            Values::Real(rows().map(|row| row[first]).collect())
        };
        (abscissa, values)
    }
}

fn text(lines: &mut Lines, form: &Form) -> Result<Vec<f64>> {
    let what = format!("{} values", form.count);
    lines.reals(form.count * form.per_value(), form.widths(), &what)
}

/// The bytes of dataset 58b. An abscissa has four bytes by the text of the format; some programs write eight bytes with
/// doubles, which can be seen from the position of the fence.
fn bytes(lines: &mut Lines, form: &Form, binary: &Binary) -> Result<Vec<f64>> {
    let rest = lines.rest();
    let fenced = |size: usize| {
        rest.get(size..).is_some_and(|after| after.trim_ascii_start().starts_with(b"-1"))
    };
    let widths = [4, 8].map(|width| (width, form.count * form.bytes_per_value(width)));
    let Some((abscissa, size)) = widths.into_iter().find(|(_, size)| fenced(*size)) else {
        let expected = format!("{} bytes of {} values, then -1", widths[0].1, form.count);
        return Err(lines.peek().map_or_else(
            || lines.ended(&expected),
            |line| line.wrong(format!("{} bytes to the end of the file", rest.len()), &expected),
        ));
    };
    let mut numbers = Vec::new();
    let mut left = &rest[..size];
    for k in 0..form.count * form.per_value() {
        let abscissa_next = form.even.is_none() && k % form.per_value() == 0;
        let width = if abscissa_next {
            abscissa
        } else if form.double {
            8
        } else {
            4
        };
        let (number, after) = left.split_at(width);
        left = after;
        let value = float(number, binary.little_endian);
        let Some(value) = value.filter(|v| v.is_finite()) else {
            let line = lines.peek().expect("the bytes are there");
            return Err(line.wrong(format!("number {k}, which is not finite"), "finite numbers"));
        };
        numbers.push(value);
    }
    lines.skip(size);
    Ok(numbers)
}

fn float(bytes: &[u8], little_endian: bool) -> Option<f64> {
    match (bytes.len(), little_endian) {
        (4, true) => Some(f32::from_le_bytes(bytes.try_into().ok()?).into()),
        (4, false) => Some(f32::from_be_bytes(bytes.try_into().ok()?).into()),
        (_, true) => Some(f64::from_le_bytes(bytes.try_into().ok()?)),
        (_, false) => Some(f64::from_be_bytes(bytes.try_into().ok()?)),
    }
}
