#!/usr/bin/env python3
"""Plots a computed curve over the measured one: comparison.csv, comparison_debonding.csv or fit_curve.csv.

The specimens' names are those of the .json file beside it. The band is two standard deviations to either side, where they are known. Needs the Debian package python3-matplotlib.
"""

import argparse
import json
import math
import pathlib

from plotting import new_picture, read_columns, save_picture

QUANTITIES = {"force_N": ("force [N]", 1.0), "angle_rad": ("debonding angle [degrees]", math.degrees(1.0))}
PARTS = {"force_N": "force_displacement", "angle_rad": "debonding_angle"}


def name_of_measured(comparison, quantity):
    """The specimen's name as the case gives it, or that it is a mean of several."""
    if comparison.name == "fit_curve.csv":
        specimens = json.loads((comparison.parent / "fit.json").read_text(encoding="utf-8"))["experiments"]
        return specimens[0]["name"] if len(specimens) == 1 else f"mean of {len(specimens)} specimens"
    whole = json.loads((comparison.parent / "comparison.json").read_text(encoding="utf-8"))
    specimens = whole[PARTS[quantity]]["specimens"]
    if len(specimens) > 1:
        return f"mean of {len(specimens)} specimens"
    return specimens[0] if isinstance(specimens[0], str) else specimens[0]["name"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("comparison", type=pathlib.Path, help="one of these files")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("comparison.png"))
    arguments = parser.parse_args()

    table = read_columns(arguments.comparison)
    quantity = next(q for q in QUANTITIES if f"model_{q}" in table)
    label, factor = QUANTITIES[quantity]
    displacement = [1e6 * u for u in table["displacement_m"]]
    measured = [factor * y for y in table[f"measured_{quantity}"]]
    figure, axes = new_picture()
    if f"measured_deviation_{quantity}" in table:
        deviation = [2.0 * factor * s for s in table[f"measured_deviation_{quantity}"]]
        axes.fill_between(displacement, [y - s for y, s in zip(measured, deviation)],
                          [y + s for y, s in zip(measured, deviation)], color="0.85", label="two standard deviations")
    axes.plot(displacement, measured, "k-", lw=1.0, label=name_of_measured(arguments.comparison, quantity))
    if f"first_{quantity}" in table:
        axes.plot(displacement, [factor * y for y in table[f"first_{quantity}"]], "--", lw=1.0, label="first guess")
    label_of_model = "estimates" if f"first_{quantity}" in table else "pfdm"
    axes.plot(displacement, [factor * y for y in table[f"model_{quantity}"]], "-", lw=1.6, label=label_of_model)
    save_picture(figure, axes, "displacement [µm]", label, arguments.output)


if __name__ == "__main__":
    main()
