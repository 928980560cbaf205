#!/usr/bin/env python3
"""Writes grain.stl: a cuboctahedron (a cube cut at the middles of its edges), as text. Synthetic; no grain was measured."""

from itertools import product
from pathlib import Path

CORNERS = [c for c in product((-1.0, 0.0, 1.0), repeat=3) if sorted(map(abs, c)) == [0.0, 1.0, 1.0]]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def side(normal):
    """The corners furthest along the normal, counter-clockwise seen from outside."""
    most = max(sum(n * x for n, x in zip(normal, c)) for c in CORNERS)
    corners = [c for c in CORNERS if abs(sum(n * x for n, x in zip(normal, c)) - most) < 1e-9]
    loop = [corners.pop(0)]
    while corners:  # the next corner has no other one to its right
        for c in corners:
            edge = [x - y for x, y in zip(c, loop[-1])]
            inwards = cross(normal, edge)
            others = [o for o in corners + loop if o not in (c, loop[-1])]
            if all(sum(i * (x - y) for i, x, y in zip(inwards, o, loop[-1])) > -1e-9 for o in others):
                loop.append(c)
                corners.remove(c)
                break
    return loop


normals = [n for n in product((-1, 0, 1), repeat=3) if sum(map(abs, n)) in (1, 3)]
with open(Path(__file__).parent / "grain.stl", "w") as file:
    file.write("solid synthetic: a cuboctahedron, edges of 2^(1/2); made by make_synthetic.py\n")
    for normal in normals:
        loop = side(normal)
        for i in range(1, len(loop) - 1):
            length = sum(n * n for n in normal) ** 0.5
            file.write("facet normal {:.9g} {:.9g} {:.9g}\n  outer loop\n".format(*(n / length for n in normal)))
            for c in (loop[0], loop[i], loop[i + 1]):
                file.write("    vertex {:g} {:g} {:g}\n".format(*c))
            file.write("  endloop\nendfacet\n")
    file.write("endsolid synthetic\n")
