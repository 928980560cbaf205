"""Laws and small cases for tests of laws written in Python."""

import numpy
import pfdm

three = numpy.eye(3)
unit = numpy.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
deviatoric = numpy.eye(6) - numpy.outer(unit, unit) / 3.0


def stiffness(young_modulus, poisson_ratio):
    """C of a linear elastic material [Pa], (6, 6)."""
    mu = young_modulus / (2.0 * (1.0 + poisson_ratio))
    bulk = young_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio))
    return bulk * numpy.outer(unit, unit) + 2.0 * mu * deviatoric


class Elastic(pfdm.OwnMaterial):
    """Of the shipped bar."""

    C = stiffness(30e9, 0.0)

    def respond(self, strain_before, strain, history, duration):
        return pfdm.MaterialResponse(self.C @ strain, self.C)


class LinearSoftening(pfdm.OwnInterfaceLaw):
    """What law = "linear" with a stiffness does with mixed_mode = "camacho_ortiz" and shear_ratio = 1."""

    history_size = 1  # the largest length of the separation [m]

    def __init__(self, stiffness):
        self.stiffness = stiffness

    def curve(self, length, strength, toughness):
        """Traction, slope, work at a length that only grows."""
        K, top = self.stiffness, strength / self.stiffness
        end = 2.0 * toughness / strength  # of a triangle of this area
        if length < top:
            return K * length, K, 0.5 * K * length**2
        if length >= end:
            return 0.0, 0.0, toughness
        fall = strength / (end - top)
        return fall * (end - length), -fall, toughness - 0.5 * fall * (end - length) ** 2

    def respond(self, separation, history, duration, strength, toughness):
        closed = separation[0] < 0.0
        along = numpy.diag([0.0 if closed else 1.0, 1.0, 1.0])
        pulled = along @ separation
        length, reached = numpy.linalg.norm(pulled), history[0]
        at = max(length, reached)
        traction, slope, work = self.curve(at, strength, toughness)
        secant = traction / at if at > 0.0 else self.stiffness
        tangent = secant * along
        dissipated = 0.0
        if length > reached:
            tangent += numpy.outer(pulled, pulled) * (slope - secant) / length**2
            before = self.curve(reached, strength, toughness)
            dissipated = work - 0.5 * traction * at - (before[2] - 0.5 * before[0] * reached)
        contact = numpy.diag([self.stiffness if closed else 0.0, 0.0, 0.0])
        force = secant * pulled + contact @ separation
        return pfdm.InterfaceResponse(force, tangent + contact, [at], 0.5 * force @ separation, dissipated)


class PlasticGlue(pfdm.OwnInterfaceLaw):
    """Elastic with K up to a traction along the normal of strength + H p, p the opening that stays."""

    history_size = 2  # p, and the sum of its changes [m]

    def __init__(self, stiffness, hardening):
        self.stiffness, self.hardening = stiffness, hardening

    def respond(self, separation, history, duration, strength, toughness):
        K, H = self.stiffness, self.hardening
        stays, sum_of_changes = history
        traction, tangent = K * (separation - [stays, 0.0, 0.0]), K * three
        excess = abs(traction[0]) - strength - H * sum_of_changes
        if excess <= 0.0:
            return pfdm.InterfaceResponse(traction, tangent, history, 0.5 * traction @ traction / K)
        change, way = excess / (K + H), numpy.sign(traction[0])
        traction[0] -= K * change * way
        return pfdm.InterfaceResponse(traction, tangent - numpy.diag([K * K / (K + H), 0.0, 0.0]),
                                      [stays + change * way, sum_of_changes + change],
                                      0.5 * traction @ traction / K, strength * change)


class J2Plasticity(pfdm.OwnMaterial):
    """What law = "j2_plasticity" does: linear isotropic and kinematic hardening, radial return."""

    history_size = 7  # plastic strain, its equivalent
    flows = True

    def __init__(self, young_modulus, poisson_ratio, yield_stress, isotropic, kinematic):
        self.C, self.mu = stiffness(young_modulus, poisson_ratio), young_modulus / (2.0 * (1.0 + poisson_ratio))
        self.yield_stress, self.isotropic, self.kinematic = yield_stress, isotropic, kinematic

    def respond(self, strain_before, strain, history, duration):
        Y, K, H, mu = self.yield_stress, self.isotropic, self.kinematic, self.mu
        plastic, p = history[:6], history[6]
        stress, tangent = self.C @ (strain - plastic), self.C
        beyond = deviatoric @ stress - 2.0 / 3.0 * H * plastic
        length = numpy.linalg.norm(beyond)
        excess = length - numpy.sqrt(2.0 / 3.0) * (Y + K * p)
        dissipated = 0.0
        if excess > 0.0:
            n, hard = beyond / length, 2.0 * mu + 2.0 / 3.0 * (K + H)
            flow = excess / hard
            stress = stress - 2.0 * mu * flow * n
            turning = 2.0 * mu * flow / length
            tangent = self.C - 2.0 * mu * (turning * deviatoric + (2.0 * mu / hard - turning) * numpy.outer(n, n))
            plastic, p = plastic + flow * n, p + numpy.sqrt(2.0 / 3.0) * flow
            dissipated = Y * numpy.sqrt(2.0 / 3.0) * flow
        locked = 0.5 * K * p**2 + H * plastic @ plastic / 3.0
        flow_stress = numpy.sqrt(2.0 / 3.0) * (Y + K * p)
        return pfdm.MaterialResponse(stress, tangent, [*plastic, p], locked, dissipated, flow_stress)


class NortonCreep(pfdm.OwnMaterial):
    """A viscous strain along the stress deviator, at the equivalent rate A sigma_eq^m; backward Euler."""

    history_size = 6
    depends_on_rate = True

    def __init__(self, young_modulus, poisson_ratio, A, m):
        self.C, self.mu = stiffness(young_modulus, poisson_ratio), young_modulus / (2.0 * (1.0 + poisson_ratio))
        self.A, self.m = A, m

    def respond(self, strain_before, strain, history, duration):
        A, m, mu = self.A, self.m, self.mu
        stress, tangent = self.C @ (strain - history), self.C
        deviator = deviatoric @ stress
        trial = numpy.sqrt(1.5 * deviator @ deviator)
        if trial == 0.0:
            return pfdm.MaterialResponse(stress, tangent, history)
        equivalent = trial
        for _ in range(50):
            slope = 1.0 + 3.0 * mu * duration * A * m * equivalent ** (m - 1.0)
            miss = trial - equivalent - 3.0 * mu * duration * A * equivalent**m
            equivalent += miss / slope
            if abs(miss) < 1e-12 * trial:
                break
        n, creep = 1.5 * deviator / trial, duration * A * equivalent**m
        along = numpy.outer(n, n) / 1.5
        softer = (1.0 - equivalent / trial) * (deviatoric - along) + (1.0 - 1.0 / slope) * along
        return pfdm.MaterialResponse(stress - 2.0 * mu * creep * n, self.C - 2.0 * mu * softer, history + creep * n,
                                     dissipated=equivalent * creep)


def block(folder, *, x, material, right="", toughness=None, more="", loading="", cells=(4, 2, 2)):
    """A block of 4 mm x 2 mm x 2 mm whose right half is the region "right", of the same material or another one; xmax moves
    by `x`, an expression [mm] of t. With a toughness the left half is damaged, with a length of 2 mm."""
    (folder / "case.toml").write_text(f"""
kind = "fracture"
title = "A block that is pulled"

[mesh]
generator = "box_hexes"
x = [{{ length = "4 mm", cells = {cells[0]} }}]
y = [{{ length = "2 mm", cells = {cells[1]} }}]
z = [{{ length = "2 mm", cells = {cells[2]} }}]
region = "left"

[[mesh.regions]]
name = "right"
lower = ["2 mm", "-1 mm", "-1 mm"]
upper = ["5 mm", "3 mm", "3 mm"]

[materials.block]
regions = ["left"{"" if right else ', "right"'}]
{f'toughness = "{toughness}"' if toughness else "damageable = false"}
{material}

{"[materials.right]" if right else ""}
{right}

[fracture]
split = "none"
{'length = "2 mm"' if toughness else ""}
{more}

[[boundary]]
patch = "xmin"
type = "symmetry"

[[boundary]]
patch = "ymin"
type = "symmetry"

[[boundary]]
patch = "zmin"
type = "symmetry"

[[boundary]]
patch = "xmax"
displacement = [{{ expr = "{x}", unit = "mm" }}, "free", "free"]

[loading]
initial_increment = 0.1
maximum_increment = 0.1
{loading}

[output]
curve = {{ patch = "xmax", component = "x" }}
""")
    return pfdm.Case(folder)


def glued(folder, x):
    """The block in two halves, E = 2 GPa without lateral contraction, held together by the interface "glue"."""
    return block(folder, x=x, material='young_modulus = "2 GPa"\npoisson_ratio = 0.0', more="""
[[interface]]
name = "glue"
between = ["left", "right"]
law = "linear"
strength = "2 MPa"
toughness = "100 J/m^2"
stiffness = "1e12 Pa/m"
""")
