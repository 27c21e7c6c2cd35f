//! After how many steps has the iteration converged? The basis of `modes::eigenpairs::steps_beyond`.
//!
//!     cargo run --release --example tuning_iterations
//!
//! Steps beyond the number of modes at which every residual is small enough, and those of the formula, before which
//! convergence is not checked. One step too many costs a product; one too few costs a check, which is several products.

use sweetspot::beam::mesh::Mesh;
use sweetspot::beam::statics::Statics;
use sweetspot::beam::sweep::Loads;
use sweetspot::eigen::lanczos::{Lanczos, Space, Wanted};
use sweetspot::modes::eigenpairs::steps_beyond;
use sweetspot::{Bat, Result, Theory};

const BATS: [&str; 4] = ["dowel", "cone", "r161", "northwestern_aluminium"];

/// The smallest sufficient number of steps, over all times of checking.
fn taken<const N: usize, const W: usize>(
    statics: &Statics<f64, N, W>,
    count: usize,
    residual: f64,
) -> Result<usize> {
    let mut fewest = usize::MAX;
    // With many modes not every step is checked.
    for earliest in 0..=count / 8 {
        let (mut lanczos, mut loads) = (Lanczos::default(), Loads::default());
        let wanted = Wanted { count, residual, earliest, clustered: 0 };
        let space = Space { known: &[], allow: &mut |_: &mut [f64]| {} };
        let start = |next: &mut [f64]| statics.view().start(count, next);
        lanczos.largest(statics.dimension(), wanted, space, start, |q, y| {
            statics.apply(q, y, &mut loads);
        })?;
        fewest = fewest.min(lanczos.steps);
    }
    Ok(fewest)
}

fn table<const N: usize, const W: usize>(theory: Theory) -> Result<()> {
    println!("\n{}: steps beyond the modes, and the formula's", theory.name());
    println!("{:24} modes {}", "", [4, 6, 8, 10, 12].map(|d| format!("  1e-{d:02}  ")).concat());
    for name in BATS {
        let bat = Bat::from_file(format!("meshes/{name}.json"))?;
        if theory.shears() && !bat.knows_shear() {
            continue;
        }
        let mut statics = Statics::<f64, N, W>::empty(&bat, theory);
        statics.assemble(&[&bat], &[&Mesh::along(&bat, 80)]);
        for count in [1, 3, 10, 30, 60] {
            print!("{name:24} {count:5} ");
            for digits in [4, 6, 8, 10, 12] {
                let residual = 10f64.powi(-digits);
                let beyond = taken(&statics, count, residual)? - count;
                print!("{beyond:4} {:3} ", steps_beyond(theory, count, residual));
            }
            println!();
        }
    }
    Ok(())
}

fn main() -> Result<()> {
    table::<8, 8>(Theory::EulerBernoulli)?;
    table::<8, 14>(Theory::Timoshenko)
}
