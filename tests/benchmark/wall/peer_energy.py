"""Strain energies of the peer [J/m^3], by their parts: what drives damage, and the rest."""

import numpy as np
import ufl


def strain(u, dimension):
    """Small strain, in the plane plane strain (3, 3)."""
    e = ufl.sym(ufl.grad(u))
    if dimension == 3:
        return e
    return ufl.as_tensor([[e[0, 0], e[0, 1], 0], [e[1, 0], e[1, 1], 0], [0, 0, 0]])


def rubber(u, lame, mu):
    """Neo-Hookean energy in plane strain; below J = 0.1 ln J goes on as its expansion to second order, as in pfdm."""
    F = ufl.Identity(2) + ufl.grad(u)
    J = ufl.det(F)
    low = (J - 0.1) / 0.1
    log = ufl.conditional(J > 0.1, ufl.ln(ufl.max_value(J, 0.1)), np.log(0.1) + low - low**2 / 2)
    return mu / 2 * (ufl.inner(F, F) - 2) - mu * log + lame / 2 * (J - 1) ** 2


def parts(u, dimension, law, split, E, nu):
    """What drives damage and the rest, of moduli in Pa; ValueError at another split than none and volumetric_deviatoric."""
    lame, mu = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
    if law == "neo_hookean":
        return rubber(u, lame, mu), 0.0
    e = strain(u, dimension)
    volume = ufl.tr(e)
    if split == "none":
        return lame / 2 * volume**2 + mu * ufl.inner(e, e), 0.0
    if split != "volumetric_deviatoric":
        raise ValueError(f"split {split}: the peer has none and volumetric_deviatoric")
    bulk, shape = lame + 2 * mu / 3, e - volume / 3 * ufl.Identity(3)
    opens = ufl.conditional(volume > 0, 1.0, 0.0)
    return opens * bulk / 2 * volume**2 + mu * ufl.inner(shape, shape), (1 - opens) * bulk / 2 * volume**2
