#!/usr/bin/env python3
"""Plots hysteresis loops: stress over strain from history.csv, or measured and fitted curves from fit_*.csv.

Needs the Debian package python3-matplotlib.

    plot_history.py RESULTS/history.csv --component xx --output loops.png
    plot_history.py RESULTS/fit_tension.csv
"""

import argparse
import pathlib

from plotting import new_picture, read_columns, save_picture


def most_strained(table):
    """The component with the largest strain of those that have a stress."""
    components = [n.split("_")[-1] for n in table if n.startswith("strain_")]
    with_stress = [c for c in components if any(n.endswith(f"stress_{c}_Pa") for n in table)]
    return max(with_stress, key=lambda c: max(map(abs, table[f"strain_{c}"])))


def plot(axes, path, component):
    table = read_columns(path)
    component = component or most_strained(table)
    shear = component[0] != component[1]
    strain = [(200.0 if shear else 100.0) * e for e in table[f"strain_{component}"]]
    for prefix, style in (("", "-"), ("measured_", "."), ("fitted_", "-")):
        name = f"{prefix}stress_{component}_Pa"
        if name not in table:
            continue
        stress = [1e-6 * s for s in table[name]]
        label = f"{path.stem} {prefix.rstrip('_')}".strip()
        axes.plot(strain, stress, style, lw=1.0, ms=2.5, label=label)
        print(f"{label}: {component} from {min(stress):.6g} to {max(stress):.6g} MPa")
    return component, shear


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("histories", nargs="+", type=pathlib.Path, help="history.csv or fit_*.csv files")
    parser.add_argument("--component", choices=["xx", "yy", "zz", "yz", "xz", "xy"], help="default: the most strained")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("hysteresis.png"))
    arguments = parser.parse_args()

    figure, axes = new_picture(height=4.5)
    for path in arguments.histories:
        component, shear = plot(axes, path, arguments.component)
    save_picture(figure, axes, f"{'engineering shear' if shear else 'strain'} {component} [%]", f"stress {component} [MPa]", arguments.output)


if __name__ == "__main__":
    main()
