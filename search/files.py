#!/usr/bin/env python3
"""Spoil good files at random and give them to the program, for as long as you like.

    search/files.py --minutes 60 [--seed 1] [--program target/debug/sweetspot] [--keep FOLDER]

Every run must end in time and in little memory, with exit code 0, 2 or 3; say an error in words and
never panic; print JSON without NaN where it succeeds; and leave nothing behind but what was asked for.
What does otherwise is kept, with the command line that shows it, and the exit code is 1.
"""

import argparse
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CORPUS = ROOT / "fuzz" / "corpus"
SECONDS = 60
BYTES = 2 << 30
BAT = (ROOT / "meshes" / "r161.json").read_text()
TABLE = '{ "format": "sweetspot-bat/1", "material": "white-ash", "profile": { "csv": "input.csv" } }'
PIECE = (
    '{ "format": "sweetspot-bat/1", "material": "white-ash", "profile": { "pieces": '
    '[{ "from": 0, "to": 0.84, "formula": %s }] } }'
)
# What is given to the program for each kind of file: the verbs, and how the file is named.
KINDS = {
    "bat": (["modes {f} -n 3", "hit {f} --points 5", "advise {f} -n 2", "analyze {f}"], "input.json"),
    "table": (["modes bat.json -n 3"], "input.csv"),
    "formula": (["modes bat.json -n 3 --tol 1e-3"], "input.txt"),
    "ball": (["hit bat.json --points 3 --ball {f}"], "input.json"),
    "modes": (["convert {f} --to csv --out /dev/null", "convert {f} --to uff --out /dev/null"], "input.json"),
    "force": (["ring bat.json --at 0.6 --force {f}"], "input.csv"),
    "shape": (["ring bat.json --shape {f}"], "input.csv"),
    "measured": (["compare bat.json --measured {f}"], "input.uff"),
}
STRANGE = [b"0", b"-1", b"1e999", b"-0", b"5e-324", b"1e308", b"1e-17", b"NaN", b"null", b"[]", b"{}",
           b'""', b'"1 in"', b"99999999999999999999", b"\xff", b"\x00", b"\xe2\x80\xae", b"\r\n", b"#",
           b",", b";", b'"', b"    -1\n"]


def spoilt(data, chance):
    """A copy with one to eight things wrong with it."""
    data = bytearray(data)
    for _ in range(chance.randint(1, 8)):
        at = chance.randint(0, len(data))
        end = min(len(data), at + chance.choice([0, 1, 2, 8, 64]))
        kind = chance.randrange(6)
        if kind == 0:
            del data[at:end]
        elif kind == 1:
            data[at:at] = chance.choice(STRANGE)
        elif kind == 2 and at < len(data):
            data[at] = chance.randrange(256)
        elif kind == 3:
            data[at:at] = data[at:end] * chance.choice([1, 2, 100])
        elif kind == 4:
            digits = [k for k, byte in enumerate(data) if 48 <= byte < 58]
            if digits:
                start = stop = chance.choice(digits)
                while stop < len(data) and chr(data[stop]) in "0123456789.eE+-":
                    stop += 1
                data[start:stop] = chance.choice(STRANGE)
        elif chance.random() < 0.1:
            del data[at:]
    return bytes(data)


def limits():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))


def fault(folder, program, args, expected):
    """What is wrong with one run, or nothing."""
    try:
        ran = subprocess.run([program, *args], cwd=folder, capture_output=True, timeout=SECONDS,
                             preexec_fn=limits, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return f"more than {SECONDS} s"
    told = ran.stderr.decode("utf-8", "replace")
    if ran.returncode not in (0, 2, 3):
        return f"exit code {ran.returncode}: {told[-500:]}"
    if "panicked" in told or len(told) > 100_000:
        return told[-500:]
    if ran.returncode == 2 and not any(line.startswith("error: ") for line in told.splitlines()):
        return f"an error that is not told: {told[:500]}"
    if ran.returncode == 0 and "-" in args:
        try:
            json.loads(ran.stdout, parse_constant=lambda name: sys.exit(name))
        except (ValueError, SystemExit) as error:
            return f"no JSON: {error}"
    left = sorted(os.listdir(folder))
    return None if left == expected else f"left behind: {left}"


def trial(program, seed, keep):
    """One spoilt file and one run; what is wrong, or nothing."""
    chance = random.Random(seed)
    kind = chance.choice(list(KINDS))
    commands, name = KINDS[kind]
    good = chance.choice(sorted((CORPUS / kind).iterdir()))
    data = spoilt(good.read_bytes(), chance)
    if kind == "measured" and good.suffix == ".csv":
        name = "input.csv"
    args = chance.choice(commands).format(f=name).split()
    if args[0] in ("modes", "hit", "ring"):
        args += ["--json", "-"]
    with tempfile.TemporaryDirectory(prefix="sweetspot-search-") as folder:
        bat = {"table": TABLE, "formula": PIECE % json.dumps(data.decode("utf-8", "replace"))}
        Path(folder, "bat.json").write_text(bat.get(kind, BAT))
        Path(folder, name).write_bytes(data)
        wrong = fault(folder, program, args, sorted(os.listdir(folder)))
        if wrong and keep:
            kept = Path(keep, str(seed))
            kept.mkdir(parents=True, exist_ok=True)
            for file in Path(folder).iterdir():
                if file.is_file():
                    (kept / file.name).write_bytes(file.read_bytes())
            (kept / "command").write_text(f"sweetspot {' '.join(args)}\n{wrong}\n")
    return wrong and f"seed {seed} ({good.name}): sweetspot {' '.join(args)}\n    {wrong}"


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--minutes", type=float, default=1.0)
    options.add_argument("--files", type=int, default=sys.maxsize, help="stop after so many, too")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--program", default=str(ROOT / "target/debug/sweetspot"))
    options.add_argument("--keep", help="a folder for the files that show something")
    given = options.parse_args()
    program = str(Path(given.program).resolve())
    end = time.monotonic() + 60 * given.minutes
    count, wrong = 0, []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        while time.monotonic() < end and count < given.files:
            seeds = range(given.seed * 10**9 + count, given.seed * 10**9 + count + 64)
            for found in pool.map(lambda seed: trial(program, seed, given.keep), seeds):
                count += 1
                if found:
                    wrong.append(found)
                    print(found, flush=True)
    print(f"{count} files, {len(wrong)} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
