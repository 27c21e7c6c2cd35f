fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "arpack")]
    arpack();
}

/// Compiles the C side of `src/eigen/arpack.rs` and links ARPACK, which pkg-config finds.
#[cfg(feature = "arpack")]
fn arpack() {
    const SHIM: &str = "src/eigen/arpack_shim.c";
    println!("cargo::rerun-if-changed={SHIM}");
    let library = pkg_config::Config::new().atleast_version("3.7").probe("arpack");
    let library = library.unwrap_or_else(|error| {
        println!(
            "cargo::error=the feature `arpack` needs arpack-ng 3.7 or newer with its C interface, \
             found by pkg-config; on Debian: apt-get install libarpack2-dev pkg-config"
        );
        eprintln!("{error}");
        std::process::exit(1);
    });
    cc::Build::new().file(SHIM).includes(&library.include_paths).compile("sweetspot_arpack");
}
