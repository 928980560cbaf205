#!/usr/bin/python3
"""Draws a section through the body of a fracture run as it has moved, or a film of it beside the curve.

    /usr/bin/python3 postproc/plots/draw_body.py RESULTS --output body.png
    /usr/bin/python3 postproc/plots/draw_body.py RESULTS --film body.webp

RESULTS is a folder with fields.pvd and force_displacement.csv. Colours go smoothly from cell to cell within a material;
broken cells (damage above 0.95) are left out, so that cracks open. Needs Debian's python3-vtk9 (libvtk9-dev brings it)
and python3-matplotlib; no display.
"""

import argparse
import io
import pathlib

import matplotlib.collections
import matplotlib.colors
import matplotlib.transforms
import numpy
from PIL import Image
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData, vtkCleanPolyData, vtkCutter, vtkFeatureEdges

from frames import cells_between, frame_at, frames_of, read_grid, run, warped
from plotting import plt, read_columns

AXES = {"xz": (0, 2, 1), "yz": (1, 2, 0), "xy": (0, 1, 2)}  # across the picture, up, normal to it
DAMAGE = matplotlib.colors.LinearSegmentedColormap.from_list("damage", [
    (0.0, "#edf0f5"), (0.25, "#9ec2e0"), (0.5, "#fcd973"), (0.75, "#e85e33"), (1.0, "#66001a")])
LOOKS = {"damage": ("damage", DAMAGE, 1.0), "von_mises": ("stress, von Mises [MPa]", "viridis", 1e-6)}
PREFIXES = {1e-9: "n", 1e-6: "\N{MICRO SIGN}", 1e-3: "m", 1.0: "", 1e3: "k", 1e6: "M"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, help="folder with fields.pvd")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("body.png"), help="the picture, a PNG")
    parser.add_argument("--film", type=pathlib.Path, help="a film of all frames in place of a picture, a WebP")
    parser.add_argument("--plane", choices=AXES, default="xz")
    parser.add_argument("--through", nargs=3, type=float, metavar=("X", "Y", "Z"), help="point of the plane [m]; the middle")
    parser.add_argument("--colour", choices=LOOKS, default="damage")
    parser.add_argument("--most", type=float, help="upper end of the colours, in their unit; the 99.5th percentile")
    parser.add_argument("--at", type=float, help="time value of the frame, as in fields.pvd; the last")
    parser.add_argument("--warp", type=float, default=1.0, help="displacements times this; 1 is true")
    parser.add_argument("--zoom", type=float, default=1.0, help="part of the body's width that is seen, 1 / ZOOM")
    parser.add_argument("--width", type=int, default=600, help="of the picture, in pixels")
    return parser.parse_args()


def curve_of(results):
    """Steps, displacements [m] and forces [N] along the direction of greatest force."""
    columns = {name: numpy.array(values) for name, values in read_columns(results / "force_displacement.csv").items()}
    force = max((columns[f"force_{axis}_N"] for axis in "xyz"), key=lambda values: numpy.abs(values).max())
    return columns["step"].astype(int), columns["displacement_m"], force


def prefix_of(value):
    """The factor and the prefix of a unit in which a value has one to three digits before the point."""
    factor = max((f for f in PREFIXES if f <= abs(value) * 1.0000001), default=1e-9)
    return factor, PREFIXES[factor]


def with_unit(value, unit, digits=3):
    factor, prefix = prefix_of(value) if value else (1.0, "")
    return f"{value / factor:.{digits}g} {prefix}{unit}"


def coloured_grid(file, colour):
    """The cells of a frame with the values that colour them, in the field "colour"."""
    grid = WrapDataObject(read_grid(file))
    if colour == "damage":
        values = numpy.array(grid.CellData["damage"])
    else:
        xx, yy, zz, xy, yz, xz = numpy.array(grid.CellData["stress"]).T
        values = numpy.sqrt(0.5 * ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) + 3 * (xy**2 + yz**2 + xz**2))
    grid.CellData.append(values * LOOKS[colour][2], "colour")
    return grid.VTKObject


def sections(grid, point, normal, warp):
    """For each material: points of the section as it has moved, its triangles, their values, and the lines of its edge."""
    sound = cells_between(grid, "damage", -1.0, 0.95)
    plane = vtkPlane()
    direction = numpy.eye(3)[normal]
    plane.SetOrigin(*(numpy.array(point) + 3e-4 * grid.GetLength() * direction))  # off the points that may lie in it
    plane.SetNormal(*direction)
    for material in sorted(set(WrapDataObject(sound).CellData["material"])):
        smoother = vtkCellDataToPointData()  # of this field alone: the points have a displacement of their own
        smoother.ProcessAllArraysOff()
        smoother.AddCellDataArray("colour")
        part = run(smoother, cells_between(sound, "material", material, material))
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


def nice_length(width):
    """About a fifth of a width: 1, 2 or 5 times a power of ten."""
    power = 10.0 ** numpy.floor(numpy.log10(width / 5))
    return max(f * power for f in (1, 2, 5) if f * power <= width / 5)


def draw_body(axes, grid, options, window, most):
    across, up, normal = AXES[options.plane]
    for points, triangles, values, rim in sections(grid, options.through, normal, options.warp):
        picture = axes.tripcolor(points[:, across], points[:, up], triangles, values, shading="gouraud", vmin=0.0, vmax=most,
                                 cmap=LOOKS[options.colour][1], rasterized=True)
        axes.add_collection(matplotlib.collections.LineCollection(rim[:, :, [across, up]], colors="0.25", linewidths=0.6))
    left, right, bottom, top = window
    axes.set_xlim(left, right), axes.set_ylim(bottom, top)
    axes.set_aspect("equal"), axes.set_axis_off()
    length = nice_length(right - left)
    below = axes.transData + matplotlib.transforms.ScaledTranslation(0.0, -0.12, axes.figure.dpi_scale_trans)
    axes.plot([left, left + length], [bottom, bottom], color="0.1", linewidth=2.5, clip_on=False, solid_capstyle="butt",
              transform=below)
    axes.text(left + 1.1 * length, bottom, with_unit(length, "m"), va="center", fontsize=9, transform=below)
    return picture


def draw_curve(axes, displacements, forces, row):
    (along, along_prefix), (force, force_prefix) = prefix_of(abs(displacements).max()), prefix_of(abs(forces).max())
    axes.plot(displacements / along, forces / force, color="#0072b2", linewidth=1.5)
    axes.plot(displacements[row] / along, forces[row] / force, "o", color="#d55e00", markersize=7)
    axes.set_xlabel(f"displacement [{along_prefix}m]"), axes.set_ylabel(f"force [{force_prefix}N]")
    axes.spines[["top", "right"]].set_visible(False)


def window_of(grid, options):
    """What is seen of the plane, with room for the moves: left, right, bottom, top."""
    across, up, _ = AXES[options.plane]
    bounds = grid.GetBounds()
    moves = options.warp * numpy.array(WrapDataObject(grid).PointData["displacement"])
    sides = []
    for axis in (across, up):
        low, high = bounds[2 * axis] + min(moves[:, axis].min(), 0), bounds[2 * axis + 1] + max(moves[:, axis].max(), 0)
        half = 0.5 * (high - low) / options.zoom
        middle = 0.5 * (high + low) if options.zoom == 1.0 else options.through[axis]
        sides += [middle - half, middle + half]
    return sides


def picture_of(file, row, curve, options, window, most):
    """The picture of a frame as an image."""
    _, displacements, forces = curve
    tall = (window[3] - window[2]) / (window[1] - window[0])
    inches, columns = options.width / 100, (0.58, 0.42) if options.film else (1.0,)
    height = min(columns[0] * inches * 0.8 * tall, inches) + 0.75
    figure = plt.figure(figsize=(inches, height))
    grid_spec = figure.add_gridspec(1, len(columns), width_ratios=columns, left=0.03, right=0.97 if options.film else 0.9,
                                    bottom=(0.6 if options.film else 0.3) / height, top=1.0 - 0.45 / height, wspace=0.45)
    body = figure.add_subplot(grid_spec[0])
    colours = draw_body(body, coloured_grid(file, options.colour), options, window, most)
    bar = figure.colorbar(colours, ax=body, fraction=0.045, pad=0.03, aspect=30)
    bar.set_label(LOOKS[options.colour][0], fontsize=9), bar.ax.tick_params(labelsize=8), bar.outline.set_visible(False)
    if options.film:
        draw_curve(figure.add_subplot(grid_spec[1]), displacements, forces, row)
    moved = "" if options.warp == 1.0 else f", drawn {options.warp:g} times as far"
    figure.text(0.03, 1.0 - 0.25 / height, f"{with_unit(displacements[row], 'm')}, {with_unit(forces[row], 'N')}{moved}", fontsize=11, weight="bold")
    memory = io.BytesIO()
    figure.savefig(memory, format="png", dpi=200)
    plt.close(figure)
    image = Image.open(memory).convert("RGB")
    return image.resize((options.width, round(options.width * image.height / image.width)), Image.LANCZOS)


def main():
    options = parse_arguments()
    plt.rcParams.update({"font.size": 9, "font.family": ["Liberation Sans", "DejaVu Sans"]})
    frames, curve = frames_of(options.results), curve_of(options.results)
    last = coloured_grid(frames[-1][1], options.colour)
    bounds = last.GetBounds()
    options.through = options.through or [0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)]
    window = window_of(last, options)
    most = options.most or (1.0 if options.colour == "damage" else
                            float(numpy.percentile(numpy.array(WrapDataObject(last).CellData["colour"]), 99.5)))
    row_of = {step: row for row, step in enumerate(curve[0])}
    if options.film is None:
        _, file, step = frame_at(frames, options.at)
        picture_of(file, row_of[step], curve, options, window, most).save(options.output, optimize=True)
        print(options.output)
        return
    pictures = [picture_of(file, row_of[step], curve, options, window, most) for _, file, step in frames]
    pictures[0].save(options.film, save_all=True, append_images=pictures[1:], loop=0, quality=75, method=6,
                     duration=[250] * (len(pictures) - 1) + [2000])
    print(options.film, f"{options.film.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
