"""Tests of meshes of arrays for fracture runs in process: what they take, and what they refuse."""

import unittest

from in_process import rows_of
from shared import Folder, bar, shipped

import numpy
import pfdm

def bar_arrays(n=21):
    """The bar's mesh as arrays: n hexahedra along x, two across; the middle cells are weak."""
    x, y, z = numpy.meshgrid(numpy.linspace(0.0, 0.1, n + 1), numpy.linspace(-5e-4, 5e-4, 3), [-5e-4, 5e-4], indexing="ij")
    points = numpy.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    at = numpy.arange(len(points)).reshape(n + 1, 3, 2)
    low = [at[:-1, :-1, :-1], at[1:, :-1, :-1], at[1:, 1:, :-1], at[:-1, 1:, :-1]]
    high = [at[:-1, :-1, 1:], at[1:, :-1, 1:], at[1:, 1:, 1:], at[:-1, 1:, 1:]]
    cells = numpy.stack([each.ravel() for each in low + high], axis=1)
    numbers = numpy.where(numpy.arange(len(cells)) // 2 == n // 2, 2, 1)
    return points, cells, numbers


class Meshes(Folder):
    def mesh(self):
        points, cells, numbers = bar_arrays()
        return pfdm.Mesh.of_blocks(points, {"hexahedron": cells}, {"hexahedron": numbers}, regions={1: "bar", 2: "weak"})

    def test_of_arrays_take_the_place_of_the_cases(self):
        ours, theirs = rows_of(pfdm.FractureRun(bar(), self.mesh())), rows_of(pfdm.FractureRun(bar()))
        self.assertEqual(len(ours), len(theirs))
        for a, b in zip(ours, theirs, strict=True):
            self.assertAlmostEqual(a["force_x_N"], b["force_x_N"], delta=1e-6 * (1e-6 + abs(b["force_x_N"])))

    def mesh_with_ends(self, numbers_of_ends, **patches):
        """Quadrilaterals at both ends have these numbers."""
        points, cells, numbers = bar_arrays()
        quads = [numpy.flatnonzero(points[:, 0] == x).reshape(3, 2) for x in (0.0, points[:, 0].max())]
        faces = numpy.array([[q[i, 0], q[i + 1, 0], q[i + 1, 1], q[i, 1]] for q in quads for i in range(2)])
        return pfdm.Mesh.of_blocks(points, {"hexahedron": cells, "quad": faces},
                                   {"hexahedron": numbers, "quad": numpy.repeat(numbers_of_ends, 2)},
                                   regions={1: "bar", 2: "weak"}, **patches)

    def own_case(self, left, right, body="steel", weak="notch"):
        """The bar between two patches, its sides free and its ends held, by names that [mesh] does not have."""
        text = (shipped / "bar_at2/case.toml").read_text()
        sides = text.index("[[boundary]]\npatches"), text.index("[loading]")
        text = text[: sides[0]] + text[sides[1] :]
        mesh, rest = text.split("[materials.concrete]")
        rest = rest.replace('"free", "free"]', '"0 mm", "0 mm"]')  # the ends are held
        rest = rest.replace("xmin", left).replace("xmax", right).replace('["bar", "weak"]', f'["{body}", "{weak}"]')
        rest = rest.replace("[regions.weak]", f"[regions.{weak}]")
        (self.folder / "case.toml").write_text(f"{mesh}[materials.concrete]{rest}")
        return pfdm.Case(self.folder, {"fracture.length": "12 mm"})

    def test_of_arrays_name_patches_by_faces(self):
        with self.assertRaisesRegex(pfdm.InputError, "ymin"):  # all else is "walls"
            pfdm.FractureRun(bar(), self.mesh_with_ends([7, 8], patches={7: "xmin", 8: "xmax"}))

    def test_of_arrays_have_names_of_their_own(self):
        mesh = self.mesh_with_ends([7, 8], patches={7: "left", 8: "right"})
        with self.assertRaisesRegex(pfdm.InputError, "left, right, walls"):  # xmin is not among them
            pfdm.FractureRun(bar(), mesh)
        mesh.regions = {1: "steel", 2: "notch"}
        case = self.own_case("left", "right")
        run = pfdm.FractureRun(case, mesh)
        self.assertEqual(run.patches, ["left", "right", "walls"])
        self.assertGreater(run.step()["force_x_N"], 0.0)
        with self.assertRaisesRegex(pfdm.InputError, "case.toml"):
            pfdm.FractureRun(case)

    def test_of_arrays_call_faces_without_names_as_gmsh_does(self):
        run = pfdm.FractureRun(self.own_case("patch_7", "patch_8", "bar", "weak"), self.mesh_with_ends([7, 8]))
        self.assertEqual(run.patches, ["patch_7", "patch_8", "walls"])
        run = pfdm.FractureRun(bar(), self.mesh_with_ends([0, 0]))
        self.assertEqual(run.patches[:2], ["xmin", "xmax"])

    def test_of_arrays_that_do_not_fit_are_refused(self):
        for change, said in [({"points": numpy.zeros((3, 2))}, r"\(3, 2\)"),
                             ({"types": numpy.zeros(3, int)}, "offsets has the shape"),
                             ({"connectivity": self.mesh().connectivity + 1000}, "there are"),
                             ({"offsets": self.mesh().offsets[::-1]}, "must be above"),
                             ({"numbers": numpy.zeros(3, int)}, "numbers has the shape"),
                             ({"numbers": numpy.zeros(42)}, "numbers is of the type float64"),
                             ({"connectivity": self.mesh().connectivity + 0.5}, "connectivity is of the type")]:
            mesh = self.mesh()
            for name, value in change.items():
                setattr(mesh, name, value)
            with self.assertRaisesRegex(pfdm.InputError, said):
                pfdm.FractureRun(bar(), mesh)
        with self.assertRaisesRegex(pfdm.InputError, "allowed: tetra"):
            pfdm.Mesh.of_blocks(numpy.zeros((3, 3)), {"tetra10": numpy.zeros((1, 10))})

    def test_of_blocks_that_do_not_fit_are_refused(self):
        points, cells, numbers = bar_arrays(4)
        for block, of_block, said in [(cells, numbers[:-1], r"the shape \(7,\); \(8,\)"),
                                      (cells, numbers.reshape(2, 4), r"the shape \(2, 4\)"),
                                      (cells, numbers + 0.5, "of the type float64"),
                                      (cells, numbers + 2**40, "to 2147483647"),
                                      (cells, ["one"] * 8, "whole numbers are expected"),
                                      (cells + 0.2, numbers, "\"hexahedron\" is of the type float64"),
                                      ([[0, 1], [2]], numbers, "\"hexahedron\" is no array")]:
            with self.assertRaisesRegex(pfdm.InputError, said):
                pfdm.Mesh.of_blocks(points, {"hexahedron": block}, {"hexahedron": of_block})
        # Too many numbers of one block do not make up for too few of another.
        with self.assertRaisesRegex(pfdm.InputError, "\"wedge\" have the shape"):
            pfdm.Mesh.of_blocks(points, {"wedge": cells[:, :6], "hexahedron": cells},
                                {"wedge": numbers[:-1], "hexahedron": [*numbers, 1]})


if __name__ == "__main__":
    unittest.main()
