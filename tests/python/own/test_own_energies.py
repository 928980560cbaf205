"""Tests of strain energies written in Python: those that repeat a law of the program give its results, another one those of
a closed form; wrong derivatives, and what cannot be combined with them, are refused."""

import unittest

from in_process import rows_of
from own_laws import Elastic, LinearSoftening, block, three
from shared import Folder

import numpy
import pfdm

E, nu = 0.9e6, 0.3
mu, lam = E / (2.0 * (1.0 + nu)), E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
of_E = f'young_modulus = "{E} Pa"\npoisson_ratio = {nu}'
outer = numpy.multiply.outer
# The same energy as law = "neo_hookean". Faces of that one have a stiffness by mu, those of all others by the tangent.
neo_hookean = 'law = "ogden"\nexponents = [2.0]\nshares = [1.0]'


class NeoHookean(pfdm.OwnHyperelastic):
    """Without volume terms; with a tangent if there is to be one."""

    def __init__(self, mu=mu, tangent=True):
        self.mu = mu
        self.tangent = mu * numpy.einsum("ik,jl->ijkl", three, three) if tangent else None

    def respond(self, F):
        return pfdm.HyperelasticResponse(0.5 * self.mu * numpy.sum(F * F), self.mu * F, self.tangent)


class WholeNeoHookean(pfdm.OwnHyperelastic):
    """mu/2 (I1 - 3) - mu ln J + lambda/2 (J - 1)^2, all that law = "neo_hookean" has."""

    def respond(self, F):
        J, inverse = numpy.linalg.det(F), numpy.linalg.inv(F)
        by_J = lam * (J - 1.0) * J - mu
        A = (mu * numpy.einsum("ik,jl->ijkl", three, three) + lam * J * (2.0 * J - 1.0) * outer(inverse.T, inverse.T)
             - by_J * numpy.einsum("li,jk->ijkl", inverse, inverse))
        W = 0.5 * mu * (numpy.sum(F * F) - 3.0) - mu * numpy.log(J) + 0.5 * lam * (J - 1.0) ** 2
        return pfdm.HyperelasticResponse(W, mu * F + by_J * inverse.T, A)


class MooneyRivlin(pfdm.OwnHyperelastic):
    """(mu - mu_01)/2 I1 + mu_01/2 I2, by differences."""

    def __init__(self, share):
        self.mu_01 = share * mu

    def respond(self, F):
        C = F.T @ F
        first, second = numpy.trace(C), 0.5 * (numpy.trace(C) ** 2 - numpy.sum(C * C))
        W = 0.5 * (mu - self.mu_01) * first + 0.5 * self.mu_01 * second
        return pfdm.HyperelasticResponse(W, (mu - self.mu_01) * F + self.mu_01 * F @ (first * three - C))


class Gent(pfdm.OwnHyperelastic):
    """-mu Jm/2 ln(1 - (I1 - 3)/Jm) (Gent, Rubber Chem. Technol. 69 (1996) 59), which the program has not."""

    def __init__(self, Jm, mu=mu):
        self.Jm, self.mu = Jm, mu

    def respond(self, F):
        left = 1.0 - (numpy.sum(F * F) - 3.0) / self.Jm
        if left <= 0.0:
            return pfdm.HyperelasticResponse(numpy.inf, numpy.full((3, 3), numpy.nan))
        return pfdm.HyperelasticResponse(-0.5 * self.mu * self.Jm * numpy.log(left), self.mu / left * F)


class Energies(Folder):
    def bent(self, law, **more):
        """A block that is held at one end and sheared and pulled at the other, in plane strain: it turns. The right half is
        stiffer, the left one is damaged."""
        stiffer = (f'regions = ["right"]\ndamageable = false\nyoung_modulus = "{3 * E} Pa"\npoisson_ratio = 0.2\n'
                   'law = "neo_hookean"')
        block(self.folder, x="0.8*t", material=f"{of_E}\n{law}", right=stiffer, toughness="0.3 kJ/m^2", cells=(4, 2, 1))
        file = self.folder / "case.toml"
        text = file.read_text()
        for old, new in [('patch = "xmin"\ntype = "symmetry"', 'patch = "xmin"\ndisplacement = ["0 m", "0 m", "0 m"]'),
                         ('patch = "ymin"', 'patch = "zmax"'), ('"mm" }, "free"', '"mm" }, "1 mm"')]:
            self.assertIn(old, text)
            text = text.replace(old, new)
        file.write_text(text)
        return pfdm.Case(self.folder, more)

    def assert_same(self, ours, theirs, tolerance=1e-6):
        our_rows, their_rows = rows_of(ours), rows_of(theirs)
        self.assertEqual(len(our_rows), len(their_rows))
        energies = ["elastic_energy_J", "fracture_energy_J", "external_work_J", "interface_dissipation_J"]
        for names in (["force_x_N", "force_y_N"], energies):
            a, b = (numpy.array([[row[name] for name in names] for row in rows]) for rows in (our_rows, their_rows))
            self.assertGreater(abs(b).max(), 0.0)
            numpy.testing.assert_allclose(a, b, rtol=0.0, atol=tolerance * abs(b).max(), err_msg=str(names))
        for name in ("displacement", "stress", "damage"):
            a, b = getattr(ours, name), getattr(theirs, name)
            numpy.testing.assert_allclose(a, b, rtol=0.0, atol=tolerance * abs(b).max(), err_msg=name)
        return their_rows

    def test_that_repeat_those_of_the_program_give_its_results(self):
        case = self.bent(neo_hookean)
        for law in (NeoHookean(), NeoHookean(tangent=False), WholeNeoHookean()):
            theirs = pfdm.FractureRun(case)
            self.assert_same(pfdm.FractureRun(case, materials={"left": law}), theirs)
            self.assertGreater(theirs.damage.max(), 0.1)
            turned = theirs.fields["deformation_gradient"]
            self.assertGreater(abs(turned[:, 0, 1] - turned[:, 1, 0]).max(), 0.1)

    def test_take_the_place_of_any_law_and_split(self):
        case = self.bent('law = "mooney_rivlin"\nsecond_invariant = 0.4\nvolumetric = "logarithmic"',
                         **{"fracture.split": "hybrid"})
        self.assert_same(pfdm.FractureRun(case, materials={"left": MooneyRivlin(0.4)}), pfdm.FractureRun(case))

    def test_have_a_pressure_where_they_are_nearly_incompressible(self):
        case = self.bent(neo_hookean, **{"materials.block.poisson_ratio": 0.4995})
        law = NeoHookean(mu=E / 2.999)
        self.assert_same(pfdm.FractureRun(case, materials={"left": law}), pfdm.FractureRun(case))

    def test_keep_the_branches_of_the_case(self):
        case = self.bent(f'{neo_hookean}\nshear_branches = [{{ modulus = "0.2 MPa", time = "0.3 s" }}]',
                         **{"loading.duration": "1 s"})
        theirs = pfdm.FractureRun(case)
        self.assert_same(pfdm.FractureRun(case, materials={"left": NeoHookean()}), theirs)
        self.assertGreater(theirs.row["plastic_dissipation_J"], 0.0)

    def test_are_those_of_a_closed_form(self):
        Jm = 4.0
        case = block(self.folder, x="4*t", material=f'{of_E}\nlaw = "neo_hookean"', cells=(2, 1, 1))
        run = pfdm.FractureRun(case, materials={name: Gent(Jm) for name in ("left", "right")})
        volume_modulus = lam - 2.0 * mu / Jm  # the energy has the rest

        def slopes(length, width):  # dW by the stretches along and across
            left, J = 1.0 - (length**2 + 2.0 * width**2 - 3.0) / Jm, length * width**2
            by_J = volume_modulus * (J - 1.0) - mu / J
            return mu / left * length + by_J * width**2, mu / left * width + by_J * length * width

        for row in list(rows_of(run))[1:]:
            length = 1.0 + row["displacement_m"] / 4e-3
            low, high = 0.5, 1.0
            for _ in range(60):
                width = 0.5 * (low + high)
                low, high = (width, high) if slopes(length, width)[1] < 0.0 else (low, width)
            self.assertAlmostEqual(row["force_x_N"], 4e-6 * slopes(length, width)[0], delta=1e-6 * row["force_x_N"])
        self.assertEqual(row["load"], 1.0)

    def glued(self, **more):
        """Two halves that turn while the glue between them opens in mixed mode."""
        case = self.bent(f"damageable = false\n{neo_hookean}")
        text = case.file.read_text().replace('toughness = "0.3 kJ/m^2"\n', "").replace('\nlength = "2 mm"\n', """
[[interface]]
name = "glue"
between = ["left", "right"]
law = "linear"
strength = "0.1 MPa"
toughness = "100 J/m^2"
stiffness = "1e10 Pa/m"
mixed_mode = "camacho_ortiz"
shear_ratio = 1.0
""")
        case.file.write_text(text)
        return pfdm.Case(self.folder, more)

    def test_go_with_laws_of_interfaces(self):
        case = self.glued()
        ours = pfdm.FractureRun(case, interfaces={"glue": LinearSoftening(1e10)}, materials={"left": NeoHookean()})
        rows = self.assert_same(ours, pfdm.FractureRun(case))
        self.assertGreater(rows[-1]["interface_dissipation_J"], 0.0)

    def test_refuse_interfaces_that_would_transfer_a_moment(self):
        class Across(LinearSoftening):
            def respond(self, separation, *others):
                answer = super().respond(separation, *others)
                return answer._replace(traction=answer.traction * [1.0, 0.5, 0.5])

        run = pfdm.FractureRun(self.glued(), interfaces={"glue": Across(1e10)})
        with self.assertRaisesRegex(pfdm.InputError, "glue.*an opened interface has to pull along its separation"):
            rows_of(run)

    def test_that_are_not_finite_cut_the_increment(self):
        case = block(self.folder, x="4*t", material=f'{of_E}\nlaw = "neo_hookean"', cells=(2, 1, 1))
        case["materials.block.poisson_ratio"] = 0.45
        law = Gent(0.5, E / 2.9)  # up to a stretch of some 1.4
        run = pfdm.FractureRun(case, materials={"left": law, "right": law})
        with self.assertRaises(pfdm.ComputationError):
            rows_of(run)
        self.assertGreater(run.row["displacement_m"], 1.4e-3)

    def assert_refused(self, said, case, law):
        with self.assertRaisesRegex(pfdm.InputError, said):
            pfdm.FractureRun(case, materials={"left": law})

    def test_with_wrong_derivatives_are_refused(self):
        class Wrong(NeoHookean):
            def __init__(self, energy=1.0, stress=three, tangent=1.0):
                super().__init__()
                self.factors = energy, stress, tangent

            def respond(self, F):
                W, P, A = super().respond(F)
                return pfdm.HyperelasticResponse(self.factors[0] * W, P @ self.factors[1], self.factors[2] * A)

        case = self.bent('law = "neo_hookean"')
        self.assert_refused("stress that respond.* is not the derivative of the energy by F: at F = .*0.1 of it", case,
                            Wrong(energy=1.1))
        self.assert_refused("tangent that respond.* is not the derivative of the stress", case, Wrong(tangent=1.1))
        turn = numpy.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
        self.assert_refused("F.-1 P is not symmetric", case, Wrong(stress=turn))
        self.assert_refused(r"stress.*\(3, 2\); \(3, 3\)", case, Wrong(stress=three[:, :2]))

    def test_that_do_not_fit_the_case_are_refused(self):
        class Fibres(NeoHookean):
            def respond(self, F):
                W, P, _ = super().respond(F)
                along = F[:, 0] @ F[:, 0] - 1.0
                return pfdm.HyperelasticResponse(W + mu * along**2, P + 4.0 * mu * along * numpy.outer(F[:, 0], three[0]))

        case = self.bent('law = "neo_hookean"')
        self.assert_refused("shear modulus 500 kPa at F = 1.* make 346.2 kPa; they must be the same", case, NeoHookean(mu=0.5e6))
        self.assert_refused("not isotropic at F = 1", case, Fibres())
        stiff = case.with_values({"materials.block.poisson_ratio": 0.48})
        self.assert_refused("has a volume energy of its own", stiff, WholeAt(0.48))
        self.assert_refused("derive the law from pfdm.OwnHyperelastic", case, Elastic())
        small = block(self.folder, x="0.01*t", material=of_E)
        self.assert_refused("no material of finite strain there.*neo_hookean", small, NeoHookean())


class WholeAt(pfdm.OwnHyperelastic):
    """mu/2 (I1 - 3 - 2 ln J) + lambda/2 (ln J)^2 of E and a Poisson's ratio."""

    def __init__(self, nu):
        self.mu, self.lam = E / (2.0 * (1.0 + nu)), E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))

    def respond(self, F):
        log, inverse = numpy.log(numpy.linalg.det(F)), numpy.linalg.inv(F)
        W = 0.5 * self.mu * (numpy.sum(F * F) - 3.0 - 2.0 * log) + 0.5 * self.lam * log**2
        return pfdm.HyperelasticResponse(W, self.mu * F + (self.lam * log - self.mu) * inverse.T)


if __name__ == "__main__":
    unittest.main()
