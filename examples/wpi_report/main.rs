//! Is the report from which this project grew still correct? All its figures and tables, computed again.
//!
//!     cargo run --release --example wpi_report [-- DIR]
//!
//! Writes figures 1 and 4 to 18 of Boucher, Mannke, McClune, *Vibrational Analysis of a Bat-Ball Collision* (Major
//! Qualifying Project, Worcester Polytechnic Institute) as CSV files into `DIR` (`target/wpi_report` by default), and
//! prints the claims of the report next to the results of its model. A real hit is different: the loss to vibration
//! here is that of the report.

mod table;
mod sums;
mod vibration;
mod hit;
mod claims;

use claims::Claim;
use std::{env, fs, io, path::PathBuf};

fn main() -> io::Result<()> {
    let directory = PathBuf::from(env::args().nth(1).unwrap_or("target/wpi_report".into()));
    fs::create_dir_all(&directory)?;
    let tables: Vec<_> = vibration::all().into_iter().chain(hit::all()).collect();
    for table in &tables {
        fs::write(directory.join(format!("{}.csv", table.name)), table.csv())?;
    }
    println!("{} tables written to {}", tables.len(), directory.display());

    let summary = hit::summary();
    print("The report's claims", &claims::claims(&summary));
    print("The report's numbers, corrected", &claims::corrections(&summary));
    Ok(())
}

fn print(title: &str, claims: &[Claim]) {
    println!("\n{title}");
    for Claim { claim, printed, ours, verdict } in claims {
        println!("\n  {claim}");
        if !printed.is_empty() {
            println!("    printed  {printed}");
        }
        println!("    ours     {ours}");
        println!("    verdict  {verdict}");
    }
}
