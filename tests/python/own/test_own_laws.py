"""Tests of laws written in Python: those that repeat a law of the program give its results, others those of a closed form;
what goes wrong in them ends a step as it does elsewhere."""

import gc
import os
import signal
import threading
import unittest
import weakref

from in_process import long_bar, rows_of
from own_laws import Elastic, J2Plasticity, LinearSoftening, NortonCreep, PlasticGlue, block, glued
from shared import Folder, shipped

import numpy
import pfdm

steel = {"young_modulus": 200e9, "poisson_ratio": 0.3, "yield_stress": 200e6, "isotropic": 10e9, "kinematic": 5e9}


def j2_block(folder, law):
    """Yields and is damaged on the left of an elastic half, forth and back."""
    text = 'young_modulus = "200 GPa"\npoisson_ratio = 0.3\n'
    if law:
        text += ('law = "j2_plasticity"\nyield_stress = "200 MPa"\nisotropic_hardening = "10 GPa"\n'
                 'kinematic_hardening = "5 GPa"\n')
    stiffer = 'regions = ["right"]\ndamageable = false\nyoung_modulus = "400 GPa"\npoisson_ratio = 0.1'
    return block(folder, x="0.02*sin(2*pi*t)", material=text, right=stiffer, toughness="5 kJ/m^2")


class Failing(Elastic):
    """Fails once, after so many calls."""

    def __init__(self, calls, act):
        self.left, self.act = calls, act

    def respond(self, *arguments):
        self.left -= 1
        if self.left == 0:
            self.act()
        return super().respond(*arguments)


def fail():
    raise LookupError("enough")


class Laws(Folder):
    def assert_rows_agree(self, ours, theirs, tolerance):
        self.assertEqual(len(ours), len(theirs))
        energies = ["elastic_energy_J", "fracture_energy_J", "external_work_J", "plastic_dissipation_J", "interface_energy_J",
                    "interface_dissipation_J"]
        for names in (["displacement_m"], ["force_x_N", "force_y_N"], ["max_damage"], energies):
            a, b = (numpy.array([[row[name] for name in names] for row in rows]) for rows in (ours, theirs))
            numpy.testing.assert_allclose(a, b, rtol=0.0, atol=tolerance * abs(b).max(), err_msg=str(names))

    def test_of_interfaces_repeat_those_of_the_program(self):
        case = pfdm.Case(shipped / "cohesive_dcb", {"interface[0].stiffness": "2e14 Pa/m", "mesh.x[1].cells": 18})
        theirs = rows_of(pfdm.FractureRun(case))
        self.assertGreater(theirs[-1]["interface_dissipation_J"], 0.0)
        ours = rows_of(pfdm.FractureRun(case, interfaces={"glue": LinearSoftening(2e14)}))
        self.assert_rows_agree(ours, theirs, 1e-9)

    def test_of_interfaces_are_those_of_a_closed_form(self):
        for x in ("0.02*sin(pi*t)", "0.02*(1-abs(2*t-1))"):  # at last nearly nothing is prescribed, and nothing at all
            with self.subTest(x):
                self.assert_glue_holds(x)

    def assert_glue_holds(self, x):
        K, H, E, length, area = 1e12, 2e11, 2e9, 4e-3, 4e-6
        run = pfdm.FractureRun(glued(self.folder, x=x), interfaces={"glue": PlasticGlue(K, H)})
        rows = rows_of(run)
        self.assertEqual(len(rows), 11)
        soft = 1.0 / (1.0 / K + length / E)  # of block and glue in series
        reached = max(row["displacement_m"] for row in rows)
        stays = (soft * reached - 2e6) / (soft + H)
        self.assertGreater(stays, 1e-6)
        for row in rows:
            u = row["displacement_m"]
            rising = row["load"] <= 0.5
            elastic = soft * u if rising else soft * (u - stays)
            due = min(elastic, 2e6 + H * (soft * u - 2e6) / (soft + H)) if rising else elastic
            self.assertAlmostEqual(row["force_x_N"], due * area, delta=1e-6 * 2e6 * area)
        self.assertAlmostEqual(rows[-1]["interface_dissipation_J"], 2e6 * stays * area, delta=1e-6 * 2e6 * stays * area)
        self.assertLess(rows[-1]["force_x_N"], 0.0)

    def test_of_materials_repeat_those_of_the_program(self):
        theirs = pfdm.FractureRun(j2_block(self.folder, law=True))
        their_rows = rows_of(theirs)
        their_strain, their_equivalent = theirs.fields["plastic_strain"], theirs.fields["equivalent_plastic_strain"]
        ours = pfdm.FractureRun(j2_block(self.folder, law=False), materials={"left": J2Plasticity(**steel)})
        our_rows = rows_of(ours)
        peak = max(range(len(their_rows)), key=lambda i: their_rows[i]["force_x_N"])
        self.assert_rows_agree(our_rows[:peak + 1], their_rows[:peak + 1], 1e-9)
        self.assert_rows_agree(our_rows, their_rows, 5e-8)  # the accelerated iterations of softening make rounding grow
        left = ours.cells_of("left")
        self.assertGreater(their_equivalent[left].min(), 1e-3)
        self.assertGreater(numpy.ptp(their_equivalent[left]), 1e-4)
        numpy.testing.assert_allclose(ours.fields["history_6"], their_equivalent, rtol=5e-8)
        numpy.testing.assert_allclose(ours.fields["inelastic_strain"], their_strain, atol=1e-9)
        self.assertGreater(ours.damage.max(), 0.05)
        numpy.testing.assert_allclose(ours.damage, theirs.damage, atol=1e-8)

    def test_of_materials_are_those_of_a_closed_form(self):
        E, A, m, time = 100e9, 1e-28, 3.0, 100.0
        case = block(self.folder, x="0.004*min(t/1e-5, 1)", material='young_modulus = "100 GPa"\npoisson_ratio = 0.3',
                     loading='duration = "100 s"', cells=(2, 1, 1))
        case = case.with_values({"loading.initial_increment": 1e-5, "loading.maximum_increment": 2e-3})
        law = NortonCreep(E, 0.3, A, m)
        run = pfdm.FractureRun(case, materials={"left": law, "right": law})
        worst, rows = 0.0, 0
        for row in run:
            if row["load"] < 1e-5:
                continue
            stress = row["force_x_N"] / 4e-6
            due = ((E * 1e-3) ** (1.0 - m) + (m - 1.0) * E * A * time * row["load"]) ** (1.0 / (1.0 - m))
            worst, rows = max(worst, abs(stress / due - 1.0)), rows + 1
        self.assertGreater(rows, 400)
        self.assertLess(stress, 0.75 * E * 1e-3)
        self.assertLess(worst, 0.01)

    def test_do_not_depend_on_the_number_of_threads(self):
        case = long_bar(**{"loading.end": 0.02, "loading.initial_increment": 0.01, "materials.concrete.damageable": True})
        found = []
        for threads in (1, 2):
            pfdm.set_threads(threads)
            run = pfdm.FractureRun(case, materials={"bar": Elastic()})
            self.assertGreater(len(run.cell_volumes), 5000)
            found.append((rows_of(run), run.damage.tobytes()))
        self.assertEqual(*found)


class Failures(Folder):
    def tearDown(self):
        pfdm.set_threads(2)

    def case(self):
        return long_bar(**{"loading.end": 0.03, "loading.initial_increment": 0.01, "loading.maximum_increment": 0.01})

    def test_end_a_step_and_leave_the_run_where_it_was(self):
        pfdm.set_threads(2)
        due = rows_of(pfdm.FractureRun(self.case(), materials={"bar": Elastic()}))
        for calls in (1, 9000, 14000):
            law = Failing(calls, fail)
            run = pfdm.FractureRun(self.case(), materials={"bar": law})
            rows, failures = [run.row], 0
            while not run.is_complete:
                before = run.row
                try:
                    rows.append(run.step())
                except LookupError as error:
                    self.assertEqual(error.args, ("enough",))
                    self.assertEqual(run.row, before)
                    failures += 1
            self.assertEqual((rows, failures), (due, 1))

    def test_by_every_call_of_every_thread_are_one_exception(self):
        class Never(Elastic):
            def respond(self, *arguments):
                raise LookupError("never")

        pfdm.set_threads(2)
        run = pfdm.FractureRun(self.case(), materials={"bar": Never()})
        for _ in range(3):
            with self.assertRaisesRegex(LookupError, "never"):
                run.step()
        self.assertEqual(run.state.step, 0)

    def test_by_ctrl_c_are_keyboard_interrupts(self):
        run = pfdm.FractureRun(self.case(), materials={"bar": Failing(3000, lambda: os.kill(os.getpid(), signal.SIGINT))})
        with self.assertRaises(KeyboardInterrupt):
            run.step()
        self.assertEqual(run.state.step, 0)
        self.assertEqual(run.step()["step"], 1)

    def test_of_interfaces_end_a_step(self):
        class Never(pfdm.OwnInterfaceLaw):
            def respond(self, *arguments):
                return 1.0 / 0.0

        run = pfdm.FractureRun(glued(self.folder, x="0.01*t"), interfaces={"glue": Never()})
        with self.assertRaises(ZeroDivisionError):
            run.step()
        self.assertEqual(run.state.step, 0)


class Places(Folder):
    def assert_refused(self, case, said, **laws):
        with self.assertRaisesRegex(pfdm.InputError, said):
            pfdm.FractureRun(case, **laws)

    def test_that_there_are_not_are_refused(self):
        case = glued(self.folder, x="0.01*t")
        law = PlasticGlue(1e12, 1e11)
        self.assert_refused(case, r'no interface "glu" \(there are: glue\)', interfaces={"glu": law})
        self.assert_refused(case, r'no region "top" \(there are: left, right\)', materials={"top": Elastic()})
        self.assert_refused(case, "derived from pfdm.OwnInterfaceLaw", interfaces={"glue": Elastic()})
        self.assert_refused(case, "derived from pfdm.OwnMaterial", materials={"left": len})
        law.history_size = 10
        self.assert_refused(case, "history_size is 10; a whole number from 0 to 9", interfaces={"glue": law})
        law.history_size = numpy.int64(2)
        self.assertGreater(pfdm.FractureRun(case, interfaces={"glue": law}).step()["force_x_N"], 0.0)
        law.history_size = 1.0
        self.assert_refused(case, "history_size is 1.0", interfaces={"glue": law})

    def test_with_what_a_law_cannot_have_are_refused(self):
        case = glued(self.folder, x="0.01*t")
        laws = {"interfaces": {"glue": PlasticGlue(1e12, 1e11)}}
        self.assert_refused(case.with_values({"interface[0].friction": 0.3}), "friction, rate and branches", **laws)
        self.assert_refused(case.with_values({"loading.maximum_dissipation": "1 uJ"}), "maximum_dissipation", **laws)
        rubber = case.with_values({"materials.block.law": "neo_hookean"})
        self.assert_refused(rubber, "the case has a material of finite strain", materials={"left": Elastic()})
        creep = {"materials": {"left": NortonCreep(2e9, 0.0, 1e-28, 3.0)}}
        self.assert_refused(case, "requires loading.duration", **creep)

    def test_of_other_laws_take_no_states(self):
        case = glued(self.folder, x="0.01*t")
        run = pfdm.FractureRun(case, interfaces={"glue": PlasticGlue(1e12, 1e11)})
        same = pfdm.FractureRun(case, interfaces={"glue": PlasticGlue(1e12, 1e11)})
        first = [run.step() for _ in range(4)]
        state = run.state
        then = [run.step() for _ in range(4)]
        run.restore(state)
        self.assertEqual([run.step() for _ in range(4)], then)
        same.restore(state)
        self.assertEqual([same.step() for _ in range(4)], then)
        self.assertNotEqual(first[-1], then[-1])
        for other in (pfdm.FractureRun(case), pfdm.FractureRun(case, interfaces={"glue": LinearSoftening(1e12)})):
            with self.assertRaisesRegex(pfdm.InputError, "other laws in Python"):
                other.restore(state)

    def test_that_are_closed_give_their_laws_back(self):
        case = glued(self.folder, x="0.01*t")
        law = PlasticGlue(1e12, 1e11)
        known = weakref.ref(law)
        run = pfdm.FractureRun(case, interfaces={"glue": law})
        run.step()
        self.assert_refused(case.with_values({"loading.maximum_dissipation": "1 uJ"}), "", interfaces={"glue": law})
        del law
        gc.collect()
        self.assertIsNotNone(known())
        run.close()
        gc.collect()
        self.assertIsNone(known())

    def test_cannot_change_the_threads_within_a_law(self):
        run = pfdm.FractureRun(long_bar(), materials={"bar": Failing(2, lambda: pfdm.set_threads(1))})
        with self.assertRaisesRegex(RuntimeError, "within a law"):
            run.step()

    def test_in_threads_of_their_own_do_not_disturb_each_other(self):
        case = glued(self.folder, x="0.01*t")
        due = rows_of(pfdm.FractureRun(case, interfaces={"glue": PlasticGlue(1e12, 1e11)}))
        found = [None, None]

        def work(i):
            found[i] = rows_of(pfdm.FractureRun(case, interfaces={"glue": PlasticGlue(1e12, 1e11)}))

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [due, due])


if __name__ == "__main__":
    unittest.main()
