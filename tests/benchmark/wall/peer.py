#!/usr/bin/python3
"""A peer of the wall: the problem of a case in dolfinx 0.5.2 (Debian 12), with linear elements and alternate minimisation.

    OMP_NUM_THREADS=1 tests/benchmark/wall/peer.py tests/benchmark/wall/sent_tension/case.toml --refinement 2 --output peer.csv

Displacement and damage of degree 1 on triangles (rectangles cut in two) or tetrahedra (boxes cut in six). Damage: bounds by PETSc's
SNESVI (vinewtonrsls). Displacement: conjugate gradients, with MUMPS' factors of an earlier matrix where flat, and with GAMG in
space. Forces, energies and CPU seconds of each step go to a CSV file, in SI units; the CPU seconds of imports, of the compilation
of forms and of the mesh are not among them.
"""

import argparse
import csv
import json
import logging
import resource
import time

import numpy as np
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

import case_file
import peer_energy
from peer_mesh import make_mesh, rigid_motions

COMPILATION = {"cffi_extra_compile_args": ["-O3", "-march=native", "-ffast-math"], "cffi_libraries": ["m"]}
LAGGED = 4  # conjugate gradient iterations with an old preconditioner after which a new one is made
EQUILIBRIUM = 1e-6
FACTORS = {"ksp_type": "cg", "pc_type": "cholesky", "pc_factor_mat_solver_type": "mumps"}
LU = {"ksp_type": "gmres", "pc_type": "lu", "pc_factor_mat_solver_type": "mumps"}
MULTIGRID = {"ksp_type": "cg", "pc_type": "gamg", "pc_gamg_type": "agg", "pc_gamg_agg_nsmooths": 1, "pc_gamg_threshold": 0.01,
             "pc_gamg_coarse_eq_limit": 500, "mg_levels_ksp_type": "chebyshev", "mg_levels_pc_type": "jacobi",
             "mg_levels_ksp_max_it": 2}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", help="case.toml")
    parser.add_argument("--refinement", type=float, default=1.0, help="factor on the cells of each block")
    parser.add_argument("--steps", type=float, default=1.0, help="factor on the number of steps")
    parser.add_argument("--tolerance", type=float, help="of the damage, in place of the case's")
    parser.add_argument("--cells", default="simplices", choices=("simplices", "boxes"), help="boxes: bilinear elements")
    parser.add_argument("--solver", choices=("mumps", "gamg"), help="of the displacement")
    parser.add_argument("--corrected", action="store_true", help="toughness less what linear elements add to a crack's energy")
    parser.add_argument("--over-relaxation", type=float, default=1.0, help="of the damage, 1: none (Farrell, Maurini 2017)")
    parser.add_argument("--most-seconds", type=float, default=450.0, help="CPU seconds after which the run ends")
    parser.add_argument("--output", default="peer.csv")
    return parser.parse_args()


def cpu():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def zero(vector):
    with vector.localForm() as local:
        local.set(0)


class Peer:
    def __init__(self, case, options):
        self.case = case
        self.body = make_mesh(case, options.cells)
        self.V = fem.VectorFunctionSpace(self.body, ("Lagrange", 1))
        self.D = fem.FunctionSpace(self.body, ("Lagrange", 1))
        self.u, self.d = fem.Function(self.V), fem.Function(self.D)
        self.tolerance = options.tolerance or case.table["solver"]["damage_tolerance"]
        self.omega, self.corrected = options.over_relaxation, options.corrected
        self.linear = self.case.fracture["split"] == "none" and "law" not in self.case.material
        self.krylov = self.factorings = 0
        self.make_forms(2 if options.cells == "simplices" else 3)
        self.hold()
        self.make_momentum(options.solver or ("mumps" if case.flat else "gamg"))
        self.make_damage()

    def make_forms(self, order):
        quantity, material, fracture = case_file.quantity, self.case.material, self.case.fracture
        ell, Gc, k = quantity(fracture["length"]), quantity(material["toughness"]), fracture["residual_stiffness"]
        if self.corrected:  # Bourdin, Francfort, Marigo, J. Elasticity 91 (2008) 5: Gc (1 + h/(2 ell)); AT1: 3 h/(8 ell)
            h = min(np.diff(a).min() for a in self.case.axes)
            Gc /= 1 + {"AT1": 3 / 8, "AT2": 1 / 2}[fracture["model"]] * h / ell
        dx = ufl.dx(domain=self.body, metadata={"quadrature_degree": order})
        moduli = quantity(material["young_modulus"]), material["poisson_ratio"]
        opening, closing = peer_energy.parts(self.u, self.case.dimension, material.get("law"), fracture["split"], *moduli)
        elastic = self.case.thickness * (((1 - k) * (1 - self.d) ** 2 + k) * opening + closing) * dx
        slope = ell * ufl.dot(ufl.grad(self.d), ufl.grad(self.d))
        surface = self.case.thickness * {"AT1": 3 * Gc / 8 * (self.d / ell + slope), "AT2": Gc / 2 * (self.d**2 / ell + slope)}[fracture["model"]] * dx

        def form(f):
            return fem.form(f, jit_params=COMPILATION)

        self.elastic, self.surface = form(elastic), form(surface)
        force = ufl.derivative(elastic, self.u, ufl.TestFunction(self.V))
        self.force, self.stiffness = form(force), form(ufl.derivative(force, self.u, ufl.TrialFunction(self.V)))
        self.move = fem.Function(self.V)
        self.moved = form(ufl.action(ufl.derivative(force, self.u, ufl.TrialFunction(self.V)), self.move))
        slope = ufl.derivative(elastic + surface, self.d, ufl.TestFunction(self.D))
        self.slope, self.curvature = form(slope), form(ufl.derivative(slope, self.d, ufl.TrialFunction(self.D)))

    def patch(self, name, component):
        facets = mesh.locate_entities_boundary(self.body, self.case.dimension - 1, self.case.patch(name))
        return fem.locate_dofs_topological(self.V.sub(component), self.case.dimension - 1, facets)

    def hold(self):
        """Prescribed displacements: their unknowns, and what gives their values [m]; of two on one unknown the later wins."""
        places, n = self.V.tabulate_dof_coordinates().T, self.case.dimension
        self.given, self.held, none = [], [], PETSc.ScalarType(0)
        for patch, component, value in self.case.held():
            dofs = self.patch(patch, component)
            self.given.append((dofs, value, places[:, dofs // n]))
            self.held.append(fem.dirichletbc(none, dofs, self.V.sub(component)))
        self.fixed = np.unique(np.concatenate([dofs for dofs, _, _ in self.given]))
        self.target = np.zeros(len(self.u.x.array))
        curve = self.case.table["output"]["curve"]
        self.curve = self.patch(curve["patch"], "xyz".index(curve["component"]))

    def load(self, t):
        for dofs, value, x in self.given:
            self.target[dofs] = value(x, t)

    def make_solver(self, matrix, prefix, settings, rtol):
        solver, options = PETSc.KSP().create(MPI.COMM_SELF), PETSc.Options()
        for key, value in settings.items():
            options[prefix + key] = value
        solver.setOptionsPrefix(prefix)
        solver.setOperators(matrix)
        solver.setFromOptions()
        solver.setTolerances(rtol=rtol, max_it=2000)
        return solver

    def make_momentum(self, kind):
        self.A, self.F, self.change = fem.petsc.create_matrix(self.stiffness), fem.petsc.create_vector(self.force), fem.Function(self.V)
        self.A.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        finite = "law" in self.case.material  # the tangent may be indefinite
        self.A.setOption(PETSc.Mat.Option.SPD, not finite)
        if kind == "gamg":
            self.A.setNearNullSpace(rigid_motions(self.V, self.case.dimension))
        self.momentum = self.make_solver(self.A, "u_", (LU if finite else FACTORS) if kind == "mumps" else MULTIGRID, 1e-7)
        self.most = {"mumps": LAGGED, "gamg": 0}[kind]
        self.usual = None

    def make_damage(self):
        self.B, self.G, self.residual = (fem.petsc.create_matrix(self.curvature), fem.petsc.create_vector(self.slope),
                                         fem.petsc.create_vector(self.slope))
        options = PETSc.Options()
        for key, value in {"ksp_type": "cg", "pc_type": "icc", "ksp_rtol": 1e-7, "snes_linesearch_type": "basic"}.items():
            options["d_" + key] = value
        self.vi = PETSc.SNES().create(MPI.COMM_SELF)
        self.vi.setOptionsPrefix("d_")
        self.vi.setType("vinewtonrsls")
        self.vi.setFunction(self.damage_residual, self.residual)
        self.vi.setJacobian(lambda snes, x, J, P: None, self.B)
        self.vi.setFromOptions()
        self.lower, self.upper = self.d.vector.copy(), self.d.vector.copy()
        self.upper.set(1.0)
        self.vi.setVariableBounds(self.lower, self.upper)

    def damage_residual(self, snes, x, f):
        """The energy is quadratic in the damage: slope = curvature d + slope at d = 0."""
        self.B.mult(x, f)
        f.axpy(1.0, self.G)

    def forces(self):
        zero(self.F)
        fem.petsc.assemble_vector(self.F, self.force)
        return self.F

    def balance(self):
        """Newton's method for u; without a split its first step is exact. The supports move in the first step."""
        for _ in range(50):
            self.A.zeroEntries()
            fem.petsc.assemble_matrix(self.A, self.stiffness, bcs=self.held)
            self.A.assemble()
            self.move.x.array[self.fixed] = self.target[self.fixed] - self.u.x.array[self.fixed]
            self.forces()
            if np.abs(self.move.x.array).max() > 0:
                fem.petsc.assemble_vector(self.F, self.moved)
            self.F.array[self.fixed] = 0.0
            self.solve_linear()
            if self.advance(self.move.x.array - self.change.x.array) < EQUILIBRIUM:
                return
        raise RuntimeError("momentum: 50 iterations of Newton's method do not converge")

    def advance(self, step):
        """Adds a step of Newton's method, halved up to six times where the forces on the free nodes grow; what they are then."""
        if self.linear:
            self.u.x.array[:] += step
            return 0.0
        start, before = self.u.x.array.copy(), self.unbalance()
        for halvings in range(7):
            self.u.x.array[:] = start + step / 2**halvings
            now = self.unbalance()
            if now < before or np.abs(self.move.x.array).max() > 0:
                break
        return now

    def unbalance(self):
        """Forces on the free nodes over those on all."""
        every = self.forces().array
        free = every.copy()
        free[self.fixed] = 0.0
        return np.linalg.norm(free) / max(np.linalg.norm(every), 1e-300)

    def solve_linear(self):
        """With factors, or the multigrid, of an earlier matrix as long as that takes few iterations."""
        limit = self.most or (int(1.5 * self.usual) + 2 if self.usual else 0)
        if self.usual is not None:
            self.momentum.setTolerances(max_it=limit)
            self.momentum.getPC().setReusePreconditioner(True)
            self.momentum.solve(self.F, self.change.vector)
            self.krylov += self.momentum.getIterationNumber()
            if self.momentum.getConvergedReason() > 0:
                return
        self.momentum.setTolerances(max_it=3000)
        self.momentum.getPC().setReusePreconditioner(False)
        self.momentum.solve(self.F, self.change.vector)
        self.krylov += self.momentum.getIterationNumber()
        self.factorings += 1
        self.usual = max(self.momentum.getIterationNumber(), 8)
        if self.momentum.getConvergedReason() < 0:
            raise RuntimeError(f"momentum: reason {self.momentum.getConvergedReason()}")

    def break_more(self):
        self.B.zeroEntries()
        fem.petsc.assemble_matrix(self.B, self.curvature)
        self.B.assemble()
        now = self.d.x.array.copy()
        self.d.x.array[:] = 0.0
        zero(self.G)
        fem.petsc.assemble_vector(self.G, self.slope)
        self.d.x.array[:] = now
        self.vi.setTolerances(rtol=0.0, atol=1e-7 * self.G.norm(), stol=0.0, max_it=100)
        self.vi.solve(None, self.d.vector)
        if self.vi.getConvergedReason() < 0:
            raise RuntimeError(f"damage: reason {self.vi.getConvergedReason()}")
        if self.omega != 1.0:
            wanted = now + self.omega * (self.d.x.array - now)
            self.d.x.array[:] = np.clip(wanted, self.lower.array, 1.0)

    def step(self, t, most, watch):
        """Alternates until the damage stays; the number of iterations, or None where time is over."""
        self.load(t)
        self.lower.array[:] = self.d.x.array
        for i in range(1, most + 1):
            before = self.d.x.array.copy()
            self.balance()
            self.break_more()
            if np.abs(self.d.x.array - before).max() < self.tolerance:
                return i
            if watch():
                return None
        raise RuntimeError(f"t = {t}: {most} iterations do not converge")

    def results(self):
        return (self.forces().array[self.curve].sum(), fem.assemble_scalar(self.elastic), fem.assemble_scalar(self.surface),
                self.d.x.array.max())


def run(peer, options, table):
    start, total = cpu(), 0
    loads = peer.case.loads(options.steps)
    for number, t in enumerate(loads, 1):
        iterations = peer.step(t, peer.case.table["solver"]["maximum_iterations"], lambda: cpu() > start + options.most_seconds)
        if iterations is None:
            return "out of time", total, cpu() - start
        total += iterations
        table.writerow([number, f"{t:.9g}", *(f"{x:.9g}" for x in peer.results()), iterations, f"{cpu() - start:.4g}"])
    return "whole", total, cpu() - start


def main():
    logging.getLogger().setLevel(logging.WARNING)
    options, start = arguments(), time.perf_counter()
    peer = Peer(case_file.Case(options.case, options.refinement), options)
    with open(options.output, "w", newline="", encoding="utf-8", buffering=1) as file:
        table = csv.writer(file)
        table.writerow("step load force_N elastic_energy_J fracture_energy_J max_damage staggered_iterations cpu_s".split())
        end, iterations, seconds = run(peer, options, table)
    print(json.dumps({"end": end, "cells": len(peer.case.cells), "points": len(peer.case.points), "iterations": iterations,
                      "cpu_s": seconds, "cpu_s_before": cpu() - seconds, "wall_s": time.perf_counter() - start,
                      "krylov": peer.krylov, "factorings": peer.factorings,
                      "MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024}))


if __name__ == "__main__":
    main()
