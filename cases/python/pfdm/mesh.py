"""Meshes of arrays, for runs in process."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, cast

import numpy
from numpy.typing import ArrayLike, NDArray

from .errors import InputError

# Names of meshio, VTK's number and the points of each. Polyhedra have any number of points.
_kinds = {"tetra": (10, 4), "hexahedron": (12, 8), "wedge": (13, 6), "pyramid": (14, 5), "triangle": (5, 3), "quad": (9, 4)}

_polyhedron = 42


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


def _face_stream(name: str, cell: Iterable[ArrayLike]) -> list[int]:
    """[n_faces, n_points, p ..., n_points, p ...] of a cell, which messages call `name`."""
    faces = [_whole(f"face {k} of {name}", face, numpy.int64) for k, face in enumerate(cell)]
    stream = [len(faces)]
    for k, face in enumerate(faces):
        if face.ndim != 1 or len(face) < 3:
            raise InputError(f"the mesh of arrays: face {k} of {name} has the shape {face.shape}; three points at least "
                             "are expected, one after the other")
        stream += [len(face), *face.tolist()]
    return stream


def _polyhedra(name: str, block: Iterable[Iterable[ArrayLike]]) -> tuple[list[int], list[int], list[int]]:
    """Points of all cells, how many each has, and their faces."""
    connectivity, sizes, faces = [], [], []
    for i, cell in enumerate(block):
        stream = _face_stream(f"cell {i} of the block \"{name}\"", cell)
        points = _points_of(stream)
        connectivity += points
        sizes.append(len(points))
        faces += stream
    return connectivity, sizes, faces


def _points_of(stream: list[int]) -> list[int]:
    """The points of a polyhedron, each once."""
    points, at = set(), 1
    while at < len(stream):
        points.update(stream[at + 1 : at + 1 + stream[at]])
        at += 1 + stream[at]
    return sorted(points)


def _like_cells(name: str, block: ArrayLike) -> tuple[int, NDArray[numpy.int64]]:
    """VTK's number of their type, and their points, (n, points of a cell)."""
    if name not in _kinds:
        raise InputError(f"the mesh of arrays: \"{name}\" is no kind of cells (allowed: {', '.join(_kinds)}, polyhedron)")
    kind, n_points = _kinds[name]
    cells = _whole(f"the block \"{name}\"", block, numpy.int64)
    if cells.ndim != 2 or cells.shape[1] != n_points:
        raise InputError(f"the mesh of arrays: the block \"{name}\" has the shape {cells.shape}; (n, {n_points}) is expected")
    return kind, cells


def _numbers_of(name: str, numbers: Mapping[str, ArrayLike], n_cells: int) -> NDArray[numpy.int32]:
    if name not in numbers:
        raise InputError(f"the mesh of arrays: there are no numbers of the block \"{name}\"")
    of_block = _whole(f"the numbers of the block \"{name}\"", numbers[name], numpy.int32)
    if of_block.shape != (n_cells,):
        raise InputError(f"the mesh of arrays: the numbers of the block \"{name}\" have the shape {of_block.shape}; "
                         f"({n_cells},) is expected, one for each cell")
    return of_block


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
        types: (n_cells,), VTK's numbers: 10 tetrahedron, 12 hexahedron, 13 wedge, 14 pyramid, 42 polyhedron, 5 triangle,
            9 quadrilateral.
        numbers: (n_cells,), whole numbers of regions and, of triangles and quadrilaterals, of patches; None: the region
            is "body".
        regions, patches: names of the numbers; others are called region_<number> and patch_<number>.
        faces: of each polyhedron in turn the number of its faces, then of each face the number of its points and these, as
            VTK's faces are; None without polyhedra. `connectivity` has each point of a polyhedron once.
    """

    points: NDArray[numpy.float64]
    connectivity: NDArray[numpy.int64]
    offsets: NDArray[numpy.int64]
    types: NDArray[numpy.int32]
    numbers: NDArray[numpy.int32] | None = None
    regions: dict[int, str] = field(default_factory=dict)
    patches: dict[int, str] = field(default_factory=dict)
    faces: NDArray[numpy.int64] | None = None

    @classmethod
    def of_blocks(cls, points: ArrayLike, blocks: Mapping[str, ArrayLike], numbers: Mapping[str, ArrayLike] | None = None,
                  *, regions: Mapping[int, str] | None = None, patches: Mapping[int, str] | None = None) -> Mesh:
        """A mesh of blocks of like cells, by meshio's names: tetra, hexahedron, wedge, pyramid, triangle, quad, and
        polyhedron, also with a number of points as in polyhedron8.

        Args:
            points: (n_points, 3), position [m].
            blocks: name to the points of each cell, shape (n, points of a cell), in VTK's order; of polyhedra to a list of
                cells, each a list of faces, each a list of points around it.
            numbers: name to the number of each cell of the block, (n,); as of Mesh.
            regions, patches: names of the numbers.

        Raises InputError for names, shapes and types that are wrong.
        """
        connectivity, sizes, types, given = [], [], [], []
        faces: list[int] = []
        for name, block in blocks.items():
            if re.fullmatch(r"polyhedron\d*", name):
                kind = _polyhedron
                cells, of_each, of_block = _polyhedra(name, cast(Iterable[Iterable[ArrayLike]], block))
                faces += of_block
            else:
                kind, like = _like_cells(name, block)
                cells, of_each = like.ravel(), numpy.full(len(like), like.shape[1])
            connectivity.append(numpy.asarray(cells, dtype=numpy.int64))
            sizes.append(numpy.asarray(of_each, dtype=numpy.int64))
            types.append(numpy.full(len(of_each), kind, dtype=numpy.int32))
            if numbers is not None:
                given.append(_numbers_of(name, numbers, len(of_each)))
        if not sizes:
            raise InputError("the mesh of arrays: it has no cells")
        return cls(numpy.asarray(points, dtype=float), numpy.concatenate(connectivity),
                   numpy.cumsum(numpy.concatenate(sizes)), numpy.concatenate(types),
                   numpy.concatenate(given) if numbers is not None else None, dict(regions or {}), dict(patches or {}),
                   numpy.array(faces, dtype=numpy.int64) if faces else None)

    def parts(self) -> tuple[Any, ...]:
        """As the extension takes it. Raises InputError for arrays that are not of whole numbers."""
        numbers = None if self.numbers is None else _whole("numbers", self.numbers, numpy.int32)
        return (self.points, _whole("connectivity", self.connectivity, numpy.int64),
                _whole("offsets", self.offsets, numpy.int64), _whole("types", self.types, numpy.int32), numbers,
                self.regions, self.patches,
                None if self.faces is None else _whole("faces", self.faces, numpy.int64))
