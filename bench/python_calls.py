"""Microseconds of calls from Python: python_calls.py (with PYTHONPATH=build/python)."""
import time

import scree


def best(function, count=20000):
    least = float("inf")
    for _ in range(7):
        begin = time.perf_counter()
        for _ in range(count):
            function()
        least = min(least, (time.perf_counter() - begin) / count)
    return 1e6 * least


simulation = scree.Simulation(scree.Case("biaxial", quick=True), 1)
simulation.step(200)


def first_view():
    simulation._seen.clear()
    simulation.view("position")


for name, function in [
    ("`view(name)`, again", lambda: simulation.view("position")),
    ("`view(name)`, the first time", first_view),
    ("`time`", lambda: simulation.time),
    ("`len(simulation)`", lambda: len(simulation)),
    ("`step(0)`", lambda: simulation.step(0)),
    ("`volume`", lambda: simulation.volume),
]:
    print(f"| {name} | {best(function):.2f} |")
