"""Unstructured grids in the files that pfdm writes: VTK's XML, binary, compressed."""

from __future__ import annotations

import base64
import xml.etree.ElementTree as xml
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy

_types = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "Int32": "i4", "Int64": "i8", "UInt8": "u1", "UInt32": "u4",
          "UInt64": "u8"}
_meshio_names = {10: "tetra", 12: "hexahedron", 13: "wedge", 14: "pyramid", 9: "quad", 5: "triangle", 7: "polygon",
                 3: "line", 1: "vertex"}
polyhedron = 42  # VTK's number of the type


@dataclass
class Grid:
    """Points and cells with their data, SI units.

    Attributes:
        points: (n_points, 3), position [m].
        connectivity: points of all cells, one cell after the other.
        offsets: (n_cells,), where each cell ends in `connectivity`.
        types: (n_cells,), VTK's numbers of cell types: 10 tetrahedron, 12 hexahedron, 13 wedge, 42 polyhedron.
        faces, face_offsets: streams of faces of polyhedra as VTK has them, or None.
        point_data, cell_data: name to (n,) or (n, n_components) array; symmetric tensors have the components
            XX, YY, ZZ, XY, YZ, XZ.
        field_data: name to array; "region_NAME" is the number that `material` has in region NAME.
        units: name of an array to its unit, where it has one.
        path: the file.
    """

    points: numpy.ndarray
    connectivity: numpy.ndarray
    offsets: numpy.ndarray
    types: numpy.ndarray
    faces: numpy.ndarray | None
    face_offsets: numpy.ndarray | None
    point_data: dict[str, numpy.ndarray]
    cell_data: dict[str, numpy.ndarray]
    field_data: dict[str, numpy.ndarray]
    units: dict[str, str]
    path: Path
    _centres: numpy.ndarray | None = field(default=None, repr=False)

    @property
    def n_cells(self) -> int:
        return len(self.types)

    @property
    def cell_centres(self) -> numpy.ndarray:
        """(n_cells, 3), mean of the points of each cell [m]."""
        if self._centres is None:
            starts = numpy.concatenate(([0], self.offsets[:-1])).astype(numpy.intp)
            sums = numpy.add.reduceat(self.points[self.connectivity], starts, axis=0)
            self._centres = sums / numpy.diff(numpy.concatenate(([0], self.offsets)))[:, None]
        return self._centres

    def regions(self) -> dict[str, int]:
        """Name of each region to its number in cell_data["material"]."""
        prefix = "region_"
        return {name.removeprefix(prefix): int(value[0]) for name, value in self.field_data.items()
                if name.startswith(prefix)}

    def to_meshio(self) -> Any:
        """The grid as meshio.Mesh, with the data. Raises ImportError without meshio, ValueError for polyhedra."""
        import meshio

        if (self.types == polyhedron).any():
            raise ValueError(f"{self.path}: meshio cannot hold these polyhedra with their data: use to_pyvista()")
        blocks: list[tuple[str, numpy.ndarray]] = []
        data: dict[str, list[numpy.ndarray]] = {name: [] for name in self.cell_data}
        sizes = numpy.diff(numpy.concatenate(([0], self.offsets)))
        for kind in numpy.unique(self.types):
            cells = numpy.flatnonzero(self.types == kind)
            n = int(sizes[cells[0]])
            ends = self.offsets[cells]
            blocks.append((_meshio_names[int(kind)], self.connectivity[ends[:, None] + numpy.arange(-n, 0)]))
            for name, values in self.cell_data.items():
                data[name].append(values[cells])
        return meshio.Mesh(self.points, blocks, point_data=self.point_data, cell_data=data)

    def to_vtk(self) -> Any:
        """The grid as vtkUnstructuredGrid with its data. Points and data are those of this grid, not copies.

        Raises ImportError without VTK (Debian: python3-vtk9).
        """
        from .vtk_grid import vtk_grid

        return vtk_grid(self)

    def to_pyvista(self) -> Any:
        """The grid as pyvista.UnstructuredGrid with its data. Raises ImportError without pyvista."""
        import pyvista

        return pyvista.wrap(self.to_vtk())


def _bytes_of(text: str, header: str) -> bytes:
    """The content of a DataArray: blocks by zlib, in base64, after their sizes."""
    text = text.strip()
    width = numpy.dtype(header).itemsize
    n_blocks = int(numpy.frombuffer(base64.b64decode(text[: (width + 2) // 3 * 4])[:width], header)[0])
    if n_blocks == 0:
        return b""
    n_header = (width * (3 + n_blocks) + 2) // 3 * 4
    sizes = numpy.frombuffer(base64.b64decode(text[:n_header]), header, 3 + n_blocks)[3:]
    blocks = base64.b64decode(text[n_header:])
    ends = numpy.cumsum(sizes)
    return b"".join(zlib.decompress(blocks[int(end - size): int(end)]) for end, size in zip(ends, sizes, strict=True))


def read_vtu(path: str | Path) -> Grid:
    """The grid of a file that pfdm has written. Arrays are views of what was read, not copies.

    Raises OSError if it cannot be read, ValueError if it is no such file.
    """
    path = Path(path)
    try:
        root = xml.parse(path).getroot()
        piece = root.find("UnstructuredGrid/Piece")
        if piece is None:
            raise ValueError("it holds no unstructured grid")
        header = _types[root.get("header_type", "UInt32")]
        units: dict[str, str] = {}

        def arrays(element: xml.Element | None) -> dict[str, numpy.ndarray]:
            found: dict[str, numpy.ndarray] = {}
            for array in () if element is None else element.iter("DataArray"):
                if array.get("type") not in _types:  # texts
                    continue
                name = array.get("Name", "")
                values = numpy.frombuffer(_bytes_of(array.text or "", header), _types[array.get("type", "")])
                n = int(array.get("NumberOfComponents", "1"))
                found[name] = values.reshape(-1, n) if n > 1 else values
                for information in array.iter("InformationKey"):
                    if information.get("name") == "UNITS_LABEL":
                        units[name] = (information.text or "").strip()
            return found

        cells = arrays(piece.find("Cells"))
        return Grid(points=next(iter(arrays(piece.find("Points")).values())), connectivity=cells["connectivity"],
                    offsets=cells["offsets"], types=cells["types"], faces=cells.get("faces"),
                    face_offsets=cells.get("faceoffsets"), point_data=arrays(piece.find("PointData")),
                    cell_data=arrays(piece.find("CellData")),
                    field_data=arrays(root.find("UnstructuredGrid/FieldData")), units=units, path=path)
    except (xml.ParseError, KeyError, StopIteration, zlib.error, ValueError) as error:
        raise ValueError(f"{path}: this is no grid that pfdm has written: {error}") from None
