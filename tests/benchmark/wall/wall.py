#!/usr/bin/python3
"""The wall: the same phase-field problems with this program and with finite elements in dolfinx, and what each error costs.

    tests/benchmark/wall/wall.py                                 # what is missing of the runs, then wall.csv and wall.png
    tests/benchmark/wall/wall.py --again --problem sent_tension  # one problem anew
    tests/benchmark/wall/wall.py --runs none                     # only the table and the figure, from what was run

A run is one process on one thread. dolfinx may be elsewhere, as in a chroot: --peer "chroot /srv/bookworm /usr/bin/python3".
"""

import argparse
import csv
import datetime
import pathlib
import platform
import shlex
import subprocess

import errors
import figure
import runs
from problems import PROBLEMS, VARIANTS

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
COLUMNS = ("problem code variant mesh steps tolerance cells unknowns iterations cpu_s MB end measure value limit reference doubt error "
           "machine version date").split()


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problem", action="append", choices=PROBLEMS, help="only this one; may be repeated")
    parser.add_argument("--again", action="store_true", help="also what was run before")
    parser.add_argument("--runs", default="missing", choices=("missing", "none"))
    parser.add_argument("--code", choices=runs.CODES, help="run only this one")
    parser.add_argument("--pfdm", default=str(ROOT / "build/release/cases/program/pfdm"))
    parser.add_argument("--peer", default="/usr/bin/python3", help="the Python that has dolfinx")
    return parser.parse_args()


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return names[0] if names else platform.machine()


def version_of_peer(peer):
    asked = "import dolfinx, petsc4py; print('dolfinx', dolfinx.__version__, 'PETSc', petsc4py.__version__)"
    return subprocess.run([*shlex.split(peer), "-c", asked], capture_output=True, text=True, check=True).stdout.strip()


def make_runs(name, options):
    stamp = {"machine": machine(), "date": datetime.date.today().isoformat()}
    for run in runs.runs_of(name, PROBLEMS[name]):
        if options.code not in (None, run.code) or (runs.result_of(run) and not options.again):
            continue
        result = runs.execute(run, options, VARIANTS)
        stamp["version"] = f"pfdm {result.get('version', '')}" if run.code == "pfdm" else version_of_peer(options.peer)
        runs.keep(run, result | stamp)
        print(f"{run.folder().relative_to(HERE / 'results')}: {result['end']}, {result['cpu_s']:.4g} CPU s, "
              f"{result.get('iterations', 0)} iterations", flush=True)


def check_grids(name, done):
    """Both codes have to have the same cells of the same mesh."""
    cells = {}
    for run, result in done:
        if "cells" in result and cells.setdefault(run.mesh, result["cells"]) != result["cells"]:
            raise SystemExit(f"{name}, mesh {run.mesh:g}: {cells[run.mesh]} cells with one code, {result['cells']} with {run.code}")


def rows_of(name):
    """A row for each run and measure."""
    problem = PROBLEMS[name]
    done = [(run, runs.result_of(run)) for run in runs.runs_of(name, problem)]
    done = [(run, result) for run, result in done if result]
    check_grids(name, done)
    whole = {run: runs.columns_of(run) for run, result in done if result["end"] == "whole"}
    values = {m: {run: f(c) for run, c in whole.items()} for m, (_, _, f) in problem.measures.items()}
    for measure, by_run in values.items():
        limits, reference, doubt = errors.limits(by_run)
        if measure in problem.exact:
            reference, doubt = problem.exact[measure], 0.0
        for run, result in done:
            value = by_run.get(run)
            yield {"problem": name, "code": run.code, "variant": run.variant, "mesh": f"{run.mesh:g}", "steps": f"{run.steps:g}",
                   "tolerance": f"{run.tolerance:g}", "measure": measure,
                   "cpu_s": f"{result['cpu_s']:.4g}", "MB": f"{result['MB']:.4g}",
                   **{k: result.get(k, "") for k in ("cells", "unknowns", "iterations", "end", "machine", "version", "date")},
                   "value": "" if value is None else f"{value:.7g}",
                   "limit": f"{limits[run.code, run.variant]:.7g}" if (run.code, run.variant) in limits else "",
                   "reference": f"{reference:.7g}", "doubt": f"{doubt / abs(reference):.2e}", "error": "" if value is None else f"{value / reference - 1:.3e}"}


def main():
    options = arguments()
    for name in options.problem or PROBLEMS:
        if options.runs == "missing":  # a run that failed or was out of time is kept as such
            make_runs(name, options)
    rows = [row for name in PROBLEMS for row in rows_of(name)]
    with open(HERE / "wall.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    figure.draw(rows, HERE / "wall.png")


if __name__ == "__main__":
    main()
