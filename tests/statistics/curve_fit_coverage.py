#!/usr/bin/env python3
"""How often the 95 % intervals of pfdm fit hold the truth.

A case is run with known values of its [[fit.parameters]], its curve gets noise of 2 % of the largest force
(postproc/plots/make_synthetic.py), and the case is fitted to it from its own values; again and again with other noise. All
fits share their runs. KEY may be any value of the case: the truth may have finer load steps.

    curve_fit_coverage.py build/release/cases/program/pfdm cases/bar_fit 20 \
        "materials.concrete.young_modulus=32 GPa" "materials.concrete.strength,regions.weak.strength=2.8 MPa" ...
"""

import argparse
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pfdm", type=pathlib.Path)
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("repetitions", type=int)
    parser.add_argument("truth", nargs="+", help="KEY=VALUE, or KEY,KEY=VALUE")
    parser.add_argument("--component", default="x", help="of the force")
    parser.add_argument("--spacing", type=float, default=1.0, help="of the measured points [um]")
    parser.add_argument("--first-seed", type=int, default=1, help="of the noise")
    parser.add_argument("--threads", type=int, default=1, help="of a fit: so many runs at a time")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for runs and fits, to go on from; default: none")
    return parser.parse_args()


def toml_value(value):
    try:
        return str(float(value))
    except ValueError:
        return f'"{value}"'


def sweep_of(truth):
    text = '\n[sweep]\nmethod = "list"\n'
    for entry in truth:
        keys, value = entry.split("=")
        quoted = ", ".join(f'"{key}"' for key in keys.split(","))
        text += f"[[sweep.parameters]]\nkey = [{quoted}]\nvalues = [{toml_value(value)}]\n"
    return text


def true_run(options, folder):
    """Values by name [SI], and the file of the curve."""
    text = (options.case / "case.toml").read_text(encoding="utf-8")
    (folder / "case.toml").write_text(text + sweep_of(options.truth), encoding="utf-8")
    subprocess.run([options.pfdm, "sweep", folder, "--quiet"], check=True)
    (folder / "case.toml").write_text(text, encoding="utf-8")
    table = (folder / "results/sweep.csv").read_text(encoding="utf-8")
    run = folder / "results" / re.search(r"# run 1: ([^\s,]+)", table).group(1)
    rows = [line for line in table.splitlines() if not line.startswith("#")]
    values = dict(zip(rows[0].split(","), map(float, rows[1].split(","))))
    return values, run / "force_displacement.csv"


def fit_with_noise(options, folder, curve, seed):
    """Its fit.json. All fits have one folder of results, whose runs they share."""
    case = folder / f"seed_{seed}"
    if not case.exists():
        shutil.copytree(options.case, case, ignore=shutil.ignore_patterns("results"))
        text = (case / "case.toml").read_text(encoding="utf-8")
        # Profiles and posteriors take runs, and the mesh is that of the truth: neither is counted here.
        text = re.sub('intervals = "(profile|posterior)"', 'intervals = "linear"', re.sub("(?m)^finer = .*$", "", text))
        (case / "case.toml").write_text(text, encoding="utf-8")
    script = pathlib.Path(__file__).parents[2] / "postproc/plots/make_synthetic.py"
    subprocess.run([sys.executable, script, curve, f"force_{options.component}_N", "force_N", ", ".join(options.truth),
                    "--spacing", str(options.spacing), "--seed", str(seed),
                    "--output", case / "data/synthetic_force_displacement.csv"], check=True)
    done = subprocess.run([options.pfdm, "fit", case, "--quiet", "--threads", str(options.threads),
                           "--output", folder / "results"], check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return json.loads((folder / "results/fit.json").read_text(encoding="utf-8"))


class Count:
    def __init__(self, truth):
        self.truth, self.held, self.errors, self.stated, self.runs, self.verdicts = truth, {}, {}, {}, [], []

    def add(self, seed, fit):
        self.runs.append(fit["fracture"]["runs"]["made"])
        print(f"seed {seed}: rms residual {fit['rms_residual']:.4f}, {fit['fracture']['runs']['made']} runs made, "
              f"{fit['verdict']}", flush=True)
        self.verdicts.append(fit["verdict"])
        if not fit["verdict"].startswith("sound"):
            print(f"    {'; '.join(fit['reasons'])}", flush=True)
            return
        for p in fit["parameters"]:
            true = next(value for name, value in self.truth.items() if name.startswith(p["name"]))
            held = p["lower"] <= true <= p["upper"]
            self.held.setdefault(p["name"], []).append(held)
            self.errors.setdefault(p["name"], []).append(p["estimate"] / true - 1.0)
            self.stated.setdefault(p["name"], []).append(p["standard_error"] / p["estimate"])
            print(f"    {p['name']}: {p['estimate']:.6g}, {p['lower']:.6g} to {p['upper']:.6g}"
                  f"{'' if held else ' MISSES'}", flush=True)

    def show(self):
        for name, held in self.held.items():
            e, s = self.errors[name], self.stated[name]
            print(f"{name}: held {sum(held)} of {len(held)}; error: mean {100 * sum(e) / len(e):+.2f} %, "
                  f"rms {100 * math.sqrt(sum(x * x for x in e) / len(e)):.2f} %, "
                  f"largest {100 * max(map(abs, e)):.2f} %; stated {100 * sum(s) / len(s):.2f} %")
        print(f"{self.verdicts.count('sound')} of {len(self.verdicts)} fits are sound; {sum(self.runs)} runs made", flush=True)


def main():
    options = arguments()
    options.pfdm = options.pfdm.absolute()
    folder = options.keep.absolute() if options.keep else pathlib.Path(tempfile.mkdtemp())
    shutil.copytree(options.case, folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("results"))
    truth, curve = true_run(options, folder)
    count = Count(truth)
    for seed in range(options.first_seed, options.first_seed + options.repetitions):
        count.add(seed, fit_with_noise(options, folder, curve, seed))
    count.show()
    if not options.keep:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
