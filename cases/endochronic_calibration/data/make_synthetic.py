#!/usr/bin/env python3
"""Makes the synthetic experiments of this case: runs the program with a known law and adds normal noise.

    cases/endochronic_calibration/data/make_synthetic.py path/to/pfdm
"""

import csv
import pathlib
import random
import subprocess
import sys
import tempfile

NOISE_PA = 0.5e6
FINER = 16  # steps of the law between two rows: its solution, not that of the rows' own increments
LAW = """
[material]
young_modulus = "117 GPa"
poisson_ratio = 0.34
kernel = [{ C = "60 GPa", alpha = 3000 }, { C = "15 GPa", alpha = 500 }, { C = "2 GPa", alpha = 30 }]
[material.hardening]
law = "saturating"
f_inf = 3.0
b = 6.0
[material.rate]
law = "logarithmic"
c = 0.02
reference_rate = "1e-5 1/s"
"""


def triangle(amplitude, period):
    """0, +amplitude at a quarter, -amplitude at three quarters of the period."""
    t = f"(t/{period}-0.25)"
    return f'{{ expr = "{amplitude}*(4*abs({t}-rint({t}))*(-1)+1)", unit = "1" }}'


EXPERIMENTS = {
    "uniaxial_slow": (800.0, 480, {"strain_xx": triangle(0.006, 100)}, ["xx"]),
    "uniaxial_fast": (0.8, 240, {"strain_xx": triangle(0.004, 0.2)}, ["xx"]),
    "torsion": (800.0, 240, {"gamma_xy": triangle(0.010, 200)}, ["xy"]),
    "biaxial": (
        400.0,
        240,
        {
            "strain_xx": '{ expr = "0.004*sin(2*pi*t/100)", unit = "1" }',
            "gamma_xy": '{ expr = "0.007*(1-cos(2*pi*t/100))", unit = "1" }',
        },
        ["xx", "xy"],
    ),
}


def run(program, duration, increments, control):
    with tempfile.TemporaryDirectory() as folder:
        text = 'kind = "endochronic"\ntitle = "synthetic"\n' + LAW
        text += f'[loading]\n[[loading.segments]]\nduration = "{duration} s"\nincrements = {FINER * increments}\n'
        text += "[loading.segments.control]\n" + "".join(f"{k} = {v}\n" for k, v in control.items())
        pathlib.Path(folder, "case.toml").write_text(text, encoding="utf-8")
        subprocess.run([program, "run", folder, "--quiet"], check=True)
        with open(pathlib.Path(folder, "results", "history.csv"), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))[::FINER]


def main():
    program = sys.argv[1]
    folder = pathlib.Path(__file__).parent
    generator = random.Random(2016)
    for name, (duration, increments, control, components) in EXPERIMENTS.items():
        rows = run(program, duration, increments, control)
        with open(folder / f"{name}.csv", "w", encoding="utf-8") as out:
            out.write("# SYNTHETIC: computed with a known endochronic law, not measured on any material.\n")
            out.write(f"# Normal noise of {NOISE_PA / 1e6} MPa was added to the stresses (make_synthetic.py).\n")
            names = ["time_s"]
            names += list(control)
            names += [f"stress_{c}_MPa" for c in components]
            out.write(",".join(names) + "\n")
            for row in rows:
                values = [f"{float(row['time_s']):.9g}"]
                for key in control:
                    strain = float(row["strain_" + key[-2:]])
                    values.append(f"{(2 * strain if key.startswith('gamma') else strain):.12g}")
                for c in components:
                    stress = float(row[f"stress_{c}_Pa"]) + generator.gauss(0.0, NOISE_PA)
                    values.append(f"{1e-6 * stress:.6f}")
                out.write(",".join(values) + "\n")


if __name__ == "__main__":
    main()
