#!/usr/bin/env bash
# Every file that read_back.py reads, of one bat: write.sh SWEETSPOT BAT.json FOLDER
set -euo pipefail

program=$(realpath "$1")
bat=$(realpath "$2")
mkdir -p "$3"
cd "$3"

"$program" modes "$bat" --tol 1e-6 --json modes.json --matrices matrices --quiet >/dev/null
"$program" modes "$bat" --tol 1e-6 -n 3 --shape-points 1001 --json many.json --quiet >/dev/null
for format in uff vtu csv npz; do
    "$program" convert modes.json --to $format
done
"$program" convert modes.json --to uff --legacy --out legacy.uff
"$program" convert many.json --to uff
"$program" convert modes.json --to vtu --surface 48 --out surface.vtu
"$program" convert modes.json --to vtu --surface 48 --out modes.pvd

"$program" identify --simulate "$bat" --points 6 --to-hz 1500 --quiet --reproducible --uff hammer.uff \
    --out found.uff --json found.json >/dev/null

respond() { # KIND OPTION…
    kind=$1
    shift
    "$program" frf "$bat" --at "28 in" --kind "$kind" --quiet "$@" \
        --uff "$kind.uff" --json "$kind.json" >/dev/null
}
respond receptance --to "2 in"
respond mobility --frequencies 50,123.456789,170,1000
respond accelerance --to "2 in" --linear --from-hz 10 --to-hz 2000 --points 200
