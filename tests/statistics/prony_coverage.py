#!/usr/bin/env python3
"""How often the 95 % intervals of pfdm fit on Prony branches hold the truth, over many noisy copies of the tests.

    prony_coverage.py build/release/cases/program/pfdm joint --number 100
    prony_coverage.py build/release/cases/program/pfdm relaxation --number 100
    prony_coverage.py build/release/cases/program/pfdm dma --lowest 0.001 --number 100
    prony_coverage.py build/release/cases/program/pfdm joint --unstated --number 100

Relaxation in shear by the closed form of a ramp that is held, DMA by that of harmonic motion. The number of branches is left
open. Noise is white: of the relaxation in per cent of the largest stress, of DMA of each value; --unstated: the case does not
say it. All data are synthetic."""

import argparse
import pathlib

import numpy as np

from fits_over_seeds import Tally, options_of, repeat

E, NU = 3e6, 0.49
MU, MODULI, TIMES = E / (2 * (1 + NU)), np.array([1.5e6, 0.8e6, 0.4e6]), np.array([0.05, 2.0, 60.0])
GAMMA, RAMP = 0.05, 0.05


def relaxation(held):
    """Times, strains, stresses."""
    t = np.concatenate([np.linspace(0.0, RAMP, 11), RAMP + np.geomspace(0.01, held, 150)])
    strain = GAMMA * np.minimum(t / RAMP, 1.0)
    rise, rest = np.minimum(t, RAMP)[:, None], np.maximum(t - RAMP, 0.0)[:, None]
    parts = MODULI * GAMMA * TIMES / RAMP * -np.expm1(-rise / TIMES) * np.exp(-rest / TIMES)
    return t, strain, MU * strain + parts.sum(axis=1)


def dma(lowest):
    """Frequencies [Hz], storage and loss moduli."""
    f = np.geomspace(lowest, 100.0, round(10 * np.log10(100.0 / lowest)) + 1)
    x = 2j * np.pi * f[:, None] * TIMES
    M = MU + (MODULI * x / (1 + x)).sum(axis=1)
    return f, M.real, M.imag


def write_table(file, header, columns):
    np.savetxt(file, np.column_stack(columns), "%.12g", ",", comments="",
               header="# synthetic: simulated, not measured\n" + header)


def write_case(folder, options, seed):
    draw, text = np.random.default_rng(seed), ""
    said = lambda words: "" if options.unstated else words
    folder.mkdir(parents=True, exist_ok=True)
    if options.study != "dma":
        t, strain, stress = relaxation(options.held)
        deviation = options.noise / 100 * stress.max()
        write_table(folder / "relaxation.csv", "time_s,strain,stress_Pa",
                    [t, strain, stress + deviation * draw.standard_normal(len(t))])
        noise = said(f', noise = "{deviation} Pa"')
        text += f"""[[fit.experiments]]
name = "relaxation"
csv = "relaxation.csv"
deformation = "shear"
strain = {{ column = "strain" }}
stress = {{ column = "stress_Pa"{noise} }}
"""
    if options.study != "relaxation":
        f, storage, loss = dma(options.lowest)
        noisy = lambda value: value * (1 + options.dma_noise / 100 * draw.standard_normal(len(f)))
        write_table(folder / "dma.csv", "f_Hz,storage_Pa,loss_Pa", [f, noisy(storage), noisy(loss)])
        noise = said(f", relative_noise = {options.dma_noise / 100}")
        text += f"""[[fit.experiments]]
name = "DMA"
csv = "dma.csv"
deformation = "shear"
frequency = {{ column = "f_Hz" }}
storage_modulus = {{ column = "storage_Pa"{noise} }}
loss_modulus = {{ column = "loss_Pa"{noise} }}
"""
    (folder / "case.toml").write_text(f"""kind = "viscoelastic"
title = "coverage (synthetic)"
[material]
young_modulus = "1 MPa"
poisson_ratio = {NU}
[frequency_sweep]
from = "1 Hz"
to = "10 Hz"
[fit]
branches = [1, {options.most}]
{text}""", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pfdm", type=pathlib.Path)
    parser.add_argument("study", choices=["joint", "relaxation", "dma"])
    parser.add_argument("--noise", type=float, default=1.0, help="of the relaxation, per cent of the largest stress")
    parser.add_argument("--dma-noise", type=float, default=2.0, help="of DMA, per cent of each value")
    parser.add_argument("--held", type=float, default=600.0, help="duration of the relaxation, s")
    parser.add_argument("--lowest", type=float, default=0.01, help="frequency of DMA, Hz")
    parser.add_argument("--most", type=int, default=5, help="branches that are tried")
    parser.add_argument("--unstated", action="store_true", help="the case does not say the noise")
    options = options_of(parser, 100)
    truth = {"young_modulus": E}
    for i, (modulus, time) in enumerate(zip(MODULI, TIMES), 1):
        truth[f"modulus_{i}"], truth[f"time_{i}"] = modulus, time
    repeat(options, Tally(truth), lambda folder, seed: write_case(folder, options, seed), every=50)


if __name__ == "__main__":
    main()
