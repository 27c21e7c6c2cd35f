#!/usr/bin/env python3
"""Random free tubes: do the hoop modes hold what they state?

A tube of one wall is solved by `sweetspot hoop` at random tolerances and by Ritz's method: products of Legendre
polynomials over the whole tube, a degree along and one across, even and odd motions apart. Its frequencies are
bounds from above; those of a lower degree say how near. Nothing of src/modes/hoop is used.

    search/hoops.py --minutes 20 [--seed N] [--program target/debug/sweetspot]

False is a frequency beyond three times its stated error of the truth, and a tolerance that is said to be met and is
not. Python 3.9 and numpy are all it needs."""

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

import numpy
from numpy.polynomial import legendre

ROOT = pathlib.Path(__file__).resolve().parent.parent


def basis(degrees, points):
    """Legendre polynomials, normed, and their slopes at points of [-1, 1]."""
    rows = []
    for k in degrees:
        one = numpy.zeros(k + 1)
        one[k] = math.sqrt(k + 0.5)
        rows.append((legendre.legval(points, one), legendre.legval(points, legendre.legder(one))))
    return [numpy.array([row[d] for row in rows]).T for d in (0, 1)]


def ritz(tube, n, along, across, count):
    """The lowest frequencies (Hz) of harmonic n of a free tube."""
    length, inner, outer, young, nu, density = tube
    lame, shear = young * nu / (1 + nu) / (1 - 2 * nu), young / (2 + 2 * nu)
    s, ws = legendre.leggauss(along + 2)
    t, wt = legendre.leggauss(across + 6)
    radius = 0.5 * (inner + outer) + 0.5 * (outer - inner) * t
    weight_x, weight_r = 0.5 * length * ws, 0.5 * (outer - inner) * wt * radius
    f, f_r = basis(range(across + 1), t)
    f_r = f_r * 2 / (outer - inner)
    by_r = f / radius[:, None]
    found = []
    for parity in (0, 1):
        # U and V are even and W is odd, or the other way.
        sides = [range(parity, along + 1, 2), range(1 - parity, along + 1, 2)]
        g, g_x = zip(*(basis(side, s) for side in sides))
        g_x = [one * 2 / length for one in g_x]
        u, v, w = (0, g[0], g_x[0]), (1, g[0], g_x[0]), (2, g[1], g_x[1])
        strains = [
            [(u, 1, f_r)],
            [(u, 1, by_r), (v, 1, n * by_r)],
            [(w, 2, f)],
            [(u, 2, f), (w, 1, f_r)],
            [(v, 1, f_r - by_r), (u, 1, -n * by_r)],
            [(v, 2, f), (w, 1, -n * by_r)],
        ]
        sizes = [g[0].shape[1] * (across + 1)] * 2 + [g[1].shape[1] * (across + 1)]
        starts = numpy.cumsum([0] + sizes)
        stiff, mass = numpy.zeros((2, starts[3], starts[3]))

        def add(matrix, a, b, factor):
            (one, i, p), (other, j, q) = a, b
            left = one[i].T @ (weight_x[:, None] * other[j])
            right = p.T @ (weight_r[:, None] * q)
            rows, columns = (slice(starts[c[0]], starts[c[0] + 1]) for c in (one, other))
            matrix[rows, columns] += factor * numpy.kron(left, right)

        for i in range(6):
            for j in range(6):
                factor = lame * (i < 3 and j < 3) + (i == j) * (2 * shear if i < 3 else shear)
                if factor:
                    for a in strains[i]:
                        for b in strains[j]:
                            add(stiff, a, b, factor)
        for c in (u, v, w):
            add(mass, (c, 1, f), (c, 1, f), density)
        root = numpy.linalg.cholesky(mass)
        half = numpy.linalg.solve(root, stiff)
        both = numpy.linalg.solve(root, half.T)
        squares = numpy.linalg.eigvalsh(0.5 * (both + both.T))
        found += [math.sqrt(max(0.0, square)) / (2 * math.pi) for square in squares[: count + 1]]
    return sorted(found)[:count]


def draw(rng):
    """A tube: length, radii, E, Poisson's ratio, density."""
    radius = rng.uniform(0.012, 0.035)
    wall = radius * rng.uniform(0.08, 0.3)
    nu = rng.choice([0.45, 0.49, rng.uniform(0.0, 0.49), rng.uniform(0.3, 0.49)])
    tube = [radius * rng.uniform(1.5, 4), radius - wall, radius, 7e10 * rng.uniform(0.1, 3), nu]
    return [float(f"{value:.6g}") for value in tube] + [2700.0]


def written(tube):
    length, inner, outer, young, nu, density = tube
    profile = {"interpolation": "linear", "x": [0.0, length], "radius": [outer] * 2,
               "inner_radius": [inner] * 2}
    material = {"density": density, "youngs_modulus": young, "poisson_ratio": nu}
    return {"format": "sweetspot-bat/1", "name": "tube", "material": material, "profile": profile}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tubes", type=int, default=10**9)
    parser.add_argument("--first", type=int, default=0, help="number of the first tube")
    parser.add_argument("--program", default=str(ROOT / "target/debug/sweetspot"))
    arguments = parser.parse_args()
    end = time.time() + 60 * arguments.minutes
    number, seen, false, short = arguments.first, 0, 0, 0
    worst, ratios, spent = (0.0, ""), [], 0.0
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "bat.json"
        while time.time() < end and number < arguments.first + arguments.tubes:
            rng = random.Random(f"{arguments.seed} {number}")
            number += 1
            tube, n = draw(rng), rng.choice([2, 2, 3, 4])
            path.write_text(json.dumps(written(tube)))
            # Two that are good, whose difference is round-off, and one that is less so.
            truth, other, rough = (ritz(tube, n, p, q, 3) for p, q in ((44, 14), (46, 13), (36, 11)))
            for tol in (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9):
                command = [arguments.program, "hoop", str(path), "--tol", str(tol), "--json", "-"]
                began = os.times().children_user
                done = subprocess.run([*command, "--quiet"], capture_output=True, text=True)
                spent += os.times().children_user - began
                short += done.returncode == 3
                if done.returncode not in (0, 3):
                    print("no answer", done.returncode, arguments.seed, number - 1, tol, flush=True)
                    continue
                answer = json.loads(done.stdout)
                own = [mode for mode in answer["modes"] if mode["harmonic"] == n]
                for mode, right, again, lower in zip(own, truth, other, rough):
                    seen += 1
                    off = abs(mode["frequency_hz"] / right - 1)
                    known = abs(lower / right - 1) + abs(again / right - 1) + 1e-11
                    stated = mode["error"]
                    where = f"{arguments.seed} {number - 1} tol {tol} n {n} m {mode['order']}"
                    if off > 3 * known:
                        ratios.append(stated / off)
                    ratio = max(0.0, off - 3 * known) / stated
                    worst = max(worst, (ratio, where))
                    met = answer["tolerance_met"] and stated > tol
                    if ratio > 3 or met:
                        false += 1
                        print(f"off {off:.2e}, stated {stated:.2e}, known {known:.0e}: {where} "
                              f"{tube}", flush=True)
    median = statistics.median(ratios) if ratios else math.nan
    print(f"{number - arguments.first} tubes, {seen} modes, {false} false, worst true/stated {worst[0]:.2f} "
          f"({worst[1]}), median stated/true {median:.2f} of {len(ratios)}, {short} with exit 3, "
          f"{spent:.1f} s")
    return 1 if false else 0


if __name__ == "__main__":
    sys.exit(main())
