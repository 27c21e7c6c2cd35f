#!/usr/bin/env bash
# The Python package: with a folder of cargo its module as the Rust tests built it, in the Python of target/python; with
# "all" its wheel, built and linted, all engines and its notebook, in that of target/python_all. ./check makes both.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1:?a folder of cargo, or all}" != all ]; then
    cp "$1/debug/lib_core.so" python/package/sweetspot/_core.abi3.so
    PYTHONPATH=$PWD/python/package target/python/bin/pytest -q python/tests
    exit
fi
export VIRTUAL_ENV=$PWD/target/python_all PATH=$PWD/target/python_all/bin:$PATH
cargo clippy --locked --manifest-path python/Cargo.toml --features whole -- -D warnings
maturin develop --quiet --locked --manifest-path python/Cargo.toml --profile dev --features whole
pytest -q python/tests
jupyter execute python/tutorial.ipynb --output ../target/check/tutorial.ipynb
