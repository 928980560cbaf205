"""Tests of fracture runs in process: steps and fields are those of the program, whatever a script does in between."""

import gc
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest

from in_process import long_bar, rows_of
from shared import Folder, bar, shipped

import numpy
import pfdm

three_steps = {"loading.end": 0.3, "loading.initial_increment": 0.1, "loading.maximum_increment": 0.1}


class Steps(Folder):
    def test_are_those_of_the_program_to_the_last_bit(self):
        case = bar()
        theirs = case.run(self.folder / "r", threads=1)
        with pfdm.FractureRun(case) as run:
            rows = rows_of(run)
            self.assertEqual(rows, theirs.curve.to_dict("records"))
            frame = theirs.frames[-1]
            self.assertEqual(run.damage.tobytes(), frame.damage.tobytes())
            self.assertEqual(run.displacement.tobytes(), frame.displacement.tobytes())
            self.assertEqual(run.stress[:, 0, 1].astype("f4").tobytes(), frame.stress[:, 3].tobytes())
            self.assertEqual(set(run.fields), set(frame.grid.cell_data))
            self.assertEqual(run.reaction("xmax")[0], rows[-1]["force_x_N"])
            self.assertEqual(run.patch_displacement("xmax")[0], rows[-1]["displacement_m"])
            with self.assertRaisesRegex(pfdm.InputError, "xmin"):
                run.reaction("left")
            with self.assertRaisesRegex(pfdm.InputError, "no further step"):
                run.step()

    def test_by_two_threads_are_the_same_whatever_is_looked_at(self):
        case = long_bar(**three_steps)
        theirs = case.run(self.folder / "r", threads=1).curve.to_dict("records")
        pfdm.set_threads(2)
        run = pfdm.FractureRun(case)
        self.assertGreater(len(run.cell_volumes), 5000)
        rows = [run.row]
        for row in run:
            rows.append(row)
            run.stress.sum()
        self.assertEqual(rows, theirs)

    def test_with_interfaces_are_the_same(self):
        case = pfdm.Case(shipped / "cohesive_dcb")
        theirs = case.run(self.folder / "r", max_steps=2).curve.to_dict("records")
        run = pfdm.FractureRun(case)
        self.assertEqual([run.row, run.step(), run.step()], theirs)

    def test_go_on_from_a_state_that_was_kept(self):
        run = pfdm.FractureRun(bar())
        for _ in range(4):
            run.step()
        state, damage = run.state, run.damage
        before = damage.copy()
        first = [run.step() for _ in range(3)]
        self.assertEqual(damage.tobytes(), before.tobytes())
        run.restore(state)
        self.assertEqual((run.state.step, state.step, run.load), (4, 4, state.load))
        self.assertEqual(run.damage.tobytes(), before.tobytes())
        self.assertEqual([run.step() for _ in range(3)], first)
        with self.assertRaisesRegex(pfdm.InputError, "another mesh"):
            run.restore(pfdm.FractureRun(bar(**{"mesh.x[0].cells": 11})).state)

    def test_that_a_watch_ends_leave_the_run_where_it_was(self):
        run, other = pfdm.FractureRun(bar()), pfdm.FractureRun(bar())
        run.step(), other.step()
        seen = []

        def watch(at):
            seen.append(at)
            if len(seen) == 2:
                raise LookupError("enough")

        before = run.row
        while not seen or len(seen) < 2:
            try:
                run.step(watch)
                other.step()
                before = run.row
            except LookupError:
                break
        self.assertEqual(run.row, before)
        self.assertEqual(list(run), list(other))
        self.assertEqual(set(seen[0]), {"step", "iteration", "load", "damage_change", "energy_change", "remark"})
        self.assertEqual({at["remark"] for at in seen}, {""})

    def test_cannot_be_done_within_a_step(self):
        run = pfdm.FractureRun(bar())
        with self.assertRaisesRegex(RuntimeError, "is computing"):
            run.step(lambda at: run.step())
        self.assertEqual(run.step()["step"], 1)

    def test_in_threads_of_their_own_do_not_disturb_each_other(self):
        cases = [long_bar(**three_steps), long_bar(**three_steps, **{"materials.concrete.toughness": "120 J/m^2"})]
        pfdm.set_threads(1)
        alone = [rows_of(pfdm.FractureRun(case)) for case in cases]
        pfdm.set_threads(2)
        found = [None, None]

        def work(i):
            found[i] = rows_of(pfdm.FractureRun(cases[i]))

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, alone)

    def test_can_be_looked_at_by_another_thread(self):
        run, ended = pfdm.FractureRun(bar(**{"loading.maximum_increment": 0.01})), threading.Event()
        seen, failed = [], []

        def look():
            try:
                while not ended.is_set():
                    row = run.row
                    run.state, repr(run), run.remarks, run.reaction("xmax"), run.patch_displacement("xmax"), run.is_complete
                    seen.append((row["step"], row["load"]))
            except Exception as error:  # is told by the main thread
                failed.append(error)

        threads = [threading.Thread(target=look) for _ in range(3)]
        for thread in threads:
            thread.start()
        rows = rows_of(run)
        ended.set()
        for thread in threads:
            thread.join()
        self.assertEqual(failed, [])
        self.assertLessEqual(set(seen), {(row["step"], row["load"]) for row in rows})

    def test_end_by_ctrl_c_and_go_on(self):
        run, other = pfdm.FractureRun(bar()), pfdm.FractureRun(bar())
        with self.assertRaises(KeyboardInterrupt):
            run.step(lambda at: os.kill(os.getpid(), signal.SIGINT))
        self.assertEqual(list(run), list(other))

    def test_end_by_ctrl_c_while_nothing_is_watched(self):
        run = pfdm.FractureRun(pfdm.Case(shipped / "glass_bead_quick"))
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            run.step()
            time.sleep(60.0)
        self.assertEqual(run.state.step, 0)

    def test_of_wrong_cases_say_file_line_and_key(self):
        with self.assertRaises(pfdm.InputError) as caught:
            pfdm.FractureRun(bar(**{"materials.concrete.toughness": "3 N"}))
        self.assertEqual(caught.exception.key, "materials.concrete.toughness")
        self.assertEqual(caught.exception.file, str(shipped / "bar_at2/case.toml"))
        with self.assertRaises(pfdm.InputError):
            pfdm.FractureRun(pfdm.Case(shipped / "endochronic_uniaxial"))

    def test_that_do_not_converge_are_computation_errors(self):
        run = pfdm.FractureRun(bar(**{"solver.maximum_iterations": 1, "loading.minimum_increment": 0.01}))
        with self.assertRaises(pfdm.ComputationError):
            list(run)
        self.assertLess(run.load, 1.0)


class Arrays(unittest.TestCase):
    def test_are_views_that_outlive_the_run(self):
        run = pfdm.FractureRun(bar())
        run.step()
        damage, stress, volumes = run.damage, run.stress, run.cell_volumes
        self.assertIs(run.damage.base is not None, True)
        self.assertEqual(run.damage.ctypes.data, damage.ctypes.data)
        self.assertFalse(damage.flags.writeable or stress.flags.owndata)
        copies = [each.copy() for each in (damage, stress, volumes)]
        run.close()
        del run
        gc.collect()
        for view, copy in zip((damage, stress, volumes), copies, strict=True):
            self.assertEqual(view.tobytes(), copy.tobytes())
        self.assertAlmostEqual(volumes.sum(), 1e-7)

    def test_of_a_closed_run_are_refused(self):
        with pfdm.FractureRun(bar()) as run:
            pass
        for ask in (run.step, lambda: run.damage, lambda: run.points):
            with self.assertRaisesRegex(pfdm.Error, "closed"):
                ask()

    def test_of_many_runs_are_given_back(self):
        def resident():
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096

        for i in range(60):
            with pfdm.FractureRun(bar()) as run:
                run.stress.sum(), run.state
            if i == 20:
                first = resident()
        self.assertLess(resident() - first, 4e6)

    def test_that_are_kept_keep_no_more_than_they_show(self):
        def resident():
            gc.collect()
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096

        def kept():
            with pfdm.FractureRun(long_bar(**three_steps)) as run:
                run.step()
                return run.damage, run.cell_volumes

        warm = [kept() for _ in range(2)]
        before = resident()
        views = [kept() for _ in range(8)]
        each = (resident() - before) / len(views)
        self.assertLess(each, 1500 * len(warm[0][0]))

    def test_of_the_mesh_fit_together(self):
        run = pfdm.FractureRun(bar())
        self.assertEqual(run.offsets[-1], len(run.connectivity))
        self.assertEqual(run.patches, ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"])
        centre = run.points[run.connectivity.reshape(-1, 8)].mean(axis=1)
        numpy.testing.assert_allclose(centre, run.cell_centres, atol=1e-15)
        self.assertEqual(len(run.cells_of("bar")) + len(run.cells_of("weak")), len(run.cell_volumes))
        with self.assertRaisesRegex(KeyError, "weak"):
            run.cells_of("steel")


class Examples(unittest.TestCase):
    def test_end_well(self):
        for script, words in [("bar_steps.py", "N/mm2"), ("creeping_foam.py", "largest difference 0.18 %")]:
            said = subprocess.run([sys.executable, str(shipped / "python" / script)], capture_output=True, text=True,
                                  check=True).stdout
            self.assertIn(words, said)


if __name__ == "__main__":
    unittest.main()
