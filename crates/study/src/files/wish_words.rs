//! What are the words of a wish: a verb, a number in figures or in words, and a direction?
//!
//! Only words are read here; [`crate::files::aim_text`] reads the goal and the unit.

use std::sync::LazyLock;

use crate::engine::typed;

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

impl Verb {
    /// All of them, each with the name of its list of words.
    const ALL: [(&str, Self); 4] = [
        ("verb no less", Self::NoLess),
        ("verb keep", Self::Keep),
        ("verb less", Self::Less),
        ("verb more", Self::More),
    ];
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
    /// An increase by that amount.
    More(&'a str),
    /// A decrease by that amount.
    Less(&'a str),
    /// An amount, and no word of where to.
    Plain(&'a str),
}

/// Lists of words by their names, in the order of the file.
static LISTS: LazyLock<Vec<(&str, Vec<&str>)>> = LazyLock::new(|| {
    let lines = include_str!("wish_words.txt").lines().filter_map(|line| line.split_once(" = "));
    lines.map(|(name, words)| (name, words.split(", ").collect())).collect()
});

/// The words of the list with that name.
fn list(name: &str) -> &'static [&'static str] {
    LISTS.iter().find(|(known, _)| *known == name).map_or(&[], |(_, words)| words)
}

/// The words of all lists whose names begin with `start`, each with the rest of its list's name.
pub fn named(start: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let lists =
        LISTS.iter().filter_map(move |(name, words)| Some((name.strip_prefix(start)?, words)));
    lists.flat_map(|(name, words)| words.iter().map(move |word| (name, *word)))
}

/// The list of that kind with a word, by the rest of its name.
fn listed(start: &'static str, word: &str) -> Option<&'static str> {
    named(start).find(|(_, known)| known.eq_ignore_ascii_case(word)).map(|(name, _)| name)
}

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
        longest(list("filler"), |word| after(text, word)).filter(|_| of_verbs(text).is_none())
    {
        text = rest;
    }
    of_verbs(text).map_or((None, text), |(verb, rest)| (Some(verb), rest))
}

fn of_verbs(text: &str) -> Option<(Verb, &str)> {
    let all = Verb::ALL.into_iter().flat_map(|(name, verb)| {
        list(name).iter().filter_map(move |word| Some((verb, after(text, word)?)))
    });
    let found = all.min_by_key(|(_, rest)| rest.len())?;
    // "no less than 30 oz" is a limit.
    (after(found.1, "than").is_none()).then_some(found)
}

/// The wish in the words beside the name; numbers are in figures.
pub fn way(text: &str) -> WishedChange<'_> {
    let mut text = longest(list("than now"), |word| before(text, word)).unwrap_or(text);
    let is = |text: &str, words: &[&str]| words.iter().any(|word| word.eq_ignore_ascii_case(text));
    if is(text, list("same")) {
        return WishedChange::Same;
    }
    while let Some(rest) = longest(list("link"), |word| after(text, word)) {
        text = rest;
    }
    let begins = |words: &[&str]| longest(words, |word| after(text, word));
    let ends = |words: &[&str]| longest(words, |word| before(text, word));
    let by = |rest: &'_ str| after(rest, "by").map_or(0, |by| rest.len() - by.len());
    if let Some(rest) = begins(list("at most")).or_else(|| ends(list("or less"))) {
        return WishedChange::AtMost(rest);
    }
    if let Some(rest) = begins(list("at least")).or_else(|| ends(list("or more"))) {
        return WishedChange::AtLeast(rest);
    }
    if let Some(rest) = begins(list("to")) {
        return match way(rest) {
            WishedChange::Plain(rest) => WishedChange::To(rest),
            bound => bound,
        };
    }
    if let Some(rest) = ends(list("more")).or_else(|| begins(list("more"))) {
        return WishedChange::More(&rest[by(rest)..]);
    }
    match ends(list("less")).or_else(|| begins(list("less"))) {
        Some(rest) => WishedChange::Less(&rest[by(rest)..]),
        None if is(text, list("same")) => WishedChange::Same,
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
    /// In place of the last word.
    fn again(out: &mut Vec<String>, word: String) {
        out.pop();
        out.push(word);
    }
    let mut out: Vec<String> = vec![];
    for word in text.replace("per cent", "percent").split(' ') {
        let number = listed("number ", word);
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
            _ => out.push(listed("unit ", word).unwrap_or(word).to_owned()),
        }
    }
    and_a_half(&mut out);
    out.join(" ")
}

/// "frequency 2", "frequency of mode 2", "mode 2 frequency" and "second bending frequency" as `f2`.
pub fn frequencies(text: &str) -> String {
    let words: Vec<&str> = text.split(' ').collect();
    let is = |word: &str, name: &str| word.eq_ignore_ascii_case(name);
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
                (number(listed("ordinal ", nth).unwrap_or_default()), 3)
            }
            [nth, f, ..] if is(f, "frequency") => {
                (number(listed("ordinal ", nth).unwrap_or_default()), 2)
            }
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
    let lists = Verb::ALL.iter().map(|(name, _)| *name);
    let lists = lists.chain(["same", "at most", "at least", "more", "less"]).flat_map(list);
    let all = lists.chain(&["within", "ounce", "ounces"]).copied();
    all.filter(|word| word.chars().all(|c| c.is_ascii_alphabetic())).collect()
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
