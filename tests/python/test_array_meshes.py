"""Tests of meshes of arrays for fracture runs in process: what they take, and what they refuse."""

import dataclasses
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

    def polyhedral_bar(self):
        """Its hexahedra by their faces."""
        points, cells, numbers = bar_arrays()
        sides = [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
        return points, [[cell[side] for side in sides] for cell in cells], numbers

    def test_of_polyhedra_are_those_of_their_faces(self):
        points, cells, numbers = self.polyhedral_bar()
        half = len(cells) // 2
        mesh = pfdm.Mesh.of_blocks(points, {"polyhedron": cells[:half], "polyhedron8": cells[half:]},
                                   {"polyhedron": numbers[:half], "polyhedron8": numbers[half:]},
                                   regions={1: "bar", 2: "weak"})
        self.assertEqual(set(mesh.types), {42})
        self.assertEqual(len(mesh.connectivity), 8 * len(cells))
        run, theirs = pfdm.FractureRun(bar(), mesh), pfdm.FractureRun(bar(), self.mesh())
        numpy.testing.assert_allclose(run.cell_volumes, theirs.cell_volumes, rtol=1e-12)
        a, b = run.step(), theirs.step()
        self.assertAlmostEqual(a["force_x_N"] / b["force_x_N"], 1.0, delta=1e-9)

    def test_of_polyhedra_are_those_of_the_file_that_has_them(self):
        case = pfdm.Case(shipped / "glass_bead_quick", {"mesh.cells": "polyhedra", "mesh.size_far": "400 um",
                                                        "mesh.layers.count": 1, "mesh.particles[0].surface_size.ell": 1.5,
                                                        "fracture.length": "100 um"})
        grid = case.run(self.folder / "r", max_steps=1).mesh
        self.assertEqual(set(grid.types), {42})
        text = (shipped / "glass_bead_quick/case.toml").read_text()
        rest = text[text.index("[materials.sylgard]") : text.index("[experiment]")]
        names = "".join(f'\n"{number}" = "{name}"' for name, number in grid.regions().items())
        (self.folder / "case.toml").write_text(
            f'kind = "fracture"\ntitle = "Of a file"\n[mesh]\ngenerator = "vtk"\nfile = "r/mesh.vtu"\nlength_unit = "m"\n'
            f'region_array = "material"\n[mesh.region_names]{names}\n{rest}')
        of_file = pfdm.Case(self.folder, {"fracture.length": "100 um"})
        mesh = pfdm.Mesh(grid.points, grid.connectivity, grid.offsets, grid.types, grid.cell_data["material"],
                         {number: name for name, number in grid.regions().items()}, faces=grid.faces)
        ours, theirs = pfdm.FractureRun(of_file, mesh), pfdm.FractureRun(of_file)
        self.assertEqual(ours.cell_volumes.tobytes(), theirs.cell_volumes.tobytes())
        self.assertEqual([ours.step() for _ in range(3)], [theirs.step() for _ in range(3)])
        self.assertGreater(ours.damage.max(), 0.0)
        self.assertAlmostEqual(ours.cell_volumes.sum(), grid.cell_data["volume"].sum(), delta=1e-20)

    def test_of_polyhedra_that_do_not_close_are_refused(self):
        points, cells, numbers = self.polyhedral_bar()
        good = pfdm.Mesh.of_blocks(points, {"polyhedron": cells})

        def changed(**values):
            return dataclasses.replace(good, **values)

        def with_number(at, number):
            faces = good.faces.copy()
            faces[at] = number
            return changed(faces=faces)

        for mesh, said in [(changed(faces=None), "need the array faces"),
                           (changed(faces=good.faces[:-1]), "faces ends within those of cell 41"),
                           (changed(faces=[*good.faces, 4]), "those of its polyhedra .* end after 1302"),
                           (changed(faces=good.faces.reshape(2, -1)), r"faces has the shape \(2, 651\)"),
                           (changed(faces=good.faces + 0.5), "faces is of the type float64"),
                           (with_number(0, 3), r"faces\[0\] is 3, the number of faces of cell 0"),
                           (with_number(0, 10**12), r"faces\[0\] is 1000000000000"),
                           (with_number(1, -1), r"faces\[1\] is -1, the number of points of a face of cell 0"),
                           (with_number(2, 1000), r"faces\[2\] is 1000; there are 132 points"),
                           (with_number(2, 131), "the faces of cell 0 do not have the points"),
                           (with_number(2, good.faces[3]), "polyhedron 0")]:
            with self.assertRaisesRegex(pfdm.InputError, said):
                pfdm.FractureRun(bar(), mesh)
        for block, said in [([cells[0], [[0, 1]]], r"face 0 of cell 1 of the block \"polyhedron\" has the shape \(2,\)"),
                            ([[[0, 1, 2.5]]], "face 0 of cell 0 .* is of the type float64"),
                            (cells, "have the shape")]:
            with self.assertRaisesRegex(pfdm.InputError, said):
                pfdm.Mesh.of_blocks(points, {"polyhedron": block}, {"polyhedron": numbers[:-1]})

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
