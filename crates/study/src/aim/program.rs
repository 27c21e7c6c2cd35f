//! The least change that meets linear wishes under linear limits: a convex quadratic program.
//!
//! ```text
//! minimise   pᵀHp + Σ μ_i t_i
//! subject to a_i − t_i ≤ g_i·p ≤ b_i + t_i,  t_i ≥ 0        wishes, with an exact penalty ("elastic")
//!            low_k ≤ r_k·p ≤ high_k                          limits
//! ```
//!
//! A wish may be missed at its price μ, so that there is always a solution if the limits leave one. The solver is
//! `clarabel`, an interior-point method.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
};

/// A row of coefficients between two bounds; either may be infinite.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounded {
    /// Coefficients of the unknowns.
    pub row: Vec<f64>,
    /// Least value.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
}

impl Bounded {
    /// The value of the row at those unknowns.
    pub fn at(&self, p: &[f64]) -> f64 {
        self.row.iter().zip(p).map(|(a, p)| a * p).sum()
    }

    /// Whether those unknowns keep the bounds within `slack`.
    pub fn is_kept(&self, p: &[f64], slack: f64) -> bool {
        (self.low - slack..=self.high + slack).contains(&self.at(p))
    }
}

/// A wish, in units of its tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Elastic {
    /// Row and bounds.
    pub wish: Bounded,
    /// The cost of one unit of a miss.
    pub penalty: f64,
}

/// The program: the quadratic form, wishes and limits.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Program {
    /// H, symmetric and positive definite.
    pub form: Vec<Vec<f64>>,
    /// The wishes.
    pub wishes: Vec<Elastic>,
    /// The limits.
    pub limits: Vec<Bounded>,
}

/// The solution of the program.
#[derive(Debug, Clone, PartialEq)]
pub struct Least {
    /// The unknowns p.
    pub p: Vec<f64>,
    /// The decrease of `pᵀHp + Σ μ t` if a wish's bound is relaxed by one unit: 0 if it does not bind, above 0 at the
    /// upper bound, below 0 at the lower one.
    pub prices: Vec<f64>,
}

impl Program {
    /// The minimum; `None` if the limits contradict each other.
    pub fn solve(&self) -> Option<Least> {
        let (n, m) = (self.form.len(), self.wishes.len());
        let mut rows = SparseRows::default();
        let mut sides = vec![];
        for (i, Elastic { wish, .. }) in self.wishes.iter().enumerate() {
            let slack = Some(n + i);
            sides.push([rows.at_most(&wish.row, wish.high, 1.0, slack), {
                rows.at_most(&wish.row, -wish.low, -1.0, slack)
            }]);
            rows.at_most(&[], 0.0, 1.0, slack);
        }
        for limit in &self.limits {
            rows.at_most(&limit.row, limit.high, 1.0, None);
            rows.at_most(&limit.row, -limit.low, -1.0, None);
        }
        let quadratic = rows_of(&self.form, n + m);
        let mut linear = vec![0.0; n];
        linear.extend(self.wishes.iter().map(|wish| wish.penalty));
        let matrix = rows.matrix(n + m);
        let cones = [SupportedConeT::NonnegativeConeT(rows.bounds.len())];
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .max_threads(1)
            .tol_gap_abs(1e-10)
            .tol_gap_rel(1e-10)
            .tol_feas(1e-11)
            .build()
            .ok()?;
        let solver =
            DefaultSolver::new(&quadratic, &linear, &matrix, &rows.bounds, &cones, settings);
        let mut solver = solver.ok()?;
        solver.solve();
        let solution = &solver.solution;
        let found = matches!(solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        let stopped = matches!(
            solution.status,
            SolverStatus::InsufficientProgress | SolverStatus::MaxIterations
        );
        // A solver that stopped short still has a solution, if it keeps the limits.
        let kept = || self.limits.iter().all(|limit| limit.is_kept(&solution.x[..n], 1e-8));
        if !(found || stopped && kept()) {
            return None;
        }
        let dual = |side: Option<usize>| side.map_or(0.0, |k| solution.z[k]);
        let prices = sides.into_iter().map(|[high, low]| dual(high) - dual(low)).collect();
        let p = solution.x[..n].to_vec();
        p.iter().all(|p| p.is_finite()).then_some(Least { p, prices })
    }
}

/// Rows `a·z ≤ b`, as their entries that are not 0.
#[derive(Default)]
struct SparseRows {
    entries: [Vec<usize>; 2],
    values: Vec<f64>,
    bounds: Vec<f64>,
}

impl SparseRows {
    /// Adds `sign · row·p − t ≤ bound` and returns its number, unless the bound is infinite.
    fn at_most(
        &mut self,
        row: &[f64],
        bound: f64,
        sign: f64,
        slack: Option<usize>,
    ) -> Option<usize> {
        if !bound.is_finite() {
            return None;
        }
        let number = self.bounds.len();
        let entries = row.iter().enumerate().map(|(j, v)| (j, sign * v)).filter(|(_, v)| *v != 0.0);
        for (j, value) in entries.chain(slack.map(|t| (t, -1.0))) {
            self.entries[0].push(number);
            self.entries[1].push(j);
            self.values.push(value);
        }
        self.bounds.push(bound);
        Some(number)
    }

    fn matrix(&self, columns: usize) -> CscMatrix<f64> {
        let [rows, of] = self.entries.clone();
        CscMatrix::new_from_triplets(self.bounds.len(), columns, rows, of, self.values.clone())
    }
}

/// The upper triangle of 2H, as `½ zᵀPz` needs it, with empty columns for variables without a square.
fn rows_of(form: &[Vec<f64>], columns: usize) -> CscMatrix<f64> {
    let (mut rows, mut of, mut values) = (vec![], vec![], vec![]);
    for (i, row) in form.iter().enumerate() {
        for (j, value) in row.iter().enumerate().skip(i).filter(|(_, v)| **v != 0.0) {
            rows.push(i);
            of.push(j);
            values.push(2.0 * value);
        }
    }
    CscMatrix::new_from_triplets(columns, columns, rows, of, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(low: f64, high: f64) -> Bounded {
        Bounded { row: vec![1.0, 1.0], low, high }
    }

    fn identity() -> Vec<Vec<f64>> {
        vec![vec![1.0, 0.0], vec![0.0, 1.0]]
    }

    /// The point of the plane x + y = 2 nearest to the origin is (1, 1). `|p|² = s²/2`, so a bound that is relaxed by 1
    /// saves s = 2.
    #[test]
    fn the_least_is_where_geometry_has_it_and_its_price_is_the_derivative() {
        let wish = Elastic { wish: plane(2.0, f64::INFINITY), penalty: 1e3 };
        let program = Program { form: identity(), wishes: vec![wish], limits: vec![] };
        let least = program.solve().unwrap();
        assert!(least.p.iter().all(|p| (p - 1.0).abs() < 1e-7), "{least:?}");
        assert!((least.prices[0] + 2.0).abs() < 1e-6, "{least:?}");
    }

    #[test]
    fn a_wish_gives_way_to_a_limit_and_limits_that_contradict_have_no_answer() {
        let wish = Elastic { wish: plane(2.0, 2.0), penalty: 1e3 };
        let limits = vec![plane(f64::NEG_INFINITY, 1.0)];
        let mut program = Program { form: identity(), wishes: vec![wish], limits };
        let least = program.solve().unwrap();
        assert!(least.p.iter().all(|p| (p - 0.5).abs() < 1e-7), "{least:?}");
        assert!((least.prices[0] + 1e3).abs() < 1e-3, "{least:?}");
        program.limits.push(plane(3.0, f64::INFINITY));
        assert_eq!(program.solve(), None);
    }
}
