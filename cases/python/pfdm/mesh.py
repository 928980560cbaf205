"""Meshes of arrays, for runs in process."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy
from numpy.typing import ArrayLike, NDArray

from .errors import InputError

# Names of meshio, VTK's number and the points of each.
_kinds = {"tetra": (10, 4), "hexahedron": (12, 8), "wedge": (13, 6), "pyramid": (14, 5), "triangle": (5, 3), "quad": (9, 4)}


def _whole(name: str, given: ArrayLike, kind: type[Any]) -> NDArray[Any]:
    """An array of whole numbers as `kind`. Raises InputError, which calls it `name`, for others."""
    try:
        array = numpy.asarray(given)
    except ValueError as error:
        raise InputError(f"the mesh of arrays: {name} is no array: {error}") from None
    if array.size == 0:
        return array.astype(kind)
    if array.dtype.kind not in "iu":
        raise InputError(f"the mesh of arrays: {name} is of the type {array.dtype}; whole numbers are expected")
    limits = numpy.iinfo(kind)
    for each in (array.min(), array.max()):
        if not limits.min <= each <= limits.max:
            raise InputError(f"the mesh of arrays: {name} has the number {each}; "
                             f"{limits.min} to {limits.max} can be counted")
    return array.astype(kind, copy=False)


@dataclass
class Mesh:
    """Points and cells, as VTK has them, with regions and patches. SI units.

    Triangles and quadrilaterals among the cells tell the patches of the boundary by their numbers; 0 stands for none.
    Without such numbers the patches are xmin, xmax ... zmax, as far as the mesh has faces in these planes of its bounding
    box.

    Attributes:
        points: (n_points, 3), position [m].
        connectivity: points of all cells, one cell after the other.
        offsets: (n_cells,), where each cell ends in `connectivity`.
        types: (n_cells,), VTK's numbers: 10 tetrahedron, 12 hexahedron, 13 wedge, 14 pyramid, 5 triangle, 9 quadrilateral.
        numbers: (n_cells,), whole numbers of regions and, of triangles and quadrilaterals, of patches; None: the region
            is "body".
        regions, patches: names of the numbers; others are called region_<number> and patch_<number>.
    """

    points: NDArray[numpy.float64]
    connectivity: NDArray[numpy.int64]
    offsets: NDArray[numpy.int64]
    types: NDArray[numpy.int32]
    numbers: NDArray[numpy.int32] | None = None
    regions: dict[int, str] = field(default_factory=dict)
    patches: dict[int, str] = field(default_factory=dict)

    @classmethod
    def of_blocks(cls, points: ArrayLike, blocks: Mapping[str, ArrayLike], numbers: Mapping[str, ArrayLike] | None = None,
                  *, regions: Mapping[int, str] | None = None, patches: Mapping[int, str] | None = None) -> Mesh:
        """A mesh of blocks of like cells, by meshio's names: tetra, hexahedron, wedge, pyramid, triangle, quad.

        Args:
            points: (n_points, 3), position [m].
            blocks: name to the points of each cell, shape (n, points of a cell), in VTK's order.
            numbers: name to the number of each cell of the block, (n,); as of Mesh.
            regions, patches: names of the numbers.

        Raises InputError for names, shapes and types that are wrong.
        """
        connectivity, sizes, types, given = [], [], [], []
        for name, block in blocks.items():
            if name not in _kinds:
                raise InputError(f"the mesh of arrays: \"{name}\" is no kind of cells (allowed: {', '.join(_kinds)})")
            kind, n_points = _kinds[name]
            cells = _whole(f"the block \"{name}\"", block, numpy.int64)
            if cells.ndim != 2 or cells.shape[1] != n_points:
                raise InputError(f"the mesh of arrays: the block \"{name}\" has the shape {cells.shape}; "
                                 f"(n, {n_points}) is expected")
            connectivity.append(cells.ravel())
            sizes.append(numpy.full(len(cells), n_points))
            types.append(numpy.full(len(cells), kind, dtype=numpy.int32))
            if numbers is not None:
                if name not in numbers:
                    raise InputError(f"the mesh of arrays: there are no numbers of the block \"{name}\"")
                of_block = _whole(f"the numbers of the block \"{name}\"", numbers[name], numpy.int32)
                if of_block.shape != (len(cells),):
                    raise InputError(f"the mesh of arrays: the numbers of the block \"{name}\" have the shape "
                                     f"{of_block.shape}; ({len(cells)},) is expected, one for each cell")
                given.append(of_block)
        if not sizes:
            raise InputError("the mesh of arrays: it has no cells")
        return cls(numpy.asarray(points, dtype=float), numpy.concatenate(connectivity),
                   numpy.cumsum(numpy.concatenate(sizes)), numpy.concatenate(types),
                   numpy.concatenate(given) if numbers is not None else None, dict(regions or {}), dict(patches or {}))

    def parts(self) -> tuple[Any, ...]:
        """As the extension takes it. Raises InputError for arrays that are not of whole numbers."""
        numbers = None if self.numbers is None else _whole("numbers", self.numbers, numpy.int32)
        return (self.points, _whole("connectivity", self.connectivity, numpy.int64),
                _whole("offsets", self.offsets, numpy.int64), _whole("types", self.types, numpy.int32), numbers,
                self.regions, self.patches)
