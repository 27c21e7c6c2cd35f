//! Springs at a border of two cells: the part of the bat beyond the border acts like two springs.
//!
//! One spring `k` acts on the deflection at a distance `l` outwards, the other, `r`, on the rotation:
//!
//! ```text
//! ½ k (w + l θ − a)² + ½ r (θ − b)²,
//! ```
//!
//! This form is kept along the pass to the root: a cell adds compliance ([`Footing::through`]), a contact adds
//! stiffness ([`Footing::meet`]).

use crate::base::{Over, Real, RunningSum};

/// An element to be crossed: the index of its first strain, the contributions of its strains to deflection and rotation
/// at its outer end, and its length (m).
pub struct Span<S> {
    /// Index of its first strain.
    pub first: usize,
    /// Contribution of each strain to deflection and rotation at the outer end.
    pub adds: Vec<[S; 2]>,
    /// Length of the element from its inner to its outer end (m).
    pub length: f64,
}

/// Strains that lie between two borders.
#[derive(Debug, Clone)]
pub struct Crossing<S> {
    /// Index of the first of them.
    pub first: usize,
    /// Contribution of each to deflection and rotation at the outer end.
    pub adds: Vec<[S; 2]>,
    /// Distance beyond the outer end at which the spring acts, including their compliance (m).
    pub at: S,
    /// Increase of [`Self::at`] due to that compliance (m).
    pub shift: S,
}

/// Four springs `½ d (α w + β θ − A)²` that meet at a border, and the two springs equivalent to them.
#[derive(Debug, Clone, Default)]
pub struct Meeting<S> {
    alpha: [S; 4],
    /// β minus that of the common spring on the deflection.
    beta: [S; 4],
    stiffness: [S; 4],
    /// Shares in the common forces.
    shares: [[S; 4]; 2],
    /// Whether the deflection and whether the rotation is held.
    holds: [bool; 2],
    /// Where the common spring on the deflection acts (m).
    pub at: S,
    /// 1 over both common stiffnesses.
    pub softness: [S; 2],
}

/// The springs that replace the part beyond a border: one on the deflection, with its place, and one on the rotation.
#[derive(Debug, Clone, Copy, Default)]
pub struct Footing {
    /// Stiffness of the spring on the deflection (N/m over the unit of energy).
    pub spring: f64,
    /// Distance outwards at which it acts (m).
    pub at: RunningSum<f64>,
    /// Stiffness of the spring on the rotation.
    pub turning: f64,
}

/// Rest position of the springs of a [`Footing`].
#[derive(Debug, Clone, Copy, Default)]
pub struct Rest<R> {
    /// `a` (m).
    pub deflection: RunningSum<R>,
    /// `b` (rad).
    pub rotation: RunningSum<R>,
}

/// The values that the springs fit: strains, or displacements of the contacts with the root at rest.
#[derive(Debug, Clone, Copy)]
pub enum Given<'a, R> {
    /// Strains of the elements and of all springs.
    Strains(&'a [R]),
    /// Displacement of every contact.
    Displacements(&'a [R]),
}

impl Footing {
    /// The footing seen through a compliance `F = [ww, wθ, θθ]` at its place, and the data of the crossing.
    pub fn through<S: Real>(self, span: Span<S>, [ww, wt, tt]: [f64; 3]) -> (Crossing<S>, Self) {
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

    /// Combines the footing with two springs `[k, l, r]` at the inner end; `carried` takes a motion of the inner end to
    /// this place.
    pub fn meet<S: Real>(self, carried: [[f64; 2]; 2], [k, l, r]: [f64; 3]) -> (Meeting<S>, Self) {
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

    /// The rest position of the common springs if each of the four alone would be at `rest`, and the forces that the
    /// four still carry then.
    ///
    /// Works with differences of two at a time, so that a spring that outweighs all others leaves the others' digits
    /// intact.
    pub fn rest<R: Over<S>>(&self, rest: [R; 4]) -> (Rest<R>, [R; 4]) {
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

    /// The forces in the four springs, from the two common forces and those that they carry anyway.
    pub fn forces<R: Over<S>>(&self, [push, turn]: [R; 2], own: &[R]) -> [R; 4] {
        std::array::from_fn(|i| push * self.shares[0][i] + turn * self.shares[1][i] + own[i])
    }
}

impl<S: Real> Crossing<S> {
    /// Contribution of the given strains to deflection and rotation at the outer end.
    pub fn moved<R: Over<S>>(&self, given: Given<R>) -> [R; 2] {
        match given {
            Given::Strains(q) => sums(&self.adds, &q[self.first..]),
            Given::Displacements(_) => [R::default(); 2],
        }
    }

    /// The rest position at the inner side, from that at the outer side, if the cell's strains move it by `lift` and
    /// `turn`.
    pub fn inwards<R: Over<S>>(&self, mut rest: Rest<R>, [lift, turn]: [R; 2]) -> Rest<R> {
        rest.deflection.add(rest.rotation.value() * self.shift - (lift + turn * self.at));
        rest.rotation.add(-turn);
        rest
    }

    /// Subtracts from the strains the effect of the forces at the inner end; returns the forces at the outer end.
    pub fn outwards<R: Over<S>>(&self, [push, turn]: [R; 2], strains: &mut [R]) -> [R; 2] {
        let moment = push * self.at + turn;
        for (q, adds) in strains[self.first..].iter_mut().zip(&self.adds) {
            *q -= push * adds[0] + moment * adds[1];
        }
        [push, turn + push * self.shift]
    }
}

/// `Σ x_k a_k` of pairs.
pub fn sums<S: Real, R: Over<S>>(pairs: &[[S; 2]], x: &[R]) -> [R; 2] {
    let mut sum = [R::default(); 2];
    for (pair, x) in pairs.iter().zip(x) {
        sum[0] += *x * pair[0];
        sum[1] += *x * pair[1];
    }
    sum
}

/// `Σ a_k b_kᵀ` of pairs, for a product known to be symmetric: `[ww, wθ, θθ]`.
pub fn product<S: Real>(a: &[[S; 2]], b: &[[S; 2]]) -> [f64; 3] {
    [[0, 0], [0, 1], [1, 1]]
        .map(|[i, j]| a.iter().zip(b).map(|(a, b)| a[i].lane(0) * b[j].lane(0)).sum())
}

/// A stiffness as a spring on the deflection, its place, and a spring on the rotation.
pub fn two_springs([ww, wt, tt]: [f64; 3]) -> [f64; 3] {
    let at = wt / ww;
    [ww, at, (tt - wt * at).max(tt * f64::EPSILON)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `½ k (w + l θ − a)² + ½ r (θ − b)²`.
    fn energy(footing: &Footing, [a, b]: [f64; 2], [w, theta]: [f64; 2]) -> f64 {
        let (stretch, twist) = (w + footing.at.value() * theta - a, theta - b);
        0.5 * footing.spring * stretch * stretch + 0.5 * footing.turning * twist * twist
    }

    fn footing(spring: f64, at: f64, turning: f64) -> Footing {
        let mut footing = Footing { spring, turning, ..Footing::default() };
        footing.at.add(at);
        footing
    }

    /// Springs that meet store the sum of their energies, less their energy at rest.
    #[test]
    fn springs_that_meet_are_together_what_they_are_one_by_one() {
        let (one, two) = (footing(3.0, 0.4, 2.0), footing(5.0, -0.3, 0.7));
        let own = [two.spring, two.at.value(), two.turning];
        let (meeting, both) = one.meet::<f64>([[1.0, 0.0], [0.0, 1.0]], own);
        let rests = [0.2, -0.1, 0.6, 0.3];
        let (rest, _) = meeting.rest(rests);
        let rest = [rest.deflection.value(), rest.rotation.value()];
        let apart =
            |u| energy(&one, [rests[0], rests[1]], u) + energy(&two, [rests[2], rests[3]], u);
        let stored = |u| apart(u) - energy(&both, rest, u);
        for u in [[1.0, 0.0], [0.0, 1.0], [-2.0, 3.0]] {
            assert!((stored(u) - stored([0.0; 2])).abs() < 1e-14, "{u:?}");
        }
    }

    /// With one strain in between, the springs are in series with its compliance.
    #[test]
    fn a_footing_seen_through_a_strain_gives_way_by_both() {
        let (beyond, adds) = (footing(3.0, 0.4, 2.0), [0.3, 0.8]);
        let span = Span { first: 0, adds: vec![adds], length: 0.0 };
        let (_, seen) = beyond.through(span, product(&[adds], &[adds]));
        for u in [[1.0, 0.0], [0.0, 1.0], [-2.0, 3.0]] {
            // The strain q that minimises ½ q² plus the energy beyond.
            let whole = |q: f64| {
                0.5 * q * q + energy(&beyond, [0.0; 2], [u[0] + adds[0] * q, u[1] + adds[1] * q])
            };
            let (slope, bend) = (0.5 * (whole(1.0) - whole(-1.0)), whole(1.0) + whole(-1.0));
            let least = whole(-slope / (bend - 2.0 * whole(0.0)));
            assert!((energy(&seen, [0.0; 2], u) - least).abs() < 1e-14 * whole(0.0).max(1.0));
        }
    }
}
