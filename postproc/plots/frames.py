"""What the pictures of bodies share: the frames of a run, and filters of VTK."""

import re
import xml.etree.ElementTree

from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import vtkThreshold
from vtkmodules.vtkFiltersGeneral import vtkWarpVector
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


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


def read_grid(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


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


def warped(data, factor):
    """Moved by the displacement at the points times a factor."""
    warp = vtkWarpVector()
    warp.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    warp.SetScaleFactor(factor)
    return run(warp, data)
