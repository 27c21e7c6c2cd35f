//! What holds a bat, met contact by contact along the way inwards.
//!
//! Of all strains that the contacts allow, those nearest to given ones are wanted: by Castigliano's
//! theorem they are the held bat's if the given ones are in equilibrium with its loads. Nobody needs
//! all contacts at once for that. Whatever lies beyond a border holds it like one spring `k` on the
//! deflection at a distance `l` outwards and one `r` on the rotation,
//!
//! ```text
//! ½ k (w + l θ − a)² + ½ r (θ − b)²,
//! ```
//!
//! and stays that under everything that is met on the way to the root: an element adds compliance, a
//! contact adds stiffness, and both are sums of squares, so that no digits go, however stiff or soft
//! a contact is. At the root both sides meet; outwards their forces are handed on, and with them
//! every strain and every reaction is known. It costs as much as there are elements and contacts.
//!
//! An elastic bed under an element holds the Legendre coefficients of its deflection `c = H q + G u`
//! by springs of softness σ (`Σ = σ²`); its forces are `t = (Σ + H Hᵀ)⁻¹ (H q + G u − H Bᵀ λ)` with `λ`
//! what the element's outer end carries, and they are eliminated where they are.
//!
//! # Source
//!
//! Worked out here: a Riccati recursion along the bat, as the sweep method of A. E. Bryson, Y.-C. Ho,
//! Applied Optimal Control (1975), chapter 5, has it for problems along time.

use crate::base::quadrature::RunningSum;
use crate::base::real::{Over, Real};

/// A support is a spring that gives way by nothing that a number shows: 2²⁶⁶, a power of two so that
/// scaling a bat by powers of two changes no digit.
const RIGID: f64 = f64::from_bits((1023 + 266) << 52);

/// How the contacts hold the bat.
#[derive(Debug, Clone)]
pub struct Holds<S> {
    /// What is met on the knob side and on the tip side, inwards from the outermost contact.
    sides: [Vec<Step<S>>; 2],
    root: Meeting<S>,
    /// How stiffly the deflection and the rotation of the root are held; 0 where they are free.
    pub held: [f64; 2],
    /// Where the spring on the deflection acts, from the root towards the tip (m).
    pub center: f64,
}

/// What is met on the way.
#[derive(Debug, Clone)]
pub enum Step<S> {
    /// An element or a joint.
    Cell(Crossing<S>),
    /// An element on an elastic bed.
    Bed(Crossing<S>, Box<Bed<S>>),
    /// A contact at a border.
    Contact(Border<S>, Meeting<S>),
}

/// Strains that lie between two borders.
#[derive(Debug, Clone)]
pub struct Crossing<S> {
    /// The place of the first of them.
    first: usize,
    /// What each adds to deflection and rotation at the outer end.
    adds: Vec<[S; 2]>,
    /// How far beyond the outer end the spring acts, seen through their compliance (m).
    at: S,
    /// How much farther [`Self::at`] is than without that compliance (m).
    shift: S,
}

/// A contact at a border.
#[derive(Debug, Clone, Copy)]
pub struct Border<S> {
    /// Number of the contact.
    pub contact: usize,
    /// Whether it holds the rotation, else the deflection.
    pub turning: bool,
    /// 1, or −1 where its rotation counts inwards.
    pub sign: S,
    /// Place of the strain of the contact's spring, and the softness of that spring.
    pub spring: Option<(usize, S)>,
}

/// An elastic bed under one element.
#[derive(Debug, Clone)]
pub struct Bed<S> {
    /// The number of its first contact.
    contact: usize,
    /// The place of its first strain.
    place: usize,
    /// How far each of its springs is drawn out by a strain of 1.
    softness: Vec<S>,
    /// Rows of `H`, and behind each that of `G`.
    rows: Vec<S>,
    /// The Cholesky factor of `Σ + H Hᵀ`, row by row.
    lower: Vec<S>,
    /// `H Bᵀ`, `(Σ + H Hᵀ)⁻¹ G` and `(Σ + H Hᵀ)⁻¹ H Bᵀ`.
    outer: Vec<[S; 2]>,
    by_motion: Vec<[S; 2]>,
    by_force: Vec<[S; 2]>,
    /// The bed as two springs at the inner end, `k`, `l` and `r`.
    own: [S; 3],
    meeting: Meeting<S>,
}

/// Four springs `½ d (α w + β θ − A)²` that meet at a border, and the two that they are together.
#[derive(Debug, Clone, Default)]
pub struct Meeting<S> {
    alpha: [S; 4],
    /// β less that of the common spring on the deflection.
    beta: [S; 4],
    stiffness: [S; 4],
    /// Shares of the common forces.
    shares: [[S; 4]; 2],
    /// Whether the deflection and whether the rotation is held.
    holds: [bool; 2],
    /// Where the common spring on the deflection acts (m), and 1 over both stiffnesses.
    at: S,
    softness: [S; 2],
}

/// What lies beyond a border: the springs on the deflection and on the rotation, and where the first
/// acts.
#[derive(Debug, Clone, Copy, Default)]
struct Footing {
    spring: f64,
    at: RunningSum<f64>,
    turning: f64,
}

/// Where the springs of [`Footing`] are at rest.
#[derive(Debug, Clone, Copy, Default)]
struct Rest<R> {
    deflection: RunningSum<R>,
    rotation: RunningSum<R>,
}

/// What the springs are to fit: strains, or displacements of the contacts with the root at rest.
#[derive(Debug, Clone, Copy)]
pub enum Given<'a, R> {
    /// Strains of the elements and of all springs.
    Strains(&'a [R]),
    /// Displacement of every contact.
    Displacements(&'a [R]),
}

/// An element as [`Build`] wants it: the place of its first strain, what these add to deflection and
/// rotation at its outer end, and its length (m).
pub struct Span<S> {
    /// The place of its first strain.
    pub first: usize,
    /// What each strain adds to deflection and rotation at the outer end.
    pub adds: Vec<[S; 2]>,
    /// Length of the element from its inner to its outer end (m).
    pub length: f64,
}

/// What an elastic bed is to [`Build`].
pub struct Under<S> {
    /// Number of the bed's first contact.
    pub contact: usize,
    /// The place of its first strain.
    pub place: usize,
    /// How far each of its springs is drawn out by a strain of 1.
    pub softness: Vec<S>,
    /// What each of them holds: rows over the strains, deflection and rotation at the inner end.
    pub rows: Vec<S>,
}

/// One side, inwards from its free end.
#[derive(Default)]
pub struct Build<S> {
    steps: Vec<Step<S>>,
    footing: Footing,
}

impl<S: Real> Build<S> {
    /// An element or, without length, a joint.
    pub fn cross(&mut self, span: Span<S>) {
        if self.steps.is_empty() {
            return;
        }
        let compliance = product(&span.adds, &span.adds);
        let (length, (crossing, seen)) = (span.length, self.footing.through(span, compliance));
        self.footing = seen;
        self.footing.at.add(length);
        self.steps.push(Step::Cell(crossing));
    }

    /// A contact at the border.
    pub fn meet(&mut self, border: Border<S>) {
        let soft = border.spring.map_or(0.0, |(_, softness)| softness.lane(0));
        let stiffness = (1.0 / (soft * soft)).min(RIGID);
        let own = if border.turning { [0.0, 0.0, stiffness] } else { [stiffness, 0.0, 0.0] };
        let (meeting, footing) = self.footing.meet([[1.0, 0.0], [0.0, 1.0]], own);
        self.footing = footing;
        self.steps.push(Step::Contact(border, meeting));
    }

    /// An element on an elastic bed.
    pub fn cross_bed(&mut self, span: Span<S>, under: Under<S>) {
        let (n, count) = (span.adds.len(), under.softness.len());
        let row = |k: usize| &under.rows[k * (n + 2)..][..n];
        let number = |x: &S| x.lane(0);
        let mut lower = vec![0.0; count * count];
        for i in 0..count {
            for j in 0..=i {
                let products = row(i).iter().zip(row(j)).map(|(a, b)| number(a) * number(b));
                let known = |k: usize| lower[i * count + k] * lower[j * count + k];
                let entry = products.sum::<f64>() - (0..j).map(known).sum::<f64>();
                let own = number(&under.softness[i]).powi(2);
                lower[i * count + j] = match i == j {
                    // A pivot is no less than what the springs give way themselves.
                    true => (entry + own).max(own).sqrt(),
                    false => entry / lower[j * count + j],
                };
            }
        }
        let lower: Vec<S> = lower.into_iter().map(S::splat).collect();
        let outer: Vec<[S; 2]> = (0..count)
            .map(|k| {
                let sum = |e: usize| {
                    let parts = row(k).iter().zip(&span.adds).map(|(h, b)| *h * b[e]);
                    parts.fold(S::default(), |sum, part| sum + part)
                };
                [sum(0), sum(1)]
            })
            .collect();
        let inner: Vec<[S; 2]> =
            (0..count).map(|k| std::array::from_fn(|e| under.rows[k * (n + 2) + n + e])).collect();
        let solved = |columns: &[[S; 2]]| -> Vec<[S; 2]> {
            let [a, b] = [0, 1].map(|e| {
                let mut column: Vec<S> = columns.iter().map(|c| c[e]).collect();
                solve(&lower, &mut column);
                column
            });
            a.into_iter().zip(b).map(|(a, b)| [a, b]).collect()
        };
        let (by_motion, by_force) = (solved(&inner), solved(&outer));
        let own = two_springs(product(&inner, &by_motion));
        let bare = product(&span.adds, &span.adds);
        let taken = product(&outer, &by_force);
        let compliance: [f64; 3] = std::array::from_fn(|i| bare[i] - taken[i]);
        let compliance = [compliance[0].max(0.0), compliance[1], compliance[2].max(0.0)];
        // How a motion of the inner end moves the outer end.
        let moved = |out: usize, inner: usize| -> f64 {
            let parts = outer.iter().zip(&by_motion);
            parts.map(|(o, m)| o[out].lane(0) * m[inner].lane(0)).sum()
        };
        let carried =
            [[1.0 - moved(0, 0), span.length - moved(0, 1)], [-moved(1, 0), 1.0 - moved(1, 1)]];
        let (crossing, seen) = self.footing.through(span, compliance);
        let (meeting, footing) = seen.meet(carried, own);
        self.footing = footing;
        let Under { contact, place, softness, rows } = under;
        let own = own.map(S::splat);
        let bed =
            Bed { contact, place, softness, rows, lower, outer, by_motion, by_force, own, meeting };
        self.steps.push(Step::Bed(crossing, Box::new(bed)));
    }
}

impl Footing {
    /// Seen through a compliance `F = [ww, wθ, θθ]` at its place; the rest of a crossing.
    fn through<S: Real>(self, span: Span<S>, [ww, wt, tt]: [f64; 3]) -> (Crossing<S>, Self) {
        let l = self.at.value();
        let across = (ww + l * (2.0 * wt + l * tt)).max(0.0);
        let share = 1.0 + self.turning * tt;
        let shift = -self.turning * (wt + l * tt) / share;
        let both = (ww * tt - wt * wt).max(0.0);
        let give = (across + self.turning * both) / share;
        let mut at = self.at;
        at.add(shift);
        let (spring, turning) = (self.spring / (1.0 + self.spring * give), self.turning / share);
        let crossing = Crossing {
            first: span.first,
            adds: span.adds,
            at: S::splat(at.value()),
            shift: S::splat(shift),
        };
        (crossing, Self { spring, at, turning })
    }

    /// Together with two springs `[k, l, r]` at the inner end of what carries a motion of the inner
    /// end to this place.
    fn meet<S: Real>(self, carried: [[f64; 2]; 2], [k, l, r]: [f64; 3]) -> (Meeting<S>, Self) {
        let at = self.at.value();
        let [lift, turn] = carried;
        let first = [lift[0] + at * turn[0], lift[1] + at * turn[1]];
        let springs = [first, turn, [1.0, l], [0.0, 1.0]];
        Meeting::of(springs, [self.spring, self.turning, k, r])
    }
}

impl<S: Real> Meeting<S> {
    /// The meeting of springs `½ d (α w + β θ)²`.
    fn of(springs: [[f64; 2]; 4], d: [f64; 4]) -> (Self, Footing) {
        let all = 0..4;
        let alpha = springs.map(|s| s[0]);
        let spring: f64 = all.clone().map(|i| d[i] * alpha[i] * alpha[i]).sum();
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let p: [f64; 4] = std::array::from_fn(|i| share(d[i] * alpha[i], spring));
        let at: f64 = all.clone().map(|i| p[i] * springs[i][1]).sum();
        let beta: [f64; 4] = std::array::from_fn(|i| {
            let beside = |j: usize| p[j] * (alpha[j] * springs[i][1] - alpha[i] * springs[j][1]);
            if spring > 0.0 { all.clone().map(beside).sum() } else { springs[i][1] }
        });
        let turning: f64 = all.map(|i| d[i] * beta[i] * beta[i]).sum();
        let q: [f64; 4] = std::array::from_fn(|i| share(d[i] * beta[i], turning));
        let number = |list: [f64; 4]| list.map(S::splat);
        let meeting = Self {
            alpha: number(alpha),
            beta: number(beta),
            stiffness: number(d),
            shares: [number(p), number(q)],
            holds: [spring > 0.0, turning > 0.0],
            at: S::splat(at),
            softness: [spring, turning].map(|k| S::splat(share(1.0, k))),
        };
        let mut place = RunningSum::default();
        place.add(at);
        (meeting, Footing { spring, at: place, turning })
    }

    /// Where the common springs are at rest if each alone would be at `rest`; and the forces that
    /// the four then have all the same.
    ///
    /// Differences of two at a time: a spring that outweighs all others leaves the others' digits.
    fn rest<R: Over<S>>(&self, rest: [R; 4]) -> (Rest<R>, [R; 4]) {
        let [p, q] = &self.shares;
        let zero = R::default();
        let sum = |parts: &[S; 4], of: &[R; 4]| {
            parts.iter().zip(of).fold(zero, |sum, (part, of)| sum + *of * *part)
        };
        let deflection = sum(p, &rest);
        let off: [R; 4] = std::array::from_fn(|i| {
            if !self.holds[0] {
                return -rest[i];
            }
            let beside = |j: usize| (rest[j] * self.alpha[i] - rest[i] * self.alpha[j]) * p[j];
            (0..4).filter(|j| *j != i).fold(zero, |sum, j| sum + beside(j))
        });
        let rotation = -sum(q, &off);
        let forces = std::array::from_fn(|i| {
            let beside = |j: usize| (off[i] * self.beta[j] - off[j] * self.beta[i]) * q[j];
            let left = match self.holds[1] {
                true => (0..4).filter(|j| *j != i).fold(zero, |sum, j| sum + beside(j)),
                false => off[i],
            };
            left * self.stiffness[i]
        });
        let mut at = Rest::<R>::default();
        at.deflection.add(deflection);
        at.rotation.add(rotation);
        (at, forces)
    }

    /// The forces of the four, of the forces of both together and what they have all the same.
    fn forces<R: Over<S>>(&self, [push, turn]: [R; 2], own: &[R]) -> [R; 4] {
        std::array::from_fn(|i| push * self.shares[0][i] + turn * self.shares[1][i] + own[i])
    }
}

impl<S: Real> Holds<S> {
    /// How both sides together hold the root, the knob side first.
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

    /// Deflection and rotation of the root that what is given calls for.
    pub fn root<R: Over<S>>(&self, given: Given<R>) -> [R; 2] {
        let (rest, _) = self.inwards(given, &mut Default::default());
        let turn = rest.rotation.value();
        [rest.deflection.value() - turn * self.root.at, turn]
    }

    /// The strains that the contacts allow and that are nearest to these, with a force and a moment
    /// at the root; the contacts' reactions.
    pub fn fit<R: Over<S>>(&self, strains: &mut [R], [force, moment]: [R; 2], reactions: &mut [R]) {
        let mut traces = <[Vec<R>; 2]>::default();
        let (_, own) = self.inwards(Given::Strains(strains), &mut traces);
        let [a, b, c, d] = self.root.forces([force, moment - force * self.root.at], &own);
        let [knob, tip] = &self.sides;
        let [knob_trace, tip_trace] = &mut traces;
        outwards(knob, [c, -d], knob_trace, strains, reactions);
        outwards(tip, [a, b], tip_trace, strains, reactions);
    }

    /// Both sides inwards to the root; leaves what the way back needs.
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

impl<S: Real> Step<S> {
    /// Where the springs are at rest on the inner side, from where they are on the outer.
    fn inwards<R: Over<S>>(&self, rest: Rest<R>, given: Given<R>, trace: &mut Vec<R>) -> Rest<R> {
        match self {
            Self::Cell(crossing) => crossing.inwards(rest, crossing.moved(given)),
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
            Self::Bed(crossing, bed) => {
                let mut forces = bed.off(crossing, given);
                solve(&bed.lower, &mut forces);
                let [lift, turn] = sums(&bed.outer, &forces);
                let moved = crossing.moved(given);
                let outer = crossing.inwards(rest, [moved[0] - lift, moved[1] - turn]);
                let n = crossing.adds.len();
                let mut push = [R::default(); 2];
                for (row, force) in bed.rows.chunks_exact(n + 2).zip(&forces) {
                    push[0] += *force * row[n];
                    push[1] += *force * row[n + 1];
                }
                let [k, l, r] = bed.own;
                let own = [-push[0] / R::of(k), -(push[1] - push[0] * l) / R::of(r)];
                let before = [outer.deflection.value(), outer.rotation.value()];
                let all = [before[0], before[1], own[0], own[1]];
                let (rest, residual) = bed.meeting.rest(all);
                trace.extend(forces);
                trace.extend([rest.deflection.value(), rest.rotation.value()]);
                trace.extend(residual);
                rest
            }
        }
    }
}

/// Hands the forces at the root on outwards, and takes them out of the strains.
fn outwards<S: Real, R: Over<S>>(
    steps: &[Step<S>],
    [mut push, mut turn]: [R; 2],
    trace: &mut Vec<R>,
    strains: &mut [R],
    reactions: &mut [R],
) {
    for step in steps.iter().rev() {
        match step {
            Step::Cell(crossing) => crossing.take(push, turn, strains),
            Step::Contact(border, meeting) => {
                let own = trace.split_off(trace.len() - 4);
                let [a, b, c, d] = meeting.forces([push, turn], &own);
                (push, turn) = (a, b);
                let reaction = if border.turning { d * border.sign } else { c };
                reactions[border.contact] = reaction;
                if let Some((place, softness)) = border.spring {
                    strains[place] += reaction * softness;
                }
                continue;
            }
            Step::Bed(crossing, bed) => {
                let own = trace.split_off(trace.len() - bed.softness.len() - 6);
                let (forces, rest) = own.split_at(bed.softness.len());
                let meeting = &bed.meeting;
                let turned = rest[1] + turn * meeting.softness[1];
                let moved = rest[0] + push * meeting.softness[0] - turned * meeting.at;
                [push, turn, ..] = meeting.forces([push, turn], &rest[2..]);
                crossing.take(push, turn, strains);
                let carried = [push, push * crossing.at + turn];
                bed.take(crossing, forces, [moved, turned], carried, strains, reactions);
            }
        }
        let (Step::Cell(crossing) | Step::Bed(crossing, _)) = step else { continue };
        turn += push * crossing.shift;
    }
}

impl<S: Real> Crossing<S> {
    /// What the given strains add to deflection and rotation at the outer end.
    fn moved<R: Over<S>>(&self, given: Given<R>) -> [R; 2] {
        match given {
            Given::Strains(q) => sums(&self.adds, &q[self.first..]),
            Given::Displacements(_) => [R::default(); 2],
        }
    }

    fn inwards<R: Over<S>>(&self, mut rest: Rest<R>, [lift, turn]: [R; 2]) -> Rest<R> {
        rest.deflection.add(rest.rotation.value() * self.shift - (lift + turn * self.at));
        rest.rotation.add(-turn);
        rest
    }

    /// Takes out of the strains what the forces make.
    fn take<R: Over<S>>(&self, push: R, turn: R, strains: &mut [R]) {
        let moment = push * self.at + turn;
        for (q, adds) in strains[self.first..].iter_mut().zip(&self.adds) {
            *q -= push * adds[0] + moment * adds[1];
        }
    }
}

impl<S: Real> Bed<S> {
    /// Displacements of the bed's springs with the inner end at rest.
    fn off<R: Over<S>>(&self, crossing: &Crossing<S>, given: Given<R>) -> Vec<R> {
        let count = self.softness.len();
        let q = match given {
            Given::Displacements(off) => return off[self.contact..][..count].to_vec(),
            Given::Strains(q) => q,
        };
        let n = crossing.adds.len();
        let own = &q[crossing.first..][..n];
        let springs = self.softness.iter().zip(&q[self.place..]);
        let rows = self.rows.chunks_exact(n + 2).zip(springs);
        rows.map(|(row, (softness, strain))| {
            let moved = own.iter().zip(row).fold(R::default(), |sum, (q, h)| sum + *q * *h);
            moved - *strain * *softness
        })
        .collect()
    }

    /// Takes out of the strains what the bed's forces make.
    fn take<R: Over<S>>(
        &self,
        crossing: &Crossing<S>,
        forces: &[R],
        moved: [R; 2],
        carried: [R; 2],
        strains: &mut [R],
        reactions: &mut [R],
    ) {
        let n = crossing.adds.len();
        for (k, row) in self.rows.chunks_exact(n + 2).enumerate() {
            let [by, out] = [&self.by_motion[k], &self.by_force[k]];
            let force = forces[k] + (moved[0] * by[0] + moved[1] * by[1])
                - (carried[0] * out[0] + carried[1] * out[1]);
            reactions[self.contact + k] = force;
            strains[self.place + k] += force * self.softness[k];
            for (q, h) in strains[crossing.first..].iter_mut().zip(&row[..n]) {
                *q -= force * *h;
            }
        }
    }
}

/// `Σ x_k a_k` of pairs.
fn sums<S: Real, R: Over<S>>(pairs: &[[S; 2]], x: &[R]) -> [R; 2] {
    let mut sum = [R::default(); 2];
    for (pair, x) in pairs.iter().zip(x) {
        sum[0] += *x * pair[0];
        sum[1] += *x * pair[1];
    }
    sum
}

/// `Σ a_k b_kᵀ` of pairs, of which it is known to be symmetric: `[ww, wθ, θθ]`.
fn product<S: Real>(a: &[[S; 2]], b: &[[S; 2]]) -> [f64; 3] {
    [[0, 0], [0, 1], [1, 1]]
        .map(|[i, j]| a.iter().zip(b).map(|(a, b)| a[i].lane(0) * b[j].lane(0)).sum())
}

/// A stiffness as a spring on the deflection, where it acts, and one on the rotation.
fn two_springs([ww, wt, tt]: [f64; 3]) -> [f64; 3] {
    let at = wt / ww;
    [ww, at, (tt - wt * at).max(tt * f64::EPSILON)]
}

/// Solves `L Lᵀ x = b`.
fn solve<S: Real, R: Over<S>>(lower: &[S], x: &mut [R]) {
    let n = x.len();
    for i in 0..n {
        let row = &lower[i * n..];
        let known = (0..i).fold(R::default(), |sum, k| sum + x[k] * row[k]);
        x[i] = (x[i] - known) / R::of(row[i]);
    }
    for i in (0..n).rev() {
        let known = (i + 1..n).fold(R::default(), |sum, k| sum + x[k] * lower[k * n + i]);
        x[i] = (x[i] - known) / R::of(lower[i * n + i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One number after the other, of no pattern.
    struct Draw(f64);

    impl Draw {
        fn next(&mut self, from: f64, to: f64) -> f64 {
            self.0 = (self.0 + 0.618_033_988_749_894_9).fract();
            from + (to - from) * (997.0 * self.0).fract()
        }
    }

    /// A displacement as the strains and the root's motion make it.
    type Row = (Vec<f64>, [f64; 2]);
    /// What is met on the way outwards, to be built inwards.
    type Met = Box<dyn FnOnce(&mut Build<f64>)>;

    fn plus((a, u): &Row, times: f64, (b, v): &Row) -> Row {
        let strains = a.iter().zip(b).map(|(a, b)| a + times * b).collect();
        (strains, [u[0] + times * v[0], u[1] + times * v[1]])
    }

    const STRAINS: usize = 3;
    const TERMS: usize = 4;
    const MOST: usize = 200;

    /// Two sides of random elements, contacts and beds; every contact's row, its spring's strain
    /// and the number of strains.
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
                // The elimination of everything loses digits, the way inwards does not.
                assert!((a - b).abs() < 1e-7 * size, "{seed} {a} {b}");
            }
            // Again: what the contacts allow stays.
            let before = found.clone();
            holds.fit(&mut found, [0.0; 2], &mut reactions);
            for (a, b) in found.iter().zip(&before) {
                assert!((a - b).abs() < 1e-13 * size, "{seed} {a} {b}");
            }
            // And it is what the contacts allow, with the root moved as is said.
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
