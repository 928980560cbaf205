#!/usr/bin/env python3
"""Writes synthetic_force_displacement.csv: closed form of a bar with a cohesive crack, with noise."""

import random

LENGTH, AREA = 0.2, 8e-6  # m, m^2
E, FT, GC = 32e9, 2.8e6, 110.0  # Pa, Pa, J/m^2
DEVIATION = 0.02 * AREA * FT  # N


def force(elongation):
    """Linear until the strength, then linear softening over the separation 2 GC/FT, the bar unloading elastically."""
    critical = 2.0 * GC / FT
    if elongation <= FT * LENGTH / E:
        return AREA * E * elongation / LENGTH
    return AREA * max(0.0, (critical - elongation) / (critical / FT - LENGTH / E))


def main():
    noise = random.Random(1)
    with open("synthetic_force_displacement.csv", "w", encoding="utf-8") as file:
        print("# SYNTHETIC, not measured: closed form of a bar of 200 mm with a cohesive crack, linear softening;", file=file)
        print(f"# E = {E / 1e9:g} GPa, ft = {FT / 1e6:g} MPa, Gc = {GC:g} J/m^2 (make_synthetic.py)", file=file)
        print("# noise: normal, independent, standard deviation 2 % of the largest force", file=file)
        print("displacement_um,force_N,force_deviation_N", file=file)
        for i in range(111):
            print(f"{i},{force(1e-6 * i) + noise.gauss(0.0, DEVIATION):.4f},{DEVIATION:.4f}", file=file)


if __name__ == "__main__":
    main()
