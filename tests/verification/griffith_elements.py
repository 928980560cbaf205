# Energy release rate of cracked bodies of the neo-Hookean polyurethane of cases/nine_*_pu by quadratic elements (dolfinx
# 0.5), from their energies at two crack lengths and one displacement: the sharp answers of nine_dcb_pu (dcb: plane strain,
# a linear pressure), nine_pure_shear_pu (strip) and nine_edge_notch_pu (notch: plane stress, the stretch across as an unknown).
# Usage: griffith_elements.py dcb|notch|strip LENGTH_MM HALF_DIFFERENCE_MM SQUARES
import sys
import numpy as np, ufl
from dolfinx import fem, mesh
from dolfinx.fem.petsc import NonlinearProblem
from dolfinx.nls.petsc import NewtonSolver
from mpi4py import MPI
from petsc4py import PETSc
kind, a0, da, n = sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
mu, lam, Gc = 0.52, 85.77, 0.041  # MPa, N/mm
size = {"dcb": (50.0, 10.0), "notch": (5.0, 12.5), "strip": (50.0, 2.5)}[kind]
most = {"dcb": 5.6, "notch": 3.5, "strip": 0.26}[kind]; steps = {"dcb": 28, "notch": 28, "strip": 13}[kind]
def graded(N, L, c, first):  # N cells, finest at c
    x = np.linspace(0, L, 4001); dens = 1.0/(first + 0.25*np.abs(x - c))
    F = np.concatenate([[0], np.cumsum(0.5*(dens[1:] + dens[:-1])*np.diff(x))])
    return np.interp(np.linspace(0, F[-1], N+1), F, x)
def run(a):
    c = a0
    xs = graded(8*n, size[0], c, 0.02*size[0]/n); xs[np.argmin(abs(xs-a))] = a
    ys = graded(4*n, size[1], 0.0, 0.02*size[1]/n)
    msh = mesh.create_unit_square(MPI.COMM_WORLD, 8*n, 4*n, mesh.CellType.triangle)
    g = msh.geometry.x
    g[:, 0] = xs[np.rint(g[:, 0]*8*n).astype(int)]; g[:, 1] = ys[np.rint(g[:, 1]*4*n).astype(int)]
    second = ufl.FiniteElement("CG", msh.ufl_cell(), 1) if kind == "dcb" else ufl.FiniteElement("DG", msh.ufl_cell(), 1)
    V = fem.FunctionSpace(msh, ufl.MixedElement([ufl.VectorElement("CG", msh.ufl_cell(), 2), second]))
    w = fem.Function(V); u, s = ufl.split(w); v = ufl.TestFunction(V)
    F = ufl.Identity(2) + ufl.grad(u)
    if kind == "dcb":  # plane strain, s the pressure
        J = ufl.det(F); W = E = mu/2*(ufl.tr(F.T*F) - 2) - mu*ufl.ln(J) + s*(J-1) - s*s/(2*lam)
    else:              # plane stress, 1 + s the stretch across
        J = ufl.det(F)*(1+s); W = E = mu/2*(ufl.tr(F.T*F) + (1+s)**2 - 3) - mu*ufl.ln(J) + lam/2*(J-1)**2
    V0, _ = V.sub(0).collapse(); top = fem.Function(V0)
    Vx, _ = V.sub(0).sub(0).collapse(); Vy, _ = V.sub(0).sub(1).collapse()
    zx, zy, uy = fem.Function(Vx), fem.Function(Vy), fem.Function(Vy)
    def on(f): return mesh.locate_entities_boundary(msh, 1, f)
    bcs = []
    def bind(f, sub, Vs, val): bcs.append(fem.dirichletbc(val, fem.locate_dofs_topological((V.sub(0).sub(sub), Vs), 1, on(f)), V.sub(0).sub(sub)))
    bind(lambda y: np.isclose(y[1], 0) & (y[0] > a - 1e-9), 1, Vy, zy)
    if kind == "dcb":
        bind(lambda y: np.isclose(y[0], 0), 1, Vy, uy); bind(lambda y: np.isclose(y[0], size[0]), 0, Vx, zx)
        grip = lambda y: np.isclose(y[0], 0)
    else:
        bind(lambda y: np.isclose(y[1], size[1]), 1, Vy, uy); grip = lambda y: np.isclose(y[1], size[1])
        if kind == "strip": bind(lambda y: np.isclose(y[1], size[1]), 0, Vx, zx)
        else:
            d = fem.locate_dofs_geometrical((V.sub(0).sub(0), Vx), lambda y: np.isclose(y[0], size[0]) & np.isclose(y[1], 0))
            bcs.append(fem.dirichletbc(zx, d, V.sub(0).sub(0)))
    R = ufl.derivative(W*ufl.dx, w, v)
    problem = NonlinearProblem(R, w, bcs); solver = NewtonSolver(MPI.COMM_WORLD, problem)
    solver.rtol = 1e-9; solver.atol = 1e-12; solver.max_it = 40
    ksp = solver.krylov_solver; o = PETSc.Options(); pre = ksp.getOptionsPrefix()
    o[pre+"ksp_type"] = "preonly"; o[pre+"pc_type"] = "lu"; o[pre+"pc_factor_mat_solver_type"] = "mumps"; ksp.setFromOptions()
    out = []
    for k in range(1, steps+1):
        uy.x.array[:] = most*k/steps
        solver.solve(w)
        out.append((most*k/steps, fem.assemble_scalar(fem.form(E*ufl.dx))))
    return np.array(out)
A, B = run(a0 - da), run(a0 + da)
U = 0.5*(A[:, 1] + B[:, 1]); d = A[:, 0]
G = 2.0*(A[:, 1] - B[:, 1])/(2*da)   # N/mm; twice, for both halves
force = np.gradient(U, d)            # of half the body, N/mm of thickness
for x, g, f, fa, fb in zip(d, G, force, np.gradient(A[:, 1], d), np.gradient(B[:, 1], d)): print(f"u {x:.4f} mm  G {1e3*g:.3f} J/m2  force {f:.5f} N/mm  of both lengths {fa:.5f} {fb:.5f}")
k = np.argmax(G > Gc)
if G[k] > Gc:
    t = (np.sqrt(Gc) - np.sqrt(G[k-1]))/(np.sqrt(G[k]) - np.sqrt(G[k-1]))
    print("G = Gc at u", d[k-1] + t*(d[k]-d[k-1]), "force", force[k-1] + t*(force[k]-force[k-1]))
