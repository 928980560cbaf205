"""A script that is killed ends the run that it has begun, in order: it goes on by a restart."""

import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

from shared import Folder, bar

import pfdm

script = """
import os, sys, threading
from pfdm import program
from shared import bar

for _ in range(8):  # as of NumPy's BLAS: the run is told of the end of each
    threading.Thread(target=threading.Event().wait, daemon=True).start()

def tell(step):
    if step["step"] >= 2:
        print(*(process.pid for process in program._running.values()), flush=True)

bar(**{f"loading.{name}_increment": 1e-4 for name in ("initial", "maximum")}).run(sys.argv[1], on_step=tell, threads=1)
"""


def is_over(pid):
    """Whether there is no such process, or one that only waits to be asked for its status."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] in "ZX"
    except OSError:
        return True


class KilledScripts(Folder):
    def end_by(self, sent):
        """Kills a script in the middle of its run; the number of the run's process."""
        place = self.folder / "r"
        with subprocess.Popen([sys.executable, "-c", script, place], stdout=subprocess.PIPE,
                              cwd=pathlib.Path(__file__).parent) as process:
            pid = int(process.stdout.readline())
            self.addCleanup(lambda: is_over(pid) or os.kill(pid, signal.SIGKILL))
            self.assertFalse(is_over(pid))
            process.send_signal(sent)
            process.stdout.read()
        self.assertEqual(process.returncode, -sent)
        return pid

    def expect_end_of(self, pid):
        latest = time.monotonic() + 60
        while not is_over(pid) and time.monotonic() < latest:
            time.sleep(0.01)
        self.assertTrue(is_over(pid), "the run goes on without its script")
        self.assertIn("interrupted", pfdm.open(self.folder / "r").status)

    def test_end_their_runs(self):
        self.expect_end_of(self.end_by(signal.SIGKILL))

    def test_end_their_runs_with_their_terminal(self):
        self.expect_end_of(self.end_by(signal.SIGHUP))

    def test_leave_alone_what_others_have_started(self):
        words = bar().words("run", self.folder / "r", 1)
        subprocess.run([os.environ["PFDM_PROGRAM"], *words], env={**os.environ, "PFDM_PARENT": "1"}, check=True,
                       stdout=subprocess.DEVNULL)
        self.assertEqual(pfdm.open(self.folder / "r").status, "complete")


if __name__ == "__main__":
    unittest.main()
