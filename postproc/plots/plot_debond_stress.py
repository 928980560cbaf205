#!/usr/bin/env python3
"""Debond stress of a bead against its radius, from the results of a sweep: a table (debond_stress.csv) and a picture.

cap:    sweep over the radius from a cap that is debonded already. Growth: the first step after which the crack has
        grown by ell, by its fracture energy. Jump: the first in which the fracture energy grows by a tenth.
whole:  sweep over the toughness at one radius, for R/l_ch. The load is that of the first step after which some place
        has d > 0.95.
The debond stress lies between the remote stress of that step and of the one before; the table has the middle.
Needs the Debian packages python3-matplotlib and python3-numpy.
"""

import argparse
import csv
import math
import pathlib
import re

import numpy

from plotting import new_picture, read_columns, save_picture

STRESS = "boundary[0].displacement.stress_Pa"
RADIUS = "boundary[0].displacement.radius_m"
TOUGHNESS = "regions.interface.toughness_J_per_m2"


def run_folders(sweep):
    text = sweep.read_text(encoding="utf-8")
    return [sweep.parent / folder for folder in re.findall(r"^#\s*run \d+: (runs/[^\s,]+)", text, re.MULTILINE)]


def has_jumped(curve, i):
    energy = curve["fracture_energy_J"]
    return i > 1 and energy[i] - energy[i - 1] > 0.1 * energy[1]


def has_grown(ring):
    """By a ring of that fracture energy [J]."""
    return lambda curve, i: i > 1 and curve["fracture_energy_J"][i] - curve["fracture_energy_J"][1] > ring


def is_broken(curve, i):
    return curve["max_damage"][i] > 0.95


def debond_load(holds, folder):
    """Load parameter: the middle of the first step after which that holds, and half its width."""
    curve = read_columns(folder / "force_displacement.csv")
    for i in range(1, len(curve["load"])):
        if holds(curve, i):
            before, now = curve["load"][i - 1], curve["load"][i]
            return 0.5 * (before + now), 0.5 * (now - before)
    raise SystemExit(f"{folder}: it does not debond; pull further")


def exponent(x, y):
    """Of the power law through the points, and its standard error."""
    (slope, _), covariance = numpy.polyfit(numpy.log(x), numpy.log(y), 1, cov="unscaled")
    fit = numpy.polyval(numpy.polyfit(numpy.log(x), numpy.log(y), 1), numpy.log(x))
    scatter = math.sqrt(sum((numpy.log(y) - fit) ** 2) / max(1, len(x) - 2))
    return slope, scatter * math.sqrt(covariance[0, 0])


def local_exponents(x, y):
    middle = numpy.sqrt(x[1:] * x[:-1])
    return middle, numpy.diff(numpy.log(y)) / numpy.diff(numpy.log(x))


def predicted(radius, a):
    """Penny-shaped crack on a bead: (1/k_p) sqrt(pi E G / (2 (1 - nu^2) R sin(theta)))."""
    return numpy.sqrt(
        math.pi * a.modulus * a.toughness / (2 * (1 - a.poisson**2) * radius * math.sin(math.radians(a.angle)))
    ) / a.concentration


def write_table(path, columns):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows([f"{value:.6g}" for value in row] for row in zip(*columns.values()))
    print(path)


def stresses(sweep, loads):
    """Middle and half the width of each step [Pa]."""
    return (numpy.array([s * value for s, value in zip(sweep[STRESS], column)]) for column in zip(*loads))


def plot_cap(axes, sweep, folders, arguments):
    radius = numpy.array(sweep[RADIUS])
    theory = predicted(radius, arguments)
    ring = arguments.toughness * math.sin(math.radians(arguments.angle)) * math.radians(arguments.azimuth) * arguments.ell
    table = {"radius_m": radius}
    grown = [debond_load(has_grown(ring * r), folder) for r, folder in zip(radius, folders)]
    jumped = [debond_load(has_jumped, folder) for folder in folders]
    for name, loads, mark in (("growth", grown, "o"), ("jump", jumped, "^")):
        stress, error = stresses(sweep, loads)
        slope, scatter = exponent(radius, stress)
        print(f"{name}: exponent {slope:.3f} +- {scatter:.3f}; local",
              *(f"{s:.3f}" for s in local_exponents(radius, stress)[1]))
        axes.errorbar(1e6 * radius, 1e-6 * stress, 1e-6 * error, fmt=mark, label=f"{name}, exponent {slope:.3f}")
        table |= {f"{name}_Pa": stress, f"{name}_half_width_Pa": error, f"{name}_over_predicted": stress / theory}
    axes.plot(1e6 * radius, 1e-6 * theory, "k--", lw=1, label="penny-shaped crack, exponent -1/2")
    axes.set_xscale("log"), axes.set_yscale("log")
    for axis, ticks in ((axes.xaxis, 1e6 * radius), (axes.yaxis, 1e-6 * theory)):
        axis.set_ticks(ticks, [f"{tick:.3g}" for tick in ticks])
        axis.set_ticks([], minor=True)
    return table, "radius [µm]", "remote stress at debonding [MPa]"


def plot_whole(axes, sweep, folders, arguments):
    stress, error = stresses(sweep, [debond_load(is_broken, folder) for folder in folders])
    ratio = arguments.radius * arguments.strength**2 / (arguments.modulus * numpy.array(sweep[TOUGHNESS]))
    order = numpy.argsort(ratio)
    ratio, stress, error = ratio[order], stress[order], error[order]
    middle, slope = local_exponents(ratio, stress)
    axes.errorbar(ratio, stress / arguments.strength, error / arguments.strength, fmt="o-", label="debond stress / ft")
    axes.plot(middle, slope, "s--", label="local exponent")
    axes.axhline(-0.5, color="k", lw=0.8, ls=":")
    axes.axhline(1 / arguments.concentration, color="k", lw=0.8, ls="--", label="1/k_p")
    axes.set_xscale("log")
    axes.xaxis.set_ticks(ratio, [f"{x:.2g}" for x in ratio])
    axes.xaxis.set_ticks([], minor=True)
    table = {"radius_over_l_ch": ratio, "debond_stress_over_strength": stress / arguments.strength,
             "half_width_over_strength": error / arguments.strength,
             "local_exponent_beyond": numpy.append(slope, math.nan)}
    return table, "R / l_ch", "debond stress / ft, local exponent"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=["cap", "whole"])
    parser.add_argument("sweep", type=pathlib.Path, help="sweep.csv")
    parser.add_argument("--modulus", type=float, default=75e6, help="of the matrix [Pa]")
    parser.add_argument("--poisson", type=float, default=0.44, help="of the matrix")
    parser.add_argument("--toughness", type=float, default=10.0, help="of the interface, for cap [J/m^2]")
    parser.add_argument("--angle", type=float, default=30.0, help="of the cap [degree]")
    parser.add_argument("--azimuth", type=float, default=5.0, help="of the sector [degree]")
    parser.add_argument("--ell", type=float, default=0.5e-6, help="for cap [m]")
    parser.add_argument("--strength", type=float, default=2e6, help="of the interface, for whole [Pa]")
    parser.add_argument("--radius", type=float, default=200e-6, help="of the bead, for whole [m]")
    parser.add_argument("--concentration", type=float, default=1.94221, help="k_p: stress at the pole over the remote")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("debond_stress.png"))
    arguments = parser.parse_args()

    sweep = read_columns(arguments.sweep)
    folders = run_folders(arguments.sweep)
    figure, axes = new_picture()
    plot = plot_cap if arguments.kind == "cap" else plot_whole
    table, x_label, y_label = plot(axes, sweep, folders, arguments)
    write_table(arguments.output.with_suffix(".csv"), table)
    save_picture(figure, axes, x_label, y_label, arguments.output)


if __name__ == "__main__":
    main()
