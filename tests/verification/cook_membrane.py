# Cook's membrane, nearly incompressible neo-Hookean, by Taylor-Hood elements (dolfinx 0.5): the reference of
# finite_incompressible.cpp. Usage: cook_membrane.py SQUARES_A_SIDE
import sys, time
import numpy as np, ufl
from dolfinx import fem, mesh
from dolfinx.fem.petsc import NonlinearProblem
from dolfinx.nls.petsc import NewtonSolver
from mpi4py import MPI
from petsc4py import PETSc
n = int(sys.argv[1]); nu = 0.4999; mu = 80.194; lam = 2*mu*nu/(1-2*nu)
t0 = time.process_time()
msh = mesh.create_unit_square(MPI.COMM_WORLD, n, n, mesh.CellType.triangle)
x = msh.geometry.x; s = x[:, 0].copy(); t = x[:, 1].copy()
x[:, 0] = 48*s; x[:, 1] = 44*s + t*(44 - 28*s)
V = fem.FunctionSpace(msh, ufl.MixedElement([ufl.VectorElement("CG", msh.ufl_cell(), 2), ufl.FiniteElement("CG", msh.ufl_cell(), 1)]))
w = fem.Function(V); u, p = ufl.split(w); v = ufl.TestFunction(V)
left = mesh.locate_entities_boundary(msh, 1, lambda y: np.isclose(y[0], 0))
right = mesh.locate_entities_boundary(msh, 1, lambda y: np.isclose(y[0], 48))
V0, _ = V.sub(0).collapse(); zero = fem.Function(V0)
bc = fem.dirichletbc(zero, fem.locate_dofs_topological((V.sub(0), V0), 1, left), V.sub(0))
tags = mesh.meshtags(msh, 1, right, np.full(len(right), 1, dtype=np.int32))
ds = ufl.Measure("ds", domain=msh, subdomain_data=tags)
load = fem.Constant(msh, PETSc.ScalarType(0.0))
F = ufl.Identity(2) + ufl.grad(u); J = ufl.det(F)
W = mu/2*(ufl.tr(F.T*F) - 2) - mu*ufl.ln(J) + p*(J-1) - p*p/(2*lam)
R = ufl.derivative(W*ufl.dx, w, v) - load*ufl.split(v)[0][1]*ds(1)
problem = NonlinearProblem(R, w, [bc]); solver = NewtonSolver(MPI.COMM_WORLD, problem)
solver.rtol = 1e-9; solver.max_it = 30
ksp = solver.krylov_solver; o = PETSc.Options(); pre = ksp.getOptionsPrefix()
o[pre+"ksp_type"] = "preonly"; o[pre+"pc_type"] = "lu"; o[pre+"pc_factor_mat_solver_type"] = "mumps"; ksp.setFromOptions()
for k in range(1, 9):
    load.value = 6.25*k/8; solver.solve(w)
uu = w.sub(0).collapse(); xs = uu.function_space.tabulate_dof_coordinates()
for q in [(48, 60), (48, 52)]:
    i = np.argmin(np.hypot(xs[:, 0]-q[0], xs[:, 1]-q[1])); print(n, xs[i, :2], uu.x.array[2*i:2*i+2])
avg = fem.assemble_scalar(fem.form(u[1]*ds(1)))/16; print("mean of the edge", avg, "cpu", time.process_time()-t0)
