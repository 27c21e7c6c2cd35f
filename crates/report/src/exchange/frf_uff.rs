//! A frequency response as a universal file.

use crate::exchange::modes_uff::beginning;
use sweetspot::motion::frf::{ResponseKind, Sample};
use sweetspot_study::identify::set::{ResponseSet, SetResponse};
use uff58::{
    Abscissa, Axis, Complex, Dataset, Dof, Function, Node, Nodes, Stamp, Values, six_digits,
};

/// The places and the kind of a response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured<'a> {
    /// Name of the bat.
    pub bat: &'a str,
    /// Whether the answer is a displacement, a velocity or an acceleration.
    pub kind: ResponseKind,
    /// Position of the force (m from the knob end).
    pub at: f64,
    /// Position of the response (m from the knob end).
    pub to: f64,
    /// Start and step of the frequencies (Hz) if they are evenly spaced.
    pub even: Option<[f64; 2]>,
}

/// The datasets of a frequency response: 151, 164 (SI), 2411 with the places of force (node 1) and
/// answer (node 2, or 1 if it is the same place), and 58: answer in +y over force in +y, complex,
/// in double precision, with time as `e^{+iωt}`.
///
/// Frequencies have six digits in the file. Compute the response at such frequencies ([`uff58::six_digits`]), because
/// near a resonance the seventh digit matters.
pub fn response(measured: &Measured, samples: &[Sample], stamp: &Stamp) -> Vec<Dataset> {
    let same = measured.at == measured.to;
    let mut nodes = vec![Node::new(1, [measured.at, 0.0, 0.0])];
    if !same {
        nodes.push(Node::new(2, [measured.to, 0.0, 0.0]));
    }
    let function = function(measured, samples, if same { 1 } else { 2 });
    let about = [measured.bat, "frequency response of a bat"];
    let mut all = beginning(about, Nodes { nodes, legacy: false }, stamp);
    all.push(Dataset::Function(Box::new(function)));
    all
}

/// The datasets of a set of responses: 151, 164 (SI), 2411, and 58 for each and for its coherence, type 6.
pub fn responses(bat: &str, set: &ResponseSet, stamp: &Stamp) -> Vec<Dataset> {
    let mut nodes: Vec<Node> = vec![];
    let places = set.points.iter().chain(&set.references);
    for place in places {
        if nodes.iter().all(|node| node.label != place.node) {
            nodes.push(Node::new(place.node, [place.x, 0.0, 0.0]));
        }
    }
    let about = [bat, "responses of a virtual test"];
    let mut all = beginning(about, Nodes { nodes, legacy: false }, stamp);
    for (number, SetResponse { measured, .. }) in (1..).zip(&set.responses) {
        let [at, to] = [measured.at, measured.to].map(Option::unwrap_or_default);
        let even = Some([measured.values[0].0, measured.values[1].0 - measured.values[0].0]);
        let subject = Measured { bat, kind: measured.kind, at, to, even };
        let own = function(&subject, &[], measured.nodes[1]);
        let reference = Dof { node: measured.nodes[0], ..own.reference.clone() };
        let values = measured.values.iter().map(|(_, v)| [v.re, v.im]).collect();
        let own = Function { number, reference, values: Values::Complex(values), ..own };
        let coherence = measured.coherence.clone().map(|values| {
            let axes = [own.axes[0].clone(), Axis::default(), Axis::default(), Axis::default()];
            Function { kind: 6, values: Values::Real(values), axes, ..own.clone() }
        });
        all.extend(
            [Some(own), coherence].into_iter().flatten().map(|f| Dataset::Function(Box::new(f))),
        );
    }
    all
}

fn function(measured: &Measured, samples: &[Sample], node: i64) -> Function {
    let value = |sample: &Sample| -> Complex {
        let value = sample.receptance * measured.kind.of(sample.frequency);
        [value.re, value.im]
    };
    let dof = |node| Dof { entity: String::new(), node, direction: 2 };
    let name = measured.kind.name();
    Function {
        ids: [
            measured.bat.into(),
            format!("{name} from a force at {} m", six_digits(measured.at)),
            String::new(),
            format!("watched at {} m from the knob end", six_digits(measured.to)),
            String::new(),
        ],
        kind: 4,
        number: 1,
        version: 1,
        load_case: 0,
        response: dof(node),
        reference: dof(1),
        abscissa: match measured.even {
            Some([start, step]) => Abscissa::Even { start, step },
            None => Abscissa::Uneven(samples.iter().map(|sample| sample.frequency).collect()),
        },
        values: Values::Complex(samples.iter().map(value).collect()),
        double: true,
        z: 0.0,
        axes: axes(measured.kind),
    }
}

/// Frequency, answer, force, and no third axis.
fn axes(kind: ResponseKind) -> [Axis; 4] {
    let axis = |quantity, label: &str, unit: &str| Axis {
        quantity,
        exponents: [0; 3],
        label: label.into(),
        unit: unit.into(),
    };
    let (quantity, unit) = match kind {
        ResponseKind::Receptance => (8, "m"),
        ResponseKind::Mobility => (11, "m/s"),
        ResponseKind::Accelerance => (12, "m/s^2"),
    };
    let answer = axis(quantity, kind.name(), unit);
    [axis(18, "frequency", "Hz"), answer, axis(13, "force", "N"), Axis::default()]
}
