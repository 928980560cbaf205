#!/usr/bin/python3
"""Draws the fields of a fracture run: damage in the planes xz and yz through a point, and the debonded band in space.

    xvfb-run -a /usr/bin/python3 postproc/plots/render_fields.py RESULTS --output PICTURES

RESULTS is a folder with fields.pvd; lengths are in metres. Needs the Debian packages python3-vtk9 (libvtk9-dev brings
it) and, where there is no display, xvfb. ParaView's pvpython runs it as well.
"""

import argparse
import pathlib

import vtkmodules.vtkInteractionStyle  # noqa: F401  (VTK's factories)
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkCutter, vtkFeatureEdges
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

from frames import cells_between, frame_at, frames_of, read_grid, run, warped

PICTURE = (1400, 1000)
WHITE, BLACK, GLASS, EDGE = (1, 1, 1), (0.1, 0.1, 0.1), (0.80, 0.83, 0.87), (0.45, 0.45, 0.45)
DAMAGE_COLOURS = ((0.0, 0.93, 0.94, 0.96), (0.25, 0.62, 0.76, 0.88), (0.5, 0.99, 0.85, 0.45),
                  (0.75, 0.91, 0.37, 0.20), (1.0, 0.40, 0.00, 0.10))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, help="folder with fields.pvd")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("."), help="folder for the pictures")
    parser.add_argument("--centre", nargs=3, type=float, metavar=("X", "Y", "Z"),
                        help="point of the planes [m]; default: the centre of the inclusion, or else of the body")
    parser.add_argument("--inclusion", type=int, default=0, help="number of the bead's material, -1 for none")
    parser.add_argument("--time", type=float, help="time value of the frame, as in fields.pvd; default: the last")
    parser.add_argument("--warp", type=float, default=0.0, metavar="FACTOR",
                        help="draw the body as it has moved, displacements times this; default: as it was")
    parser.add_argument("--gaps", action="store_true", help="leave the broken cells (d > 0.95) out of the sections")
    parser.add_argument("--band", type=float, default=0.9, help="least damage of the debonded band")
    parser.add_argument("--zoom", type=float, default=1.0)
    return parser.parse_args()


def section(data, centre, normal):
    plane = vtkPlane()
    plane.SetOrigin(*centre)
    plane.SetNormal(*normal)
    cutter = vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.GenerateTrianglesOff()
    return run(cutter, data)


def surface(data):
    return run(vtkGeometryFilter(), data)


def outline(data):
    edges = vtkFeatureEdges()
    edges.ColoringOff()
    return run(edges, surface(data))


def centre_of(data):
    bounds = data.GetBounds()
    return [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]


def damage_colours():
    table = vtkColorTransferFunction()
    table.SetColorSpaceToLab()
    for value, *colour in DAMAGE_COLOURS:
        table.AddRGBPoint(value, *colour)
    return table


def plain_actor(data, colour, width=1.0):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetAmbient(0.35)
    actor.GetProperty().SetDiffuse(0.75)
    actor.GetProperty().SetLineWidth(width)
    return actor


def damage_actor(data, lit):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("damage")
    mapper.SetLookupTable(damage_colours())
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.35 if lit else 1.0)
    actor.GetProperty().SetDiffuse(0.75 if lit else 0.0)
    return actor


def set_text(properties, size):
    properties.SetColor(*BLACK)
    properties.SetFontSize(size)
    properties.SetFontFamilyToArial()
    properties.BoldOff()
    properties.ItalicOff()
    properties.ShadowOff()


def colour_bar():
    bar = vtkScalarBarActor()
    bar.SetLookupTable(damage_colours())
    bar.SetTitle("damage d\n ")
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.2f")
    bar.UnconstrainedFontSizeOn()
    set_text(bar.GetTitleTextProperty(), 26)
    set_text(bar.GetLabelTextProperty(), 24)
    bar.SetPosition(0.87, 0.2)
    bar.SetWidth(0.09)
    bar.SetHeight(0.6)
    return bar


def caption(text):
    actor = vtkTextActor()
    actor.SetInput(text)
    set_text(actor.GetTextProperty(), 26)
    actor.SetPosition(30, 25)
    return actor


def draw(path, actors, text, direction, bounds, zoom):
    renderer = vtkRenderer()
    renderer.SetBackground(*WHITE)
    for actor in actors:
        renderer.AddActor(actor)
    renderer.AddActor2D(colour_bar())
    renderer.AddActor2D(caption(text))
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*(-d for d in direction))
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera(bounds)
    camera.Zoom(1.25 * zoom)

    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*PICTURE)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    print(path)


def slice_actors(grid, bead, centre, normal):
    actors = [damage_actor(section(grid, centre, normal), lit=False)]
    if bead.GetNumberOfCells():
        actors.append(plain_actor(section(surface(bead), centre, normal), BLACK, 2.5))
    return actors


def band_actors(grid, bead, least_damage):
    actors = []
    if bead.GetNumberOfCells():
        actors.append(plain_actor(surface(bead), GLASS))
    else:
        actors.append(plain_actor(outline(grid), EDGE, 1.5))
    actors.append(damage_actor(surface(cells_between(grid, "damage", least_damage, 1.0)), lit=True))
    return actors


def main():
    options = parse_arguments()
    options.output.mkdir(parents=True, exist_ok=True)
    time, file, _ = frame_at(frames_of(options.results), options.time)
    grid = read_grid(file)
    if options.warp:
        grid = warped(grid, options.warp)
    drawn = cells_between(grid, "damage", 0.0, 0.95) if options.gaps else grid
    bead = cells_between(grid, "material", options.inclusion, options.inclusion)
    centre = options.centre or centre_of(bead if bead.GetNumberOfCells() else grid)
    for name, normal, direction in (("xz", (0, 1, 0), (0, 1, 0)), ("yz", (1, 0, 0), (-1, 0, 0))):
        draw(options.output / f"damage_{name}.png", slice_actors(drawn, bead, centre, normal),
             f"{name} plane, time value {time:.4g}", direction, grid.GetBounds(), options.zoom)
    around = bead if bead.GetNumberOfCells() else grid
    draw(options.output / "debonded_band.png", band_actors(grid, bead, options.band),
         f"cells with d > {options.band:g}, time value {time:.4g}", (-0.56, 0.72, -0.41), around.GetBounds(),
         0.85 * options.zoom)


main()
