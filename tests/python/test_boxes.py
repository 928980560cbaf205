"""Tests of boxes in process: composites along a path of mean strain, step by step, and the stiffness of linear ones."""

import json
import unittest

from in_process import rows_of
from shared import Folder, shipped

import numpy
import pfdm

path = """
[[interface]]
name = "bond"
between = ["block", "matrix"]
law = "linear"
strength = "2 MPa"
toughness = "10 J/m^2"
stiffness = "1e13 Pa/m"

[homogenization]
path = [{ strain_zz = "1 %" }, { strain_zz = "0.5 %" }]

[loading]
initial_increment = 0.2
maximum_increment = 0.2
"""


def box(folder, more="", **values):
    """Eight stiff cells in the middle of a soft box."""
    (folder / "case.toml").write_text(f"""
kind = "homogenize"
title = "A block in a box"

[mesh]
generator = "box_hexes"
x = [{{ length = "4 mm", cells = 4 }}]
y = [{{ length = "4 mm", cells = 4 }}]
z = [{{ length = "4 mm", cells = 4 }}]
region = "matrix"

[[mesh.regions]]
name = "block"
lower = ["1 mm", "1 mm", "1 mm"]
upper = ["3 mm", "3 mm", "3 mm"]

[materials.stiff]
regions = ["block"]
young_modulus = "70 GPa"
poisson_ratio = 0.2

[materials.soft]
regions = ["matrix"]
young_modulus = "1 GPa"
poisson_ratio = 0.4
{more}
""")
    return pfdm.Case(folder, values)


def arrays_of(run):
    """The mesh of its run as arrays."""
    numbers = numpy.isin(numpy.arange(64), run.cells_of("block")).astype(int)
    return pfdm.Mesh(run.points, run.connectivity, run.offsets, numpy.full(64, 12), numbers, {0: "matrix", 1: "block"})


class Glued(pfdm.OwnInterfaceLaw):
    def respond(self, separation, history, duration, strength, toughness):
        return pfdm.InterfaceResponse(1e13 * separation, 1e13 * numpy.eye(3), stored=5e12 * separation @ separation)


class Paths(Folder):
    def test_step_as_those_of_the_program_to_the_last_bit(self):
        case = box(self.folder, path)
        theirs = case.run(self.folder / "r", threads=1)
        run = pfdm.FractureRun(case)
        rows = rows_of(run)
        self.assertEqual(rows, theirs.table("stress_strain.csv").to_dict("records"))
        self.assertEqual(len(rows), 11)
        self.assertGreater(rows[-1]["debonded_area_bond_m2"], 0.0)
        self.assertLess(rows[-1]["stress_zz_Pa"], rows[5]["stress_zz_Pa"])
        self.assertEqual(run.displacement.tobytes(), theirs.frames[-1].displacement.tobytes())

    def test_take_laws_meshes_and_states(self):
        case = box(self.folder, path)
        run = pfdm.FractureRun(case, arrays_of(pfdm.FractureRun(case)), interfaces={"bond": Glued()})
        first = run.step()
        self.assertAlmostEqual(first["strain_zz"], 0.002, delta=1e-12)
        state, second = run.state, run.step()
        self.assertAlmostEqual(second["stress_zz_Pa"] / first["stress_zz_Pa"], 2.0, delta=1e-4)
        self.assertEqual(second["debonded_area_bond_m2"], 0.0)
        run.restore(state)
        self.assertEqual(run.step(), second)

    def test_that_are_wrong_say_file_line_and_key(self):
        with self.assertRaisesRegex(pfdm.InputError, "strain has to be between") as caught:
            pfdm.FractureRun(box(self.folder, path, **{"homogenization.path[0].strain_zz": "200 %"}))
        self.assertEqual(caught.exception.file, str(self.folder / "case.toml"))
        with self.assertRaisesRegex(pfdm.InputError, "\"lenght\""):
            pfdm.FractureRun(box(self.folder, f"{path}\n[output]\nlenght = 1.0"))
        with self.assertRaisesRegex(pfdm.InputError, r"pfdm.homogenize\(\)"):
            pfdm.FractureRun(pfdm.Case(shipped / "composite_stiffness"))


class Stiffnesses(Folder):
    def test_are_those_of_the_program_to_the_last_bit(self):
        for boundary in ("periodic", "uniform traction"):
            case = box(self.folder, f'[homogenization]\nboundary = "{boundary}"')
            case.run(self.folder / "r")
            theirs = json.loads((self.folder / "r/homogenized.json").read_text())
            ours = pfdm.homogenize(case)
            self.assertEqual(ours["stiffness_Pa"].shape, (6, 6))
            of_program = {name: value for name, value in theirs.items() if name not in ("case", "case_hash", "version")}
            as_lists = {name: value.tolist() if isinstance(value, numpy.ndarray) else value for name, value in ours.items()}
            self.assertEqual(as_lists, of_program)

    def test_of_arrays_are_those_of_the_same_mesh(self):
        case, stepped = box(self.folder), self.folder / "stepped"
        stepped.mkdir()
        mesh = arrays_of(pfdm.FractureRun(box(stepped, path)))
        ours, theirs = pfdm.homogenize(case, mesh), pfdm.homogenize(case)
        scale = abs(theirs["stiffness_Pa"]).max()
        numpy.testing.assert_allclose(ours["stiffness_Pa"], theirs["stiffness_Pa"], rtol=0.0, atol=1e-6 * scale)
        bounds = theirs["bounds"]["hashin_shtrikman"]
        self.assertGreater(ours["isotropic"]["bulk_modulus_Pa"], bounds["bulk_modulus_lower_Pa"])

    def test_of_layers_are_those_of_a_closed_form(self):
        """Two layers across x: sigma_xx is the same in both, and so are strains along them."""
        case = box(self.folder, **{"mesh.regions[0].lower[0]": "2 mm", "mesh.regions[0].upper[0]": "5 mm",
                                   "mesh.regions[0].lower[1]": "-1 mm", "mesh.regions[0].upper[1]": "5 mm",
                                   "mesh.regions[0].lower[2]": "-1 mm", "mesh.regions[0].upper[2]": "5 mm"})
        C = pfdm.homogenize(case)["stiffness_Pa"]
        lame = [(E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))) for E, nu in ((70e9, 0.2), (1e9, 0.4))]
        self.assertAlmostEqual(C[0, 0] * numpy.mean([1 / (a + 2 * mu) for a, mu in lame]), 1.0, delta=1e-6)
        self.assertAlmostEqual(C[3, 3] / numpy.mean([mu for _, mu in lame]), 1.0, delta=1e-6)
        self.assertAlmostEqual(C[4, 4] * numpy.mean([1 / mu for _, mu in lame]), 1.0, delta=1e-6)

    def test_that_are_wrong_say_file_line_and_key(self):
        for more, said in [(path, r"pfdm.FractureRun\(\)"), ("lenght = 1.0", "\"lenght\""),
                           ('[homogenization]\nboundary = "rigid"', "uniform traction")]:
            with self.assertRaisesRegex(pfdm.InputError, said) as caught:
                pfdm.homogenize(box(self.folder, more))
            self.assertEqual(caught.exception.file, str(self.folder / "case.toml"))
        with self.assertRaisesRegex(pfdm.InputError, "is not \"homogenize\""):
            pfdm.homogenize(pfdm.Case(shipped / "bar_at2"))


if __name__ == "__main__":
    unittest.main()
