"""Tests of the module pfdm: studies, sensitivities, specimens and fits that scripts start."""

import unittest

from shared import Folder, bar, shipped

import numpy
import pfdm

toughness = "materials.concrete.toughness"
young_modulus = "materials.concrete.young_modulus"


class Studies(Folder):
    def test_of_all_combinations_find_what_is_there_already(self):
        values = {toughness: ["50 J/m^2", "100 J/m^2"], "fracture.length": ["12 mm", "16 mm"]}
        table = pfdm.sweep(bar(), values, self.folder / "study", processes=2)
        self.assertEqual(list(table[toughness]), ["50 J/m^2"] * 2 + ["100 J/m^2"] * 2)
        # AT2: the strength goes with the square root of Gc over ell.
        self.assertAlmostEqual(table["peak_force_N"][2] / table["peak_force_N"][0], 2**0.5, delta=0.05)
        before = [r.folder.joinpath("summary.json").stat().st_mtime_ns for r in table["results"]]
        pfdm.sweep(bar(), values, self.folder / "study", processes=2)
        self.assertEqual([r.folder.joinpath("summary.json").stat().st_mtime_ns for r in table["results"]], before)
        other = pfdm.sweep(bar(), {toughness: ["60 J/m^2"]}, self.folder / "study")
        self.assertLess(table["peak_force_N"][0], other["peak_force_N"][0])

    def test_tell_which_runs_failed(self):
        case = bar(**{"loading.minimum_increment": 0.01})
        table = pfdm.sweep(case, {"solver.maximum_iterations": [2, 5000]}, self.folder / "study")
        self.assertTrue(table["status"][0].startswith("failed: "))
        self.assertEqual(table["status"][1], "complete")


class Sensitivities(Folder):
    def test_are_tables_and_events(self):
        case = bar()
        direct = case.sensitivity(self.folder / "direct", parameters=[young_modulus, toughness], method="direct")
        differences = case.sensitivity(self.folder / "differences", parameters=young_modulus, step=0.02)
        first, other = (r.sensitivity[f"elasticity_{young_modulus}"].dropna().iloc[0] for r in (direct, differences))
        self.assertAlmostEqual(first, other, places=3)
        self.assertGreater(first, 0.8)
        self.assertEqual(differences.sensitivities["parameters"][0]["name"], young_modulus)
        with self.assertRaises(pfdm.InputError):
            case.sensitivity(self.folder / "none", parameters=["materials.none"])


class Specimens(Folder):
    def test_are_cases_whose_records_are_reduced(self):
        record = self.folder / "record.csv"
        rows = [f"{0.1 * i};{i}" for i in range(21)] + [f"{2 + 0.1 * i};{20 - 0.1 * i}" for i in range(1, 20)]
        record.write_text("Opening [mm];Load [N]\n" + "\n".join(rows) + "\n")
        case = pfdm.specimen(self.folder / "dcb", "double_cantilever_beam", data=record, width="20 mm")
        self.assertEqual(case["experiment.reduction.width"], "20 mm")
        test, = case.reduce().reduction["tests"]
        self.assertAlmostEqual(test["initial_compliance_m_per_N"], 1e-4)
        self.assertGreater(test["methods"][3]["propagation"]["G_J_per_m2"], 0.0)
        with self.assertRaises(pfdm.InputError):
            pfdm.specimen(self.folder / "other", "double_cantilever_beam", width="20")


class Fits(Folder):
    def test_have_estimates_with_intervals_and_a_case(self):
        case = pfdm.Case(shipped / "endochronic_calibration")
        fit = case.fit(self.folder / "results")
        self.assertIn(fit.verdict, ("sound", "questionable"))
        content = fit.content["parameters"]
        self.assertEqual(list(fit.estimates["estimate"]), [p["estimate"] for p in content])
        self.assertEqual(list(fit.correlation.columns), [p["name"] for p in content])
        run = fit.case.run()
        self.assertEqual((run.folder, run.status), (self.folder / "results/fitted", "complete"))
        self.assertEqual(pfdm.Case(run.folder).results().folder, run.folder)
        self.assertIsNone(fit.posterior)
        self.assertEqual(fit.laws, [])

    def test_have_samples_of_the_posterior(self):
        curve = bar().run(self.folder / "truth").curve
        stiffness = curve["force_x_N"][1] / curve["displacement_m"][1]
        noise = numpy.random.default_rng(4).normal(0.0, 0.02, 41)
        at = numpy.linspace(0.0, 4e-6, 41)
        place = self.folder / "bar"
        place.mkdir()
        rows = "".join(f"{u},{stiffness * u + n}\n" for u, n in zip(at, noise))
        (place / "data.csv").write_text("# SYNTHETIC, made by the test\nu_m,F_N\n" + rows)
        (place / "case.toml").write_text((shipped / "bar_at2/case.toml").read_text() + """
[experiment]
stiffness_between = ["1 um", "3 um"]
[[experiment.specimens]]
name = "one"
csv = "data.csv"
displacement = { column = "u_m" }
force = { column = "F_N" }
[fit]
intervals = "posterior"
[[fit.parameters]]
key = "materials.concrete.young_modulus"
bounds = ["10 GPa", "90 GPa"]
[[fit.stages]]
name = "elastic"
between = ["0 um", "4 um"]
""")
        fit = pfdm.Case(place, {"mesh.x[0].cells": 21, "fracture.length": "12 mm"}).fit()
        self.assertTrue(fit.verdict.startswith("sound"), fit.reasons)
        name = "materials.concrete.young_modulus"
        samples, modulus = fit.posterior[name], fit.estimates.loc[name]
        self.assertEqual(fit.posterior.attrs["units"], {name: "Pa"})
        self.assertLess(abs(samples.mean() - modulus.estimate), 0.2 * modulus.standard_error)
        self.assertLess(abs(samples.std() / modulus.standard_error - 1.0), 0.15)
        self.assertIsNone(fit.discrepancy)
        with_discrepancy = pfdm.Case(place, {"mesh.x[0].cells": 21, "fracture.length": "12 mm",
                                             "fit.intervals": "discrepancy"}).fit(self.folder / "wide")
        lacking = with_discrepancy.discrepancy
        self.assertTrue((lacking["lower_force_N"] < lacking["upper_force_N"]).all())
        self.assertAlmostEqual(lacking["displacement_m"].iloc[-1], 4e-6)
        self.assertGreater(with_discrepancy.posterior[name].std(), samples.std())


if __name__ == "__main__":
    unittest.main(verbosity=2)
