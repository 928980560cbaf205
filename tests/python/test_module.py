"""Tests of the module pfdm: what scripts see of cases and their runs is what the command line makes."""

import csv
import gc
import os
import pathlib
import signal
import subprocess
import threading
import unittest

from shared import Folder, bar, shipped

import numpy
import pandas
import pfdm

toughness = "materials.concrete.toughness"


class Cases(Folder):
    def test_values_are_those_of_the_file_until_they_are_set(self):
        case = pfdm.Case(shipped / "bar_at2")
        self.assertEqual(case[toughness], "100 J/m^2")
        self.assertEqual(case["boundary[1].displacement[0]"], "0.1 mm")
        self.assertIn("boundary[1].patch", list(case))
        other = case.with_values({toughness: "120 J/m^2"})
        self.assertEqual((case[toughness], other[toughness]), ("100 J/m^2", "120 J/m^2"))
        del other[toughness]
        self.assertEqual(other[toughness], "100 J/m^2")
        with self.assertRaisesRegex(KeyError, r"toughnes \(near: materials.concrete.toughness"):
            case["materials.concrete.toughnes"]
        with self.assertRaises(TypeError):
            case[toughness] = object()

    def test_numbers_of_numpy_lists_and_tables_become_toml(self):
        from pfdm.toml_text import toml_piece

        self.assertEqual(toml_piece(numpy.float64(0.25)), "0.25")
        self.assertEqual(toml_piece(numpy.array([1, 2])), "[1, 2]")
        self.assertEqual(toml_piece({"expr": 'x "t"', "unit": "um"}), '{ expr = "x \\"t\\"", unit = "um" }')
        self.assertEqual(toml_piece([True, "20 um", 3]), '[true, "20 um", 3]')

    def test_quantities_of_pint_are_taken_with_their_unit(self):
        class Units(str):
            def __format__(self, spec):
                return self if spec == "~C" else "wrong"

        class Quantity:  # as pint has it
            magnitude, units = 300.0, Units("J/m**2")

        case = bar(**{toughness: Quantity()})
        self.assertIn("the input is valid", case.check().text)

    def test_check_tells_what_would_run_and_what_is_doubtful(self):
        check = bar(**{"fracture.length": "0.5 mm"}).check()
        self.assertIn("cells 42", check.text)
        self.assertEqual(str(check).splitlines(), check.text)
        self.assertTrue(any("no crack would be resolved" in warning for warning in check.warnings), check.warnings)
        self.assertFalse(bar().check().warnings)

    def test_keys_are_completed(self):
        keys = bar(**{"fracture.length": "0.5 mm"})._ipython_key_completions_()
        for key in (toughness, "fracture.length", "boundary[1].patch"):
            self.assertIn(key, keys)

    def test_dicts_take_the_place_of_tables(self):
        case = bar(**{"loading": {"end": 0.5, "initial_increment": 0.25}})
        self.assertTrue(case.check().text)
        with self.assertRaises(pfdm.InputError) as caught:
            bar(**{"materials.concrete.shear_branches[0].modulus": "7 MPa"}).check()
        self.assertRegex(str(caught.exception), r"^materials\.concrete\.shear_branches\[0\]\.modulus: .* given as a whole")

    def test_errors_have_file_line_and_key(self):
        lines = (shipped / "bar_at2/case.toml").read_text().splitlines()
        for key, value, named in [(toughness, "3 N", toughness), (toughness, 3.0, toughness),
                                  ("materials.concrete.poisson_ratio", 0.7, "materials.concrete.poisson_ratio"),
                                  ("materials.concrete.toughnes", "3 J/m^2", "materials.concrete.toughnes")]:
            with self.assertRaises(pfdm.InputError) as caught:
                bar(**{key: value}).check()
            self.assertEqual(caught.exception.key, named)
            self.assertEqual(caught.exception.file, str(shipped / "bar_at2/case.toml"))
            self.assertNotIn("--set", str(caught.exception))
            if key.endswith("toughnes"):  # it is not in the file
                self.assertIsNone(caught.exception.line)
            else:
                self.assertIn(f"{key.split('.')[-1]} = ", lines[caught.exception.line - 1])
        with self.assertRaises(pfdm.InputError) as caught:
            bar(**{"boundary[7].patch": "xmin"}).check()
        self.assertEqual(caught.exception.key, "boundary[7].patch")
        with self.assertRaises(pfdm.InputError):
            pfdm.Case(self.folder)


class Runs(Folder):
    def test_are_those_of_the_command_line_to_the_last_bit(self):
        case = bar(**{toughness: "120 J/m^2"})
        run = case.run(self.folder / "script", threads=1)
        subprocess.run([os.environ["PFDM_PROGRAM"], *case.words("run", self.folder / "line", 1)], check=True,
                       stdout=subprocess.DEVNULL)
        files = [self.folder / name / "force_displacement.csv" for name in ("script", "line")]
        self.assertEqual(files[0].read_bytes(), files[1].read_bytes())
        rows = list(csv.DictReader(files[1].read_text().splitlines()))
        self.assertEqual(list(run.curve["force_x_N"]), [float(row["force_x_N"]) for row in rows])
        self.assertEqual(run.curve.attrs["units"]["force_x_N"], "N")
        with self.assertRaisesRegex(KeyError, r"force_N \(near: force_x_N, force_y_N, force_z_N\)"):
            run.curve["force_N"]
        self.assertEqual(run.curve.attrs["units"]["damaged_volume_m3"], "m^3")
        self.assertEqual(run.status, "complete")
        self.assertEqual(run.summary["cells"], 42)

    def test_tell_each_step_as_it_is_done(self):
        seen = []
        run = bar().run(self.folder / "r", on_step=seen.append)
        self.assertEqual(pandas.DataFrame(seen)["displacement_m"].tolist(), run.curve["displacement_m"].tolist())
        self.assertEqual(str(seen[1]), "step 1: 1 um, 299.8 mN")
        self.assertEqual(str(type(seen[1])({**seen[1], "displacement_m": 0.0, "force_y_N": -4.2e4})), "step 1: 0 m, -42 kN")

    def test_of_kinds_without_load_steps_cannot_be_followed(self):
        with self.assertRaisesRegex(pfdm.InputError, "have steps to follow"):
            pfdm.Case(shipped / "endochronic_uniaxial").run(self.folder / "r", on_step=print)

    def test_end_in_order_where_the_script_says_so(self):
        run = bar().run(self.folder / "r", on_step=lambda step: step["step"] < 3)
        self.assertIn(run.summary["steps"], (3, 4))  # the run waits for the script
        self.assertIn("interrupted", run.status)
        whole = bar().run(self.folder / "r", restart=True)
        unbroken = bar().run(self.folder / "unbroken")
        pandas.testing.assert_frame_equal(whole.curve, unbroken.curve, check_exact=True)

    def test_pass_on_what_a_callback_raises(self):
        def fails(step):
            raise ZeroDivisionError(step["step"])

        with self.assertRaises(ZeroDivisionError):
            bar().run(self.folder / "r", on_step=fails)

    def test_end_in_order_by_ctrl_c(self):
        with self.assertRaises(KeyboardInterrupt):
            bar().run(self.folder / "r", on_step=lambda step: os.kill(os.getpid(), signal.SIGINT))
        self.assertIn("interrupted", pfdm.open(self.folder / "r").status)

    def test_go_side_by_side_in_threads(self):
        runs = {}

        def make(name):
            runs[name] = bar().run(self.folder / name, threads=1)

        threads = [threading.Thread(target=make, args=(name,)) for name in ("a", "b")]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        pandas.testing.assert_frame_equal(runs["a"].curve, runs["b"].curve, check_exact=True)

    def test_that_fail_raise_with_the_programs_words(self):
        with self.assertRaisesRegex(pfdm.ComputationError, "converge"):
            bar(**{"solver.maximum_iterations": 2, "loading.minimum_increment": 0.01}).run(self.folder / "r")

    def test_have_fields_as_arrays(self):
        run = bar().run(self.folder / "r")
        frame = run.frames[-1]
        self.assertEqual(frame.damage.shape, (42,))
        self.assertEqual(frame.stress.shape, (42, 6))
        self.assertAlmostEqual(float(frame.damage.max()), run.summary["max_damage"], delta=1e-6)
        self.assertEqual(frame.grid.units["stress"], "Pa")
        self.assertAlmostEqual(float(run.mesh.cell_data["volume"].sum()), 1e-7, delta=1e-20)
        weak = run.mesh.regions()["weak"]
        centres = frame.grid.cell_centres[run.mesh.cell_data["material"] == weak]
        numpy.testing.assert_allclose(centres[:, 0], 0.05, atol=1e-9)
        self.assertFalse(frame.damage.flags.owndata)
        with self.assertRaisesRegex(AttributeError, "damage, "):
            frame.nothing

    def test_are_views_that_outlive_them_and_leave_no_memory(self):
        bar().run(self.folder / "r")

        def resident():
            gc.collect()
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096

        for i in range(400):
            run = pfdm.open(self.folder / "r")
            damage = run.frames[-1].damage
            volume = run.mesh.cell_data["volume"]
            if i == 100:
                first = resident()
        copies = [each.copy() for each in (damage, volume)]
        del run
        self.assertLess(resident() - first, 1e6)
        for view, copy in zip((damage, volume), copies, strict=True):
            self.assertFalse(view.flags.owndata)
            self.assertEqual(view.tobytes(), copy.tobytes())

    def test_have_the_same_fields_in_one_file(self):
        try:
            import h5py  # noqa: F401
        except ImportError:
            self.skipTest("without h5py")
        values = {"output.frames_every": 2, "mesh.region": "bar/1", "materials.concrete.regions": ["bar/1", "weak"]}
        apart = bar(**values).run(self.folder / "apart").frames
        run = bar(**values, **{"output.format": "vtkhdf"}).run(self.folder / "one")
        self.assertFalse((run.folder / "fields.pvd").exists())
        self.assertEqual([(one.step, one.time) for one in run.frames], [(one.step, one.time) for one in apart])
        for one, other in zip(run.frames, apart, strict=True):
            for name in ("points", "connectivity", "offsets", "types"):
                numpy.testing.assert_array_equal(getattr(one.grid, name), getattr(other.grid, name))
            for data in ("cell_data", "point_data"):
                of_one, of_other = getattr(one.grid, data), getattr(other.grid, data)
                self.assertEqual(set(of_one), set(of_other))
                for name, values in of_other.items():
                    numpy.testing.assert_array_equal(of_one[name], values)
            self.assertEqual(one.grid.units["stress"], "Pa")
            self.assertEqual(one.grid.regions(), other.grid.regions())
            self.assertIn("bar/1", one.grid.regions())

    def test_have_the_cells_that_meshio_reads(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("without meshio")
        run = bar().run(self.folder / "r")
        mesh = run.frames[-1].grid.to_meshio()
        again = meshio.read(run.frames[-1].path)
        numpy.testing.assert_array_equal(mesh.cells[0].data, again.cells[0].data)
        numpy.testing.assert_array_equal(mesh.cell_data["damage"][0], again.cell_data["damage"][0])


class ResultsThatAreNotThere(Folder):
    def test_name_the_command_that_makes_them(self):
        results = pfdm.open(self.folder)
        for get, command in [(lambda: results.summary, "pfdm run"), (lambda: results.fit, "pfdm fit"),
                             (lambda: results.frames, "pfdm run"), (lambda: results.law, "cohesive_law.csv")]:
            with self.assertRaisesRegex(pfdm.MissingResult, command):
                get()
        with self.assertRaises(pfdm.MissingResult):
            pfdm.open(self.folder / "nowhere")
        (self.folder / "mesh.vtu").write_text("<VTKFile/>")
        with self.assertRaisesRegex(ValueError, "mesh.vtu"):
            results.mesh


if __name__ == "__main__":
    unittest.main(verbosity=2)
