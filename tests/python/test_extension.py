"""Tests of the compiled extension as a whole: its absence, its threads, and forks of the process."""

import os
import signal
import subprocess
import sys
import threading
import unittest

from in_process import long_bar
from shared import shipped

import _pfdm
import pfdm

class Extension(unittest.TestCase):
    def test_is_asked_for_when_it_is_needed_and_its_absence_says_how_to_get_it(self):
        script = """
import sys
sys.modules["_pfdm"] = None
import pfdm
print(pfdm.Case(sys.argv[1]).kind)
try:
    pfdm.Endochronic(young_modulus=1.0)
except pfdm.Error as error:
    print(error)
"""
        said = subprocess.run([sys.executable, "-c", script, str(shipped / "bar_at2")], capture_output=True, text=True,
                              check=True).stdout
        self.assertIn("fracture", said)
        for words in ("./pfdm python SCRIPT", "python3-dev and pybind11-dev", f"Python {sys.version_info.major}."):
            self.assertIn(words, said)

    def test_survives_a_fork(self):
        run = pfdm.FractureRun(long_bar())
        pfdm.set_threads(2)
        run.step()
        state = run.state
        due = run.step()
        run.restore(state)

        def child():
            alone = _pfdm.n_threads()
            pfdm.set_threads(2)
            return alone == 1 and run.step() == due

        self.assert_child_succeeds(child)
        self.assertEqual(_pfdm.n_threads(), 2)
        self.assertEqual(run.step(), due)

    def test_survives_a_fork_while_another_thread_computes(self):
        pfdm.set_threads(2)
        run, ended = pfdm.FractureRun(long_bar()), threading.Event()
        start = run.state

        def work():
            while not ended.is_set():
                run.restore(start)
                run.step()

        thread = threading.Thread(target=work)
        thread.start()
        try:
            for _ in range(10):
                self.assert_child_succeeds(lambda: pfdm.set_threads(2) or _pfdm.n_threads() == 2)
        finally:
            ended.set()
            thread.join()

    def assert_child_succeeds(self, act):
        """Of a process that fork makes, within half a minute."""
        child = os.fork()
        if child == 0:
            signal.alarm(30)
            good = False
            try:
                good = act()
            finally:
                os._exit(0 if good else 1)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)


if __name__ == "__main__":
    unittest.main()
