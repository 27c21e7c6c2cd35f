#!/usr/bin/env python3
"""Random bats on the lathe: do the derivatives of what is searched along the bat hold what they state?

The truth is a difference of whole bats: each is written as a file of its own, with a band turned down or
up by 40, 80 and 160 um of diameter, and solved by `sweetspot hit --tol 1e-7`, whose search shares neither
elements nor places nor formula with `sweetspot lathe`. From the three steps comes a value and how well it is known.
A finite cut that the answer states is compared with the same cut, written as a file too.

    python3 search/derivatives.py --minutes 20 [--seed N] [--program target/debug/sweetspot]

False is a derivative beyond three times its stated error of the truth, and a finite cut that is another by more
than 2 % and more than the values' errors, unless `not_smooth_at` names the output. Python 3.9 is all it needs."""

import argparse
import json
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
MM = 1e-3
STEPS = [4e-5, 8e-5, 1.6e-4]
CUT = 5e-4
# Names in the map, and where they stand in the hit's sweet spot.
PLACES = {
    "exit_speed_max.value": ("exit_speed_max", "value"),
    "exit_speed_max.x_m": ("exit_speed_max", "x_m"),
    "zone_m[0]": ("zone_m", 0),
    "zone_m[1]": ("zone_m", 1),
    "vibration_min.value": ("vibration_min", "value"),
    "vibration_min.x_m": ("vibration_min", "x_m"),
    "hands_velocity_min.value": ("hands_velocity_min", "value"),
    "hands_acceleration_min.value": ("hands_acceleration_min", "value"),
}


def draw(rng):
    """A solid bat of straight pieces, free or held, its theory, scene and band."""
    length = round(rng.uniform(0.6, 0.95), 3)
    inner = sorted(round(rng.uniform(0.04, 0.96) * length, 3) for _ in range(rng.randint(2, 5)))
    x = [0.0] + [b for a, b in zip([0.0] + inner, inner) if b - a > 0.02 and length - b > 0.02]
    x.append(length)
    thin, thick = rng.uniform(0.022, 0.032), rng.uniform(0.045, 0.068)
    rise = rng.uniform(2.0, 12.0)
    middle = rng.uniform(0.35, 0.7) * length
    curve = lambda s: thin + (thick - thin) / (1 + math.exp(-rise * (s - middle) / length))
    diameter = [round(curve(s) * rng.uniform(0.96, 1.04), 5) for s in x]
    young = rng.uniform(8e9, 18e9)
    bat = {
        "format": "sweetspot-bat/1", "name": "random", "source": "random",
        "material": {"density": round(rng.uniform(550, 850)), "youngs_modulus": round(young),
                     "shear_modulus": round(young / rng.uniform(10, 20)),
                     "loss_factor": rng.choice([0.0, 0.01, 0.02])},
        "profile": {"interpolation": "linear", "unit": "m", "x": x, "diameter": diameter},
    }
    hold = rng.choice(["free", "free", "free", "grip", "grip", "clamped", "pinned"])
    if hold == "grip":
        stiff = 10 ** rng.uniform(3.5, 6)
        bat["grip"] = {"from": 0, "to": 0.15, "stiffness": float(f"{stiff:.3g}")}
    elif hold != "free":
        bat["supports"] = [{"x": round(rng.uniform(0.0, 0.15), 3), "type": hold}]
    theory = rng.choice(["euler-bernoulli", "rayleigh", "timoshenko"])
    options = ["--theory", theory, "--pitch", f"{rng.uniform(15, 45):.1f} m/s"]
    options += ["--swing-speed", f"{rng.uniform(20, 60):.1f} rad/s"]
    if rng.random() < 0.3:
        options += ["--cor", f"{rng.uniform(0.3, 0.65):.2f}"]
    begin = round(rng.uniform(0.02, 0.85) * length, 3)
    end = round(min(length - 0.005, begin + rng.uniform(0.025, 0.12)), 3)
    return bat, hold, options, [begin, end]


def turned(bat, band, by):
    """The bat with its diameter smaller by `by` (m) over the band."""
    x, diameter = bat["profile"]["x"], bat["profile"]["diameter"]

    def at(s):
        k = max(k for k in range(len(x) - 1) if x[k] <= s)
        return diameter[k] + (diameter[k + 1] - diameter[k]) * (s - x[k]) / (x[k + 1] - x[k])

    begin, end = band
    inside = [(s, d - by) for s, d in zip(x, diameter) if begin < s < end]
    rows = [(s, d) for s, d in zip(x, diameter) if s < begin] + [(begin, at(begin))]
    rows += [(begin, at(begin) - by), *inside, (end, at(end) - by), (end, at(end))]
    rows += [(s, d) for s, d in zip(x, diameter) if s > end]
    profile = {**bat["profile"], "x": [s for s, _ in rows], "diameter": [d for _, d in rows]}
    return {**bat, "profile": profile}


class Bench:
    """Runs the program."""

    def __init__(self, program, folder):
        self.program, self.folder, self.spent = program, pathlib.Path(folder), 0.0

    def run(self, verb, bat, options):
        path = self.folder / "bat.json"
        path.write_text(json.dumps(bat))
        command = [self.program, verb, str(path), *options, "--json", "-", "--quiet"]
        began = os.times().children_user
        done = subprocess.run(command, capture_output=True, text=True)
        if verb == "lathe":
            self.spent += os.times().children_user - began
        if done.returncode not in (0, 3):
            return done.returncode, None
        return done.returncode, json.loads(done.stdout)

    def places(self, bat, options):
        """What the map's outputs are, by a search along that bat alone."""
        more = ["--tol", "1e-7", "--at", str(0.8 * bat["profile"]["x"][-1])]
        _, found = self.run("hit", bat, options + more)
        spot = found and found["sweet_spot"]

        def one(name, key):
            where = spot and spot[name]
            return None if where is None else where[key]

        return {known: one(*keys) for known, keys in PLACES.items()}


def differences(bench, bat, options, band):
    """Each output's derivative (per mm taken off), how well it is known, and its change by the finite cut."""
    now = bench.places(bat, options)
    pairs = []
    for step in STEPS:
        thin, thick = (bench.places(turned(bat, band, by), options) for by in (step, -step))
        pairs.append((step, thin, thick))
    cut = bench.places(turned(bat, band, CUT), options)
    for name in PLACES:
        every = [now[name], cut[name]] + [d[name] for _, *both in pairs for d in both]
        if any(value is None for value in every):
            continue
        central = [(thin[name] - thick[name]) / (2 * step) for step, thin, thick in pairs]
        fine, rough = ((4 * a - b) / 3 for a, b in zip(central, central[1:]))
        # Two steps of the fourth order, and what the search leaves of a place or value.
        floor = 2e-8 * (1 if name.endswith(("x_m", "]")) else abs(now[name]))
        known = abs(fine - rough) + floor / STEPS[0]
        yield name, now[name], fine * MM, known * MM, (cut[name] - now[name]) / CUT * MM


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first bat")
    parser.add_argument("--bats", type=int, default=10**9)
    parser.add_argument("--program", default=str(ROOT / "target/debug/sweetspot"))
    arguments = parser.parse_args()
    end = time.time() + 60 * arguments.minutes
    seen = silent = short = asked = 0
    false, worst, ratios, jumps = [], {}, [], 0
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(arguments.program, folder)
        number = arguments.first
        while time.time() < end and asked < arguments.bats:
            rng = random.Random(f"{arguments.seed} {number}")
            number += 1
            bat, hold, options, band = draw(rng)
            more = ["--bands", f"{band[0]} m to {band[1]} m", "--outputs", ",".join(PLACES)]
            code, answer = bench.run("lathe", bat, options + more)
            asked += 1
            short += code == 3
            if answer is None:
                print("no answer", code, number - 1, flush=True)
                continue
            [found] = answer["bands"]
            not_smooth = {row["name"] for row in answer["not_smooth_at"]}
            errors = {row["name"]: row["error"] or 0.0 for row in answer["outputs"]}
            values = {row["name"]: row["value"] for row in answer["outputs"]}
            for name, value, truth, known, cut in differences(bench, bat, options, band):
                said = found["change"][name]
                silent += said is None
                jumps += name in not_smooth
                where = f"{arguments.seed} {number - 1} {hold} {' '.join(options)} {band} {name}"
                if said is not None:
                    seen += 1
                    stated, off = found["error"][name], abs(said - truth)
                    ratio = max(0.0, off - 3 * known) / (stated + 1e-9 * abs(said) + 1e-300)
                    if off > 3 * known:
                        ratios.append(stated / off)
                    if name not in not_smooth and ratio > worst.get(name, (0.0,))[0]:
                        worst[name] = (ratio, where)
                    if ratio > 3 and name not in not_smooth:
                        false.append(where)
                        print(f"off {off:.1e}, stated {stated:.1e}, known {known:.0e}, "
                              f"{said:.5g} for {truth:.5g}: {where}", flush=True)
                finite = found["finite"] and found["finite"][name]
                if finite is not None and name not in not_smooth:
                    near = 2 * (errors[name] + abs(values[name] - value)) * MM / CUT
                    apart = abs(finite - cut)
                    if apart > near + 0.02 * abs(cut) + 1e-6 * abs(value):
                        false.append(where)
                        print(f"finite cut {finite:.5g} for {cut:.5g}: {where}", flush=True)
    median = statistics.median(ratios) if ratios else math.nan
    for name, (ratio, where) in sorted(worst.items()):
        print(f"{name}: worst true/stated {ratio:.2f}: {where}")
    print(f"{asked} bats, {seen} derivatives, {len(false)} false, {silent} without, {jumps} not "
          f"smooth, median stated/true {median:.2f} of {len(ratios)}, {short} with exit 3, "
          f"{bench.spent:.1f} s in lathe")
    return 1 if false else 0


if __name__ == "__main__":
    sys.exit(main())
