# The bonded disc of cases/poker_chip_gent_lindley, neo-Hookean and axisymmetric, by Taylor-Hood elements (dolfinx 0.5): the
# force of the elastic branch. Usage: bonded_disc.py ELEMENTS_IN_RADIUS ELEMENTS_IN_HEIGHT RISE_OF_THE_TOP_IN_MM STEPS
import sys
import numpy as np, ufl
from dolfinx import fem, mesh
from dolfinx.fem.petsc import NonlinearProblem
from dolfinx.nls.petsc import NewtonSolver
from mpi4py import MPI
from petsc4py import PETSc
n_r, n_z = int(sys.argv[1]), int(sys.argv[2])
E, nu, core, R, H = 1.769652, 0.499705058, 0.1, 10.0, 0.95  # MPa, mm
top, steps = float(sys.argv[3]), int(sys.argv[4])  # mm
mu, lam = E/2/(1+nu), E*nu/(1+nu)/(1-2*nu)
msh = mesh.create_rectangle(MPI.COMM_WORLD, [[0, 0], [1, 1]], [n_r, n_z], mesh.CellType.quadrilateral)
def graded(s, ratio, n):  # widths in geometric progression, the last of n over the first
    q = ratio**(1/(n-1))
    return (1-q**(s*n))/(1-q**n)
x = msh.geometry.x
x[:, 0] = core + (R-core)*graded(x[:, 0], 0.25, n_r); x[:, 1] = H*graded(x[:, 1], 0.3, n_z)
W = fem.FunctionSpace(msh, ufl.MixedElement([ufl.VectorElement("CG", msh.ufl_cell(), 2),
                                             ufl.FiniteElement("CG", msh.ufl_cell(), 1)]))
w = fem.Function(W); u, p = ufl.split(w)
r = ufl.SpatialCoordinate(msh)[0]; g = ufl.grad(u)
F = ufl.as_tensor([[1+g[0, 0], g[0, 1], 0], [g[1, 0], 1+g[1, 1], 0], [0, 0, 1+u[0]/r]]); J = ufl.det(F)
potential = (mu/2*(ufl.inner(F, F)-3) - mu*ufl.ln(J) + p*(J-1) - p*p/(2*lam))*r*ufl.dx
residual = ufl.derivative(potential, w)
values = [fem.Function(W.sub(0).sub(k).collapse()[0]) for k in range(2)]; rise = fem.Function(values[1].function_space)
def dofs(k, where):
    facets = mesh.locate_entities_boundary(msh, 1, where)
    return fem.locate_dofs_topological((W.sub(0).sub(k), values[k].function_space), 1, facets)
lid = lambda x: np.isclose(x[1], H)
held = [(values[0], 0, lid), (values[0], 0, lambda x: np.isclose(x[0], core)),
        (values[1], 1, lambda x: np.isclose(x[1], 0)), (rise, 1, lid)]
problem = NonlinearProblem(residual, w, [fem.dirichletbc(v, dofs(k, where), W.sub(0).sub(k)) for v, k, where in held])
solver = NewtonSolver(MPI.COMM_WORLD, problem); solver.rtol = solver.atol = 1e-10
prefix, options = solver.krylov_solver.getOptionsPrefix(), PETSc.Options()
for key, value in (("ksp_type", "preonly"), ("pc_type", "lu"), ("pc_factor_mat_solver_type", "mumps")):
    options[prefix + key] = value
solver.krylov_solver.setFromOptions()
for step in range(1, steps+1):
    rise.x.array[:] = top*step/steps
    n, converged = solver.solve(w)
    force = 2*fem.petsc.assemble_vector(fem.form(residual)).array[dofs(1, lid)[0]].sum()  # over pi
    print(f"{1e3*top*step/steps:.1f} um: mean stress {force/(R*R-core*core):.5f} MPa, "
          f"pressure up to {w.sub(1).collapse().x.array.max()/mu:.3f} mu, {n} steps of Newton")
