//! How is a formula read?
//!
//! The grammar is Python's for arithmetic, with `^` another way to write `**`:
//!
//! ```text
//! sum     = product (("+" | "-") product)*
//! product = signed (("*" | "/") signed)*
//! signed  = ("+" | "-")* power
//! power   = atom [("**" | "^") signed]
//! atom    = number | "x" | "pi" | function "(" sum ("," sum)* ")" | "(" sum ")"
//! ```
//!
//! So `-2**2` is −4, `2**3**2` is 2⁹ and `2**-1` is ½. The parser library winnow reads it, because ready-made
//! expression evaluators take `-2^2` for 4.

use std::ops::Range;

use winnow::ModalResult;
use winnow::Parser;
use winnow::combinator::{alt, cut_err, opt, preceded, repeat, separated, terminated};
use winnow::error::{ErrMode, ParserError};
use winnow::stream::{LocatingSlice, Location, Stateful, Stream};
use winnow::token::{one_of, take_while};

use crate::base::{Complaint, nearest, shortened};
use crate::bat::formula_tree::{FUNCTIONS, Node};

/// Longest formula that is read (characters).
const LONGEST: usize = 10_000;
/// Deepest nesting of brackets and powers that is read.
const DEEPEST: usize = 100;
/// Most `abs`, `min` and `max` in one formula: each is evaluated on every stretch between the corners of all.
const MOST_BRANCHES: usize = 100;

/// The parts of a formula, or what is wrong with it and where in the text (bytes).
pub(crate) fn read(text: &str) -> Result<Node, (Complaint, Range<usize>)> {
    let length = text.chars().count();
    if length > LONGEST {
        let expected = format!("{LONGEST} at most");
        let found = format!("a formula of {length} characters");
        return Err((Complaint::new("", found, expected), 0..text.len()));
    }
    if text.trim().is_empty() {
        let expected = "a formula of x, such as \"0.0125 + 0.02*x\"";
        return Err((Complaint::new("", "an empty formula", expected), 0..text.len()));
    }
    let mut input = FormulaInput { input: LocatingSlice::new(text), state: 0 };
    match whole(&mut input) {
        Ok(root) if root.branches() > MOST_BRANCHES => {
            let found = format!("{} abs, min and max in one formula", root.branches());
            let expected = format!("{MOST_BRANCHES} at most; stations hold more corners");
            Err((Complaint::new("", found, expected), 0..text.len()))
        }
        Ok(root) => Ok(root),
        Err(ErrMode::Backtrack(fault) | ErrMode::Cut(fault)) => {
            let part = fault.offset..fault.offset + word(&text[fault.offset..]).len();
            Err((fault.complaint(text), part))
        }
        Err(ErrMode::Incomplete(_)) => unreachable!("the whole text is there"),
    }
}

/// The remaining text, its place, and its depth in brackets and powers.
type FormulaInput<'a> = Stateful<LocatingSlice<&'a str>, usize>;

/// A mistake at a byte of the text.
#[derive(Debug)]
struct Fault {
    offset: usize,
    /// What was found, if it is not the word at that place.
    found: Option<String>,
    expected: String,
    hint: String,
}

impl ParserError<FormulaInput<'_>> for Fault {
    type Inner = Self;

    fn from_input(input: &FormulaInput<'_>) -> Self {
        let offset = input.current_token_start();
        Self { offset, found: None, expected: String::new(), hint: String::new() }
    }

    fn into_inner(self) -> Result<Self, Self> {
        Ok(self)
    }
}

impl Fault {
    fn new(input: &FormulaInput, expected: impl Into<String>) -> ErrMode<Self> {
        ErrMode::Cut(Self { expected: expected.into(), ..Self::from_input(input) })
    }

    /// The complaint, which quotes what was found with its place, and what was expected:
    /// `"tanhh" at character 10 of "0.0127 + tanhh(x)"`.
    fn complaint(self, text: &str) -> Complaint {
        let here = word(&text[self.offset..]);
        let what = match self.found {
            Some(found) => found,
            None if here.is_empty() => "the end".to_owned(),
            None => format!("{:?}", shortened(here, 40)),
        };
        let before = text[..self.offset].chars().count();
        // A window of a long formula around the place.
        let skipped = before.saturating_sub(60);
        let window: String = text.chars().skip(skipped).collect();
        let dots = if skipped > 0 { "…" } else { "" };
        let window = format!("{dots}{}", shortened(&window, 100));
        let found = format!("{what} at character {} of {window:?}", before + 1);
        let hint = match here.chars().next() {
            Some('\u{2212}' | '–' | '—') => "a minus is written -",
            Some('×' | '·' | '⋅') => "times is written *",
            Some('²' | '³') => "a square is written ^2",
            Some(',') if self.expected.starts_with("an operator (") => {
                "decimals follow a point: 0.5"
            }
            _ => &self.hint,
        };
        Complaint::new("", found, self.expected.clone()).hinted(hint)
    }
}

/// The word, number or single character that the text begins with.
fn word(text: &str) -> &str {
    let end = text.find(|c| !in_name(c)).unwrap_or(text.len());
    let first = text.chars().next().map_or(0, char::len_utf8);
    &text[..end.max(first)]
}

/// Letters of names include the point, for `math.tanh` and for numbers.
fn in_name(c: char) -> bool {
    c.is_alphabetic() || c.is_ascii_digit() || c == '_' || c == '.'
}

fn whole(input: &mut FormulaInput) -> ModalResult<Node, Fault> {
    blanks(input)?;
    let root = sum(input)?;
    if input.eof_offset() == 0 {
        return Ok(root);
    }
    Err(Fault::new(input, "an operator (+ - * / ^) or the end"))
}

fn blanks(input: &mut FormulaInput) -> ModalResult<(), Fault> {
    take_while(0.., [' ', '\t', '\r', '\n']).void().parse_next(input)
}

/// One of these characters and the blanks behind it.
fn symbol<'a, const N: usize>(
    symbols: [char; N],
) -> impl Parser<FormulaInput<'a>, char, ErrMode<Fault>> {
    terminated(one_of(symbols), blanks)
}

fn sum(input: &mut FormulaInput) -> ModalResult<Node, Fault> {
    let first = product(input)?;
    let more = (symbol(['+', '-']).map(|sign| sign == '-'), cut_err(product));
    list(first, more, Node::Sum, input)
}

fn product(input: &mut FormulaInput) -> ModalResult<Node, Fault> {
    let first = signed(input)?;
    let more = (symbol(['*', '/']).map(|sign| sign == '/'), cut_err(signed));
    list(first, more, Node::Product, input)
}

/// `first` alone, or all of them in a node of that kind.
fn list<'a>(
    first: Node,
    more: impl Parser<FormulaInput<'a>, (bool, Node), ErrMode<Fault>>,
    kind: fn(Vec<(bool, Node)>) -> Node,
    input: &mut FormulaInput<'a>,
) -> ModalResult<Node, Fault> {
    let rest: Vec<(bool, Node)> = repeat(0.., more).parse_next(input)?;
    if rest.is_empty() {
        return Ok(first);
    }
    Ok(kind([(false, first)].into_iter().chain(rest).collect()))
}

fn signed(input: &mut FormulaInput) -> ModalResult<Node, Fault> {
    let signs: Vec<char> = repeat(0.., symbol(['+', '-'])).parse_next(input)?;
    let value = power(input)?;
    let negative = signs.iter().filter(|sign| **sign == '-').count() % 2 == 1;
    Ok(if negative { Node::Negative(Box::new(value)) } else { value })
}

fn power(input: &mut FormulaInput) -> ModalResult<Node, Fault> {
    let base = atom(input)?;
    let operator = terminated(alt(("**", "^")), blanks);
    let exponent = opt(preceded(operator, cut_err(deeper(signed)))).parse_next(input)?;
    Ok(match exponent {
        Some(exponent) => Node::Power(Box::new([base, exponent])),
        None => base,
    })
}

/// The parser `inner` one level of brackets or powers deeper; an error below [`DEEPEST`] levels.
fn deeper<'a, T>(
    mut inner: impl FnMut(&mut FormulaInput<'a>) -> ModalResult<T, Fault>,
) -> impl FnMut(&mut FormulaInput<'a>) -> ModalResult<T, Fault> {
    move |input| {
        if input.state == DEEPEST {
            let expected = format!("at most {DEEPEST} levels of brackets and powers");
            return Err(Fault::new(input, expected));
        }
        input.state += 1;
        let value = inner(input);
        input.state -= 1;
        value
    }
}

fn atom(input: &mut FormulaInput) -> ModalResult<Node, Fault> {
    const EXPECTED: &str = "a number, x, pi, a function or a bracket";
    match input.peek_token() {
        Some('(') => {
            symbol(['(']).parse_next(input)?;
            let inner = deeper(sum)(input)?;
            closed(input, "an operator (+ - * / ^) or a closing bracket")?;
            Ok(inner)
        }
        Some('0'..='9' | '.') => number(input),
        Some(c) if c.is_alphabetic() || c == '_' => named(input),
        _ => Err(Fault::new(input, EXPECTED)),
    }
}

fn closed(input: &mut FormulaInput, expected: &str) -> ModalResult<(), Fault> {
    match opt(symbol([')'])).parse_next(input)? {
        Some(_) => Ok(()),
        None => Err(Fault::new(input, expected)),
    }
}

/// `12`, `1.`, `.5`, `2.5e-3`.
fn number(input: &mut FormulaInput) -> ModalResult<Node, Fault> {
    let start = input.checkpoint();
    let digits = || take_while(0.., '0'..='9');
    let sign = || opt(one_of(['+', '-']));
    let exponent = (one_of(['e', 'E']), sign(), take_while(1.., '0'..='9'));
    let written = (digits(), opt(('.', digits())), opt(exponent)).take().parse_next(input)?;
    // A point alone is not a number, and a number beyond the range of `f64` is refused.
    let value = written.parse().ok().filter(|value: &f64| value.is_finite());
    match value {
        Some(value) => {
            blanks(input)?;
            Ok(Node::Number(value))
        }
        None => {
            input.reset(&start);
            Err(Fault::new(input, "a number such as 0.0125 or 1e-3"))
        }
    }
}

/// `x`, `pi` or a function with its arguments.
fn named(input: &mut FormulaInput) -> ModalResult<Node, Fault> {
    let start = input.checkpoint();
    let name = terminated(take_while(1.., in_name), blanks).parse_next(input)?;
    let function = match name {
        "x" => return Ok(Node::X),
        "pi" => return Ok(Node::Number(std::f64::consts::PI)),
        _ => FUNCTIONS.iter().find(|(known, _)| *known == name),
    };
    let Some((name, function)) = function else {
        input.reset(&start);
        return Err(unknown_name(input, name));
    };
    if opt(symbol(['('])).parse_next(input)?.is_none() {
        return Err(Fault::new(input, format!("a bracket: {name}(…)")));
    }
    let arguments: Vec<Node> =
        deeper(|input| separated(1.., cut_err(sum), symbol([','])).parse_next(input))(input)?;
    closed(input, "an operator (+ - * / ^), a comma or a closing bracket")?;
    if function.takes(arguments.len()) {
        return Ok(Node::Call(*function, arguments));
    }
    input.reset(&start);
    let plural = if arguments.len() == 1 { "" } else { "s" };
    let found = format!("{name} of {} argument{plural}", arguments.len());
    let expected = if function.takes(1) { "one" } else { "two or more" };
    let fault = Fault::from_input(input);
    Err(ErrMode::Cut(Fault { found: Some(found), expected: expected.into(), ..fault }))
}

/// An unknown name, with the nearest valid one.
fn unknown_name(input: &FormulaInput, unknown: &str) -> ErrMode<Fault> {
    let functions = FUNCTIONS.map(|(name, _)| name);
    let names: Vec<&str> = ["x", "pi"].into_iter().chain(functions).collect();
    let expected = format!("x, pi or a function: {}", functions.join(", "));
    // `math.tanh` and `np.tanh` stand for their last part.
    let plain = unknown.rsplit('.').next().unwrap_or(unknown);
    let meant = if plain == "ln" { Some("log") } else { nearest(plain, &names) };
    let hint = meant.map(|name| format!("did you mean {name}?")).unwrap_or_default();
    ErrMode::Cut(Fault { expected, hint, ..Fault::from_input(input) })
}
