#!/usr/bin/python3
"""Draws a section through the body of a fracture run as it has moved, alone or beside the curve, or a film of both.

    /usr/bin/python3 postproc/plots/draw_body.py RESULTS --output body.png
    /usr/bin/python3 postproc/plots/draw_body.py RESULTS --film body.webp

RESULTS is a folder with fields.pvd and force_displacement.csv. Colours go smoothly from cell to cell within a material;
broken cells (damage above 0.95) are left out, so that cracks open. Needs Debian's python3-vtk9 (libvtk9-dev brings it)
and python3-matplotlib; no display.
"""

import argparse
import pathlib

import matplotlib.collections
import numpy
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkCutter, vtkFeatureEdges

from frames import (LOOKS, Curve, add_options, coloured_grid, frame_at, frames_of, materials_of, most_of, run,
                    sound_cells, warped)
from plotting import draw_caption, draw_colours, draw_scale, image_of, new_body, plt, prefix_of

AXES = {"xz": (0, 2, 1), "yz": (1, 2, 0), "xy": (0, 1, 2)}  # across the picture, up, normal to it


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, help="folder with fields.pvd")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("body.png"), help="the picture, a PNG")
    parser.add_argument("--film", type=pathlib.Path, help="a film of all frames in place of a picture, a WebP")
    parser.add_argument("--plane", choices=AXES, default="xz")
    parser.add_argument("--through", nargs=3, type=float, metavar=("X", "Y", "Z"), help="point of the plane [m]; the middle")
    parser.add_argument("--window", nargs=4, type=float, metavar=("LEFT", "RIGHT", "BOTTOM", "TOP"),
                        help="what is seen of the plane [m], in place of the whole body")
    parser.add_argument("--curve", action="store_true", help="the force over the displacement beside the body")
    add_options(parser)
    return parser.parse_args()


def sections(grid, point, normal, warp):
    """For each material: points of the section as it has moved, its triangles, their values, and the lines of its edge."""
    plane = vtkPlane()
    direction = numpy.eye(3)[normal]
    plane.SetOrigin(*(numpy.array(point) + 3e-4 * grid.GetLength() * direction))  # off the points that may lie in it
    plane.SetNormal(*direction)
    for _, part in materials_of(sound_cells(grid)):
        cutter = vtkCutter()
        cutter.SetCutFunction(plane)
        cut = run(cutter, part)
        if cut.GetNumberOfPolys() == 0:
            continue
        moved = WrapDataObject(run(vtkCleanPolyData(), warped(cut, warp)))  # cells share the points that they have in common
        edges = vtkFeatureEdges()
        edges.ColoringOff()
        edges.FeatureEdgesOff()
        edges.ManifoldEdgesOff()
        edges.NonManifoldEdgesOff()
        rim = WrapDataObject(run(edges, moved.VTKObject))
        triangles = numpy.array(moved.Polygons).reshape(-1, 4)[:, 1:]
        lines = vtk_to_numpy(rim.GetLines().GetConnectivityArray()).reshape(-1, 2)
        yield (numpy.array(moved.Points), triangles, numpy.array(moved.PointData["colour"]),
               numpy.array(rim.Points)[lines])


def draw_body(axes, grid, options, window, most):
    across, up, normal = AXES[options.plane]
    for points, triangles, values, rim in sections(grid, options.through, normal, options.warp):
        picture = axes.tripcolor(points[:, across], points[:, up], triangles, values, shading="gouraud", vmin=0.0, vmax=most,
                                 cmap=LOOKS[options.colour][1], rasterized=True)
        axes.add_collection(matplotlib.collections.LineCollection(rim[:, :, [across, up]], colors="0.25", linewidths=0.6))
    left, right, bottom, top = window
    axes.set_xlim(left, right), axes.set_ylim(bottom, top)
    axes.set_aspect("equal"), axes.set_axis_off()
    draw_scale(axes)
    return picture


def draw_curve(axes, curve, row):
    factors, labels = [], []
    for values, name, unit in zip((curve.x, curve.y), curve.names, curve.units):
        factor, prefix = prefix_of(abs(values).max()) if unit else (1.0, "")
        factors.append(factor), labels.append(f"{name} [{prefix}{unit}]" if unit else name)
    axes.plot(curve.x / factors[0], curve.y / factors[1], color="#0072b2", linewidth=1.5)
    axes.plot(curve.x[row] / factors[0], curve.y[row] / factors[1], "o", color="#d55e00", markersize=7)
    axes.set_xlabel(labels[0]), axes.set_ylabel(labels[1])
    axes.spines[["top", "right"]].set_visible(False)


def window_of(grid, options):
    """What is seen of the plane, with room for the moves: left, right, bottom, top."""
    if options.window:
        return options.window
    across, up, _ = AXES[options.plane]
    bounds = grid.GetBounds()
    moves = options.warp * numpy.array(WrapDataObject(grid).PointData["displacement"])
    sides = []
    for axis in (across, up):
        low, high = bounds[2 * axis] + min(moves[:, axis].min(), 0), bounds[2 * axis + 1] + max(moves[:, axis].max(), 0)
        sides += [low, high]
    return sides


def is_flat(window):
    """The curve of a flat body is drawn below it."""
    left, right, bottom, top = window
    return top - bottom < 0.4 * (right - left)


def panels(options, window):
    """The figure and its axes: of the body alone, or with the curve beside it, below a flat one."""
    tall, inches = (window[3] - window[2]) / (window[1] - window[0]), options.width / 100
    if not (options.curve or options.film):
        figure, axes = new_body(options.width, tall)
        return figure, [axes]
    body = 0.83 * inches * tall + 0.55  # and its colours below
    if is_flat(window):
        height, rows_and_columns = body + 3.0, (2, 1)
        place = {"left": 0.1, "right": 0.93, "hspace": 0.6 / (0.5 * (body + 1.7)), "height_ratios": (body, 1.7)}
    else:
        height, rows_and_columns = min(max(0.46 * inches * tall, 2.0), inches) + 0.75, (1, 2)
        place = {"left": 0.03, "right": 0.97, "wspace": 0.45, "width_ratios": (0.58, 0.42)}
    figure = plt.figure(figsize=(inches, height))
    grid = figure.add_gridspec(*rows_and_columns, bottom=0.6 / height, top=1.0 - 0.45 / height, **place)
    return figure, [figure.add_subplot(part) for part in grid]


def picture_of(file, row, curve, options, window, most):
    """The picture of a frame as an image."""
    figure, (body, *beside) = panels(options, window)
    colours = draw_body(body, coloured_grid(file, options.colour), options, window, most)
    draw_colours(body, colours, LOOKS[options.colour][0], below=bool(beside) and is_flat(window))
    for axes in beside:
        draw_curve(axes, curve, row)
    draw_caption(figure, curve.caption(row), options.warp)
    return image_of(figure, options.width)


def main():
    options = parse_arguments()
    frames, curve = frames_of(options.results), Curve(options.results)
    last = coloured_grid(frames[-1][1], options.colour)
    bounds = last.GetBounds()
    options.through = options.through or [0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)]
    window = window_of(last, options)
    most = most_of(last, options)
    if options.film is None:
        _, file, step = frame_at(frames, options.at)
        picture_of(file, curve.row_of(step), curve, options, window, most).save(options.output, optimize=True)
        print(options.output)
        return
    pictures = [picture_of(file, curve.row_of(step), curve, options, window, most) for _, file, step in frames]
    pictures[0].save(options.film, save_all=True, append_images=pictures[1:], loop=0, quality=75, method=6,
                     duration=[250] * (len(pictures) - 1) + [2000])
    print(options.film, f"{options.film.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
