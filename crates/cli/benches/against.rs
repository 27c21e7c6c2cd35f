//! Time of whole commands: side by side with another build of the program, or in units of a fixed computation.
//!
//! `cargo bench -p sweetspot-cli --bench against -- --against PROGRAM` runs both programs in turns and prints the least
//! time of each and their ratio. Without a program each time is divided by that of the fixed computation in the same
//! run, and compared with what `kept.csv` beside it has; `-- --keep` writes that file anew. Every command runs on one core.

use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

/// Turns: the least time of them counts.
const TURNS: usize = 9;
const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/kept.csv");

/// Commands by name, and in how many of the turns they run.
const COMMANDS: [(&str, usize, &[&str]); 13] = [
    ("start", TURNS, &["--version"]),
    ("modes, r161", TURNS, &["modes", "r161", "-n", "5", "--quiet"]),
    ("modes, r161, 400 of them", 1, &["modes", "r161", "-n", "400", "--quiet"]),
    ("modes, a million elements", 2, &MILLION),
    ("hit, one place", TURNS, &["hit", "r161", "--at", "28 in", "--quiet"]),
    ("hit, 101 places", TURNS, &["hit", "r161", "--points", "101", "--quiet"]),
    ("hit, 2005 places, 1e-4", TURNS, &["hit", "r161", "--points", "2005", "--quiet"]),
    ("hit, 101 places, 1e-6", 5, &["hit", "r161", "--points", "101", "--tol", "1e-6", "--quiet"]),
    ("hit, northwestern_aluminium", 5, &["hit", "northwestern_aluminium", "--quiet"]),
    ("bbcor, bbcor_made_up", 5, &["bbcor", "bbcor_made_up", "--quiet"]),
    ("hoop, northwestern_aluminium", 5, &["hoop", "northwestern_aluminium", "--quiet"]),
    ("lathe, r161", 3, &["lathe", "r161", "--quiet"]),
    ("analyze, r161", 5, &["analyze", "r161", "--quiet"]),
];
const MILLION: [&str; 9] =
    ["modes", "r161", "-n", "5", "--elements", "1000000", "--degree", "3", "--quiet"];

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let after = |name: &str| asked.iter().position(|arg| arg == name);
    let ours = Path::new(env!("CARGO_BIN_EXE_sweetspot"));
    match after("--against").map(|k| asked.get(k + 1)) {
        Some(Some(other)) => side_by_side(ours, Path::new(other)),
        Some(None) => eprintln!("--against needs the path of another sweetspot"),
        None => in_units(ours, after("--keep").is_some()),
    }
}

/// Time of a command (ms); `None` if the program fails.
fn time(program: &Path, args: &[&str]) -> Option<f64> {
    let mut command = Command::new(program);
    command.args(args).env("RAYON_NUM_THREADS", "1");
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let start = Instant::now();
    let status = command.status().ok()?;
    let took = 1e3 * start.elapsed().as_secs_f64();
    status.success().then_some(took)
}

/// The least time of both programs, which take turns, for every command.
fn side_by_side(ours: &Path, other: &Path) {
    println!("{:<30} {:>12} {:>12} {:>8}", "least time", "other", "this", "ratio");
    for (name, turns, args) in COMMANDS {
        let mut least = [f64::INFINITY; 2];
        for _ in 0..turns {
            for (least, program) in least.iter_mut().zip([other, ours]) {
                *least = least.min(time(program, args).unwrap_or(f64::INFINITY));
            }
        }
        let [before, now] = least;
        println!("{name:<30} {before:>9.1} ms {now:>9.1} ms {:>7.2}x", before / now);
    }
}

/// The least time of every command over that of the fixed computation, beside the one that was kept.
fn in_units(ours: &Path, keep: bool) {
    let kept = std::fs::read_to_string(KEPT).unwrap_or_default();
    let known = |name: &str| -> Option<f64> {
        let row = kept.lines().find(|row| row.starts_with(&format!("\"{name}\",")))?;
        row.rsplit(',').next()?.parse().ok()
    };
    let mut rows = String::from("command,units\n");
    println!("{:<30} {:>12} {:>9} {:>11}", "least time", "", "units", "over kept");
    for (name, turns, args) in COMMANDS {
        let (mut least, mut unit) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..turns {
            unit = unit.min(fixed());
            least = least.min(time(ours, args).unwrap_or(f64::INFINITY));
        }
        let units = least / unit;
        let over = known(name).map_or("-".to_owned(), |known| format!("{:.2}", units / known));
        println!("{name:<30} {least:>9.1} ms {units:>9.3} {over:>11}");
        rows.push_str(&format!("\"{name}\",{units:.4}\n"));
    }
    if keep {
        std::fs::write(KEPT, rows).expect("benches/kept.csv can be written");
    }
}

/// Time (ms) of a computation that never changes: 4 million steps of a rotation, each after the other.
fn fixed() -> f64 {
    let start = Instant::now();
    let (mut x, mut y) = (black_box(1.0_f64), black_box(0.0_f64));
    let (cos, sin) = (black_box(0.8), black_box(0.6));
    for _ in 0..4_000_000 {
        (x, y) = (cos * x - sin * y, sin * x + cos * y);
    }
    black_box((x, y));
    1e3 * start.elapsed().as_secs_f64()
}
