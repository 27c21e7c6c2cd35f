//! The lowest eigenpairs of a sparse pencil, by ARPACK: a check of our own Lanczos.
//!
//! ARPACK keeps state between calls in global variables, so a process runs one search at a time, however many threads
//! ask. It gets `K/σ` and `M`, whose `μ = λ/σ` has no unit: for eigenvalues of the inverse below 4e-11, ARPACK would
//! measure convergence absolutely.

use std::any::Any;
use std::ffi::{c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Mutex, PoisonError};

use nalgebra_sparse::CscMatrix;

use crate::base::{Error, Result, dot};
use crate::eigen::factor::Factor;
use crate::eigen::lanczos::Ritz;
use crate::eigen::shift_invert::{self, Noise, Pairs, multiply};

/// The `count` lowest eigenpairs of `K x = λ M x`, the rigid ones included.
///
/// As [`shift_invert::lowest`], but with ARPACK's implicitly restarted Lanczos in its shift-invert mode: the operator
/// is `σ (K + σM)⁻¹ M` in the inner product of `M`.
///
/// # Errors
///
/// As [`shift_invert::lowest`].
pub fn lowest(
    k: &CscMatrix<f64>,
    m: &CscMatrix<f64>,
    shift: f64,
    count: usize,
    residual: f64,
) -> Result<Pairs> {
    let factor = Factor::new(k, m, shift)?;
    let mut noise = Noise::default();
    let ritz = shift_invert::every_copy(k.nrows(), count, |found, wanted| {
        let momenta: Vec<Vec<f64>> = found.iter().map(|x| product(m, x)).collect();
        let mut inverse = |y: &mut [f64]| {
            factor.forward(y);
            factor.backward(y);
            for (x, momentum) in found.iter().zip(&momenta) {
                let part = dot(momentum, y);
                y.iter_mut().zip(x).for_each(|(y, x)| *y -= part * x);
            }
            y.iter_mut().for_each(|y| *y *= shift);
        };
        let operators =
            Operators { mass: &mut |x, y| multiply(m, x, y), inverse: &mut inverse, panic: None };
        let ritz = largest(noise.vector(k.nrows()), wanted, residual, operators)?;
        Ok(Ritz { values: ritz.values.iter().map(|theta| theta / shift).collect(), ..ritz })
    })?;
    shift_invert::pairs(k, m, shift, ritz)
}

fn product(a: &CscMatrix<f64>, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; x.len()];
    multiply(a, x, &mut y);
    y
}

/// The operators that ARPACK calls, and the panic if one of them failed.
struct Operators<'a> {
    /// `y = B x`
    mass: &'a mut dyn FnMut(&[f64], &mut [f64]),
    /// `y ← (A + B)⁻¹ y`
    inverse: &'a mut dyn FnMut(&mut [f64]),
    panic: Option<Box<dyn Any + Send>>,
}

/// Operators and their size, passed through C.
struct Context<'a> {
    size: usize,
    operators: Operators<'a>,
}

/// `struct problem` of `arpack_shim.c`, field by field.
#[repr(C)]
struct Problem {
    size: c_int,
    wanted: c_int,
    basis: c_int,
    most_restarts: c_int,
    tolerance: f64,
    start: *mut f64,
    vectors: *mut f64,
    products: *mut f64,
    work: *mut f64,
    values: *mut f64,
    selected: *mut c_void,
    context: *mut c_void,
    mass: extern "C" fn(*mut c_void, *const f64, *mut f64) -> c_int,
    inverse: extern "C" fn(*mut c_void, *mut f64) -> c_int,
    converged: c_int,
    steps: c_int,
}

unsafe extern "C" {
    fn sweetspot_arpack(problem: *mut Problem) -> c_int;
}

/// One search at a time owns ARPACK's variables, from its first call to its last.
static ARPACK: Mutex<()> = Mutex::new(());

const MOST_RESTARTS: c_int = 300;

/// The arrays that ARPACK reads and writes.
struct Memory {
    start: Vec<f64>,
    vectors: Vec<f64>,
    products: Vec<f64>,
    work: Vec<f64>,
    values: Vec<f64>,
    /// ARPACK's integers take four or eight bytes.
    selected: Vec<u64>,
}

impl Memory {
    fn new(start: Vec<f64>, basis: usize) -> Self {
        Self {
            vectors: vec![0.0; start.len() * basis],
            products: vec![0.0; 3 * start.len()],
            work: vec![0.0; basis * (basis + 8)],
            values: vec![0.0; basis],
            selected: vec![0; basis],
            start,
        }
    }

    fn problem(&mut self, wanted: usize, tolerance: f64, context: &mut Context) -> Result<Problem> {
        let integer = |number: usize| {
            let most = format!("at most {}", c_int::MAX);
            c_int::try_from(number).map_err(|_| Error::value("unknowns", number, most))
        };
        Ok(Problem {
            size: integer(self.start.len())?,
            wanted: integer(wanted)?,
            basis: integer(self.values.len())?,
            most_restarts: MOST_RESTARTS,
            tolerance,
            start: self.start.as_mut_ptr(),
            vectors: self.vectors.as_mut_ptr(),
            products: self.products.as_mut_ptr(),
            work: self.work.as_mut_ptr(),
            values: self.values.as_mut_ptr(),
            selected: self.selected.as_mut_ptr().cast(),
            context: (&raw mut *context).cast(),
            mass,
            inverse,
            converged: 0,
            steps: 0,
        })
    }

    /// The eigenpairs found, the largest of `(A + B)⁻¹ B` first.
    fn pairs(&self, count: usize, steps: usize) -> Ritz {
        let inverted = self.values.iter().map(|mu| 1.0 / (mu + 1.0));
        let vectors = self.vectors.chunks_exact(self.start.len());
        let mut pairs: Vec<(f64, &[f64])> = inverted.zip(vectors).take(count).collect();
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (values, vectors) = pairs.into_iter().map(|(theta, x)| (theta, x.to_vec())).unzip();
        Ritz { values, vectors, steps }
    }
}

/// The `wanted` largest eigenpairs of `(A + B)⁻¹ B`, but at most all but one: ARPACK cannot find the last.
fn largest(start: Vec<f64>, wanted: usize, residual: f64, operators: Operators) -> Result<Ritz> {
    let size = start.len();
    let wanted = wanted.min(size.saturating_sub(1));
    let mut memory = Memory::new(start, size.min(2 * wanted + 10));
    let mut context = Context { size, operators };
    let mut problem = memory.problem(wanted, residual, &mut context)?;
    let status = {
        // A search that panicked leaves no state that the next one reads.
        let _alone = ARPACK.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: `problem` has the layout of the shim's struct; every array is as long as the
        // shim says it must be and outlives the call, as does `context`, which only the two
        // callbacks touch meanwhile; the lock keeps other threads out of ARPACK.
        unsafe { sweetspot_arpack(&raw mut problem) }
    };
    if let Some(panic) = context.operators.panic.take() {
        resume_unwind(panic);
    }
    let (converged, steps) = (problem.converged.max(0) as usize, problem.steps.max(0) as usize);
    if status != 0 || converged < wanted {
        let converged = converged.min(wanted.saturating_sub(1));
        return Err(Error::NotConverged { wanted, converged, steps });
    }
    Ok(memory.pairs(wanted, steps))
}

/// Runs a callback. A panic is kept for the Rust side and stops the iteration.
fn guarded(context: *mut c_void, work: impl FnOnce(&mut Context)) -> c_int {
    // SAFETY: the shim hands back the pointer that `largest` gave it, to a `Context` which lives
    // until the shim has returned and which nothing else touches while a callback runs.
    let context = unsafe { &mut *context.cast::<Context>() };
    match catch_unwind(AssertUnwindSafe(|| work(context))) {
        Ok(()) => 0,
        Err(panic) => {
            context.operators.panic = Some(panic);
            1
        }
    }
}

extern "C" fn mass(context: *mut c_void, x: *const f64, y: *mut f64) -> c_int {
    guarded(context, |context| {
        // SAFETY: ARPACK points `x` and `y` at different thirds of `products`, `size` numbers each.
        let (x, y) = unsafe {
            let x = std::slice::from_raw_parts(x, context.size);
            (x, std::slice::from_raw_parts_mut(y, context.size))
        };
        (context.operators.mass)(x, y);
    })
}

extern "C" fn inverse(context: *mut c_void, y: *mut f64) -> c_int {
    guarded(context, |context| {
        // SAFETY: ARPACK points `y` at a third of `products`, `size` numbers long.
        let y = unsafe { std::slice::from_raw_parts_mut(y, context.size) };
        (context.operators.inverse)(y);
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagonal(size: usize, panic_at: usize) -> Result<Ritz> {
        let mut calls = 0;
        let mut inverse = |y: &mut [f64]| {
            calls += 1;
            assert!(calls != panic_at, "the product number {calls} fails");
            y.iter_mut().enumerate().for_each(|(i, y)| *y /= (i + 1) as f64);
        };
        let mut mass = |x: &[f64], y: &mut [f64]| y.copy_from_slice(x);
        let operators = Operators { mass: &mut mass, inverse: &mut inverse, panic: None };
        largest(Noise::default().vector(size), 3, 1e-13, operators)
    }

    #[test]
    fn a_panic_in_a_product_comes_out_in_rust_and_the_next_search_is_sound() {
        let before = diagonal(40, usize::MAX).unwrap();
        for panic_at in [1, 2, 7] {
            let panic = catch_unwind(|| diagonal(40, panic_at)).unwrap_err();
            let message = panic.downcast_ref::<String>().unwrap();
            assert!(message.starts_with("the product number"), "{message}");
        }
        let after = diagonal(40, usize::MAX).unwrap();
        assert_eq!((before.values, before.vectors), (after.values.clone(), after.vectors));
        for (k, value) in after.values.iter().enumerate() {
            assert!((value * (k + 1) as f64 - 1.0).abs() < 1e-13, "{value}");
        }
    }
}
