"""Tutorials step by step, exactly as they are written, in a folder of their own.

    check_tutorials.py CHECKOUT [--all] TUTORIAL...

PFDM_PROGRAM is the program, PYTHONPATH has the module. Each block of a tutorial is taken in its order, as tutorial_steps.py says:
commands are run, files written, tables put where the text says. A block that is not known there is a fault, and so is one that
the page lacks. --all: also the commands that take minutes.

Exit status: 0, or 1 with a line for each fault; 77 where what a tutorial needs is not installed.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tutorial_blocks import Do, Skipped, Tried, blocks_of
from tutorial_steps import before, tutorials

needed = {"mesh": "gmsh", "study": "gmsh"}

launcher = """#!/bin/sh
if [ "$1" = python ]; then shift; exec "{python}" "$@"; fi
exec "$PFDM_PROGRAM" "$@"
"""


def lay_out(folder, checkout):
    """What a reader has: the launcher, and the cases as they are shipped."""
    (folder / "pfdm").write_text(launcher.format(python=sys.executable))
    (folder / "pfdm").chmod(0o755)
    shutil.copytree(checkout / "cases", folder / "cases", ignore=shutil.ignore_patterns("results", "program", "python"))


def try_out(name, folder, checkout, with_slow):
    """Goes through a tutorial. Raises AssertionError with what is wrong, Skipped."""
    page = checkout / "cases/tutorials" / f"{name}.md"
    shutil.copy(page, folder)
    tried = Tried(folder, with_slow)
    blocks = iter(blocks_of(page.read_text(encoding="utf-8")))
    skipped = False
    for step in tutorials[name]:
        if isinstance(step, Do):
            try:
                tried.other_words = step.act(folder)
                skipped = False
            except Skipped as why:
                print(f"{name}: a block is left out: {why}")
                skipped = True
            continue
        block = next(blocks, None)
        if block is None:
            raise AssertionError(f"the page has no block for {step}")
        if not skipped:
            step(block, tried)
        tried.other_words, skipped = None, False
    if more := next(blocks, None):
        raise AssertionError(f"nothing is said here of\n{more.text}")


def main():
    checkout = Path(sys.argv[1]).resolve()
    with_slow, names = "--all" in sys.argv, [word for word in sys.argv[2:] if word != "--all"]
    for name in names:
        if name in needed and shutil.which(needed[name]) is None:
            print(f"{name}: {needed[name]} is not installed")
            return 77
    if missing := [each for each in ("numpy", "pandas", "matplotlib") if importlib.util.find_spec(each) is None]:
        print(f"not installed: {missing}")
        return 77
    os.environ["MPLBACKEND"] = "Agg"
    faults = 0
    with tempfile.TemporaryDirectory(prefix="pfdm_tutorials_") as scratch:
        folder = Path(scratch).resolve()
        lay_out(folder, checkout)
        for name in dict.fromkeys(each for name in names for each in (*before.get(name, ()), name)):
            try:
                try_out(name, folder, checkout, with_slow)
                print(f"{name}: as it is written")
            except (AssertionError, subprocess.SubprocessError, OSError) as wrong:
                faults += 1
                print(f"{name}: {wrong}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
