"""Cases written in Python, and grids of results as those of VTK."""

import os
import re
import subprocess
import unittest

import numpy
from shared import Folder, bar, shipped

import pfdm


def block_with(page, words):
    """The block of code of a page that has the words, without its indentation."""
    blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", page.read_text(encoding="utf-8"), re.MULTILINE)
    (found,) = [block for block in blocks if words in block]
    return re.sub("^    ", "", found, flags=re.MULTILINE)


class NewCases(Folder):
    def test_of_the_table_of_another_run_as_it(self):
        case = bar(**{"loading.end": 0.6})
        made = pfdm.new_case(self.folder / "made", case.table)
        self.assertEqual(made.table, case.table)
        for one, name in ((case, "a"), (made, "b")):
            one.run(self.folder / name, threads=1)
        self.assertEqual(*((self.folder / name / "force_displacement.csv").read_bytes() for name in "ab"))

    def test_have_names_and_texts_of_any_kind(self):
        table = {"kind": "fracture", "title": 'a "bar"\\ µ', "materials": {"a.b c": {"values": numpy.arange(2), "flag": True}},
                 "boundary": [{"patch": "x", "displacement": ("0 m", 1e-7)}, {"x y": {}}], "mesh": {"deep": {"er": {}}}}
        said = pfdm.new_case(self.folder / "made", table).table
        self.assertEqual(said["title"], table["title"])
        self.assertEqual(said["materials"], {"a.b c": {"values": [0, 1], "flag": True}})
        self.assertEqual(said["boundary"], [{"patch": "x", "displacement": ["0 m", 1e-7]}, {"x y": {}}])
        self.assertEqual(said["mesh"], {"deep": {"er": {}}})

    def test_do_not_go_where_something_is(self):
        (self.folder / "other.txt").write_text("mine")
        with self.assertRaisesRegex(pfdm.InputError, "something already"):
            pfdm.new_case(self.folder, {"kind": "fracture"})
        with self.assertRaisesRegex(TypeError, "object"):
            pfdm.new_case(self.folder / "made", {"kind": object()})
        self.assertFalse((self.folder / "made").exists())

    def test_that_are_wrong_say_so_when_they_are_checked(self):
        made = pfdm.new_case(self.folder / "made", {**bar().table, "boundary": []})
        with self.assertRaisesRegex(pfdm.InputError, "boundary"):
            made.check()

    def test_of_the_documentation_break(self):
        names = {}
        text = block_with(shipped / "python/README.md", "pfdm.new_case(").replace('"my_', f'"{self.folder}/my_')
        exec(text, names)
        self.assertEqual(names["run"].status, "complete")
        self.assertGreater(names["run"].frames[-1].damage.max(), 0.99)


class TablesOfCases(unittest.TestCase):
    def test_have_the_values_that_were_set(self):
        case = bar(**{"solver.linear": "direct", "boundary[1].displacement[0]": "2 mm"})
        table = case.table
        self.assertEqual(table["solver"]["linear"], "direct")
        self.assertEqual(table["boundary"][1]["displacement"], ["2 mm", "free", "free"])
        table["boundary"].clear()
        self.assertEqual(case["boundary[0].patch"], "xmin")
        for key in ("boundary[9].patch", "title.length", "boundary.patch"):
            with self.assertRaisesRegex(KeyError, re.escape(key)):
                bar(**{key: 1}).table


class GridsOfVtk(Folder):
    def read_by_vtk(self, path):
        try:
            from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
        except ImportError:
            self.skipTest("without VTK")
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        return reader.GetOutput()

    def expect_same_cells(self, made, read):
        self.assertEqual(made.GetNumberOfCells(), read.GetNumberOfCells())
        for i in range(made.GetNumberOfCells()):
            one, other = made.GetCell(i), read.GetCell(i)
            self.assertEqual(one.GetCellType(), other.GetCellType())
            self.assertEqual([one.GetPointId(k) for k in range(one.GetNumberOfPoints())],
                             [other.GetPointId(k) for k in range(other.GetNumberOfPoints())])
            self.assertEqual(one.GetNumberOfFaces(), other.GetNumberOfFaces())
            self.assertEqual(one.GetBounds(), other.GetBounds())

    def test_are_those_that_vtk_reads_and_share_the_arrays(self):
        frame = bar().run(self.folder / "r").frames[-1]
        read = self.read_by_vtk(frame.path)
        from vtkmodules.util.numpy_support import vtk_to_numpy
        grid = frame.grid
        made = grid.to_vtk()
        self.expect_same_cells(made, read)
        for name, values in grid.cell_data.items():
            shown = vtk_to_numpy(made.GetCellData().GetArray(name))
            numpy.testing.assert_array_equal(shown, values)
            self.assertTrue(numpy.shares_memory(shown, values))

    def test_have_polyhedra(self):
        subprocess.run([os.environ["PFDM_PROGRAM"], "mesh", shipped / "glass_bead_quick", "--output", self.folder, "--set",
                        "mesh.cells=polyhedra", "--set", "mesh.particles[0].surface_size.ell=6.0", "--set",
                        "mesh.layers.count=1", "--set", "mesh.layers.thickness=40 um"], check=True, capture_output=True)
        grid = pfdm.open(self.folder).mesh
        self.assertIn(42, grid.types)
        self.expect_same_cells(grid.to_vtk(), self.read_by_vtk(grid.path))

    def test_are_of_each_frame_of_one_file(self):
        try:
            import h5py  # noqa: F401
            import vtkmodules.util.numpy_support  # noqa: F401
        except ImportError as error:
            self.skipTest(str(error))
        frames = bar(**{"output.frames_every": 2, "output.format": "vtkhdf"}).run(self.folder / "r").frames
        most = [frame.grid.to_vtk().GetCellData().GetArray("damage").GetRange()[1] for frame in frames]
        self.assertEqual(most, [float(frame.damage.max()) for frame in frames])
        self.assertLess(most[1], most[-1])


if __name__ == "__main__":
    unittest.main()
