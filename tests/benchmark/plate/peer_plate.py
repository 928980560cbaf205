#!/usr/bin/env python3
"""The plate of cases/plate_ambient by finite elements: modes, response to the base's motion, heating, in one run.

Needs dolfinx 0.5 with slepc4py (Debian 12: apt-get install --no-install-recommends python3-dolfinx-real
python3-slepc4py-real). Call: OMP_NUM_THREADS=1 peer_plate.py NX NY NZ DEGREE [minutes] [convection of the faces]

Hexahedra of the given degree on the same box mesh. Modes: SLEPc, shift-invert at zero with MUMPS. Response: modes with
the static correction. Heat source: 1/2 omega Im(c) Re(sigma:conj(eps)), projected by lumping; transient conduction,
linear elements, backward Euler with steps of 15 s. Prints one line of JSON with CPU seconds by stage.
"""
import json
import resource
import sys
import time

import numpy as np
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc
from slepc4py import SLEPc

NX, NY, NZ, DEGREE = (int(word) for word in sys.argv[1:5])
MINUTES = float(sys.argv[5]) if len(sys.argv) > 5 else 60.0
AIR = float(sys.argv[6]) if len(sys.argv) > 6 else 8.0
LX, LY, LZ = 0.1778, 0.254, 0.0127
RHO, E, NU, ETA = 1150.0, 50e6, 0.45, 0.185
CONDUCTIVITY, CAPACITY, CLAMP = 0.25, RHO * 1790.0, 100.0
LEVEL, N_MODES, N_SUMMED, STEP = 2.0 * 9.80665, 6, 30, 15.0

spent = {}


class Stage:
    def __init__(self, name):
        self.name = name

    def __enter__(self):
        self.start = time.process_time()

    def __exit__(self, *_):
        spent[self.name] = round(time.process_time() - self.start, 2)


def factored(A, kind):
    solver = PETSc.KSP().create(MPI.COMM_WORLD)
    solver.setOperators(A)
    solver.setType("preonly")
    solver.getPC().setType(kind)
    solver.getPC().setFactorSolverType("mumps")
    return solver


box = mesh.create_box(MPI.COMM_WORLD, [[0, 0, 0], [LX, LY, LZ]], [NX, NY, NZ], mesh.CellType.hexahedron)
V = fem.VectorFunctionSpace(box, ("CG", DEGREE))
u, v = ufl.TrialFunction(V), ufl.TestFunction(V)
MU, LAMBDA = E / 2 / (1 + NU), E * NU / (1 + NU) / (1 - 2 * NU)
eps = lambda w: ufl.sym(ufl.grad(w))  # noqa: E731
sigma = lambda w: 2 * MU * eps(w) + LAMBDA * ufl.tr(eps(w)) * ufl.Identity(3)  # noqa: E731
ends = lambda x: np.isclose(x[0], 0.0) | np.isclose(x[0], LX)  # noqa: E731

with Stage("assembly"):
    held = fem.locate_dofs_geometrical(V, ends)
    clamp = fem.dirichletbc(np.zeros(3), held, V)
    K = fem.petsc.assemble_matrix(fem.form(ufl.inner(sigma(u), eps(v)) * ufl.dx), bcs=[clamp], diagonal=1.0)
    K.assemble()
    M = fem.petsc.assemble_matrix(fem.form(RHO * ufl.inner(u, v) * ufl.dx), bcs=[clamp], diagonal=1e-12)
    M.assemble()
    whole = fem.petsc.assemble_matrix(fem.form(RHO * ufl.inner(u, v) * ufl.dx))
    whole.assemble()

with Stage("modes"):
    solver = SLEPc.EPS().create(MPI.COMM_WORLD)
    solver.setOperators(K, M)
    solver.setProblemType(SLEPc.EPS.ProblemType.GHEP)
    solver.setDimensions(N_SUMMED)
    solver.setTolerances(1e-9)
    transform = solver.getST()
    transform.setType("sinvert")
    transform.setShift(0.0)
    transform.getKSP().setType("preonly")
    transform.getKSP().getPC().setType("cholesky")
    transform.getKSP().getPC().setFactorSolverType("mumps")
    solver.setTarget(0.0)
    solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
    solver.solve()
    shapes, omega = [], []
    for k in range(min(solver.getConverged(), N_SUMMED)):
        shape = K.createVecRight()
        omega.append(np.sqrt(solver.getEigenpair(k, shape).real))
        shape.scale(1.0 / np.sqrt(shape.dot(M * shape)))
        shapes.append(shape)
    omega = np.array(omega)

with Stage("response"):
    rigid = fem.Function(V)
    rigid.interpolate(lambda x: np.stack([0 * x[0], 0 * x[0], 1 + 0 * x[0]]))
    load = whole * rigid.vector
    array = load.array
    array[(held[:, None] * 3 + np.arange(3)).ravel()] = 0.0
    load.array = array
    participation = np.array([shape.dot(load) for shape in shapes])
    static = K.createVecRight()
    transform.getKSP().solve(load, static)
    static_moment = static.dot(load)
    C = 1.0 + 1j * ETA

    def weights(w):
        """Of the modes, beside -static/C, per unit of the base's acceleration."""
        return -participation * (1.0 / (C * omega**2 - w**2) - 1.0 / (C * omega**2))

    def power(w):
        moment = -static_moment / C + (weights(w) * participation).sum()
        return 0.5 * w * moment.imag

    frequencies = np.geomspace(30.0, 400.0, 200)
    curve = [power(2 * np.pi * f) for f in frequencies]
    lower, upper = frequencies[np.argmax(curve) - 1], frequencies[np.argmax(curve) + 1]
    for _ in range(60):
        a, b = lower + 0.382 * (upper - lower), lower + 0.618 * (upper - lower)
        lower, upper = (a, upper) if power(2 * np.pi * a) < power(2 * np.pi * b) else (lower, b)
    driven = 0.5 * (lower + upper)
    w = 2 * np.pi * driven
    parts = []
    for part in (np.real, np.imag):
        field = fem.Function(V)
        field.vector.axpy(part(-1.0 / C), static)
        for weight, shape in zip(weights(w), shapes):
            field.vector.axpy(part(weight), shape)
        field.vector.scale(LEVEL)
        parts.append(field)

with Stage("heating"):
    T = fem.FunctionSpace(box, ("CG", 1))
    t, s = ufl.TrialFunction(T), ufl.TestFunction(T)
    heat = 0.5 * w * ETA * sum(ufl.inner(sigma(part), eps(part)) for part in parts)
    source = fem.petsc.assemble_vector(fem.form(heat * s * ufl.dx))
    fixture = mesh.locate_entities_boundary(box, 2, ends)
    open_air = mesh.locate_entities_boundary(
        box, 2, lambda x: np.isclose(x[2], 0) | np.isclose(x[2], LZ) | np.isclose(x[1], 0) | np.isclose(x[1], LY))
    top = mesh.locate_entities_boundary(box, 2, lambda x: np.isclose(x[2], LZ))
    top_only = mesh.meshtags(box, 2, np.sort(top), np.full(len(top), 1, np.int32))
    both = np.concatenate([fixture, open_air])
    values = np.concatenate([np.full(len(fixture), 1), np.full(len(open_air), 2)]).astype(np.int32)
    order = np.argsort(both)
    tags = mesh.meshtags(box, 2, both[order], values[order])
    ds = ufl.Measure("ds", box, subdomain_data=tags)
    stored = fem.petsc.assemble_matrix(fem.form(CAPACITY * t * s * ufl.dx))
    stored.assemble()
    A = fem.petsc.assemble_matrix(fem.form(CAPACITY * t * s * ufl.dx + STEP * CONDUCTIVITY
                                           * ufl.inner(ufl.grad(t), ufl.grad(s)) * ufl.dx
                                           + STEP * CLAMP * t * s * ds(1) + STEP * AIR * t * s * ds(2)))
    A.assemble()
    direct = factored(A, "cholesky")
    rise = fem.Function(T)
    for _ in range(round(MINUTES * 60 / STEP)):
        right = stored * rise.vector
        right.axpy(STEP, source)
        direct.solve(right, rise.vector)
    seen = ufl.Measure("ds", box, subdomain_data=top_only)(1)
    area = LX * LY
    on_top = fem.locate_dofs_topological(T, 2, top)

total = RHO * LX * LY * LZ
print(json.dumps({
    "unknowns": V.dofmap.index_map.size_global * 3,
    "modes_Hz": [round(f, 3) for f in (omega[:N_MODES] / 2 / np.pi).tolist()],
    "effective_mass": round(float(participation[0]**2 / total), 4),
    "driven_Hz": round(float(driven), 3),
    "power_W": round(float(LEVEL**2 * power(w)), 5),
    "heat_over_power": round(float(source.sum() / (LEVEL**2 * power(w))), 6),
    "surface_mean_rise_K": round(fem.assemble_scalar(fem.form(rise * seen)) / area, 4),
    "surface_largest_rise_K": round(float(rise.x.array[on_top].max()), 4),
    "cpu_s": spent,
    "cpu_s_in_all": round(time.process_time(), 1),
    "peak_MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024}))
