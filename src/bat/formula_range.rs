//! Which values does a formula take on an interval, and on a box of the complex plane around it?
//!
//! [`Formula::on`] follows the parse tree with [`Jet`]s instead of numbers. Where an `abs`, a `min`
//! or a `max` takes one side all along the interval, that side continues beyond it.

use crate::base::interval::{Interval, Jet, Rectangle};
use crate::bat::formula::Formula;
use crate::bat::formula_tree::{Function, Node};

/// Whether a number that chooses a branch is positive; `None` where that is not known.
type Side<'a> = &'a mut dyn FnMut(Jet) -> Option<bool>;

/// A formula and its square on an interval.
pub(crate) struct On {
    /// The formula and its square at the middle, with the width of an evaluation's round-off.
    pub middle: [Jet; 2],
    /// The formula and its square on the interval.
    pub on: [Jet; 2],
    /// The chosen sides of its branches, in the order of the tree.
    sides: Vec<bool>,
}

impl Formula {
    /// The formula and its square between `from` and `to`; `None` if a branch changes its side or there is no value.
    pub(crate) fn on(&self, from: f64, to: f64) -> Option<On> {
        let middle = 0.5 * (from + to);
        let at = Jet::variable(Rectangle::point(middle));
        let mut switches = Vec::new();
        let middle = both(self.root(), at, &mut |switch| {
            switches.push(switch);
            Some(switch.value.re.low + switch.value.re.high >= 0.0)
        })?;
        let along = Interval { low: from.min(to), high: from.max(to) };
        let (half, farthest) = (0.5 * (along.high - along.low), along.largest());
        let mut sides = Vec::with_capacity(switches.len());
        let on = both(self.root(), Jet::variable(Rectangle::real(along)), &mut |switch| {
            let range = switch.range(switches[sides.len()], half);
            let side = side(range, farthest * switch.slope.re.largest())?;
            sides.push(side);
            Some(side)
        })?;
        Some(On { middle, on, sides })
    }

    /// The square on a box, each branch on the side that it takes on the interval; `None` if it is not analytic.
    pub(crate) fn square_around(&self, on: &On, around: Rectangle) -> Option<Rectangle> {
        let mut sides = on.sides.iter().copied();
        Some(square(self.root(), Jet::variable(around), &mut |_| sides.next())?.value)
    }
}

/// The side of 0 that a range is on; `scale` times the spacing of numbers is its round-off.
fn side(range: Interval, scale: f64) -> Option<bool> {
    let most = 1e-9 * range.largest();
    let slack = (32.0 * f64::EPSILON * (scale + range.largest())).min(most);
    if range.low >= -slack {
        Some(true)
    } else if range.high <= slack {
        Some(false)
    } else {
        None
    }
}

/// The value and the square of a node; each branch is decided once.
fn both(node: &Node, x: Jet, tell: Side) -> Option<[Jet; 2]> {
    let mut told = Vec::new();
    let value = jet(node, x, &mut |switch| {
        told.push(tell(switch)?);
        told.last().copied()
    })?;
    let mut told = told.into_iter();
    Some([value, square(node, x, &mut |_| told.next())?])
}

/// The values and slopes of a node.
fn jet(node: &Node, x: Jet, tell: Side) -> Option<Jet> {
    match node {
        Node::Number(value) => Some(Jet::constant(*value)),
        Node::X => Some(x),
        Node::Sum(terms) => terms.iter().try_fold(Jet::constant(0.0), |sum, (minus, term)| {
            let term = jet(term, x, tell)?;
            Some(if *minus { sum - term } else { sum + term })
        }),
        Node::Product(factors) => product(factors, &mut |factor| jet(factor, x, tell)),
        Node::Negative(node) => Some(-jet(node, x, tell)?),
        Node::Power(nodes) => jet(&nodes[0], x, tell)?.power(jet(&nodes[1], x, tell)?),
        Node::Call(function, arguments) => called(*function, arguments, x, tell),
    }
}

/// The square of a node. The square of a root is its argument, which is analytic where the root ends.
fn square(node: &Node, x: Jet, tell: Side) -> Option<Jet> {
    match node {
        Node::Product(factors) => product(factors, &mut |factor| square(factor, x, tell)),
        Node::Negative(node) => square(node, x, tell),
        Node::Power(nodes) => match nodes[1] {
            Node::Number(exponent) => jet(&nodes[0], x, tell)?.power(Jet::constant(2.0 * exponent)),
            _ => Some(jet(node, x, tell)?.square()),
        },
        Node::Call(Function::Sqrt, arguments) => jet(&arguments[0], x, tell),
        _ => Some(jet(node, x, tell)?.square()),
    }
}

fn product(factors: &[(bool, Node)], of: &mut dyn FnMut(&Node) -> Option<Jet>) -> Option<Jet> {
    factors.iter().try_fold(Jet::constant(1.0), |product, (divides, factor)| {
        let factor = of(factor)?;
        Some(product * if *divides { factor.reciprocal()? } else { factor })
    })
}

fn called(function: Function, arguments: &[Node], x: Jet, tell: Side) -> Option<Jet> {
    let first = jet(&arguments[0], x, tell)?;
    match function {
        Function::Sin => Some(first.sin()),
        Function::Cos => Some(first.cos()),
        Function::Tan => first.tan(),
        Function::Exp => Some(first.exp()),
        Function::Log => first.ln(),
        Function::Sqrt => first.sqrt(),
        Function::Tanh => first.tanh(),
        Function::Abs => Some(if tell(first)? { first } else { -first }),
        Function::Min | Function::Max => arguments[1..].iter().try_fold(first, |chosen, other| {
            let other = jet(other, x, tell)?;
            let above = tell(other - chosen)?;
            Some(if above == (function == Function::Max) { other } else { chosen })
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values and slopes at random places lie in the ranges, whatever the interval's length.
    #[test]
    fn ranges_hold_the_values_and_the_slopes_of_formulas() {
        let texts = [
            "0.02-0.015*exp(-((x-0.4)/0.001)^2)",
            "0.0127 + 0.0102*(1 + tanh((x - 0.50)/0.00001))",
            "max(0.02, 0.03 - abs(x - 0.4)*50)",
            "0.03*sqrt(1 - (x/1.2)^2) + 0.001*sin(300*x)^3",
            "(x + 0.1)^-1.5 + 2**-x - x**3/tan(0.3 + x)",
            "min(x, 0.5 - x, 0.2) + log(1 + x) * cos(7*x)",
        ];
        let mut held = 0;
        for (k, formula) in texts.map(|text| Formula::parse(text).unwrap()).iter().enumerate() {
            for j in 0..3000 {
                let share = |n: usize| (0.618_033_988_7 * (n * (k + 3) + j) as f64).fract();
                let (from, length) = (share(1), 10f64.powf(-9.0 * share(17)));
                let to = (from + length).min(1.0);
                let Some(on) = formula.on(from, to) else { continue };
                let x = from + (to - from) * share(41);
                let half = 0.5 * (to - from);
                let ranges = [0, 1].map(|i| on.on[i].range(on.middle[i], half));
                let value = formula.at(x);
                assert!(ranges[0].contains(value), "{} {from} {to} {x}", formula.text());
                assert!(ranges[1].contains(value * value), "{} {from} {to} {x}", formula.text());
                let chord = (formula.at(to) - formula.at(from)) / (to - from);
                let round = 1e-15 / (to - from);
                let slope = on.on[0].slope.re;
                assert!(slope.low - round <= chord && chord <= slope.high + round);
                held += 1;
            }
        }
        assert!(held > 10_000, "{held}");
    }

    #[test]
    fn a_branch_that_changes_its_side_has_no_range_and_one_at_its_corner_has() {
        let formula = Formula::parse("0.02 + abs(x - 0.4)").unwrap();
        assert!(formula.on(0.39, 0.41).is_none());
        assert!(formula.on(0.4, 0.41).is_some() && formula.on(0.3, 0.4).is_some());
        let same = Formula::parse("max(x, x) + abs(0*x)").unwrap();
        assert!(same.on(0.0, 1.0).is_some());
    }
}
