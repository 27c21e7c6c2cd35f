#!/usr/bin/env bash
# The Python package: built, linted, tested, and its notebook executed. Wants target/python, which ./check makes.
set -euo pipefail
cd "$(dirname "$0")/.."
python=$PWD/target/python
export VIRTUAL_ENV=$python PATH=$python/bin:$PATH

cargo clippy --locked --manifest-path python/Cargo.toml --features whole -- -D warnings
maturin develop --quiet --locked --manifest-path python/Cargo.toml --profile dev --features whole
pytest -q python/tests
jupyter execute python/tutorial.ipynb --output ../target/check/tutorial.ipynb
