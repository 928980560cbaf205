"""Tests of what pip makes of the checkout: with the compiled extension where it is built, without it elsewhere."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import unittest
import zipfile

for needed in ("setuptools", "wheel"):
    if importlib.util.find_spec(needed) is None:
        print(f"skipped: no {needed}")
        sys.exit(77)

root = pathlib.Path(__file__).parents[2]


class Packages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.checkout = self.folder / "checkout"
        shutil.copytree(root / "cases/python", self.checkout / "cases/python", ignore=shutil.ignore_patterns("__pycache__"))
        for name in ("setup.py", "pyproject.toml", "MANIFEST.in"):
            shutil.copy(root / name, self.checkout)

    def build_extension(self):
        place = self.checkout / "build/release/cases/python/extension"
        place.mkdir(parents=True)
        (place / ("_pfdm" + sysconfig.get_config_var("EXT_SUFFIX"))).touch()

    def make(self, what, place):
        """Of the checkout at `place`, as pip has it made; "sdist" or "wheel"."""
        script = f"from setuptools import build_meta; print(build_meta.build_{what}({str(self.folder)!r}))"
        made = subprocess.run([sys.executable, "-c", script], cwd=place, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": ""})
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        return self.folder / made.stdout.splitlines()[-1]

    def extension_in(self, wheel):
        with zipfile.ZipFile(wheel) as files:
            self.assertIn("pfdm/case.py", files.namelist())
            return [name for name in files.namelist() if name.startswith("_pfdm")]

    def unpacked_sdist(self):
        with tarfile.open(self.make("sdist", self.checkout)) as files:
            files.extractall(self.folder / "unpacked")
        return next((self.folder / "unpacked").iterdir())

    def test_have_no_stub_alone(self):
        wheel = self.make("wheel", self.checkout)
        self.assertEqual(self.extension_in(wheel), [])
        self.assertIn("-none-any", wheel.name)

    def test_have_the_extension_where_it_is_built(self):
        self.build_extension()
        wheel = self.make("wheel", self.checkout)
        self.assertEqual(len(self.extension_in(wheel)), 2)
        self.assertNotIn("-none-any", wheel.name)

    def test_are_made_of_source_distributions(self):
        place = self.unpacked_sdist()
        self.assertTrue((place / "cases/python/_pfdm.pyi").exists())
        self.assertEqual(self.extension_in(self.make("wheel", place)), [])


if __name__ == "__main__":
    unittest.main()
