#!/usr/bin/env python3
"""Makes the synthetic tests of this case, and what they would be without noise at a rate that is not fitted. The binder
has a continuous spectrum, a power law in time,

    G(t) = G_rest + G_1 (1 + t/t_0)^-n = G_rest + G_1 t_0^n / Gamma(n) int_0^inf s^(n-1) exp(-s t_0) exp(-s t) ds,

and a constant bulk modulus. The integral is a sum over 391 rates s, which shares nothing with the branches of the fit.

    cases/binder_rates/data/make_synthetic.py
"""

import pathlib
import re

import numpy as np
from scipy.special import gamma

G_REST, G_1, T_0, N = 0.4e6, 2e6, 1e-2, 0.35  # Pa, Pa, s, -; chosen, of the order of an unfilled HTPB binder
NU = 0.499  # relaxed
K = 2 * G_REST * (1 + NU) / (3 * (1 - 2 * NU))
NOISE_STRESS, NOISE_DMA = 1.5e3, 0.02  # Pa, parts of the value
RATES = {"slow": 2.5e-4, "medium": 2.5e-3, "fast": 2.5e-2, "faster": 2.5e-1}  # 1/s
FIFTH, LARGEST = 2.5, 0.05  # 1/s, strain


def spectrum(per_decade, lowest, highest):
    """Rates s [1/s] and moduli [Pa] of the integral by the trapezoidal rule in ln s."""
    s = 10.0 ** np.arange(np.log10(lowest), np.log10(highest), 1.0 / per_decade)
    return s, G_1 * (T_0 * s) ** N * np.exp(-s * T_0) / gamma(N) * np.log(10.0) / per_decade


S, MODULI = spectrum(23, 1e-12, 1e5)
for t in (0.0, 1e-3, 1.0, 1e3):
    assert abs((MODULI * np.exp(-S * t)).sum() / (G_1 * (1 + t / T_0) ** -N) - 1) < 1e-3, t


def tension(time, strain, substeps=20):
    """Stress of a strain that is linear between the times: deviator e = 2/3 (strain - lateral), s = 2 G_rest e + sum q,
    q' + S q = 2 G e', lateral stress K tr - s/2 = 0."""
    q, e, stress = np.zeros_like(S), 0.0, [0.0]
    for k in range(1, len(time)):
        h = (time[k] - time[k - 1]) / substeps
        decay = np.exp(-S * h)
        share = np.where(S * h > 1e-8, -np.expm1(-S * h) / np.maximum(S * h, 1e-300), 1.0)
        stiff = 2 * G_REST + (2 * MODULI * share).sum()  # of s with e at the end of the substep
        for i in range(1, substeps + 1):
            total = strain[k - 1] + (strain[k] - strain[k - 1]) * i / substeps
            known = (decay * q).sum() - (2 * MODULI * share).sum() * e
            # e = 2/3 (total - lateral), K (total + 2 lateral) = s/2, s = stiff e + known
            new = (6 * K * total - known) / (6 * K + stiff)
            lateral = total - 1.5 * new
            q = decay * q + 2 * MODULI * share * (new - e)
            e = new
        s = 2 * G_REST * e + q.sum()
        stress.append(1.5 * s)
        assert abs(K * (total + 2 * lateral) - 0.5 * s) < 1e-6 * (abs(s) + 1.0)
    return np.array(stress)


def complex_modulus(f):
    x = 2j * np.pi * f[:, None] / S
    return G_REST + (MODULI * x / (1 + x)).sum(axis=1)


def write(name, remark, header, columns, noise=True):
    text = (f"# SYNTHETIC: computed with a power-law spectrum, not measured on any material ({remark}).\n"
            + ("# Normal noise was added" if noise else "# Without noise") + " (make_synthetic.py).\n" + header + "\n")
    rows = "".join(",".join(f"{value:.7g}" for value in row) + "\n" for row in zip(*columns))
    (pathlib.Path(__file__).parent / name).write_text(text + rows, encoding="utf-8")


def write_truth_block():
    """The block with the true spectrum, two branches a decade, in place of the estimates. Of t from 20 us to 20 s the sum
    is G(t) within 0.1 %; what is slower is at rest for ever there, what is faster has gone."""
    s, moduli = spectrum(2, 1e-12, 10**3.4)
    for t in np.geomspace(2e-5, 20.0, 20):
        assert abs((G_REST + (moduli * np.exp(-s * t)).sum()) / (G_REST + G_1 * (1 + t / T_0) ** -N) - 1) < 1e-3, t
    slow = s < 1e-3
    rest = G_REST + moduli[slow].sum()
    young, nu = 9 * K * rest / (3 * K + rest), (3 * K - 2 * rest) / (6 * K + 2 * rest)
    branches = "".join(f'  {{ modulus = "{m:.9g} Pa", time = "{1 / r:.9g} s" }},\n'
                       for r, m in zip(s[~slow], moduli[~slow]))
    here = pathlib.Path(__file__).parent
    text = (here.parent / "block/case.toml").read_text(encoding="utf-8")
    begin, end = text.index("young_modulus"), text.index("damageable")
    text = text[:begin] + (f'young_modulus = "{young:.9g} Pa"\npoisson_ratio = {nu:.9g}\n'
                           f"shear_branches = [\n{branches}]\n") + text[end:]
    text = re.sub("# estimates of pfdm fit.*", "# SYNTHETIC: the spectrum of data/make_synthetic.py", text)
    text = text.replace("at a rate that was not fitted, 2.5 1/s", "with its true spectrum, 2.5 1/s")
    (here.parent / "block_true/case.toml").write_text(text, encoding="utf-8")


def main(seed=71):
    draw = np.random.default_rng(seed)
    for name, rate in RATES.items():
        time = np.linspace(0.0, LARGEST / rate, 101)
        stress = tension(time, rate * time) + NOISE_STRESS * draw.standard_normal(len(time))
        write(f"tension_{name}.csv", f"tension at {rate:g} 1/s", "time_s,strain_%,stress_kPa",
              [time, 100 * rate * time, 1e-3 * stress])
    held = np.concatenate([np.linspace(0.0, 0.2, 21), 0.2 + np.geomspace(0.01, 1000.0, 121)])
    strain = 0.02 * np.minimum(held / 0.2, 1.0)
    stress = tension(held, strain) + NOISE_STRESS * draw.standard_normal(len(held))
    write("relaxation.csv", "tension to 2 % within 0.2 s, then held", "time_s,strain_%,stress_kPa",
          [held, 100 * strain, 1e-3 * stress])
    f = np.geomspace(0.1, 100.0, 31)
    G = complex_modulus(f)
    noisy = lambda value: value * (1 + NOISE_DMA * draw.standard_normal(len(f)))
    write("dma.csv", "shear", "Frequency,Storage modulus,tan(delta)\nHz,MPa,-",
          [f, noisy(1e-6 * G.real), noisy(G.imag / G.real)])
    f = np.geomspace(1e-4, 200.0, 64)
    G = complex_modulus(f)
    write("truth_complex_modulus.csv", "truth, shear",
          "frequency_Hz,true_shear_storage_modulus_Pa,true_shear_loss_modulus_Pa", [f, G.real, G.imag], False)
    time = np.linspace(0.0, LARGEST / FIFTH, 101)
    write("truth_fifth_rate.csv", f"truth, tension at {FIFTH:g} 1/s", "time_s,strain,stress_Pa",
          [time, FIFTH * time, tension(time, FIFTH * time)], False)
    write_truth_block()


if __name__ == "__main__":
    main()
