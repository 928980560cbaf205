"""The compiled extension _pfdm, in which pieces of the program run in this process."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .errors import Error
from .toml_text import toml_piece

if TYPE_CHECKING:
    from types import ModuleType

    from .case import Case


@cache
def extension() -> ModuleType:
    """The module _pfdm, with a thread for each core at first. Raises Error, which says how to get it."""
    try:
        import _pfdm
    except ImportError as error:
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        raise Error(
            f"this needs the compiled extension of pfdm, which was not found for Python {version} ({error}). "
            "./pfdm python SCRIPT builds it and finds it, and Debian's package has that of the Python that it was built "
            "for. By hand: install python3-dev and pybind11-dev, run cmake again, build the target pfdm_python, and put the "
            "folder of _pfdm.*.so on PYTHONPATH"
        ) from None
    _pfdm.set_threads(len(os.sched_getaffinity(0)))
    return _pfdm


def set_threads(n: int) -> None:
    """Number of threads of all later computations in this process, at least 1; at first one for each core.

    Results do not depend on it. Of several runs at once one has the threads at a time, the others their own thread. A
    process that os.fork() makes begins with one: call this there for more. Do not fork while another thread of the script
    computes or opens a case: what that thread has locked stays so in the child. multiprocessing has the start method
    "spawn" for it.

    Raises Error without the compiled extension.
    """
    extension().set_threads(n)


def toml_of(tables: Mapping[str, Mapping[str, Any] | None]) -> str:
    """Tables as a text of TOML; those that are None or empty are left out."""
    return "".join(f"{name} = {toml_piece(table)}\n" for name, table in tables.items() if table)


def place_of(case: Case) -> tuple[Path, list[str]]:
    """A case as the extension reads it: its file, and its other values as words of --set."""
    return case.file, [f"{key}={toml_piece(value)}" for key, value in case.values.items()]
