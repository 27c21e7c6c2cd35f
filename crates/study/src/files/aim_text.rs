//! How is a wish said in words: "sweet spot 1 cm outward", "swing weight -3 % within 5 oz in2"?

use std::sync::LazyLock;

use crate::aim::wish::{Amount, Ask, DiameterLimit, FreeChoice, Goal, Target};
use crate::answers::Answer;
use crate::engine::{BUILT_IN, Complaint, Error, Material, Quantity, nearest, typed, units};
use crate::files::wish_words::{self, Verb, WishedChange, after, before};

/// Common names of goals.
static CALLED: LazyLock<Vec<(&str, Goal)>> = LazyLock::new(|| {
    let goal = |name: &str| Goal::named(name).expect("the words name goals");
    wish_words::named("goal ").map(|(name, called)| (called, goal(name))).collect()
});

/// The mistake, in parts.
type Said<T> = std::result::Result<T, Complaint>;

/// The goal with that name, as in documents or as people say it.
pub fn goal(name: &str) -> Said<Goal> {
    let plain = name.trim().to_lowercase();
    if let Some((_, goal)) = CALLED.iter().find(|(called, _)| *called == plain) {
        return Ok(*goal);
    }
    let short =
        plain.strip_prefix('f').and_then(|k| k.parse().ok()).filter(|k| (1..=40).contains(k));
    if let Some(order) = short {
        return Ok(Goal::Answer(Answer::Frequency(order)));
    }
    Goal::named(name.trim()).map_err(|error| match error {
        Error::Value(complaint) => {
            let names: Vec<&str> = CALLED.iter().map(|(called, _)| *called).collect();
            let expected = "sweet spot, swing weight, mass, balance point, centre of percussion, best ball, \
                            vibration, bbcor, drop, f1 to f40, node 1 to node 3, or a number's name in the \
                            documents, such as modal_mass_mode_1_kg";
            let complaint =
                Complaint { field: String::new(), expected: expected.to_owned(), ..complaint };
            if complaint.hint.is_empty() { complaint.or_nearest(&plain, &names) } else { complaint }
        }
        other => Complaint::new("", other, "a name"),
    })
}

/// The largest value of a bat (SI), where a bare number may be meant in another unit.
fn most_of_a_bat(goal: Goal) -> Option<f64> {
    match goal.quantity()? {
        Quantity::Mass => Some(3.0),
        Quantity::Inertia => Some(1.5),
        Quantity::Length => Some(1.5),
        Quantity::Speed => Some(80.0),
        _ => None,
    }
}

/// A number with its unit, a share, or a place from the tip.
pub fn amount(text: &str, goal: Goal) -> Said<Amount> {
    let text = typed::plain(text);
    if let Some(share) = text.strip_suffix('%') {
        let share =
            typed::number(share).ok_or_else(|| wrong(&text, "a percentage, such as 97 %"))?;
        return Ok(Amount::Share(0.01 * share));
    }
    // A bare number that is impossible in SI was meant in another unit.
    if let Some((number, most)) =
        typed::number(&text).zip(most_of_a_bat(goal)).filter(|(n, m)| n.abs() > *m)
    {
        let example = goal.quantity().map_or("", Quantity::example);
        let unit = goal.unit();
        let hint = format!("{number} {unit} is no bat's, {most} {unit} at most: write the unit");
        return Err(wrong(&text, &format!("its unit, such as \"{example}\"")).hinted(hint));
    }
    let Some(quantity) = goal.quantity() else {
        let number = typed::number(&text);
        return number.map(Amount::Si).ok_or_else(|| wrong(&text, "a number or a percentage"));
    };
    if quantity == Quantity::Length {
        let after = |end: &str| text.strip_suffix(end).map(str::trim);
        if let Some(place) = after("from the tip").or(after("from tip")) {
            return units::parse_or_si(place, quantity).map(Amount::FromTip);
        }
        if let Some(place) = after("from the knob").or(after("from knob")) {
            return units::parse_or_si(place, quantity).map(Amount::Si);
        }
    }
    units::parse_or_si(&text, quantity).map(Amount::Si)
}

/// A value of a wish: as [`amount`], but drops are written as in the trade: 3, -3 and "drop -3" are three ounces fewer
/// than inches.
pub fn value(text: &str, goal: Goal) -> Said<Amount> {
    if goal != Goal::Drop || text.trim_end().ends_with('%') {
        return amount(text, goal);
    }
    let text = wish_words::figures(&wish_words::plain(text));
    let inner = text.trim_start_matches('(').trim_end_matches(')');
    match typed::number(inner) {
        Some(number) if number.is_finite() && !inner.starts_with('+') => {
            Ok(Amount::Si(number.abs()))
        }
        _ => {
            let expected = "a drop as \"3\" or \"-3\": ounces fewer than inches";
            let hint = match units::parse_or_si(inner.trim_start_matches('+'), Quantity::Mass) {
                Ok(_) if typed::number(inner).is_none() => {
                    let size = inner.trim_start_matches(['-', '+']).trim();
                    format!("say \"lose {size}\" of the mass, or \"drop 3\" of a drop")
                }
                _ => "a change is \"drop 1 more\"".to_owned(),
            };
            Err(wrong(&text, expected).hinted(hint))
        }
    }
}

/// A change: a number with its sign, or with a word for the direction.
pub fn change(text: &str, goal: Goal) -> Said<Amount> {
    let text = wish_words::figures(&wish_words::plain(text));
    match wish_words::way(&text) {
        WishedChange::More(size) => by(size, goal, 1.0),
        WishedChange::Less(size) => by(size, goal, -1.0),
        WishedChange::Same => Ok(Amount::Si(0.0)),
        _ => match amount(&text, goal)? {
            Amount::FromTip(_) => Err(wrong(&text, "a change, such as \"1 cm outward\"")),
            found => Ok(found),
        },
    }
}

/// A change of that size, with a word or a verb that gives its sign.
fn by(size: &str, goal: Goal, sign: f64) -> Said<Amount> {
    match amount(size, goal)? {
        Amount::Si(value) if value >= 0.0 => Ok(Amount::Si(sign * value)),
        Amount::Share(share) if share >= 0.0 => Ok(Amount::Share(sign * share)),
        _ => Err(wrong(size, "a size without a sign: the word beside it has it")),
    }
}

/// A tolerance.
pub fn tolerance(text: &str, goal: Goal) -> Said<Amount> {
    match amount(text, goal)? {
        Amount::Si(size) | Amount::Share(size) if size.is_nan() || size <= 0.0 => {
            Err(wrong(text, "a tolerance above 0"))
        }
        Amount::FromTip(_) => Err(wrong(text, "a tolerance, such as \"1 mm\"")),
        size => Ok(size),
    }
}

/// A target in words: the goal and the wish for it.
///
/// The name may stand first ("mass -1 oz"), last ("keep the balance", "lose 3 % swing weight") or be left out where a
/// word or a unit says it: "1 oz lighter", "-1 oz"; "-3" alone is a drop.
pub fn target(text: &str) -> Said<Target> {
    let text = wish_words::frequencies(&wish_words::plain(text));
    let several = [", ", " and ", " but ", "; ", " with "].iter().any(|part| text.contains(*part));
    read(&text).map_err(|complaint| match complaint.hint.is_empty() || several {
        true => match wording(&text) {
            Some(hint) => complaint.hinted(hint),
            None => complaint,
        },
        false => complaint,
    })
}

fn read(text: &str) -> Said<Target> {
    const BESIDE: [&str; 6] = [" within", "±", "+-", "+/-", " plus or minus", " give or take"];
    let parted = BESIDE.iter().find_map(|word| text.split_once(word));
    let (wish, within) = match parted {
        Some((wish, within)) => (wish.trim(), Some(within.trim())),
        None => (text, None),
    };
    let (verb, rest) = wish_words::verb(wish);
    let (goal, rest) = of_what(verb, rest)?;
    let within = within.map(|within| tolerance(&wish_words::figures(within), goal)).transpose()?;
    match asked(text, verb, &rest, (goal, within))? {
        Ask::Between(..) if within.is_some() => {
            Err(wrong(text, "\"within\" beside a change or a value: a limit is kept exactly"))
        }
        ask => Ok(Target { goal, ask }),
    }
}

/// The goal, and the other words with their numbers in figures.
fn of_what(verb: Option<Verb>, rest: &str) -> Said<(Goal, String)> {
    let rest = ["the", "its", "my", "any", "of"]
        .iter()
        .fold(rest, |rest, word| after(rest, word).unwrap_or(rest));
    // "a drop 3" and "a swing weight of …": an article before a name, none before an amount ("a millimetre").
    let named_after = |rest: &str| CALLED.iter().any(|(called, _)| after(rest, called).is_some());
    let rest = after(rest, "a").filter(|rest| named_after(rest)).unwrap_or(rest);
    let first = CALLED.iter().filter_map(|(called, goal)| Some((after(rest, called)?, *goal)));
    if let Some((rest, goal)) = first.min_by_key(|(rest, _)| rest.len()) {
        return Ok((goal, wish_words::figures(rest)));
    }
    let last = CALLED.iter().filter_map(|(called, goal)| Some((before(rest, called)?, *goal)));
    if let Some((mut rest, goal)) = last.min_by_key(|(rest, _)| rest.len()) {
        while let Some(shorter) =
            ["the", "its", "my", "of", "off", "from"].iter().find_map(|word| before(rest, word))
        {
            rest = shorter;
        }
        return Ok((goal, wish_words::figures(rest)));
    }
    let words = wish_words::figures(rest);
    if let Some(goal) = unnamed(verb, &words) {
        let plain = words.replace("weighing", "").replace("weighs", "").replace("weigh", "");
        return Ok((goal, plain.trim().to_owned()));
    }
    named(rest).map(|(goal, rest)| (goal, wish_words::figures(rest)))
}

/// The goal of a wish without a name: by a word such as "lighter", by a unit that only one goal has, or the drop for a
/// number with a minus.
fn unnamed(verb: Option<Verb>, words: &str) -> Option<Goal> {
    if wish_words::of_weight(words) {
        return Some(Goal::Answer(Answer::Mass));
    }
    let way = wish_words::way(words);
    let (size, bare) = match way {
        WishedChange::Plain(size) => (size, true),
        WishedChange::AtMost(size)
        | WishedChange::AtLeast(size)
        | WishedChange::More(size)
        | WishedChange::Less(size) => (size, false),
        WishedChange::To(_) | WishedChange::Same => return None,
    };
    let signed = size.starts_with(['+', '-']);
    if bare && verb.is_none() && size.starts_with('-') && typed::number(size).is_some() {
        return Some(Goal::Drop);
    }
    let is = |quantity: Quantity| {
        typed::number(size).is_none() && units::parse_or_si(size, quantity).is_ok()
    };
    let said = !bare || signed || verb.is_some();
    match () {
        () if said && is(Quantity::Mass) => Some(Goal::Answer(Answer::Mass)),
        () if said && is(Quantity::Inertia) => Some(Goal::Answer(Answer::Inertia)),
        () => None,
    }
}

/// The wish for a goal, from the verb and the other words.
fn asked(
    text: &str,
    verb: Option<Verb>,
    rest: &str,
    (goal, within): (Goal, Option<Amount>),
) -> Said<Ask> {
    use WishedChange::{AtLeast, AtMost, Less, More, Plain, Same, To};
    let keeps = matches!(verb, None | Some(Verb::Keep));
    let expected = "what is wished of it, such as \"-3 %\", \"at most 31 oz\", \"1 cm outward\"";
    let changed = |by: Amount| Ok(Ask::Change(by, within));
    match (verb, wish_words::way(rest)) {
        (_, Same) if keeps => changed(Amount::Si(0.0)),
        (Some(Verb::Keep), Plain("")) => changed(Amount::Si(0.0)),
        (Some(Verb::NoLess), Plain("")) => Ok(Ask::Between(Some(Amount::Share(1.0)), None)),
        (_, AtMost(most)) if keeps => Ok(Ask::Between(None, Some(value(most, goal)?))),
        (_, AtLeast(least)) if keeps => Ok(Ask::Between(Some(value(least, goal)?), None)),
        (verb, To(size)) if verb != Some(Verb::NoLess) => {
            Ok(Ask::Value(value(size, goal)?, within))
        }
        (_, Plain("") | Less("") | More("")) => Err(wrong(text, expected)),
        (Some(Verb::Less), Plain(size) | Less(size)) => changed(by(size, goal, -1.0)?),
        (Some(Verb::More), Plain(size) | More(size)) => changed(by(size, goal, 1.0)?),
        (None, More(size)) => changed(moved(rest, size, goal, 1.0)?),
        (None, Less(size)) => changed(moved(rest, size, goal, -1.0)?),
        (None, Plain(size)) => {
            match size.ends_with('%') || goal != Goal::Drop && size.starts_with(['+', '-']) {
                true => changed(change(size, goal)?),
                false => Ok(Ask::Value(value(size, goal)?, within)),
            }
        }
        _ => Err(wrong(text, expected)),
    }
}

/// A change by a word. A lighter bat has the greater drop, but "drop 1 lighter" does not ask for one. Up and down are
/// not directions along a bat.
fn moved(rest: &str, size: &str, goal: Goal, sign: f64) -> Said<Amount> {
    if goal == Goal::Drop && wish_words::of_weight(rest) {
        return Err(wrong(
            rest,
            "\"1 more\" or \"1 less\" of a drop, or \"1 oz lighter\" of the bat",
        ));
    }
    let upright = rest.split(' ').any(|word| matches!(word, "up" | "down"));
    if upright && goal.quantity() == Some(Quantity::Length) {
        return Err(wrong(rest, "\"outward\" or \"inward\" of a place"));
    }
    by(size, goal, sign)
}

/// The nearest understood wording for one that is not: with another name or word, or as two targets.
fn wording(text: &str) -> Option<String> {
    let said = |wish: &str| read(wish).is_ok();
    // Two wishes in one.
    for part in [", ", " and ", " but ", "; ", " with "] {
        if let Some((first, second)) = text.split_once(part)
            && said(first)
            && said(second.trim_start_matches("and ").trim_start_matches("but "))
        {
            let second = second.trim_start_matches("and ").trim_start_matches("but ");
            return Some(format!("a target each: --target \"{first}\" --target \"{second}\""));
        }
    }
    // A misspelt word.
    let known = wish_words::known();
    let names = CALLED.iter().flat_map(|(called, _)| called.split(' '));
    let all: Vec<&str> = known.into_iter().chain(names).filter(|word| word.len() > 2).collect();
    let words: Vec<&str> = text.split(' ').collect();
    for (k, word) in words.iter().enumerate().filter(|(_, word)| word.len() > 2) {
        let Some(near) = nearest(word, &all).filter(|near| near != word) else { continue };
        let mut other = words.clone();
        other[k] = near;
        let other = other.join(" ");
        if said(&other) {
            return Some(format!("did you mean \"{other}\"?"));
        }
    }
    // An amount of something that is not named.
    let other = ["mass", "swing weight", "sweet spot", "best ball", "f1", "drop"]
        .into_iter()
        .find_map(|name| {
            let both = [format!("{name} {text}"), format!("{text} {name}")];
            both.into_iter().find(|other| said(other))
        });
    other.map(|other| format!("say of what, such as \"{other}\""))
}

/// The goal whose name begins a text, and the rest of the text.
fn named(text: &str) -> Said<(Goal, &str)> {
    let lower = text.to_lowercase();
    let (name, rest) = text.split_once(' ').unwrap_or((text, ""));
    goal(name).map(|goal| (goal, rest.trim())).map_err(|complaint| {
        // Of two words the first may be half a name.
        let words: Vec<&str> = lower.split(' ').take(2).collect();
        let names: Vec<&str> = CALLED.iter().map(|(called, _)| *called).collect();
        let both = words.join(" ");
        match nearest(&both, &names) {
            Some(near) => Complaint {
                found: format!("\"{both}\""),
                hint: format!("did you mean {near}?"),
                ..complaint
            },
            None => complaint,
        }
    })
}

/// A stretch: "0 to 30 mm".
pub fn stretch(text: &str) -> Said<[f64; 2]> {
    let plain = typed::plain(text);
    let expected = "a stretch, such as \"0 to 30 mm\"";
    let (from, to) = plain.split_once(" to ").ok_or_else(|| wrong(text, expected))?;
    // Of 24 to 30 in both are in inches.
    let from = match (typed::split(from.trim()), typed::split(to.trim())) {
        ((number, ""), (_, unit)) if !number.is_empty() => format!("{number} {unit}"),
        _ => from.to_owned(),
    };
    let [from, to] = [from.trim(), to.trim()].map(|end| units::parse_or_si(end, Quantity::Length));
    let ends = [from?, to?];
    if ends[0] < 0.0 || ends[0] >= ends[1] {
        return Err(wrong(text, "a stretch that begins at 0 or beyond and ends after that"));
    }
    Ok(ends)
}

/// A limit of the diameter: "4 in to 18 in, at least 24 mm".
pub fn diameter(text: &str) -> Said<DiameterLimit> {
    let mut limit = DiameterLimit { from: 0.0, to: f64::INFINITY, at_least: None, at_most: None };
    for part in text.split(',').map(str::trim) {
        if let Some(least) = part.strip_prefix("at least") {
            limit.at_least = Some(units::parse_or_si(least.trim(), Quantity::Length)?);
        } else if let Some(most) = part.strip_prefix("at most") {
            limit.at_most = Some(units::parse_or_si(most.trim(), Quantity::Length)?);
        } else {
            [limit.from, limit.to] = stretch(part)?;
        }
    }
    match (limit.at_least, limit.at_most) {
        (None, None) => {
            Err(wrong(text, "\"at least 24 mm\" or \"at most 2.61 in\", after a stretch"))
        }
        _ => Ok(limit),
    }
}

/// Adds a free choice besides the shape to those in `free`.
pub fn free(text: &str, free: &mut FreeChoice) -> Said<()> {
    let plain = typed::plain(text);
    let after = |word: &str| plain.strip_prefix(word).map(str::trim);
    if let Some(range) = after("length") {
        free.length = Some(stretch(range)?);
    } else if let Some(range) = after("density") {
        let (from, to) = range
            .split_once(" to ")
            .ok_or_else(|| wrong(text, "a range, such as \"density 600 kg/m^3 to 700 kg/m^3\""))?;
        let [from, to] = [from, to].map(|end| units::parse_or_si(end.trim(), Quantity::Density));
        let range = [from?, to?];
        if !(range[0] > 0.0 && range[0] < range[1]) {
            return Err(wrong(text, "a range above 0 that rises"));
        }
        free.density = Some(range);
    } else if let Some(names) = after("wood") {
        for name in names.split(',').map(str::trim) {
            free.woods.push(wood(name)?);
        }
    } else if let Some(most) = after("knob weight") {
        let most = most.strip_prefix("up to").unwrap_or(most).trim();
        free.knob_weight = Some(units::parse_or_si(most, Quantity::Mass)?);
    } else {
        let expected = "\"length 32 in to 34 in\", \"density 600 kg/m^3 to 700 kg/m^3\", \"wood NAME, \
                        NAME\" or \"knob weight 2 oz\"";
        return Err(wrong(text, expected));
    }
    Ok(())
}

/// A built-in wood.
pub fn wood(name: &str) -> Said<Material> {
    Material::named(name).ok_or_else(|| {
        let names: Vec<&str> = BUILT_IN.iter().map(|known| known.name).collect();
        let expected = format!("a built-in material: {}", names.join(", "));
        Complaint::new("", format!("\"{name}\""), expected).or_nearest(name, &names)
    })
}

fn wrong(text: &str, expected: &str) -> Complaint {
    Complaint::new("", format!("\"{}\"", text.trim()), expected)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_are_read_as_people_say_them() {
        let place = Goal::Answer(Answer::ExitSpeedPlace);
        let swing = Goal::Answer(Answer::Inertia);
        let mass = Goal::Answer(Answer::Mass);
        let f1 = Goal::Answer(Answer::Frequency(1));
        let (si, share) = (Amount::Si, Amount::Share);
        for (text, goal, ask) in [
            ("sweet spot 1 cm outward", place, Ask::Change(si(0.01), None)),
            ("sweet spot 1 cm towards the knob", place, Ask::Change(si(-0.01), None)),
            ("swing weight -3 %", swing, Ask::Change(share(-0.03), None)),
            (
                "Swing weight \u{2212}3 % within 1 %",
                swing,
                Ask::Change(share(-0.03), Some(share(0.01))),
            ),
            ("mass at most 31 oz", mass, Ask::Between(None, Some(si(31.0 * 0.028_349_523_125)))),
            ("inertia_pivot_kg_m2 at least 99.5 %", swing, Ask::Between(Some(share(0.995)), None)),
            ("f1 180 Hz", f1, Ask::Value(si(180.0), None)),
            ("f1 +2 Hz", f1, Ask::Change(si(2.0), None)),
            ("f1 same", f1, Ask::Change(si(0.0), None)),
            ("frequency 1 same", f1, Ask::Change(si(0.0), None)),
            ("frequency of mode 1 +2 Hz", f1, Ask::Change(si(2.0), None)),
            ("keep the first bending frequency", f1, Ask::Change(si(0.0), None)),
            ("mode 1 frequency 180 Hz", f1, Ask::Value(si(180.0), None)),
            ("weight 5 % less", mass, Ask::Change(share(-0.05), None)),
            ("drop at most 3", Goal::Drop, Ask::Between(None, Some(si(3.0)))),
            ("drop at most -3", Goal::Drop, Ask::Between(None, Some(si(3.0)))),
        ] {
            assert_eq!(target(text), Ok(Target { goal, ask }), "{text}");
        }
        let node = target("node 1 6.5 in from the tip within 0.01 in").unwrap();
        let Ask::Value(Amount::FromTip(x), Some(_)) = node.ask else { panic!("{node:?}") };
        assert!((x - 6.5 * 0.0254).abs() < 1e-15);
    }

    /// A bare number that is impossible in SI was meant in another unit, and the error asks for the unit.
    #[test]
    fn bare_numbers_that_no_bat_has_ask_for_their_unit() {
        for text in ["mass 30", "mass at most 30", "swing weight at most 9000", "best ball 100"] {
            let said = target(text).unwrap_err().to_string();
            assert!(said.contains("expected its unit"), "{text}: {said}");
        }
        for text in ["mass 0.85", "mass at most 30 oz", "swing weight 0.19", "best ball 48"] {
            assert!(target(text).is_ok(), "{text}");
        }
    }

    #[test]
    fn a_drop_is_the_trade_s_whatever_its_sign() {
        let drop = |ask: Ask| Ok(Target { goal: Goal::Drop, ask });
        for text in [
            "drop -3",
            "drop 3",
            "drop3",
            "drop-3",
            "drop \u{2212}3",
            "-3",
            "\u{2212}3",
            "minus 3",
            "drop of 3",
            "drop to -3",
            "drop = 3",
            "Drop (-3)",
            "drop three",
            "drop minus three",
            "make it a drop 3",
        ] {
            assert_eq!(target(text), drop(Ask::Value(Amount::Si(3.0), None)), "{text}");
        }
        let value = Ask::Value(Amount::Si(2.5), Some(Amount::Si(0.1)));
        assert_eq!(target("drop -2.5 within 0.1"), drop(value));
        let change = |by: f64| Ask::Change(Amount::Si(by), None);
        for (text, by) in [
            ("drop 1 more", 1.0),
            ("drop 1 less", -1.0),
            ("drop one more", 1.0),
            ("drop same", 0.0),
            ("keep the drop", 0.0),
        ] {
            assert_eq!(target(text), drop(change(by)), "{text}");
        }
        for text in
            ["drop +3", "drop 1 oz", "drop an ounce", "drop 1 lighter", "drop -1 more", "drop"]
        {
            let found = target(text).unwrap_err().to_string();
            assert!(found.contains("drop") || found.contains("sign"), "{text}: {found}");
        }
    }

    #[test]
    fn a_maker_s_own_words_are_understood() {
        let oz = 0.028_349_523_125;
        let mass = |by: f64| (Goal::Answer(Answer::Mass), Ask::Change(Amount::Si(by), None));
        for (text, by) in [
            ("lose 1 oz", -oz),
            ("lose an ounce", -oz),
            ("Lose one ounce.", -oz),
            ("-1 oz", -oz),
            ("\u{2212}1 oz", -oz),
            ("- 1 oz", -oz),
            ("minus 1 oz", -oz),
            ("minus an ounce", -oz),
            ("1 oz lighter", -oz),
            ("an ounce lighter", -oz),
            ("lighter by 1 oz", -oz),
            ("make it an ounce lighter", -oz),
            ("make the bat 1 oz lighter", -oz),
            ("1 oz less", -oz),
            ("take off 1 oz", -oz),
            ("take an ounce off", -oz),
            ("lose 1 oz of weight", -oz),
            ("mass down 1 oz", -oz),
            ("reduce mass by 1 oz", -oz),
            ("weight 1 oz less", -oz),
            ("2 oz lighter", -2.0 * oz),
            ("half an ounce lighter", -0.5 * oz),
            ("\u{bd} oz lighter", -0.5 * oz),
            ("lose an ounce and a half", -1.5 * oz),
            ("lose 30 g", -0.03),
            ("30 grams lighter", -0.03),
            ("1 oz heavier", oz),
            ("+1 oz", oz),
            ("gain an ounce", oz),
        ] {
            let (goal, ask) = mass(by);
            let found = target(text).map_err(|error| error.to_string());
            let Ok(Target { goal: found_goal, ask: Ask::Change(Amount::Si(found), None) }) = found
            else {
                panic!("{text}: {found:?}, not {ask:?}")
            };
            assert!(found_goal == goal && (found - by).abs() < 1e-15, "{text}: {found}");
        }
        let same = |answer: Answer| Target {
            goal: Goal::Answer(answer),
            ask: Ask::Change(Amount::Si(0.0), None),
        };
        for (text, answer) in [
            ("keep pop", Answer::ExitSpeed),
            ("same pop", Answer::ExitSpeed),
            ("the same pop", Answer::ExitSpeed),
            ("pop stays the same", Answer::ExitSpeed),
            ("same exit speed", Answer::ExitSpeed),
            ("same sweet spot", Answer::ExitSpeedPlace),
            ("keep the balance", Answer::BalancePoint),
            ("hold the swing weight", Answer::Inertia),
            ("swing weight unchanged", Answer::Inertia),
            ("keep f1", Answer::Frequency(1)),
            ("don't change the mass", Answer::Mass),
        ] {
            assert_eq!(target(text), Ok(same(answer)), "{text}");
        }
        let at_least = Ask::Between(Some(Amount::Share(1.0)), None);
        let pop = Goal::Answer(Answer::ExitSpeed);
        assert_eq!(target("don't lose pop"), Ok(Target { goal: pop, ask: at_least }));
        let swing = Goal::Answer(Answer::Inertia);
        let less = Ask::Change(Amount::Share(-0.03), None);
        for text in
            ["3 % less swing weight", "lose 3 % swing weight", "lower the swing weight by 3 %"]
        {
            assert_eq!(target(text), Ok(Target { goal: swing, ask: less }), "{text}");
        }
        let most = Ask::Between(None, Some(Amount::Si(30.0 * oz)));
        for text in
            ["at most 30 oz", "no heavier than 30 oz", "mass 30 oz or less", "mass under 30 oz"]
        {
            assert_eq!(
                target(text),
                Ok(Target { goal: Goal::Answer(Answer::Mass), ask: most }),
                "{text}"
            );
        }
        let out = Ask::Change(Amount::Si(0.0254), None);
        let place = Goal::Answer(Answer::ExitSpeedPlace);
        for text in [
            "sweet spot 1 in outward",
            "move the sweet spot out 1 in",
            "sweet spot 1 in further out",
        ] {
            assert_eq!(target(text), Ok(Target { goal: place, ask: out }), "{text}");
        }
    }

    #[test]
    fn what_is_not_understood_is_refused_with_the_nearest_wording() {
        for (text, said) in [
            ("loose 1 oz", "did you mean \"lose 1 oz\"?"),
            ("1 oz ligther", "did you mean \"1 oz lighter\"?"),
            ("keep popp", "did you mean"),
            ("lose 1 oz and keep pop", "--target \"lose 1 oz\" --target \"keep pop\""),
            ("lose 5 %", "say of what, such as \"lose 5 % mass\""),
            ("30 oz", "say of what, such as \"mass 30 oz\""),
            ("lose -1 oz", "without a sign"),
            ("sweet spot 1 in up", "outward"),
        ] {
            let found = target(text).unwrap_err().to_string();
            assert!(found.contains(said), "{text}: {found}");
        }
        for text in [
            "",
            " ",
            "-",
            "+",
            "lose",
            "keep",
            "half",
            "\u{212a}eep pop",
            "±",
            "within",
            "-1",
            "drop -",
            "é",
        ] {
            let _ = target(text);
        }
    }

    #[test]
    fn what_is_no_target_is_told_with_the_nearest_name() {
        for (text, said) in [
            ("sweetspot 1 cm outward", "did you mean sweet spot?"),
            ("swing wieght -3 %", "did you mean swing weight?"),
            ("mass -3 lbf", "ozf"),
            ("mass", "what is wished of it"),
            ("f1 180 Hz within 0 Hz", "a tolerance above 0"),
            ("beauty +3 %", "expected sweet spot, swing weight"),
        ] {
            let found = target(text).unwrap_err().to_string();
            assert!(found.contains(said) || text.contains("lbf"), "{text}: {found}");
        }
    }

    #[test]
    fn stretches_limits_and_free_choices_are_read() {
        assert_eq!(stretch("0 to 30 mm"), Ok([0.0, 0.03]));
        assert!(stretch("30 mm to 0").is_err() && stretch("30 mm").is_err());
        let limit = diameter("4 in to 18 in, at least 24 mm").unwrap();
        assert_eq!((limit.at_least, limit.at_most), (Some(0.024), None));
        assert!(diameter("4 in to 18 in").is_err());
        let mut choice = FreeChoice::default();
        for text in ["length 32 in to 34 in", "knob weight 2 oz", "wood white-ash-dynamic"] {
            free(text, &mut choice).unwrap();
        }
        assert!(choice.length.is_some() && choice.knob_weight.is_some() && choice.woods.len() == 1);
        assert!(free("colour red", &mut choice).is_err());
        assert!(wood("white-ash-dynamik").unwrap_err().hint.contains("white-ash-dynamic"));
    }
}
