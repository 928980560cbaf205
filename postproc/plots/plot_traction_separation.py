#!/usr/bin/env python3
"""Plots the traction-separation law of a bar in tension over a reference law.

The separation is the bar's elongation less that of the sound bar under the same force. Needs the Debian package
python3-matplotlib.
"""

import argparse
import pathlib

from plotting import new_picture, read_columns, save_picture


def interpolate(x, xs, ys):
    for i in range(1, len(xs)):
        if x <= xs[i]:
            return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1])
    return ys[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("curve", type=pathlib.Path, help="force_displacement.csv of a bar along x")
    parser.add_argument("reference", type=pathlib.Path, help="CSV with separation_m and traction_Pa")
    parser.add_argument("--area", type=float, required=True, help="of the bar's section [m^2]")
    parser.add_argument("--length", type=float, required=True, help="of the bar [m]")
    parser.add_argument("--young-modulus", type=float, required=True, help="[Pa]")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("traction_separation.png"))
    arguments = parser.parse_args()

    curve, law = read_columns(arguments.curve), read_columns(arguments.reference)
    traction = [force / arguments.area for force in curve["force_x_N"]]
    compliance = arguments.length / arguments.young_modulus
    separation = [u - t * compliance for u, t in zip(curve["displacement_m"], traction)]
    softening = [(w, t) for w, t in zip(separation, traction) if w > 1e-9]
    strength = max(law["traction_Pa"])
    misfit = max(abs(t - interpolate(w, law["separation_m"], law["traction_Pa"])) for w, t in softening)
    print(f"largest difference {misfit:.4g} Pa, {100 * misfit / strength:.2g} % of the strength")

    figure, axes = new_picture()
    axes.plot([1e3 * w for w in law["separation_m"]], [1e-6 * t for t in law["traction_Pa"]], "k-", lw=1.2,
              label="closed form")
    axes.plot([1e3 * w for w, _ in softening], [1e-6 * t for _, t in softening], "o", ms=4, mfc="none", label="pfdm")
    save_picture(figure, axes, "separation [mm]", "traction [MPa]", arguments.output)


if __name__ == "__main__":
    main()
