//! What are the words of a wish: a verb, a number in figures or in words, and a direction?
//!
//! Only words are read here; [`crate::files::aim_text`] reads the goal and the unit.

use sweetspot::base::typed;

/// The meaning of the verb at the beginning of a wish.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verb {
    /// Keep it.
    Keep,
    /// Lose nothing.
    NoLess,
    /// Lose this much.
    Less,
    /// Gain this much.
    More,
}

/// The wish, with the words of its amount.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WishedChange<'a> {
    /// As it is.
    Same,
    /// No more than this.
    AtMost(&'a str),
    /// No less than this.
    AtLeast(&'a str),
    /// This.
    To(&'a str),
    /// So much more.
    More(&'a str),
    /// So much less.
    Less(&'a str),
    /// An amount, and no word of where to.
    Plain(&'a str),
}

const VERBS: [(&str, Verb); 32] = [
    ("do not lose any", Verb::NoLess),
    ("do not lose", Verb::NoLess),
    ("without losing any", Verb::NoLess),
    ("without losing", Verb::NoLess),
    ("no loss of", Verb::NoLess),
    ("no less", Verb::NoLess),
    ("do not change", Verb::Keep),
    ("with the same", Verb::Keep),
    ("the same", Verb::Keep),
    ("same", Verb::Keep),
    ("keep", Verb::Keep),
    ("hold", Verb::Keep),
    ("maintain", Verb::Keep),
    ("preserve", Verb::Keep),
    ("retain", Verb::Keep),
    ("unchanged", Verb::Keep),
    ("lose", Verb::Less),
    ("shed", Verb::Less),
    ("trim", Verb::Less),
    ("remove", Verb::Less),
    ("take off", Verb::Less),
    ("cut off", Verb::Less),
    ("take", Verb::Less),
    ("cut", Verb::Less),
    ("reduce", Verb::Less),
    ("lower", Verb::Less),
    ("decrease", Verb::Less),
    ("gain", Verb::More),
    ("add", Verb::More),
    ("put on", Verb::More),
    ("increase", Verb::More),
    ("raise", Verb::More),
];
const FILLERS: [&str; 17] = [
    "please",
    "i want to",
    "i want",
    "make",
    "get",
    "move",
    "shift",
    "let",
    "have",
    "it",
    "the",
    "my",
    "its",
    "this",
    "bat",
    "be",
    "with",
];
const SAME: [&str; 16] = [
    "same",
    "the same",
    "stays the same",
    "stay the same",
    "stays",
    "as it is",
    "stays as it is",
    "as is",
    "kept",
    "unchanged",
    "stays unchanged",
    "constant",
    "fixed",
    "not changed",
    "as before",
    "where it is",
];
const LINKS: [&str; 10] =
    [":", "should be", "must be", "stays", "is", "be", "weighs", "by", "of", "further"];
const AT_MOST: [&str; 16] = [
    "at most",
    "no more than",
    "not more than",
    "no heavier than",
    "not above",
    "not over",
    "lighter than",
    "less than",
    "under",
    "below",
    "up to",
    "maximum",
    "max",
    "<=",
    "≤",
    "<",
];
const AT_LEAST: [&str; 14] = [
    "at least",
    "no less than",
    "not less than",
    "no lighter than",
    "not below",
    "not under",
    "heavier than",
    "more than",
    "over",
    "above",
    "minimum",
    ">=",
    "≥",
    ">",
];
const OR_LESS: [&str; 6] =
    ["at most", "at the most", "or less", "or lighter", "or below", "maximum"];
const OR_MORE: [&str; 5] = ["at least", "or more", "or heavier", "or above", "minimum"];
const TO: [&str; 4] = ["to", "=", "at", "exactly"];
const MORE: [&str; 19] = [
    "outward",
    "outwards",
    "out",
    "further out",
    "farther out",
    "towards the tip",
    "toward the tip",
    "towards the barrel",
    "toward the barrel",
    "towards the end",
    "toward the end",
    "more",
    "higher",
    "heavier",
    "faster",
    "up",
    "larger",
    "bigger",
    "increase",
];
const LESS: [&str; 20] = [
    "inward",
    "inwards",
    "further in",
    "towards the knob",
    "toward the knob",
    "towards the handle",
    "toward the handle",
    "towards the hands",
    "toward the hands",
    "less",
    "lower",
    "lighter",
    "slower",
    "down",
    "smaller",
    "off",
    "fewer",
    "lighten",
    "reduction",
    "decrease",
];
const THAN_NOW: [&str; 5] =
    ["than now", "than before", "than it is", "than it was", "than it is now"];

/// A text in plain signs: "don't" in full, one blank between words, no full stop at its end.
pub fn plain(text: &str) -> String {
    let full =
        ["n't", "n’t", "N'T"].iter().fold(text.to_owned(), |text, not| text.replace(not, " not"));
    let words: Vec<String> = typed::plain(&full).split_whitespace().map(str::to_owned).collect();
    words.join(" ").trim_end_matches(['.', '!']).trim_end().to_owned()
}

/// The text after a word at its beginning; `None` if it does not begin with that word.
pub fn after<'a>(text: &'a str, word: &str) -> Option<&'a str> {
    let head = text.get(..word.len())?;
    let rest = &text[word.len()..];
    let (last, next) = (head.chars().last()?, rest.chars().next());
    let goes_on = next.is_some_and(|next| {
        let letter = |c: char| c.is_alphabetic() || matches!(c, '_' | '@');
        letter(last) && letter(next)
            || last.is_ascii_digit() && (next.is_alphanumeric() || next == '.')
    });
    (head.eq_ignore_ascii_case(word) && !goes_on).then(|| rest.trim_start())
}

/// The text before a word at its end.
pub fn before<'a>(text: &'a str, word: &str) -> Option<&'a str> {
    let at = text.len().checked_sub(word.len())?;
    let (rest, tail) = (text.get(..at)?, text.get(at..)?);
    let apart = rest.is_empty() || rest.ends_with([' ', '%']);
    (apart && tail.eq_ignore_ascii_case(word)).then(|| rest.trim_end())
}

/// The longest of the words that matches, and the rest.
fn longest<'a>(words: &[&str], rest: impl Fn(&str) -> Option<&'a str>) -> Option<&'a str> {
    words.iter().filter_map(|word| rest(word)).min_by_key(|rest| rest.len())
}

/// The verb at the beginning of a text, and the rest without filler words.
pub fn verb(mut text: &str) -> (Option<Verb>, &str) {
    while let Some(rest) =
        longest(&FILLERS, |word| after(text, word)).filter(|_| of_verbs(text).is_none())
    {
        text = rest;
    }
    of_verbs(text).map_or((None, text), |(verb, rest)| (Some(verb), rest))
}

fn of_verbs(text: &str) -> Option<(Verb, &str)> {
    let all = VERBS.iter().filter_map(|(word, verb)| Some((*verb, after(text, word)?)));
    let found = all.min_by_key(|(_, rest)| rest.len())?;
    // "no less than 30 oz" is a limit.
    (after(found.1, "than").is_none()).then_some(found)
}

/// The wish in the words beside the name; numbers are in figures.
pub fn way(text: &str) -> WishedChange<'_> {
    let mut text = longest(&THAN_NOW, |word| before(text, word)).unwrap_or(text);
    let is = |text: &str, words: &[&str]| words.iter().any(|word| word.eq_ignore_ascii_case(text));
    if is(text, &SAME) {
        return WishedChange::Same;
    }
    while let Some(rest) = longest(&LINKS, |word| after(text, word)) {
        text = rest;
    }
    let begins = |words: &[&str]| longest(words, |word| after(text, word));
    let ends = |words: &[&str]| longest(words, |word| before(text, word));
    let by = |rest: &'_ str| after(rest, "by").map_or(0, |by| rest.len() - by.len());
    if let Some(rest) = begins(&AT_MOST).or_else(|| ends(&OR_LESS)) {
        return WishedChange::AtMost(rest);
    }
    if let Some(rest) = begins(&AT_LEAST).or_else(|| ends(&OR_MORE)) {
        return WishedChange::AtLeast(rest);
    }
    if let Some(rest) = begins(&TO) {
        return match way(rest) {
            WishedChange::Plain(rest) => WishedChange::To(rest),
            bound => bound,
        };
    }
    if let Some(rest) = ends(&MORE).or_else(|| begins(&MORE)) {
        return WishedChange::More(&rest[by(rest)..]);
    }
    match ends(&LESS).or_else(|| begins(&LESS)) {
        Some(rest) => WishedChange::Less(&rest[by(rest)..]),
        None if is(text, &SAME) => WishedChange::Same,
        None => WishedChange::Plain(text),
    }
}

/// Whether the words speak of the bat's weight without its name.
pub fn of_weight(text: &str) -> bool {
    const WORDS: [&str; 6] = ["lighter", "heavier", "lighten", "weigh", "weighs", "weighing"];
    text.split(' ').any(|word| WORDS.iter().any(|known| known.eq_ignore_ascii_case(word)))
}

/// Numbers in words as figures: "half an ounce" is `0.5 oz`, "an ounce and a half" `1.5 oz`, "minus 3" `-3`.
pub fn figures(text: &str) -> String {
    const NUMBERS: [(&str, &str); 16] = [
        ("a", "1"),
        ("an", "1"),
        ("one", "1"),
        ("two", "2"),
        ("three", "3"),
        ("four", "4"),
        ("five", "5"),
        ("six", "6"),
        ("seven", "7"),
        ("eight", "8"),
        ("nine", "9"),
        ("ten", "10"),
        ("twelve", "12"),
        ("half", "0.5"),
        ("quarter", "0.25"),
        ("zero", "0"),
    ];
    const UNITS: [(&str, &str); 12] = [
        ("ounce", "oz"),
        ("ounces", "oz"),
        ("oz.", "oz"),
        ("gram", "g"),
        ("grams", "g"),
        ("gramme", "g"),
        ("grammes", "g"),
        ("pound", "lb"),
        ("pounds", "lb"),
        ("hertz", "Hz"),
        ("percent", "%"),
        ("OZ", "oz"),
    ];
    let of = |table: &[(&str, &'static str)], word: &str| {
        table.iter().find(|(known, _)| known.eq_ignore_ascii_case(word)).map(|(_, said)| *said)
    };
    /// In place of the last word.
    fn again(out: &mut Vec<String>, word: String) {
        out.pop();
        out.push(word);
    }
    let mut out: Vec<String> = vec![];
    for word in text.replace("per cent", "percent").split(' ') {
        let number = of(&NUMBERS, word);
        let last = out.last().map(String::as_str).unwrap_or_default();
        let counted = last.parse::<f64>().is_ok() || last.contains('/');
        let figure = word.starts_with(|c: char| c.is_ascii_digit());
        match (number, last) {
            // "half an ounce", "1/2 an ounce", "quarter of an ounce".
            (Some("1"), _) if counted && word.starts_with(['a', 'A']) => {}
            (None, _) if counted && word == "of" => {}
            // "a half ounce".
            (Some(part @ ("0.5" | "0.25")), "1") => again(&mut out, part.to_owned()),
            (Some(number), "minus" | "-") => again(&mut out, format!("-{number}")),
            (Some(number), "plus" | "+") => again(&mut out, format!("+{number}")),
            (Some(number), _) => out.push(number.to_owned()),
            (None, "minus" | "-") if figure => again(&mut out, format!("-{word}")),
            (None, "plus" | "+") if figure => again(&mut out, format!("+{word}")),
            _ => out.push(of(&UNITS, word).unwrap_or(word).to_owned()),
        }
    }
    and_a_half(&mut out);
    out.join(" ")
}

/// "frequency 2", "frequency of mode 2", "mode 2 frequency" and "second bending frequency" as `f2`.
pub fn frequencies(text: &str) -> String {
    const ORDINALS: [[&str; 2]; 5] = [
        ["first", "1st"],
        ["second", "2nd"],
        ["third", "3rd"],
        ["fourth", "4th"],
        ["fifth", "5th"],
    ];
    let words: Vec<&str> = text.split(' ').collect();
    let is = |word: &str, name: &str| word.eq_ignore_ascii_case(name);
    let ordinal = |word: &str| {
        let at = ORDINALS.iter().position(|both| both.iter().any(|one| is(word, one)));
        at.map(|k| k + 1)
    };
    let number = |word: &str| word.parse::<usize>().ok().filter(|k| (1..=40).contains(k));
    let mut out: Vec<String> = vec![];
    let mut k = 0;
    while k < words.len() {
        let (order, taken) = match &words[k..] {
            [f, of, mode, n, ..] if is(f, "frequency") && is(of, "of") && is(mode, "mode") => {
                (number(n), 4)
            }
            [mode, n, f, ..] if is(mode, "mode") && is(f, "frequency") => (number(n), 3),
            [nth, bending, f, ..] if is(bending, "bending") && is(f, "frequency") => {
                (ordinal(nth), 3)
            }
            [nth, f, ..] if is(f, "frequency") => (ordinal(nth), 2),
            [f, n, ..] if is(f, "frequency") => (number(n), 2),
            _ => (None, 1),
        };
        match order {
            Some(order) => out.push(format!("f{order}")),
            None => out.push(words[k].to_owned()),
        }
        k += if order.is_some() { taken } else { 1 };
    }
    out.join(" ")
}

/// "1 oz and 0.5" and "1 and 0.5 oz" as `1.5 oz`.
fn and_a_half(words: &mut Vec<String>) {
    let Some(k) = words.iter().position(|word| word == "and") else { return };
    let number = |word: Option<&String>| word.and_then(|word| word.parse::<f64>().ok());
    let part = number(words.get(k + 1)).filter(|part| *part > 0.0 && *part < 1.0);
    let at = [k.checked_sub(1), k.checked_sub(2)].into_iter().flatten();
    let whole = at.filter_map(|at| Some((at, number(words.get(at))?))).next();
    if let (Some((at, whole)), Some(part)) = (whole, part) {
        words[at] = (whole + part.copysign(whole)).to_string();
        words.drain(k..k + 2);
    }
}

/// Every word that a wish may have besides names and numbers.
pub fn known() -> Vec<&'static str> {
    let verbs = VERBS.iter().map(|(word, _)| *word);
    let lists =
        [&SAME[..], &AT_MOST, &AT_LEAST, &MORE, &LESS, &["within", "ounce", "ounces"]].concat();
    verbs.chain(lists).filter(|word| word.chars().all(|c| c.is_ascii_alphabetic())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_words_are_figures() {
        for (said, figure) in [
            ("an ounce", "1 oz"),
            ("half an ounce", "0.5 oz"),
            ("a half ounce", "0.5 oz"),
            ("a quarter of an ounce", "0.25 oz"),
            ("an ounce and a half", "1.5 oz"),
            ("one and a half ounces", "1.5 oz"),
            ("minus three", "-3"),
            ("- 1 oz", "-1 oz"),
            ("1/2 an ounce", "1/2 oz"),
            ("5 per cent", "5 %"),
        ] {
            assert_eq!(figures(said), figure, "{said}");
        }
    }

    #[test]
    fn verbs_and_ways_are_found_at_both_ends() {
        assert_eq!(verb("make the bat lose 1 oz"), (Some(Verb::Less), "1 oz"));
        assert_eq!(verb("keep the balance"), (Some(Verb::Keep), "the balance"));
        assert_eq!(verb("no less than 30 oz"), (None, "no less than 30 oz"));
        assert_eq!(way("1 oz lighter"), WishedChange::Less("1 oz"));
        assert_eq!(way("lighter by 1 oz"), WishedChange::Less("1 oz"));
        assert_eq!(way("out 1 in"), WishedChange::More("1 in"));
        assert_eq!(way("should be at most 30 oz"), WishedChange::AtMost("30 oz"));
        assert_eq!(way("to 30 oz"), WishedChange::To("30 oz"));
        assert_eq!(way("stays the same"), WishedChange::Same);
        assert_eq!(after("drop3", "drop"), Some("3"));
        assert_eq!(after("node 12", "node 1"), None);
        assert_eq!(after("mass_kg", "mass"), None);
    }
}
