"""What tests of the module pfdm share. Without NumPy or pandas they are skipped."""

import pathlib
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401
    import pandas  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import pfdm

shipped = pathlib.Path(__file__).parents[2] / "cases"


def bar(**values):
    """The shipped bar, coarser."""
    coarse = {"mesh.x[0].cells": 21, "fracture.length": "12 mm", "loading.maximum_increment": 0.1}
    return pfdm.Case(shipped / "bar_at2", {**coarse, **values})


class Folder(unittest.TestCase):
    """A folder for each test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
