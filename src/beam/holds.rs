//! How the contacts hold a bat, one contact after another on the pass inwards.
//!
//! Of all strains that the contacts allow, the nearest ones to the given strains are wanted. By Castigliano's theorem
//! they are the held bat's, if the given ones are in equilibrium with its loads. The contacts need not be treated all
//! at once. The part beyond a border acts like two springs, a [`Footing`], and this form is kept along the pass to the
//! root: an element adds compliance, a contact adds stiffness. Both are sums of squares, so that no digits are lost,
//! however stiff or soft a contact is. At the root both sides meet. A pass outwards then hands their forces on and
//! gives every strain and every reaction. The cost is proportional to the number of elements and contacts.
//!
//! # Source
//!
//! Worked out here: a Riccati recursion along the bat. A. E. Bryson, Y.-C. Ho, Applied Optimal Control (1975), chapter
//! 5, has the sweep method for problems in time.

use crate::base::{Over, Real};
use crate::beam::bed::Bed;
use crate::beam::footing::{Crossing, Footing, Meeting, Rest, product};

pub use crate::beam::bed::Under;
pub use crate::beam::footing::{Given, Span};

/// Stiffness of a support, so large that its deflection changes no digit: 2²⁶⁶, a power of two so that scaling a bat by
/// powers of two changes no digit.
const RIGID: f64 = f64::from_bits((1023 + 266) << 52);

/// How the contacts hold the bat.
#[derive(Debug, Clone)]
pub struct Holds<S> {
    /// The steps of the knob side and of the tip side, inwards from the outermost contact.
    sides: [Vec<HoldStep<S>>; 2],
    root: Meeting<S>,
    /// Stiffnesses that hold the deflection and the rotation of the root; 0 where they are free.
    pub held: [f64; 2],
    /// Distance from the root to the spring on the deflection, towards the tip (m).
    pub center: f64,
}

/// One step of the pass.
#[derive(Debug, Clone)]
enum HoldStep<S> {
    /// An element or a joint.
    Cell(Crossing<S>),
    /// An element on an elastic bed.
    Bed(Box<Bed<S>>),
    /// A contact at a border.
    Contact(Border<S>, Meeting<S>),
}

/// A contact at a border.
#[derive(Debug, Clone, Copy)]
pub struct Border<S> {
    /// Number of the contact.
    pub contact: usize,
    /// Whether it holds the rotation; otherwise it holds the deflection.
    pub turning: bool,
    /// 1, or −1 if its rotation counts inwards.
    pub sign: S,
    /// Index of the strain of the contact's spring, and the softness of that spring.
    pub spring: Option<(usize, S)>,
}

/// One side while it is built, inwards from its free end.
#[derive(Default)]
pub struct Build<S> {
    steps: Vec<HoldStep<S>>,
    footing: Footing,
}

impl<S: Real> Build<S> {
    /// Adds an element or, with length 0, a joint.
    pub fn cross(&mut self, span: Span<S>) {
        if self.steps.is_empty() {
            return;
        }
        let compliance = product(&span.adds, &span.adds);
        let (length, (crossing, seen)) = (span.length, self.footing.through(span, compliance));
        self.footing = seen;
        self.footing.at.add(length);
        self.steps.push(HoldStep::Cell(crossing));
    }

    /// Adds a contact at the border.
    pub fn meet(&mut self, border: Border<S>) {
        let soft = border.spring.map_or(0.0, |(_, softness)| softness.lane(0));
        let stiffness = (1.0 / (soft * soft)).min(RIGID);
        let own = if border.turning { [0.0, 0.0, stiffness] } else { [stiffness, 0.0, 0.0] };
        let (meeting, footing) = self.footing.meet([[1.0, 0.0], [0.0, 1.0]], own);
        self.footing = footing;
        self.steps.push(HoldStep::Contact(border, meeting));
    }

    /// Adds an element on an elastic bed.
    pub fn cross_bed(&mut self, span: Span<S>, under: Under<S>) {
        let (bed, footing) = Bed::new(span, under, self.footing);
        self.footing = footing;
        self.steps.push(HoldStep::Bed(Box::new(bed)));
    }
}

impl<S: Real> Holds<S> {
    /// The root held by both sides together; the knob side is the first.
    pub fn of([knob, tip]: [Build<S>; 2]) -> Self {
        let [mirrored, here] = [knob.footing, tip.footing];
        let other = [mirrored.spring, -mirrored.at.value(), mirrored.turning];
        let (root, both) = here.meet([[1.0, 0.0], [0.0, 1.0]], other);
        Self {
            sides: [knob.steps, tip.steps],
            root,
            held: [both.spring, both.turning],
            center: both.at.value(),
        }
    }

    /// Deflection and rotation of the root that the given values require.
    pub fn root<R: Over<S>>(&self, given: Given<R>) -> [R; 2] {
        let (rest, _) = self.inwards(given, &mut Default::default());
        let turn = rest.rotation.value();
        [rest.deflection.value() - turn * self.root.at, turn]
    }

    /// Changes the strains into the nearest ones that the contacts allow, with a force and a moment at the root; leaves
    /// the contacts' reactions.
    pub fn fit<R: Over<S>>(&self, strains: &mut [R], [force, moment]: [R; 2], reactions: &mut [R]) {
        let mut traces = <[Vec<R>; 2]>::default();
        let (_, own) = self.inwards(Given::Strains(strains), &mut traces);
        let [a, b, c, d] = self.root.forces([force, moment - force * self.root.at], &own);
        for (side, mut forces) in [[c, -d], [a, b]].into_iter().enumerate() {
            for step in self.sides[side].iter().rev() {
                forces = step.outwards(forces, &mut traces[side], strains, reactions);
            }
        }
    }

    /// Both sides inwards to the root; leaves in `traces` what the way back needs.
    fn inwards<R: Over<S>>(&self, given: Given<R>, traces: &mut [Vec<R>; 2]) -> (Rest<R>, [R; 4]) {
        let [knob, tip]: [Rest<R>; 2] = std::array::from_fn(|side| {
            let mut rest = Rest::default();
            for step in &self.sides[side] {
                rest = step.inwards(rest, given, &mut traces[side]);
            }
            rest
        });
        self.root.rest([
            tip.deflection.value(),
            tip.rotation.value(),
            knob.deflection.value(),
            -knob.rotation.value(),
        ])
    }
}

impl<S: Real> HoldStep<S> {
    /// The rest positions at the inner side, from those at the outer side. Leaves in `trace` what [`Self::outwards`]
    /// needs.
    fn inwards<R: Over<S>>(&self, rest: Rest<R>, given: Given<R>, trace: &mut Vec<R>) -> Rest<R> {
        match self {
            Self::Cell(crossing) => crossing.inwards(rest, crossing.moved(given)),
            Self::Bed(bed) => bed.inwards(rest, given, trace),
            Self::Contact(border, meeting) => {
                let zero = R::default();
                let off = match (given, border.spring) {
                    (Given::Displacements(off), _) => -off[border.contact],
                    (Given::Strains(q), Some((place, softness))) => q[place] * softness,
                    (Given::Strains(_), None) => zero,
                };
                let off = off * border.sign;
                let own = if border.turning { [zero, off] } else { [off, zero] };
                let before = [rest.deflection.value(), rest.rotation.value()];
                let (rest, forces) = meeting.rest([before[0], before[1], own[0], own[1]]);
                trace.extend(forces);
                rest
            }
        }
    }

    /// Subtracts from the strains the effect of the forces at the inner side; returns the forces at the outer side.
    fn outwards<R: Over<S>>(
        &self,
        forces: [R; 2],
        trace: &mut Vec<R>,
        strains: &mut [R],
        reactions: &mut [R],
    ) -> [R; 2] {
        match self {
            Self::Cell(crossing) => crossing.outwards(forces, strains),
            Self::Bed(bed) => bed.outwards(forces, trace, strains, reactions),
            Self::Contact(border, meeting) => {
                let own = trace.split_off(trace.len() - 4);
                let [push, turn, c, d] = meeting.forces(forces, &own);
                let reaction = if border.turning { d * border.sign } else { c };
                reactions[border.contact] = reaction;
                if let Some((place, softness)) = border.spring {
                    strains[place] += reaction * softness;
                }
                [push, turn]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sequence of numbers without a pattern.
    struct Draw(f64);

    impl Draw {
        fn next(&mut self, from: f64, to: f64) -> f64 {
            self.0 = (self.0 + 0.618_033_988_749_894_9).fract();
            from + (to - from) * (997.0 * self.0).fract()
        }
    }

    /// A displacement as a linear form in the strains and the root's motion.
    type Row = (Vec<f64>, [f64; 2]);
    /// The steps on the way outwards, to be built inwards.
    type Met = Box<dyn FnOnce(&mut Build<f64>)>;

    fn plus((a, u): &Row, times: f64, (b, v): &Row) -> Row {
        let strains = a.iter().zip(b).map(|(a, b)| a + times * b).collect();
        (strains, [u[0] + times * v[0], u[1] + times * v[1]])
    }

    const STRAINS: usize = 3;
    const TERMS: usize = 4;
    const MOST: usize = 200;

    /// Two sides of random elements, contacts and beds. Returns every contact's row and its spring's strain, and the
    /// number of strains.
    fn bat(draw: &mut Draw) -> (Holds<f64>, Vec<Row>, usize) {
        let (cells, mut rows, mut dimension) = ([3, 4], vec![], 7 * STRAINS);
        let zero = || vec![0.0; MOST];
        let mut first = 0;
        let sides = [0, 1].map(|side| {
            let outwards = if side == 0 { -1.0 } else { 1.0 };
            let mut at = [(zero(), [1.0, 0.0]), (zero(), [0.0, outwards])];
            let mut met: Vec<Met> = vec![];
            for cell in 0..cells[side] {
                let length = draw.next(0.01, 1.0);
                let scale = length.sqrt();
                let mut number = || draw.next(-1.0, 1.0);
                let adds: Vec<[f64; 2]> =
                    (0..STRAINS).map(|_| [number() * length * scale, number() * scale]).collect();
                let mut outer = [plus(&at[0], length, &at[1]), at[1].clone()];
                for (k, adds) in adds.iter().enumerate() {
                    (0..2).for_each(|e| outer[e].0[first + k] += adds[e]);
                }
                let span = Span { first, adds, length };
                if cell == 1 {
                    let (contact, place) = (rows.len(), dimension);
                    dimension += TERMS;
                    let (mut softness, mut all) = (vec![], vec![]);
                    for term in 0..TERMS {
                        let inner = [[1.0, 0.5 * length], [0.0, 0.5 * length]];
                        let inner = inner.get(term).copied().unwrap_or_default();
                        let mut row = plus(&(zero(), [0.0; 2]), inner[0], &at[0]);
                        row = plus(&row, inner[1], &at[1]);
                        for k in 0..STRAINS {
                            all.push(draw.next(-1.0, 1.0) * length * scale);
                            row.0[first + k] += all[all.len() - 1];
                        }
                        all.extend(inner);
                        softness.push(10f64.powf(draw.next(-1.0, 3.0)));
                        row.0[place + term] -= softness[term];
                        rows.push(row);
                    }
                    let under = Under { contact, place, softness, rows: all };
                    met.push(Box::new(move |build| build.cross_bed(span, under)));
                } else {
                    met.push(Box::new(move |build| build.cross(span)));
                }
                first += STRAINS;
                at = outer;
                if draw.next(0.0, 1.0) < 0.6 {
                    let (contact, turning) = (rows.len(), draw.next(0.0, 1.0) < 0.4);
                    let sign = if turning { outwards } else { 1.0 };
                    let mut row = plus(&(zero(), [0.0; 2]), sign, &at[usize::from(turning)]);
                    let soft = 10f64.powf(draw.next(-7.0, 7.0));
                    let spring = (draw.next(0.0, 1.0) < 0.7).then_some((dimension, soft));
                    if let Some((place, softness)) = spring {
                        row.0[place] -= softness;
                        dimension += 1;
                    }
                    rows.push(row);
                    let border = Border { contact, turning, sign, spring };
                    met.push(Box::new(move |build| build.meet(border)));
                }
            }
            let mut build = Build::default();
            met.into_iter().rev().for_each(|meet| meet(&mut build));
            build
        });
        (Holds::of(sides), rows, dimension)
    }

    /// The strains nearest to given ones under all conditions at once, by elimination with pivots.
    fn all_at_once(rows: &[Row], given: &[f64], root: [f64; 2]) -> Vec<f64> {
        let (n, size) = (given.len(), given.len() + 2 + rows.len());
        let mut system = vec![vec![0.0; size + 1]; size];
        for (k, value) in given.iter().chain(&root).enumerate() {
            system[k][size] = *value;
            system[k][k] = if k < n { 1.0 } else { 0.0 };
        }
        for (i, (strains, motion)) in rows.iter().enumerate() {
            for (k, value) in strains[..n].iter().chain(motion).enumerate() {
                (system[k][n + 2 + i], system[n + 2 + i][k]) = (*value, *value);
            }
        }
        for k in 0..size {
            let largest = |i: &usize| system[*i][k].abs();
            let pivot = (k..size).max_by(|i, j| largest(i).total_cmp(&largest(j))).unwrap();
            system.swap(k, pivot);
            for i in (0..size).filter(|i| *i != k) {
                let part = system[i][k] / system[k][k];
                for j in k..=size {
                    system[i][j] -= part * system[k][j];
                }
            }
        }
        (0..n).map(|k| system[k][size] / system[k][k]).collect()
    }

    #[test]
    fn contacts_met_one_by_one_hold_as_all_at_once() {
        for seed in 0..40 {
            let mut draw = Draw(f64::from(seed) * 0.137);
            let (holds, rows, dimension) = bat(&mut draw);
            assert!(holds.held.iter().all(|stiffness| *stiffness > 0.0));
            let given: Vec<f64> = (0..dimension).map(|_| draw.next(-1.0, 1.0)).collect();
            let root = [draw.next(-1.0, 1.0), draw.next(-1.0, 1.0)];
            let (mut found, mut reactions) = (given.clone(), vec![0.0; rows.len()]);
            holds.fit(&mut found, root, &mut reactions);
            let exact = all_at_once(&rows, &given, root);
            let size = exact.iter().fold(1.0, |most: f64, q| most.max(q.abs()));
            for (a, b) in found.iter().zip(&exact) {
                // The elimination of all at once loses digits; the pass inwards does not.
                assert!((a - b).abs() < 1e-7 * size, "{seed} {a} {b}");
            }
            // A second fit leaves allowed strains unchanged.
            let before = found.clone();
            holds.fit(&mut found, [0.0; 2], &mut reactions);
            for (a, b) in found.iter().zip(&before) {
                assert!((a - b).abs() < 1e-13 * size, "{seed} {a} {b}");
            }
            // The contacts allow the result, with the root moved as returned.
            let moved = holds.root(Given::Strains(&found));
            for (strains, by_root) in &rows {
                let parts = strains.iter().zip(&found).map(|(a, q)| a * q);
                let all: Vec<f64> =
                    parts.chain([by_root[0] * moved[0], by_root[1] * moved[1]]).collect();
                let size: f64 = all.iter().map(|part| part.abs()).sum();
                assert!(all.iter().sum::<f64>().abs() < 1e-11 * size.max(1e-3), "{seed}");
            }
        }
    }

    #[test]
    fn a_lone_pin_leaves_the_turning_about_it_free() {
        let mut tip = Build::<f64>::default();
        tip.meet(Border { contact: 0, turning: false, sign: 1.0, spring: None });
        tip.cross(Span { first: 0, adds: vec![[0.1, 0.7]], length: 0.3 });
        let holds = Holds::of([Build::default(), tip]);
        assert!(holds.held[0] > 0.0 && holds.held[1] == 0.0);
        assert_eq!(holds.center, 0.3);
        let mut strains = [0.4];
        holds.fit(&mut strains, [0.0; 2], &mut [0.0]);
        assert_eq!(strains, [0.4]);
    }
}
