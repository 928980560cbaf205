"""Files of results as tables of pandas, with the units of their columns, and as dicts."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy

from .errors import MissingResult

if TYPE_CHECKING:
    import pandas

_units = {"m": "m", "N": "N", "J": "J", "Pa": "Pa", "m2": "m^2", "m3": "m^3", "deg": "degree", "s": "s", "Hz": "Hz",
          "K": "K", "per_m": "1/m", "N_per_m": "N/m", "J_per_m2": "J/m^2", "J_per_m3": "J/m^3", "Pa_per_m": "Pa/m",
          "m_per_s": "m/s", "m_per_s2": "m/s^2"}


def unit_in(name: str) -> str:
    """Unit at the end of a name, as "N" of "force_x_N" and "J/m^2" of "toughness_J_per_m2"; "" if there is none."""
    for at in (m.end() for m in re.finditer("_", name)):
        if name[at:] in _units:
            return _units[name[at:]]
    return ""


def read_table(path: Path) -> pandas.DataFrame:
    """A CSV file of pfdm as a table; attrs["units"] has the unit of each column whose name ends with one."""
    import pandas

    return _with_units(pandas.read_csv(path, comment="#", float_precision="round_trip"))


def table_of(columns: Mapping[str, numpy.ndarray]) -> pandas.DataFrame:
    """Columns as a table, with units like those of read_table()."""
    import pandas

    return _with_units(pandas.DataFrame(columns))


def _with_units(table: pandas.DataFrame) -> pandas.DataFrame:
    from .named_columns import NamedColumns

    table = NamedColumns(table)
    table.attrs["units"] = {str(name): unit_in(str(name)) for name in table.columns if unit_in(str(name))}
    return table


def read_json(path: Path, command: str) -> dict[str, Any]:
    """A file of results; raises MissingResult, which names the command that makes it, where there is none."""
    if not path.exists():
        raise MissingResult(f"{path} is not there: {command} writes it")
    return json.loads(path.read_text(errors="replace"))
