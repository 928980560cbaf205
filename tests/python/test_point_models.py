"""Tests of the laws of points in process: their arrays are what the program writes, to the last bit."""

import os
import signal
import threading
import time
import unittest

import in_process  # noqa: F401  (skips without the extension)
from shared import Folder, shipped

import numpy
import pandas
import pfdm

class Histories(Folder):
    def assert_same_columns(self, ours, theirs, names):
        """Bit by bit; `names`: ours to theirs."""
        for own, other in names.items():
            a, b = ours[own].to_numpy(float), theirs[other].to_numpy(float)
            self.assertEqual(a.tobytes(), b.tobytes(), f"{own}: {numpy.abs(a - b).max()}")


class MassMaterials(Histories):
    case = pfdm.Case(shipped / "htpb_soft_sweep",
                     {"test[0].excitation.duration": "2 s", "test[0].excitation.ramp": "0.1 s"})
    values = {"structure": "2", "mass": 1.12, "damping": "19.7 N s/m",
              "stiffness": [54160.0, "-1.083 MN/m^2", 1.3e8, 0.0, "8.67e11 N/m^5"]}
    columns = {"time_s": "time", "base_acceleration_m_per_s2": "base_acceleration",
               "relative_acceleration_m_per_s2": "relative_acceleration"}

    def ran(self, case, test):
        """The record that `pfdm run` leaves of a test; its second row has the units."""
        case.run(self.folder / "r", threads=1)
        return pandas.read_csv(self.folder / f"r/{test}.csv", comment="#", skiprows=[], float_precision="round_trip",
                               dtype=str).iloc[1:].astype(float).reset_index(drop=True)

    def quiet(self):
        """The shipped sweep without noise."""
        text = (shipped / "htpb_soft_sweep/case.toml").read_text().replace("signal_to_noise_dB = 60\nnoise_seed = 1\n", "")
        (self.folder / "case.toml").write_text(text)
        return pfdm.Case(self.folder, self.case.values)

    def test_respond_to_an_excitation_as_the_program_does(self):
        case = self.quiet()
        for model in (pfdm.MassMaterial.of(case), pfdm.MassMaterial(**self.values)):
            excitation = {**case["test[0].excitation"], "duration": "2 s", "ramp": 0.1}
            self.assert_same_columns(model.respond(excitation, rate=1000.0), self.ran(case, "sweep_2g0"), self.columns)

    def test_respond_to_a_record_as_the_program_does(self):
        base = 15.0 * numpy.random.default_rng(1).standard_normal(800)
        base[:50] = base[-50:] = 0.0
        base -= base.mean()
        times = numpy.arange(800) / 1000.0
        record = pandas.DataFrame({"time_s": times, "base_acceleration_m_per_s2": base})
        record.to_csv(self.folder / "record.csv", index=False)
        self.quiet()
        text = (self.folder / "case.toml").read_text()
        head = text[: text.index("[[test]]")]
        measured = 'excitation = { type = "measured", file = "record.csv", base = "base_acceleration_m_per_s2", ' \
                   'time = "time_s", from = "5 Hz", to = "200 Hz", unit = "m/s^2", time_unit = "s" }\n'
        (self.folder / "case.toml").write_text(f'{head}[[test]]\nname = "shaken"\n{measured}')
        case = pfdm.Case(self.folder)
        theirs = self.ran(case, "shaken")
        ours = pfdm.MassMaterial.of(case).respond(base, rate=1000.0, band=(5.0, 200.0))
        self.assert_same_columns(ours, theirs, self.columns)
        self.assertEqual(ours.attrs["units"]["relative_displacement_m"], "m")

    def test_respond_to_records_of_few_samples(self):
        model = pfdm.MassMaterial(**self.values)
        for n in (2, 3, 4, 5):
            motion = model.respond(numpy.ones(n), rate=1000.0)
            self.assertEqual(len(motion), n)
            self.assertTrue(numpy.isfinite(motion.to_numpy()).all())

    def test_end_by_ctrl_c(self):
        model = pfdm.MassMaterial(**self.values)
        long = {"type": "harmonic", "level": 1.0, "frequency": 30.0, "duration": 2000.0}
        threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
        began = time.process_time()
        with self.assertRaises(KeyboardInterrupt):
            model.respond(long, rate=1000.0, tolerance=1e-14)
        self.assertLess(time.process_time() - began, 0.7)

    def test_have_forces_of_any_shape(self):
        model = pfdm.MassMaterial(**self.values)
        z = numpy.array([[0.0, 1e-3], [-2e-3, 4e-3]])
        k = model.stiffness
        numpy.testing.assert_allclose(model.stiffness_force(z), sum(k[i] * z ** (i + 1) for i in range(5)), rtol=1e-13)
        numpy.testing.assert_allclose(model.damping_force(z), 19.7 * z)
        frequency = numpy.array([10.0, 35.0])
        numpy.testing.assert_allclose(model.complex_stiffness(frequency), k[0] + 2j * numpy.pi * frequency * 19.7)
        self.assertEqual(model.mass, 1.12)
        self.assertLess(model.settling_point(), 0.0)
        self.assertIn('structure = "2"', model.text())

    def test_say_what_is_wrong(self):
        for values, said in [({"mass": "1 m"}, "mass"), ({"mas": 1.0}, "did you mean \"mass\""),
                             ({"stiffness": [-1.0]}, "k_1 must be positive"), ({"structure": "9"}, "allowed")]:
            with self.assertRaisesRegex(pfdm.InputError, said) as caught:
                pfdm.MassMaterial(**{**self.values, **values})
            self.assertIsNone(caught.exception.file)
        model = pfdm.MassMaterial(**self.values)
        for base, rate, said in [(numpy.zeros((3, 2)), 1000.0, r"\(3, 2\)"), (numpy.zeros(1), 1000.0, "two samples"),
                                 (numpy.zeros(9), -1.0, "must be positive"),
                                 ({"type": "harmonic"}, 0.0, "rate: 0 Hz must be positive"),
                                 ({"type": "swept_sin"}, 1000.0, "did you mean \"swept_sine\"")]:
            with self.assertRaisesRegex(pfdm.InputError, said):
                model.respond(base, rate)
        with self.assertRaisesRegex(pfdm.InputError, "htpb_soft_sweep/case.toml"):
            pfdm.MassMaterial.of(self.case.with_values({"model.mass": "1 m"}))
        with self.assertRaisesRegex(pfdm.ComputationError, "unbounded"):
            weak = pfdm.MassMaterial(structure="2", mass=1.0, stiffness=[4e4, 0.0, -1e12], damping=1.0)
            weak.respond({"type": "harmonic", "level": 500.0, "frequency": 30.0, "duration": 1.0}, 1000.0)


class EndochronicLaws(Histories):
    soft_metal = {"young_modulus": "117 GPa", "poisson_ratio": 0.34,
                  "kernel": [{"C": "60 GPa", "alpha": 3000}, {"C": 15e9, "alpha": 500}, {"C": "2 GPa", "alpha": 30}],
                  "hardening": {"law": "saturating", "f_inf": 3.0, "b": 6.0}}

    @staticmethod
    def path():
        """Strains of 40 points in all components."""
        return 0.01 * numpy.sin(numpy.arange(40)[:, None] * numpy.linspace(0.1, 0.4, 6))

    def test_respond_as_the_program_does(self):
        case = pfdm.Case(shipped / "endochronic_uniaxial", {"loading.repeat": 1})
        theirs = case.run(self.folder / "r", threads=1).table("history.csv")
        time = 4.0 * numpy.arange(201) / 200
        strain = []
        for t in time:  # as the program interpolates a table
            x, y = [0.0, 1.0, 3.0, 4.0], [0.0, 0.01, -0.01, 0.0]
            above = min(int(numpy.searchsorted(x, t, side="right")), 3)
            w = (t - x[above - 1]) / (x[above] - x[above - 1])
            strain.append((1.0 - w) * y[above - 1] + w * y[above] if t < 4.0 else y[-1])
        for law in (pfdm.Endochronic.of(case), pfdm.Endochronic(**self.soft_metal)):
            ours = law.respond({"strain_xx": strain}, time)
            self.assertEqual(list(ours.columns), list(theirs.columns))
            self.assert_same_columns(ours, theirs, {name: name for name in theirs.columns})
        self.assertEqual(ours.attrs["units"], theirs.attrs["units"])

    def test_give_the_stress_of_all_strains(self):
        law = pfdm.Endochronic(**self.soft_metal)
        strain = self.path()
        stress = law.stress(strain)
        pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
        tensors = numpy.empty((40, 3, 3))
        for k, (i, j) in enumerate(pairs):
            tensors[:, i, j] = tensors[:, j, i] = strain[:, k]
        of_tensors = law.stress(tensors)
        for k, (i, j) in enumerate(pairs):
            self.assertEqual(of_tensors[:, j, i].tobytes(), stress[:, k].tobytes())
        mean = stress[:, :3].mean(axis=1)  # elastic: K tr(eps)
        K = law.young_modulus / (3.0 * (1.0 - 2.0 * law.poisson_ratio))
        numpy.testing.assert_allclose(mean, K * strain[:, :3].sum(axis=1), rtol=1e-9, atol=1.0)

    def test_say_what_is_wrong(self):
        for values, said in [({"poisson_ratio": 0.7}, "poisson_ratio"), ({"kernel": []}, "at least one term"),
                             ({"hardening": {"law": "satturating"}}, "did you mean \"saturating\"")]:
            with self.assertRaisesRegex(pfdm.InputError, said):
                pfdm.Endochronic(**{**self.soft_metal, **values})
        law = pfdm.Endochronic(**self.soft_metal)
        zeros = numpy.zeros(4)
        for prescribed, time, said in [({"strain_xz_": zeros}, None, "did you mean"),
                                       ({"strain_xx": zeros}, zeros, "come after"),
                                       ({"strain_xx": zeros, "stress_xx": zeros}, None, "each pair"),
                                       ({"strain_xx": zeros, "strain_yy": numpy.zeros(3)}, None, "3 values are given"),
                                       ({"strain_xx": zeros * numpy.nan}, None, "finite")]:
            with self.assertRaisesRegex(pfdm.InputError, said):
                law.respond(prescribed, time)
        with self.assertRaisesRegex(pfdm.InputError, r"\(4, 3\)"):
            law.stress(numpy.zeros((4, 3)))
        with self.assertRaisesRegex(pfdm.ComputationError, "saturation surface"):
            law.respond({"stress_xx": [0.0, 1e9, 2e9]})


class InterfaceLaws(unittest.TestCase):
    numbers = {"strength": "2 MPa", "toughness": 100.0, "stiffness": "1e13 Pa/m"}

    def law(self, name, **others):
        return pfdm.InterfaceLaw(law=name, **{**self.numbers, **others})

    def test_reach_their_strength_and_take_their_toughness(self):
        names = [name for name in pfdm.InterfaceLaw.names() if name != "table"]
        self.assertIn("xu_needleman", names)
        opening = numpy.linspace(0.0, 100 * 50e-6, 400001)
        for name in names:
            law = self.law(name)
            traction = law.traction(opening)
            self.assertAlmostEqual(traction.max() / law.strength, 1.0, places=3, msg=name)
            work = ((traction[1:] + traction[:-1]) / 2 * numpy.diff(opening)).sum()
            self.assertAlmostEqual(work / law.toughness, 1.0, delta=0.01, msg=name)

    def test_are_those_of_their_equations(self):
        opening = numpy.array([[0.0, 5e-6], [2e-5, 8e-5]])
        x = opening * numpy.e * 2e6 / 100.0
        numpy.testing.assert_allclose(self.law("xu_needleman").traction(opening), 2e6 * x * numpy.exp(1.0 - x), rtol=1e-12)
        numpy.testing.assert_allclose(
            pfdm.softening("exponential", opening, strength="2 MPa", toughness="100 J/m^2"),
            2e6 * numpy.exp(-opening * 2e4), rtol=1e-12)
        self.assertIn("cornelissen", pfdm.softening_laws())

    def test_remember_what_has_happened(self):
        law = self.law("exponential", mixed_mode="benzeggagh_kenane", shear_strength="3 MPa", shear_toughness="200 J/m^2",
                       exponent=2.0)
        path = [[0.0, 0.0, 0.0], [2e-5, 0.0, 0.0], [1e-5, 0.0, 0.0], [2e-5, 0.0, 0.0], [2e-5, 1e-5, 0.0], [5e-3, 0.0, 0.0]]
        found = law.respond(path)
        tractions = found[["traction_n_Pa", "traction_s_Pa"]].to_numpy()
        self.assertAlmostEqual(tractions[2, 0], tractions[1, 0] / 2, delta=1e-6)
        self.assertAlmostEqual(tractions[3, 0] / tractions[1, 0], 1.0, places=12)
        self.assertGreater(tractions[4, 1], 0.0)
        self.assertTrue((numpy.diff(found["damage"]) >= 0.0).all())
        self.assertAlmostEqual(found["damage"].iloc[-1], 1.0, places=6)
        self.assertEqual(law.respond([0.0, 2e-5])["traction_n_Pa"].iloc[1], law.traction(2e-5))
        self.assertEqual(found.attrs["units"]["dissipated_J_per_m2"], "J/m^2")

    def test_say_what_is_wrong(self):
        for values, said in [({"law": "bilinaer"}, "did you mean \"bilinear\""), ({"stiffness": "rigid"}, "is required"),
                             ({"stiffness": 1.0}, "takes more than the toughness"),
                             ({"strength": "2 m"}, "expected a stress"),
                             ({"strenght": 1.0}, "did you mean \"strength\""),
                             ({"rate": {"law": "power", "reference_rate": "1 mm/s", "m": 0.2}}, "have no time")]:
            with self.assertRaisesRegex(pfdm.InputError, said):
                self.law("bilinear", **values) if "law" not in values else pfdm.InterfaceLaw(**{**self.numbers, **values})
        with self.assertRaisesRegex(pfdm.InputError, r"\(2, 2\)"):
            self.law("bilinear").respond([[0.0, 0.0], [1.0, 0.0]])
        with self.assertRaisesRegex(pfdm.InputError, "cornelissen"):
            pfdm.softening("corn", 0.0, strength=1.0, toughness=1.0)


if __name__ == "__main__":
    unittest.main()
