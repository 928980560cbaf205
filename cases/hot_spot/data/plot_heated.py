#!/usr/bin/env python3
"""Draws heated.vtu of one or more runs: to the left of each axis the mean heating, to the right the rise at the end.

    plot_heated.py TITLE=heated.vtu [TITLE=heated.vtu ...] --output heated.png
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm, Normalize
from vtk.util.numpy_support import vtk_to_numpy


def read(path):
    """Polygons of the cells in the half plane (radius, z) in um, heating in W/m^3, rise in K."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    polygons = []
    for i in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(i).GetPointIds()
        x = points[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]]
        flat = np.unique(np.round(np.column_stack([np.hypot(x[:, 0], x[:, 1]), x[:, 2]]) * 1e6, 6), axis=0)
        from_middle = flat - flat.mean(axis=0)
        polygons.append(flat[np.argsort(np.arctan2(from_middle[:, 1], from_middle[:, 0]))])
    values = grid.GetCellData()
    return polygons, *(vtk_to_numpy(values.GetArray(name)) for name in ("heating", "temperature_rise"))


def draw(axis, polygons, values, sign, cmap, norm):
    shown = PolyCollection([p * [sign, 1.0] for p in polygons], array=values, cmap=cmap, norm=norm, edgecolors="face",
                           linewidths=0.4)
    axis.add_collection(shown)
    return shown


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="TITLE=FILE")
    parser.add_argument("--output", default="heated.png")
    options = parser.parse_args()
    read_runs = [(title, read(path)) for title, path in (run.rsplit("=", 1) for run in options.runs)]
    most = max(rise.max() for _, (_, _, rise) in read_runs)
    heatings = np.concatenate([heating for _, (_, heating, _) in read_runs])
    norms = LogNorm(max(heatings.max() * 1e-3, 1.0), heatings.max()), Normalize(0.0, most)
    figure, axes = plt.subplots(1, len(read_runs), figsize=(6.0, 4.9), sharey=True)
    figure.subplots_adjust(left=0.13, right=0.97, bottom=0.37, top=0.97, wspace=0.12)
    for axis, (title, (polygons, heating, rise)) in zip(np.atleast_1d(axes), read_runs):
        left = draw(axis, polygons, np.maximum(heating, norms[0].vmin), -1.0, "magma", norms[0])
        right = draw(axis, polygons, rise, 1.0, "inferno", norms[1])
        turn = np.linspace(0, 2 * np.pi, 200)
        axis.plot(150 * np.sin(turn), 150 * np.cos(turn), color="white", linewidth=0.8)
        axis.axvline(0.0, color="white", linewidth=0.8)
        axis.set(title=title, xlim=(-330, 330), ylim=(-330, 330), aspect="equal", xticks=(-300, -150, 0, 150, 300), xlabel="radius [\N{MICRO SIGN}m]")
    np.atleast_1d(axes)[0].set_ylabel("z [\N{MICRO SIGN}m]")
    for shown, label, bottom in ((left, "left: mean heating [W/m$^3$]", 0.24), (right, "right: rise at the end [K]", 0.11)):
        figure.colorbar(shown, cax=figure.add_axes([0.2, bottom, 0.68, 0.025]), orientation="horizontal", label=label)
    figure.savefig(options.output, dpi=150)
    print(options.output)


if __name__ == "__main__":
    main()
