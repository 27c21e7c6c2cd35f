//! What are the parts of a formula, and what is the value of each at `x`?

/// A part of a formula with a value. Sums and products are lists, so that a long one does not nest deeply.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Node {
    Number(f64),
    X,
    /// Terms, and whether each is subtracted.
    Sum(Vec<(bool, Node)>),
    /// Factors, and whether each divides.
    Product(Vec<(bool, Node)>),
    Negative(Box<Node>),
    Power(Box<[Node; 2]>),
    Call(Function, Vec<Node>),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Function {
    Sin,
    Cos,
    Tan,
    Exp,
    Log,
    Sqrt,
    Tanh,
    Abs,
    Min,
    Max,
}

/// The names of the functions in a formula.
pub(crate) const FUNCTIONS: [(&str, Function); 10] = [
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("exp", Function::Exp),
    ("log", Function::Log),
    ("sqrt", Function::Sqrt),
    ("tanh", Function::Tanh),
    ("abs", Function::Abs),
    ("min", Function::Min),
    ("max", Function::Max),
];

impl Node {
    /// Number of functions in it that choose a branch.
    pub(crate) fn branches(&self) -> usize {
        let all = |nodes: &[Self]| nodes.iter().map(Self::branches).sum::<usize>();
        match self {
            Self::Number(_) | Self::X => 0,
            Self::Sum(parts) | Self::Product(parts) => {
                parts.iter().map(|(_, node)| node.branches()).sum()
            }
            Self::Negative(node) => node.branches(),
            Self::Power(nodes) => all(&nodes[..]),
            Self::Call(Function::Abs | Function::Min | Function::Max, arguments) => {
                1 + all(arguments)
            }
            Self::Call(_, arguments) => all(arguments),
        }
    }

    /// The value at `x`; `switch` is called with every number whose sign chooses a branch.
    pub(crate) fn value(&self, x: f64, switch: &mut impl FnMut(f64)) -> f64 {
        match self {
            Self::Number(value) => *value,
            Self::X => x,
            Self::Sum(terms) => terms.iter().fold(0.0, |sum, (minus, term)| {
                let term = term.value(x, switch);
                if *minus { sum - term } else { sum + term }
            }),
            Self::Product(factors) => factors.iter().fold(1.0, |product, (divides, factor)| {
                let factor = factor.value(x, switch);
                if *divides { product / factor } else { product * factor }
            }),
            Self::Negative(node) => -node.value(x, switch),
            Self::Power(nodes) => nodes[0].value(x, switch).powf(nodes[1].value(x, switch)),
            Self::Call(function, arguments) => function.value(arguments, x, switch),
        }
    }
}

impl Function {
    fn value(self, arguments: &[Node], x: f64, switch: &mut impl FnMut(f64)) -> f64 {
        let first = arguments[0].value(x, switch);
        match self {
            Self::Sin => first.sin(),
            Self::Cos => first.cos(),
            Self::Tan => first.tan(),
            Self::Exp => first.exp(),
            Self::Log => first.ln(),
            Self::Sqrt => first.sqrt(),
            Self::Tanh => first.tanh(),
            Self::Abs => {
                switch(first);
                first.abs()
            }
            Self::Min | Self::Max => arguments[1..].iter().fold(first, |chosen, argument| {
                let other = argument.value(x, switch);
                let difference = other - chosen;
                switch(difference);
                // NaN wins over any number, so that it is not hidden.
                let takes = if self == Self::Min { difference < 0.0 } else { difference > 0.0 };
                if takes || other.is_nan() { other } else { chosen }
            }),
        }
    }

    pub(crate) fn takes(self, count: usize) -> bool {
        if matches!(self, Self::Min | Self::Max) { count >= 2 } else { count == 1 }
    }
}
