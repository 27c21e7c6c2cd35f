"""Writes crates/proof/src/gauss_24.txt and gauss_40.txt: Gauss points and Legendre polynomials there.

    python3 search/legendre_tables.py

Everything is computed in 60 decimal digits and written as the nearest doubles.
"""

import pathlib
from decimal import Decimal, getcontext

getcontext().prec = 60
COUNTS = (24, 40)
FOLDER = pathlib.Path(__file__).resolve().parent.parent / "crates/proof/src"


def legendre(x, count):
    """P_0 .. P_(count) at x, by (j + 1) P_(j+1) = (2j + 1) x P_j - j P_(j-1)."""
    values = [Decimal(1), x]
    for j in range(1, count):
        values.append(((2 * j + 1) * x * values[j] - j * values[j - 1]) / (j + 1))
    return values


def cosine(x):
    """cos x by its series; some digits do, Newton's method finds the others."""
    term, total, k = Decimal(1), Decimal(1), 0
    while abs(term) > Decimal(10) ** -30:
        k += 2
        term *= -x * x / (k * (k - 1))
        total += term
    return total


def gauss(n):
    """The zeros of P_n, rising, by Newton's method, and Gauss's weights 2 (1 - x^2) / (n P_(n-1))^2."""
    pi = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")
    points = []
    for k in range(n):
        x = -cosine(pi * (k + Decimal("0.75")) / (n + Decimal("0.5")))
        for _ in range(12):
            p = legendre(x, n)
            slope = n * (p[n - 1] - x * p[n]) / (1 - x * x)
            x -= p[n] / slope
        p = legendre(x, n)
        assert abs(p[n]) < Decimal(10) ** -50
        points.append((x, 2 * (1 - x * x) / (n * p[n - 1]) ** 2))
    return points


def line(numbers):
    """Numbers as the shortest decimals that give the nearest doubles."""
    return " ".join(repr(float(number)) for number in numbers)


def table(n):
    """The points above 0; below it P_j has the same values for even j and the opposite for odd j."""
    points = gauss(n)
    assert abs(sum(w for _, w in points) - 2) < Decimal(10) ** -50
    points = points[n // 2 :]
    values = [legendre(x, n) for x, _ in points]
    yield f"# {n} Gauss points on [-1, 1], written by search/legendre_tables.py from 60 digits: nearest doubles."
    yield f"# A row holds the {n // 2} points x above 0, or what belongs to each of them. The rows: x; the weights w;"
    yield f"# Legendre's P_j(x), j = 0 to {n - 1}; (2j + 1)/2 w P_j(x), j = 0 to {n - 1}."
    yield line(x for x, _ in points)
    yield line(w for _, w in points)
    for j in range(n):
        yield line(v[j] for v in values)
    for j in range(n):
        scale = Decimal(2 * j + 1) / 2
        yield line(scale * w * v[j] for (_, w), v in zip(points, values))


for n in COUNTS:
    (FOLDER / f"gauss_{n}.txt").write_text("".join(row + "\n" for row in table(n)))
