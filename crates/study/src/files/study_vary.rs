//! Which inputs differ between the rows of a study, and where do they belong?
//!
//! An input is named by its path in the bat file, in the ball file or in the scene; [`Varied::put`] writes its value
//! there.

use serde_json::{Value, json};

use crate::engine::{
    Amount, Complaint, Error, FilePosition, Mistakes, Node, Quantity, Result, Setup, marks,
    mistakes, shortest, typed, units,
};
use crate::files::form::later;
use crate::files::written::{Written, written};
use crate::many::design::{Axis, DesignRow, DesignTerms};
use crate::many::distribution::Distribution;
use crate::named::named;

written! {
    /// The variation of a member: one of these. The numbers of one variation are all bare or all in the same unit.
    VariationForm with { "minProperties": 1, "maxProperties": 1 } {
        /// These values, one after the other.
        values = later::<Vec<Value>>().saying("minItems", 1);
        /// From, to, and how many values at even distances.
        grid = later::<(Amount, Amount, u64)>();
        /// Every value between the two alike.
        uniform = later::<(Amount, Amount)>();
        /// Mean and standard deviation.
        normal = later::<(Amount, Amount)>();
        /// Median, and the standard deviation of the natural logarithm.
        lognormal = later::<(Amount, f64)>();
        /// The least value, the likeliest, the greatest.
        triangular = later::<(Amount, Amount, Amount)>();
    }
    |_| -> () { Ok(()) }
}

named! {
    /// Whose member varies.
    pub enum VariedFile {
        /// The bat file's.
        Bat = "bat",
        /// The ball file's.
        Ball = "ball",
        /// The scene's.
        Scene = "scene",
    }
}

/// A member that varies.
#[derive(Debug, Clone)]
pub struct Varied {
    /// Its path, with that of its document before it: `bat.material.density`.
    pub path: String,
    /// Whose it is.
    pub subject: VariedFile,
    /// Its path in its document.
    inside: Vec<PathStep>,
    way: Variation,
    /// Its position in the study.
    place: Box<FilePosition>,
}

/// A step of a path into a document.
#[derive(Debug, Clone, PartialEq, Eq)]
enum PathStep {
    Member(String),
    Item(usize),
}

/// The variation of a member.
#[derive(Debug, Clone)]
struct Variation {
    /// Its list or its distribution in a row.
    axis: Axis,
    /// The numbers of a list of numbers, in the unit.
    numbers: Vec<f64>,
    /// The values of another list.
    listed: Vec<ListedValue>,
    /// The unit of its numbers, which may be empty.
    unit: String,
}

/// A value of a list.
#[derive(Debug, Clone)]
struct ListedValue {
    /// As the study writes it.
    said: Value,
    /// The value for a document, without the name of a file.
    meant: Value,
}

impl Varied {
    /// Its number in a row, or the value of its list.
    fn of_row(&self, row: &DesignRow) -> std::result::Result<f64, &ListedValue> {
        match self.way.axis {
            Axis::Drawn(k) => Ok(row.values[k]),
            Axis::List(k) => {
                let pick = row.picks[k] as usize;
                self.way.numbers.get(pick).copied().ok_or_else(|| &self.way.listed[pick])
            }
        }
    }

    /// Its value in a row, as a document has it.
    pub fn value(&self, row: &DesignRow) -> Value {
        match (self.of_row(row), self.unit()) {
            (Ok(number), "") => number.into(),
            (Ok(number), unit) => format!("{} {unit}", shortest(number)).into(),
            (Err(listed), _) => listed.meant.clone(),
        }
    }

    /// Its value in a row as a cell of a table: a number in its unit, or the item of the list.
    pub fn cell(&self, row: &DesignRow) -> String {
        match self.of_row(row).map_err(|listed| &listed.said) {
            Ok(number) => shortest(number),
            Err(Value::String(text)) => marks::cell(text),
            Err(other) => other.to_string(),
        }
    }

    /// Its axis in the design.
    pub fn axis(&self) -> Axis {
        self.way.axis
    }

    /// Whether all its values are numbers.
    pub fn is_number(&self) -> bool {
        self.way.listed.iter().all(|value| value.said.is_number())
    }

    /// The unit of its numbers, empty for bare numbers and for lists.
    pub fn unit(&self) -> &str {
        &self.way.unit
    }

    /// Replaces profiles that name a file, `{"csv": …}`, by what `of` makes of them.
    ///
    /// # Errors
    ///
    /// Those of `of`, in the study.
    pub fn replace_tables(&mut self, mut of: impl FnMut(&Value) -> Result<Value>) -> Result<()> {
        let is_profile = self.subject == VariedFile::Bat && self.inside == [member("profile")];
        for ListedValue { meant, .. } in self.way.listed.iter_mut().filter(|_| is_profile) {
            if meant.get("csv").is_some() {
                let placed = |complaint| wrong(&self.path, &self.place, complaint);
                *meant = of(meant).map_err(|error| error.placed(placed))?;
            }
        }
        Ok(())
    }

    /// Writes its value of a row into a document. A missing member is added to its object, and so is a missing object;
    /// a material given as a name becomes an object with that name and the member.
    ///
    /// # Errors
    ///
    /// How far the path leads, if it leads nowhere.
    pub fn put(&self, root: &mut Value, row: &DesignRow) -> Result<()> {
        let (mut here, mut passed) = (root, String::new());
        for step in &self.inside {
            let lost = |what: String| {
                let found = format!("{what} at \"{passed}\"");
                Error::value(self.path.clone(), found, "a path that is in the document")
            };
            match step {
                PathStep::Item(k) => {
                    let list = here.as_array_mut().ok_or_else(|| lost("no list".to_owned()))?;
                    let many = list.len();
                    let none = || lost(format!("{many} items, none of number {k},"));
                    here = list.get_mut(*k).ok_or_else(none)?;
                    passed += &format!("[{k}]");
                }
                PathStep::Member(name) => {
                    if here.is_string() {
                        *here = json!({ "name": here.clone() });
                    } else if here.is_null() {
                        *here = json!({});
                    }
                    let object =
                        here.as_object_mut().ok_or_else(|| lost("no object".to_owned()))?;
                    here = object.entry(name).or_insert(Value::Null);
                    passed += &format!("{}{name}", if passed.is_empty() { "" } else { "." });
                }
            }
        }
        *here = self.value(row);
        Ok(())
    }

    /// Whether a complaint about a document, or about the path itself, is about this input.
    pub fn is_meant(&self, complaint: &Complaint) -> bool {
        complaint.field == self.path
            || steps(&complaint.field).is_some_and(|field| one_within(&field, &self.inside))
    }

    /// An error about it, in the study.
    pub fn wrong(&self, complaint: Complaint) -> Error {
        wrong(&self.path, &self.place, complaint)
    }
}

fn wrong(path: &str, place: &FilePosition, complaint: Complaint) -> Error {
    let complaint = Complaint { field: format!("vary.{path}"), ..complaint };
    Error::Input { place: Box::new(place.clone()), complaint }
}

fn member(name: &str) -> PathStep {
    PathStep::Member(name.to_owned())
}

/// The steps of a path such as `attachments[0].mass`, which has only one notation.
fn steps(path: &str) -> Option<Vec<PathStep>> {
    let mut steps = vec![];
    for part in path.split('.') {
        let (name, items) = part.split_at(part.find('[').unwrap_or(part.len()));
        if name.is_empty() || name.contains(']') {
            return None;
        }
        steps.push(member(name));
        let items = items.strip_prefix('[').map(|items| items.strip_suffix(']'));
        for k in items.map_or(Some(vec![]), |items| Some(items?.split("][").collect()))? {
            let number: usize = k.parse().ok().filter(|number: &usize| number.to_string() == k)?;
            steps.push(PathStep::Item(number));
        }
    }
    Some(steps)
}

/// Whether one of two paths contains the other, or both are equal.
fn one_within(a: &[PathStep], b: &[PathStep]) -> bool {
    a.starts_with(b) || b.starts_with(a)
}

/// The inputs that vary; their lists and distributions are added to the design.
pub(crate) fn varied(node: &Node, wanted: &mut DesignTerms) -> Result<Vec<Varied>> {
    let object = node.members()?;
    let paths = object.keys();
    if paths.is_empty() {
        let expected = "one path at least, such as \"bat.material.density\"";
        return Err(node.error("an empty object", expected));
    }
    /// Most inputs: every row writes all of them into its bat.
    const MOST: usize = 100;
    if paths.len() > MOST {
        return Err(node.error(format!("{} paths", paths.len()), format!("{MOST} at most")));
    }
    let mut all: Vec<(VariedFile, Vec<PathStep>, &str)> = vec![];
    mistakes::all(paths.iter().map(|(path, node)| {
        let key = node.key();
        let (subject, inside) = led(path, &key)?;
        let other = all.iter().find(|(of, into, _)| *of == subject && one_within(into, &inside));
        if let Some((_, into, other)) = other {
            return Err(if *into == inside {
                key.error(format!("\"{path}\" a second time"), "it once")
            } else {
                let found = format!("\"{path}\" beside \"{other}\", one inside the other");
                key.error(found, "paths of which none lies inside another")
            });
        }
        all.push((subject, inside.clone(), path));
        let way = way(node, wanted)?;
        Ok(Varied { path: path.clone(), subject, inside, way, place: key.place() })
    }))
}

/// Whose member a path names, and where it is there.
fn led(path: &str, key: &Node) -> Result<(VariedFile, Vec<PathStep>)> {
    let found = format!("\"{path}\"");
    let subject = path.split_once('.').and_then(|(first, inside)| {
        let subject = VariedFile::ALL.into_iter().find(|subject| subject.name() == first)?;
        Some((subject, inside, steps(inside)?))
    });
    let Some((subject, inside, steps)) = subject else {
        let expected = "a path that begins with bat., ball. or scene., such as \
                        \"bat.material.density\" or \"bat.profile.diameter[12]\"";
        return Err(key.error(found, expected));
    };
    if subject == VariedFile::Scene && !Setup::MEMBERS.contains(&inside) {
        let expected = format!("scene. and one of {}", Setup::MEMBERS.join(", "));
        let complaint = Complaint::new("", found, expected);
        return Err(key.complain(complaint.or_nearest(inside, &Setup::MEMBERS)));
    }
    if subject == VariedFile::Bat && steps == [member("profile"), member("csv")] {
        let expected = "\"bat.profile\", with values such as {\"csv\": \"stations.csv\"}";
        return Err(key.error(found, expected));
    }
    Ok((subject, steps))
}

/// The variation of a member, added to the design.
fn way(node: &Node, wanted: &mut DesignTerms) -> Result<Variation> {
    let mut mistakes = Mistakes::default();
    let object = node.object(VariationForm::KEYS, &mut mistakes)?;
    mistakes.end(())?;
    let Some((way, node)) = object.one_of(VariationForm::KEYS)? else {
        let expected = format!("one of {}", VariationForm::KEYS.join(", "));
        return Err(node.error("nothing that says how it varies", expected));
    };
    let items = node.items()?;
    let mut list = |numbers: Vec<f64>, listed: Vec<ListedValue>, unit: String| {
        wanted.lists.push(numbers.len().max(listed.len()) as u64);
        Variation { axis: Axis::List(wanted.lists.len() - 1), numbers, listed, unit }
    };
    if way == "values" {
        if items.is_empty() {
            return Err(node.error("an empty list", "one value at least"));
        }
        if let Some((numbers, unit)) = of_one_unit(&items) {
            return Ok(list(numbers, vec![], unit));
        }
        let listed =
            items.iter().map(Node::value).map(|said| ListedValue { meant: said.clone(), said });
        return Ok(list(vec![], listed.collect(), String::new()));
    }
    let forms: [(&str, &str, usize); 5] = [
        ("grid", "[from, to, how many], such as [\"0 oz\", \"2 oz\", 9]", 3),
        ("uniform", "[from, to], such as [600, 700]", 2),
        ("normal", "[mean, standard deviation], such as [\"27.5 mm\", \"0.2 mm\"]", 2),
        ("lognormal", "[median, standard deviation of the logarithm], such as [650, 0.04]", 2),
        ("triangular", "[from, likeliest, to], such as [600, 650, 720]", 3),
    ];
    let (_, form, count) = forms.into_iter().find(|(name, ..)| *name == way).unwrap_or(forms[0]);
    if items.len() != count {
        return Err(node.error(format!("{} values", items.len()), form));
    }
    // The last number of these two has no unit.
    let with_unit = if matches!(way, "grid" | "lognormal") { count - 1 } else { count };
    let (numbers, unit) = alike(&items[..with_unit])?;
    if way == "grid" {
        let count = items[2].whole()?;
        if !(2..=1_000_000).contains(&count) {
            return Err(items[2].error(items[2].shown(), "2 to 1000000 values"));
        }
        let at = |k: u64| {
            let share = k as f64 / (count - 1) as f64;
            (1.0 - share) * numbers[0] + share * numbers[1]
        };
        return Ok(list((0..count).map(at).collect(), vec![], unit));
    }
    wanted.drawn.push(distribution(way, &numbers, &items, node)?);
    let axis = Axis::Drawn(wanted.drawn.len() - 1);
    Ok(Variation { axis, numbers: vec![], listed: vec![], unit })
}

/// The distribution of that name with these numbers; that of a logarithm is the second item.
fn distribution(way: &str, numbers: &[f64], items: &[Node], node: &Node) -> Result<Distribution> {
    let distribution = match way {
        "uniform" => Distribution::Uniform { from: numbers[0], to: numbers[1] },
        "normal" => Distribution::Normal { mean: numbers[0], deviation: numbers[1] },
        "triangular" => {
            Distribution::Triangular { from: numbers[0], peak: numbers[1], to: numbers[2] }
        }
        _ => Distribution::Lognormal { median: numbers[0], deviation: items[1].number()? },
    };
    distribution.check().map_err(|error| {
        error.placed(|complaint| {
            let found = format!("{} for \"{}\"", complaint.found, complaint.field);
            node.complain(Complaint { field: String::new(), found, ..complaint })
        })
    })?;
    Ok(distribution)
}

/// The numbers of values that must all have the unit of the first, and the unit.
fn alike(items: &[Node]) -> Result<(Vec<f64>, String)> {
    let (numbers, units): (Vec<f64>, Vec<String>) =
        mistakes::all(items.iter().map(number))?.into_iter().unzip();
    if let Some(k) = units.iter().position(|other| *other != units[0]) {
        let expected = match &*units[0] {
            "" => "a bare number, as the first".to_owned(),
            unit => format!("the unit \"{unit}\", as the first has"),
        };
        return Err(items[k].error(items[k].shown(), expected));
    }
    Ok((numbers, units[0].clone()))
}

/// The numbers of values that all have the same unit, and the unit.
fn of_one_unit(items: &[Node]) -> Option<(Vec<f64>, String)> {
    let (numbers, unit) = alike(items).ok()?;
    let known = Quantity::ALL.iter().any(|quantity| units::factor(&unit, *quantity).is_ok());
    known.then_some((numbers, unit))
}

/// A number and its unit, which may be empty.
fn number(node: &Node) -> Result<(f64, String)> {
    let Ok(text) = node.string() else { return Ok((node.number()?, String::new())) };
    let plain = typed::plain(&text);
    let (number, unit) = typed::split(&plain);
    let value = typed::number(number).or_else(|| typed::mixed(number));
    match value.filter(|value| value.is_finite()) {
        Some(value) => Ok((value, unit.to_owned())),
        None => Err(node.error(node.shown(), "a number, or a number and its unit")),
    }
}
