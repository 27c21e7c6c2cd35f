//! How does a damped bat respond to a force `e^{iωt}`?

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};

use crate::base::dot;
use crate::modes::reduced::Reduced;

/// Strains under a force `e^{iωt}`.
pub struct DrivenStrains {
    /// Amplitudes of the rigid motions, if they are coupled.
    pub rigid: Vec<c64>,
    /// Amplitudes of the strains.
    pub parts: Vec<c64>,
    /// The residual of the projection, as real and imaginary strains.
    pub residual: [Vec<f64>; 2],
}

/// A unit force (1 N) at a place, and the deflection there.
#[derive(Debug, Clone)]
pub struct UnitForce {
    /// Deflection by the free rigid motions (m).
    pub rigid: Vec<f64>,
    /// Deflection by every strain of the reduced bat (m); strains added later contribute 0.
    pub row: Vec<f64>,
}

/// The quantities that do not depend on the frequency.
pub struct Driven {
    damping: Mat<f64>,
    apart: Option<Apart>,
}

/// Strains without coupling by damping: each responds alone.
struct Apart {
    /// `ℓ` (s) of each strain, and its loss factor.
    each: Vec<(f64, f64)>,
    /// The strains in terms of the members.
    turned: Mat<f64>,
}

impl Reduced {
    /// A force or a deflection at x; its static strains join the members.
    pub fn place(&mut self, x: f64) -> UnitForce {
        let row = self.flexible.row(x);
        self.add(row.clone());
        let rigid = self.flexible.rigid.iter().map(|rigid| rigid.deflection(x)).collect();
        UnitForce { rigid, row: (0..self.len()).map(|k| dot(self.strains(k), &row)).collect() }
    }

    /// `Σ |q_i| |M_ij| |q_j′|` (s² times the square of a strain's unit) of two responses.
    pub fn inertia_of(&self, [one, other]: &[DrivenStrains; 2]) -> f64 {
        let row = |i: usize, j: usize| self.mass[i.max(j)][i.min(j)].abs();
        let by = |i: usize| -> f64 {
            other.parts.iter().enumerate().map(|(j, part)| row(i, j) * part.norm()).sum()
        };
        one.parts.iter().enumerate().map(|(i, part)| part.norm() * by(i)).sum()
    }

    /// The quantities that do not depend on the frequency, valid until further strains join.
    pub fn driven(&self) -> Driven {
        Driven { damping: self.damping(), apart: self.apart() }
    }

    /// The uncoupled strains, or `None`. There must be no dashpots, and the loss must couple no two strains: every mode
    /// has a loss factor, and all other strains share one.
    fn apart(&self) -> Option<Apart> {
        const COUPLED: f64 = 1e-12;
        let (n, modes) = (self.len(), self.omega.len());
        let own: Vec<f64> = (0..n).map(|k| self.loss[k][k]).collect();
        let others = own.get(modes).copied().unwrap_or(0.0);
        let most = COUPLED * own.iter().copied().fold(0.0, f64::max);
        let alike = own.iter().skip(modes).all(|loss| (loss - others).abs() <= most);
        let alone = (0..n).all(|i| self.loss[i][..i].iter().all(|loss| loss.abs() <= most));
        if !(self.flexible.dashpots.is_empty() && alike && alone) {
            return None;
        }
        let (lengths, turned) = self.diagonal().ok()?;
        Some(Apart { each: lengths.into_iter().zip(own).collect(), turned })
    }

    /// The strains under a force `e^{iωt}` N at a place, with the materials' stiffness times `1 + iη`; `driven` is
    /// [`Self::driven`].
    pub fn answer(&self, driven: &Driven, place: &UnitForce, omega: f64) -> DrivenStrains {
        let (rigid, parts) = match &driven.apart {
            Some(apart) => (vec![], self.one_by_one(apart, place, omega)),
            None => self.together(&driven.damping, place, omega),
        };
        let residual = self.residual(c64::new(0.0, omega), true, &rigid, &parts);
        DrivenStrains { rigid, parts, residual }
    }

    /// Amplitudes of uncoupled strains.
    fn one_by_one(&self, apart: &Apart, place: &UnitForce, omega: f64) -> Vec<c64> {
        let (n, modes) = (self.len(), self.omega.len());
        let force = |i: usize| place.row.get(i).copied().unwrap_or(0.0) / self.flexible.energy_unit;
        let along = |k: usize| match k < modes {
            true => force(k),
            false => (modes..n).map(|i| apart.turned[(i, k)] * force(i)).sum(),
        };
        let follows = |(k, (length, loss)): (usize, &(f64, f64))| {
            along(k) / c64::new(1.0 - (omega * length).powi(2), *loss)
        };
        let mut parts: Vec<c64> = apart.each.iter().enumerate().map(follows).collect();
        let turned = |i: usize| (modes..n).map(|k| parts[k] * apart.turned[(i, k)]).sum();
        let others: Vec<c64> = (modes..n).map(turned).collect();
        parts.splice(modes.., others);
        parts
    }

    /// Amplitudes of rigid motions and strains coupled by dashpots and losses.
    fn together(&self, damping: &Mat<f64>, place: &UnitForce, omega: f64) -> (Vec<c64>, Vec<c64>) {
        let (n, r) = (self.len(), self.rigid_unknowns());
        let (square, unit) = (omega * omega, self.flexible.energy_unit);
        let z = Mat::from_fn(r + n, r + n, |i, j| {
            let (mut real, mut imaginary) = (0.0, omega * damping[(i, j)]);
            if i >= r && j >= r {
                let (low, high) = (i.min(j) - r, i.max(j) - r);
                real = f64::from(u8::from(i == j)) - square * self.mass[high][low];
                imaginary += self.loss[high][low];
            } else if i == j {
                real = -square * self.rigid_mass(i);
            }
            c64::new(real, imaginary)
        });
        let forces = place.rigid[..r].iter().chain(&place.row);
        let forces: Vec<f64> = forces.map(|w| w / unit).collect();
        let force = |i: usize, _| c64::new(forces.get(i).copied().unwrap_or(0.0), 0.0);
        let solved = z.partial_piv_lu().solve(Mat::from_fn(r + n, 1, force));
        let of = |range: std::ops::Range<usize>| range.map(|i| solved[(i, 0)]).collect();
        (of(0..r), of(r..r + n))
    }
}

impl DrivenStrains {
    /// The deflection at a place (m), without the rigid motions that no dashpot affects.
    pub fn at(&self, place: &UnitForce) -> c64 {
        let strains = self.parts.iter().zip(&place.row).map(|(part, w)| *part * *w);
        let rigid = self.rigid.iter().zip(&place.rigid).map(|(part, w)| *part * *w);
        strains.chain(rigid).sum()
    }

    /// Size of the residual.
    pub fn missed(&self) -> f64 {
        self.residual.iter().map(|r| dot(r, r)).sum::<f64>().sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Bat;
    use crate::bat::theory::Theory;
    use crate::modes::request::Request;
    use crate::modes::solve::solve;

    /// The shortcut without coupling agrees with the equations of all strains together: with and without loss, with
    /// losses of single modes, and with strains beyond the modes. A dashpot excludes the shortcut.
    #[test]
    fn strains_that_nothing_couples_follow_as_all_together_do() {
        let bat = |more: &str, loss: f64| {
            let text = format!(
                r#"{{ "format": "sweetspot-bat/1", "material": {{ "density": 700, "youngs_modulus": 15e9,
                "shear_modulus": 1e9, "loss_factor": {loss} }}, "profile": {{ "interpolation": "linear",
                "x": [0, 0.4, 0.84], "radius": [0.012, 0.014, 0.03] }}{more} }}"#
            );
            Bat::from_text("bat.json", &text, "".as_ref()).unwrap()
        };
        let reduced = |bat: &Bat| {
            let request = Request { modes: 4, theory: Theory::Timoshenko, ..Request::default() };
            let solution = solve(bat, &request).unwrap();
            let mut reduced = Reduced::new(bat, solution.elements(), 4).unwrap();
            let places = [0.1, 0.55].map(|x| {
                reduced.place(x);
                x
            });
            let places = places.map(|x| reduced.place(x));
            (reduced, places)
        };
        for (loss, measured) in [(0.0, false), (0.02, false), (0.0, true)] {
            let (mut reduced, [at, to]) = reduced(&bat("", loss));
            if measured {
                reduced.lose(&[0.01, 0.02, 0.03, 0.04]);
            }
            let driven = reduced.driven();
            let apart = driven.apart.as_ref().expect("nothing couples");
            assert!(reduced.len() > reduced.omega.len());
            for frequency in [20.0, 160.0, 700.0, 3000.0] {
                let omega = std::f64::consts::TAU * frequency;
                let short = reduced.one_by_one(apart, &at, omega);
                let (_, long) = reduced.together(&driven.damping, &at, omega);
                let at_place = |parts: Vec<c64>| {
                    DrivenStrains { rigid: vec![], parts, residual: [vec![], vec![]] }.at(&to)
                };
                let [short, long] = [short, long].map(at_place);
                assert!((short - long).norm() < 1e-10 * long.norm(), "{frequency} {short} {long}");
            }
        }
        let grip =
            ", \"grip\": { \"from\": 0, \"to\": 0.15, \"stiffness\": 3e4, \"damping\": 300 }";
        assert!(reduced(&bat(grip, 0.0)).0.driven().apart.is_none());
    }
}
