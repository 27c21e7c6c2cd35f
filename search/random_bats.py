"""Random bats as the program's JSON, and their exact modes from that JSON."""

import random

from flint import arb, arb_series

from reference import PI, Bat

THEORIES = ["euler-bernoulli", "rayleigh", "timoshenko"]
KINDS = ["plain", "hollow", "steps", "formula", "whips", "three whips", "absorber", "absorbers",
         "held", "loaded", "grip", "joint", "split"]
# Bats at the border of what arithmetic and meshes can tell; only by name, or all by "hard".
HARD = ["stiff springs", "thin hinges", "pointed", "far weights", "cylinders"]
FORMULAS = [
    ("{a} + {b}*x^2", lambda x, a, b: x * x * b + a),
    ("{a} + {b}*sin(4*x)^2", lambda x, a, b: (x * 4).sin() * (x * 4).sin() * b + a),
    ("{a}*exp({b}*40*x)", lambda x, a, b: (x * arb(b) * 40).exp() * a),
    ("{a} + {b}/(1 + exp(12 - 24*x))", lambda x, a, b: 1 / ((12 - x * 24).exp() + 1) * b + a),
    ("sqrt({a}^2 + {b}^2*x)", lambda x, a, b: (x * arb(b) ** 2 + arb(a) ** 2).sqrt()),
    ("{a}*x^{b}", lambda x, a, b: (x.log() * arb(b)).exp() * arb(a)),
    ("{a}*(0.84-x)^{b}", lambda x, a, b: ((arb(0.84) - x).log() * arb(b)).exp() * arb(a)),
]
ORDINARY = FORMULAS[:5]


def random_case(seed, kind, solve):
    """A bat and what is asked of it."""
    rng = random.Random(seed)
    kind = rng.choice(HARD) if kind == "hard" else kind or rng.choice(KINDS)
    case = {"kind": kind, "theory": rng.choice(THEORIES), "modes": rng.randint(1, 8)}
    if rng.random() < 0.15:
        case["elements"], case["degree"] = rng.randint(4, 30), rng.randint(3, 8)
    else:
        case["tolerance"] = 10 ** rng.uniform(-12, -2)
    material = {"density": rng.uniform(400, 900), "youngs_modulus": rng.uniform(8e9, 2e10),
                "shear_modulus": rng.uniform(5e8, 2e9)}
    if rng.random() < 0.5:
        material["shear_coefficient"] = rng.uniform(0.5, 0.95)
    bat = {"format": "sweetspot-bat/1", "name": f"{kind} {seed}", "source": "search/random_bats.py",
           "material": material}
    whips = {"whips": 2, "three whips": 3}.get(kind)
    if whips:
        # Rough answers, whose errors are not small beside what parts near twins.
        if "tolerance" in case and rng.random() < 0.7:
            case["tolerance"] = 10 ** rng.uniform(-5, -1)
        bat.update(whipped(rng, whips))
    elif kind == "formula":
        bat["profile"] = {"pieces": pieces(rng)}
    elif kind == "pointed":
        # What the reference leaves off the point is below these tolerances.
        case.pop("elements", None), case.pop("degree", None)
        case["tolerance"] = 10 ** rng.uniform(-6, -2)
        text = rng.choice(["{a}*x^{b}", "{a}*(0.84-x)^{b}"])
        values = {"a": repr(round(rng.uniform(0.02, 0.04), 6)), "b": repr(round(rng.uniform(0.6, 1.5), 3))}
        bat["profile"] = {"pieces": [{"from": 0.0, "to": 0.84, "formula": text.format(**values)}]}
    elif kind in ("stiff springs", "thin hinges"):
        case["modes"] = rng.randint(1, 10)
        bat["profile"] = uneven(rng)
    elif kind == "cylinders":
        if "tolerance" in case:
            case["tolerance"] = 10 ** rng.uniform(-13.5, -9)
        bat["profile"] = chain(rng)
    else:
        bat["profile"] = columns(rng, kind)
    length = end(bat)
    places = lambda count: [length * (k + rng.uniform(0.2, 0.8)) / count for k in range(count)]
    if kind == "absorber":
        tuned(rng, bat, case, solve, length)
    elif kind == "absorbers":
        bat["absorbers"] = [{"x": x, "mass": 10 ** rng.uniform(-4, -1),
                             "stiffness": 10 ** rng.uniform(2, 5)} for x in places(rng.randint(2, 6))]
    elif kind == "held":
        kinds = ["pinned", "clamped"]
        bat["supports"] = [{"x": x, "type": rng.choice(kinds)} for x in places(rng.randint(1, 3))]
        if rng.random() < 0.5:
            bat["supports"][0]["x"] = 0.0
    elif kind == "loaded":
        bat["attachments"] = [attachment(rng, x) for x in places(rng.randint(1, 4))]
    elif kind == "grip":
        bat["grip"] = {"from": 0.02, "to": 0.02 + rng.uniform(0.05, 0.2),
                       "stiffness": 10 ** rng.uniform(3, 6), "damping": 0.0}
    elif kind == "joint":
        bat["joints"] = [{"x": x, "rotational_stiffness": 10 ** rng.uniform(2, 5)}
                         for x in places(rng.randint(1, 2))]
    elif kind == "stiff springs":
        bat["attachments"] = [stiff(rng, x) for x in places(rng.randint(1, 4))]
        if rng.random() < 0.5:
            bat["joints"] = [{"x": x, "rotational_stiffness": 10 ** rng.uniform(-3, 7)}
                             for x in places(rng.randint(1, 2))]
    elif kind == "thin hinges":
        if rng.random() < 0.3:
            bat["attachments"] = [stiff(rng, x) for x in places(1)]
    elif kind == "far weights":
        bat["attachments"] = [{"x": x, "mass": 10 ** rng.uniform(-1, 4), "offset": rng.uniform(-0.5, 0.5),
                               "rotary_inertia": 10 ** rng.uniform(-6, -2)}
                              for x in rng.sample([0.0, length, 0.5 * length], rng.randint(1, 2))]
    elif kind == "split":
        # A clamp in the middle parts the bat into two that know nothing of each other.
        bat["profile"] = twins(rng)
        case["modes"] = rng.randint(1, 4)
        bat["supports"] = [{"x": 0.5 * end(bat), "type": "clamped"}]
    return bat, case


def uneven(rng):
    """Radii from 5 to 140 mm, in steps or nearly so: thin hinges between thick parts."""
    count, length = rng.randint(4, 40), rng.uniform(0.7, 1.0)
    inner = sorted(rng.uniform(0.0, 1.0) for _ in range(count - 2))
    x = [0.0] + [length * v for v in inner] + [length]
    if any(b - a < 1e-4 for a, b in zip(x, x[1:])):
        x = [length * k / (count - 1) for k in range(count)]
    interpolation = rng.choice(["linear", "constant"])
    r = [10 ** rng.uniform(-2.3, -0.86) for _ in x]
    if interpolation == "constant":
        r[-1] = r[-2]
    return {"interpolation": interpolation, "x": x, "radius": r}


def chain(rng):
    """Cylinders one after the other, as slices of a lathe's table."""
    count, length = rng.choice([1, 2, 10, 30, 84, 150]), rng.uniform(0.7, 0.9)
    x = [length * k / count for k in range(count + 1)]
    wide = rng.uniform(0.0, 0.6)
    r = [0.02 * (1 + wide * rng.uniform(-1, 1)) for _ in x]
    r[-1] = r[-2]
    return {"interpolation": "constant", "x": x, "radius": r}


def stiff(rng, x):
    found = {"x": x, "stiffness": 10 ** rng.uniform(-2, 12)}
    if rng.random() < 0.5:
        found["rotational_stiffness"] = 10 ** rng.uniform(0, 8)
    return found


def attachment(rng, x):
    found = {"x": x}
    if rng.random() < 0.8:
        found["mass"] = 10 ** rng.uniform(-3, 0)
        found["offset"] = rng.choice([0.0, rng.uniform(-0.03, 0.03)])
        found["rotary_inertia"] = rng.choice([0.0, 10 ** rng.uniform(-6, -3)])
    if rng.random() < 0.4 or "mass" not in found:
        found["stiffness"] = 10 ** rng.uniform(3, 7)
    if rng.random() < 0.3:
        found["rotational_stiffness"] = 10 ** rng.uniform(1, 4)
    return found


def columns(rng, kind):
    count = rng.randint(2, 14)
    length = rng.uniform(0.6, 1.1)
    inner = sorted(rng.uniform(0.03, 0.97) for _ in range(count - 2))
    x = [0.0] + [length * v for v in inner] + [length]
    if any(b - a < 0.01 for a, b in zip(x, x[1:])):
        x = [length * k / (count - 1) for k in range(count)]
    r = [rng.uniform(0.011, 0.034) for _ in x]
    if kind == "steps":
        k = rng.randint(1, len(x) - 1) if len(x) > 2 else 1
        if 0 < k < len(x) - 1:
            x, r = x[:k] + [x[k]] + x[k:], r[:k] + [rng.uniform(0.011, 0.034)] + r[k:]
    interpolation = rng.choice(["linear", "pchip", "constant"] if kind == "steps"
                               else ["linear", "pchip"])
    if interpolation == "constant":
        # A station's radius holds up to the next: the last one closes the bat, a step has no
        # other left of it.
        r[-1] = r[-2]
        for k in range(1, len(x) - 1):
            if x[k] == x[k + 1]:
                r[k] = r[k - 1]
    profile = {"interpolation": interpolation, "x": x, "radius": r}
    if interpolation == "linear" and rng.random() < 0.3:
        collinear(rng, profile)
    if kind == "hollow":
        share = rng.uniform(0.3, 0.9)
        profile["inner_radius"] = [share * v for v in profile["radius"]]
    return profile


def collinear(rng, profile):
    """Stations more that change nothing but where elements end."""
    x, r = profile["x"], profile["radius"]
    k = rng.choice([k for k in range(len(x) - 1) if x[k + 1] - x[k] > 0.02])
    count = rng.randint(1, 12)
    more = [(k1 + 1) / (count + 1) for k1 in range(count)]
    profile["x"] = x[:k + 1] + [x[k] + s * (x[k + 1] - x[k]) for s in more] + x[k + 1:]
    profile["radius"] = r[:k + 1] + [r[k] + s * (r[k + 1] - r[k]) for s in more] + r[k + 1:]


def twins(rng):
    """Two like halves, one of them cut finer."""
    thin, length = rng.uniform(0.005, 0.015), rng.uniform(0.2, 0.5)
    other = thin * (1 + rng.choice([0.0, 10 ** rng.uniform(-9, -3)]))
    profile = {"interpolation": "linear", "x": [0.0, length, length, 2 * length],
               "radius": [thin, thin, other, other]}
    if rng.random() < 0.8:
        finer(rng, profile, 0)
    return profile


def finer(rng, profile, k):
    count = rng.choice([1, 3, 10, 30, 60])
    x, r = profile["x"], profile["radius"]
    profile["x"] = x[:k + 1] + [x[k] + (j + 1) / (count + 1) * (x[k + 1] - x[k])
                                for j in range(count)] + x[k + 1:]
    profile["radius"] = r[:k + 1] + [r[k]] * count + r[k + 1:]


def whipped(rng, whips):
    """Equal or nearly equal whips, long thin ends, on a heavy short middle; one cut finer."""
    thin, heavy = rng.uniform(0.003, 0.010), 10 ** rng.uniform(-1.7, 0.9)
    long, short = rng.uniform(0.2, 0.5), rng.uniform(0.02, 0.3)
    unlike = lambda: 1 + rng.choice([0.0, 0.0, 10 ** rng.uniform(-7, -2)])
    taper = rng.choice([1.0, 1.0, rng.uniform(0.5, 1.5)])
    other = thin * unlike()
    x = [0.0, long, long, long + short, long + short, 2 * long + short]
    r = [thin * taper, thin, heavy, heavy, other, other * taper]
    supports = []
    if whips == 3:
        # The third between two heavy parts, held at its ends like the others at theirs.
        third = thin * unlike()
        x += [2 * long + short, 2 * long + 2 * short]
        r += [heavy, heavy]
        x += [2 * long + 2 * short, 3 * long + 2 * short]
        r += [third, third]
        supports = [{"x": long + 0.5 * short, "type": "clamped"},
                    {"x": 2 * long + 1.5 * short, "type": "clamped"}]
    profile = {"interpolation": "linear", "x": x, "radius": r}
    if taper == 1.0 and rng.random() < 0.8:
        finer(rng, profile, 0 if rng.random() < 0.5 else 4)
    bat = {"profile": profile}
    if supports:
        bat["supports"] = supports
    return bat


def tuned(rng, bat, case, solve, length):
    """An absorber tuned to a mode of the bat, well or nearly."""
    quick = {"modes": 3, "theory": case["theory"], "tolerance": 1e-10}
    answer = solve(bat, quick)[0]
    mode = rng.choice(answer["modes"])
    mass = 10 ** rng.uniform(-9, -2)
    omega = mode["omega_rad_s"] * (1 + rng.choice([0.0, rng.choice([-1, 1]) * 10 ** rng.uniform(-8, -2)]))
    bat["absorbers"] = [{"x": rng.uniform(0.0, length), "mass": mass, "stiffness": mass * omega ** 2}]


def pieces(rng):
    length, count = rng.uniform(0.6, 1.1), rng.randint(1, 3)
    borders = [0.0] + sorted(rng.uniform(0.1, 0.9) * length for _ in range(count - 1)) + [length]
    made = []
    for a, b in zip(borders, borders[1:]):
        text, _ = rng.choice(ORDINARY)
        values = {"a": repr(round(rng.uniform(0.012, 0.02), 6)), "b": repr(round(rng.uniform(0.004, 0.015), 6))}
        made.append({"from": a, "to": b, "formula": text.format(**values)})
    return made


def end(bat):
    profile = bat["profile"]
    return profile["pieces"][-1]["to"] if "pieces" in profile else profile["x"][-1]


# From here on: what the JSON means.

def exact(bat, most, theory):
    """The reference's bat, for λ up to `most`."""
    smooth = radii(bat["profile"])
    nodes = fixtures(bat)
    grip = bat.get("grip")
    cuts = set(nodes) | ({grip["from"], grip["to"]} if grip else set())
    parts = []
    for a, b, outer, inner in smooth:
        borders = [a] + sorted(c for c in cuts if a < c < b) + [b]
        for low, high in zip(borders, borders[1:]):
            bed = grip["stiffness"] if grip and grip["from"] <= low and high <= grip["to"] else None
            parts.append((low, high, section(bat["material"], outer, inner, bed, theory)))
    whole = Bat(parts, nodes, most, theory)
    whole.most = most
    return whole


def section(material, outer, inner, bed, theory):
    density, modulus = arb(material["density"]), arb(material["youngs_modulus"])

    def at(x):
        r, hole = outer(x), inner(x) if inner else None
        square = r * r
        bore = hole * hole if inner else arb_series([0])
        area, second = (square - bore) * PI, (square * square - bore * bore) * (PI / 4)
        slip = turning = arb_series([0])
        if theory != "euler-bernoulli":
            turning = second * density
        if theory == "timoshenko":
            kappa = material.get("shear_coefficient")
            if kappa is None:
                m = bore / square
                nu, whole = arb("0.3"), (m + 1) * (m + 1)
                kappa = whole * (6 * (1 + nu)) / (whole * (7 + 6 * nu) + m * (20 + 12 * nu))
            else:
                kappa = arb_series([arb(kappa)])
            slip = 1 / (kappa * area * arb(material["shear_modulus"]))
        return (second * modulus, slip, area * density, turning,
                None if bed is None else arb_series([arb(bed)]))
    return at


def fixtures(bat):
    nodes = {}
    add = lambda x, what: nodes.setdefault(x, []).append(what)
    for a in bat.get("attachments", []):
        zero = lambda key: a.get(key, 0.0)
        add(a["x"], {"kind": "attachment", "mass": zero("mass"), "offset": zero("offset"),
                     "inertia": zero("rotary_inertia"), "stiffness": zero("stiffness"),
                     "rotational_stiffness": zero("rotational_stiffness")})
    for a in bat.get("absorbers", []):
        add(a["x"], {"kind": "absorber", "mass": a["mass"], "stiffness": a["stiffness"]})
    for j in bat.get("joints", []):
        add(j["x"], {"kind": "joint", "stiffness": j["rotational_stiffness"]})
    for s in bat.get("supports", []):
        add(s["x"], {"kind": s["type"]})
    return nodes


def radii(profile):
    """(from, to, outer, inner) of every smooth piece; the radii take a power series."""
    if "pieces" in profile and "^" in (text := profile["pieces"][0]["formula"]) \
            and (" " not in text and "exp" not in text):
        return pointed(profile["pieces"][0], text)
    if "pieces" in profile:
        return [(p["from"], p["to"], formula(p["formula"]), None) for p in profile["pieces"]]
    x = profile["x"]
    every = [profile["radius"]] + ([profile["inner_radius"]] if "inner_radius" in profile else [])
    curves = [cubics(profile["interpolation"], x, r) for r in every]
    made = []
    for k in range(len(x) - 1):
        if x[k] < x[k + 1]:
            inner = polynomial(x[k], curves[1][k]) if len(curves) > 1 else None
            made.append((x[k], x[k + 1], polynomial(x[k], curves[0][k]), inner))
    return made


def pointed(piece, text):
    """A bat with a pointed end, less the last 1e-10 of it, in pieces that grow away from the point."""
    end, at = piece["to"], formula(text)
    away = [end * 1e-10 * 4.0 ** k for k in range(16)] + [0.5 * end, end]
    mirrored = "-" in text
    places = sorted(end - d for d in away) if mirrored else away
    if mirrored:
        places[0] = 0.0
    return [(a, b, at, None) for a, b in zip(places, places[1:])]


def polynomial(start, coefficients):
    def at(x):
        t, value = x - arb(start), arb_series([0])
        for c in reversed(coefficients):
            value = value * t + c
        return value
    return at


def cubics(interpolation, x, r):
    """Coefficients in the distance from each station, exact in the stations' numbers."""
    x, r = [arb(v) for v in x], [arb(v) for v in r]
    made, k = [None] * (len(x) - 1), 0
    while k < len(x) - 1:
        last = k
        while last + 1 < len(x) and x[last + 1] > x[last]:
            last += 1
        if interpolation == "pchip" and last > k:
            made[k:last] = pchip(x[k:last + 1], r[k:last + 1])
        else:
            for j in range(k, last):
                slope = (r[j + 1] - r[j]) / (x[j + 1] - x[j])
                made[j] = [r[j]] if interpolation == "constant" else [r[j], slope]
        k = last + 1
    return made


def pchip(x, y):
    """Fritsch and Butland's slopes with SciPy's end conditions, as design and README say."""
    n = len(x)
    h = [b - a for a, b in zip(x, x[1:])]
    m = [(b - a) / w for a, b, w in zip(y, y[1:], h)]
    if n == 2:
        return [[y[0], m[0]]]
    d = [arb(0)] * n
    for k in range(1, n - 1):
        if m[k - 1] * m[k] > 0:
            w1, w2 = 2 * h[k] + h[k - 1], h[k] + 2 * h[k - 1]
            d[k] = (w1 + w2) / (w1 / m[k - 1] + w2 / m[k])

    def one_sided(h0, h1, m0, m1):
        slope = ((2 * h0 + h1) * m0 - h0 * m1) / (h0 + h1)
        if not slope * m0 > 0:
            return arb(0)
        if not m0 * m1 > 0 and abs(slope) > 3 * abs(m0):
            return 3 * m0
        return slope
    d[0], d[-1] = one_sided(h[0], h[1], m[0], m[1]), one_sided(h[-1], h[-2], m[-1], m[-2])
    return [[y[k], d[k], (3 * m[k] - 2 * d[k] - d[k + 1]) / h[k],
             (d[k] + d[k + 1] - 2 * m[k]) / h[k] ** 2] for k in range(n - 1)]


def formula(text):
    """The formula that was written with these numbers."""
    import re
    for template, value in FORMULAS:
        pattern = re.escape(template)
        for letter in "ab":
            first = re.escape("{%s}" % letter)
            pattern = pattern.replace(first, rf"(?P<{letter}>[0-9.]+)", 1)
        found = re.fullmatch(pattern, text)
        if found:
            a, b = arb(float(found["a"])), arb(float(found["b"]))
            return lambda x: value(x, a, b)
    raise ValueError(text)
