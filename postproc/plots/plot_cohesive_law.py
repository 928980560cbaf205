#!/usr/bin/env python3
"""Plots the averaged traction-separation laws of cohesive_law.csv: normal traction over normal separation.

One line for each polar angle (a plane has one); a reference law, such as data/produced_law.csv of a bar, in black. Jumps,
across which a law is not known, are dotted. Needs the Debian package python3-matplotlib.
"""

import argparse
import pathlib

from plotting import new_picture, read_columns, save_picture


def laws_of(table, surface):
    """(from, to) in degrees -> lists of separation and traction, in the order of the steps."""
    laws = {}
    for i, number in enumerate(table["surface"]):
        if number != surface:
            continue
        angles = tuple(round(table[f"polar_angle_{end}_deg"][i]) for end in ("from", "to"))
        separation, traction = laws.setdefault(angles, ([], []))
        separation.append(table["separation_m"][i])
        traction.append(table["traction_Pa"][i])
    return laws


def is_jump(before, after, strength):
    """Whether a step falls by more than half of the strength, or from a fifth of it or more to nearly nothing."""
    fall = before - after
    return fall > 0.5 * strength or (fall > 0.2 * strength and after < 0.1 * before)


def plot_law(axes, separation, traction, label, factor):
    u, t = [factor * s for s in separation], [1e-6 * v for v in traction]
    jumps = [i for i in range(1, len(t)) if is_jump(t[i - 1], t[i], max(t))]
    colour = None
    for start, end in zip([0, *jumps], [*jumps, len(t)]):
        if start > 0:
            axes.plot(u[start - 1 : start + 1], t[start - 1 : start + 1], ":", lw=0.8, color=colour)
        (line,) = axes.plot(u[start:end], t[start:end], "o-", ms=3, lw=1.2, color=colour, label=label)
        colour, label = line.get_color(), None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("law", type=pathlib.Path, help="cohesive_law.csv")
    parser.add_argument("--surface", type=int, default=0, help="number of the surface, as in the file's first lines")
    parser.add_argument("--reference", type=pathlib.Path, help="CSV with separation_m and traction_Pa")
    parser.add_argument("--least-traction", type=float, default=0.1, help="of the largest law's strength, to be shown")
    parser.add_argument("--log", action="store_true", help="logarithmic separations")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("cohesive_law.png"))
    arguments = parser.parse_args()

    laws = laws_of(read_columns(arguments.law), arguments.surface)
    if not laws:
        parser.error(f"{arguments.law} has no surface {arguments.surface}")
    strongest = max(max(traction) for _, traction in laws.values())
    widest = max(max(separation) for separation, _ in laws.values())
    factor, unit = (1e3, "mm") if widest > 5e-4 else (1e6, "µm")

    figure, axes = new_picture()
    if arguments.reference:
        reference = read_columns(arguments.reference)
        axes.plot([factor * w for w in reference["separation_m"]], [1e-6 * t for t in reference["traction_Pa"]], "k-",
                  lw=1.2, label="closed form")
    for (start, end), (separation, traction) in laws.items():
        if max(traction) < arguments.least_traction * strongest:
            continue
        label = "pfdm" if len(laws) == 1 else f"{start}° to {end}°"
        plot_law(axes, separation, traction, label, factor)
        print(f"{label}: strength {max(traction):.4g} Pa")
    if arguments.log:
        axes.set_xscale("log")
        axes.set_xlim(left=factor * 1e-4 * widest)
    save_picture(figure, axes, f"separation [{unit}]", "normal traction [MPa]", arguments.output)


if __name__ == "__main__":
    main()
