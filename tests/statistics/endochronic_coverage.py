#!/usr/bin/env python3
"""How often the 95 % intervals of pfdm fit on an endochronic law hold the truth, over many noisy copies of its tests.

    endochronic_coverage.py build/release/cases/program/pfdm hardening --noise 0.2 --number 50
    endochronic_coverage.py build/release/cases/program/pfdm staggered --noise 0.04 --number 20
    endochronic_coverage.py build/release/cases/program/pfdm rates --noise 0.2 --number 20

hardening, staggered: one cyclic test. rates: a rate that jumps, a strain that is held, and a stress that is held, fitted at
once. The responses are integrated by SciPy from the law as ordinary differential equations, which share nothing with the
program. Noise is white, in per cent of the rms of what is measured in each test. All data are synthetic."""

import argparse
import pathlib

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from fits_over_seeds import Tally, options_of, repeat

E, NU = 117e9, 0.34


class Law:
    """Kernel [(C [Pa], alpha)], f = f_inf + (1 - f_inf) exp(-b zeta), rate factor 1 + c ln(1 + rate/reference)."""

    def __init__(self, kernel, f_inf, b, c=0.0, reference=1e-4):
        self.kernel, self.f_inf, self.b, self.c, self.reference = kernel, f_inf, b, c, reference

    def f(self, zeta, rate):
        of_path = self.f_inf + (1.0 - self.f_inf) * np.exp(-self.b * zeta)
        return of_path * (1.0 + self.c * np.log1p(rate / self.reference))

    def truth(self, with_kernel):
        values = {"f_inf": self.f_inf, "b": self.b}
        if self.c:
            values["c"] = self.c
        for i, (C, alpha) in enumerate(self.kernel, 1):
            if with_kernel:
                values[f"C_{i}"], values[f"alpha_{i}"] = C, alpha
        return values

    def toml(self):
        terms = ", ".join(f'{{ C = "{C} Pa", alpha = {alpha} }}' for C, alpha in self.kernel)
        text = f"""[material]
young_modulus = "{E} Pa"
poisson_ratio = {NU}
kernel = [{terms}]
[material.hardening]
law = "saturating"
f_inf = {self.f_inf}
b = {self.b}
"""
        if self.c:
            text += f'[material.rate]\nlaw = "logarithmic"\nc = {self.c}\nreference_rate = "{self.reference} 1/s"\n'
        return text


TRUE = Law([(40e9, 2000.0), (7e9, 300.0)], 1.8, 9.0)
TRUE_RATES = Law([(300e9, 15000.0), (30e9, 1000.0)], 1.4, 60.0, 0.1)
FIRST = {"hardening": Law(TRUE.kernel, 1.4, 15.0), "staggered": Law([(55e9, 2600.0), (5e9, 220.0)], 1.4, 15.0),
         "rates": Law([(200e9, 9000.0), (45e9, 1500.0)], 1.2, 30.0, 0.06)}


class Curve:
    """Times, what is followed, what is measured: strain and stress in tension, or stress and strain."""

    def __init__(self, name, time, strain, stress, controlled="strain"):
        self.name, self.time, self.strain, self.stress, self.controlled = name, time, strain, stress, controlled

    def measured(self):
        return self.stress if self.controlled == "strain" else self.strain

    def write(self, folder, noise, draw):
        values, deviation = self.measured(), noise * np.sqrt(np.mean(self.measured()**2))
        values = values + deviation * draw.standard_normal(len(values))
        strain, stress = (self.strain, values) if self.controlled == "strain" else (values, self.stress)
        np.savetxt(folder / f"{self.name}.csv", np.column_stack([self.time, strain, stress]), "%.12g", ",", comments="",
                   header="# synthetic: simulated, not measured\ntime_s,strain_xx,stress_xx_Pa")
        of = [f', noise = "{deviation} Pa"', ""] if self.controlled == "strain" else ["", f", noise = {deviation}"]
        return f"""[[fit.experiments]]
name = "{self.name}"
csv = "{self.name}.csv"
controlled = "{self.controlled}"
stress = {{ stress_xx = {{ column = "stress_xx_Pa", unit = "Pa"{of[0]} }} }}
strain = {{ strain_xx = {{ column = "strain_xx"{of[1]} }} }}
"""


def cycles(law, turns, points):
    """Strains linear between the turning points. sigma = E (eps - eps_p) and, of each term,
    d sigma_r = 3 C_r d eps_p - alpha_r sigma_r dz, dz = sqrt(3/2) |d eps_p| / f(zeta)."""
    C, alpha = np.array(law.kernel).T
    strain, found, state, zeta, at = [0.0], [0.0], np.zeros(len(C)), 0.0, 0.0
    for turn in turns:
        sign = np.sign(turn - at)

        def slope(e, x):
            recovery = alpha * x[:-1] * np.sqrt(1.5) / law.f(x[-1], 0.0)
            p = E / (E + np.sum(3 * C) - sign * np.sum(recovery))  # d eps_p / d eps
            return np.append(3 * C * p - recovery * sign * p, np.sqrt(1.5) * sign * p)

        e = np.linspace(at, turn, points + 1)
        x = solve_ivp(slope, (at, turn), np.append(state, zeta), "DOP853", e[1:], rtol=1e-10, atol=1e-4).y
        strain += list(e[1:])
        found += list(x[:-1].sum(axis=0))
        state, zeta, at = x[:-1, -1], x[-1, -1], turn
    return Curve("cycles", np.arange(len(strain), dtype=float), np.array(strain), np.array(found))


def in_parts(name, law, parts, controlled):
    """Tension that never turns. parts: [(rate of the controlled quantity, times)] from part to part. The plastic rate p is
    the largest root of E (eps' - p) = 3 sum C p - sum alpha sigma_r zeta'/f, or sigma' = the right side,
    zeta' = sqrt(3/2) p."""
    C, alpha = np.array(law.kernel).T
    k, grid = np.sqrt(1.5), np.logspace(-14, 3, 300)

    def plastic_rate(s, zeta, rate):
        recovery = np.sum(alpha * s)
        drive, hold = (E * rate, E) if controlled == "strain" else (rate, 0.0)
        balance = lambda p: drive - (hold + 3 * C.sum()) * p + recovery * k * p / law.f(zeta, k * p)
        signs = balance(grid) > 0.0
        falls = np.flatnonzero(signs[:-1] & ~signs[1:])
        return brentq(balance, grid[falls[-1]], grid[falls[-1] + 1], xtol=1e-30, rtol=1e-13) if len(falls) else 0.0

    def slope(_, x, rate):
        p = plastic_rate(x[:-2], x[-2], rate)
        ds = 3 * C * p - alpha * x[:-2] * k * p / law.f(x[-2], k * p)
        return np.concatenate([ds, [k * p, rate if controlled == "strain" else ds.sum() / E + p]])

    x = np.zeros(len(C) + 2)
    rows, tolerance = [[0.0, 0.0, 0.0]], [1.0] * len(C) + [1e-12, 1e-12]
    for rate, times in parts:
        begin = rows[-1][0]
        found = solve_ivp(slope, (0.0, times[-1]), x, "LSODA", times, rtol=1e-9, atol=tolerance, args=(rate,))
        rows += [[begin + t, y[-1], y[:-2].sum()] for t, y in zip(times, found.y.T)]
        x = found.y[:, -1]
    return Curve(name, *np.array(rows).T, controlled)


def curves(study):
    if study != "rates":
        return [cycles(TRUE, [0.002, -0.002, 0.004, -0.004, 0.006, -0.006, 0.008, -0.008, 0.008, -0.008], 40)]
    ramp = lambda duration: duration * np.arange(1, 101) / 100
    held = np.geomspace(1e-3, 1000.0, 200)
    return [in_parts("rate_jump", TRUE_RATES, [(1e-4, ramp(60.0)), (1e-2, ramp(0.6)), (1e-4, ramp(60.0))], "strain"),
            in_parts("relaxation", TRUE_RATES, [(1e-2, ramp(1.0)), (0.0, held)], "strain"),
            in_parts("creep", TRUE_RATES, [(140e6, ramp(1.0)), (0.0, held)], "stress")]


def write_case(folder, study, tests, noise, seed, substeps, increment):
    draw = np.random.default_rng(seed)
    text = f'kind = "endochronic"\ntitle = "coverage (synthetic)"\n{FIRST[study].toml()}'
    text += f"""[loading]
[[loading.segments]]
control = {{ strain_xx = {{ csv = "{tests[0].name}.csv", column = "strain_xx" }} }}
[fit]
method = "{'joint' if study == 'rates' else study}"
substeps = {substeps}
{f"largest_strain_increment = {increment}" if increment else ""}
estimate = ["kernel", "hardening"{', "rate"' if study == "rates" else ""}]
"""
    folder.mkdir(parents=True, exist_ok=True)
    text += "".join(test.write(folder, noise, draw) for test in tests)
    (folder / "case.toml").write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pfdm", type=pathlib.Path)
    parser.add_argument("study", choices=FIRST)
    parser.add_argument("--noise", type=float, default=0.2, help="per cent of the rms")
    parser.add_argument("--increment", type=float, help="largest_strain_increment; default: none")
    parser.add_argument("--substeps", type=int, default=1, help="of the curves' increments, of cycles 4e-4 at most")
    options = options_of(parser, 20)
    law, tests = TRUE_RATES if options.study == "rates" else TRUE, curves(options.study)
    repeat(options, Tally(law.truth(options.study != "hardening")),
           lambda folder, seed: write_case(folder, options.study, tests, options.noise / 100, seed, options.substeps,
                                           options.increment),
           every=10)


if __name__ == "__main__":
    main()
