#!/usr/bin/env python3
"""How often the 95 % intervals of a linear fit to the runs of pfdm fit and pfdm sweep hold the truth.

Around the run that is nearest to the data the computed forces are fitted by a linear function of the logarithms of the
values, over all runs within a reach of each value, near ones weighing more; that model gives estimates and intervals,
about which the same is done once more. No run is made: the same ones serve all repetitions of the noise (2 % of the
largest force). Needs the Debian package python3-numpy.

    response_surface_coverage.py RUNS TRUTH/force_displacement.csv "materials.sylgard.young_modulus=75 MPa:0.06" ...

KEY=VALUE:REACH, values in the case's units, the reach of their logarithms. `--differences H`: derivatives by
differences of one value at a time, over H of its logarithm, instead.
"""

import argparse
import csv
import json
import math
import pathlib
import tomllib

import numpy as np

T_95 = 1.96


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=pathlib.Path, help="folder of runs, as results/runs")
    parser.add_argument("truth", type=pathlib.Path, help="force_displacement.csv")
    parser.add_argument("parameters", nargs="+", help="KEY=VALUE:REACH")
    parser.add_argument("--component", default="z", help="of the force")
    parser.add_argument("--spacing", type=float, default=1.5, help="of the measured points [um]")
    parser.add_argument("--repetitions", type=int, default=1000)
    parser.add_argument("--differences", type=float, help="step")
    return parser.parse_args()


def number(quantity):
    return float(str(quantity).split()[0])


def curve_at(file, component, points):
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return np.interp(points, [float(row["displacement_m"]) for row in rows],
                     [float(row[f"force_{component}_N"]) for row in rows])


def value_in(case, key):
    for name in key.split("."):
        case = case[name]
    return number(case)


def read_runs(options, keys, points):
    """Logarithms of the values, forces: a row for each complete run."""
    values, forces = [], []
    for summary in sorted(options.runs.glob("*/summary.json")):
        folder = summary.parent
        if json.loads(summary.read_text(encoding="utf-8"))["status"] != "complete":
            continue
        if (folder / "force_displacement.csv").resolve() == options.truth.resolve():
            continue
        case = tomllib.loads((folder / "case.toml").read_text(encoding="utf-8"))
        values.append([math.log(value_in(case, key)) for key in keys])
        forces.append(curve_at(folder / "force_displacement.csv", options.component, points))
    return np.array(values), np.array(forces)


def by_regression(values, residuals, centre, reach):
    """Residuals at the centre and their derivatives, over the runs within reach; nothing if there are too few."""
    distance = np.sum(((values - centre) / reach) ** 2, axis=1)
    near = distance < 1.0
    if near.sum() < 2 * (len(reach) + 1):
        return None
    weight = np.sqrt(1.0 - distance[near])[:, None]
    design = np.column_stack([np.ones(near.sum()), values[near] - centre])
    solution = np.linalg.lstsq(design * weight, residuals[near] * weight, rcond=None)[0]
    return solution[0], solution[1:].T


def difference_nodes(values, forces, step):
    """Runs with neighbours to both sides in each value -> derivatives of the forces."""
    number_of = {tuple(np.round(v, 4)): i for i, v in enumerate(values)}
    nodes = []
    for v in values:
        sides = [[number_of.get(tuple(np.round(v + sign * step * axis, 4))) for sign in (1, -1)]
                 for axis in np.eye(len(v))]
        if all(side is not None for pair in sides for side in pair):
            nodes.append((v, np.array([(forces[a] - forces[b]) / (2.0 * step) for a, b in sides]).T))
    return nodes


def estimate(options, values, forces, nodes, data, deviation, reach):
    """Logarithms and their standard errors."""
    residuals = (forces - data) / deviation
    best = int(np.argmin(np.sum(residuals**2, axis=1)))
    centre = values[best]
    for _ in range(1 if options.differences else 2):
        if options.differences:
            model = residuals[best], min(nodes, key=lambda node: np.abs(node[0] - centre).max())[1] / deviation
        else:
            model = by_regression(values, residuals, centre, reach)
        if model is None:
            return None
        here, slope = model
        covariance = np.linalg.pinv(slope.T @ slope)
        centre = centre + np.clip(-covariance @ slope.T @ here, -reach, reach)
    return centre, np.sqrt(np.diag(covariance))


def main():
    options = arguments()
    keys = [entry.split("=")[0] for entry in options.parameters]
    true = np.array([math.log(number(entry.split("=")[1].split(":")[0])) for entry in options.parameters])
    reach = np.array([float(entry.split(":")[1]) for entry in options.parameters])
    with open(options.truth, newline="", encoding="utf-8") as file:
        end = float(list(csv.DictReader(file))[-1]["displacement_m"])
    points = np.arange(0.0, end * (1.0 - 1e-9), 1e-6 * options.spacing)
    truth = curve_at(options.truth, options.component, points)
    deviation = 0.02 * truth.max()
    values, forces = read_runs(options, keys, points)
    nodes = difference_nodes(values, forces, options.differences) if options.differences else []
    noise = np.random.default_rng(1)
    found = []
    for _ in range(options.repetitions):
        data = truth + noise.normal(0.0, deviation, len(points))
        entry = estimate(options, values, forces, nodes, data, deviation, reach)
        if entry is not None:
            found.append(entry)
    errors = np.array([centre - true for centre, _ in found])
    stated = np.array([error for _, error in found])
    print(f"{len(values)} runs, {len(points)} points, {len(found)} of {options.repetitions} repetitions")
    for j, key in enumerate(keys):
        e = errors[:, j]
        held = np.mean(np.abs(e) < T_95 * stated[:, j])
        print(f"{key}: held {100 * held:.1f} %; error mean {100 * e.mean():+.2f} %, "
              f"standard deviation {100 * e.std():.2f} %, stated {100 * np.median(stated[:, j]):.2f} %; "
              f"95 % of errors below {100 * np.quantile(np.abs(e), 0.95):.1f} %")


if __name__ == "__main__":
    main()
