//! Where is the compression largest, or as large again? By Newton's method on the exact motion.

use crate::collision::contact::abreast::places::{Abreast, Motion, Move};
use crate::collision::contact::collocation::POINTS;
use crate::collision::contact::each::Each;

/// Share of a step within which a turn is found.
const FOUND: f64 = 1e-6;

impl<const W: usize> Abreast<'_, W> {
    /// Moves the places that turn in this step to their turn. Returns the length of the step at every place, the
    /// factors that move the modes by that time, and the places where the turn was found.
    #[inline(always)]
    pub(super) fn turn(
        &mut self,
        length: f64,
        powers: &[Each<W>; POINTS],
        turned: Each<W>,
    ) -> (Each<W>, Vec<Move<W>>, Each<W>) {
        let (start, end) = (self.distance(&self.now), self.distance(&self.next));
        let time = crossing(start[0], start[1] * length, end[0], end[1] * length) * length;
        let mut time = turned.choose(time, Each::all(length));
        let mut moves =
            vec![([Each::default(); 2], [[Each::default(); 2]; POINTS]); self.weights.len()];
        let mut left = Each::default();
        for round in 0..3 {
            for n in 0..self.weights.len() {
                moves[n] = moments(time * self.omegas[n]);
            }
            self.within(&moves, time, length, powers, turned);
            let [rate, bend] = self.distance(&self.next);
            left = rate / bend;
            if round == 2 {
                break;
            }
            let sane = turned.and(left.abs().within(Each::all(0.1 * length)));
            let by = sane.choose(left, Each::default());
            time = (time - by).max(Each::default()).min(Each::all(length));
        }
        (time, moves, left.abs().within(Each::all(FOUND * length)))
    }

    /// The quantity that is 0 at the turn, and its rate: the rate of the compression, or on the way back the distance
    /// from the largest compression.
    #[inline(always)]
    pub(super) fn distance(&self, state: &Motion<W>) -> [Each<W>; 2] {
        let rate = self.rate(state);
        if let Some([x, force]) = self.top {
            return [self.reach(state) - x - self.rest * force, rate];
        }
        let mut bend = -state.force * self.inverse_mass;
        for n in 0..self.weights.len() {
            let [_, im] = state.memories[n];
            bend -= self.weights[n] * (state.force - im * self.omegas[n]) * self.omegas[n];
        }
        [rate, bend]
    }

    /// The state at a time within a step, where `which` holds.
    #[inline(always)]
    pub(super) fn within(
        &mut self,
        moves: &[Move<W>],
        time: Each<W>,
        length: f64,
        powers: &[Each<W>; POINTS],
        which: Each<W>,
    ) {
        let share = time / length;
        let (mut scaled, mut scale) = (*powers, Each::all(1.0));
        let (mut push, mut back, mut force) = (Each::default(), Each::default(), Each::default());
        for k in 0..POINTS {
            scaled[k] = powers[k] * scale;
            scale = scale * share;
            let next = (k + 1) as f64;
            push += scaled[k] * (1.0 / next);
            back += scaled[k] * (1.0 / (next * (next + 1.0)));
            force += scaled[k];
        }
        let (now, next) = (&self.now, &mut self.next);
        next.time = which.choose(now.time + time, next.time);
        next.impulse = which.choose(now.impulse + push * time, next.impulse);
        next.speed = which.choose(now.speed - self.inverse_mass * push * time, next.speed);
        let closing = now.closing + now.speed * time - self.inverse_mass * back * time * time;
        next.closing = which.choose(closing, next.closing);
        next.force = which.choose(force, next.force);
        for n in 0..self.weights.len() {
            let ([cos, sin], all) = &moves[n];
            let [a, b] = now.memories[n];
            let mut re = *cos * a - *sin * b;
            let mut im = *cos * b + *sin * a;
            for k in 0..POINTS {
                re += all[k][0] * time * scaled[k];
                im += all[k][1] * time * scaled[k];
            }
            next.memories[n] =
                [which.choose(re, next.memories[n][0]), which.choose(im, next.memories[n][1])];
        }
    }

    /// Compression and force at that share of a step, where `which` holds.
    #[inline(always)]
    pub(super) fn look(&mut self, course: &[Each<W>; POINTS], share: Each<W>, which: Each<W>) {
        let mut x = course[POINTS - 1];
        for k in (0..POINTS - 1).rev() {
            x = x * share + course[k];
        }
        let [force] = self.forces([x]);
        self.next.compression = which.choose(x, self.next.compression);
        self.next.force = which.choose(force, self.next.force);
    }
}

/// [`crate::motion::phi::moments`] of `iθ`, θ ≥ 0, at every place.
#[inline(always)]
pub(super) fn moments<const W: usize>(angle: Each<W>) -> Move<W> {
    const NEAR: f64 = 1.5;
    const TERMS: usize = 9;
    let near = angle.below(Each::all(NEAR));
    let [sin, cos] = angle.sin_cos();
    let one = Each::all(1.0);
    let far_angle = near.choose(one, angle);
    let mut far = [[Each::default(); 2]; POINTS];
    let mut above = [cos - 1.0, sin];
    for k in 0..POINTS {
        far[k] = [above[1] / far_angle, -above[0] / far_angle];
        above = [far[k][0] * (k + 1) as f64 - 1.0, far[k][1] * (k + 1) as f64];
    }
    // Σ (iθ)^j 4!/(5 + j)!, even and odd terms by themselves.
    let small = near.choose(angle, Each::default());
    let square = small * small;
    let [mut even, mut odd] = [one; 2];
    let mut j = TERMS - 1;
    while j > 0 {
        let term = |first: usize| 1.0 / (((first + 2 * j) * (first - 1 + 2 * j)) as f64);
        even = one - even * square * term(POINTS);
        odd = one - odd * square * term(POINTS + 1);
        j -= 1;
    }
    let count = POINTS as f64;
    let mut all = [[Each::default(); 2]; POINTS];
    all[POINTS - 1] = [even * (1.0 / count), odd * small * (1.0 / (count * (count + 1.0)))];
    let mut k = POINTS - 1;
    while k > 0 {
        let [re, im] = all[k];
        all[k - 1] = [(one - small * im) * (1.0 / k as f64), small * re * (1.0 / k as f64)];
        k -= 1;
    }
    for k in 0..POINTS {
        all[k] = [near.choose(all[k][0], far[k][0]), near.choose(all[k][1], far[k][1])];
    }
    ([cos, sin], all)
}

/// The zero in [0, 1] of the cubic with those values and slopes at both ends.
#[inline(always)]
fn crossing<const W: usize>(
    from: Each<W>,
    from_slope: Each<W>,
    to: Each<W>,
    to_slope: Each<W>,
) -> Each<W> {
    let rise = to - from;
    let square = rise * 3.0 - from_slope * 2.0 - to_slope;
    let cube = from_slope + to_slope - rise * 2.0;
    let [zero, one] = [Each::default(), Each::all(1.0)];
    let (mut low, mut high) = (zero, one);
    let mut s = (from / (from - to)).max(zero).min(one);
    for _ in 0..6 {
        let value = ((cube * s + square) * s + from_slope) * s + from;
        let slope = (cube * s * 3.0 + square * 2.0) * s + from_slope;
        let above = zero.below(value * from);
        low = above.choose(s, low);
        high = above.choose(high, s);
        let newton = s - value / slope;
        // Once the zero is found, the last digits may leave the interval.
        let found = (newton - s).abs().within(Each::all(1e-10));
        let inside = low.below(newton).and(newton.below(high)).or(found);
        s = inside.choose(newton, (low + high) * 0.5);
    }
    s
}
