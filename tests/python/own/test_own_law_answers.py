"""Tests of what laws written in Python answer: shapes and numbers that there cannot be."""

import unittest

from in_process import long_bar
from own_laws import Elastic, glued, three
from shared import Folder

import numpy
import pfdm


class Answers(Folder):
    def test_of_interfaces_say_what_is_expected(self):
        def law(*returned):
            class Wrong(pfdm.OwnInterfaceLaw):
                history_size = 1

                def respond(self, *arguments):
                    return returned

            return Wrong()

        for answer, said in [((numpy.zeros(2), three, [0.0], 0.0, 0.0), r"glue.*Wrong.*traction.*\(2,\); \(3,\)"),
                             ((numpy.zeros(3), three[0], [0.0], 0.0, 0.0), r"tangent.*\(3,\); \(3, 3\)"),
                             ((numpy.zeros(3), three, [], 0.0, 0.0), r"history.*\(0,\); \(1,\)"),
                             ((numpy.zeros(3), three, [0.0], "much", 0.0), "stored energy.*no array of numbers"),
                             ((numpy.zeros(3), three), "a tuple of 5 entries"),
                             (([numpy.nan, 0.0, 0.0], three, [0.0], 0.0, 0.0), "glue.*Wrong.*traction.*is not finite"),
                             ((numpy.zeros(3), three * numpy.inf, [0.0], 0.0, 0.0), "tangent.*is not finite"),
                             ((numpy.zeros(3), three, [0.0], 0.0, numpy.nan), "dissipated energy.*is not finite")]:
            run = pfdm.FractureRun(glued(self.folder, x="0.01*t"), interfaces={"glue": law(*answer)})
            with self.assertRaisesRegex(pfdm.InputError, said):
                run.step()

    def test_of_stresses_that_are_not_finite_cut_the_increment(self):
        class Breaks(Elastic):
            def respond(self, strain_before, strain, history, duration):
                far = abs(strain - strain_before).max() > 1e-6
                wrong = numpy.nan if far else 1.0
                return pfdm.MaterialResponse(self.C @ strain * wrong, self.C, dissipated=0.0 * wrong)

        run = pfdm.FractureRun(long_bar(**{"mesh.x[0].cells": 21, "loading.initial_increment": 0.01}),
                               materials={"bar": Breaks()})
        self.assertLess(run.step()["load"], 0.002)
        self.assertTrue(run.remarks)

    def test_of_materials_have_energies_that_there_can_be(self):
        class Wrong(Elastic):
            def __init__(self, **energies):
                self.energies = energies

            def respond(self, strain_before, strain, history, duration):
                return pfdm.MaterialResponse(self.C @ strain, self.C, **self.energies)

        case = long_bar(**{"mesh.x[0].cells": 21, "loading.initial_increment": 0.01})
        for energies, said in [({"locked": numpy.nan}, "bar.*Wrong.*locked energy.*is not finite"),
                               ({"dissipated": numpy.inf}, "dissipated energy.*is not finite"),
                               ({"dissipated": -1.0}, "dissipated energy.*is -1; it must not be negative")]:
            run = pfdm.FractureRun(case, materials={"bar": Wrong(**energies)})
            with self.assertRaisesRegex(pfdm.InputError, said):
                run.step()
            self.assertEqual(run.state.step, 0)

    def test_of_materials_may_have_a_dissipation_of_rounding(self):
        class Rounded(Elastic):
            def respond(self, strain_before, strain, history, duration):
                return pfdm.MaterialResponse(self.C @ strain, self.C, dissipated=-1e-15 * strain @ self.C @ strain)

        run = pfdm.FractureRun(long_bar(**{"mesh.x[0].cells": 21, "loading.initial_increment": 0.01}),
                               materials={"bar": Rounded()})
        self.assertEqual(run.step()["step"], 1)


if __name__ == "__main__":
    unittest.main()
