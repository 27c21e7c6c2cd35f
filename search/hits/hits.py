#!/usr/bin/env python3
"""Random hits: does the program say how far its exit speeds are from the truth?

The truth is `reference.c`, Taylor series of ball and modes until the ball is gone for
good, with so many modes and the static flexibility of the others (`bats.py`) that what is left out
is below 1e-9 of the closing speed or said. Nothing of src/collision is used.

    python3 search/hits/hits.py --minutes 60 [--seed N] [--program target/debug/sweetspot] [--stiff]
        new hits until then; every hit with an error beyond three times the stated one is printed,
        with the command that shows it; exit code 1 if there was one. --stiff: of balls up to a hundred
        times as hard as a baseball, which leave before the bat's slower modes have moved

    python3 search/hits/hits.py --write validation/hits/hits.json --bats 44 --seed 16
        draws the hits that `sweetspot validate --promise` looks at, and their exit speeds

    python3 search/hits/hits.py --peaks
        the largest exit speeds of a dowel and a cone, which tests/contact.rs has

Python 3.9 and a C compiler are all it needs."""

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
from concurrent.futures import ThreadPoolExecutor

from bats import ROOT, SHAPE_POINTS, Bat, draw

FOLDER = pathlib.Path(__file__).resolve().parent
MODES = {"euler-bernoulli": 80, "rayleigh": 90, "timoshenko": 160}
# Of the modes left out: sum(c/w^2)/sum(c/w^4) over the square of the last one's w. Gains stay and
# frequencies rise as n^2; fall and rise as n^-2 and n; stay and rise as n.
BEYOND = {"euler-bernoulli": 7 / 3, "rayleigh": 5 / 3, "timoshenko": 3.0}


def scene(rng, bat, stiff=False):
    """A random place, swing, pitch, ball and wall."""
    share = round(rng.uniform(0.5, 1.0) if rng.random() < 0.85 else rng.uniform(0.1, 0.5), 4)
    share = round(share * (SHAPE_POINTS - 1)) / (SHAPE_POINTS - 1)
    mass = rng.uniform(0.13, 0.2)
    exponent = rng.choice([1.0, 1.5, 1.84, rng.uniform(1.0, 2.2)])
    deep = 0.004 * (0.03 / 0.004) ** rng.random()
    if stiff:
        deep = 0.0002 * (0.004 / 0.0002) ** rng.random()
    stiffness = 0.5 * (1 + exponent) * mass * 45.0**2 / deep ** (1 + exponent)
    cor = rng.choice([0.5, rng.uniform(0.05, 1.0), rng.uniform(0.3, 0.7)])
    if exponent == 1.0 and rng.random() < 0.5:
        # A linear ball that ends where its force ends: what the file's damping_ratio stands for.
        ratio = rng.uniform(0.0, 0.5)
        cor = math.exp(-2 * ratio * math.acos(ratio) / math.sqrt(1 - ratio * ratio))
    at_rest = rng.random() < 0.15
    hit = {
        "x": share * bat.length,
        "swing": 0.0 if at_rest or bat.support and rng.random() < 0.5 else rng.uniform(5, 70),
        "pivot": rng.uniform(-0.1, 0.3),
        "pitch": 60.0 ** rng.random(),
        "mass": mass,
        "stiffness": stiffness,
        "exponent": exponent,
        "cor": cor,
        "tolerance": rng.choice([1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8]),
    }
    if rng.random() < 0.15:
        hit["modes"] = rng.randint(1, 14)
    if rng.random() < 0.15:
        hit["wall_stiffness"] = 10 ** rng.uniform(6, 8)
        if rng.random() < 0.5:
            hit["wall_mass"] = 10 ** rng.uniform(-2.3, -0.5)
    # Three digits are enough of a random number.
    return share, {k: v if k in ("x", "modes") else float(f"{v:.4g}") for k, v in hit.items()}


def line(bat, modes, count, share, hit, exactly, faster=1.0):
    """The hit as reference.c reads it, with that many modes and one for all others."""
    omega, gain = modes
    gains = [gain(n, share) for n in range(count)]
    rest = 0.0
    if not exactly:
        taken = sum(g / w**2 for g, w in zip(gains, omega))
        rest = max(0.0, bat.flexibility(hit["x"]) - taken)
    rows = [(w, bat.damping, g) for w, g in zip(omega, gains)]
    if rest > 0:
        # One mode for all of them, as soft as they are and about as fast.
        square = BEYOND[bat.theory] * omega[count - 1] ** 2
        rows.append((math.sqrt(square), bat.damping, rest * square))
        rest = 0.0
    if "wall_mass" in hit:
        rows.append((math.sqrt(hit["wall_stiffness"] / hit["wall_mass"]), 0.0, 1 / hit["wall_mass"]))
    elif "wall_stiffness" in hit:
        rest += 1 / hit["wall_stiffness"]
    inverse = 1 / hit["mass"] + bat.recoil(hit["x"])
    speed = faster * closing(hit)
    head = [len(rows), inverse, rest, hit["stiffness"], hit["exponent"], hit["cor"], speed]
    return "\n".join(" ".join(repr(v) for v in row) for row in [head, *rows])


def closing(hit):
    return hit["swing"] * (hit["x"] + hit["pivot"]) + hit["pitch"]


def truths(program, bat, modes, drawn):
    """Exit speeds from the reference, how well they are known, and what happened."""
    NUDGE = 1e-9
    text = []
    for share, hit in drawn:
        exactly = "modes" in hit
        full = hit.get("modes", len(modes[0]))
        fewer = full if exactly else 7 * full // 10
        text.append(line(bat, modes, full, share, hit, exactly))
        text.append(line(bat, modes, fewer, share, hit, exactly))
        text.append(line(bat, modes, fewer, share, hit, exactly, 1 + NUDGE))
    done = subprocess.run([program], input="\n".join(text), capture_output=True, text=True)
    rows = [[float(v) for v in row.split()] for row in done.stdout.splitlines()]
    if len(rows) != len(text):
        raise RuntimeError(f"the reference ended early: {done.returncode}")
    for k, (_, hit) in enumerate(drawn):
        (found, first, lasts, touches, reloads, off, _), fewer, nudged = rows[3 * k : 3 * k + 3]
        u, m = closing(hit), hit["mass"]
        # Damping's own loss is not added up: what it leaves open is not known.
        known = math.isfinite(found) and math.isfinite(fewer[0]) and math.isfinite(nudged[0])
        if not known or abs(off) > 1e-11:
            yield hit, None
            continue
        magnified = abs(nudged[0] - fewer[0] * (1 + NUDGE)) / (m * u * NUDGE)
        yield hit, {
            "exit_speed": found / m - hit["pitch"],
            "first_exit_speed": first / m - hit["pitch"],
            "known_to": abs(fewer[0] - found) / (m * u) + 3e-15 * magnified + 1e-13,
            "sensitivity": magnified,
            "contacts": int(touches),
            "reloads": int(reloads),
            "imbalance": off,
        }


def peaks(program, reference):
    """Largest exit speed, and where (share of the length), of 15 modes and nothing else: a quartic
    through five places about the best of a fine grid."""
    report = {"density": 0.0257 * 0.45359237 / 0.0254**3,
              "youngs_modulus": 2.02e6 * 0.45359237 * 9.80665 / 0.0254**2}
    ash = {"density": 711.0, "youngs_modulus": 13.9e9}
    for name, diameter, wood in [("dowel", [1.6777 * 0.0254] * 2, report),
                                 ("cone", [0.025, 0.066], ash)]:
        x = [0.0, 0.8382]
        profile = {"interpolation": "linear", "x": x, "diameter": diameter}
        text = {"format": "sweetspot-bat/1", "name": name, "material": wood, "profile": profile}
        bat = Bat(text, "euler-bernoulli")
        modes = bat.modes(program, 15)
        for swing in (40.0, 50.0, 60.0):
            hit = {"swing": swing, "pivot": 0.0635, "pitch": 40.2336, "stiffness": 1e7}
            hit |= {"mass": 5.0 * 0.028349523125, "exponent": 1.5, "cor": 0.5, "modes": 15}
            grid = [k / (SHAPE_POINTS - 1) for k in range(300, SHAPE_POINTS)]
            drawn = [(share, {**hit, "x": share * bat.length}) for share in grid]
            found = [truth["exit_speed"] for _, truth in truths(reference, bat, modes, drawn)]
            k = min(max(found.index(max(found)), 2), len(grid) - 3)

            def at(share):
                value = 0.0
                for i in range(k - 2, k + 3):
                    weight = found[i]
                    for j in range(k - 2, k + 3):
                        weight *= 1 if i == j else (share - grid[j]) / (grid[i] - grid[j])
                    value += weight
                return value

            steps = [grid[k - 1] + n / 1e4 * (grid[k + 1] - grid[k - 1]) for n in range(10001)]
            best = max(steps, key=at)
            print(f"{name} {swing} {best:.6f} {at(best):.6f}")


def build(folder):
    program = pathlib.Path(folder) / "reference"
    command = ["cc", "-O3", "-march=native", "-fassociative-math", "-fno-signed-zeros",
               "-fno-trapping-math", "-o", str(program), str(FOLDER / "reference.c"), "-lm"]
    subprocess.run(command, check=True)
    return str(program)


def hits(seed, program, reference, count, stiff=False):
    """The random bat of that seed, and random hits of it with their truths."""
    rng = random.Random(seed)
    text, theory = draw(rng)
    bat = Bat(text, theory)
    modes = bat.modes(program, MODES[theory])
    drawn = []
    while len(drawn) < count:
        share, hit = scene(rng, bat, stiff)
        # A light tip gives way without end; a pin does not at all.
        if closing(hit) > 0.5 and bat.outer(hit["x"]) > 0.01 and bat.recoil(hit["x"]) < 1e3:
            if not bat.support or hit["x"] > bat.support[1] + 0.05:
                drawn.append((share, hit))
    return text, theory, list(truths(reference, bat, modes, drawn))


def write(path, arguments, reference):
    bats, lines = [], []
    one = lambda k: hits(f"{arguments.seed} {k}", arguments.program, reference, arguments.hits)
    for text, theory, found in ThreadPoolExecutor(os.cpu_count()).map(one, range(arguments.bats)):
        for hit, truth in found:
            if truth is None:
                continue
            row = {"bat": len(bats), "theory": theory, **hit}
            row |= {k: v for k, v in truth.items() if k != "imbalance"}
            row["known_to"] = float(f"{row['known_to']:.2g}")
            row["sensitivity"] = float(f"{row['sensitivity']:.2g}")
            lines.append(json.dumps(row))
        bats.append(json.dumps(text))
        print(f"{len(bats)} bats, {len(lines)} hits: {text['name']}, {theory}", file=sys.stderr)
    source = (
        f"python3 search/hits/hits.py --write validation/hits/hits.json --bats {arguments.bats} "
        f"--hits {arguments.hits} --seed {arguments.seed}: random bats and hits, exit speeds by "
        "Taylor series (search/hits/reference.c). SI units; exit_speed when the ball "
        "is gone for good; known_to of the closing speed; sensitivity: what a change of the closing "
        "speed is magnified by beyond proportion."
    )
    body = '{\n"source": %s,\n"bats": [\n%s\n],\n"hits": [\n%s\n]\n}\n'
    path.write_text(body % (json.dumps(source), ",\n".join(bats), ",\n".join(lines)))


def asked(program, folder, text, theory, hit):
    """The program's command for a hit, and its answer."""
    bat, ball = folder / "bat.json", folder / "ball.json"
    bat.write_text(json.dumps(text))
    keys = ("mass", "stiffness", "exponent", "cor")
    ball.write_text(json.dumps({"format": "sweetspot-ball/1", "name": "ball", "source": "random",
                                "radius": 0.0366, **{k: hit[k] for k in keys}}))
    command = [program, "hit", str(bat), "--ball", str(ball), "--at", repr(hit["x"])]
    command += ["--swing-speed", f"{hit['swing']} rad/s", f"--pivot={hit['pivot']} m"]
    command += ["--pitch", f"{hit['pitch']} m/s", "--theory", theory, "--json", "-", "--quiet"]
    command += ["--tol", repr(hit["tolerance"])]
    if "wall_stiffness" not in hit:
        command += ["--wall", "off"]  # the reference knows no hoop modes
    for key, option in [("modes", "--modes"), ("wall_stiffness", "--wall-stiffness"),
                        ("wall_mass", "--wall-mass")]:
        command += [option, repr(hit[key])] if key in hit else []
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        return command, done.returncode, None
    return command, done.returncode, json.loads(done.stdout)["impacts"][0]


def search(arguments, reference):
    """Until the time is over; whether nothing false was found."""
    end, seen, close, visible, broken = time.time() + 60 * arguments.minutes, 0, 0, 0, 0
    worst, worst_first, apart, bat, short, ratios, spent = 0.0, 0.0, 0, 0, 0, [], 0.0
    with tempfile.TemporaryDirectory() as folder:
        while time.time() < end:
            seed, bat = f"{arguments.seed} {bat}", bat + 1
            text, theory, found = hits(
                seed, arguments.program, reference, arguments.hits, arguments.stiff)
            for hit, truth in found:
                if truth is None:
                    continue
                began = os.times()
                command, code, impact = asked(
                    arguments.program, pathlib.Path(folder), text, theory, hit)
                ended = os.times()
                spent += ended.children_user - began.children_user
                seen, short = seen + 1, short + (code == 3)
                stated = impact and impact["error"] and impact["error"]["exit_speed"]
                if stated is None:
                    # An answer that is refused says nothing false.
                    print("no answer", code, json.dumps(text), json.dumps(hit))
                    continue
                off = abs(impact["exit_speed_m_s"] - truth["exit_speed"]) / closing(hit)
                sure = max(0.0, off - truth["known_to"])
                ratio = sure / (stated + 1e-14)
                worst = max(worst, ratio)
                if off > 3 * truth["known_to"] and off > 1e-13:
                    visible += 1
                    close += stated <= 30 * off
                    ratios.append(stated / off)
                first = impact["first_separation"]
                first_off = abs(first["exit_speed_m_s"] - truth["first_exit_speed"]) / closing(hit)
                first_sure = max(0.0, first_off - truth["known_to"])
                first_ratio = first_sure / (first["exit_speed_error"] + 1e-14)
                worst_first = max(worst_first, first_ratio)
                # A touch or a reload of next to no force is one thing or the other.
                happened = {"second_contact": truth["contacts"] > 1, "reload": truth["reloads"] > 0}
                told = {flag: flag in impact["flags"] for flag in happened}
                if told != happened:
                    apart += 1
                    print(f"told {told}, happened {happened}:", " ".join(command[1:]))
                    print(" ", json.dumps(text))
                    print(" ", json.dumps(hit), json.dumps(truth), impact["flags"], flush=True)
                if first_ratio > 3:
                    print(f"first separation off by {first_off:.2e}, stated {first['exit_speed_error']:.2e}")
                if max(ratio, first_ratio) > 3 or (code == 0 and stated > hit["tolerance"]):
                    broken += 1
                    print(f"off by {off:.2e}, stated {stated:.2e}:", " ".join(command[1:]))
                    print(" ", json.dumps(text))
                    print(" ", json.dumps(hit), json.dumps(truth), flush=True)
            median = statistics.median(ratios) if ratios else math.nan
            print(f"{seen} hits, {broken} broken, worst true/stated {worst:.2f} "
                  f"(first separation {worst_first:.2f}), {apart} with other touches or reloads, "
                  f"{close} of {visible} stated within 30 times, median stated/true {median:.2f}, "
                  f"{short} with exit 3, {spent:.1f} s", file=sys.stderr)
    return broken == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--seed", type=int, default=16)
    parser.add_argument("--bats", type=int, default=44)
    parser.add_argument("--hits", type=int, default=10, help="hits of each bat")
    parser.add_argument("--write", type=pathlib.Path, metavar="FILE")
    parser.add_argument("--peaks", action="store_true")
    parser.add_argument("--stiff", action="store_true")
    parser.add_argument("--program", default=str(ROOT / "target/debug/sweetspot"))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        reference = build(folder)
        if arguments.peaks:
            peaks(arguments.program, reference)
            return 0
        if arguments.write:
            write(arguments.write, arguments, reference)
            return 0
        return 0 if search(arguments, reference) else 1


if __name__ == "__main__":
    sys.exit(main())
