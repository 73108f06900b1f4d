"""The state checksum of the states of tests/unit/test_checksum.c, from the text of docs/architecture.md alone.

Prints the six numbers that the test holds, in 2D and 3D each: without and with a periodic cell and a wall of the case;
and the first again with body 1 taken out, of which the contacts go.
"""
import struct

MASK = (1 << 64) - 1


def word(c, w):
    z = ((c ^ w) + 0x9E3779B97F4A7C15) & MASK
    z = ((z ^ z >> 30) * 0xBF58476D1CE4E5B9) & MASK
    z = ((z ^ z >> 27) * 0x94D049BB133111EB) & MASK
    return z ^ z >> 31


def number(c, x):
    return word(c, struct.unpack("<Q", struct.pack("<d", x))[0] if x else 0)


def numbers(c, xs):
    for x in xs:
        c = number(c, x)
    return c


def material(m):
    return numbers(0, [2000 + 500 * m, 1e9 + m, 2e9, 0.25 + 0.25 * m, 0.125, 0.0625, 0])


def bodies(c, d, holes):
    c = word(c, 2 if holes else 3)
    if holes:
        c = word(c, 3)
    for k in range(3):
        if holes and k == 1:
            continue
        if holes:
            c = word(c, k)
        n = k + 1
        c = numbers(c, [n, -n, 4 * n][:d])
        c = numbers(c, [0.1 * n, 0.2 * n, 0.3 * n][:d])
        c = numbers(c, [7 * n] if d == 2 else [n, 2 * n, 3 * n])
        c = numbers(c, [0.5 * n, 3 * n])
        c = word(c, material(1 if k == 2 else 0))
        c = numbers(c, [f * 0.25 for f in [10 * k, -k, 5 * k][:d]])
        c = numbers(c, [t * 0.125 for t in ([100 * k] if d == 2 else [k, 2 * k, 3 * k])])
    return c


def contacts(c, d, holes):
    memory = [  # first, kind of the second (body, element, plate), its number, slip, rolling; the second remembers nothing
        (0, 0, 1, [0.5, 0.25, 0.125], [1.5, 0, 0, 0]),
        (1, 1, 3, [-1, -2, -3], [3.5, 0, -2, 4]),
        (1, 2, 1, [4, 5, 6], [4.5, 0, -3, 6]),
    ]
    if holes:
        memory = []
    for first, kind, second, slip, rolling in memory:
        for w in (first, kind, second):
            c = word(c, w)
        c = numbers(c, slip if d == 3 else slip[:1])
        c = numbers(c, rolling if d == 3 else rolling[:1])
    return word(c, len(memory))


def walls(c, full):
    c = word(c, 1)  # the top plate
    c = numbers(c, [-9, 0.75, 1, 2, 3])
    if full:
        time = 6 * 0.5
        for centre, velocity, spin in zip([0.5, 0.25, 0], [1, 2, 3], [0, 4, 0]):
            c = numbers(c, [centre + velocity * time, spin * time, velocity, spin])
    return c


def state(d, full, holes):
    c = word(word(0, d), 1234)
    c = number(c, 0.5)
    c = walls(contacts(bodies(c, d, holes), d, holes), full)
    if full:
        c = word(c, 1)
        c = numbers(c, [k + 1 for k in range(9)])
        c = numbers(c, [0.25 * k for k in range(9)])
        c = numbers(c, [0.5 * k for k in range(9)])
    c = numbers(c, [0.001 * k for k in range(9)])
    return numbers(c, range(1, 14 if holes else 13))


for full, holes in ((False, False), (True, False), (False, True)):
    print(*(f"0x{state(d, full, holes):016x}" for d in (2, 3)))
