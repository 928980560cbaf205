"""What tests of runs in process share. Without the compiled extension they are skipped."""

import sys

from shared import shipped

try:
    import _pfdm  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import pfdm


def long_bar(**values):
    """The shipped bar of so many cells that loops over them are cut into pieces for several threads."""
    return pfdm.Case(shipped / "bar_at2", {"mesh.x[0].cells": 3001, "fracture.length": "12 mm", **values})


def rows_of(run):
    return [run.row, *run]
