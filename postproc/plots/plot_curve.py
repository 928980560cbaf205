#!/usr/bin/env python3
"""Plots force-displacement curves (force_displacement.csv) into one picture.

Needs the Debian package python3-matplotlib.
"""

import argparse
import pathlib

from plotting import new_picture, prefix_of, read_columns, save_picture

DIRECTIONS = "xyz"


def pulled_direction(curve):
    """The direction in which the largest force acts."""
    return max(DIRECTIONS, key=lambda d: max(map(abs, curve[f"force_{d}_N"])))


def read_curve(path, direction):
    """Displacements [m] and forces [N]."""
    curve = read_columns(path)
    return curve["displacement_m"], curve[f"force_{direction or pulled_direction(curve)}_N"]


def plot(axes, displacement, force, label):
    (line,) = axes.plot(displacement, force, lw=1.6, marker="o", ms=2.5, label=label)
    peak = max(range(len(force)), key=lambda i: abs(force[i]))
    axes.plot(displacement[peak], force[peak], "o", ms=7, mfc="none", mec=line.get_color())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("curves", nargs="+", type=pathlib.Path, help="force_displacement.csv files")
    parser.add_argument("--labels", nargs="*", help="one per curve; default: the case's folder")
    parser.add_argument("--direction", choices=DIRECTIONS, help="of the force; default: that of the largest")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("force_displacement.png"))
    arguments = parser.parse_args()
    labels = arguments.labels or [path.absolute().parent.parent.name for path in arguments.curves]
    if len(labels) != len(arguments.curves):
        parser.error(f"{len(labels)} labels for {len(arguments.curves)} curves")

    figure, axes = new_picture()
    curves = [read_curve(path, arguments.direction) for path in arguments.curves]
    (along, along_prefix), (newtons, prefix) = (prefix_of(max(abs(v) for curve in curves for v in curve[axis]))
                                                for axis in (0, 1))
    for (displacement, force), label in zip(curves, labels):
        plot(axes, [u / along for u in displacement], [f / newtons for f in force], label)
    save_picture(figure, axes, f"displacement [{along_prefix}m]", f"force [{prefix}N]", arguments.output)


if __name__ == "__main__":
    main()
