"""The program `pfdm` as a child process."""

from __future__ import annotations

import math
import os
import shutil
import signal
import subprocess
import tempfile
import threading
from collections.abc import Callable, Iterable
from typing import IO

from .errors import ComputationError, Error, InputError


def _in_unit_that_fits(value: float, unit: str) -> str:
    """"157.1 um" of 1.571e-4 m: a prefix that leaves one to three digits before the point."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g} {unit}"
    power = min(3, max(-4, math.floor(math.log10(abs(value) * (1.0 + 5e-5)) / 3.0)))
    return f"{value / 1000.0**power:.4g} {'pnum kMG'[power + 4].strip()}{unit}"


class Step(dict[str, float]):
    """A load step as a dict of the columns of force_displacement.csv, SI units in their names; print() shows it in brief,
    "step 8: 157.1 um, 9.222 N", by the largest component of the force."""

    def __str__(self) -> str:
        forces = [self[name] for name in ("force_x_N", "force_y_N", "force_z_N") if name in self]
        if "displacement_m" not in self or not forces:
            return f"step {self.get('step', math.nan):.0f}: load {self.get('load', math.nan):.4g}"
        return (f"step {self['step']:.0f}: {_in_unit_that_fits(self['displacement_m'], 'm')}, "
                f"{_in_unit_that_fits(max(forces, key=abs), 'N')}")

_running: dict[int, subprocess.Popen[bytes]] = {}  # by the thread that waits


def program() -> str:
    """Path of the program: the environment's PFDM_PROGRAM, or `pfdm` on the PATH. Raises Error if there is none."""
    found = os.environ.get("PFDM_PROGRAM") or shutil.which("pfdm")
    if not found:
        raise Error("the program pfdm was not found: start the script by ./pfdm python SCRIPT, install the package, or "
                    "set PFDM_PROGRAM to the path of the program")
    return found


def _message(stderr: str) -> str:
    """What the program says at last, without its name."""
    lines = [line.removeprefix("pfdm: ") for line in stderr.splitlines() if not line.startswith("pfdm: warning: ")]
    return "\n".join(line for line in lines if line) or "the program said nothing"


def _follow(rows: IO[str], on_step: Callable[[Step], object]) -> bool:
    """Calls `on_step` with each row of the curve; True if it has asked for the end by returning False."""
    names = rows.readline().strip().split(",")
    for line in rows:
        step = Step({name: float(value) for name, value in zip(names, line.split(","), strict=True)})
        if on_step(step) is False:
            return True
    return False


def call(words: list[str], on_step: Callable[[Step], object] | None = None) -> str:
    """Runs `pfdm WORDS...` and returns what it printed.

    `on_step` is called, in the caller's thread, with each row of the curve of a run; if it returns False the run ends
    after its present iteration, as by Ctrl-C. What it raises ends the run likewise, and is raised here.

    Raises InputError for status 2, ComputationError for status 1, KeyboardInterrupt for Ctrl-C once the program has
    ended in order. If the script is killed, or its terminal closed, the program ends likewise.
    """
    with tempfile.TemporaryFile("w+", errors="replace") as out, tempfile.TemporaryFile("w+", errors="replace") as err:
        reading, writing = os.pipe() if on_step else (-1, -1)
        if on_step:
            words = [*words, "--curve-to", f"/dev/fd/{writing}"]
        # A session of its own: Ctrl-C in a terminal comes to the script alone, which passes it on. PFDM_PARENT: the
        # program ends with this process.
        process = subprocess.Popen([program(), *words], stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                   env={**os.environ, "PFDM_PARENT": str(os.getpid())},
                                   pass_fds=(writing,) if on_step else (), start_new_session=True)
        _running[threading.get_ident()] = process
        stopped = False
        try:
            if on_step:
                os.close(writing)
                with os.fdopen(reading) as rows:
                    stopped = _follow(rows, on_step)
                    if stopped:
                        process.send_signal(signal.SIGINT)
            status = process.wait()
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.wait()
            raise
        finally:
            del _running[threading.get_ident()]
        out.seek(0)
        err.seek(0)
        said, complaint = out.read(), err.read()
    if status == 2:
        raise InputError(_message(complaint))
    if status == 0 or (stopped and status in (130, -signal.SIGINT)):
        return said
    if status < 0 or status > 128:
        raise ComputationError(f"the program was ended by signal {status - 128 if status > 128 else -status}: "
                               f"{_message(complaint)}")
    raise ComputationError(_message(complaint))


def interrupt(threads: Iterable[int]) -> None:
    """Asks the programs that these threads wait for to end in order, as Ctrl-C does."""
    for thread in threads:
        if process := _running.get(thread):
            process.send_signal(signal.SIGINT)
