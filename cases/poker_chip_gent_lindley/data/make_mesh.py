#!/usr/bin/env python3
"""Writes disc.msh: a sector of 5 degrees of the upper half of a bonded disc, one cell wide; SI units.

    python3 make_mesh.py [cells along the radius] [cells across half the thickness]
"""
import math
import sys

RADIUS, HALF, INNER, ANGLE = 10e-3, 0.95e-3, 0.1e-3, math.radians(5)


def graded(a, b, n, ratio):
    """n cells from a to b, the last one `ratio` times the first."""
    q = ratio ** (1 / max(n - 1, 1))
    total = sum(q**i for i in range(n))
    points, at = [a], a
    for i in range(n):
        at += (b - a) * q**i / total
        points.append(at)
    return points


def main():
    nr, nz = (int(x) for x in sys.argv[1:3]) if len(sys.argv) > 2 else (60, 12)
    radii, heights = graded(INNER, RADIUS, nr, 0.25), graded(0, HALF, nz, 0.3)
    points = [(r * math.cos(s * ANGLE / 2), r * math.sin(s * ANGLE / 2), z)
              for z in heights for r in radii for s in (-1, 1)]

    def at(i, k, side):  # from 1
        return 1 + 2 * (i + (nr + 1) * k) + side

    names = ["inner", "outer", "zmin", "zmax", "front", "back"]
    quads = {name: [] for name in names}
    hexes = []
    for k in range(nz):
        quads["inner"].append((at(0, k, 0), at(0, k, 1), at(0, k + 1, 1), at(0, k + 1, 0)))
        quads["outer"].append((at(nr, k, 0), at(nr, k, 1), at(nr, k + 1, 1), at(nr, k + 1, 0)))
        for i in range(nr):
            low = (at(i, k, 0), at(i + 1, k, 0), at(i + 1, k, 1), at(i, k, 1))
            high = (at(i, k + 1, 0), at(i + 1, k + 1, 0), at(i + 1, k + 1, 1), at(i, k + 1, 1))
            hexes.append(low + high)
            quads["front"].append((low[0], low[1], high[1], high[0]))
            quads["back"].append((low[3], low[2], high[2], high[3]))
            if k == 0:
                quads["zmin"].append(low)
            if k == nz - 1:
                quads["zmax"].append(high)
    with open("disc.msh", "w") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n7\n")
        for n, name in enumerate(names, 1):
            out.write(f'2 {n} "{name}"\n')
        out.write(f'3 7 "body"\n$EndPhysicalNames\n$Nodes\n{len(points)}\n')
        for n, p in enumerate(points, 1):
            out.write(f"{n} {p[0]:.9g} {p[1]:.9g} {p[2]:.9g}\n")
        out.write(f"$EndNodes\n$Elements\n{len(hexes) + sum(len(q) for q in quads.values())}\n")
        n = 0
        for tag, name in enumerate(names, 1):
            for q in quads[name]:
                n += 1
                out.write(f"{n} 3 2 {tag} {tag} {' '.join(map(str, q))}\n")
        for h in hexes:
            n += 1
            out.write(f"{n} 5 2 7 7 {' '.join(map(str, h))}\n")
        out.write("$EndElements\n")


main()
