//! The energy of a step, and the bump on its force that corrects it, as in [`crate::collision::contact::energy`].

use crate::collision::contact::abreast::places::{Abreast, Move};
use crate::collision::contact::collocation::LANES;
use crate::collision::contact::each::Each;
use crate::collision::contact::table::StepTable;

impl<const W: usize> Abreast<'_, W> {
    /// Energy lost in the ball (J).
    #[inline(always)]
    pub(super) fn lost(&self) -> Each<W> {
        let Some([x, force]) = self.top else { return Each::default() };
        let shares =
            Each::all(1.0) / (self.exponent + 1.0) - Each::all(1.0) / (self.unloading + 1.0);
        x * force * shares
    }

    /// Adds a bump to the force so that the energy balance closes. Returns the places where the bump is small enough.
    #[inline(always)]
    pub(super) fn correct(
        &mut self,
        table: &StepTable,
        length: Each<W>,
        [turned, idle]: [Each<W>; 2],
        moves: Option<&[Move<W>]>,
    ) -> Each<W> {
        self.settle();
        let next = &self.next;
        let of_ball = next.force * next.compression.max(Each::default()) / (self.power() + 1.0);
        let mut modes = Each::default();
        let (mut moved, mut work) = (Each::default(), Each::default());
        for n in 0..self.weights.len() {
            let [re, im] = next.memories[n];
            let gain = self.weights[n] * self.omegas[n];
            modes += gain * (re * re + im * im);
            let [p, q] = self.bump(table, length, turned, moves, n);
            moved -= self.weights[n] * q;
            work += gain * (re * p + im * q);
        }
        let rigid = next.speed * next.speed / self.inverse_mass;
        let lost = self.lost();
        let rest = self.rest * next.force * next.force;
        let whole = (rigid + modes + rest) * 0.5 + of_ball + lost + self.spent;
        let defect = whole - self.energy;
        let off = (defect - self.defect).abs() / self.energy;
        let speed = -length * self.inverse_mass * (1.0 / 6.0);
        let closing = length * speed * 0.5;
        let slope = next.speed * speed / self.inverse_mass + work;
        let size = -defect / (slope + next.force * (closing + moved));
        let kick = (size * speed / self.speed).abs();
        let slight = Each::all(self.collider.tuning.slight * self.accuracy)
            .max(defect.abs() / self.energy * 3.0);
        let fits = kick.within(slight);
        let size = fits.choose(size, Each::default());
        let sane = fits.and(off.within(Each::all(1.0))).or(off.within(Each::all(1e-12)));
        self.corrected += idle.choose(Each::default(), off);
        self.defect = idle.choose(self.defect, fits.choose(Each::default(), defect));
        for n in 0..self.weights.len() {
            let bumps = self.bump(table, length, turned, moves, n);
            let next = &mut self.next.memories[n];
            next[0] += size * bumps[0];
            next[1] += size * bumps[1];
        }
        self.next.speed += size * speed;
        self.next.closing += size * closing;
        self.next.impulse += size * length * (1.0 / 6.0);
        self.settle();
        sane
    }

    /// Effect of a bump of 1 N on mode n in a step of that length, as real and imaginary part.
    #[inline(always)]
    pub(super) fn bump(
        &self,
        table: &StepTable,
        length: Each<W>,
        turned: Each<W>,
        moves: Option<&[Move<W>]>,
        n: usize,
    ) -> [Each<W>; 2] {
        let [p, q] = &table.bump[n / LANES];
        let whole = [Each::all(p[n % LANES]), Each::all(q[n % LANES])];
        match moves {
            None => whole,
            Some(moves) => {
                let (_, all) = &moves[n];
                let part = |k: usize| turned.choose((all[1][k] - all[2][k]) * length, whole[k]);
                [part(0), part(1)]
            }
        }
    }

    /// Compression and force from the motions, `x + C F(x) = z + Σ y`, by one step of Newton's method from values that
    /// are close.
    #[inline(always)]
    pub(super) fn settle(&mut self) {
        let (reach, x, force) = (self.reach(&self.next), self.next.compression, self.next.force);
        let by = (reach - x - self.rest * force) / (self.rest * self.slope(x, force) + 1.0);
        let [force] = self.near([x + by], [force], [by]);
        (self.next.compression, self.next.force) = (x + by, force);
    }
}
