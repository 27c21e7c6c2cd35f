//! How close are the frequencies of a bat to each other? The basis of `modes::certificate::is_twin`.
//!
//!     cargo run --release --example tuning_gaps
//!
//! The smallest `n (1 − λ_n/λ_{n+1})` of the first modes. A value far below these is not a gap between modes of a bat:
//! the next mode is a twin of the last and must be included.

use sweetspot::{Bat, Request, Result, Theory, solve};

const MODES: usize = 40;

fn main() -> Result<()> {
    let mut paths: Vec<_> = std::fs::read_dir("meshes")
        .expect("run from the project's folder")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    paths.sort();
    println!("{:36} {:16} least   at mode", "bat", "theory");
    for path in paths {
        let bat = Bat::from_file(&path)?;
        for theory in Theory::ALL {
            if theory.shears() && !bat.knows_shear() {
                continue;
            }
            let solution = solve(
                &bat,
                &Request { modes: MODES, tolerance: 1e-6, theory, ..Request::default() },
            )?;
            let modes = solution.modes.windows(2).enumerate();
            let gaps = modes.map(|(k, pair)| {
                let ratio = (pair[0].omega / pair[1].omega).powi(2);
                ((k + 1) as f64 * (1.0 - ratio), k + 1)
            });
            let (gap, mode) = gaps.min_by(|a, b| a.0.total_cmp(&b.0)).expect("there are two");
            println!("{:36} {:16} {gap:5.2} {mode:9}", bat.name(), theory.name());
        }
    }
    Ok(())
}
