//! What is the radius at `x` if the file gives it as a formula?
//!
//! Parse once with [`Formula::parse`]; evaluate many times with [`Formula::at`].

use std::ops::Range;
use std::sync::Arc;

use crate::base::Complaint;
use crate::bat::formula_text;
use crate::bat::formula_tree::Node;

/// Number of samples between which corners are sought.
const SAMPLES: usize = 1000;
/// A formula with more corners than this is refused.
const MOST_CORNERS: usize = 1000;

/// A formula of `x`, such as `0.0127 + 0.0102*(1 + tanh((x - 0.50)/0.11))`.
///
/// Numbers, `x`, `pi`, `+ - * /`, `**` or `^`, and the functions `sin cos tan exp log sqrt tanh abs min max`: angles in
/// radians, `log` natural, `min` and `max` of two arguments or more. Clones share what was parsed.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula(Arc<Parsed>);

#[derive(Debug, PartialEq)]
struct Parsed {
    text: String,
    root: Node,
}
impl Formula {
    /// Reads a formula.
    ///
    /// # Errors
    ///
    /// A [`Complaint`] without a field that names the character, counted from 1, what was found there and what was
    /// expected. It also refuses more than 10 000 characters or 100 levels of brackets and powers.
    pub fn parse(text: &str) -> Result<Self, Complaint> {
        Self::parse_in_place(text).map_err(|(complaint, _)| complaint)
    }

    /// As [`Self::parse`], with the range of the wrong part of the text in bytes.
    pub(crate) fn parse_in_place(text: &str) -> Result<Self, (Complaint, Range<usize>)> {
        let root = formula_text::read(text)?;
        Ok(Self(Arc::new(Parsed { text: text.to_owned(), root })))
    }

    /// The formula as it was written.
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// The root of the parse tree.
    pub(crate) fn root(&self) -> &Node {
        &self.0.root
    }

    /// Value of the formula at `x`; NaN where it is undefined, such as `sqrt(-1)`.
    pub fn at(&self, x: f64) -> f64 {
        self.0.root.value(x, &mut |_| {})
    }

    /// Places inside `from < x < to` where the formula may have a corner, rising: where the argument of an `abs`
    /// changes sign, or two arguments of `min` or `max` change their order.
    ///
    /// They are sought between 1000 even samples, and each is found to the last bit.
    ///
    /// # Errors
    ///
    /// A [`Complaint`] without a field, if there are more than 1000.
    pub fn corners(&self, from: f64, to: f64) -> Result<Vec<f64>, Complaint> {
        let sample = |k: usize| from + (to - from) * k as f64 / SAMPLES as f64;
        // For each switch, the last place where it was not 0, and its sign there.
        let mut last: Vec<Option<(f64, f64)>> = vec![None; self.switches(from).len()];
        let mut corners = Vec::new();
        for k in 0..=SAMPLES {
            let x = if k == SAMPLES { to } else { sample(k) };
            for (i, v) in self.switches(x).into_iter().enumerate() {
                if let Some((before, side)) = last[i]
                    && v * side < 0.0
                {
                    corners.push(self.crossing(i, side, before, x));
                }
                if v != 0.0 {
                    last[i] = Some((x, v.signum()));
                }
            }
            if corners.len() > MOST_CORNERS {
                let found = format!("more than {MOST_CORNERS} corners of abs, min and max");
                return Err(Complaint::new("", found, "fewer, or more pieces"));
            }
        }
        corners.retain(|x| *x > from && *x < to);
        corners.sort_by(f64::total_cmp);
        Ok(corners)
    }

    /// The first number after `low` where switch `i` has changed its side, by bisection.
    fn crossing(&self, i: usize, side: f64, mut low: f64, mut high: f64) -> f64 {
        loop {
            let middle = low + 0.5 * (high - low);
            if middle <= low || middle >= high {
                return high;
            }
            if self.switches(middle)[i] * side > 0.0 { low = middle } else { high = middle }
        }
    }

    /// The numbers whose signs choose a branch at `x`, always in the same order.
    fn switches(&self, x: f64) -> Vec<f64> {
        let mut switches = Vec::new();
        self.0.root.value(x, &mut |switch| switches.push(switch));
        switches
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn value(text: &str, x: f64) -> f64 {
        Formula::parse(text).unwrap().at(x)
    }

    fn complaint(text: &str) -> String {
        Formula::parse(text).unwrap_err().to_string()
    }

    /// Formulas and their values at x = 0.7, printed by Python 3 (`math`'s functions) with `repr`.
    #[rustfmt::skip]
    const PYTHON: &[(&str, f64)] = &[
        ("-2**2", -4.0),
        ("2**-1", 0.5),
        ("2**3**2", 512.0),
        ("-x**2", -0.48999999999999994),
        ("2*-3", -6.0),
        ("+3", 3.0),
        ("--3", 3.0),
        ("-+-2", 2.0),
        ("2**-3**2", 0.001953125),
        ("2*3**2", 18.0),
        ("-2**-2", -0.25),
        ("2**-1*3", 1.5),
        ("1-2-3", -4.0),
        ("8/4/2", 1.0),
        ("2/3*4", 2.6666666666666665),
        ("1+2*3-4/5", 6.2),
        ("1e-3+.5+2.", 2.501),
        ("2E+2", 200.0),
        ("x*(x+1)", 1.19),
        ("(((x)))", 0.7),
        ("-(x-1)**2", -0.09000000000000002),
        ("3**0.5", 1.7320508075688772),
        ("2**x**2", 1.404444875737997),
        ("-x**2*3", -1.4699999999999998),
        ("1 - -x", 1.7),
        ("sin(x)+cos(x)*tan(x)", 1.288435374475382),
        ("exp(-x)*log(x+1)", 0.2635021912540122),
        ("sqrt(x)/tanh(x)", 1.3843557817144831),
        ("abs(x-1)", 0.30000000000000004),
        ("abs(1-x)", 0.30000000000000004),
        ("min(x,0.5)", 0.5),
        ("max(x,0.5,0.9)", 0.9),
        ("min(3,2,1,x)", 0.7),
        ("pi*x", 2.199114857512855),
        ("3*pi", 9.42477796076938),
        ("0.0127 + 0.0102*(1 + tanh((x - 0.50)/0.11))", 0.03257629963846353),
        ("log(exp(2))", 2.0),
        ("\t1\n+ 2 ", 3.0),
        ("max(min(x,1),-x)", 0.7),
        ("sin(pi/2)**2", 1.0),
        ("1e2*1e-2", 1.0),
        ("3-2+1", 2.0),
        ("2*x/0.5*x", 1.9599999999999997),
        ("100/10*10", 100.0),
        ("sqrt(1-(x-0.2)**2)", 0.8660254037844386),
        ("-abs(-x)", -0.7),
        ("0.5**-x**-2", 4.11478293390511),
        ("x--x", 1.4),
        ("x*-x**2", -0.3429999999999999),
    ];

    #[test]
    fn values_are_those_of_python() {
        for (text, expected) in PYTHON {
            let got = value(text, 0.7);
            assert!((got - expected).abs() <= 4e-16 * expected.abs(), "{text}: {got} {expected}");
        }
    }

    #[test]
    fn a_hat_is_a_power() {
        for (text, expected) in PYTHON.iter().filter(|(text, _)| text.contains("**")) {
            let hat = text.replace("**", "^");
            assert_eq!(value(&hat, 0.7), value(text, 0.7), "{hat}");
            assert!((value(&hat, 0.7) - expected).abs() <= 4e-16 * expected.abs(), "{hat}");
        }
    }

    #[test]
    fn a_mistake_is_told_with_its_place() {
        let rows = [
            ("", "an empty formula"),
            (" \t", "an empty formula"),
            ("1 +", "found the end at character 4 of \"1 +\", expected a number, x"),
            ("+", "the end at character 2"),
            ("1 + * 2", "\"*\" at character 5"),
            ("2x", "\"x\" at character 2 of \"2x\", expected an operator (+ - * / ^) or the end"),
            ("2 ** ", "the end at character 6"),
            ("2***3", "\"*\" at character 4"),
            ("8 // 2", "\"/\" at character 4"),
            (
                "(1 + x",
                "the end at character 7 of \"(1 + x\", expected an operator (+ - * / ^) or a closing",
            ),
            ("1 + x)", "\")\" at character 6"),
            ("()", "\")\" at character 2"),
            (
                "0.01 + tanhh(x)",
                "\"tanhh\" at character 8 of \"0.01 + tanhh(x)\", expected x, pi or a function: sin, cos",
            ),
            ("tanhh(x)", "; did you mean tanh?"),
            ("X", "; did you mean x?"),
            ("math.sqrt(x)", "\"math.sqrt\" at character 1"),
            ("math.sqrt(x)", "; did you mean sqrt?"),
            ("ln(x)", "; did you mean log?"),
            ("é + 1", "\"é\" at character 1"),
            ("sin x", "\"x\" at character 5 of \"sin x\", expected a bracket: sin(…)"),
            ("sin", "the end at character 4"),
            ("sin()", "\")\" at character 5"),
            ("sin(1, 2)", "found sin of 2 arguments at character 1 of \"sin(1, 2)\", expected one"),
            (
                "1 + min(x)",
                "found min of 1 argument at character 5 of \"1 + min(x)\", expected two or more",
            ),
            ("min(1, )", "\")\" at character 8"),
            (
                "min(1; 2)",
                "\";\" at character 6 of \"min(1; 2)\", expected an operator (+ - * / ^), a comma or",
            ),
            (
                "0,5",
                "\",\" at character 2 of \"0,5\", expected an operator (+ - * / ^) or the end; decimals follow a point: 0.5",
            ),
            (".", "\".\" at character 1 of \".\", expected a number such as"),
            ("1e999", "\"1e999\" at character 1 of \"1e999\", expected a number"),
            ("1e", "\"e\" at character 2"),
            ("0x10", "\"x10\" at character 2"),
            ("1..2", "\".2\" at character 3"),
            ("1 − x", "; a minus is written -"),
            ("x²", "at character 2"),
            ("x if x > 0 else 1", "\"if\" at character 3"),
            ("x > 0", "\">\" at character 3"),
            ("pi(2)", "\"(\" at character 3"),
            ("x\u{1b}[2J", "at character 2 of \"x\\u{1b}[2J\""),
        ];
        for (text, words) in rows {
            let said = complaint(text);
            assert!(said.contains(words), "{text}: {said}");
            assert!(!said.chars().any(char::is_control), "{said:?}");
        }
    }

    #[test]
    fn a_mistake_in_a_long_formula_is_shown_with_its_surroundings() {
        let said = complaint(&format!("{}1 + foo + {}1", "x + ".repeat(100), "x + ".repeat(100)));
        assert!(said.contains("\"foo\" at character 405 of \"…"), "{said}");
        assert!(said.len() < 400, "{said}");
    }

    #[test]
    fn neither_depth_nor_length_overflows_anything() {
        let deep = |open: &str, close: &str, n: usize| {
            Formula::parse(&format!("{}x{}", open.repeat(n), close.repeat(n)))
        };
        for (open, close) in [("(", ")"), ("sin(", ")"), ("-(", ")"), ("2**", ""), ("2^-", "")] {
            assert!(deep(open, close, 100).is_ok(), "{open}");
            let said = deep(open, close, 101).unwrap_err().to_string();
            assert!(said.contains("at most 100 levels of brackets and powers"), "{said}");
            assert!(deep(open, close, 1999).is_err(), "{open}");
        }
        assert_eq!(deep("-", "", 9999).unwrap().at(1.0), -1.0);
        assert_eq!(deep("1+", "", 4999).unwrap().at(1.0), 5000.0);
        assert_eq!(deep("1*", "", 4999).unwrap().at(3.0), 3.0);
        let said = deep("-", "", 10_000).unwrap_err().to_string();
        assert!(said.contains("a formula of 10001 characters, expected 10000 at most"), "{said}");
    }

    #[test]
    fn corners_are_where_abs_turns_and_min_and_max_change() {
        let corners = |text: &str| Formula::parse(text).unwrap().corners(0.0, 1.0).unwrap();
        let quarter = 0.25_f64.next_down()..=0.25_f64.next_up();
        assert_eq!(corners("abs(x - 0.4)"), [0.4]);
        assert_eq!(corners("abs(x - 0.4004)"), [0.4004]);
        assert_eq!(corners("abs(0.4 - x) + min(x, 0.7)"), [0.4, 0.7]);
        assert!(quarter.contains(&corners("max(x, 0.5 - x)")[0]));
        assert_eq!(corners("max(0.1, x - 0.5, 2*x - 1.25)").len(), 2);
        assert_eq!(corners("abs(sin(10*pi*x + 0.1))").len(), 10);
        for smooth in ["abs(x)", "abs(x - 1)", "max(x, x)", "abs(0*x)", "x*x", "abs((x - 0.4)^2)"] {
            assert!(corners(smooth).is_empty(), "{smooth}");
        }
        let many = Formula::parse(&vec!["abs(sin(1000*x))"; 40].join(" + ")).unwrap();
        assert!(many.corners(0.0, 1.0).unwrap_err().to_string().contains("more than 1000 corners"));
    }

    #[test]
    fn what_has_no_value_is_no_number() {
        for text in ["sqrt(-x)", "log(-x)", "(-x)**0.5", "0/(x - 1)", "min(1, sqrt(-x))"] {
            assert!(value(text, 1.0).is_nan(), "{text}");
        }
        assert!(value("max(sqrt(-x), 1)", 1.0).is_nan());
        assert!(value("1/(x - 1)", 1.0).is_infinite());
    }

    /// Random expressions with a bracket around every part, and what Rust makes of the parts.
    fn bracketed() -> impl Strategy<Value = (String, f64)> {
        let leaf = prop_oneof![
            (0.1..10.0_f64).prop_map(|v| (v.to_string(), v)),
            Just(("x".to_owned(), 0.7)),
        ];
        leaf.prop_recursive(6, 40, 2, |inner| {
            (0..8, inner.clone(), inner).prop_map(|(kind, (a, u), (b, v))| match kind {
                0 => (format!("({a} + {b})"), u + v),
                1 => (format!("({a}-{b})"), u - v),
                2 => (format!("({a} * {b})"), u * v),
                3 => (format!("({a}/{b})"), u / v),
                4 => (format!("({a})**({b})"), u.powf(v)),
                5 => (format!("(-{a})"), -u),
                6 => (format!("tanh({a})"), u.tanh()),
                _ => (format!("min({a}, {b})"), if v < u { v } else { u }),
            })
        })
    }

    proptest! {
        #[test]
        fn bracketed_expressions_are_their_parts((text, expected) in bracketed()) {
            let got = value(&text, 0.7);
            let same = got == expected || got.is_nan() || expected.is_nan();
            prop_assert!(same, "{text}: {got} {expected}");
        }

        #[test]
        fn any_text_is_a_formula_or_told_why_not(text in "[x0-9.e+*/^(),a-z−²\\- ]{0,30}") {
            match Formula::parse(&text) {
                Ok(formula) => prop_assert_eq!(formula.text(), text),
                Err(complaint) => prop_assert!(!complaint.expected.is_empty(), "{complaint}"),
            }
        }
    }
}
