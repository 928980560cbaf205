"""Runs of the wall: what is run, with which program, and what is kept of it (`results/PROBLEM/CODE_.../`)."""

import csv
import json
import os
import pathlib
import shlex
import subprocess
from dataclasses import dataclass

import case_file

HERE = pathlib.Path(__file__).resolve().parent
CODES = ("pfdm", "dolfinx")


@dataclass(frozen=True)
class Run:
    problem: str
    code: str
    mesh: float = 1.0  # factor on the cells of each block
    steps: float = 1.0  # factor on the number of steps
    tolerance: float = 1.0  # factor on that of the damage
    variant: str = ""

    def folder(self):
        parts = [self.code, f"mesh_{self.mesh:g}"]
        parts += [f"steps_{self.steps:g}"] if self.steps != 1.0 else []
        parts += [f"tolerance_{self.tolerance:g}"] if self.tolerance != 1.0 else []
        parts += [self.variant] if self.variant else []
        return HERE / "results" / self.problem / "_".join(parts)


def runs_of(name, problem):
    """Each mesh with both codes; on the second one, twice the steps, and a tenth of the tolerance."""
    for mesh in problem.meshes:
        for code in CODES:
            yield Run(name, code, mesh)
    for code in CODES:
        yield Run(name, code, problem.meshes[1], steps=2.0)
        yield Run(name, code, problem.meshes[1], tolerance=0.1)
    for code, mesh in problem.finer.items():
        yield Run(name, code, mesh)
    for variant in problem.variants:
        for mesh in problem.meshes[:2]:
            yield Run(name, "dolfinx", mesh, variant=variant)


def settings_of_pfdm(run, table):
    """--set KEY=VALUE for the mesh, the steps and the tolerance."""
    settings, mesh = [], table["mesh"]
    flat = len(mesh["z"]) == 1 and mesh["z"][0]["cells"] == 1
    for axis in "xy" if flat else "xyz":
        for i, block in enumerate(mesh[axis]):
            settings.append(f"mesh.{axis}[{i}].cells={max(1, round(block['cells'] * run.mesh))}")
    for key in ("initial_increment", "maximum_increment"):
        settings.append(f"loading.{key}={table['loading'][key] / run.steps!r}")
    settings.append(f"solver.damage_tolerance={table['solver']['damage_tolerance'] * run.tolerance!r}")
    return [word for s in settings for word in ("--set", s)]


def command_of(run, programs, variants):
    case = HERE / run.problem
    table = case_file.Case(case / "case.toml").table
    if run.code == "pfdm":
        return [*shlex.split(programs.pfdm), "run", str(case), "--threads", "1", "--quiet", "-o", str(run.folder() / "run"),
                *settings_of_pfdm(run, table)]
    tolerance = table["solver"]["damage_tolerance"] * run.tolerance
    return [*shlex.split(programs.peer), str(HERE / "peer.py"), str(case / "case.toml"), "--refinement", str(run.mesh), "--steps",
            str(run.steps), "--tolerance", repr(tolerance), "--output", str(run.folder() / "run/force_displacement.csv"),
            *variants.get(run.variant, [])]


def execute(run, programs, variants):
    """Runs it as a child; CPU seconds are the child's own and its children's (rusage), the peer's without imports, compilation
    and mesh."""
    folder = run.folder()
    (folder / "run").mkdir(parents=True, exist_ok=True)
    with open(folder / "said.txt", "w", encoding="utf-8") as said:
        child = subprocess.Popen(command_of(run, programs, variants), stdout=said, stderr=subprocess.STDOUT,
                                 env=os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
        _, status, usage = os.wait4(child.pid, 0)
    result = {"code": os.waitstatus_to_exitcode(status), "cpu_s": usage.ru_utime + usage.ru_stime, "MB": usage.ru_maxrss / 1024}
    told = told_by_pfdm(folder) if run.code == "pfdm" else told_by_peer(folder)
    result = told | result
    if result["code"] != 0:
        result["end"] = "failed"
    result["cpu_s"] -= result.pop("cpu_s_before", 0.0)
    return result


def keep(run, result):
    (run.folder() / "run.json").write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")


def result_of(run):
    """What run.json says of it; None where it was not run."""
    path = run.folder() / "run.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def told_by_pfdm(folder):
    path = folder / "run/summary.json"
    if not path.exists():
        return {"end": "failed"}
    summary = json.loads(path.read_text(encoding="utf-8"))
    return {"end": "whole" if summary["status"] == "complete" else summary["status"], "cells": summary["cells"],
            "unknowns": summary["unknowns"], "iterations": summary["staggered_iterations"], "version": summary["version"]}


def told_by_peer(folder):
    last = (folder / "said.txt").read_text(encoding="utf-8").strip().splitlines()[-1:]
    return json.loads(last[0]) if last and last[0].startswith("{") else {"end": "failed"}


def columns_of(run):
    """The curve by columns, the force of pfdm in the direction of the case's curve."""
    with open(run.folder() / "run/force_displacement.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    columns = {name: [float(row[name]) for row in rows] for name in rows[0]}
    if run.code == "pfdm":
        table = case_file.Case(HERE / run.problem / "case.toml").table
        columns["force_N"] = columns[f"force_{table['output']['curve']['component']}_N"]
    return columns
