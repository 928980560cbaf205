#!/usr/bin/env python3
"""Plots columns of any CSV file of results over another one, with units by the ends of their names.

    postproc/plots/plot_table.py RESULTS/response.csv --x frequency_Hz --y amplitude

A column may be "|name|", its magnitude. Needs the Debian package python3-matplotlib.
"""

import argparse
import math
import pathlib
import re

from plotting import new_picture, prefix_of, read_columns, save_picture

UNITS = {"m": "m", "N": "N", "Pa": "Pa", "s": "s", "Hz": "Hz", "K": "K", "J": "J", "W": "W", "deg": "°", "C": "°C",
         "N_per_m": "N/m", "J_per_m2": "J/m²", "m_per_s2": "m/s²", "per_s": "1/s"}
WITH_PREFIX = {"m", "N", "Pa", "J", "W", "N/m"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", nargs="+", type=pathlib.Path)
    parser.add_argument("--x", required=True, help="a column")
    parser.add_argument("--y", required=True, nargs="+", help="columns; each is drawn from all tables that have it")
    parser.add_argument("--labels", nargs="*", help="one for each curve; default: names of columns or tables")
    parser.add_argument("--x-label", help="in words, without a unit; default: the column's name")
    parser.add_argument("--y-label")
    parser.add_argument("--points", nargs="*", type=int, default=[], help="numbers of the curves drawn as points, from 0")
    parser.add_argument("--x-range", nargs=2, type=float, metavar=("FROM", "TO"), help="in the table's unit")
    parser.add_argument("--log", choices=("x", "y", "xy"), default="", help="logarithmic axes")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("table.png"))
    return parser.parse_args()


def words_and_unit(column):
    """The name without its unit, in words, and the unit: "force_x_N" is "force x" in N."""
    name = column.strip("|")
    end = max((end for end in UNITS if name.endswith("_" + end)), key=len, default=None)
    return re.sub("_", " ", name[: -len(end) - 1] if end else name), UNITS[end] if end else ""


def values_of(table, column):
    values = table[column.strip("|")]
    return [abs(v) for v in values] if column.startswith("|") else values


def axis_of(columns, all_values, words):
    """The factor of an axis and its label."""
    name, unit = words_and_unit(columns[0])
    factor, prefix = prefix_of(max(map(abs, all_values), default=1.0)) if unit in WITH_PREFIX else (1.0, "")
    return 1.0 / factor, (words or name) + (f" [{prefix}{unit}]" if unit else "")


def main():
    options = parse_arguments()
    curves = []
    for path in options.tables:
        table = read_columns(path)
        for column in options.y:
            if column.strip("|") in table:
                label = words_and_unit(column)[0] if len(options.y) > 1 else path.stem
                low, high = options.x_range or (-math.inf, math.inf)
                seen = [(x, y) for x, y in zip(values_of(table, options.x), values_of(table, column)) if low <= x <= high]
                curves.append((label, [x for x, _ in seen], [y for _, y in seen]))
    if not curves:
        raise SystemExit(f"none of the tables has a column {' or '.join(options.y)}")
    x_factor, x_label = axis_of([options.x], [x for _, xs, _ in curves for x in xs], options.x_label)
    y_factor, y_label = axis_of(options.y, [y for _, _, ys in curves for y in ys if y == y], options.y_label)
    figure, axes = new_picture()
    for number, (label, xs, ys) in enumerate(curves):
        label = options.labels[number] if options.labels else label
        style = {"ls": "none", "marker": "o", "ms": 3} if number in options.points else {"lw": 1.6}
        axes.plot([x_factor * x for x in xs], [y_factor * y for y in ys], label=label, **style)
    for axis in options.log:
        getattr(axes, f"set_{axis}scale")("log")
    save_picture(figure, axes, x_label, y_label, options.output)


if __name__ == "__main__":
    main()
