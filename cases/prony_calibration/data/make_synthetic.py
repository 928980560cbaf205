#!/usr/bin/env python3
"""Makes the synthetic tests of this case: a known Prony series as ordinary differential equations of its branches, which
share nothing with the program, with normal noise.

    cases/prony_calibration/data/make_synthetic.py
"""

import pathlib

import numpy as np
from scipy.linalg import expm

E, NU = 2e6, 0.49  # relaxed
MODULI, TIMES = np.array([2.0e6, 0.8e6, 0.4e6]), np.array([0.02, 1.0, 40.0])
MU, K = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
NOISE_STRESS, NOISE_STRAIN, NOISE_DMA = 1e3, 3e-5, 0.02  # Pa, 1, parts of the value


def slopes(follows_stress):
    """Matrix of d[x, input]/dt with the input's rate last, and the row that gives the answer. x: viscous strains of the
    branches, of the axial deviator e; s = 2 mu_0 e - sum 2 mu_i x_i, stress = 3/2 s, strain = e + s/(6 K)."""
    n, mu_0 = len(TIMES), MU + MODULI.sum()
    if follows_stress:  # e = (s + sum 2 mu_i x_i)/(2 mu_0), s = 2/3 stress
        e = np.append(MODULI / mu_0, 1 / (3 * mu_0))
        answer = e + np.append(np.zeros(n), 1 / (9 * K))
    else:  # s = (2 mu_0 strain - sum 2 mu_i x_i)/(1 + mu_0/(3 K))
        s = np.append(-2 * MODULI, 2 * mu_0) / (1 + mu_0 / (3 * K))
        e = np.append(np.zeros(n), 1.0) - s / (6 * K)
        answer = 1.5 * s
    matrix = np.zeros((n + 2, n + 2))
    matrix[:n, :n + 1] = e / TIMES[:, None]
    matrix[:n, :n] -= np.diag(1 / TIMES)
    matrix[n, n + 1] = 1.0
    return matrix, answer


def tension(time, given, follows_stress=False):
    """Stress of a strain, or strain of a stress, that is linear between the times."""
    matrix, answer = slopes(follows_stress)
    x, found = np.zeros(len(TIMES) + 1), [0.0]
    for dt, change in zip(np.diff(time), np.diff(given)):
        x = (expm(matrix * dt) @ np.append(x, change / dt))[:-1]
        found.append(answer @ x)
    return np.array(found)


def write(name, remark, header, columns):
    text = (f"# SYNTHETIC: computed with a known Prony series, not measured on any material ({remark}).\n"
            "# Normal noise was added (make_synthetic.py).\n" + header + "\n")
    rows = "".join(",".join(f"{value:.7g}" for value in row) + "\n" for row in zip(*columns))
    (pathlib.Path(__file__).parent / name).write_text(text + rows, encoding="utf-8")


def main():
    draw = np.random.default_rng(52)
    ramp = np.linspace(0.0, 0.1, 21)
    held = np.concatenate([ramp, 0.1 + np.geomspace(0.01, 300.0, 130)])
    strain = 0.03 * np.minimum(held / 0.1, 1.0)
    stress = tension(held, strain) + NOISE_STRESS * draw.standard_normal(len(held))
    write("relaxation.csv", "tension to 3 % within 0.1 s, then held", "time_s,strain_%,stress_kPa",
          [held, 100 * strain, 1e-3 * stress])
    stress = 60e3 * np.minimum(held / 0.1, 1.0)
    strain = tension(held, stress, True) + NOISE_STRAIN * draw.standard_normal(len(held))
    write("creep.csv", "tension of 60 kPa within 0.1 s, then held", "time_s,strain_%,stress_kPa",
          [held, 100 * strain, 1e-3 * stress])
    time = np.linspace(0.0, 0.5, 101)
    stress = tension(time, 0.1 * time) + NOISE_STRESS * draw.standard_normal(len(time))
    write("constant_rate.csv", "tension at 0.1 1/s", "time_s,strain_%,stress_kPa", [time, 10 * time, 1e-3 * stress])
    f = np.geomspace(0.005, 50.0, 61)
    x = 2j * np.pi * f[:, None] * TIMES
    G = MU + (MODULI * x / (1 + x)).sum(axis=1)
    noisy = lambda value: value * (1 + NOISE_DMA * draw.standard_normal(len(f)))
    write("dma.csv", "shear", "Frequency,Storage modulus,tan(delta)\nHz,MPa,-",
          [f[::-1], noisy(1e-6 * G.real)[::-1], noisy(G.imag / G.real)[::-1]])  # swept down


if __name__ == "__main__":
    main()
