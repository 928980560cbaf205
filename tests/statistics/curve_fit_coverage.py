#!/usr/bin/env python3
"""How often the 95 % intervals of pfdm fit hold the truth.

A case is run with known values of its [[fit.parameters]], its curve gets noise of 2 % of the largest force, and the case is
fitted to it from its own values; again and again with other noise. All fits share their runs' cache.

    curve_fit_coverage.py build/release/cases/program/pfdm cases/bar_fit 20 \
        "materials.concrete.young_modulus=32 GPa" "materials.concrete.strength,regions.weak.strength=2.8 MPa" ...
"""

import argparse
import csv
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import tempfile


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pfdm")
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("repetitions", type=int)
    parser.add_argument("truth", nargs="+", help="KEY=VALUE, or KEY,KEY=VALUE")
    parser.add_argument("--component", default="x", help="of the force")
    parser.add_argument("--spacing", type=float, default=1e-6, help="of the measured points [m]")
    return parser.parse_args()


def sweep_of(truth):
    text = '\n[sweep]\nmethod = "list"\n'
    for entry in truth:
        keys, value = entry.split("=")
        quoted = ", ".join(f'"{key}"' for key in keys.split(","))
        text += f'[[sweep.parameters]]\nkey = [{quoted}]\nvalues = ["{value}"]\n'
    return text


def interpolated(curve, x):
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if x0 <= x <= x1:
            return y0 + (x - x0) / (x1 - x0) * (y1 - y0)
    return curve[-1][1]


def true_curve(options, folder):
    text = (options.case / "case.toml").read_text(encoding="utf-8")
    (folder / "case.toml").write_text(text + sweep_of(options.truth), encoding="utf-8")
    subprocess.run([options.pfdm, "sweep", str(folder), "--quiet"], check=True)
    (folder / "case.toml").write_text(text, encoding="utf-8")
    table = (folder / "results/sweep.csv").read_text(encoding="utf-8")
    run = folder / "results" / re.search(r"# run 1: (\S+)", table).group(1)
    rows = [line for line in table.splitlines() if not line.startswith("#")]
    values = dict(zip(rows[0].split(","), map(float, rows[1].split(","))))
    with open(run / "force_displacement.csv", newline="", encoding="utf-8") as file:
        curve = [(float(row["displacement_m"]), float(row[f"force_{options.component}_N"]))
                 for row in csv.DictReader(file)]
    return values, curve


def write_data(options, folder, curve, seed):
    noise = random.Random(seed)
    deviation = 0.02 * max(force for _, force in curve)
    with open(folder / "data/synthetic_force_displacement.csv", "w", encoding="utf-8") as file:
        print("# SYNTHETIC\ndisplacement_um,force_N,force_deviation_N", file=file)
        for i in range(int(curve[-1][0] / options.spacing * (1.0 + 1e-12)) + 1):
            x = i * options.spacing
            print(f"{1e6 * x:.6g},{interpolated(curve, x) + noise.gauss(0.0, deviation):.6g},{deviation:.6g}", file=file)


def main():
    options = arguments()
    folder = pathlib.Path(tempfile.mkdtemp()) / "case"
    shutil.copytree(options.case, folder, ignore=shutil.ignore_patterns("results"))
    truth, curve = true_curve(options, folder)
    held, errors, runs = {}, {}, []
    for seed in range(1, options.repetitions + 1):
        write_data(options, folder, curve, seed)
        subprocess.run([options.pfdm, "fit", str(folder), "--quiet"], check=True)
        fit = json.loads((folder / "results/fit.json").read_text(encoding="utf-8"))
        runs.append(fit["runs"]["made"] + fit["runs"]["reused"])
        for p in fit["parameters"]:
            true = next(value for name, value in truth.items() if name.startswith(p["name"]))
            held.setdefault(p["name"], []).append(p["lower_95"] <= true <= p["upper_95"])
            errors.setdefault(p["name"], []).append(p["estimate"] / true - 1.0)
        for name, inside in held.items():
            e = errors[name]
            print(f"{seed:3} {name}: held {sum(inside)} of {len(inside)}, mean error {100 * sum(e) / len(e):+.2f} %, "
                  f"rms {100 * math.sqrt(sum(x * x for x in e) / len(e)):.2f} %, largest "
                  f"{100 * max(map(abs, e)):.2f} %; {sum(runs) / len(runs):.0f} runs", flush=True)
    shutil.rmtree(folder.parent)


if __name__ == "__main__":
    main()
