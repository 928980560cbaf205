#!/usr/bin/env python3
"""The bonded crystal in closed form: heat of the binder by the correspondence principle.

A hollow elastic sphere (radii 30 and 150 um) within a viscoelastic one (to 750 um), whose outer surface moves by
u = (-nu x, -nu y, z) 0.1 % sin(w t). Navier's equations have solutions of degree 0, u_r = A r + B/r^2, and of degree 2,
u_r = U(r) P2(cos theta), u_theta = V(r)/2 dP2/dtheta, with

    U = A r - 6 nu/(1 - 2 nu) B r^3 + 3 C/r^4 + (5 - 4 nu)/(1 - 2 nu) D/r^2
    V = A r - (7 - 4 nu)/(1 - 2 nu) B r^3 - 2 C/r^4 + 2 D/r^2

(Christensen, Lo, J. Mech. Phys. Solids 27 (1979) 315); moduli are complex. The binder makes w/2 Im(sigma : conj(eps)).

    closed_form.py [FREQUENCY_HZ ...]    prints the power of a sector of 4 degrees, W, and writes closed_form.csv
"""
import math
import sys
from pathlib import Path

import numpy as np

r_0, a, b = 30e-6, 150e-6, 750e-6
strain = 1e-3
E_c, nu_c = 15e9, 0.32
E_b, nu_b = 75e6, 0.44
branches = [(6e6, 160e-6), (6e6, 8e-6)]
sector = math.radians(4.0)


def binder(omega):
    """Bulk and complex shear modulus."""
    mu = E_b / (2 * (1 + nu_b)) + sum(m * 1j * omega * t / (1 + 1j * omega * t) for m, t in branches)
    return E_b / (3 * (1 - 2 * nu_b)), mu


def degree_2(K, mu, r):
    """Columns A, B, C, D of U, V, U', V'."""
    nu = (3 * K - 2 * mu) / (2 * (3 * K + mu))
    p, q, s = 6 * nu / (1 - 2 * nu), (7 - 4 * nu) / (1 - 2 * nu), (5 - 4 * nu) / (1 - 2 * nu)
    U = [r, -p * r**3, 3 / r**4, s / r**2]
    V = [r, -q * r**3, -2 / r**4, 2 / r**2]
    dU = [1, -3 * p * r**2, -12 / r**5, -2 * s / r**3]
    dV = [1, -3 * q * r**2, 8 / r**5, -4 / r**3]
    return np.array([U, V, dU, dV], dtype=complex)


def tractions(K, mu, r):
    """Rows: sigma_rr by P2, sigma_rtheta by dP2/dtheta."""
    U, V, dU, dV = degree_2(K, mu, r)
    trace = dU + 2 * U / r - 3 * V / r  # Laplace-Beltrami of P2 is -6 P2, halved
    lam = K - 2 * mu / 3
    return np.array([lam * trace + 2 * mu * dU, mu * (U / r + 0.5 * dV - 0.5 * V / r)])


def solve(omega):
    K_c, mu_c = E_c / (3 * (1 - 2 * nu_c)), E_c / (2 * (1 + nu_c))
    K_b, mu_b = binder(omega)
    # Degree 2: A, B, C, D of the crystal, then of the binder.
    M, rhs = np.zeros((8, 8), complex), np.zeros(8, complex)
    M[0:2, :4] = tractions(K_c, mu_c, r_0)
    M[2:4, :4], M[2:4, 4:] = degree_2(K_c, mu_c, a)[:2], -degree_2(K_b, mu_b, a)[:2]
    M[4:6, :4], M[4:6, 4:] = tractions(K_c, mu_c, a), -tractions(K_b, mu_b, a)
    M[6:8, 4:] = degree_2(K_b, mu_b, b)[:2]
    # (-nu x, -nu y, z): the mean (1 - 2 nu)/3, the deviator 2/3 (1 + nu) r P2.
    rhs[6:8] = 2 / 3 * (1 + nu_b) * strain * b
    scale = np.abs(M).max(axis=0)
    two = np.linalg.solve(M / scale, rhs) / scale
    # Degree 0.
    N = np.zeros((4, 4), complex)
    N[0, :2] = [3 * K_c, -4 * mu_c / r_0**3]
    N[1] = [a, 1 / a**2, -a, -1 / a**2]
    N[2] = [3 * K_c, -4 * mu_c / a**3, -3 * K_b, 4 * mu_b / a**3]
    N[3, 2:] = [b, 1 / b**2]
    scale = np.abs(N).max(axis=0)
    zero = np.linalg.solve(N / scale, np.array([0, 0, 0, (1 - 2 * nu_b) / 3 * strain * b])) / scale
    return K_b, mu_b, two[4:], zero[2:]


def heating(omega, r, theta):
    """W/m^3 in the binder."""
    K, mu, two, zero = solve(omega)
    U, V, dU, dV = degree_2(K, mu, r) @ two
    c, s = math.cos(theta), math.sin(theta)
    P, dP, ddP = 1.5 * c * c - 0.5, -3 * c * s, -3 * (c * c - s * s)
    e_rr = dU * P + zero[0] - 2 * zero[1] / r**3
    e_tt = U * P / r + 0.5 * V * ddP / r + zero[0] + zero[1] / r**3
    e_pp = U * P / r + 0.5 * V * (dP * c / s if s > 1e-12 else ddP) / r + zero[0] + zero[1] / r**3
    e_rt = 0.5 * dP * (U / r + 0.5 * dV - 0.5 * V / r)
    mean = (e_rr + e_tt + e_pp) / 3
    square = sum(abs(e - mean) ** 2 for e in (e_rr, e_tt, e_pp)) + 2 * abs(e_rt) ** 2
    return omega * mu.imag * square  # w/2 2 mu'' e:e


def power(omega):
    """W in the sector, by Gauss's rule."""
    x, w = np.polynomial.legendre.leggauss(48)
    radii, wr = a + (b - a) * (x + 1) / 2, w * (b - a) / 2
    y, v = np.polynomial.legendre.leggauss(24)
    total = 0.0
    for r, g in zip(radii, wr):
        total += sum(h * heating(omega, r, math.acos(z)) for z, h in zip(y, v)) * g * r * r
    return total * sector


def main():
    frequencies = [float(f) for f in sys.argv[1:]] or [1e3, 20e3]
    with open(Path(__file__).parent / "closed_form.csv", "w") as file:
        file.write("frequency_Hz,radius_m,polar_angle_degree,heating_W_per_m3\n")
        for f in frequencies:
            omega = 2 * math.pi * f
            print(f"{f:g} Hz: loss factor in shear {binder(omega)[1].imag / binder(omega)[1].real:.4f}, "
                  f"power of the sector {power(omega):.6g} W")
            for r in (150e-6, 155e-6, 160e-6, 180e-6, 220e-6, 300e-6, 500e-6, 740e-6):
                for degrees in range(0, 91, 15):
                    file.write(f"{f:g},{r:g},{degrees},{heating(omega, r, math.radians(degrees)):.8g}\n")


if __name__ == "__main__":
    main()
