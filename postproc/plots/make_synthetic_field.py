#!/usr/bin/env python3
"""Writes synthetic displacement fields as DIC would measure them: of the frames of a run, at the points of a grid in the plane
x, y, with noise, labelled as synthetic. A point's displacement is a quadratic by least squares through the cells around it;
with --split none of the cells on the other side of a crack along x counts.

    make_synthetic_field.py RESULTS "E = 3.2 GPa ..." --x 22 78 29 --y 0.6 19.4 16 --deviation 10 --output data/fields.csv
"""

import argparse
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "cases/python"))
from frames import frames_of  # noqa: E402
from pfdm.vtu import read_vtu  # noqa: E402
from plotting import read_columns  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, help="of a run with frames")
    parser.add_argument("values", help="what it was run with, for the comment")
    parser.add_argument("--x", type=float, nargs=3, required=True, help="first, last [mm] and number of the points along x")
    parser.add_argument("--y", type=float, nargs=3, required=True, help="the same along y")
    parser.add_argument("--split", type=float, help="y of a crack [mm]")
    parser.add_argument("--deviation", type=float, required=True, help="standard deviation of the noise [um]")
    parser.add_argument("--subset", type=int, default=1,
                        help="the noise is a mean over so many points each way, as of subsets that overlap; its deviation is as said")
    parser.add_argument("--rigid", type=float, default=0.0, help="standard deviation of a shift of each frame [um]; of "
                                                                  "its rotation as much over 100 mm")
    parser.add_argument("--outliers", type=float, default=0.0, help="share of points whose noise is 100 times as large")
    parser.add_argument("--scale", type=float, default=1.0, help="of the displacements, as of a wrong calibration")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("synthetic_displacements.csv"))
    return parser.parse_args()


def operator(centres, points, split):
    """Weights of the cells' displacements at each point, rows of a matrix."""
    weights = numpy.zeros((len(points), len(centres)))
    for i, p in enumerate(points):
        d = centres[:, :2] - p
        far = numpy.hypot(*d.T)
        if split is not None:
            far = numpy.where((centres[:, 1] > split) == (p[1] > split), far, numpy.inf)
        near = numpy.argsort(far, kind="stable")[:16]
        x, y = (d[near] / far[near[-1]]).T
        basis = numpy.stack([numpy.ones_like(x), x, y, x * x, x * y, y * y], axis=1)
        weights[i, near] = numpy.linalg.pinv(basis)[0]
    return weights


def noise_of(random, shape, options):
    """(nx, ny, 2)"""
    n = options.subset
    white = random.normal(0.0, 1.0, (shape[0] + n - 1, shape[1] + n - 1, 2))
    mean = sum(white[i:i + shape[0], j:j + shape[1]] for i in range(n) for j in range(n)) / n
    return options.deviation * mean


def main():
    options = arguments()
    random = numpy.random.default_rng(options.seed)
    nx, ny = int(options.x[2]), int(options.y[2])
    x, y = numpy.meshgrid(numpy.linspace(*options.x[:2], nx), numpy.linspace(*options.y[:2], ny), indexing="ij")
    points = 1e-3 * numpy.stack([x.ravel(), y.ravel()], axis=1)
    curve = read_columns(options.results / "force_displacement.csv")
    weights = None
    with open(options.output, "w", encoding="utf-8") as file:
        print(f"# SYNTHETIC, not measured: computed by pfdm run with {options.values}", file=file)
        print(f"# noise: normal, standard deviation {options.deviation:g} um of each component, "
              + ("independent" if options.subset == 1 else f"means over {options.subset} points each way"), file=file)
        print("frame,curve_um,x_mm,y_mm,u_um,v_um", file=file)
        for number, (_, path, step) in enumerate(frames_of(options.results)):
            at = dict(zip(curve["step"], curve["displacement_m"]))[step]
            if at == 0.0:
                continue
            grid = read_vtu(path)
            if weights is None:
                weights = operator(grid.cell_centres, points, None if options.split is None else 1e-3 * options.split)
            u = 1e6 * options.scale * (weights @ grid.cell_data["displacement"][:, :2])
            u += noise_of(random, x.shape, options).reshape(-1, 2)
            shift, turn = random.normal(0.0, 1.0, 2) * options.rigid, random.normal() * options.rigid / 100.0
            u += shift + turn * numpy.stack([-y.ravel(), x.ravel()], axis=1)
            wild = random.random(len(u)) < options.outliers
            u[wild] += 100.0 * options.deviation * random.normal(0.0, 1.0, (wild.sum(), 2))
            for (px, py), (ux, uy) in zip(points, u):
                print(f"{number},{1e6 * at:.6g},{1e3 * px:.4g},{1e3 * py:.4g},{ux:.1f},{uy:.1f}", file=file)


if __name__ == "__main__":
    main()
