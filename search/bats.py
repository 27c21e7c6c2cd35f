#!/usr/bin/env python3
"""Random bats against exact modes: prints every false statement, exit 1 if there is one.

    search/bats.py --minutes 60 --program target/debug/sweetspot [--seed 1] [--kind whips] [-v]

The program solves each bat at a random tolerance in a random theory; `reference.py`, which shares
nothing with it, finds the modes. False is: a frequency, modal mass or node farther off than three
times its stated error; a mode that is missing or in the list by mistake; a tolerance said to be met
that is not. The bats are described in `random_bats.py`. The first run makes a venv beside this file
with python-flint and numpy from PyPI.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

HERE = Path(__file__).resolve().parent
ALWAYS, MOSTLY, VISIBLE = 3.0, 30.0, 1e-13


def with_libraries(script=__file__):
    """Runs that file again in a venv that has them."""
    try:
        import flint, numpy  # noqa: F401
        return
    except ImportError:
        pass
    folder = HERE / ".venv"
    python = folder / "bin" / "python"
    if os.environ.get("BATS_VENV"):
        sys.exit("python-flint and numpy could not be installed")
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        install = [python, "-m", "pip", "install", "--quiet", "python-flint", "numpy"]
        subprocess.run(install, check=True)
    os.execve(python, [str(python), script, *sys.argv[1:]], {**os.environ, "BATS_VENV": "1"})


def solved(program, bat, case):
    """The program's JSON, exit code and complaints."""
    command = [program, "modes", "/dev/stdin", "-n", str(case["modes"]), "--theory", case["theory"],
               "--shape-points", "0", "--json", "-", "--quiet"]
    if case.get("elements"):
        command += ["--elements", str(case["elements"]), "--degree", str(case["degree"])]
    else:
        command += ["--tol", repr(case["tolerance"])]
    done = subprocess.run(command, input=json.dumps(bat), capture_output=True, text=True,
                          timeout=300)
    answer = json.loads(done.stdout) if done.stdout.strip() else None
    return answer, done.returncode, done.stderr.strip()


def false_statements(answer, code, case, bat):
    """What is false, as sentences; the pairs of true and stated errors of frequencies and of nodes; the
    worst ratios."""
    from random_bats import exact
    said, pairs, near, worst = [], [], [], {"frequency": 0.0, "mass": 0.0, "nodes": 0.0}
    modes, rigid = answer["modes"], answer["rigid_modes"]
    if not modes:
        return said, pairs, near, worst
    reference = exact(bat, 1.3 * (2 * 3.141592653589793 * modes[-1]["frequency_hz"]) ** 2,
                      case["theory"])
    slowest = (2 * 3.141592653589793 * modes[0]["frequency_hz"]) ** 2
    found = reference.count(1e-9 * slowest)
    if found != rigid:
        said.append(f"{rigid} rigid motions, there are {found}")
        rigid = found
    length = reference.borders[-1]
    for k, mode in enumerate(modes, 1):
        if None in mode["error"].values():
            continue        # said to be unknown
        stated = mode["error"]["discretization"] + mode["error"]["round_off"]
        omega2 = (2 * 3.141592653589793 * mode["frequency_hz"]) ** 2
        off = ALWAYS * stated + 3e-16
        low, high = omega2 * max(1 - off, 0.0) ** 2, omega2 * (1 + off) ** 2
        below, above = reference.count(low), reference.count(high)
        if not below < k + rigid <= above:
            said.append(f"mode {k}, {mode['frequency_hz']} Hz within {stated:.1e}: in reach of "
                        f"three times that are modes {below - rigid + 1} to {above - rigid}")
            wide = 1e-9
            while reference.count(omega2 * (1 - min(wide, 0.99)) ** 2) >= k + rigid or \
                    (reference.count(min(omega2 * (1 + wide) ** 2, reference.most)) < k + rigid
                     and omega2 * (1 + wide) ** 2 < reference.most):
                wide *= 3
                if wide > 10:
                    break
            low, high = omega2 * (1 - min(wide, 0.99)) ** 2, min(omega2 * (1 + wide) ** 2, reference.most)
            if not reference.count(low) < k + rigid <= reference.count(high):
                continue
        truth = reference.mode(k + rigid, low, high)
        error = abs(mode["frequency_hz"] / truth["frequency"] - 1)
        pairs.append((error, stated))
        worst["frequency"] = max(worst["frequency"], (error - 2.3e-16) / stated if stated else 0.0)
        if code == 0 and "tolerance" in case and error > case["tolerance"] + 1e-15:
            said.append(f"mode {k}: 'met' {case['tolerance']:.1e}, true error {error:.1e}")
        off, own = abs(mode["modal_mass_kg"] / truth["mass"] - 1), mode["error"]["modal_mass"]
        worst["mass"] = max(worst["mass"], (off - 1e-13) / own if own else 0.0)
        if off > ALWAYS * own + 1e-13:
            said.append(f"mode {k}: modal mass {mode['modal_mass_kg']} within {own:.1e}, is "
                        f"{truth['mass']}: {off / own if own else 0:.1f} times")
        told = untold(mode, truth["nodes"])
        own, off = mode["error"]["nodes_m"], apart(mode["nodes_m"], told, length)
        near.append((off, own))
        worst["nodes"] = max(worst["nodes"], (off - 1e-12) / own if own else 0.0)
        if off > ALWAYS * own + 1e-12:
            nodes = [round(float(x), 9) for x in told]
            said.append(f"mode {k}: nodes {[round(x, 9) for x in mode['nodes_m']]} within "
                        f"{own:.1e} m, are {nodes}: {off:.1e} m off")
    return said, pairs, near, worst


def untold(mode, true):
    """The true nodes, less those that the mode says it cannot tell and does not list."""
    left = [float(x) for x in true]
    stretches = mode.get("nodes_untold_m", [])
    spare = [x for x in left if any(a <= x <= b for a, b in stretches)]
    for x in mode["nodes_m"]:
        if not left:
            break
        nearest = min(left, key=lambda y: abs(x - y))
        left.remove(nearest)
    return sorted(x for x in true if not (x in left and x in spare))


def apart(own, true, length):
    """The farthest that a node is from one of the other list; from the nearest end where two lists
    are of different length, because a node enters there, or where two of them meet."""
    if len(own) == len(true):
        return max((abs(a - b) for a, b in zip(own, true)), default=0.0)
    few, many = sorted([list(own), list(true)], key=len)
    spare = []
    for x in many:
        others = [abs(x - y) for y in few] + [x, length - x]
        others += [abs(x - y) / 2 for y in many if y != x]
        spare.append(min(others))
    return max(spare, default=0.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=1.0)
    parser.add_argument("--program", default=str(HERE.parent / "target" / "debug" / "sweetspot"))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=10**9, help="as many bats at most")
    parser.add_argument("--kind", help="only bats of this kind; \"hard\": of all that are hard")
    parser.add_argument("-v", "--verbose", action="store_true")
    asked = parser.parse_args()
    with_libraries()
    sys.path.insert(0, str(HERE))
    from random_bats import random_case
    started, count, false, refused, broken = time.time(), 0, 0, 0, 0
    pairs, near, worst = [], [], {"frequency": 0.0, "mass": 0.0, "nodes": 0.0}
    seed, used = asked.seed, 0.0
    while time.time() - started < 60 * asked.minutes and count < asked.cases:
        bat, case = random_case(seed, asked.kind, lambda bat, case: solved(asked.program, bat, case))
        name, seed = f"bat {seed} ({case['kind']}, {case['theory']}, {case['modes']} modes, " \
                     f"{case.get('tolerance', case.get('elements'))})", seed + 1
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        answer, code, complaint = solved(asked.program, bat, case)
        used += resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        count += 1
        if answer is None or code == 3:
            refused += 1
            print(f"{name}: exit {code}, {complaint[-200:]}", flush=True)
            if answer is None:
                continue
        try:
            said, own, around, ratios = false_statements(answer, code, case, bat)
        except ArithmeticError as error:
            print(f"{name}: no reference, {error}")
            continue
        pairs, near = pairs + own, near + around
        for key, ratio in ratios.items():
            worst[key] = max(worst[key], ratio)
        if asked.verbose:
            print(name, code, {key: round(float(ratio), 2) for key, ratio in ratios.items()}, flush=True)
        if said:
            false, broken = false + 1, broken + len(said)
            print(f"FALSE: {name}\n  " + "\n  ".join(said))
            print("  " + json.dumps(bat), flush=True)
    visible = [(error, stated) for error, stated in pairs if error > VISIBLE]
    close = sum(stated <= MOSTLY * error for error, stated in visible)
    print(f"{count} bats, {len(pairs)} modes: {false} bats with {broken} false statements, "
          f"{refused} not solved to the tolerance, {used:.1f} s of processor time")
    print("largest true over stated error: " +
          ", ".join(f"{key} {ratio:.2f}" for key, ratio in worst.items()))
    print(f"stated within 30 times the true error: {close} of {len(visible)} frequencies")
    usual = [stated / error for error, stated in visible]
    nodes = [stated / off for off, stated in near if stated and off > 1e-12]
    print(f"median of stated over true error: frequencies {median(usual or [0]):.3g}, "
          f"nodes {median(nodes or [0]):.3g}")
    return 1 if false else 0


if __name__ == "__main__":
    sys.exit(main())
