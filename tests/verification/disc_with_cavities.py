# The bonded disc of cases/poker_chip_gent_lindley in closed form, as a thin, nearly incompressible layer at small
# strain (SciPy): the pressure p(r), whose gradient squeezes the rubber outwards, never above the strength. With u the
# displacement of half the disc and H half the thickness, H^3/(3 mu) (p'' + p'/r) = H p/K - u outside the radius a to
# which p is the strength (p' = 0 there), and p = mu u/H at the rim, where the rubber is free.
# Usage: disc_with_cavities.py STRENGTH_IN_MPa HALF_DISPLACEMENT_IN_um ...
import sys
import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import i0, i1, iv, k0, k1
mu, K, R, H = 0.59, 1000.0, 10.0, 0.95  # MPa, mm
E, kappa = 9*K*mu/(3*K+mu), np.sqrt(3*mu/(K*H*H))
strength, rises = float(sys.argv[1]), [1e-3*float(x) for x in sys.argv[2:]]
def growth(a, r):  # of p - K u/H from a to r
    return kappa*a*(k1(kappa*a)*i0(kappa*r) + i1(kappa*a)*k0(kappa*r)) if a > 0 else i0(kappa*r)
def rise(a):  # u at which p is the strength up to a
    return strength/(K/H*(1 - 1/growth(a, R)) + mu/H/growth(a, R))
first = rise(0)
print(f"the strength is reached at {1e3*first:.3f} um, {strength:.4g} MPa; mean stress "
      f"{first/H*(K*iv(2, kappa*R)/i0(kappa*R) + E):.4f} MPa")
for u in rises:
    a = brentq(lambda a: rise(a)-u, 1e-9, R*(1-1e-9)) if u > first else 0.0
    at_rim = mu*u/H - K*u/H
    p = lambda r: K*u/H + at_rim*growth(a, r)/growth(a, R) + 2*mu*u/H
    mean = (a*a*strength + 2*quad(lambda r: p(r)*r, a, R)[0])/R**2
    force = mean*R*R*np.pi/72
    print(f"{1e3*u:.1f} um: radius {a:.3f} mm, mean stress {mean:.4f} MPa, force of 5 degrees {force:.4f} N")
