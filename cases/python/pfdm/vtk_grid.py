"""Grids of results as those of VTK, for PyVista and VTK's own filters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy

if TYPE_CHECKING:
    from .vtu import Grid

polyhedron = 42  # VTK's number of the type


def vtk_grid(grid: Grid) -> Any:
    """A vtkUnstructuredGrid of the points, cells, data and field data of a grid."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

    made = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(grid.points)))
    made.SetPoints(points)
    starts = numpy.concatenate(([0], grid.offsets)).astype("i8")
    if (grid.types == polyhedron).any():
        _add_cells_by_faces(made, grid, starts, vtkIdList)
    else:
        cells = vtkCellArray()
        cells.SetData(numpy_to_vtkIdTypeArray(starts, deep=True),
                      numpy_to_vtkIdTypeArray(grid.connectivity.astype("i8"), deep=True))
        made.SetCells(numpy_to_vtk(grid.types.astype("u1"), deep=True), cells)
    for to, data in ((made.GetPointData(), grid.point_data), (made.GetCellData(), grid.cell_data),
                     (made.GetFieldData(), grid.field_data)):
        for name, values in data.items():
            array = numpy_to_vtk(numpy.ascontiguousarray(values))
            array.SetName(name)
            to.AddArray(array)
    return made


def _add_cells_by_faces(made: Any, grid: Grid, starts: numpy.ndarray, id_list: Any) -> None:
    """Cells one by one, polyhedra by their faces: number of faces, then of each its number of points and these."""
    made.AllocateEstimate(grid.n_cells, 8)
    assert grid.faces is not None and grid.face_offsets is not None
    ends = numpy.asarray(grid.face_offsets)
    first = 0
    for i, kind in enumerate(grid.types):
        if kind == polyhedron:
            stream = grid.faces[first:ends[i]]
        else:
            stream = grid.connectivity[starts[i]:starts[i + 1]]
        first = ends[i] if ends[i] >= 0 else first  # of other cells -1
        ids = id_list()
        for number in stream:
            ids.InsertNextId(int(number))
        made.InsertNextCell(int(kind), ids)
