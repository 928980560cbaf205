#!/usr/bin/python3
"""Draws the body of a fracture run in space as it has moved, without its broken cells (damage above 0.95).

    xvfb-run -a /usr/bin/python3 postproc/plots/draw_space.py RESULTS --output space.png --cut xz
    xvfb-run -a /usr/bin/python3 postproc/plots/draw_space.py RESULTS --mesh --cut xz --whole 0

RESULTS is a folder with fields.pvd and force_displacement.csv, for --mesh with mesh.vtu alone. Colours go smoothly from cell
to cell within a material.
Needs Debian's python3-vtk9 (libvtk9-dev brings it), python3-matplotlib and, where there is no display, xvfb.
"""

import argparse
import pathlib

import matplotlib.cm
import matplotlib.colors
import numpy
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (VTK's factories)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkTableBasedClipDataSet
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

from frames import (LOOKS, Curve, add_options, coloured_grid, frame_at, frames_of, materials_of, most_of, read_grid, run,
                    sound_cells, warped)
from plotting import draw_caption, draw_colours, draw_scale, image_of, new_body, plt

NORMALS = {"xz": 1, "yz": 0, "xy": 2}
MATERIALS = ("#dfe6ee", "#7fa8c9", "#e0a458", "#8f6f9e")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, help="folder with fields.pvd")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("space.png"), help="the picture, a PNG")
    parser.add_argument("--cut", choices=NORMALS, help="a plane through the middle: what lies before it is left out")
    parser.add_argument("--whole", type=int, nargs="*", default=[], help="numbers of materials that are not cut")
    parser.add_argument("--from", dest="seen_from", nargs=3, type=float, default=(-0.5, -1.0, 0.45), metavar=("X", "Y", "Z"),
                        help="direction to the eye")
    parser.add_argument("--mesh", action="store_true", help="the mesh before the run, a colour for each material")
    add_options(parser)
    return parser.parse_args()


def cut_off(part, grid, options):
    """Without what lies before the plane."""
    bounds, normal = grid.GetBounds(), NORMALS[options.cut]
    plane = vtkPlane()
    plane.SetOrigin(*(0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)))
    plane.SetNormal(*-numpy.sign(options.seen_from[normal]) * numpy.eye(3)[normal])
    clip = vtkTableBasedClipDataSet()
    clip.SetClipFunction(plane)
    return run(clip, part)


def surfaces(grid, options):
    """Number and surface of each material as it has moved, with its colours at the points."""
    for material, part in materials_of(grid if options.mesh else sound_cells(grid), smooth=not options.mesh):
        if options.cut and material not in options.whole:
            part = cut_off(part, grid, options)
        surface = run(vtkGeometryFilter(), part)
        normals = vtkPolyDataNormals()
        normals.SetFeatureAngle(30.0)
        yield material, run(normals, surface if options.mesh else warped(surface, options.warp))


def colour_table(colour):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i, rgba in enumerate(plt.get_cmap(LOOKS[colour][1])(range(256))):
        table.SetTableValue(i, *rgba)
    return table


def actor_of(surface, table, most):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("colour")
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(0.0, most)
    mapper.SetInterpolateScalarsBeforeMapping(True)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.3)
    actor.GetProperty().SetDiffuse(0.75)
    return actor


def plain(actor, material):
    actor.GetMapper().ScalarVisibilityOff()
    actor.GetProperty().SetColor(*matplotlib.colors.to_rgb(MATERIALS[material % len(MATERIALS)]))
    return actor


def rendered(actors, seen_from, width):
    """The pixels, rows from above, without margins, and the size of one [m]."""
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for actor in actors:
        renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*seen_from)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(3 * width, 3 * width)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.Update()
    pixels = vtk_to_numpy(image.GetOutput().GetPointData().GetScalars()).reshape(3 * width, 3 * width, 3)[::-1]
    drawn = (pixels < 255).any(axis=2)
    (rows,), (columns,) = numpy.nonzero(drawn.any(axis=1)), numpy.nonzero(drawn.any(axis=0))
    return (pixels[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1], 2.0 * camera.GetParallelScale() / (3 * width))


def figure_of(pixels, size, width):
    """The figure with the pixels, of `size` [m] each, and its axes."""
    figure, axes = new_body(width, pixels.shape[0] / pixels.shape[1])
    axes.imshow(pixels, extent=(0.0, size * pixels.shape[1], 0.0, size * pixels.shape[0]))
    axes.set_axis_off()
    draw_scale(axes)
    return figure, axes


def picture_of_mesh(options):
    grid = read_grid(options.results / "mesh.vtu")
    actors = [plain(actor_of(surface, vtkLookupTable(), 1.0), material) for material, surface in surfaces(grid, options)]
    return figure_of(*rendered(actors, options.seen_from, options.width), options.width)[0]


def picture_of_frame(options):
    curve = Curve(options.results)
    _, file, step = frame_at(frames_of(options.results), options.at)
    grid = coloured_grid(file, options.colour)
    most = most_of(grid, options)
    table, (label, colours, _) = colour_table(options.colour), LOOKS[options.colour]
    actors = [actor_of(surface, table, most) for _, surface in surfaces(grid, options)]
    figure, axes = figure_of(*rendered(actors, options.seen_from, options.width), options.width)
    draw_colours(axes, matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0.0, most), colours), label)
    draw_caption(figure, curve.caption(curve.row_of(step)), options.warp)
    return figure


def main():
    options = parse_arguments()
    picture = picture_of_mesh(options) if options.mesh else picture_of_frame(options)
    image_of(picture, options.width).save(options.output, optimize=True)
    print(options.output)


if __name__ == "__main__":
    main()
