"""Bats that are hit: how they are drawn, written and weighed, and how they give way to a slow force.

Everything here is computed from the stations anew, by quadrature; of the program only the modes of
other bats than the uniform one are taken (`sweetspot modes`, tolerance 1e-12), which have references of
their own."""

import json
import math
import pathlib
import subprocess
import tempfile

GAUSS = [
    (0.1834346424956498, 0.3626837833783620),
    (0.5255324099163290, 0.3137066458778873),
    (0.7966664774136267, 0.2223810344533745),
    (0.9602898564975363, 0.1012285362903763),
]
POINTS = [(0.5 - 0.5 * x, 0.5 * w) for x, w in reversed(GAUSS)] + [
    (0.5 + 0.5 * x, 0.5 * w) for x, w in GAUSS
]
SHAPE_POINTS = 401


def pchip_slopes(x, y):
    """Fritsch and Carlson's monotone slopes, as SciPy's PchipInterpolator has them."""
    n = len(x)
    h = [b - a for a, b in zip(x, x[1:])]
    d = [(b - a) / k for a, b, k in zip(y, y[1:], h)]
    if n == 2:
        return [d[0], d[0]]

    def end(h0, h1, d0, d1):
        s = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
        if s * d0 <= 0:
            return 0.0
        return 3 * d0 if d0 * d1 <= 0 and abs(s) > 3 * abs(d0) else s

    slopes = [end(h[0], h[1], d[0], d[1])]
    for k in range(1, n - 1):
        if d[k - 1] * d[k] <= 0:
            slopes.append(0.0)
            continue
        a, b = 2 * h[k] + h[k - 1], h[k] + 2 * h[k - 1]
        slopes.append((a + b) / (a / d[k - 1] + b / d[k]))
    return slopes + [end(h[-1], h[-2], d[-1], d[-2])]


class Curve:
    """A radius along the bat: (x, values), linear or pchip, equal neighbours a step."""

    def __init__(self, x, y, kind):
        self.pieces = []
        start = 0
        for k in range(1, len(x) + 1):
            if k == len(x) or x[k] == x[k - 1]:
                xs, ys = x[start:k], y[start:k]
                slopes = pchip_slopes(xs, ys) if kind == "pchip" else None
                for i in range(len(xs) - 1):
                    ends = slopes[i : i + 2] if slopes else None
                    self.pieces.append((xs[i], xs[i + 1], ys[i], ys[i + 1], ends))
                start = k

    def __call__(self, x):
        for a, b, ya, yb, slopes in self.pieces:
            if x <= b or b == self.pieces[-1][1]:
                h, s = b - a, (x - a) / (b - a)
                if slopes is None:
                    return ya + (yb - ya) * s
                t = 1 - s
                return (
                    ya * (1 + 2 * s) * t * t
                    + yb * s * s * (3 - 2 * s)
                    + h * s * t * (slopes[0] * t - slopes[1] * s)
                )


class Bat:
    """A bat file's content, with its rigid body and its static flexibility."""

    def __init__(self, text, theory):
        self.text, self.theory = text, theory
        profile, m = text["profile"], text["material"]
        x = profile["x"]
        outer = [0.5 * d for d in profile["diameter"]]
        inner = [0.5 * d for d in profile.get("inner_diameter", [0.0] * len(x))]
        kind = profile["interpolation"]
        self.outer, self.inner = Curve(x, outer, kind), Curve(x, inner, kind)
        self.length, self.cuts = x[-1], sorted(set(x))
        self.density, self.young = m["density"], m["youngs_modulus"]
        self.shear = m.get("shear_modulus", 0) * m.get("shear_coefficient", 1)
        self.damping = 0.5 * m.get("loss_factor", 0)
        self.loads = [(a["x"], a["mass"]) for a in text.get("attachments", [])]
        supports = text.get("supports", [])
        self.support = (supports[0]["type"], supports[0]["x"]) if supports else None
        self.weigh()

    def section(self, x):
        """Area and second moment of area."""
        a, b = self.outer(x), self.inner(x)
        return math.pi * (a * a - b * b), math.pi / 4 * (a**4 - b**4)

    def parts(self, *more):
        """Intervals without a cut inside, a few for each between stations."""
        cuts = sorted(set(self.cuts) | set(more) | {x for x, _ in self.loads})
        fine = max(1, 96 // len(cuts))
        for a, b in zip(cuts, cuts[1:]):
            for k in range(fine):
                yield a + (b - a) * k / fine, a + (b - a) * (k + 1) / fine

    def weigh(self):
        mass = moment = square = turning = 0.0
        for a, b in self.parts():
            for s, w in POINTS:
                x = a + (b - a) * s
                area, second = self.section(x)
                dm = self.density * area * w * (b - a)
                mass, moment, square = mass + dm, moment + dm * x, square + dm * x * x
                turning += self.density * second * w * (b - a)
        for x, m in self.loads:
            mass, moment, square = mass + m, moment + m * x, square + m * x * x
        self.turns = self.theory != "euler-bernoulli"
        self.mass, self.balance = mass, moment / mass
        self.line = square - moment * moment / mass
        self.inertia = self.line + (turning if self.turns else 0)
        self.about_pin = None
        if self.support and self.support[0] == "pinned":
            arm = self.balance - self.support[1]
            self.about_pin = self.inertia + mass * arm * arm

    def recoil(self, x):
        """1/M_eff (1/kg) of the bat that does not bend."""
        if self.support is None:
            return 1 / self.mass + (x - self.balance) ** 2 / self.inertia
        return (x - self.support[1]) ** 2 / self.about_pin if self.about_pin else 0.0

    def flexibility(self, at):
        """Deflection under a unit force at a place that the bat's own inertia and its support balance
        (m/N): the integral of M^2/EI and, with shear, of Q^2/(kappa G A)."""
        kind, support = self.support or ("free", 0.0)
        force = moment = energy = reaction = 0.0
        if kind == "free":
            push, turn, centre = 1 / self.mass, (at - self.balance) / self.inertia, self.balance
        elif kind == "pinned":
            push, turn, centre = 0.0, (at - support) / self.about_pin, support
            reaction = 1 - turn * self.mass * (self.balance - support)
        else:
            push = turn = centre = 0.0
            force, moment = 1.0, -at
        load = lambda x: push + turn * (x - centre)
        loads = dict(self.loads)
        for a, b in self.parts(at, support):
            force += loads.get(a, 0) * load(a)
            if a == support:
                force += reaction
            pushed = 1.0 if a >= at else 0.0
            h = b - a

            def inside(end):
                q = m = 0.0
                for s, w in POINTS:
                    x = a + (end - a) * s
                    area, second = self.section(x)
                    here = self.density * area * load(x) * w * (end - a)
                    q += here
                    m += here * (end - x)
                    if self.turns:
                        m -= self.density * second * turn * w * (end - a)
                return force + q - pushed, moment + (force - pushed) * (end - a) + m

            for s, w in POINTS:
                x = a + h * s
                across, bent = inside(x)
                area, second = self.section(x)
                energy += bent * bent / (self.young * second) * w * h
                if self.theory == "timoshenko":
                    energy += across * across / (self.shear * area) * w * h
            across, moment = inside(b)
            force = across + pushed
        return energy

    def uniform(self):
        text = self.text
        return (
            len(set(text["profile"]["diameter"])) == 1
            and self.theory == "euler-bernoulli"
            and not text.get("attachments")
            and not text.get("supports")
        )

    def modes(self, program, count):
        """omega (rad/s) and a function n, share of the length -> phi^2/m (1/kg)."""
        if self.uniform():
            return self.closed_form(count)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bat.json"
            path.write_text(json.dumps(self.text))
            command = [program, "modes", str(path), "-n", str(count), "--tol", "1e-12", "--quiet"]
            command += ["--theory", self.theory, "--shape-points", str(SHAPE_POINTS), "--json", "-"]
            done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode not in (0, 3):
            raise RuntimeError(done.stderr)
        modes = json.loads(done.stdout)["modes"]
        off = max(m["error"]["discretization"] + m["error"]["round_off"] for m in modes)
        if off > 1e-9:
            raise RuntimeError(f"modes known to {off} only")
        omega = [m["omega_rad_s"] for m in modes]

        def gain(n, share):
            k = share * (SHAPE_POINTS - 1)
            assert abs(k - round(k)) < 1e-9
            phi = modes[n]["shape"]["deflection"][round(k)]
            return phi * phi / modes[n]["modal_mass_kg"]

        return omega, gain

    def closed_form(self, count):
        """The free uniform beam: cos b cosh b = 1; shapes by what decays from either end."""
        area, second = self.section(0.0)
        unit = math.sqrt(self.young * second / (self.density * area)) / self.length**2
        roots = []
        for n in range(1, count + 1):
            b = (n + 0.5) * math.pi
            for _ in range(60):
                b = (n + 0.5) * math.pi + (-1) ** (n + 1) * math.asin(min(1, 1 / math.cosh(b))) \
                    if b < 300 else (n + 0.5) * math.pi
            roots.append(b)

        def gain(n, share):
            b = roots[n]
            # Scaled to a mean square of 1: cosh + cos - sigma (sinh + sin), without large numbers.
            e, sign = math.exp(-b), (-1) ** (n + 1)
            # sigma = (cosh b - cos b)/(sinh b - sin b); cosh - sigma sinh by decaying exponentials.
            sigma = (1 + e * e - 2 * e * math.cos(b)) / (1 - e * e - 2 * e * math.sin(b))
            grow = (1 - sigma) / 2
            # 1 - sigma = (2 e cos b - 2 e^2 - 2 e sin b)/(1 - e^2 - 2 e sin b)
            grow = (e * math.cos(b) - e * e - e * math.sin(b)) / (1 - e * e - 2 * e * math.sin(b))
            x = b * share
            w = grow * math.exp(x) + (1 + sigma) / 2 * math.exp(-x) + math.cos(x)
            w -= sigma * math.sin(x)
            return w * w / self.mass

        return [unit * b * b for b in roots], gain


ROOT = pathlib.Path(__file__).resolve().parents[2]


def bundled(name):
    """A bat of meshes/ in metres."""
    text = json.loads((ROOT / "meshes" / f"{name}.json").read_text())
    profile, m = text["profile"], text["material"]
    giga = lambda v: 1e9 * float(v.split()[0]) if isinstance(v, str) else v
    material = {k: giga(v) for k, v in m.items()}
    if profile["diameter"][-1] == 0:
        profile["diameter"][-1] = 10
    return {
        "format": "sweetspot-bat/1",
        "name": name,
        "material": material,
        "profile": {
            "interpolation": profile["interpolation"],
            "x": [v / 1000 for v in profile["x"]],
            "diameter": [v / 1000 for v in profile["diameter"]],
        },
    }


def draw(random):
    """A random bat and a theory."""
    kind = random.choice(["dowel", "cone", "linear", "r161", "torpedo", "hollow", "tube"])
    theory = random.choice(["euler-bernoulli", "euler-bernoulli", "rayleigh", "timoshenko"])
    length = round(random.uniform(0.66, 0.92), 3)
    wood = {
        "density": float(random.randint(500, 900)),
        "youngs_modulus": random.randint(90, 200) * 1e8,
        "shear_modulus": random.randint(7, 13) * 1e8,
        "shear_coefficient": 0.9,
    }
    metal = {
        "density": 2770.0,
        "youngs_modulus": 7.1e10,
        "shear_modulus": 2.7e10,
        "shear_coefficient": 0.53,
    }
    size = lambda a, b: round(random.uniform(a, b), 4)
    if kind in ("r161", "torpedo"):
        text = bundled(kind)
        length = text["profile"]["x"][-1]
    else:
        wide = size(0.055, 0.066)
        x, diameter, inner = [0.0, length], None, None
        if kind == "dowel":
            diameter = [size(0.035, 0.055)] * 2
        elif kind == "cone":
            diameter = [size(0.022, 0.03), wide]
        elif kind == "linear":
            x = [0.0, 0.02, 0.02, 0.35 * length, 0.7 * length, length]
            x = [round(v, 4) for v in x]
            x[-1] = length
            diameter = [0.05, 0.05, 0.025, size(0.024, 0.032), wide, wide]
        elif kind == "hollow":
            x = [0.0, round(0.4 * length, 4), round(0.7 * length, 4), length]
            diameter = [0.024, 0.028, wide, wide]
            inner = [round(d - 2 * size(0.002, 0.004), 5) for d in diameter]
        else:
            wide, wall = size(0.04, 0.06), size(0.0015, 0.004)
            diameter, inner = [wide] * 2, [round(wide - 2 * wall, 5)] * 2
        text = {
            "format": "sweetspot-bat/1",
            "name": kind,
            "material": metal if inner else wood,
            "profile": {"interpolation": "linear", "x": x, "diameter": diameter},
        }
        if inner:
            text["profile"]["inner_diameter"] = inner
    if random.random() < 0.4:
        text["material"]["loss_factor"] = round(10 ** random.uniform(-3, -1.2), 4)
    held = random.random()
    if random.random() < 0.25:
        x = round(random.choice([0.03, 0.1, length - 0.05, 0.6 * length]), 4)
        text["attachments"] = [{"x": x, "mass": round(random.uniform(0.02, 0.15), 3)}]
    elif held < 0.25:
        place = 0.1524 if held < 0.15 else 0.0
        text["supports"] = [{"x": place, "type": "pinned" if held < 0.15 else "clamped"}]
    return text, theory
