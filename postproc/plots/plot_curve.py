#!/usr/bin/env python3
"""Plots force-displacement curves (force_displacement.csv) into one picture.

Needs the Debian package python3-matplotlib.
"""

import argparse
import pathlib
import re

from plotting import PREFIXES, new_picture, prefix_of, read_columns, save_picture

DIRECTIONS = "xyz"


def pulled_direction(curve):
    """The direction in which the largest force acts."""
    return max(DIRECTIONS, key=lambda d: max(map(abs, curve[f"force_{d}_N"])))


def read_curve(path, direction):
    """Displacements [m] and forces [N]."""
    curve = read_columns(path)
    return curve["displacement_m"], curve[f"force_{direction or pulled_direction(curve)}_N"]


def read_other(path):
    """The same of another source: the first two columns, with units in their names as "displacement_mm", "force_kN"."""
    factors = {prefix: factor for factor, prefix in PREFIXES.items()} | {"u": 1e-6}
    curve = []
    for name, values in list(read_columns(path).items())[:2]:
        unit = re.search("_([a-zA-Z]?)[mN]$", name)
        if unit is None or unit[1] not in factors:
            raise SystemExit(f"{path}: the name of the column {name} does not end with a unit of length or force")
        curve.append([factors[unit[1]] * value for value in values])
    return tuple(curve)


def plot(axes, displacement, force, label):
    (line,) = axes.plot(displacement, force, lw=1.6, marker="o", ms=2.5, label=label)
    peak = max(range(len(force)), key=lambda i: abs(force[i]))
    axes.plot(displacement[peak], force[peak], "o", ms=7, mfc="none", mec=line.get_color())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("curves", nargs="+", type=pathlib.Path, help="force_displacement.csv files")
    parser.add_argument("--labels", nargs="*", help="one per curve; default: the case's folder")
    parser.add_argument("--direction", choices=DIRECTIONS, help="of the force; default: that of the largest")
    parser.add_argument("--unsigned", action="store_true", help="displacements and forces without their signs")
    parser.add_argument("--beside", nargs=2, metavar=("CSV", "LABEL"), help="a curve of another source")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("force_displacement.png"))
    arguments = parser.parse_args()
    labels = arguments.labels or [path.absolute().parent.parent.name for path in arguments.curves]
    if len(labels) != len(arguments.curves):
        parser.error(f"{len(labels)} labels for {len(arguments.curves)} curves")

    figure, axes = new_picture()
    curves = [read_curve(path, arguments.direction) for path in arguments.curves]
    if arguments.unsigned:
        curves = [tuple([abs(value) for value in column] for column in curve) for curve in curves]
    other = read_other(arguments.beside[0]) if arguments.beside else None
    shown = [*curves, other] if other else curves
    (along, along_prefix), (newtons, prefix) = (prefix_of(max(abs(v) for curve in shown for v in curve[axis]))
                                                for axis in (0, 1))
    if other:
        places, values = [u / along for u in other[0]], [f / newtons for f in other[1]]
        axes.plot(places, values, "ks-", lw=1.0, ms=4, label=arguments.beside[1])
    for (displacement, force), label in zip(curves, labels):
        plot(axes, [u / along for u in displacement], [f / newtons for f in force], label)
    save_picture(figure, axes, f"displacement [{along_prefix}m]", f"force [{prefix}N]", arguments.output)


if __name__ == "__main__":
    main()
