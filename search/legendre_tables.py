"""Writes src/base/interval/tables.rs: Gauss points and Legendre polynomials there, for intervals.

    python3 search/legendre_tables.py > src/base/interval/tables.rs

Everything is computed in 60 decimal digits and written as the nearest doubles.
"""

from decimal import Decimal, getcontext

getcontext().prec = 60
COUNTS = (24, 40)


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


def line(numbers, indent):
    """Numbers as the shortest decimals that give the nearest doubles."""
    out, row = [], " " * indent
    for number in numbers:
        text = repr(float(number)) + ","
        if len(row) + 1 + len(text) > 100:
            out.append(row)
            row = " " * indent
        row += (" " if row.strip() else "") + text
    return "\n".join(out + [row])


def table(n):
    """The points above 0; below it P_j has the same values for even j and the opposite for odd j."""
    points = gauss(n)
    assert abs(sum(w for _, w in points) - 2) < Decimal(10) ** -50
    points = points[n // 2 :]
    values = [legendre(x, n) for x, _ in points]
    print("#[rustfmt::skip]")
    print(f"const HALF_OF_{n}: Half<{n // 2}, {n}> = Half {{")
    print("    points: [")
    print(line([x for x, _ in points], 8))
    print("    ],\n    weights: [")
    print(line([w for _, w in points], 8))
    print("    ],\n    legendre: [")
    for j in range(n):
        print("        [")
        print(line([v[j] for v in values], 12))
        print("        ],")
    print("    ],\n    to_series: [")
    for j in range(n):
        print("        [")
        scale = Decimal(2 * j + 1) / 2
        print(line([scale * w * v[j] for (_, w), v in zip(points, values)], 12))
        print("        ],")
    print("    ],\n};")


print("//! What are the Gauss points, and Legendre's polynomials there, to the last bit?")
print("//!")
print("//! Written by `search/legendre_tables.py` from 60 digits: every number is the double nearest to the")
print("//! true one. Tests hold them against identities in twice the digits.")
print()
print("use super::gauss::{Gauss, Half};")
for n in COUNTS:
    print(f"\n/// {n} points.")
    print(f"pub static GAUSS_{n}: Gauss<{n}> = HALF_OF_{n}.whole();")
for n in COUNTS:
    print()
    table(n)
