# A disc of rubber between two bonded plates, neo-Hookean and axisymmetric, by Taylor-Hood elements (biquadratic
# displacement, bilinear pressure; SciPy): force over the area, stress on the axis and stored energy.
# Usage: rubber_disc.py R_MM HEIGHT_MM NU ELEMENTS_IN_RADIUS ELEMENTS_IN_HEIGHT RISE_OF_THE_TOP_IN_MM STEPS
import sys
import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
R, H, nu = (float(a) for a in sys.argv[1:4])
n_r, n_z, rise, steps = int(sys.argv[4]), int(sys.argv[5]), float(sys.argv[6]), int(sys.argv[7])
mu, lam = 1.0, 2*nu/(1-2*nu)
# nodes: lattice of (2 n_r + 1) (2 n_z + 1) for u, every second one for p
N_r, N_z = 2*n_r+1, 2*n_z+1
grid = lambda L, n: L*np.linspace(0, 1, n)
X = np.stack(np.meshgrid(grid(R, N_r), grid(H, N_z), indexing="ij"), -1).reshape(-1, 2)
at = lambda i, j: i*N_z+j
E = [(a, b) for a in range(n_r) for b in range(n_z)]
quad = np.array([[at(2*a+i, 2*b+j) for i in range(3) for j in range(3)] for a, b in E])
lin = np.array([[(a+i)*(n_z+1)+b+j for i in range(2) for j in range(2)] for a, b in E])
n_u, n_p = len(X), (n_r+1)*(n_z+1)
def l2(s): return np.array([2*(s-.5)*(s-1), -4*s*(s-1), 2*s*(s-.5)]), np.array([4*s-3, 4-8*s, 4*s-1])
def l1(s): return np.array([1-s, s])
g, gw = np.polynomial.legendre.leggauss(4); g, gw = (g+1)/2, gw/2
points = [(a, b, wa*wb) for a, wa in zip(g, gw) for b, wb in zip(g, gw)]
dr, dz = R/n_r, H/n_z
dofs = np.concatenate([2*quad, 2*quad+1, 2*n_u+lin], 1)  # 9 radial, 9 axial, 4 pressures
free = np.ones(2*n_u+n_p, bool)
axis, low, top = X[:, 0] == 0, X[:, 1] == 0, X[:, 1] == H
free[0:2*n_u:2][axis | low | top] = False; free[1:2*n_u:2][low | top] = False
def assemble(x):
    r_all, k_all = np.zeros((len(E), 22)), np.zeros((len(E), 22, 22)); energy = 0.0; tops = 0
    ur, uz, pe = x[2*quad], x[2*quad+1], x[2*n_u+lin]
    for s, t, w in points:
        (a, da), (b, db) = l2(s), l2(t)
        N = np.outer(a, b).ravel(); Nr = np.outer(da, b).ravel()/dr; Nz = np.outer(a, db).ravel()/dz
        P = np.outer(l1(s), l1(t)).ravel()
        rad = X[quad][:, :, 0] @ N; W = w*dr*dz*rad*2*np.pi
        B = np.zeros((len(E), 5, 18))  # rows F_rr, F_rz, F_zr, F_zz, F_tt
        B[:, 0, :9] = Nr; B[:, 1, :9] = Nz; B[:, 2, 9:] = Nr; B[:, 3, 9:] = Nz; B[:, 4, :9] = N/rad[:, None]
        F = np.einsum("eij,ej->ei", B, np.concatenate([ur, uz], 1)) + [1, 0, 0, 1, 1]
        a_, b_, c_, d_, h = F.T; D = a_*d_-b_*c_; J = D*h; p = pe @ P
        cof = np.stack([d_*h, -c_*h, -b_*h, a_*h, D], 1)
        C2 = np.zeros((len(E), 5, 5))  # d cof/dF
        for i, j, v in ((0, 3, h), (1, 2, -h), (0, 4, d_), (1, 4, -c_), (2, 4, -b_), (3, 4, a_)): C2[:, i, j] = C2[:, j, i] = v
        f = p-mu/J  # of mu/2 (I1-3) - mu ln J + p (J-1) - p^2/(2 lam)
        S = mu*F+f[:, None]*cof
        A = mu*np.eye(5)+f[:, None, None]*C2+(mu/J**2)[:, None, None]*cof[:, :, None]*cof[:, None, :]
        BW = B*W[:, None, None]
        r_all[:, :18] += np.einsum("eij,ei->ej", BW, S)
        r_all[:, 18:] += ((J-1-p/lam)*W)[:, None]*P
        k_all[:, :18, :18] += np.einsum("eia,eij,ejb->eab", BW, A, B)
        up = np.einsum("eia,ei->ea", BW, cof)[:, :, None]*P
        k_all[:, :18, 18:] += up; k_all[:, 18:, :18] += np.swapaxes(up, 1, 2)
        k_all[:, 18:, 18:] -= (W/lam)[:, None, None]*np.outer(P, P)
        energy += (W*(mu/2*((F*F).sum(1)-3)-mu*np.log(J)+p*p/(2*lam))).sum()
    res = np.bincount(dofs.ravel(), r_all.ravel(), 2*n_u+n_p)
    i, j = np.repeat(dofs, 22, 1).ravel(), np.tile(dofs, (1, 22)).ravel()
    return res, sp.csc_matrix((k_all.ravel(), (i, j)), shape=(2*n_u+n_p,)*2), energy
x = np.zeros(2*n_u+n_p); idx = np.flatnonzero(free)
for step in range(1, steps+1):
    x[1:2*n_u:2] += X[:, 1]/H*rise/steps
    for it in range(30):
        res, K, energy = assemble(x)
        if np.abs(res[idx]).max() < 1e-9*max(1, np.abs(res[:2*n_u]).max()): break
        x[idx] -= splu(K[idx][:, idx]).solve(res[idx])
    force = res[1:2*n_u:2][top].sum()
    print(f"{1e3*rise*step/steps:.1f} um: mean stress {force/(np.pi*R*R):.5f} mu, pressure on the axis {x[2*n_u+n_z//2]:.4f} mu, "
          f"energy {energy:.5f} mu mm^3, {it} steps of Newton", flush=True)
