"""What fuzzing starts with: the cases and the sample files of the repository, and short samples of other formats."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
LONGEST = 16_000  # bytes of a seed; longer text files lose their end

TOML = "\n".join([
    'a."b.c"."\\"" = [ 1, [ "ä", \'€\' ], { d = true, e = -1.5e-3, f = inf } ]',
    'g = """', 'h "" \\""" i\\"""" # j', "k = '''l''''", "[[m.n]]", "o = 0x1F", 'p = "\\u00e9 \\t"', ""]).encode()
FRAMES = """<?xml version="1.0"?>
<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">
<Collection>
<DataSet timestep="0" part="0" file="frame_000000.vtu"/>
<DataSet timestep="0.5" part="0" file="frame_000010.vtu"/>
</Collection>
</VTKFile>
"""
MODEL = """{"structure": "2", "kernel_terms": 1, "verdict": "sound", "reasons": ["a"], "relative_misfit": 0.1,
"predicted_relative_misfit": 0.2, "bic": -3.5, "parameters": [{"name": "k", "unit": "N/m", "estimate": 1.0,
"lower": 0.5, "upper": 2.0, "bounds": [0, 3], "at_bound": false}]}"""
CURVE = (
    "step,load,displacement_m,force_x_N,force_y_N,force_z_N,elastic_energy_J,fracture_energy_J,"
    "external_work_J,max_damage,damaged_volume_m3,staggered_iterations,viscous_dissipation_J,"
    "plastic_dissipation_J,interface_energy_J,interface_dissipation_J,strength_dissipation_J,"
    "eigenstrain_work_J,interface_viscous_dissipation_J")
STORED = [
    # Which reader, and what it reads: as in targets/stored.cpp.
    (0, '{"status": "finished", "case_hash": "0123456789abcdef", "peak_force_N": 1.5, "unknown": null}'),
    (1, '{"case": "a", "status": "finished", "version": "0.1.0", "case_hash": "0123456789abcdef", "threads": 2, '
        '"cells": 10, "unknowns": 30, "steps": 4, "staggered_iterations": 9, "krylov_iterations": 99, '
        '"wall_seconds": 1.5, "cpu_seconds": 2.5, "wall_seconds_by_stage": {"assembly": 0.5}, '
        '"cpu_seconds_by_stage": {"assembly": 0.5}, "peak_memory_bytes": 1e8, "rounds": 3, "figure": 0.5}'),
    (2, '{"format": 1, "kind": "fracture", "case": "a", "version": "0.1.0", "case_hash": "0123456789abcdef", '
        '"method": "a", "wall_seconds": 1.5, "confidence": 0.95, "verdict": "sound", "reasons": ["a"], '
        '"converged": true, "message": "a", "parameters": [{"name": "k", "unit": "Pa", "estimate": 1.5, '
        '"standard_error": 0.1, "lower": 1.0, "upper": 2.0, "first_guess": 1.2, "at_bound": false, '
        '"bounds": [0.1, 9.0], "log_scale": true, "profile": {"lower": 0.5, "upper": 2.0, '
        '"lower_open": false, "upper_open": true}}], "experiments": [{"name": "e", "fitted": true, '
        '"data": 12, "relative_misfit": 0.1, "unit": "N", "quantity": "force", "rms_misfit_N": 0.1, '
        '"rms_force_N": 1.0, "curve": "e.csv"}], "fracture": {}}'),
    (2, '{"format": 1, "kind": "mass_material", "case": "a", "version": "0.1.0", "case_hash": "0123456789abcdef", '
        '"method": "a", "wall_seconds": 1.5, "confidence": 0.95, "converged": true, "message": "a", "parameters": [], '
        '"experiments": [], "mass_material": {"structure": "2", "youngs_modulus": [{"frequency_Hz": 1, '
        '"storage_modulus_Pa": 2, "loss_modulus_Pa": 3}], "ogden": {"largest_displacement_m": 1, "relative_misfit": 1, '
        '"terms": [{"mu_Pa": 1, "alpha": 2}]}, "repeatability": {"records": [{"name": "r", "level_m_per_s2": 1, '
        '"age_s": 1, "run": 1, "relative_misfit": 1, "converged": true, "estimates": []}], '
        '"parameters": [{"name": "k", "mean": 1, "residual_deviation": 1, "residual_degrees_of_freedom": 2, '
        '"repeat_deviation": null, "repeat_degrees_of_freedom": 3, "expected_deviation": 1, '
        '"effects": [{"name": "e", "value": 1, "lower_95": 0, "upper_95": 2}]}]}}}'),
    (3, '{"case": "a", "case_hash": "0123456789abcdef", "analysed": "fedcba9876543210", "records": []}'),
    (4, '{"case": "a", "case_hash": "0123456789abcdef", "version": "0.1.0", "method": "a", "chosen": "2", '
        f'"models": [{MODEL}]}}'),
    (5, '{"tests": [{"name": "a/b.csv"}, {"name": "c"}]}'),
    (6, '{"surface": "bead", "step": 3, "polar_angle_from_rad": 0.1, "polar_angle_to_rad": null, '
        '"debonding_angle_rad": 0.5}'),
    (7, '{"case": "a", "status": "finished", "pfdm_version": "0.1.0", "steps": [{"name": "one", "does": "run", '
        '"case_hash": "a", "outcome_hash": "b", "wall_seconds": 1, "verdict": "c", "files_taken": ["d"], '
        '"numbers_taken": [{"into": "a", "from": "b", "key": "c", "value": 1}], '
        '"figures": [{"says": "a", "value": 1, "unit": "Pa", "interval": [0, 2]}]}]}'),
    (8, CURVE + "\n0" + ",0" * CURVE.count(",") + "\n1,nan" + ",1" * (CURVE.count(",") - 1) + "\n"),
    (9, "\x10\0\0\0\0\0\0\x000123456789abcdef" + "\0" * 400),
    (10, 'stiffness_Pa[0][1]\n{"stiffness_Pa": [[1.5, 2.5], [3.5, null]], "a": {"b": 1}}'),
]
MESSAGES = [
    'cases/x/case.toml:12: [mesh] "thicknes" is not known here; did you mean "thickness"? (allowed: '
    + ", ".join(f"key_{i}" for i in range(60)) + ")",
    "cannot read /" + "folder/" * 50 + "file.csv: No such file or directory",
    '"Fa\u00df\u2026\U0001f600" is not a number\n\x1b[31m' + "a" * 2500,
]


def files(*patterns):
    found = [path for pattern in patterns for path in ROOT.glob(pattern)]
    return sorted(path for path in found if "results" not in path.parts and path.is_file())


def contents(*patterns, head=b""):
    return [head + path.read_bytes()[:LONGEST] for path in files(*patterns)]


def case_texts():
    return [path.read_text("utf-8") for path in files("cases/*/case.toml")]


def cases_in_their_folders():
    return [f"# {path.parent.name}\n".encode() + path.read_bytes()
            for path in files("cases/*/case.toml") if re.fullmatch(r"[0-9a-z_]+", path.parent.name)]


def quoted(pattern):
    return sorted({word.encode() for text in case_texts() for word in re.findall(pattern, text)})


def tables():
    """As a foreign table of unknown layout, with each of the separators, and as one of this program's."""
    found = contents("cases/*/data/*.csv", "tests/reports/*/*.csv", "tests/reliability/inputs/*/*.csv")
    heads = (2, 7, 14, 26, 42, 70, 13, 1, 0)
    return [bytes([heads[i % len(heads)]]) + text[:3000] for i, text in enumerate(found)]


def of_choice(pairs):
    return [bytes([choice]) + text.encode("utf-8") for choice, text in pairs]


SEEDS = {
    "toml": lambda: [b"# loading.steps = 3\n" + text.encode() for text in case_texts()]
    + [text.replace("\n", "\r\n").encode() for text in case_texts()[::8]] + [TOML],
    "case": cases_in_their_folders,
    "quantity": lambda: quoted(r'"([-+0-9.][^"\n]* [^"\n]+)"') + quoted(r'unit = "([^"\n]+)"'),
    "expression": lambda: quoted(r'expr = "([^"\n]+)"'),
    "csv": tables,
    "uff": lambda: contents("tests/postproc/data/*.uff", "tests/reports/*/*.uff"),
    "wav": lambda: contents("tests/postproc/data/*.wav", "tests/reliability/inputs/*/*.wav"),
    "mat": lambda: contents("tests/reliability/inputs/*/*.mat"),
    "hdf5": lambda: contents("tests/postproc/data/*.h5", "tests/reliability/inputs/*/*.h5"),
    "gmsh": lambda: contents("tests/mesh/data/*.msh", "tests/reports/*/*.msh", "tests/reports/*/*/*.msh"),
    "surface": lambda: contents("cases/*/data/*.stl", "tests/reports/*/*.stl", "tests/reliability/inputs/*/*.stl",
                                head=b"\0") + contents("tests/reports/*/*.obj", head=b"\1"),
    "vtk": lambda: contents("tests/reliability/inputs/*/*.vtu", head=b"\0")
    + contents("tests/reports/*/*.vtk", "tests/reliability/inputs/*/*.vtk", head=b"\1"),
    "frames": lambda: [FRAMES.encode(), FRAMES.replace('part="0" ', "").encode()],
    "stored": lambda: of_choice(STORED),
    "message": lambda: [text.encode("utf-8") for text in MESSAGES],
}
