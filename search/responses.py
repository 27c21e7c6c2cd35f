#!/usr/bin/env python3
"""Random damped bats against exact responses and damped modes: prints every false statement, exit 1 if there is one.

    search/responses.py --minutes 20 --seed 1 [--program target/debug/sweetspot]

The bats have dashpots (a grip, absorbers) or none. Of each a frequency response is asked between two places that are
often within one element, with few modes, and the damped modes at a random tolerance. The truth is the bat's own
equation at one complex s: on every stretch

    w' = θ + Q/κGA,  θ' = M/EI,  Q' = (k + s c + s² ρA) w,  M' = −Q + s² ρI θ

is solved by power series with 256 bits (python-flint), and the stretches are chained from end to end. A response is
what a unit jump of Q makes; a damped mode is an s at which both ends are free of Q and M, found by the secant method
from the pole that the program states. False is what is farther off than three times its stated error.
"""

import argparse
import json
import random
import resource
import subprocess
import sys
import time
from math import pi
from pathlib import Path
from statistics import median

from bats import HERE, with_libraries

ALWAYS = 3.0
TERMS = 40


class Damped:
    """A bat at complex s: what takes (w, θ, Q, M) from its knob end to any place."""

    def __init__(self, bat, theory):
        from random_bats import radii, section
        self.bat, self.pieces = bat, radii(bat["profile"])
        self.section = lambda outer, inner: section(bat["material"], outer, inner, None, theory)
        self.length = max(b for _, b, _, _ in self.pieces)

    def bed(self, x, s):
        grip = self.bat.get("grip")
        inside = grip and grip["from"] <= x <= grip["to"]
        return grip["stiffness"] + s * grip.get("damping", 0.0) if inside else s * 0

    def point(self, x, s):
        """What an absorber at x resists with."""
        total = s * 0
        for a in self.bat.get("absorbers", []):
            if a["x"] == x:
                k = a["mass"] * (2 * PI() * a["frequency"]) ** 2
                damped = k + s * a["damping"]
                total += a["mass"] * s * s * damped / (a["mass"] * s * s + damped)
        return total

    def transfer(self, s, start, end):
        """From just behind `start` to just before `end`, points in between included."""
        from flint import acb_mat
        grip = self.bat.get("grip") or {"from": 0.0, "to": 0.0}
        cuts = {grip["from"], grip["to"], start, end} | {a["x"] for a in self.bat.get("absorbers", [])}
        whole = acb_mat(4, 4, [int(i % 5 == 0) for i in range(16)])
        for low, high, outer, inner in self.pieces:
            borders = sorted({low, high} | {c for c in cuts if low < c < high})
            for a, b in zip(borders, borders[1:]):
                if a >= start and b <= end and b > a:
                    whole = self.stretch(s, a, b, self.section(outer, inner)) * whole
                    if b < end:
                        whole = self.jump(self.point(b, s)) * whole
        return whole

    @staticmethod
    def jump(stiffness):
        from flint import acb, acb_mat
        return acb_mat(4, 4, [acb(1), 0, 0, 0, 0, 1, 0, 0, stiffness, 0, 1, 0, 0, 0, 0, 1])

    def stretch(self, s, a, b, section):
        """One smooth stretch; it is halved until its series end."""
        from flint import acb, acb_mat, acb_series, arb, arb_series
        middle, half = (arb(a) + arb(b)) / 2, (arb(b) - arb(a)) / 2
        parts = section(arb_series([middle, half]))[:4]
        stiffness, slip, line, turning = (acb_series([acb(c) for c in part.coeffs()] or [acb(0)])
                                          for part in map(arb_series, parts))
        bends, bed = acb_series([acb(1)]) / stiffness, self.bed((a + b) / 2, s)
        load, couple = line * (s * s) + acb_series([bed]), turning * (s * s)

        def integral(series, start):
            total = series.integral()
            left = sum((c if k % 2 == 0 else -c for k, c in enumerate(total.coeffs())), acb(0))
            return (total - acb_series([left])) * half + acb_series([start])

        columns = []
        for column in range(4):
            w0, t0, q0, m0 = (acb(int(column == i)) for i in range(4))
            w = q = m = theta = acb_series([acb(0)])
            for _ in range(12):
                before, turned = w, theta
                q = integral(load * w, q0)
                m = integral(couple * theta - q, m0)
                theta = integral(bends * m, t0)
                w = integral(theta + slip * q, w0)
            size = lambda f: max([abs(complex(c)) for c in f.coeffs()] or [0.0])
            if (size(w - before) > 1e-28 * size(w) or size(theta - turned) > 1e-28 * size(theta)) or \
                    max(abs(complex(c)) for c in (w.coeffs() + [acb(0)] * TERMS)[TERMS - 3:TERMS]) > 1e-26 * size(w):
                centre = 0.5 * (a + b)
                return self.stretch(s, centre, b, section) * self.stretch(s, a, centre, section)
            end = [sum(f.coeffs(), acb(0)) for f in (w, theta, q, m)]
            columns.append([acb(v.real.mid(), v.imag.mid()) for v in end])
        return acb_mat(4, 4, [columns[j][i] for i in range(4) for j in range(4)])

    def ends(self, s):
        """(Q, M) beyond the tip by (w, θ) at the knob end."""
        whole = self.jump(self.point(self.length, s)) * self.transfer(s, 0.0, self.length) * self.jump(self.point(0.0, s))
        return whole

    def open(self, s):
        """A number that is 0 at a damped mode."""
        m = self.ends(s)
        return m[2, 0] * m[3, 1] - m[2, 1] * m[3, 0]

    def response(self, s, at, to):
        """w at `to` by a unit force at `at`."""
        from flint import acb
        s = acb(s)
        whole = self.ends(s)
        rest = self.jump(self.point(self.length, s)) * self.transfer(s, at, self.length)
        loaded = [-rest[i, 2] for i in (2, 3)]
        (a, b), (c, d) = ([whole[i, j] for j in (0, 1)] for i in (2, 3))
        det = a * d - b * c
        w, theta = -(d * loaded[0] - b * loaded[1]) / det, -(a * loaded[1] - c * loaded[0]) / det
        there = self.transfer(s, 0.0, to) * self.jump(self.point(0.0, s))
        value = there[0, 0] * w + there[0, 1] * theta
        if to > at:
            value -= self.transfer(s, at, to)[0, 2]
        return complex(acb(value))

    def pole(self, near):
        """The s at which `open` is 0, from one that is near."""
        from flint import acb
        near = complex(near)
        x, y = acb(near * (1 + 1e-7)), acb(near)
        of_x = self.open(x)
        for _ in range(40):
            of_y = self.open(y)
            step = of_y * (y - x) / (of_y - of_x)
            x, of_x, y = y, of_y, y - step
            y = acb(y.real.mid(), y.imag.mid())
            if abs(complex(step)) < 1e-17 * abs(complex(y)):
                return complex(y)
        raise ArithmeticError("the secant method does not settle")


def PI():
    from flint import arb
    return arb.pi()


def random_bat(rng):
    length, kind = 0.84, rng.choice(["constant", "linear", "pchip"])
    bat = {"format": "sweetspot-bat/1", "name": "d",
           "material": {"density": 700.0, "youngs_modulus": 15e9, "shear_modulus": 1e9, "loss_factor": 0.0},
           "profile": {"interpolation": kind, "x": [0.0, 0.3, length],
                       "radius": [rng.uniform(0.011, 0.02), rng.uniform(0.011, 0.03), rng.uniform(0.02, 0.033)]}}
    if kind == "constant":
        bat["profile"]["radius"][2] = bat["profile"]["radius"][1]
    if rng.random() < 0.6:
        bat["grip"] = {"from": 0.0, "to": rng.choice([0.15, 0.2]), "stiffness": 10 ** rng.uniform(2, 6),
                       "damping": 10 ** rng.uniform(0, 4)}
    if rng.random() < 0.5:
        bat["absorbers"] = [{"x": rng.choice([0.0, 0.3, length]), "mass": 10 ** rng.uniform(-3, -1.5),
                             "frequency": 10 ** rng.uniform(1.5, 3), "damping": 10 ** rng.uniform(-2.5, 1)}]
    return bat


def asked_of(program, bat, words):
    command = [program, *words[:1], "/dev/stdin", *words[1:], "--quiet", "--json", "-"]
    done = subprocess.run(command, input=json.dumps(bat), capture_output=True, text=True, timeout=300)
    return (json.loads(done.stdout) if done.stdout.strip() else None), done.returncode, done.stderr.strip()


def responses(program, bat, theory, rng):
    """The response's true and stated error, relative, of one random pair of places."""
    at = rng.uniform(0.02, 0.82)
    to = min(max(at + rng.choice([1, -1]) * 10 ** rng.uniform(-5, -0.3), 0.0), 0.84)
    frequency, count = 10 ** rng.uniform(1.3, 3.7), rng.choice([1, 1, 3, 8])
    words = ["frf", "--at", repr(at), "--to", repr(to), "-n", str(count), "--frequencies", repr(frequency),
             "--theory", theory]
    answer, code, complaint = asked_of(program, bat, words)
    if answer is None:
        return None, code, " ".join(words) + ": " + complaint[-200:]
    told = complex(answer["real_m_per_n"][0], answer["imaginary_m_per_n"][0])
    exact = Damped(bat, theory)
    truth, beside = (exact.response(2j * pi * f, at, to) for f in (frequency, frequency * (1 + 1e-6)))
    # Near a resonance a frequency's own error counts as often as the response is steep.
    sharp = 2 + abs(beside / truth - 1) / 1e-6
    stated = answer["truncation_m_per_n"][0] / abs(truth) + answer["frequencies_within"] * sharp
    return (abs(told - truth) / abs(truth), stated), code, " ".join(words)


def poles(program, bat, theory, rng):
    """True and stated errors of the damped modes."""
    words = ["modes", "-n", "4", "--tol", f"1e-{rng.randint(4, 10)}", "--theory", theory, "--shape-points", "0"]
    answer, code, complaint = asked_of(program, bat, words)
    if answer is None:
        return [], code, " ".join(words) + ": " + complaint[-200:]
    exact, pairs = Damped(bat, theory), []
    for mode in answer["modes"]:
        damped = mode.get("damping")
        if not damped or not damped.get("complex") or not damped["damped_frequency_hz"] or damped["error"] is None:
            continue
        told = complex(-damped["decay_1_per_s"], 2 * pi * damped["damped_frequency_hz"])
        truth = exact.pole(told)
        pairs.append((abs(told - truth) / abs(truth), damped["error"]))
    return pairs, code, " ".join(words)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=10**9)
    parser.add_argument("--program", default=str(HERE.parent / "target" / "debug" / "sweetspot"))
    asked = parser.parse_args()
    with_libraries(__file__)
    from flint import ctx
    ctx.prec, ctx.cap = 256, TERMS
    started, count, used, false, exits = time.time(), 0, 0.0, 0, 0
    seen = {"response": [], "damped mode": []}
    while time.time() - started < 60 * asked.minutes and count < asked.cases:
        seed = asked.seed + count
        rng = random.Random(seed)
        bat, theory = random_bat(rng), rng.choice(["euler-bernoulli", "rayleigh", "timoshenko"])
        count += 1
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        for kind, of in (("response", responses), ("damped mode", poles)):
            try:
                found, code, words = of(asked.program, bat, theory, rng)
            except ArithmeticError as error:
                print(f"case {seed}: no reference, {error}")
                continue
            if code == 3 or not found and code:
                exits += 1
                print(f"case {seed}: exit {code}, {words}", flush=True)
            for true, stated in ([found] if isinstance(found, tuple) else found or []):
                seen[kind].append((true, stated))
                if true > ALWAYS * stated + 1e-12:
                    false += 1
                    print(f"FALSE: case {seed}, {kind}: {true:.1e} off, {stated:.1e} stated, {words}\n  "
                          + json.dumps(bat), flush=True)
        used += resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    print(f"{count} bats: {false} false, {exits} not solved to the tolerance, {used:.1f} s of processor time")
    for kind, pairs in seen.items():
        worst = max(((true - 1e-12) / stated for true, stated in pairs if stated), default=0.0)
        usual = median([stated / true for true, stated in pairs if true > 1e-13] or [0])
        print(f"{kind}: {len(pairs)}, largest true over stated {worst:.2f}, median of stated over true {usual:.3g}")
    return 1 if false else 0


if __name__ == "__main__":
    sys.exit(main())
