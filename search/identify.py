#!/usr/bin/env python3
"""Random sets of responses with a known truth: does `sweetspot identify` find the modes, and do its intervals hold?

    search/identify.py --program target/debug/sweetspot --seed 1 --cases 200 [--masses] [--keep DIR] [--jobs 2]

A set is of a tapered beam in dense matrices of its own (Euler-Bernoulli, 48 elements, free ends, masses of 0.4 to 1.4 kg),
hung free, with 3 to 10 modes in the band and those beyond it. Loss factors are 0.002 to 0.03 and differ by 15 % from mode
to mode. In a fifth of the sets the beam has two planes whose stiffnesses differ by 2 %, a little more at one end than at
the other, and is struck between them: every mode has a twin 1 % apart. 6 to 24 points, the accelerometer at the tip and
the hammer roving, or the hammer at the tip and accelerometers in a row. A hammer of 0.1 to 0.3 kg with a tip of
2e5 to 2e7 N/m makes a half sine that tells what force each line has; white noise of -60 to -30 dB of the response's root mean
square is divided by it. Accelerance, mobility or receptance, in SI or in g, inches and pounds. Nothing of the program
is used to make them.

Found is a mode within 0.4 % of the frequency and with a MAC of 0.8 or more; false is one that is no such mode's.
"""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from bats import with_libraries

with_libraries(__file__)
import numpy as np

ELEMENTS = 48
POUND = 4.4482216152605
GRAVITY = 9.80665
KINDS = {"accelerance": (12, 2), "mobility": (11, 1), "receptance": (8, 0)}


def beam(length, mass, stiffness):
    """Dense M and K of linear mass per length and bending stiffness given at nodes."""
    h = length / ELEMENTS
    size = 2 * (ELEMENTS + 1)
    m, k = np.zeros((size, size)), np.zeros((size, size))
    for e in range(ELEMENTS):
        at = slice(2 * e, 2 * e + 4)
        rho, ei = 0.5 * (mass[e] + mass[e + 1]), 0.5 * (stiffness[e] + stiffness[e + 1])
        m[at, at] += rho * h / 420 * np.array([[156, 22*h, 54, -13*h], [22*h, 4*h*h, 13*h, -3*h*h],
                                               [54, 13*h, 156, -22*h], [-13*h, -3*h*h, -22*h, 4*h*h]])
        k[at, at] += ei / h**3 * np.array([[12, 6*h, -12, 6*h], [6*h, 4*h*h, -6*h, 2*h*h],
                                           [-12, -6*h, 12, -6*h], [6*h, 2*h*h, -6*h, 4*h*h]])
    return m, k


def modes_of(m, k):
    """Frequencies (Hz) and deflections for a modal mass of 1, the two rigid ones first, with a frequency of 0."""
    half = np.linalg.inv(np.linalg.cholesky(m))
    values, vectors = np.linalg.eigh(half @ k @ half.T)
    values[:2] = 0.0
    return np.sqrt(np.abs(values)) / (2 * math.pi), (half.T @ vectors)[::2]


def answers(every, row, watched, w2, mass):
    """Accelerances `row` (products of deflections, by mode) at complex squares `w2`, with a mass at every watched place.

    `H' = H (1 + m H_ww)^-1` between the force and the watched places, of all the modes.
    """
    def between(products):
        return sum(product[..., None] * (-w2 / ((2 * math.pi * f) ** 2 * (1 + 1j * loss) - w2)) for (f, loss, _), product in
                   zip(every, products))
    if not mass:
        return between(row)
    shapes = [shape[watched] for *_, shape in every]
    loaded = np.moveaxis(between([np.outer(s, s) for s in shapes]), -1, 0) * mass + np.eye(len(watched))
    if len(watched) == 1:
        return between(row) / loaded[:, 0, 0]
    return np.linalg.solve(loaded, between(row).T[:, :, None])[:, :, 0].T


def response_set(seed, masses=False):
    """A random set: its truth, its places, its responses as measured."""
    draw = np.random.default_rng(seed)
    uniform, log = draw.uniform, lambda a, b: math.exp(draw.uniform(math.log(a), math.log(b)))
    length, total = uniform(0.6, 1.1), uniform(0.4, 1.4)
    s = np.linspace(0, 1, ELEMENTS + 1)
    radius = 0.6 + uniform(0.1, 1.2) * s + uniform(-0.3, 0.3) * np.sin(math.pi * s) ** 2
    mass = radius**2
    mass *= total / (length * np.mean(mass))
    stiffness = radius**4
    first = uniform(90, 250)
    m, k = beam(length, mass, stiffness)
    stiffness = stiffness * (first / modes_of(m, k)[0][2]) ** 2
    twins = seed % 5 == 0 and not masses
    wanted = int(draw.integers(3, 11))
    eta = log(0.002, 0.03)
    planes = [(stiffness, 1.0)]
    if twins:
        angle = uniform(math.radians(25), math.radians(65))
        tilt = uniform(-0.4, 0.4)
        planes = [(stiffness, math.cos(angle) ** 2), (stiffness * (1.02 + 0.02 * tilt * (2 * s - 1)), math.sin(angle) ** 2)]
    count = (wanted + 1) // 2 if twins else wanted
    points = int(draw.integers(6, 25))
    places = np.sort(draw.choice(np.arange(1, ELEMENTS), points - 1, replace=False))
    places = np.append(places, ELEMENTS)
    truth, every, edges, beyond = [], [], [], []
    for stiff, share in planes:
        hz, shapes = modes_of(*beam(length, mass, stiff))
        for n, f in enumerate(hz):
            loss = eta * (1 + 0.15 * draw.standard_normal()) if f > 0 else 0.0
            loss = min(max(loss, 0.002), 0.03) if f > 0 else 0.0
            every.append((f, loss, math.sqrt(share) * shapes[:, n]))
            if 2 <= n < 2 + count:
                truth.append({"hz": f, "loss": loss, "shape": shapes[places, n]})
        beyond.append(hz[2 + count])
        edges.append([max(hz[1 + count], 0) , hz[2 + count]])
    low, high = max(e[0] for e in edges), min(e[1] for e in edges)
    top = low + uniform(0.3, 0.7) * (high - low)
    step = log(0.25, 1.0)
    step = max(step, top / 4000)
    step = float(f"{step:.3g}")  # what six digits of a file hold
    lines = np.arange(math.ceil(0.3 * first / step), math.floor(top / step)) * step
    extra = np.random.default_rng([seed, 1])
    mass = math.exp(extra.uniform(math.log(1e-3), math.log(0.02))) if masses else 0.0
    window = extra.uniform(0.17, 0.5) / step if masses and seed % 2 else 0.0
    hammer_roves = bool(extra.integers(0, 2)) if masses else None
    w2 = (2 * math.pi * lines - (1j / window if window else 0.0)) ** 2
    row = [shape[places] * shape[ELEMENTS] for *_, shape in every]
    exact = answers(every, row, [ELEMENTS] if hammer_roves else places, w2, mass)
    hammer, tip = uniform(0.1, 0.3), 2e5 * math.exp(uniform(0.0, 1.0) * math.log(100))
    near = 1 / (1 / hammer + 1 / 0.15)
    contact = math.pi * math.sqrt(near / tip)
    # A tip that does not reach the end of the band would be changed for a harder one.
    contact = min(contact, 1.3 / top)
    x = lines * contact
    force = np.abs(np.cos(math.pi * x) / (1 - (2 * x) ** 2 + 1e-9))
    level = uniform(-60, -30)
    size = np.sqrt(np.mean(np.abs(exact) ** 2, axis=1, keepdims=True)) * 10 ** (level / 20)
    noise = draw.standard_normal(exact.shape) + 1j * draw.standard_normal(exact.shape)
    measured = exact + size * noise / math.sqrt(2) / np.maximum(force, 0.05)
    kind = list(KINDS)[int(draw.integers(0, 3))]
    us, roves = bool(draw.integers(0, 2)), bool(draw.integers(0, 2))
    return {"seed": seed, "truth": truth, "x": places * length / ELEMENTS, "hz": lines, "step": step, "measured": measured,
            "kind": kind, "us": us, "hammer_roves": hammer_roves if masses else roves, "twins": twins,
            "level": level, "eta": eta, "mass": mass, "window": window, "beyond": beyond}


def universal(case):
    """The set as a universal file: nodes from 1 along x, the tip the last; dataset 58 in double precision."""
    out = ["    -1", "  2411"]
    for n, x in enumerate(case["x"], 1):
        out += [f"{n:10d}{0:10d}{0:10d}{0:10d}", f"{x:25.16E}{0.0:25.16E}{0.0:25.16E}"]
    out.append("    -1")
    quantity, power = KINDS[case["kind"]]
    values = case["measured"] / (2j * math.pi * case["hz"]) ** (2 - power)
    unit, per = {2: "m/s^2", 1: "m/s", 0: "m"}[power], "N"
    if case["us"]:
        unit, factor = {2: ("g", GRAVITY), 1: ("in/s", 0.0254), 0: ("in", 0.0254)}[power]
        per, values = "lbf", values / factor * POUND
    tip = len(case["x"])
    for n, row in enumerate(values, 1):
        response, reference = (tip, n) if case["hammer_roves"] else (n, tip)
        out += ["    -1", "    58", "response", "NONE", "NONE", "NONE", "NONE",
                f"{4:5d}{n:10d}{1:5d}{0:10d} {'NONE':10s}{response:10d}{2:4d} {'NONE':10s}{reference:10d}{2:4d}",
                f"{6:10d}{len(row):10d}{1:10d}{case['hz'][0]:13.5E}{case['step']:13.5E}{0.0:13.5E}",
                f"{18:10d}{0:5d}{0:5d}{0:5d} {'frequency':20s} {'Hz':20s}",
                f"{quantity:10d}{0:5d}{0:5d}{0:5d} {'answer':20s} {unit:20s}",
                f"{13:10d}{0:5d}{0:5d}{0:5d} {'force':20s} {per:20s}",
                f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20s} {'NONE':20s}"]
        numbers = np.column_stack([row.real, row.imag]).ravel()
        out += ["".join(f"{v:20.12E}" for v in numbers[k:k + 4]) for k in range(0, len(numbers), 4)]
        out.append("    -1")
    return "\n".join(out) + "\n"


def mac(a, b):
    return abs(np.vdot(a, b)) ** 2 / (np.vdot(a, a).real * np.vdot(b, b).real)


def scored(case, found):
    """Found modes beside true ones: which is which, and how far off."""
    pairs = [(abs(f["hz"] / t["hz"] - 1), i, j) for i, t in enumerate(case["truth"]) for j, f in enumerate(found)
             if abs(f["hz"] / t["hz"] - 1) < 0.004 and mac(t["shape"], f["shape"]) >= 0.8]
    mine, taken = {}, set()
    for _, i, j in sorted(pairs):
        if i not in mine and j not in taken:
            mine[i] = j
            taken.add(j)
    rows = []
    for i, j in mine.items():
        t, f = case["truth"][i], found[j]
        rows.append({"hz": f["hz"], "f": f["hz"] / t["hz"] - 1, "loss": f["loss"] / t["loss"] - 1, "mac": mac(t["shape"], f["shape"]),
                     "f_holds": f["hz95"][0] <= t["hz"] <= f["hz95"][1],
                     "loss_holds": f["loss95"][0] <= t["loss"] <= f["loss95"][1]})
    missed = [case["truth"][i]["hz"] for i in range(len(case["truth"])) if i not in mine]
    # Masses pull modes into the band that are beyond it without them.
    pulled = [hz for hz in case["beyond"] if case["mass"]]
    false = [f["hz"] for j, f in enumerate(found) if j not in taken and not any(abs(f["hz"] / hz - 1) < 0.02 for hz in pulled)]
    return {"rows": rows, "missed": missed, "false": false, "wanted": len(case["truth"]), "found": len(found)}


def told(name, all_scores):
    rows = [r for s in all_scores for r in s["rows"]]
    wanted, found = sum(s["wanted"] for s in all_scores), sum(s["found"] for s in all_scores)
    if not rows:
        return
    median = lambda key: np.median([abs(r[key]) for r in rows])
    worst = lambda key: np.quantile([abs(r[key]) for r in rows], 0.95)
    macs = [r["mac"] for r in rows]
    share = lambda key: 100 * np.mean([r[key] for r in rows])
    print(f"{name}: {len(all_scores)} sets, {wanted} modes: found {100 * len(rows) / wanted:.1f} %, "
          f"false {100 * sum(len(s['false']) for s in all_scores) / max(found, 1):.2f} %; f {100 * median('f'):.4f} % "
          f"(95 %: {100 * worst('f'):.3f}), loss factor {100 * median('loss'):.2f} % ({100 * worst('loss'):.1f}); "
          f"MAC {np.median(macs):.5f} (5 %: {np.quantile(macs, 0.05):.4f}; {100 * np.mean(np.array(macs) >= 0.98):.1f} % at least 0.98); "
          f"intervals hold {share('f_holds'):.1f} and {share('loss_holds'):.1f} %")


def identified(args, case, folder):
    path = folder / f"set{case['seed']}.uff"
    path.write_text(universal(case))
    told = [word for option, value, unit in (("--accelerometer", case["mass"], "kg"), ("--window", case["window"], "s"))
            if value for word in (option, f"{value!r} {unit}")]
    words = [args.program, "identify", str(path), *told, "--json", "-", "--quiet"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=900)
    if done.returncode not in (0, 1):
        print(f"seed {case['seed']}: {done.stderr.strip()}")
        return []
    modes = json.loads(done.stdout)["modes"]
    parts = lambda m: np.array([complex(p["re"], p["im"]) for p in m["shape"]])
    return [{"hz": m["frequency_hz"], "loss": 2 * m["damping_ratio"], "hz95": m["frequency_interval95_hz"],
             "loss95": [2 * d for d in m["damping_ratio_interval95"]], "shape": parts(m)} for m in modes]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--masses", action="store_true", help="with accelerometers that weigh, and windows")
    parser.add_argument("--keep", type=Path)
    parser.add_argument("-v", action="store_true", dest="verbose")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)

        def one(k):
            case = response_set(1000 * args.seed + k, args.masses)
            score = scored(case, identified(args, case, folder))
            if args.verbose or score["missed"] or score["false"]:
                hz = lambda all: ", ".join(f"{f:.1f}" for f in all) or "none"
                print(f"seed {case['seed']}: {case['level']:.0f} dB, loss factor {case['eta']:.4f}, twins {case['twins']}, "
                      f"{len(case['x'])} points, {score['wanted']} modes; missed {hz(score['missed'])}; false {hz(score['false'])}")
            return case, score

        with ThreadPoolExecutor(args.jobs) as pool:
            scores = list(pool.map(one, range(args.cases)))
    groups = {"all": lambda case: True, "twins": lambda case: case["twins"], "no twins": lambda case: not case["twins"]}
    if args.masses:
        groups = {"all": groups["all"], "one accelerometer": lambda case: case["hammer_roves"],
                  "accelerometers in a row": lambda case: not case["hammer_roves"], "window": lambda case: case["window"] > 0}
    for name, is_in in groups.items():
        told(name, [score for case, score in scores if is_in(case)])


if __name__ == "__main__":
    main()
