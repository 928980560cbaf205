# The poker-chip of cases/nine_poker_chip_pu, neo-Hookean at finite strain and axisymmetric, by Taylor-Hood elements (dolfinx
# 0.5): the force of the sound disc and where it reaches the strength surface (Biot stress), sharp and as the model with its ell
# has it (ELL_MM, DELTA); of a sharp penny-shaped crack in the plane at SHARE of the height the energy release rate, from the
# energies of neighbouring radii at one displacement, and what Griffith asks for.
# Usage: poker_chip_finite.py ELEMENTS_IN_RADIUS ELEMENTS_IN_HEIGHT MOST_UM STEPS sound ELL_MM DELTA
#        poker_chip_finite.py ELEMENTS_IN_RADIUS ELEMENTS_IN_HEIGHT MOST_UM STEPS crack SHARE RADII_IN_ELEMENTS (as 2,4,6)
import sys
import numpy as np, ufl
from dolfinx import fem, mesh
from dolfinx.fem.petsc import NonlinearProblem
from dolfinx.nls.petsc import NewtonSolver
from mpi4py import MPI
from petsc4py import PETSc
n_r, n_z, most, steps = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])/1e3, int(sys.argv[4])
mu, lam, Gc, ts, hs = 0.52, 85.77, 0.041, 0.3, 1.0  # MPa, N/mm
R, sphere = 5.0, 18.2
top = lambda r: 1.0 + sphere - np.sqrt(sphere**2 - r**2)
def disc(open_elements, level):
    i, j = np.meshgrid(np.arange(n_r+1), np.arange(n_z+1), indexing="ij")
    r = R*i/n_r; x = np.stack([r.ravel(), (top(r)*j/n_z).ravel()], 1)
    ids = np.arange(r.size).reshape(r.shape); upper = ids.copy(); n = r.size
    for k in range(open_elements):
        upper[k, level] = n; x = np.vstack([x, x[ids[k, level]]]); n += 1
    cells = [[(upper if b >= level else ids)[a+p, b+q] for q in (0, 1) for p in (0, 1)] for a in range(n_r) for b in range(n_z)]
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("quadrilateral", geometric_dimension=2), 1))
    return mesh.create_mesh(MPI.COMM_SELF, np.array(cells, dtype=np.int64), x, domain)
def density_of(l, t):  # W at the stretches l, t, t
    J = l*t*t; return mu/2*(l*l+2*t*t-3) - mu*np.log(J) + lam/2*(J-1)**2
def bisected(f, a, b):  # where f becomes positive
    for _ in range(100): m = (a+b)/2; a, b = (m, b) if f(m) < 0 else (a, m)
    return a
def energies_at_strengths():  # uniaxial and hydrostatic Biot stress
    pull = lambda l, t: mu*(l-1/l) + lam*(l*t*t-1)*t*t
    side = lambda l: bisected(lambda t: mu*(t-1/t) + lam*(l*t*t-1)*l*t, 0.3, 1.2)
    l, h = bisected(lambda l: pull(l, side(l)) - ts, 1.0, 2.0), bisected(lambda l: pull(l, l) - hs, 1.0, 1.5)
    return density_of(l, side(l)), density_of(h, h)
def run(open_elements, level, watch):
    msh = disc(open_elements, level)
    W = fem.FunctionSpace(msh, ufl.MixedElement([ufl.VectorElement("CG", msh.ufl_cell(), 2),
                                                 ufl.FiniteElement("CG", msh.ufl_cell(), 1)]))
    w = fem.Function(W); u, p = ufl.split(w)
    r = ufl.SpatialCoordinate(msh)[0]; g = ufl.grad(u)
    F = ufl.as_tensor([[1+g[0, 0], g[0, 1], 0], [g[1, 0], 1+g[1, 1], 0], [0, 0, 1+u[0]/r]]); J = ufl.det(F)
    dx = ufl.dx(metadata={"quadrature_degree": 5})
    density = mu/2*(ufl.inner(F, F)-3) - mu*ufl.ln(J) + p*(J-1) - p*p/(2*lam)
    residual = ufl.derivative(density*r*dx, w)
    spaces = [W.sub(0).sub(k).collapse()[0] for k in range(2)]
    zero = [fem.Function(s) for s in spaces]; rise = fem.Function(spaces[1])
    def dofs(k, where):
        return fem.locate_dofs_topological((W.sub(0).sub(k), spaces[k]), 1, mesh.locate_entities_boundary(msh, 1, where))
    lid = lambda x: np.isclose(x[1], top(x[0]))
    floor = lambda x: np.isclose(x[1], 0)
    axis = lambda x: np.isclose(x[0], 0)
    held = [(zero[0], 0, lid), (zero[0], 0, floor), (zero[0], 0, axis), (zero[1], 1, floor), (rise, 1, lid)]
    problem = NonlinearProblem(residual, w, [fem.dirichletbc(v, dofs(k, where), W.sub(0).sub(k)) for v, k, where in held])
    solver = NewtonSolver(MPI.COMM_SELF, problem); solver.rtol = solver.atol = 1e-10; solver.max_it = 30
    prefix, options = solver.krylov_solver.getOptionsPrefix(), PETSc.Options()
    for key, value in (("ksp_type", "preonly"), ("pc_type", "lu"), ("pc_factor_mat_solver_type", "mumps")):
        options[prefix + key] = value
    solver.krylov_solver.setFromOptions()
    form = fem.form(residual); energy = fem.form(density*r*dx)
    pts = np.array([[a, b] for b in (0.1127, 0.5, 0.8873) for a in (0.1127, 0.5, 0.8873)])
    expression = fem.Expression(ufl.as_vector([F[0, 0], F[0, 1], F[1, 0], F[1, 1], F[2, 2], p, *ufl.SpatialCoordinate(msh)]), pts)
    cells = np.arange(msh.topology.index_map(2).size_local, dtype=np.int32)
    curve = []
    for step in range(1, steps+1):
        now = most*step/steps
        rise.x.array[:] = now
        solver.solve(w)
        force = fem.petsc.assemble_vector(form).array[dofs(1, lid)[0]].sum()*np.pi/36  # of 5 degrees, N
        curve.append((now, force, fem.assemble_scalar(energy)*np.pi/36))
        if watch is not None: watch(now, force, expression.eval(cells).reshape(-1, 8))
    return np.array(curve)
if sys.argv[5] == "sound":
    ell, delta = float(sys.argv[6]), float(sys.argv[7])
    W_ts, W_hs = energies_at_strengths()
    s = delta*Gc/(8*ell)
    by_trace = s/hs - 2*W_hs/(3*hs); by_shear = np.sqrt(3)*(3*hs-ts)/(hs*ts)*s + 2*W_hs/(np.sqrt(3)*hs) - 2*np.sqrt(3)*W_ts/ts
    print(f"W at the strengths {W_ts:.6f}, {W_hs:.6f} MPa; coefficients by shear {by_shear:.4f}, by trace {by_trace:.4f}")
    print("displacement um, force N of 5 degrees | share of the strength surface on the axis in the middle half of the height; "
          "the largest in the inner 90 %, at r mm, share of the height | the same of the model's surface | I1/3 on the axis MPa")
    def watch(now, force, at):
        F = np.zeros((len(at), 3, 3)); F[:, 0, 0], F[:, 0, 1], F[:, 1, 0], F[:, 1, 1], F[:, 2, 2] = at[:, :5].T
        U2, V = np.linalg.eigh(np.swapaxes(F, 1, 2) @ F); l = np.sqrt(U2); J = l.prod(1)
        pressure = at[:, 5]
        biot = mu*(l-1/l) + pressure[:, None]*J[:, None]/l
        I1 = biot.sum(1); dev = biot - I1[:, None]/3; q = np.sqrt(0.5*(dev**2).sum(1))
        W = mu/2*((l*l).sum(1)-3) - mu*np.log(J) + pressure**2/(2*lam)
        sharp = (q + ts/(np.sqrt(3)*(3*hs-ts))*I1)/(np.sqrt(3)*ts*hs/(3*hs-ts))
        model = (np.where(I1 > 0, 2*W, 0) + by_shear*q + by_trace*I1)/(3*delta*Gc/(8*ell))  # 1 where d = 0 ends
        r, z = at[:, 6], at[:, 7]; share = z/top(r)
        inner = (share > 0.05) & (share < 0.95); core = inner & (r < 0.1) & (abs(share-0.5) < 0.25)
        text = f"{1e3*now:.2f} {force:.5f}"
        for f in (sharp, model):
            k = np.argmax(np.where(inner, f, -1)); text += f" | {f[core].max():.4f}; {f[k]:.4f} at {r[k]:.3f} {share[k]:.3f}"
        k = np.argmax(np.where(r < 0.1, I1, -1)); text += f" | I1/3 on the axis {I1[k]/3:.4f}"
        print(text, flush=True)
    run(0, n_z//2, watch)
else:
    level = int(round(float(sys.argv[6])*n_z)); radii = [int(k) for k in sys.argv[7].split(",")]
    curves = [run(k, level, None) for k in radii]
    for k, c in zip(radii, curves): print(f"radius {R*k/n_r:.3f} mm: force {c[-1, 1]:.4f} N at {1e3*most:.2f} um")
    print("radius mm, displacement um at which G = Gc (fixed grips), force of 5 degrees N")
    for k in range(len(radii)-1):
        a0, a1 = R*radii[k]/n_r, R*radii[k+1]/n_r
        G = (curves[k][:, 2]-curves[k+1][:, 2])/(0.5*(a1**2-a0**2)*np.pi/36)  # N/mm, per reference area
        d, f = np.r_[0, curves[k][:, 0]], np.r_[0, 0.5*(curves[k][:, 1]+curves[k+1][:, 1])]
        root = np.sqrt(np.maximum(np.r_[0, G], 0)); m = np.argmax(root > np.sqrt(Gc))
        if m == 0: print(f"{0.5*(a0+a1):.3f} G = {1e3*G[-1]:.2f} J/m^2 at the end"); continue
        u = d[m-1] + (np.sqrt(Gc)-root[m-1])/(root[m]-root[m-1])*(d[m]-d[m-1])
        print(f"{0.5*(a0+a1):.3f} {1e3*u:.3f} {np.interp(u, d, f):.4f}")
