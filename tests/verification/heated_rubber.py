#!/usr/bin/env python3
"""Heat of a point of viscous rubber that is strained to and fro without losing any: figures that
tests/verification/finite_histories/heated_rubber.cpp is compared with. Needs NumPy and SciPy.

A neo-Hookean spring beside a Maxwell branch, F = F_e F_v (Reese, Govindjee, Int. J. Solids Struct. 35 (1998) 3455). The
viscous gradient F_v itself is integrated, F_v' = D_v F_v, and not C_v as the program does; D_v has the direction of the
deviator of Mandel's stress of the isochoric spring. The heat is integrated beside it, and compared with work less energy.
"""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

MU, BRANCH, TAU, CAPACITY, PERIOD = 1e6, 2e6, 1e-2, 1500.0 * 1000.0, 0.05
ONE = np.eye(3)


def elastic(F, F_v):
    """Isochoric b_e' of the branch, 3 x 3, and J."""
    J = np.linalg.det(F)
    F_e = J ** (-1 / 3) * F @ np.linalg.inv(F_v)
    return F_e, J


def flow(F, F_v, tau):
    """F_v' and the heat per time and reference volume [W/m^3]. The spring's energy is BRANCH/2 J^(2/3) (tr b_e' - 3)."""
    F_e, J = elastic(F, F_v)
    C_e = F_e.T @ F_e
    deviator = C_e - np.trace(C_e) / 3 * ONE
    D = deviator / (2 * tau)
    return D @ F_v, BRANCH * J ** (2 / 3) * np.tensordot(deviator, D)


def stress(F, F_v, Lambda):
    """First Piola-Kirchhoff [Pa]: energies MU/2 (I1 - 3) - MU ln J + Lambda/2 (J - 1)^2, and the branch's."""
    F_e, J = elastic(F, F_v)
    inverse = np.linalg.inv(F).T
    b_e = F_e @ F_e.T
    branch = BRANCH * J ** (2 / 3) * (b_e - ONE)  # Kirchhoff: of J^(2/3) (tr b_e' - 3)/2 at constant F_v
    return MU * (F - inverse) + Lambda * (J - 1) * J * inverse + branch @ inverse


def energy(F, F_v, Lambda):
    F_e, J = elastic(F, F_v)
    return (MU / 2 * (np.tensordot(F, F) - 3) - MU * np.log(J) + Lambda / 2 * (J - 1) ** 2
            + BRANCH / 2 * J ** (2 / 3) * (np.tensordot(F_e, F_e) - 3))


def shear(amplitude):
    def at(t, F_v):
        F = ONE.copy()
        F[0, 1] = amplitude * np.sin(2 * np.pi * t / PERIOD)
        rate = np.zeros((3, 3))
        rate[0, 1] = amplitude * 2 * np.pi / PERIOD * np.cos(2 * np.pi * t / PERIOD)
        return F, rate
    return at


def tension(amplitude, Lambda):
    """Uniaxial stress; the part of the rate across does no work."""
    def at(t, F_v):
        a = 1 + amplitude * np.sin(2 * np.pi * t / PERIOD)
        lateral = brentq(lambda b: stress(np.diag([a, b, b]), F_v, Lambda)[1, 1], 0.3, 3.0, xtol=1e-15, rtol=1e-14)
        rate = np.zeros((3, 3))
        rate[0, 0] = amplitude * 2 * np.pi / PERIOD * np.cos(2 * np.pi * t / PERIOD)
        return np.diag([a, lateral, lateral]), rate
    return at


def rises(at, Lambda, cycles):
    """Rise at the end of each cycle [K], and work less stored energy over the heat."""
    def rate(t, y):
        F_v = y[:9].reshape(3, 3)
        F, F_rate = at(t, F_v)
        F_v_rate, heat = flow(F, F_v, TAU)
        return np.concatenate([F_v_rate.ravel(), [heat, np.tensordot(stress(F, F_v, Lambda), F_rate)]])
    ends = PERIOD * np.arange(1, cycles + 1)
    y = solve_ivp(rate, (0, ends[-1]), np.concatenate([ONE.ravel(), [0.0, 0.0]]), t_eval=ends, method="DOP853",
                  rtol=1e-11, atol=1e-13).y
    F_v = y[:9, -1].reshape(3, 3)
    account = (y[10, -1] - energy(at(ends[-1], F_v)[0], F_v, Lambda)) / y[9, -1]
    return y[9] / CAPACITY, account


def shift(law, T):
    """a_T of a temperature [K]: WLF (Williams, Landel, Ferry 1955), or Arrhenius."""
    if law == "wlf":
        return 10.0 ** (-8.86 * (T - 300.0) / (101.6 + T - 300.0))
    return np.exp(120e3 / 8.314462618 * (1.0 / T - 1.0 / 290.0))


def warmed(law, expansion):
    """Sheared by sin, its volume held, while rises strain it (F_e = F/(1 + expansion rise)) and shift the branch's time:
    rise [K] and nominal stresses along and across the shear [Pa] after 1.25 and 3.25 cycles."""
    at, start, ratio = shear(1.0), 290.0, 0.3
    Lambda = MU * 2 * ratio / (1 - 2 * ratio)

    def elastic_part(t, rise):
        free = 1.0 + expansion * rise
        return at(t, None)[0] / free, free

    def rate(t, y):
        F_e, free = elastic_part(t, y[9])
        F_v_rate, heat = flow(F_e, y[:9].reshape(3, 3), TAU * shift(law, start + y[9]))
        return np.concatenate([F_v_rate.ravel(), [free ** 3 * heat / CAPACITY]])

    ends = PERIOD * np.array([1.25, 3.25])
    y = solve_ivp(rate, (0, ends[-1]), np.concatenate([ONE.ravel(), [0.0]]), t_eval=ends, method="DOP853", rtol=1e-11,
                  atol=1e-13).y
    for k, t in enumerate(ends):
        F_e, free = elastic_part(t, y[9, k])
        P = free ** 2 * stress(F_e, y[:9, k].reshape(3, 3), Lambda)
        yield y[9, k], P[0, 1], P[1, 1]


def volume_branch(poisson, K, tau, amplitude=0.3, cycles=3):
    """Uniaxial stress with a bulk branch besides, K/2 (J_e - 1)^2, (ln J_v)' = ln J_e/tau: at 1.25 and 3.25 cycles rise
    [K], nominal stress [Pa] and lateral stretch."""
    Lambda = MU * 2 * poisson / (1 - 2 * poisson)

    def total(F, F_v, log_J_v):
        J = np.linalg.det(F)
        J_e = J / np.exp(log_J_v)
        return stress(F, F_v, Lambda) + K * (J_e - 1) * J_e * np.linalg.inv(F).T

    def at(t, F_v, log_J_v):
        a = 1 + amplitude * np.sin(2 * np.pi * t / PERIOD)
        b = brentq(lambda b: total(np.diag([a, b, b]), F_v, log_J_v)[1, 1], 0.3, 3.0, xtol=1e-15, rtol=1e-14)
        return np.diag([a, b, b])

    def rate(t, y):
        F_v = y[:9].reshape(3, 3)
        F = at(t, F_v, y[9])
        F_v_rate, heat = flow(F, F_v, TAU)
        r = np.log(np.linalg.det(F)) - y[9]
        of_volume = K * (np.exp(r) - 1) * np.exp(r) * r / tau
        return np.concatenate([F_v_rate.ravel(), [r / tau, (heat + of_volume) / CAPACITY]])

    ends = PERIOD * np.array([1.25, 3.25])
    y = solve_ivp(rate, (0, ends[-1]), np.concatenate([ONE.ravel(), [0.0, 0.0]]), t_eval=ends, method="DOP853",
                  rtol=1e-10, atol=1e-12).y
    for k, t in enumerate(ends):
        F_v = y[:9, k].reshape(3, 3)
        F = at(t, F_v, y[9, k])
        yield y[10, k], total(F, F_v, y[9, k])[0, 0], F[1, 1]


def main():
    for amplitude in (1e-3, 0.8):
        of_cycle, account = rises(shear(amplitude), 0.0, 3)
        print(f"shear {amplitude:g}:", *(f"{rise:.10g} K" for rise in of_cycle), f"account {account:.9f}")
    for poisson in (0.3, 0.4995):
        Lambda = MU * 2 * poisson / (1 - 2 * poisson)
        of_cycle, account = rises(tension(0.5, Lambda), Lambda, 3)
        print(f"tension, nu {poisson}:", *(f"{rise:.10g} K" for rise in of_cycle), f"account {account:.9f}")
    for rise, force, lateral in volume_branch(0.2, 3e6, 2e-2):
        print(f"bulk branch, nu 0.2: {rise:.10g} K, {force:.10g} Pa, lateral stretch {lateral:.10g}")
    for law in ("wlf", "arrhenius"):
        for expansion in (0.0, 1e-3):
            for rise, along, across in warmed(law, expansion):
                print(f"two-way, {law}, expansion {expansion:g}/K: {rise:.10g} K, {along:.10g} Pa, {across:.10g} Pa")


if __name__ == "__main__":
    main()
