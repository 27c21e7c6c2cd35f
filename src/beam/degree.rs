//! From a degree and a theory, known at run time, to code compiled for them.

use crate::bat::Theory;
use crate::beam::mesh::Mesh;

/// Mesh, degree and theory of a bat's elements.
#[derive(Debug, Clone, Copy)]
pub struct Elements<'a> {
    /// Where they are.
    pub mesh: &'a Mesh,
    /// Degree of their deflection.
    pub degree: usize,
    /// The beam theory.
    pub theory: Theory,
}

/// Work on elements whose degree is a constant in the code.
pub trait OfDegree {
    /// Its result.
    type Output;

    /// Does the work: a deflection has N coefficients, an element W − 2 strains.
    fn with<const N: usize, const W: usize>(self) -> Self::Output;
}

/// Does the work on elements with a deflection of that degree, 3 to 12: `N = p + 1` coefficients and `p − 1` strains,
/// or twice as many with shear.
pub fn of_degree<T: OfDegree>(degree: usize, theory: Theory, work: T) -> T::Output {
    match (theory.shears(), degree) {
        (false, 3) => work.with::<4, 4>(),
        (false, 4) => work.with::<5, 5>(),
        (false, 5) => work.with::<6, 6>(),
        (false, 6) => work.with::<7, 7>(),
        (false, 7) => work.with::<8, 8>(),
        (false, 8) => work.with::<9, 9>(),
        (false, 9) => work.with::<10, 10>(),
        (false, 10) => work.with::<11, 11>(),
        (false, 11) => work.with::<12, 12>(),
        (false, _) => work.with::<13, 13>(),
        (true, 3) => work.with::<4, 6>(),
        (true, 4) => work.with::<5, 8>(),
        (true, 5) => work.with::<6, 10>(),
        (true, 6) => work.with::<7, 12>(),
        (true, 7) => work.with::<8, 14>(),
        (true, 8) => work.with::<9, 16>(),
        (true, 9) => work.with::<10, 18>(),
        (true, 10) => work.with::<11, 20>(),
        (true, 11) => work.with::<12, 22>(),
        (true, _) => work.with::<13, 24>(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::rule::DEGREES;

    struct Sizes;

    impl OfDegree for Sizes {
        type Output = [usize; 2];

        fn with<const N: usize, const W: usize>(self) -> [usize; 2] {
            [N, W]
        }
    }

    #[test]
    fn every_degree_has_its_coefficients_and_strains() {
        for degree in DEGREES {
            for theory in Theory::ALL {
                let strains = (degree - 1) * if theory.shears() { 2 } else { 1 };
                assert_eq!(of_degree(degree, theory, Sizes), [degree + 1, strains + 2]);
            }
        }
    }
}
