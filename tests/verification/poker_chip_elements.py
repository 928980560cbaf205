# The poker-chip of cases/nine_poker_chip by quadratic elements, axisymmetric and linear elastic (SciPy alone): the load at
# which the strength surface is reached, and where; the energy release rate of a sharp penny-shaped crack of radius a at a
# share of the height, from the energies of neighbouring radii at one displacement.
# Usage: poker_chip_elements.py CELLS_IN_RADIUS CELLS_IN_HEIGHT SHARE_OF_THE_HEIGHT
import sys
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sl
n_r, n_z, share = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
E, nu, Gc, sts, shs = 70e3, 0.22, 0.010, 40.0, 27.8  # MPa, mm, N/mm
R, sphere = 5.0, 18.2
lam, mu = E*nu/((1+nu)*(1-2*nu)), E/(2*(1+nu))
top = lambda r: 1.0 + sphere - np.sqrt(sphere**2 - r**2)
level = 2*int(round(share*n_z))  # of the crack's plane among the nodes
g, w = np.polynomial.legendre.leggauss(3)
xi, eta = [v.ravel() for v in np.meshgrid(g, g, indexing="ij")]
weight = np.outer(w, w).ravel()
def line(x): return np.array([0.5*x*(x-1), 1-x*x, 0.5*x*(x+1)]), np.array([x-0.5, -2*x, x+0.5])
(Nx, dx), (Ny, dy) = line(xi), line(eta)
N = np.array([Nx[i]*Ny[j] for i in range(3) for j in range(3)])      # (9, q)
Dx = np.array([dx[i]*Ny[j] for i in range(3) for j in range(3)])
Dy = np.array([Nx[i]*dy[j] for i in range(3) for j in range(3)])
def solve(m):  # m: elements along the radius over which the crack is open; force and energy per radian at a unit displacement
    i, j = np.meshgrid(np.arange(2*n_r+1), np.arange(2*n_z+1), indexing="ij")
    r = R*i/(2.0*n_r); z = top(r)*j/(2.0*n_z)
    ids = np.arange(r.size).reshape(r.shape)
    upper = ids.copy(); n = r.size
    x = np.stack([r.ravel(), z.ravel()], 1)
    for k in range(2*m):  # the nodes of the crack but for its tip
        upper[k, level] = n; x = np.vstack([x, x[ids[k, level]]]); n += 1
    el = []
    for a in range(n_r):
        for b in range(n_z):
            use = upper if 2*b >= level else ids
            el.append([use[2*a+p, 2*b+q] for p in range(3) for q in range(3)])
    el = np.array(el); X = x[el]  # (e, 9, 2)
    J = np.stack([np.einsum("nq,enk->eqk", Dx, X), np.einsum("nq,enk->eqk", Dy, X)], 2)
    det = np.linalg.det(J); inv = np.linalg.inv(J)
    D = np.einsum("eqkl,lnq->eqnk", inv, np.stack([Dx, Dy]))  # gradients (e, q, n, 2)
    rq = np.einsum("nq,en->eq", N, X[:, :, 0])
    B = np.zeros(D.shape[:2] + (4, 18))
    B[..., 0, 0::2] = D[..., 0]; B[..., 1, 1::2] = D[..., 1]
    B[..., 2, 0::2] = np.transpose(N)[None]/rq[..., None]
    B[..., 3, 0::2] = D[..., 1]; B[..., 3, 1::2] = D[..., 0]
    C = lam*np.outer([1, 1, 1, 0], [1, 1, 1, 0]) + np.diag([2*mu, 2*mu, 2*mu, mu])
    K = np.einsum("eqsi,st,eqtj,eq->eij", B, C, B, weight*det*rq, optimize=True)
    dof = np.stack([2*el, 2*el+1], 2).reshape(len(el), 18)
    A = sp.coo_matrix((K.ravel(), (np.repeat(dof, 18, 1).ravel(), np.tile(dof, 18).ravel())), shape=(2*n, 2*n)).tocsr()
    u = np.zeros(2*n); held = np.zeros(2*n, bool)
    bottom, lid, axis = ids[:, 0], ids[:, -1], np.concatenate([ids[0], upper[0]])
    for s in (bottom, lid): held[2*s] = held[2*s+1] = True
    held[2*axis] = True; u[2*lid+1] = 1.0
    free = ~held
    u[free] = sl.spsolve(A[free][:, free].tocsc(), -(A[free] @ u))
    e = np.einsum("eqsi,ei->eqs", B, u[dof]); s = e @ C
    I1 = s[..., :3].sum(-1); dev = s[..., :3] - I1[..., None]/3
    J2 = 0.5*(dev**2).sum(-1) + s[..., 3]**2
    load = np.sqrt(3)*sts*shs/(3*shs-sts)/(np.sqrt(J2) + sts/(np.sqrt(3)*(3*shs-sts))*I1)
    where = np.stack([rq, np.einsum("nq,en->eq", N, X[:, :, 1])], -1)
    return (A @ u) @ u, load, where
energy, load, where = solve(0)
print(f"stiffness of 5 degrees {energy*np.pi/36:.6g} N/mm")
for r_most in (0.5, 1, 2, 3, 4):
    ok = (where[..., 0] > r_most-0.5) & (where[..., 0] <= r_most) & (load > 0)
    k = np.argmin(np.where(ok, load, np.inf)); rz = where.reshape(-1, 2)[k]
    mid = ok & (abs(where[..., 1]/top(where[..., 0]) - 0.5) < 0.1)
    print(f"r {r_most-0.5:.1f} to {r_most:.1f}: strength surface at {1e3*load.ravel()[k]:.4f} um, r {rz[0]:.3f}, share {rz[1]/top(rz[0]):.3f}; in the middle {1e3*load[mid].min():.4f}")
print("radius mm, displacement um at which G = Gc (fixed grips), force of 5 degrees N")
last = energy
step = max(1, n_r//50)
for m in range(step, n_r, step):
    now, _, _ = solve(m)
    a0, a1 = R*(m-step)/n_r, R*m/n_r
    G = 0.5*(last-now)/(0.5*(a1**2-a0**2))  # at a unit displacement, per mm^2
    d = np.sqrt(Gc/G)
    print(f"{0.5*(a0+a1):.3f} {1e3*d:.4f} {0.5*(now+last)*np.pi/36*d:.3f}")
    last = now
