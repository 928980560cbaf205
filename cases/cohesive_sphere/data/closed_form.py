#!/usr/bin/env python3
"""Writes closed_form.csv: the band's law, and the outside's displacement at which each of its states is in equilibrium.

All is a function of r: u = A r + B/r^2, stress = 3 K A - 4 mu B/r^3 in each shell (Lame's solution of a sphere); bead and
band carry the traction T from the rigid core to the crack, band and matrix from the crack, opened by w, to the outside.
"""

import pathlib

STRENGTH, TOUGHNESS = 2e6, 10.0  # [Pa], [J/m^2]
CORE, RADIUS, WIDTH, OUTER = 120e-6, 240e-6, 6.5e-6, 960e-6  # [m]
CRACK = RADIUS + 0.5 * WIDTH


def shell(young, poisson):
    """3 K and 4 mu [Pa]"""
    return young / (1.0 - 2.0 * poisson), 2.0 * young / (1.0 + poisson)


GLASS, SYLGARD, BAND = shell(70e9, 0.3), shell(75e6, 0.44), shell(7.5e6, 0.0)


def carried(u, stress, start, end, elasticity):
    three_k, four_mu = elasticity
    a = (stress + four_mu * u / start) / (three_k + four_mu)
    b = (u - a * start) * start**2
    return a * end + b / end**2, three_k * a - four_mu * b / end**3


def outside(opening, traction):
    """Displacement of the outside [m]"""
    inner = carried(*carried(0.0, 1.0, CORE, RADIUS, GLASS), RADIUS, CRACK, BAND)
    crack = (inner[0] / inner[1] * traction + opening, traction)
    return carried(*carried(*crack, CRACK, RADIUS + WIDTH, BAND), RADIUS + WIDTH, OUTER, SYLGARD)[0]


def main():
    final = 2.0 * TOUGHNESS / STRENGTH
    with open(pathlib.Path(__file__).parent / "closed_form.csv", "w", encoding="utf-8") as file:
        print("# Closed form, not measured: linear softening, ft = 2 MPa, Gc = 10 J/m^2; by closed_form.py", file=file)
        print("separation_m,traction_Pa,outer_displacement_m", file=file)
        for i in range(41):
            opening = final * i / 40
            traction = STRENGTH * (1.0 - opening / final)
            print(f"{opening:.6g},{traction:.6g},{outside(opening, traction):.6g}", file=file)


if __name__ == "__main__":
    main()
