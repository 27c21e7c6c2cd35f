//! Which reactions of supports, springs and the bed are in equilibrium with the inertia of the motion of a trial?
//!
//! For every motion z that the supports allow, and reactions `R` in equilibrium with the inertia of `y`,
//!
//! ```text
//! ⟨y, z⟩ = ∫m χ_z − V γ_z dx + Σ R_j b_j(z),    V steps by −R_j at a held deflection, m by R_j at a held rotation
//! ```
//!
//! for any reactions otherwise. Those of springs come from the trial, `R = σ k b(y)`; those of supports from a motion ψ
//! that is 1 there and 0 beyond the two adjacent cells, `R = ⟨y, ψ⟩ − σ ∫EI χ χ_ψ`. These are plain numbers without any
//! assumption. The last two are computed as intervals, so that force and moment are exactly in equilibrium.
//!
//! A bed presses with `r = σ k w`. Where no two contacts hold the bat, a line `α + β (x − x_m)` is added, which is
//! determined in place of the last two reactions; the residual has `∫(r − σ k w)²/k`.

use crate::enclosure::beam::Proven;
use crate::enclosure::contacts::Contact;
use crate::enclosure::moved::Tried;
use crate::series::Series;
use sweetspot::base::Interval;

/// The reactions in equilibrium with a motion's inertia (times s²).
pub struct Reactions {
    /// Of every contact (N or N m).
    pub contacts: Vec<Interval>,
    /// The line of the bed: α (N/m), and β (N/m²).
    pub line: [Interval; 2],
}

impl Proven {
    /// The reactions in equilibrium with the inertia of a motion, beyond the part `z k w` of the bed.
    pub fn reactions(&self, tried: &Tried) -> Option<Reactions> {
        let Tried { moved, z, .. } = tried;
        let mut line = [Interval::point(0.0); 2];
        if !self.is_held() {
            return Some(Reactions { contacts: vec![], line });
        }
        let arm = |contact: &Contact| self.arm(contact.border);
        let [mut force, mut moment] = self.inertia(moved);
        for k in self.in_bed() {
            let (cell, pressed) = (&self.cells[k], self.pressed(tried, k));
            let arm = Series::of(&[cell.middle, cell.half]);
            force = force - cell.half * pressed.integral();
            moment = moment - cell.half * arm.inner(&pressed);
        }
        let of_base = |k: usize| self.base.is_some_and(|base| base.contains(&k));
        let mut all = vec![Interval::point(0.0); self.contacts.len()];
        for (k, (contact, value)) in
            self.contacts.iter().zip(moved.held(&self.contacts)).enumerate()
        {
            if of_base(k) {
                continue;
            }
            let reaction = match contact.stiffness {
                Some(stiffness) => z * stiffness.middle() * value,
                None => self.at_support(contact, tried),
            };
            let reaction = Interval::point(if reaction.is_finite() { reaction } else { 0.0 });
            if contact.turning {
                moment = moment - reaction;
            } else {
                force = force - reaction;
                moment = moment - reaction * arm(contact);
            }
            all[k] = reaction;
        }
        let Some([i, j]) = self.base else {
            let [length, middle] = self.bed_figures()?;
            let over = length.reciprocal()?;
            let moment = moment - force * middle;
            let slope = Interval::point(12.0) * moment * over * over.square();
            line = [force * over, slope];
            return Some(Reactions { contacts: all, line });
        };
        let (first, second) = (&self.contacts[i], &self.contacts[j]);
        // About the first.
        let moment = moment - force * arm(first);
        if second.turning {
            (all[i], all[j]) = (force, moment);
        } else {
            all[j] = moment * (arm(second) - arm(first)).reciprocal()?;
            all[i] = force - all[j];
        }
        Some(Reactions { contacts: all, line })
    }

    /// The pressure of the bed on a cell due to a motion, `z k w`.
    pub fn pressed(&self, Tried { moved, z, .. }: &Tried, cell: usize) -> Series {
        let stiffness = self.bed.map_or(Interval::point(0.0), |bed| bed.stiffness);
        moved.cells[cell][0].times(Interval::point(*z) * stiffness)
    }

    /// The line of the bed on a cell.
    pub fn line(&self, [level, slope]: [Interval; 2], cell: usize) -> Option<Series> {
        let [_, middle] = self.bed_figures()?;
        let cell = &self.cells[cell];
        Some(Series::of(&[level + slope * (cell.middle - middle), slope * cell.half]))
    }

    /// Length of the bed and the arm of its middle (m).
    fn bed_figures(&self) -> Option<[Interval; 2]> {
        let [from, to] = self.bed?.borders.map(|border| self.arm(border));
        Some([to - from, Interval::point(0.5) * (from + to)])
    }

    /// The reaction of a support, nearly: `⟨y, ψ⟩ − z ∫EI χ χ_ψ` with Hermite's cubics ψ.
    fn at_support(&self, contact: &Contact, tried: &Tried) -> f64 {
        let Tried { moved, loads, strains, z } = tried;
        let border = contact.border;
        let before = border.checked_sub(1).map(|k| (k, 1.0));
        let beyond = (border < self.cells.len()).then_some((border, -1.0));
        let mut sum = 0.0;
        for (k, s) in before.into_iter().chain(beyond) {
            let h = self.cells[k].half.middle();
            // Deflection, slope and curvature of ψ in Legendre's polynomials.
            let [w, slope, bend] = match contact.turning {
                false => [
                    vec![0.5, 0.6 * s, 0.0, -0.1 * s],
                    vec![0.5 * s / h, 0.0, -0.5 * s / h],
                    vec![0.0, -1.5 * s / (h * h)],
                ],
                true => [
                    vec![-s * h / 6.0, -0.1 * h, s * h / 6.0, 0.1 * h],
                    vec![0.0, 0.5 * s, 0.5],
                    vec![0.5 * s / h, 1.5 / h],
                ],
            }
            .map(|coefficients| Series::exact(&coefficients));
            let couple = loads[k].1.as_ref().map_or(0.0, |couple| couple.inner(&slope).middle());
            let own = loads[k].0.inner(&w).middle() + couple;
            sum += h * (own - z * strains[k].0.inner(&bend).middle());
        }
        for mass in self.masses.iter().filter(|mass| mass.border == border) {
            let [w, turn] = moved.borders[border].map(Interval::point);
            let push = mass.mass.middle() * mass.at([w, turn], &moved.gives).middle();
            let couple = mass.offset.middle() * push + mass.inertia.middle() * turn.middle();
            sum += if contact.turning { couple } else { push };
        }
        sum
    }
}
