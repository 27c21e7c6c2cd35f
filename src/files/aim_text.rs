//! How is a wish said in words: "sweet spot 1 cm outward", "swing weight -3 % within 5 oz in2"?

use crate::base::error::{Complaint, Error, nearest};
use crate::base::typed;
use crate::base::units::{self, Quantity};
use crate::bat::material::{BUILT_IN, Material};
use crate::study::aim::wish::{Amount, Ask, DiameterLimit, FreeChoice, Goal, Target};
use crate::study::many::answers::Answer;

/// What people call a goal.
const CALLED: [(&str, Goal); 20] = [
    ("sweet spot", Goal::Answer(Answer::ExitSpeedPlace)),
    ("best place", Goal::Answer(Answer::ExitSpeedPlace)),
    ("swing weight", Goal::Answer(Answer::Inertia)),
    ("moment of inertia", Goal::Answer(Answer::Inertia)),
    ("mass", Goal::Answer(Answer::Mass)),
    ("weight", Goal::Answer(Answer::Mass)),
    ("balance point", Goal::Answer(Answer::BalancePoint)),
    ("balance", Goal::Answer(Answer::BalancePoint)),
    ("center of percussion", Goal::Answer(Answer::CenterOfPercussion)),
    ("centre of percussion", Goal::Answer(Answer::CenterOfPercussion)),
    ("exit speed", Goal::Answer(Answer::ExitSpeed)),
    ("best ball", Goal::Answer(Answer::ExitSpeed)),
    ("vibration", Goal::Answer(Answer::Vibration)),
    ("bbcor", Goal::Answer(Answer::Bbcor)),
    ("drop", Goal::Drop),
    ("first frequency", Goal::Answer(Answer::Frequency(1))),
    ("second frequency", Goal::Answer(Answer::Frequency(2))),
    ("node 1", Goal::Answer(Answer::Node(1))),
    ("node 2", Goal::Answer(Answer::Node(2))),
    ("node 3", Goal::Answer(Answer::Node(3))),
];

/// What is wrong, in parts.
type Said<T> = std::result::Result<T, Complaint>;

/// The goal of a name, as documents or as people have it.
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
            match complaint.hint.is_empty() {
                true => complaint.or_nearest(&plain, &names),
                false => complaint,
            }
        }
        other => Complaint::new("", other, "a name"),
    })
}

/// A number with its unit, a share, or a place from the tip.
pub fn amount(text: &str, goal: Goal) -> Said<Amount> {
    let text = typed::plain(text);
    if let Some(share) = text.strip_suffix('%') {
        let share =
            typed::number(share).ok_or_else(|| wrong(&text, "a percentage, such as 97 %"))?;
        return Ok(Amount::Share(0.01 * share));
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

/// A change: a number with its sign, or with a word that says where to.
pub fn change(text: &str, goal: Goal) -> Said<Amount> {
    const MORE: [&str; 8] = [
        "outward",
        "outwards",
        "towards the tip",
        "toward the tip",
        "more",
        "higher",
        "heavier",
        "faster",
    ];
    const LESS: [&str; 8] = [
        "inward",
        "inwards",
        "towards the knob",
        "toward the knob",
        "less",
        "lower",
        "lighter",
        "slower",
    ];
    let text = typed::plain(text);
    let ended =
        |words: &[&str]| words.iter().find_map(|word| text.strip_suffix(word)).map(str::trim);
    let signed = |amount: Amount, sign: f64| match amount {
        Amount::Si(value) => Amount::Si(sign * value),
        Amount::Share(share) => Amount::Share(sign * share),
        place => place,
    };
    let found = match (ended(&MORE), ended(&LESS)) {
        (Some(size), _) => signed(amount(size, goal)?, 1.0),
        (_, Some(size)) => signed(amount(size, goal)?, -1.0),
        _ => amount(&text, goal)?,
    };
    match found {
        Amount::FromTip(_) => Err(wrong(&text, "a change, such as \"1 cm outward\"")),
        found => Ok(found),
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

/// A target: its name, then what is wished of it.
pub fn target(text: &str) -> Said<Target> {
    let text = typed::plain(text);
    let (goal, rest) = named(&text)?;
    let parted = ["within", "±", "+-", "+/-"].iter().find_map(|word| rest.split_once(word));
    let (rest, within) = match parted {
        Some((rest, within)) => (rest.trim(), Some(tolerance(within.trim(), goal)?)),
        None => (rest, None),
    };
    let after = |word: &str| rest.strip_prefix(word).map(str::trim);
    if let Some(most) = after("at most") {
        return Ok(Target { goal, ask: Ask::Between(None, Some(amount(most, goal)?)) });
    }
    if let Some(least) = after("at least") {
        return Ok(Target { goal, ask: Ask::Between(Some(amount(least, goal)?), None) });
    }
    if matches!(rest, "same" | "kept" | "unchanged" | "as it is") {
        return Ok(Target { goal, ask: Ask::Change(Amount::Si(0.0), within) });
    }
    if let Some(value) = after("to ").or(after("=")).or(after("at ")) {
        return Ok(Target { goal, ask: Ask::Value(amount(value, goal)?, within) });
    }
    let signed = rest.starts_with(['+', '-']) || rest.ends_with('%');
    let ends_in_a_word = rest.chars().last().is_some_and(char::is_alphabetic);
    if rest.is_empty() {
        let expected =
            "what is wished of it, such as \"-3 %\", \"at most 31 oz\", \"1 cm outward\"";
        return Err(wrong(&text, expected));
    }
    if !signed && let Ok(value) = amount(rest, goal) {
        return Ok(Target { goal, ask: Ask::Value(value, within) });
    }
    match change(rest, goal) {
        Ok(change) => Ok(Target { goal, ask: Ask::Change(change, within) }),
        Err(_) if ends_in_a_word && goal.quantity().is_none() => {
            Err(wrong(rest, "a number, or a percentage and its sign"))
        }
        Err(complaint) => Err(complaint),
    }
}

/// The goal that a text begins with, and the rest of it.
fn named(text: &str) -> Said<(Goal, &str)> {
    let lower = text.to_lowercase();
    let begins = |called: &&(&str, Goal)| {
        lower.strip_prefix(called.0).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
    };
    let longest = CALLED.iter().filter(begins).max_by_key(|(called, _)| called.len());
    if let Some((called, goal)) = longest {
        return Ok((*goal, text[called.len()..].trim()));
    }
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

/// A free choice besides the shape, added to those there are.
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
            ("weight 5 % less", mass, Ask::Change(share(-0.05), None)),
            ("drop at most 3", Goal::Drop, Ask::Between(None, Some(si(3.0)))),
        ] {
            assert_eq!(target(text), Ok(Target { goal, ask }), "{text}");
        }
        let node = target("node 1 6.5 in from the tip within 0.01 in").unwrap();
        let Ask::Value(Amount::FromTip(x), Some(_)) = node.ask else { panic!("{node:?}") };
        assert!((x - 6.5 * 0.0254).abs() < 1e-15);
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
