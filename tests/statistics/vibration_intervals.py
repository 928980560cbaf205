#!/usr/bin/env python3
"""How often pfdm fit finds what a record has, and how often its 95 % intervals hold the truth.

    vibration_intervals.py PFDM pair_sweep 100 --decibel 40     a sample with a conjugate pair, order left open
    vibration_intervals.py PFDM pair_random 100 --decibel 60
    vibration_intervals.py PFDM terms_random 200 --decibel 40   two real terms, noise on base and response
    vibration_intervals.py PFDM model_3 30 --decibel 40         nonlinear damping, one sweep

One clean record of each kind, by vibration_simulator.py, with other noise on both channels each time."""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from vibration_corpus import QUINTIC, two_terms, write_case
from vibration_simulator import DAMPING, STIFFNESS, Random, Sample, Sweep, integrated, linear, noisy, polynomial

PAIR = 2 * np.pi * 220.0  # [rad/s]


def with_pair(stiffness):
    return Sample(stiffness, 0.5 * DAMPING, alpha=[0.15 * PAIR + 1j * PAIR], beta=[(0.1 + 0.0045j) * STIFFNESS])


KINDS = {  # sample, base, structure
    "pair_sweep": (lambda: with_pair(polynomial(QUINTIC)), Sweep, "4b"),
    "pair_random": (lambda: with_pair([STIFFNESS]), lambda: Random(duration=20.0), "linear_4b"),
    "terms_random": (two_terms, lambda: Random(duration=20.0), "linear_4b"),
    "model_3": (lambda: Sample(polynomial(QUINTIC), DAMPING / 0.72, 1.8), Sweep, "3"),
}


def truth_of(sample):
    """By the names of fit.json."""
    values = {f"k{i + 1}_": k for i, k in enumerate(sample.k)}
    values["c_"] = sample.c
    if sample.exponent:
        values["lambda"] = sample.exponent
    for i, (alpha, beta) in enumerate(zip(sample.alpha, sample.beta)):
        values[f"alpha{i + 1}_"], values[f"beta{i + 1}_"] = np.real(alpha), np.real(beta)
        if np.imag(alpha):
            values[f"alpha{i + 1}_imag"], values[f"beta{i + 1}_imag"] = np.imag(alpha), np.imag(beta)
    return values


def named(parameters, name):
    """The estimate that begins so; "alpha1_" is not "alpha1_imaginary_per_s"."""
    for p in parameters:
        if p["name"].startswith(name) and ("imag" in p["name"]) == ("imag" in name):
            return p
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pfdm", type=pathlib.Path)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("repetitions", type=int)
    parser.add_argument("--decibel", type=float, default=40.0)
    parser.add_argument("--first-seed", type=int, default=1)
    options = parser.parse_args()
    make, base_of, structure = KINDS[options.kind]
    sample, base = make(), base_of()
    swept = isinstance(base, Sweep)
    if swept:
        y, rows = integrated([sample], base)
        z = rows[0]
    else:
        y, z = linear(sample, base)
    truth = truth_of(sample)
    found, verdicts = [], {}
    with tempfile.TemporaryDirectory() as temporary:
        for seed in range(options.first_seed, options.first_seed + options.repetitions):
            folder = pathlib.Path(temporary) / str(seed)
            write_case(folder, structure, swept, [noisy(y, z, options.decibel, seed)], replicates=500)
            subprocess.run([options.pfdm.resolve(), "fit", folder, "--quiet", "--threads", "1"], check=True,
                           stderr=subprocess.DEVNULL)
            fit = json.loads((folder / "results/fit.json").read_text(encoding="utf-8"))
            verdicts[fit["verdict"]] = verdicts.get(fit["verdict"], 0) + 1
            estimates = {name: named(fit["parameters"], name) for name in truth}
            if len(fit["parameters"]) == len(truth) and all(estimates.values()):
                found.append(estimates)
    print(f"{options.kind}, {options.decibel:g} dB: {options.repetitions} records, these terms found in {len(found)}; {verdicts}")
    for name, value in truth.items():
        errors = np.array([e[name]["estimate"] / value - 1 for e in found])
        sure = [e[name] for e in found if e[name]["lower"] is not None]
        held = sum(e["lower"] <= value <= e["upper"] for e in sure)
        if len(errors):
            print(f"  {name:14s} largest error {np.max(np.abs(errors)):.2e}, mean {np.mean(errors):+.1e}, "
                  f"rms {np.sqrt(np.mean(errors**2)):.1e}; interval held the truth in {held} of {len(sure)}")
    if options.kind.startswith("pair") and found:
        size = lambda e: np.hypot(e["alpha1_"]["estimate"], e["alpha1_imag"]["estimate"])
        ratio = lambda e: e["alpha1_"]["estimate"] / size(e)
        true_size, true_ratio = np.abs(sample.alpha[0]), np.real(sample.alpha[0]) / np.abs(sample.alpha[0])
        print(f"  frequency within {max(abs(size(e) / true_size - 1) for e in found):.2e}, "
              f"damping within {max(abs(ratio(e) / true_ratio - 1) for e in found):.2e}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
