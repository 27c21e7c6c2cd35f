#!/usr/bin/env bash
# Which lines of src/ and crates/ do the tests run? Builds the tests with counters (rustc's own), runs them, and
# adds up the lines. Reads the counters with `cov` of llvm_profparser, which is installed if missing:
# it needs no LLVM of the compiler's version.
set -euo pipefail
cd "$(dirname "$0")/../.."

out="$PWD/target/coverage"
mkdir -p "$out/profiles"
rm -f "$out"/profiles/*
command -v cov >/dev/null || cargo install --locked --root "$out/tools" llvm_profparser@0.15.0
PATH="$PATH:$out/tools/bin"

# Counters in this package only. Child processes write into the same files as their parents: one for
# each program (%m), added up.
export RUSTC_WORKSPACE_WRAPPER="$PWD/tests/quality/counted_rustc" CARGO_TARGET_DIR="$out/build"
export CARGO_INCREMENTAL=0 LLVM_PROFILE_FILE="$out/profiles/%m.profraw"
cargo test --locked --workspace --exclude sweetspot-python --no-run 2>&1 | tee "$out/build.txt"
rm -f "$out"/profiles/*
cargo test --locked --workspace --exclude sweetspot-python --no-fail-fast "$@"

programs=("$out/build/debug/sweetspot")
while read -r program; do programs+=("$program"); done \
    < <(sed -n 's/^ *Executable .*(\(.*\))$/\1/p' "$out/build.txt")
profiles=("$out"/profiles/*.profraw)
cov show "${profiles[@]/#/--instr-profile=}" "${programs[@]/#/--object=}" >"$out/lines.txt"
python3 tests/quality/coverage.py "$out/lines.txt"
