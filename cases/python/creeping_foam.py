"""A law of one's own in Python: a bar of foam that creeps is stretched at a constant rate.

    ./pfdm python cases/python/creeping_foam.py

Material: E = 30 MPa without lateral contraction, and a strain that creeps along the stress at the rate A stress^2 (Norton
1929), which the program does not have; A = 1e-14 Pa^-2 s^-1, chosen. From stress' = E (rate - A stress^2) the stress is
(rate/A)^(1/2) tanh(E (rate A)^(1/2) t).
"""

from pathlib import Path

import numpy
import pfdm

E, A = 30e6, 1e-14  # [Pa], [Pa^-2 s^-1]
rate, time, width = 1e-4, 100.0, 1e-3  # [1/s], [s], [m]


class CreepingFoam(pfdm.OwnMaterial):
    history_size = 6  # the strain that has crept
    depends_on_rate = True

    def respond(self, strain_before, strain, history, duration):
        trial = E * (strain - history)
        size = numpy.linalg.norm(trial)
        if size == 0.0:
            return pfdm.MaterialResponse(trial, E * numpy.eye(6), history)
        b = E * duration * A  # left + b left^2 = size, of the stress at the end of the step
        slope = numpy.sqrt(1.0 + 4.0 * b * size)  # 1 + 2 b left
        left = 2.0 * size / (1.0 + slope)
        stress, along = trial * left / size, numpy.outer(trial, trial) / size**2
        tangent = E * (left / size * (numpy.eye(6) - along) + along / slope)
        return pfdm.MaterialResponse(stress, tangent, strain - stress / E, dissipated=duration * A * left**3)


case = pfdm.Case(Path(__file__).parents[1] / "bar_at2", {
    "mesh.x[0].cells": 3, "materials.concrete.young_modulus": f"{E} Pa", "materials.concrete.damageable": False,
    "boundary[1].displacement[0]": f"{0.1 * rate * time} m",  # of 0.1 m
    "loading.duration": f"{time} s", "loading.initial_increment": 0.0025, "loading.maximum_increment": 0.0025})
foam = CreepingFoam()

with pfdm.FractureRun(case, materials={"bar": foam, "weak": foam}) as run:
    largest = 0.0
    for row in run:
        stress = row["force_x_N"] / width**2
        due = (rate / A) ** 0.5 * numpy.tanh(E * (rate * A) ** 0.5 * time * row["load"])
        largest = max(largest, abs(stress / due - 1.0))
        if row["step"] % 50 == 0:
            print(f"{time * row['load']:6.2f} s: {1e-3 * stress:7.2f} kPa, expected {1e-3 * due:7.2f} kPa")
print(f"largest difference {100.0 * largest:.2f} %")
