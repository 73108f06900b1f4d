#!/usr/bin/env python3
"""Surface to volume: fits the ghosts of a process to the counts of bench/ranks.sh, and says what follows for many.

ranks_fit.py DIMENSION COUNT TABLE. In the mean a process with n bodies has g = a n^((d-1)/d) + b n^((d-2)/d) ghosts (a
layer on its faces, and along its edges), or g = a n^((d-1)/d) alone; least squares of g over its prediction, over the
rows with at least `LEAST` processes, whose parts have neighbours on all sides. Bytes and messages follow from g.
"""

import sys

LEAST = 8  # processes from which on parts of a periodic cell have others on all sides


def read(path):
    """Rows: processes, bodies, ghosts, most, neighbours, bytes, reductions."""
    with open(path, encoding="ascii") as table:
        rows = [line.split() for line in table]
    return [[float(row[k]) for k in (0, 1, 2, 3, 4, 5, 7)] for row in rows if int(row[0]) > 1]


def fit(rows, powers):
    """Coefficients by which sum over rows of (sum_k c_k n^p_k / g - 1)^2 is least: one or two powers."""
    columns = [[row[1] ** power / row[2] for row in rows] for power in powers]
    matrix = [[sum(x * y for x, y in zip(a, b)) for b in columns] for a in columns]
    right = [sum(a) for a in columns]
    if len(powers) == 1:
        return [right[0] / matrix[0][0]]
    determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0]
    return [
        (right[0] * matrix[1][1] - right[1] * matrix[0][1]) / determinant,
        (right[1] * matrix[0][0] - right[0] * matrix[1][0]) / determinant,
    ]


def main():
    """Prints both fits with their deviations, and the means that they are used with."""
    dimension, count, path = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    rows = [row for row in read(path) if row[0] >= LEAST]
    if len(rows) < 2:
        print(f"no fit: less than two rows with {LEAST} processes")
        return
    surface, edge = (dimension - 1) / dimension, (dimension - 2) / dimension
    for powers in ([surface], [surface, edge]):
        numbers = fit(rows, powers)
        wrong = max(abs(sum(c * row[1] ** p for c, p in zip(numbers, powers)) / row[2] - 1) for row in rows)
        terms = " + ".join(f"{c:.3g} n^{p:.3g}" for c, p in zip(numbers, powers))
        print(f"{dimension}D, {count} bodies: ghosts of a process = {terms}, within {100 * wrong:.0f} %")
    each = sum(row[5] / row[2] for row in rows) / len(rows)
    most = max(row[3] / row[2] for row in rows)
    print(f"bytes sent a step and ghost {each:.0f}; process with most ghosts {most:.2f} times the mean")


main()
