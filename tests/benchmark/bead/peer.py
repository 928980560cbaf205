#!/usr/bin/python3
"""A bead in dolfinx 0.5.2 (Debian 12), on the tetrahedra of `pfdm mesh`, its prisms cut in three.

    OMP_NUM_THREADS=1 tests/benchmark/bead/peer.py RESULTS/mesh.vtu --degree 1 --output peer.csv
    OMP_NUM_THREADS=1 tests/benchmark/bead/peer.py RESULTS/mesh.vtu --case glass_bead_quick --end 480 --steps 60

Displacement of degree 1 or 2, damage of degree 1, AT2, irreversible by the largest driving energy so far, alternate minimisation.
In `glass_bead_quick` cracks close (volumetric-deviatoric split, by the volume change of the last displacements) and the bead cannot
be damaged. Writes force and debonded area of each step, and the CPU seconds so far, without those of compilation.
"""

import argparse
import csv
import json
import logging
import resource
import time

import basix
import numpy as np
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

BEAD, MATRIX, BAND = 0, 1, 2
RESIDUAL_STIFFNESS = 1e-6
# ell [um], Gc [J/m^2] of bead, matrix and band, whether cracks close, whether the bead stays sound; units: um, MPa, J/m^2, uN
CASES = {"bead": (20.0, (1000.0, 100.0, 10.0), False, False),
         "glass_bead_quick": (30.0, (10000.0, 10000.0, 275.768), True, True)}
GLASS, SYLGARD = (70e3, 0.3), (75.0, 0.44)
DEBONDED = 0.95
COMPILATION = {"cffi_extra_compile_args": ["-O3", "-march=native", "-ffast-math"], "cffi_libraries": ["m"]}
TETRAHEDRON, WEDGE = 10, 13
# Numbers of a wedge's points that begin with each of them, its orientation kept.
ROTATIONS = np.array([[0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4],
                      [3, 5, 4, 0, 2, 1], [4, 3, 5, 1, 0, 2], [5, 4, 3, 2, 1, 0]])


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--case", default="bead", choices=CASES)
    parser.add_argument("--no-split", action="store_true", help="cracks that would close carry nothing")
    parser.add_argument("--toughness", type=float, help="of the band, instead of the case's [J/m^2]")
    parser.add_argument("--degree", type=int, default=1, choices=(1, 2), help="of the displacement")
    parser.add_argument("--end", type=float, default=22.0, help="last displacement of the top [um]")
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--tolerance", type=float, default=1e-4, help="of the damage")
    parser.add_argument("--most-iterations", type=int, default=300, help="in a step")
    parser.add_argument("--most-seconds", type=float, default=900.0, help="CPU seconds, of the whole run")
    parser.add_argument("--output", default="peer.csv")
    return parser.parse_args()


def cpu():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def cut_wedges(wedges):
    """Three tetrahedra each; the diagonal of every rectangle starts at its smallest point number (Dompierre et al. 1999)."""
    turned = np.take_along_axis(wedges, ROTATIONS[wedges.argmin(axis=1)], axis=1)
    first = np.minimum(turned[:, 1], turned[:, 5]) < np.minimum(turned[:, 2], turned[:, 4])
    one, other = [[0, 1, 2, 5], [0, 1, 5, 4], [0, 4, 5, 3]], [[0, 1, 2, 4], [0, 4, 2, 5], [0, 4, 5, 3]]
    return np.where(first[:, None, None], turned[:, one], turned[:, other]).reshape(-1, 4)


def read_cells(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    kind, offset = vtk_to_numpy(grid.GetCellTypesArray()), vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    points, region = vtk_to_numpy(grid.GetCells().GetConnectivityArray()), vtk_to_numpy(grid.GetCellData().GetArray("material"))
    tetrahedra = points[offset[:-1][kind == TETRAHEDRON, None] + np.arange(4)]
    wedges = points[offset[:-1][kind == WEDGE, None] + np.arange(6)]
    cells = np.vstack([tetrahedra, cut_wedges(wedges)]).astype(np.int64)
    regions = np.concatenate([region[kind == TETRAHEDRON], np.repeat(region[kind == WEDGE], 3)])
    return 1e6 * vtk_to_numpy(grid.GetPoints().GetData()).astype(float), cells, regions, wedges


def make_mesh(path):
    points, cells, regions, wedges = read_cells(path)
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", "tetrahedron", 1))
    body = mesh.create_mesh(MPI.COMM_SELF, cells, points, domain)
    return body, regions[np.asarray(body.topology.original_cell_index)], points, wedges


def rigid_motions(space):
    x, vectors = space.tabulate_dof_coordinates(), []
    for k in range(6):
        motion = fem.Function(space)
        values = motion.x.array.reshape(-1, 3)
        if k < 3:
            values[:, k] = 1.0
        else:
            values[:] = np.cross(np.eye(3)[k - 3], x)
        vectors.append(motion.vector.copy())
    for i, v in enumerate(vectors):
        for w in vectors[:i]:
            v.axpy(-w.dot(v), w)
        v.normalize()
    return PETSc.NullSpace().create(vectors=vectors, comm=MPI.COMM_SELF)


def make_solver(matrix, prefix, settings):
    solver, options = PETSc.KSP().create(MPI.COMM_SELF), PETSc.Options()
    solver.setOptionsPrefix(prefix)
    for key, value in settings.items():
        options[prefix + key] = value
    solver.setOperators(matrix)
    solver.setFromOptions()
    solver.setInitialGuessNonzero(True)
    solver.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
    solver.setTolerances(rtol=1e-8, max_it=3000)
    return solver


class Bead:
    def __init__(self, options):
        degree = options.degree
        self.ell, self.toughness, self.closes, self.bead_is_sound = CASES[options.case]
        self.closes = self.closes and not options.no_split
        if options.toughness:
            self.toughness = (*self.toughness[:BAND], options.toughness)
        self.body, self.region, self.points, self.wedges = make_mesh(options.mesh)
        self.V = fem.VectorFunctionSpace(self.body, ("Lagrange", degree))
        self.D = fem.FunctionSpace(self.body, ("Lagrange", 1))
        self.make_forms(degree)
        self.hold()
        self.make_solvers()
        self.columns = self.find_columns()

    def constant_by_cell(self, values):
        field = fem.Function(self.by_cell)
        field.x.array[self.by_cell.dofmap.list.array] = values
        return field

    def make_forms(self, degree):
        self.by_cell = fem.FunctionSpace(self.body, ("DG", 0))
        glass = self.region == BEAD
        E, nu = np.where(glass, GLASS[0], SYLGARD[0]), np.where(glass, GLASS[1], SYLGARD[1])
        lame, mu = self.constant_by_cell(E * nu / ((1 + nu) * (1 - 2 * nu))), self.constant_by_cell(E / (2 * (1 + nu)))
        Gc = self.constant_by_cell(np.choose(self.region, self.toughness))
        breaks = self.constant_by_cell(np.where(glass & self.bead_is_sound, 0.0, 1.0))
        order = 2 * degree  # integrates the degraded energy exactly
        dx = ufl.dx(metadata={"quadrature_degree": order})
        at_points = ufl.FiniteElement("Quadrature", self.body.ufl_cell(), order, quad_scheme="default")
        self.u, self.d = fem.Function(self.V), fem.Function(self.D)
        self.driving = fem.Function(fem.FunctionSpace(self.body, at_points))
        u, v, p, q = ufl.TrialFunction(self.V), ufl.TestFunction(self.V), ufl.TrialFunction(self.D), ufl.TestFunction(self.D)
        g = 1 - breaks * (1 - (1 - self.d) ** 2 - RESIDUAL_STIFFNESS)

        def strain(w):
            return ufl.sym(ufl.grad(w))

        def volume(w):
            return ufl.tr(strain(w))

        closed = ufl.conditional(volume(self.u) < 0, 1.0, 0.0) if self.closes else 0.0
        kept = closed * (lame + 2 * mu / 3)  # bulk modulus of closed cracks

        def sound_stress(w):
            return lame * volume(w) * ufl.Identity(3) + 2 * mu * strain(w)

        def stress(w):
            return g * sound_stress(w) + (1 - g) * kept * volume(w) * ufl.Identity(3)

        def form(f):
            return fem.form(f, jit_params=COMPILATION)

        self.stiffness = form(ufl.inner(stress(u), strain(v)) * dx)
        self.forces = form(ufl.inner(stress(self.u), strain(v)) * dx)
        self.damage_matrix = form(((Gc / self.ell + 2 * self.driving) * p * q + Gc * self.ell * ufl.dot(ufl.grad(p), ufl.grad(q))) * dx)
        self.damage_load = form(2 * self.driving * q * dx)
        places, _ = basix.make_quadrature(basix.CellType.tetrahedron, order)
        driving = breaks * (ufl.inner(sound_stress(self.u), strain(self.u)) - kept * volume(self.u) ** 2) / 2
        self.energy = fem.Expression(driving, places, jit_params=COMPILATION)
        self.all_cells = np.arange(len(self.region), dtype=np.int32)

    def hold(self):
        heights = self.points[:, 2]

        def face(z):
            return mesh.locate_entities_boundary(self.body, 2, lambda x: np.isclose(x[2], z))

        self.pull = fem.Constant(self.body, PETSc.ScalarType(0))
        self.top = fem.locate_dofs_topological(self.V.sub(2), 2, face(heights.max()))
        bottom = fem.locate_dofs_topological(self.V, 2, face(heights.min()))
        self.held = [fem.dirichletbc(np.zeros(3), bottom, self.V), fem.dirichletbc(self.pull, self.top, self.V.sub(2))]

    def make_solvers(self):
        self.A, self.B = fem.petsc.create_matrix(self.stiffness), fem.petsc.create_matrix(self.damage_matrix)
        self.F, self.G = fem.petsc.create_vector(self.forces), fem.petsc.create_vector(self.damage_load)
        self.A.setNearNullSpace(rigid_motions(self.V))
        multigrid = {"ksp_type": "cg", "pc_type": "gamg", "pc_gamg_type": "agg", "pc_gamg_agg_nsmooths": 1,
                     "pc_gamg_threshold": 0.01, "pc_gamg_coarse_eq_limit": 500, "mg_levels_ksp_type": "chebyshev",
                     "mg_levels_pc_type": "jacobi", "mg_levels_ksp_max_it": 2}
        if self.closes:  # the multigrid is not positive definite there
            multigrid |= {"ksp_type": "fgmres", "ksp_gmres_restart": 100, "mg_levels_ksp_chebyshev_esteig": "0,0.05,0,1.3"}
        self.momentum = make_solver(self.A, "u_", multigrid)
        self.damage = make_solver(self.B, "d_", {"ksp_type": "cg", "pc_type": "jacobi"})
        direct = {"ksp_type": "preonly", "pc_type": "lu", "pc_factor_mat_solver_type": "mumps"}
        self.factors = make_solver(self.A, "l_", direct)
        self.usual, self.krylov = None, 0

    def balance(self, renew):
        """Solves for u; the multigrid is built anew where asked, and where the last solve took 1.5 times its iterations. Where it
        fails, as it does with closed cracks, the matrix is factored."""
        self.A.zeroEntries()
        fem.petsc.assemble_matrix(self.A, self.stiffness, bcs=self.held)
        self.A.assemble()
        with self.F.localForm() as load:
            load.set(0)
        fem.petsc.apply_lifting(self.F, [self.stiffness], bcs=[self.held])
        fem.petsc.set_bc(self.F, self.held)
        renew = renew or self.usual is None or self.momentum.getIterationNumber() > 1.5 * self.usual
        start = self.u.x.array.copy()
        for _ in range(2):
            self.momentum.getPC().setReusePreconditioner(not renew)
            self.momentum.solve(self.F, self.u.vector)
            self.krylov += self.momentum.getIterationNumber()
            if renew:
                self.usual = max(self.momentum.getIterationNumber(), 8)
            if self.momentum.getConvergedReason() > 0:
                return
            self.u.x.array[:], renew = start, True
        self.factors.setInitialGuessNonzero(False)
        self.factors.solve(self.F, self.u.vector)
        if self.factors.getConvergedReason() < 0:
            raise RuntimeError(f"momentum: reason {self.factors.getConvergedReason()}")

    def drive(self, least):
        self.driving.x.array[:] = np.maximum(least, self.energy.eval(self.all_cells).ravel())

    def solve_damage(self):
        self.B.zeroEntries()
        fem.petsc.assemble_matrix(self.B, self.damage_matrix)
        self.B.assemble()
        with self.G.localForm() as load:
            load.set(0)
        fem.petsc.assemble_vector(self.G, self.damage_load)
        self.damage.solve(self.G, self.d.vector)
        if self.damage.getConvergedReason() < 0:
            raise RuntimeError(f"damage: reason {self.damage.getConvergedReason()}")

    def force(self):
        with self.F.localForm() as load:
            load.set(0)
        fem.petsc.assemble_vector(self.F, self.forces)
        return 1e-6 * self.F.array[self.top].sum()

    def find_columns(self):
        """By the direction of each column of prisms: its six points a prism, and the area of its triangle on the bead."""
        corners = self.points[self.wedges]
        radius = np.linalg.norm(corners, axis=2)
        upper = radius[:, 3:].mean(axis=1) > radius[:, :3].mean(axis=1)
        inner = np.where(upper[:, None, None], corners[:, :3], corners[:, 3:])
        centre = inner.mean(axis=1)
        direction = np.round(centre / np.linalg.norm(centre, axis=1)[:, None], 6)
        _, column = np.unique(direction, axis=0, return_inverse=True)
        area = 0.5 * np.linalg.norm(np.cross(inner[:, 1] - inner[:, 0], inner[:, 2] - inner[:, 0]), axis=1)
        first = np.full(column.max() + 1, np.inf)
        np.minimum.at(first, column, area)
        # Damage of the mesh's points by those of the file.
        place = {tuple(p): i for i, p in enumerate(np.round(self.D.tabulate_dof_coordinates(), 6))}
        dof = np.array([place.get(tuple(p), -1) for p in np.round(self.points, 6)])
        return column, first, dof[self.wedges]

    def debonded_area(self):
        column, area, dofs = self.columns
        largest = np.zeros(len(area))
        np.maximum.at(largest, column, self.d.x.array[dofs].max(axis=1))
        return area[largest > DEBONDED].sum()


def run(bead, options, table):
    iterations, watch = 0, cpu()
    for step in range(1, options.steps + 1):
        bead.pull.value = options.end * step / options.steps
        least = bead.driving.x.array.copy()
        for i in range(1, options.most_iterations + 1):
            before = bead.d.x.array.copy()
            bead.balance(renew=i == 1)
            bead.drive(least)
            bead.solve_damage()
            iterations += 1
            if np.abs(bead.d.x.array - before).max() < options.tolerance:
                break
            if cpu() > options.most_seconds:
                return "out of time"
        row = [step, float(bead.pull.value), bead.force(), bead.debonded_area(), i, iterations, bead.krylov, cpu() - watch]
        table.writerow([f"{x:.7g}" for x in row])
        print(*(f"{x:.6g}" for x in row), flush=True)
    return "whole"


def elastic(bead):
    """The body without damage at 1 um: force and CPU seconds of assembly, multigrid and solution."""
    bead.pull.value = 1.0
    start = cpu()
    bead.balance(renew=True)
    seconds = cpu() - start
    result = bead.force(), seconds, bead.momentum.getIterationNumber()
    bead.u.x.array[:] = 0.0
    return result


def main():
    logging.getLogger().setLevel(logging.WARNING)
    options = arguments()
    start = time.perf_counter()
    bead = Bead(options)
    print(json.dumps({"tetrahedra": len(bead.region), "unknowns": bead.V.dofmap.index_map.size_global * 3,
                      "elastic_force_N_per_um, CPU s, iterations": elastic(bead), "bead_mm2": bead.columns[1].sum() * 1e-6}))
    with open(options.output, "w", newline="", encoding="utf-8", buffering=1) as file:
        table = csv.writer(file)
        table.writerow("step displacement_um force_N debonded_um2 iterations all_iterations krylov_u cpu_s".split())
        end = run(bead, options, table)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(json.dumps({"end": end, "wall_s": time.perf_counter() - start, "cpu_s": cpu(), "MB": peak}))


if __name__ == "__main__":
    main()
