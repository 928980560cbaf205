#!/usr/bin/python3
"""Draws the pictures of shipped cases anew from their results, each by the command of pictures.txt.

    /usr/bin/python3 postproc/plots/draw_cases.py                      # of all cases that have results
    /usr/bin/python3 postproc/plots/draw_cases.py glass_bead_quick     # of one
    /usr/bin/python3 postproc/plots/draw_cases.py --list glass_bead_quick

Results are those in cases/NAME/results. Runs of other files of a case, as finite_strain.toml, go to a folder in them of
that name (`--output cases/NAME/results/finite_strain`).
"""

import argparse
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
cases = here.parents[1] / "cases"


def commands():
    """(case, picture, words of the command) of all pictures. RESULTS stands for the case's results, CASE for its folder."""
    for line in (here / "pictures.txt").read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            picture, command = line.split(": ", 1)
            case = picture.split("/")[0]
            script, *words = shlex.split(command)
            program = cases / case / script if "/" in script else here / script
            in_place = [word.replace("RESULTS", str(cases / case / "results")).replace("CASE", str(cases / case))
                        for word in words]
            output = "--film" if picture.endswith(".webp") else "--output"
            yield case, picture, [program, *in_place, output, cases / picture]


def draw(picture, command):
    """Whether the picture was drawn; without results it is left as it is."""
    missing = [word for word in command if isinstance(word, str) and re.search(r"/results(/|$)", word)
               and not pathlib.Path(word.split("=")[-1]).exists()]
    if missing:
        print(f"{picture}: left as it is, without {os.path.relpath(missing[0])}")
        return False
    screen = ["xvfb-run", "-a"] if command[0].name == "draw_space.py" and not os.environ.get("DISPLAY") else []
    if screen and shutil.which("xvfb-run") is None:
        print(f"{picture}: left as it is, without a display or xvfb (apt-get install xvfb)")
        return False
    subprocess.run([*screen, "/usr/bin/python3", *command], check=True)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="CASE", help="names of cases; all")
    parser.add_argument("--list", action="store_true", help="print the commands alone")
    options = parser.parse_args()
    known = list(commands())
    for name in options.names:
        if name not in {case for case, _, _ in known}:
            parser.error(f"no picture is of the case {name}")
    wanted = [(picture, command) for case, picture, command in known if not options.names or case in options.names]
    if options.list:
        for _, command in wanted:
            print(shlex.join(os.path.relpath(word) if "/" in str(word) else str(word) for word in command))
        return
    sys.exit(0 if any([draw(picture, command) for picture, command in wanted]) else 1)


if __name__ == "__main__":
    main()
