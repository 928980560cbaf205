"""Files of every format that the program reads, damaged in the same ways."""

import math
import random
import re
import shutil
import struct
import subprocess
from pathlib import Path

IMPORT = """kind = "fracture"
title = "imported"
[mesh]
generator = "{generator}"
file = "{file}"
length_unit = "mm"
[materials.m]
regions = ["{region}"]
young_modulus = "30 GPa"
poisson_ratio = 0.2
toughness = "100 J/m^2"
[fracture]
model = "AT1"
length = "4 mm"
[[boundary]]
patch = "xmin"
displacement = ["0 mm", "0 mm", "0 mm"]
[[boundary]]
patch = "xmax"
displacement = ["0.002 mm", "free", "free"]
[loading]
initial_increment = 0.5
maximum_increment = 0.5
[output]
curve = {{ patch = "xmax", component = "x" }}
"""

RECORD = """kind = "mass_material"
title = "a record"
[model]
structure = "1"
mass = "1 kg"
stiffness = ["1.5e4 N/m"]
damping = "8 N s/m"
[sampling]
rate = "{rate}"
[[test]]
name = "up"
record = {{ file = "{file}", base = "{base}", relative = "{relative}", unit = "m/s^2", from = "{start}", to = "{end}" }}
[fit]
method = "output_error"
"""


def matlab_matrix(name, values):
    """A variable of a .mat file of version 5: a column of doubles."""

    def element(kind, data):
        return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)

    body = element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", len(values), 1))
    body += element(1, name.encode()) + element(9, struct.pack(f"<{len(values)}d", *values))
    return element(14, body)


def matlab_file(columns):
    head = b"MATLAB 5.0 MAT-file, made by a test".ljust(124) + struct.pack("<HH", 0x0100, 0x4D49)
    return head + b"".join(matlab_matrix(name, values) for name, values in columns.items())


def make_records(folder, data):
    time = [0.005 * i for i in range(400)]
    columns = {"t": time, "base": [math.sin(60 * t) for t in time], "rel": [0.5 * math.cos(60 * t) for t in time]}
    (folder / "r.mat").write_bytes(matlab_file(columns))
    rows = "\n".join(",".join(repr(columns[name][i]) for name in columns) for i in range(len(time)))
    (folder / "r.csv").write_text("t [s],base [m/s^2],rel [m/s^2]\n" + rows + "\n")
    for suffix, source in (("h5", data / "records.h5"), ("wav", data / "float.wav"), ("uff", data / "binary_even.uff")):
        shutil.copy(source, folder / f"r.{suffix}")
    shutil.copy(data / "text_uneven.uff", folder / "r.unv")
    for suffix in ("mat", "csv", "h5", "wav", "uff", "unv"):
        case = RECORD.format(rate="200 Hz", file=f"r.{suffix}", base="base", relative="rel", start="1 Hz", end="50 Hz")
        yield f"r.{suffix}", case, ["analyse"]


def make_meshes(folder, repository, program):
    bar = folder / "made"
    bar.mkdir()
    shutil.copy(repository / "cases/bar_at2/case.toml", bar / "case.toml")
    subprocess.run([program, "mesh", bar], check=True, capture_output=True)
    shutil.copy(bar / "results/mesh.vtu", folder / "m.vtu")
    shutil.copy(repository / "tests/reports/05_vtk_prisms_5_6/prism6.vtk", folder / "m.vtk")
    yield "m.vtu", IMPORT.format(generator="vtk", file="m.vtu", region="region_0"), ["check"]
    yield "m.vtk", IMPORT.format(generator="vtk", file="m.vtk", region="region_1"), ["check"]
    for name in ("shapes_41_text", "shapes_41_binary", "shapes_22_text", "shapes_22_binary"):
        shutil.copy(repository / f"tests/mesh/data/{name}.msh", folder / f"{name}.msh")
        yield f"{name}.msh", IMPORT.format(generator="gmsh", file=f"{name}.msh", region="region_1"), ["check"]
    surfaces = repository / "tests/reports/09_obj_points_of_each_face"
    for name, case in (("cube.obj", "case.toml"), ("cube.stl", "stl.toml")):
        shutil.copy(surfaces / name, folder / name)
        yield name, (surfaces / case).read_text(), ["check"]


def make_tables(folder, repository):
    for name, file in (
        ("bar_fit", "data/synthetic_force_displacement.csv"),
        ("endochronic_calibration", "data/torsion.csv"),
        ("plate_fit", "data/synthetic_H1.csv"),
    ):
        source = repository / "cases" / name
        shutil.copytree(source / "data", folder / "data", dirs_exist_ok=True)
        yield file, (source / "case.toml").read_text(), ["check"]
    text = (repository / "cases/bar_at2/case.toml").read_text()
    (folder / "x.json").write_text('{"a": {"young_modulus_Pa": 3e10, "list": [1, 2.5, {"b": "text"}]}, "unit": "Pa"}')
    taken = '{ from = "x.json", key = "a.young_modulus_Pa" }'
    yield "x.json", text.replace('young_modulus = "30 GPa"', f"young_modulus = {taken}"), ["check"]


def short_run(folder, repository, program):
    """A run of three steps, to be continued; the files that a restart reads."""
    text = (repository / "cases/bar_at2/case.toml").read_text().replace("cells = 201", "cells = 21")
    (folder / "case.toml").write_text(text.replace("end = 1.0", "end = 0.05"))
    subprocess.run([program, "run", folder, "--max-steps", "3"], check=True, capture_output=True)
    for file in ("checkpoint.bin", "force_displacement.csv", "fields.pvd"):
        yield f"results/{file}", None, ["run", "--restart"]


def replaced_number(content, by):
    """The middle number of a text file is another."""
    numbers = list(re.finditer(rb"(?<![\w.])-?\d+\.?\d*(?:[eE][-+]?\d+)?", content))
    if not numbers:
        return content + by
    found = numbers[len(numbers) // 2]
    return content[: found.start()] + by + content[found.end() :]


def damages(content, seed):
    """(what, bytes) of a damaged file."""
    size = len(content)
    chance = random.Random(seed)
    for part in (0.0, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98):
        yield f"cut at {part:g}", content[: int(part * size)]
    yield "without its last byte", content[:-1]
    for i in range(14):
        at = chance.randrange(size if i % 2 else min(size, 300))
        flipped = bytes([content[at] ^ (1 << chance.randrange(8))])
        yield f"bit flipped at {at}", content[:at] + flipped + content[at + 1 :]
    for i in range(6):
        at, n = chance.randrange(size), chance.randrange(1, 64)
        byte = (b"\0", b"\xff", b"9")[i % 3]
        yield f"{n} bytes {byte!r} at {at}", content[:at] + byte * n + content[at + n :]
    half = size // 2
    yield "a block removed", content[: size // 3] + content[half:]
    yield "halves exchanged", content[half:] + content[:half]
    yield "twice", content + content
    yield "a long line", content[:half] + b"7" * 1_000_000 + content[half:]
    yield "many blanks", content[:half] + b" " * 1_000_000 + content[half:]
    yield "not UTF-8", content[:half] + b"l\xe4tin" + content[half:]
    for number in (b"nan", b"1e300", b"-1e-320", b"99999999999999999999", b"-1", b"1e999"):
        yield f"a number is {number.decode()}", replaced_number(content, number)
    yield "other bytes", bytes(chance.randrange(256) for _ in range(2000))
    yield "empty lines", b"\n" * 5000
