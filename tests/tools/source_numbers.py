#!/usr/bin/env python3
"""Numbers of the sources: length of functions and files, circles of includes.

    source_numbers.py SOURCE_DIR

A function is counted from the line of its opening brace (column 0) to that of its closing one, as .clang-format sets
them, its head included. Complains (and exits with 1) when one has more than 60 lines, when the median is above 12, when
a file has more than 600, when headers include each other in a circle, and when units do (`x.c` counts with `x.h`, which
it implements) that are not among those that have long done so, `OLD`: that list only gets shorter.
"""
import pathlib
import re
import statistics
import sys

MOST_LINES, MEDIAN, FILE_LINES = 60, 12, 600
OLD = []
INCLUDE = re.compile(r'#include "([a-z_]+/[a-z0-9_]+)\.h"')
HEAD = re.compile(r"^[A-Za-z_][^;={}]*\)\s*$")


def functions(lines):
    """(line number, lines) of each function, from the first line of its head."""
    start = None
    for number, line in enumerate(lines):
        if line.rstrip() == "{" and number and HEAD.match(head_of(lines, number)):
            start = number - head_of(lines, number).count("\n") - 1
        elif line.rstrip() == "}" and start is not None:
            yield start + 1, number - start + 1
            start = None


def head_of(lines, brace):
    """The lines above a brace that belong to the head of a function, joined."""
    first = brace - 1
    while first > 0 and lines[first].startswith(" ") and not lines[first - 1].rstrip().endswith((";", "}")):
        first -= 1
    return "\n".join(line.rstrip() for line in lines[first:brace])


def unit_of(path):
    return str(path.with_suffix(""))


def circles(graph):
    """Sets of nodes that all reach each other (Tarjan), of more than one node."""
    index, low, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in graph.get(node, ()):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            place = stack.index(node)
            if len(stack) - place > 1:
                found.append(set(stack[place:]))
            del stack[place:]

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return found


def main():
    source = pathlib.Path(sys.argv[1]) / "src"
    sys.setrecursionlimit(10000)
    complaints, lengths, units, headers = [], [], {}, {}
    for path in sorted(source.rglob("*.[ch]")):
        name = path.relative_to(source)
        lines = path.read_text().splitlines()
        if len(lines) > FILE_LINES:
            complaints.append(f"src/{name} has {len(lines)} lines")
        for start, length in functions(lines):
            lengths.append(length)
            if length > MOST_LINES:
                complaints.append(f"src/{name}:{start} is a function of {length} lines")
        unit = unit_of(name)
        wanted = {found[1] for line in lines if (found := INCLUDE.match(line))} - {unit}
        units.setdefault(unit, set()).update(wanted)
        if name.suffix == ".h":
            headers[unit] = wanted
    median = statistics.median(lengths)
    if median > MEDIAN:
        complaints.append(f"the median function has {median:g} lines")
    complaints += [f"a circle of headers: {sorted(one)}" for one in circles(headers)]
    loops = circles(units)
    complaints += [f"a circle of units: {sorted(one)}" for one in loops if not any(one <= old for old in OLD)]
    complaints += [f"no circle any more, strike it: {sorted(old)}" for old in OLD if not any(one <= old for one in loops)]
    for complaint in complaints:
        print("FAIL:", complaint)
    print(f"{len(lengths)} functions: median {median:g} lines, longest {max(lengths)}; {len(loops)} old circles of units")
    return bool(complaints)


if __name__ == "__main__":
    sys.exit(main())
