"""A case written in Python."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .case import Case
from .errors import InputError
from .toml_text import toml_text


def new_case(directory: str | Path, table: Mapping[str, Any]) -> Case:
    """A new case, whose mesh, materials and boundary conditions are dicts and lists of Python.

        pfdm.new_case("bar", {"kind": "fracture", "materials": {"steel": {"regions": ["body"], ...}},
                              "boundary": [{"patch": "xmin", "displacement": ["0 mm", "free", "free"]}, ...], ...})

    Args:
        directory: a new or empty directory; case.toml is written there.
        table: what case.toml says: a dict for each table, a list of dicts for each list of tables. Values are those of
            Case: texts with units, quantities of pint, numbers, arrays. Case.table is such a dict, of another case.
            Files are named from the directory, or by their absolute paths.

    Returns:
        The case. Whether its values are right is told by check(), run() and fit().

    Raises:
        InputError: there is something in the directory.
        TypeError: a value is nothing that case.toml can say.
    """
    folder = Path(directory)
    text = toml_text(table)
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError(f"{folder}: there is something already: a new case needs a new or empty directory")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "case.toml").write_text(text, encoding="utf-8")
    return Case(folder)
