#!/usr/bin/env python3
"""Writes synthetic_force_displacement.csv from the force_displacement.csv of a run with known values: adds noise."""

import argparse
import csv
import pathlib
import random

STEP = 1.5  # um


def interpolated(curve, x):
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if x0 <= x <= x1:
            return y0 + (x - x0) / (x1 - x0) * (y1 - y0)
    return curve[-1][1]  # the last displacement, but for rounding


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=pathlib.Path, help="force_displacement.csv")
    parser.add_argument("values", help="the values that it was run with, for the comment")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("synthetic_force_displacement.csv"))
    arguments = parser.parse_args()
    with open(arguments.run, newline="", encoding="utf-8") as file:
        curve = [(1e6 * float(row["displacement_m"]), float(row["force_z_N"])) for row in csv.DictReader(file)]
    noise = random.Random(arguments.seed)
    deviation = 0.02 * max(force for _, force in curve)
    with open(arguments.output, "w", encoding="utf-8") as file:
        print(f"# SYNTHETIC, not measured: computed by pfdm run with {arguments.values}", file=file)
        print("# noise: normal, independent, standard deviation 2 % of the largest force", file=file)
        print("displacement_um,force_N,force_deviation_N", file=file)
        for i in range(int(curve[-1][0] / STEP + 1e-9) + 1):
            force = interpolated(curve, i * STEP) + noise.gauss(0.0, deviation)
            print(f"{i * STEP:g},{force:.4f},{deviation:.4f}", file=file)


if __name__ == "__main__":
    main()
