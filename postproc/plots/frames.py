"""What the pictures of bodies share: the frames of a run, what colours them, and filters of VTK."""

import re
import xml.etree.ElementTree

import matplotlib.colors
import numpy
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData, vtkThreshold
from vtkmodules.vtkFiltersGeneral import vtkWarpVector
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from plotting import read_columns, with_unit

DAMAGE = matplotlib.colors.LinearSegmentedColormap.from_list("damage", [
    (0.0, "#edf0f5"), (0.25, "#9ec2e0"), (0.5, "#fcd973"), (0.75, "#e85e33"), (1.0, "#66001a")])
LOOKS = {"damage": ("damage", DAMAGE, 1.0), "von_mises": ("stress, von Mises [MPa]", "viridis", 1e-6)}


def add_options(parser):
    """What is drawn of which frame, and how large."""
    parser.add_argument("--colour", choices=LOOKS, default="damage")
    parser.add_argument("--most", type=float, help="upper end of the colours, in their unit; the 99.5th percentile")
    parser.add_argument("--at", type=float, help="time value of the frame, as in fields.pvd; the last")
    parser.add_argument("--warp", type=float, default=1.0, help="displacements times this; 1 is true")
    parser.add_argument("--width", type=int, default=600, help="of the picture, in pixels")


def frames_of(results):
    """(time value, file, step) of all frames in the folder of a run's results."""
    rows = xml.etree.ElementTree.parse(results / "fields.pvd").findall(".//DataSet")
    if not rows:
        raise SystemExit(f"{results} has no frames")
    return [(float(row.get("timestep")), results / row.get("file"), int(re.search(r"(\d+)\.vtu", row.get("file"))[1]))
            for row in rows]


def frame_at(frames, time):
    """The frame nearest to a time value; the last one for None."""
    return frames[-1] if time is None else min(frames, key=lambda frame: abs(frame[0] - time))


class Curve:
    """Force [N] over displacement [m] of a run, or of a box mean stress [Pa] over mean strain: in the direction of the most."""

    def __init__(self, results):
        is_box = (results / "stress_strain.csv").is_file()
        file, start, end = ("stress_strain.csv", "stress_", "_Pa") if is_box else ("force_displacement.csv", "force_", "_N")
        columns = {name: numpy.array(values) for name, values in read_columns(results / file).items()}
        most = max((name for name in columns if name.startswith(start) and name.endswith(end)),
                   key=lambda name: numpy.abs(columns[name]).max())
        name = most[len(start):-len(end)]
        self.steps, self.y = columns["step"].astype(int), columns[most]
        self.x = columns[f"strain_{name}"] if is_box else columns["displacement_m"]
        self.names, self.units = (("strain", "stress"), ("", "Pa")) if is_box else (("displacement", "force"), ("m", "N"))

    def row_of(self, step):
        return list(self.steps).index(step)

    def caption(self, row):
        """"624 um, 27.1 N"; of a box "strain 0.04, 1.2 MPa"."""
        x = with_unit(self.x[row], "m") if self.units[0] else f"{self.names[0]} {self.x[row]:.3g}"
        return f"{x}, {with_unit(self.y[row], self.units[1])}"


def read_grid(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


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


def run(a_filter, source):
    a_filter.SetInputData(source)
    a_filter.Update()
    return a_filter.GetOutput()


def cells_between(grid, field, low, high):
    threshold = vtkThreshold()
    threshold.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, field)
    threshold.SetLowerThreshold(low)
    threshold.SetUpperThreshold(high)
    threshold.SetThresholdFunction(vtkThreshold.THRESHOLD_BETWEEN)
    return run(threshold, grid)


def sound_cells(grid):
    """Without the broken ones, so that cracks open."""
    return cells_between(grid, "damage", -1.0, 0.95)


def materials_of(grid, smooth=True):
    """Number and cells of each material; smooth: with the field "colour" at its points."""
    for material in sorted(set(WrapDataObject(grid).CellData["material"])):
        part = cells_between(grid, "material", material, material)
        if smooth:
            smoother = vtkCellDataToPointData()  # of this field alone: the points have a displacement of their own
            smoother.ProcessAllArraysOff()
            smoother.AddCellDataArray("colour")
            part = run(smoother, part)
        yield int(material), part


def most_of(grid, options):
    """The upper end of the colours."""
    return options.most or (1.0 if options.colour == "damage" else
                            float(numpy.percentile(numpy.array(WrapDataObject(grid).CellData["colour"]), 99.5)))


def warped(data, factor):
    """Moved by the displacement at the points times a factor."""
    warp = vtkWarpVector()
    warp.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    warp.SetScaleFactor(factor)
    return run(warp, data)
