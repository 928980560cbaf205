# Interfaces whose traction depends on the rate of opening, T = T_0(delta) (1 + (delta'/v_0)^m), linear softening after a
# straight rise (SciPy): two blocks pulled at a constant speed, by an ODE solver and by implicit steps; a double cantilever
# beam opened at constant rates, by beams on springs in series with the interface. By hand:
# `python3 rate_interfaces.py blocks` or `beam [rate factor's v_0 in mm/s, 0 for none] [opening rate in mm/s] [steps]`.
import sys

import numpy as np
import scipy.sparse as sp
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.sparse.linalg import splu


def law(x, strength, toughness, K):
    """Traction in opening [Pa] at the separation x [m], K the rise's stiffness [Pa/m]."""
    rise = strength / K
    end = rise + 2.0 * (toughness - 0.5 * strength * rise) / strength
    return np.where(x < rise, K * x, np.maximum(0.0, strength * (end - x) / (end - rise)))


def blocks():
    """Blocks of 1 mm, E = 1 GPa, nu = 0: u = delta + c T. Pulled at `speed` to 0.3 mm, v_0 = 1 mm/s, m = 0.2."""
    strength, toughness, K, c, m = 2e6, 400.0, 5e12, 2e-3 / 1e9, 0.2
    speed, v_0, u_end = 1e-3, 1e-3, 0.3e-3
    T_0 = lambda x: float(law(x, strength, toughness, K))

    def rate(t, y):
        over = (speed * t - y[0]) / c / T_0(y[0]) - 1.0 if y[0] > 0.0 else 0.0
        v = v_0 * max(over, 0.0) ** (1.0 / m)
        return [v, T_0(y[0]) * v, (speed * t - y[0]) / c * speed, ((speed * t - y[0]) / c - T_0(y[0])) * v]

    # The rise is straight, and passed at a constant rate v; so is softening in the end.
    v = brentq(lambda v: v * (1.0 + c * K * (1.0 + (v / v_0) ** m)) - speed, 1e-12, speed)
    top, over = strength / K, (v / v_0) ** m
    print(f"rise: rate {v:.12e} m/s, ends at u {speed * top / v:.9e} m")
    start = [top, 0.5 * strength * top, 0.5 * strength * top * (1.0 + over), 0.5 * strength * top * over]
    ode = solve_ivp(rate, (top / v, 1.001 * u_end / speed), start, method="LSODA", rtol=1e-12,
                    atol=[1e-18, 1e-10, 1e-10, 1e-10], t_eval=np.arange(1, 7) * 0.05e-3 / speed)
    for t, x, w, work, viscous in zip(ode.t, *ode.y):
        print(f"ODE      u {speed * t:.3e} delta {x:.12e} T {(speed * t - x) / c:.9e} viscous {viscous:.9e}")
    for n in (24, 48, 96, 192, 384):
        x, viscous, before = 0.0, 0.0, 0.0
        dt = u_end / speed / n
        for k in range(1, n + 1):
            u = u_end * k / n
            miss = lambda y: y + c * T_0(y) * (1.0 + (max(0.0, y - x) / dt / v_0) ** m) - u
            y = brentq(miss, x, u, xtol=1e-22, rtol=1e-15)
            over = ((y - x) / dt / v_0) ** m
            points = [x] + [p for p in (strength / K,) if x < p < y] + [y]
            done = sum(0.5 * (T_0(a) + T_0(b)) * (b - a) for a, b in zip(points, points[1:]))
            viscous += 0.5 * (before + over) * done
            x, before = y, over
            if n == 24 and k % 4 == 0 or k == n:
                print(f"{n:4} steps u {u:.3e} delta {x:.12e} T {(u - x) / c:.9e} viscous {viscous:.9e}")


def beam(v_0, rate, n_steps, cells=400, end=2.6e-3, m=0.2, strength=50e6, toughness=281.0, out=None):
    """Two arms of h = 2 mm, E = 126 GPa, nu = 0.3 in plane strain, bonded from 30 to 60 mm, where they are clamped,
    opened by D to `end` at `rate` [m/s]. The springs are such that the elastic beam is the corrected one (chi). Returns
    D [m] and the force per width [N/m]. v_0 = 0: without rate."""
    E, nu, h, a0, L = 126e9, 0.3, 2e-3, 30e-3, 60e-3
    E1, mu = E / (1.0 - nu * nu), E / (2.0 * (1.0 + nu))
    gamma = 1.18 * E1 / mu
    chi = np.sqrt(E1 / (11.0 * mu) * (3.0 - 2.0 * (gamma / (1.0 + gamma)) ** 2))
    EI = E1 * h**3 / 12.0
    spring = 4.0 * EI / (chi * h) ** 4  # of half the opening [Pa/m]
    K = 1e3 * E1 / h  # nearly rigid
    soft = strength**2 / (2.0 * toughness) / (1.0 - strength**2 / (2.0 * K * toughness))
    x = np.linspace(a0, 45e-3, cells + 1)
    dx = x[1] - x[0]
    n = cells + 1
    # Hermite elements from a0 on; the free arm of length a0 is exact: moment and shear at a0 by its force P.
    k = EI / dx**3 * np.array([[12, 6 * dx, -12, 6 * dx], [6 * dx, 4 * dx**2, -6 * dx, 2 * dx**2],
                               [-12, -6 * dx, 12, -6 * dx], [6 * dx, 2 * dx**2, -6 * dx, 4 * dx**2]])
    rows, cols, values = [], [], []
    for e in range(cells):
        at = np.arange(2 * e, 2 * e + 4)
        rows.append(np.repeat(at, 4)), cols.append(np.tile(at, 4)), values.append(k.ravel())
    A = sp.csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(cols))), (2 * n, 2 * n))
    A = A.tolil()
    A[2 * n - 2, 2 * n - 2] += 1e9 * EI / dx**3
    A[2 * n - 1, 2 * n - 1] += 1e9 * EI / dx
    A = A.tocsc()
    weight = np.full(n, dx)
    weight[[0, -1]] *= 0.5
    b = np.zeros(2 * n)  # of the force P at the free end: w(0) = w_0 - a0 theta_0 + P a0^3/(3 EI)
    b[0], b[1] = 1.0, -a0

    def at(d, opened, reached, dt):
        """T and dT/d delta."""
        rising, r = strength / K, np.maximum(reached, 1e-30)
        left = lambda y: np.maximum(0.0, strength - soft * (y - rising))
        kept = np.where(r < rising, K, left(r) / r)
        grows = (d > reached) & (d > rising)
        T, slope = np.where(grows, left(d), kept * d), np.where(grows, np.where(left(d) > 0.0, -soft, 0.0), kept)
        if v_0 > 0.0:
            change = np.maximum(d - opened, 1e-300)
            over = np.where(d > opened, (change / dt / v_0) ** m, 0.0)
            T, slope = np.where(d > 0.0, T * (1.0 + over), T), slope * (1.0 + over) + np.maximum(T, 0.0) * over * m / change
        return T, slope

    def traction(w, opened, reached, dt):
        """T, dT/dw and delta where w = delta/2 + T/spring."""
        low, high = np.minimum(2.0 * w, 0.0), np.maximum(2.0 * w, 0.0)
        for _ in range(60):
            middle = 0.5 * (low + high)
            above = 0.5 * middle + at(middle, opened, reached, dt)[0] / spring > w
            high, low = np.where(above, middle, high), np.where(above, low, middle)
        d = 0.5 * (low + high)
        slope = at(d, opened, reached, dt)[1]
        return spring * (w - 0.5 * d), slope / (0.5 + slope / spring), d

    w = np.zeros(2 * n)
    opened, reached = np.zeros(n), np.zeros(n)
    curve = []
    for step in range(1, n_steps + 1):
        D = end * step / n_steps
        dt = end / n_steps / rate
        P = 0.0
        for _ in range(60):
            T, slope, d = traction(w[0::2], opened, reached, dt)
            # Unknowns: w, P with w(0) - a0 theta + P a0^3/(3 EI) = D/2.
            f = A @ w - b * P
            f[0::2] += weight * T
            J = A + sp.diags(np.repeat(weight * slope, 2) * np.tile([1.0, 0.0], n))
            solve = splu(J.tocsc()).solve
            one, two = solve(-f), solve(b)
            c = a0**3 / (3.0 * EI)
            dP = (D / 2 - b @ (w + one) - c * P) / (c + b @ two)
            change = one + dP * two
            w = w + change
            P += dP
            if np.max(np.abs(change[0::2])) < 1e-9 * D:
                break
        else:
            print("no convergence at", D)
        d = traction(w[0::2], opened, reached, dt)[2]
        opened, reached = d, np.maximum(reached, d)
        curve.append((D, P))
    D, P = np.array(curve).T
    length = (D * E1 * h**3 / (8.0 * P)) ** (1.0 / 3.0)  # a + chi h
    G = 12.0 * P**2 * length**2 / (E1 * h**3)
    return D, P, length - chi * h, G


if __name__ == "__main__":
    if sys.argv[1] == "blocks":
        blocks()
    else:
        v_0, rate, steps = float(sys.argv[2]) * 1e-3, float(sys.argv[3]) * 1e-3, int(sys.argv[4])
        for D, P, a, G in list(zip(*beam(v_0, rate, steps)))[steps // 13 - 1 :: steps // 13]:
            print(f"D {D:.4e} m  P {P:.5e} N/m  a {a:.5e} m  G {G:.3f} J/m^2")
