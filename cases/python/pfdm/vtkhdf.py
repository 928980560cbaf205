"""Frames out of the one file of a run, fields.vtkhdf, read by h5py (Debian's python3-h5py)."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy

from .vtu import Grid


def _opened(path: Path) -> Any:
    try:
        import h5py
    except ImportError:
        raise ImportError(f"{path}: h5py reads it, which is not installed (Debian: python3-h5py)") from None
    return h5py.File(path, "r")


def steps_in(path: Path) -> list[tuple[int, float]]:
    """Number of the load step and time of each frame.

    Raises OSError if the file cannot be read, ValueError if pfdm has not written it.
    """
    with _opened(path) as file:
        try:
            names = bytes(file["pfdm/names"][:]).decode().splitlines()
            times = file["VTKHDF/Steps/Values"][:]
        except KeyError as error:
            raise ValueError(f"{path}: pfdm has not written it: {error}") from None
    return [(int((re.findall(r"\d+", name) or ["0"])[-1]), float(time)) for name, time in zip(names, times, strict=True)]


def read_frame(path: Path, number: int) -> Grid:
    """The grid of a frame with its data, as read_vtu() gives that of a .vtu file; `number` from 0.

    Raises OSError if the file cannot be read, ValueError if pfdm has not written it.
    """
    with _opened(path) as file:
        try:
            return _frame(file["VTKHDF"], number, path)
        except KeyError as error:
            raise ValueError(f"{path}: pfdm has not written it: {error}") from None


def _text(data: Any, name: str) -> str:
    """The text of an attribute; empty without it."""
    text = data.attrs.get(name, "")
    return text.decode() if isinstance(text, bytes) else str(text)


def _frame(root: Any, k: int, path: Path) -> Grid:
    steps = root["Steps"]
    part = steps["PartOffsets"][k]
    n_points, n_cells, n_corners = (int(root[name][part])
                                    for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"))
    first_point, first_cell, first_corner = (
        int(steps["PointOffsets"][k]), int(steps["CellOffsets"][k, 0]), int(steps["ConnectivityIdOffsets"][k, 0]))
    first_end = first_cell + int(part) + 1  # each part has one offset more than cells
    units: dict[str, str] = {}

    def arrays(group: str, n: int) -> dict[str, numpy.ndarray]:
        found = {}
        for in_file, data in root[group].items() if group in root else ():
            first = int(steps[f"{group}Offsets"][in_file][k])
            name = _text(data, "name") or in_file  # names of HDF5 have no "/"
            found[name] = data[first: first + n]
            if unit := _text(data, "units"):
                units[name] = unit
        return found

    return Grid(points=root["Points"][first_point: first_point + n_points],
                connectivity=root["Connectivity"][first_corner: first_corner + n_corners],
                offsets=root["Offsets"][first_end: first_end + n_cells],
                types=root["Types"][first_cell: first_cell + n_cells], faces=None, face_offsets=None,
                point_data=arrays("PointData", n_points), cell_data=arrays("CellData", n_cells),
                field_data=arrays("FieldData", 1), units=units, path=path)
