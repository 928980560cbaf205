#!/usr/bin/env python3
"""How often the 95 % intervals of pfdm fit on an endochronic law hold the truth, over many noisy copies of one cyclic test.

    endochronic_coverage.py build/release/cases/program/pfdm hardening --noise 0.2 --number 50
    endochronic_coverage.py build/release/cases/program/pfdm staggered --noise 0.04 --number 20

The uniaxial response is integrated by SciPy from the law as an ordinary differential equation; it shares nothing with the
program. Noise is white, in per cent of the rms stress. All data are synthetic."""

import argparse
import pathlib

import numpy as np
from scipy.integrate import solve_ivp

from fits_over_seeds import Tally, options_of, repeat

E, NU = 117e9, 0.34
KERNEL = [(40e9, 2000.0), (7e9, 300.0)]  # C [Pa], alpha
F_INF, B = 1.8, 9.0
FIRST = {"hardening": (KERNEL, 1.4, 15.0), "staggered": ([(55e9, 2600.0), (5e9, 220.0)], 1.4, 15.0)}


def stress(turns, points):
    """Strains, axial stresses [Pa]: linear between the turning points. sigma = E (eps - eps_p) and, of each term,
    d sigma_r = 3 C_r d eps_p - alpha_r sigma_r dz, dz = sqrt(3/2) |d eps_p| / f(zeta)."""
    C, alpha = np.array(KERNEL).T
    strain, found, state, zeta, at = [0.0], [0.0], np.zeros(len(KERNEL)), 0.0, 0.0
    for turn in turns:
        sign = np.sign(turn - at)

        def slope(e, x):
            f = F_INF + (1.0 - F_INF) * np.exp(-B * x[-1])
            recovery = alpha * x[:-1] * np.sqrt(1.5) / f
            p = E / (E + np.sum(3 * C) - sign * np.sum(recovery))  # d eps_p / d eps
            return np.append(3 * C * p - recovery * sign * p, np.sqrt(1.5) * sign * p)

        e = np.linspace(at, turn, points + 1)
        x = solve_ivp(slope, (at, turn), np.append(state, zeta), "DOP853", e[1:], rtol=1e-10, atol=1e-4).y
        strain += list(e[1:])
        found += list(x[:-1].sum(axis=0))
        state, zeta, at = x[:-1, -1], x[-1, -1], turn
    return np.array(strain), np.array(found)


def write_case(folder, method, strain, measured, noise, increment=None):
    kernel, f_inf, b = FIRST[method]
    terms = ", ".join(f'{{ C = "{C} Pa", alpha = {alpha} }}' for C, alpha in kernel)
    text = f"""kind = "endochronic"
title = "coverage (synthetic)"
[material]
young_modulus = "{E} Pa"
poisson_ratio = {NU}
kernel = [{terms}]
[material.hardening]
law = "saturating"
f_inf = {f_inf}
b = {b}
[loading]
[[loading.segments]]
control = {{ strain_xx = {{ csv = "curve.csv", column = "strain_xx" }} }}
[fit]
method = "{method}"
{f"largest_strain_increment = {increment}" if increment else ""}
estimate = ["kernel", "hardening"]
[[fit.experiments]]
name = "cycles"
csv = "curve.csv"
strain = {{ strain_xx = {{ column = "strain_xx" }} }}
stress = {{ stress_xx = {{ column = "stress_xx_Pa", unit = "Pa", noise = "{noise} Pa" }} }}
"""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "case.toml").write_text(text, encoding="utf-8")
    time = np.arange(len(strain), dtype=float)
    np.savetxt(folder / "curve.csv", np.column_stack([time, strain, measured]), "%.12g", ",", comments="",
               header="# synthetic: simulated, not measured\ntime_s,strain_xx,stress_xx_Pa")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pfdm", type=pathlib.Path)
    parser.add_argument("method", choices=FIRST)
    parser.add_argument("--noise", type=float, default=0.2, help="per cent of the rms stress")
    parser.add_argument("--increment", type=float, help="largest_strain_increment; default: those of the curve, 4e-4 at most")
    options = options_of(parser, 20)
    amplitude = [0.002, -0.002, 0.004, -0.004, 0.006, -0.006, 0.008, -0.008, 0.008, -0.008]
    strain, clean = stress(amplitude, 40)
    deviation = options.noise / 100 * np.sqrt(np.mean(clean**2))
    truth = {"f_inf": F_INF, "b": B}
    if options.method == "staggered":
        for i, (C, alpha) in enumerate(KERNEL, 1):
            truth[f"C_{i}"], truth[f"alpha_{i}"] = C, alpha

    def noisy_case(folder, seed):
        draw = np.random.default_rng(seed)
        measured = clean + deviation * draw.standard_normal(len(clean))
        write_case(folder, options.method, strain, measured, deviation, options.increment)

    repeat(options, Tally(truth), noisy_case, every=10)


if __name__ == "__main__":
    main()
