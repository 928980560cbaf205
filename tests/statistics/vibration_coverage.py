#!/usr/bin/env python3
"""How often the 95 % intervals of pfdm fit on vibration records hold the truth, over many noisy copies of one test.

    vibration_coverage.py build/release/cases/program/pfdm pairs_sweep --decibel 60 --number 100
    vibration_coverage.py build/release/cases/program/pfdm pairs_random --decibel 40 --number 100
    vibration_coverage.py build/release/cases/program/pfdm base_noise --number 200

Noise of the same level, relative to the rms of each channel, is added to base and response. The records are those of
vibration_simulator.py, which shares nothing with the program. All are synthetic."""

import argparse
import pathlib

import numpy as np
from scipy.io import savemat

from fits_over_seeds import Tally, options_of, repeat
from vibration_corpus import QUINTIC
from vibration_simulator import (DAMPING, MASS, RATE, STIFFNESS, VELOCITY, Random, Sample, Sweep, integrated, noisy,
                                 polynomial, steady_random)

OMEGA_PAIR = 2 * np.pi * 220.0
PAIR = {"alpha": [0.15 * OMEGA_PAIR + 1j * OMEGA_PAIR], "beta": [(0.1 + 0.0045j) * STIFFNESS]}


class Study:
    """Clean records, the model that is fitted and its true parameters."""

    def __init__(self, structure, sample, records, base, order):
        self.structure, self.sample, self.records, self.base, self.order = structure, sample, records, base, order

    def truth(self):
        s = self.sample
        values = {f"k{i + 1}_N_per_m{'' if i == 0 else i + 1}": k for i, k in enumerate(s.k)}
        values["c_N_s_per_m"] = s.c
        for i, (alpha, beta) in enumerate(zip(s.alpha, s.beta), 1):
            values[f"alpha{i}_per_s"], values[f"beta{i}_N_per_m"] = np.real(alpha), np.real(beta)
            if np.imag(alpha):
                values[f"alpha{i}_imaginary_per_s"] = np.imag(alpha)
                values[f"beta{i}_imaginary_N_per_m"] = np.imag(beta)
        return values


def pairs_sweep(_):
    sample = Sample(polynomial(QUINTIC), 0.5 * DAMPING, **PAIR)
    y, rows = integrated([sample], Sweep())
    return Study("4b", sample, [(y, rows[0])], Sweep(), "auto")


def pairs_random(options):
    sample = Sample([STIFFNESS], 0.5 * DAMPING, **PAIR)
    return Study("linear_4b", sample, [steady_random(sample, 60.0, options.duration, 1)], Random, "auto")


def base_noise(options):
    """The sample and the two levels of cases/pbx_random, 20 to 850 Hz."""
    sample = Sample([2.4e6], 70.0, alpha=[300.0, 3000.0], beta=[3.0e5, 6.0e5])
    records = [steady_random(sample, level, options.duration, seed) for seed, level in ((1, 35.0), (3, 64.0))]
    return Study("linear_4b", sample, records, Random, 2)


STUDIES = {"pairs_sweep": pairs_sweep, "pairs_random": pairs_random, "base_noise": base_noise}


def write_case(folder, study, decibel, seed):
    folder.mkdir(parents=True, exist_ok=True)
    text = f'kind = "mass_material"\ntitle = "coverage (synthetic)"\n[model]\nstructure = "{study.structure}"\n'
    text += f'mass = "{MASS} kg"\nreference_velocity = "{VELOCITY} m/s"\n[sampling]\nrate = "{RATE} Hz"\n'
    for i, (y, z) in enumerate(study.records):
        y, z = noisy(y, z, decibel, 100 * seed + i)
        savemat(folder / f"record_{i}.mat", {"base_acceleration": y, "relative_acceleration": z})
        text += f'[[test]]\nname = "test_{i}"\nrecord = {{ file = "record_{i}.mat", unit = "m/s^2", '
        text += f'rate = "{RATE} Hz", from = "{study.base.low} Hz", to = "{study.base.high} Hz" }}\n'
    order = f'"{study.order}"' if isinstance(study.order, str) else study.order
    (folder / "case.toml").write_text(f"{text}[fit]\nkernel_order = {order}\n", encoding="utf-8")


def errors_of_pair(found, truth):
    """Of frequency |alpha|, damping Re(alpha) and k1, relative."""
    frequency = lambda p: abs(p["alpha1_per_s"] + 1j * p["alpha1_imaginary_per_s"])
    return {"frequency": frequency(found) / frequency(truth) - 1,
            "damping": found["alpha1_per_s"] / truth["alpha1_per_s"] - 1,
            "k1": found["k1_N_per_m"] / truth["k1_N_per_m"] - 1}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pfdm", type=pathlib.Path)
    parser.add_argument("study", choices=STUDIES)
    parser.add_argument("--decibel", type=float, default=40.0)
    parser.add_argument("--duration", type=float, default=24.0, help="of random motion [s]")
    options = options_of(parser, 100)
    study = STUDIES[options.study](options)
    tally = Tally(study.truth(), errors_of_pair if options.study.startswith("pairs") else None)
    repeat(options, tally, lambda folder, seed: write_case(folder, study, options.decibel, seed))


if __name__ == "__main__":
    main()
