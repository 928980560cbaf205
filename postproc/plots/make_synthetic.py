#!/usr/bin/env python3
"""Writes a synthetic measurement: a column of a run's results over its displacement, with noise, labelled as synthetic.

    make_synthetic.py RESULTS/force_displacement.csv force_z_N force_N "E = 75 MPa ..." --output data/synthetic.csv
    make_synthetic.py RESULTS/debonding.csv debonding_angle_minus_rad angle_deg "..." --scale 57.29578 --deviation 2
"""

import argparse
import csv
import pathlib
import random


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=pathlib.Path, help="CSV of a run, with the column displacement_m")
    parser.add_argument("column", help="of the run")
    parser.add_argument("name", help="of the column that is written, with its unit: force_N")
    parser.add_argument("values", help="what it was run with, for the comment")
    parser.add_argument("--scale", type=float, default=1.0, help="unit of the run's column in the written one's")
    parser.add_argument("--deviation", type=float,
                        help="standard deviation of the noise where the column is not zero; default: 2 %% of the "
                             "largest value, everywhere")
    parser.add_argument("--spacing", type=float, default=1.5, help="of the points [um]")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("synthetic.csv"))
    return parser.parse_args()


def interpolated(curve, x):
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if x0 <= x <= x1:
            return y0 + (x - x0) / (x1 - x0) * (y1 - y0)
    return curve[-1][1]  # the last displacement, but for rounding


def read_curve(options):
    with open(options.run, newline="", encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [(1e6 * float(row["displacement_m"]), options.scale * float(row[options.column])) for row in rows]


def main():
    options = arguments()
    curve = read_curve(options)
    noise = random.Random(options.seed)
    deviation = options.deviation or 0.02 * max(value for _, value in curve)
    quantity, unit = options.name.rsplit("_", 1)
    told = f"{deviation:g} {unit} where the value is not zero" if options.deviation else "2 % of the largest value"
    with open(options.output, "w", encoding="utf-8") as file:
        print(f"# SYNTHETIC, not measured: computed by pfdm run with {options.values}", file=file)
        print(f"# noise: normal, independent, standard deviation {told}", file=file)
        print(f"displacement_um,{options.name},{quantity}_deviation_{unit}", file=file)
        for i in range(int(curve[-1][0] / options.spacing + 1e-9) + 1):
            x = i * options.spacing
            value = interpolated(curve, x)
            if value != 0.0 or not options.deviation:
                value += noise.gauss(0.0, deviation)
            print(f"{x:.6g},{value:.4f},{deviation:.4f}", file=file)


if __name__ == "__main__":
    main()
