//! The seeds of the fuzz targets, each given to its reader.

use std::fs;
use std::path::Path;

#[path = "../fuzz/readers.rs"]
mod readers;

/// Every reader takes some of its seeds and refuses others, and never panics; nor on a seed that ends
/// anywhere or belongs to another reader.
#[test]
fn every_reader_takes_or_refuses_every_seed() {
    let root = Path::new(env!("SWEETSPOT_TOP")).join("fuzz/corpus");
    let seeds = |name: &str| -> Vec<Vec<u8>> {
        let files = fs::read_dir(root.join(name)).unwrap();
        files.map(|file| fs::read(file.unwrap().path()).unwrap()).collect()
    };
    let all: Vec<_> = readers::READERS.iter().flat_map(|(name, _)| seeds(name)).collect();
    for (name, reader) in readers::READERS {
        let own = seeds(name);
        let taken = own.iter().filter(|seed| reader(seed)).count();
        assert!(taken > 0 && taken < own.len(), "{name}: {taken} of {}", own.len());
        for seed in &own {
            for k in 0..16 {
                reader(&seed[..seed.len() * k / 16]);
            }
        }
        for seed in &all {
            reader(seed);
        }
    }
    let target = |name: &str| root.join(format!("../fuzz_targets/{name}.rs")).is_file();
    assert!(readers::READERS.iter().all(|(name, _)| target(name)));
}
