"""A fit by SciPy, as the README of cases/python shows one, against that of the program: the shipped bar on fewer cells."""

import sys
import unittest

from shared import Folder, shipped

try:
    import scipy.optimize
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import numpy
import pandas
import pfdm

GUESS = numpy.array([30e9, 3e6, 120.0])  # Pa, Pa, J/m^2: of case.toml
COARSE = {"mesh.x[1].cells": 81}


def with_parameters(case, values):
    modulus, strength, toughness = values
    return case.with_values({"materials.concrete.young_modulus": f"{modulus} Pa",
                             "materials.concrete.strength": f"{strength} Pa",
                             "regions.weak.strength": f"{2.99 / 3 * strength} Pa",  # stays as much weaker
                             "materials.concrete.toughness": f"{toughness} J/m^2"})


class OwnFit(Folder):
    def test_meets_the_estimates_of_the_program(self):
        case = pfdm.Case(shipped / "bar_fit", COARSE)
        data = pandas.read_csv(shipped / "bar_fit/data/synthetic_force_displacement.csv", comment="#")

        def residuals(x):
            run = with_parameters(case, x * GUESS).run(self.folder / "run", threads=1)
            force = numpy.interp(1e-6 * data["displacement_um"], run.curve["displacement_m"], run.curve["force_x_N"])
            return (force - data["force_N"]) / data["force_deviation_N"]

        own = scipy.optimize.least_squares(residuals, numpy.ones(3), jac="3-point", diff_step=0.02, ftol=1e-4, xtol=1e-4)
        errors = numpy.sqrt(numpy.diag(numpy.linalg.inv(own.jac.T @ own.jac)))
        fit = case.fit(self.folder / "fit")
        theirs = fit.estimates["estimate"].to_numpy() / GUESS
        self.assertTrue(own.success, own.message)
        self.assertTrue(numpy.all(numpy.abs(own.x - theirs) < errors), (own.x - theirs) / errors)


if __name__ == "__main__":
    unittest.main()
