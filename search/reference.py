"""Modes of a bat by exact dynamic stiffness in multiprecision, with certified mode numbers.

A bat is cut into segments on which its section is smooth. On a segment the equations of the beam,

    w' = θ + Q/κGA,  θ' = M/EI,  Q' = (k − λρA) w,  M' = −Q − λρI θ

(Q/κGA = 0 without shear, ρI = 0 for Euler-Bernoulli, k an elastic bed), are solved by power series
in x and in λ = ω², which gives the exact dynamic stiffness of the segment for any λ. The number of
modes below λ is that of the negative pivots of the assembled stiffness, because no segment held at
both ends has a mode of its own below the largest λ (W. H. Wittrick, F. W. Williams, Quart. J. Mech.
Appl. Math. 24 (1971) 263); that is shown for every segment by the balls of python-flint's `arb`.
Numbers have 256 bits, and the series are cut where a term is below 1e-22. Nothing here is shared
with the program.
"""

import numpy as np
from flint import arb, arb_poly, arb_series, ctx

TERMS = 40          # of a power series on a segment
BITS = 256
ctx.prec = BITS
ctx.cap = TERMS
PI = arb.pi()
GAUSS = np.polynomial.legendre.leggauss(32)


def inverse(m):
    (a, b), (c, d) = m
    det = a * d - b * c
    return [[d / det, -b / det], [-c / det, a / det]]


def times(m, n):
    return [[sum((m[i][k] * n[k][j] for k in range(len(n))), arb(0)) for j in range(len(n[0]))]
            for i in range(len(m))]


def plus(m, n, sign=1):
    return [[a + sign * b for a, b in zip(r, s)] for r, s in zip(m, n)]


def transposed(m):
    return [list(row) for row in zip(*m)]


def mirrored(m):
    """A matrix in (w, θ) seen from the other end."""
    return [[m[0][0], -m[0][1]], [-m[1][0], m[1][1]]]


def middles(m):
    """Without the radii, which would grow from segment to segment by what cancels in each: 256 bits
    are so many more than what cancels in all of them."""
    return [[arb(v.mid()) for v in row] for row in m]


class Unresolved(Exception):
    """A segment is too long for its series, or too long for the largest λ."""


class Segment:
    """The beam between `a` and `b`; `section(x)` gives EI, 1/κGA (0: rigid), ρA, ρI and bed."""

    def __init__(self, a, b, section, most):
        self.a, self.b = a, b
        self.half = (arb(b) - arb(a)) / 2
        x = arb_series([(arb(a) + arb(b)) / 2, self.half])
        stiffness, slip, self.line, self.turning, bed = section(x)
        one = arb_series([1])
        self.bends = one / stiffness
        for series in [self.bends, slip, self.line, self.turning]:
            c = [abs(float(v.mid())) for v in arb_series(series).coeffs()] or [0.0]
            if len(c) >= TERMS - 1 and max(c[-3:]) > 1e-22 * max(c):
                raise Unresolved
        self.slip, self.bed = slip, bed
        self.by_lambda = []                     # [k][column] = (w, θ, Q, M) as series
        before = None
        for k in range(40):
            now = [self.solved(k, j, before) for j in range(4)]
            self.by_lambda.append(now)
            if k > 2 and self.negligible(now, arb(most) ** k):
                break
            before = [column for column in now]
        else:
            raise Unresolved
        # No mode of its own below the largest λ: the determinant keeps its sign.
        everywhere = arb(mid=arb(most) / 2, rad=arb(most) / 2)
        self.ends = [[arb_poly([self.at_end(c[j][i]) for c in self.by_lambda]) for j in range(4)] for i in range(4)]
        uf = [[self.ends[i][j](everywhere) for j in (2, 3)] for i in (0, 1)]
        det = uf[0][0] * uf[1][1] - uf[0][1] * uf[1][0]
        if not (det > 0 or det < 0):
            raise Unresolved

    @staticmethod
    def at_end(series):
        total = arb(0)
        for c in arb_series(series).coeffs():
            total += c
        return total

    def integral(self, series, start):
        """From u = −1, times half the length, and the value there."""
        total = arb_series(series).integral()
        left = arb(0)
        for k, c in enumerate(total.coeffs()):
            left += c if k % 2 == 0 else -c
        return (total - left) * self.half + start

    def solved(self, k, column, before):
        """The part of λ^k in the solution that is the unit vector `column` at the left end."""
        zero = arb_series([0])
        start = [arb(int(k == 0 and column == i)) for i in range(4)]
        w = zero
        for _ in range(1 if self.bed is None else 14):
            force = zero if self.bed is None else self.bed * w
            couple = zero
            if before is not None:
                force = force - self.line * before[column][0]
                couple = couple - self.turning * before[column][1]
            q = self.integral(force, start[2])
            m = self.integral(couple - q, start[3])
            theta = self.integral(self.bends * m, start[1])
            w = self.integral(theta + self.slip * q, start[0])
        return (w, theta, q, m)

    def negligible(self, now, scale):
        first = self.by_lambda[0]
        for j in range(4):
            for i in range(4):
                size = max(abs(float(c.mid())) for c in first[j][i].coeffs() or [arb(0)])
                own = max([abs(float((c * scale).mid())) for c in now[j][i].coeffs()] or [0.0])
                if size > 0 and own > 1e-26 * size:
                    return False
        return True

    def transfer(self, lam):
        return [[self.ends[i][j](lam) for j in range(4)] for i in range(4)]

    def stiffness(self, lam):
        t = self.transfer(lam)
        uu, uf = [r[:2] for r in t[:2]], [r[2:] for r in t[:2]]
        fu, ff = [r[:2] for r in t[2:]], [r[2:] for r in t[2:]]
        inv = inverse(uf)
        return times(inv, uu), [[-v for v in r] for r in inv], times(ff, inv)

    def shape(self, lam, left, right):
        """Coefficients in u of w and θ where the ends move so, as floats."""
        t = self.transfer(lam)
        uu, uf = [r[:2] for r in t[:2]], [r[2:] for r in t[:2]]
        rest = plus([[v] for v in right], times(uu, [[v] for v in left]), -1)
        state = left + [row[0] for row in times(inverse(uf), rest)]
        sums = [arb_series([0]), arb_series([0])]
        power = arb(1)
        for term in self.by_lambda:
            for j in range(4):
                for i in range(2):
                    sums[i] = sums[i] + term[j][i] * (power * state[j])
            power = power * lam
        return [np.array([float(c.mid()) for c in s.coeffs()] or [0.0]) for s in sums]


class Bat:
    """Segments and what stands at their borders, up to λ = `most`."""

    def __init__(self, pieces, nodes, most, theory):
        """`pieces`: (a, b, section); `nodes`: {x: [fixture, …]}, all x borders of pieces."""
        self.theory = theory
        self.segments = []
        for a, b, section in pieces:
            self.cut(a, b, section, most)
        self.borders = [self.segments[0].a] + [s.b for s in self.segments]
        self.fixtures = [nodes.get(x, []) for x in self.borders]

    def cut(self, a, b, section, most, depth=0):
        try:
            self.segments.append(Segment(a, b, section, most))
        except Unresolved:
            if depth > 14:
                raise
            middle = 0.5 * (a + b)
            self.cut(a, middle, section, most, depth + 1)
            self.cut(middle, b, section, most, depth + 1)

    def sweep(self, stiffnesses, lam, back=False):
        """Over every border, from one end on: the form of what lies before it, without and with
        the fixtures there, and what takes it to the next; and all pivots."""
        steps, pivots = {}, []
        form = [[arb(0), arb(0)], [arb(0), arb(0)]]
        order = range(len(self.borders))
        for i in reversed(order) if back else order:
            before = form
            form, own = self.through(form, self.fixtures[i], lam, back)
            pivots += own
            k = i - 1 if back else i
            if not 0 <= k < len(stiffnesses):
                steps[i] = (before, form, None)
                pivots += eliminated(form, self.held(i))[1]
                break
            aa, ab, bb = stiffnesses[k]
            if back:
                aa, ab, bb = mirrored(bb), mirrored(transposed(ab)), mirrored(aa)
            inv, own = eliminated(plus(form, aa), self.held(i))
            pivots += own
            onwards = times(inv, ab)
            steps[i] = (before, form, onwards)
            form = middles(plus(bb, times(transposed(ab), onwards), -1))
        return steps, pivots

    def held(self, i):
        kinds = {f["kind"] for f in self.fixtures[i]}
        return "clamped" if "clamped" in kinds else "pinned" if "pinned" in kinds else None

    def through(self, form, fixtures, lam, back):
        pivots = []
        for f in fixtures:
            (a, b), (_, d) = form
            if f["kind"] == "attachment":
                o = arb(f["offset"]) * (-1 if back else 1)
                m, spring, turn = lam * f["mass"], arb(f["stiffness"]), arb(f["rotational_stiffness"])
                a, b, d = a + spring - m, b - m * o, d + turn - m * o * o - lam * f["inertia"]
            elif f["kind"] == "absorber":
                k, left = arb(f["stiffness"]), arb(f["stiffness"]) - lam * f["mass"]
                pivots.append(left)
                a = a - lam * f["mass"] * k / left
            elif f["kind"] == "joint":
                k = arb(f["stiffness"])
                pivot = d + k
                pivots.append(pivot)
                a, b, d = a - b * b / pivot, b * k / pivot, k - k * k / pivot
            form = [[a, b], [b, d]]
        return form, pivots

    def count(self, lam):
        """How many modes, rigid ones included, are below λ: certain."""
        lam = arb(lam)
        pivots = self.sweep([s.stiffness(lam) for s in self.segments], lam)[1]
        return sum(is_negative(pivot) for pivot in pivots)

    def forms(self, lam):
        """At every border that is free to move, the form of the whole bat in its motion there."""
        stiffnesses = [s.stiffness(lam) for s in self.segments]
        left, _ = self.sweep(stiffnesses, lam)
        right, _ = self.sweep(stiffnesses, lam, back=True)
        free = [i for i in range(len(self.borders)) if self.held(i) is None]
        return {i: plus(left[i][1], mirrored(right[i][0])) for i in free}, left, right

    def find(self, number, low, high):
        """λ of mode `number` (rigid ones counted, from 1), that lies between."""
        low, high, counts = arb(low), arb(high), [0, 10**6]
        halvings = 0
        while halvings < 10 or counts[1] - counts[0] > 1:
            middle = arb(((low + high) / 2).mid())
            count = self.count(middle)
            low, high = (low, middle) if count >= number else (middle, high)
            counts = [counts[0], count] if count >= number else [count, counts[1]]
            halvings += 1
            if halvings > 200:
                raise ArithmeticError("two modes of one frequency")
        middle = arb(((low + high) / 2).mid())
        size = lambda f: abs(float(det(f).mid())) / (abs(float(f[0][0].mid())) + abs(float(f[1][1].mid())))
        forms = self.forms(middle)[0]
        at = min(forms, key=lambda i: size(forms[i]))
        value = lambda lam: arb(det(self.forms(lam)[0][at]).mid())
        x, y = arb((low + (high - low) * arb(0.4)).mid()), middle
        of_x, of_y = value(x), value(y)
        for _ in range(60):
            if of_x == of_y:
                break
            step = of_y * (y - x) / (of_y - of_x)
            x, of_x = y, of_y
            y = arb((y - step).mid())
            if not (low < y and y < high):
                # A pole is near: halve once more and try again.
                middle = arb(((low + high) / 2).mid())
                low, high = (low, middle) if self.count(middle) >= number else (middle, high)
                x, y = arb((low + (high - low) * arb(0.4)).mid()), arb(((low + high) / 2).mid())
                of_x, of_y = value(x), value(y)
                continue
            if abs(float((step / y).mid())) < 1e-30:
                return y, at
            of_y = value(y)
        raise ArithmeticError("no convergence")

    def mode(self, number, low, high):
        """ω (rad/s), modal mass (kg) and nodes (m) of mode `number`, as in [`find`]."""
        lam, at = self.find(number, low, high)
        forms, left, right = self.forms(lam)
        (a, b), (_, d) = forms[at]
        start = [-b, a] if abs(float(a.mid())) > abs(float(d.mid())) else [d, -b]
        after, before = {at: start}, {at: self.behind(at, left, start)}
        for i in range(at, 0, -1):
            u = [[-v] for v in before[i]]
            after[i - 1] = [row[0] for row in times(left[i - 1][2], u)]
            before[i - 1] = self.behind(i - 1, left, after[i - 1])
        for i in range(at, len(self.borders) - 1):
            u = [[-after[i][0]], [after[i][1]]]
            row = [row[0] for row in times(right[i + 1][2], u)]
            far = self.behind(i + 1, right, row)
            before[i + 1], after[i + 1] = [row[0], -row[1]], [far[0], -far[1]]
        return self.figures(lam, after, before)

    def behind(self, i, steps, u):
        """The motion on the near side of a joint from that on the far one."""
        for f in self.fixtures[i]:
            if f["kind"] == "joint":
                (_, b), (_, d) = steps[i][0]
                k = arb(f["stiffness"])
                return [u[0], (k * u[1] - b * u[0]) / (d + k)]
        return u

    def figures(self, lam, after, before):
        lam_f = float(lam.mid())
        mass, most, nodes, last = 0.0, 0.0, [], 0.0
        biggest = max(abs(float(u[0].mid())) for u in after.values()) or 1.0
        previous = None
        grid = -np.cos(np.linspace(0, np.pi, 49))
        for k, s in enumerate(self.segments):
            w, theta = s.shape(lam, after[k], before[k + 1])
            turns = 0 if self.theory == "euler-bernoulli" else 1
            line, turning = [np.array([float(c.mid()) for c in arb_series(v).coeffs()] or [0.0])
                             for v in (s.line, s.turning)]
            value = lambda c, u: np.polynomial.polynomial.polyval(u, c)
            half, (points, weights) = float(s.half.mid()), GAUSS
            mass += half * np.sum(weights * (value(line, points) * value(w, points) ** 2
                                  + turns * value(turning, points) * value(theta, points) ** 2))
            samples = value(w, grid)
            slope = np.polynomial.polynomial.polyder(w)
            bend = np.polynomial.polynomial.polyder(slope)
            top = int(np.argmax(np.abs(samples)))
            most = max(most, abs(samples[top]))
            # Beside a border the largest deflection may be between it and the first place too.
            u = grid[top]
            for _ in range(8):
                bent = value(bend, u)
                u = np.clip(u - value(slope, u) / bent, -1, 1) if bent else u
            most = max(most, abs(value(w, u)))
            middle = 0.5 * (s.a + s.b)
            # Round-off of the sum is no sign; nor is what 256 bits leave of a part at rest.
            least = max(1e-14 * float(np.sum(np.abs(w))), 1e-30 * biggest)
            for u, here in zip(grid, samples):
                if abs(here) < least:
                    continue
                if previous is not None and previous[1] * here < 0:
                    nodes.append(self.zero(previous, (k, u), w, here, middle, half))
                previous = ((k, u), here, middle + half * u, w)
        for i, fixtures in enumerate(self.fixtures):
            w, theta = (float(v.mid()) for v in after[i])
            for f in fixtures:
                if f["kind"] == "attachment":
                    mass += f["mass"] * (w + f["offset"] * theta) ** 2 + f["inertia"] * theta ** 2
                elif f["kind"] == "absorber":
                    mass += f["mass"] * (w / (1 - lam_f * f["mass"] / f["stiffness"])) ** 2
        return {"frequency": float((lam.sqrt() / (2 * PI)).mid()), "mass": mass / most ** 2,
                "nodes": nodes}

    @staticmethod
    def zero(previous, now, w, here, middle, half):
        if previous[0][0] != now[0]:
            low = -1.0          # between two segments: at their border, or just inside of this one
        else:
            low = previous[0][1]
        high = now[1]
        value = lambda u: np.polynomial.polynomial.polyval(u, w)
        if value(low) * here > 0:
            return middle + half * low
        for _ in range(60):
            u = 0.5 * (low + high)
            low, high = (low, u) if value(u) * here > 0 else (u, high)
        return middle + half * 0.5 * (low + high)


def det(m):
    return m[0][0] * m[1][1] - m[0][1] * m[1][0]


def is_negative(pivot):
    if pivot < 0:
        return 1
    if pivot > 0:
        return 0
    raise ArithmeticError("a pivot of no sign: more bits are needed")


def eliminated(form, held):
    """The inverse on what may move, and its pivots."""
    zero = arb(0)
    (a, b), (_, d) = form
    if held == "clamped":
        return [[zero, zero], [zero, zero]], []
    if held == "pinned":
        return [[zero, zero], [zero, 1 / d]], [d]
    return inverse(form), [a, d - b * b / a]
