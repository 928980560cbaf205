# Cantilevers of layers in plane strain and bonded layers that are pulled, by quadratic elements (nine nodes): what the
# tests laminate_beams.cpp and confined_layers.cpp compare with. Needs NumPy and SciPy.
import numpy as np, scipy.sparse as sp, scipy.sparse.linalg as sl

POINTS, WEIGHTS = np.array([-np.sqrt(.6), 0, np.sqrt(.6)]), np.array([5, 8, 5])/9
def shapes(s):
    return np.array([s*(s-1)/2, 1-s*s, s*(s+1)/2]), np.array([s-.5, -2*s, s+.5])
def lame(E, nu):
    return E*nu/(1+nu)/(1-2*nu), E/2/(1+nu)
def solve(X, Y, laws, hold, traction=0.0, axisymmetric=False):
    """Edges of the elements along x and y; (lambda, mu) of each row of them; hold(x, y, values) sets what is held; a
    traction along y on the last x. Returns the stiffness matrix, the displacements and the forces."""
    nx, ny = len(X)-1, len(Y)-1
    x, y = (np.interp(np.arange(2*n+1)/2, np.arange(n+1), E) for n, E in ((nx, X), (ny, Y)))
    i, j = (k.ravel() for k in np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"))
    nodes = np.stack([(2*i+a)*(2*ny+1) + 2*j+b for a in range(3) for b in range(3)], 1)
    hx, hy = np.diff(X)[i], np.diff(Y)[j]
    lam, mu = (np.array([law[k] for law in laws])[j] for k in (0, 1))
    K = np.zeros((len(i), 18, 18))
    for p, wp in zip(POINTS, WEIGHTS):
        for q, wq in zip(POINTS, WEIGHTS):
            (n, dn), (m, dm) = shapes(p), shapes(q)
            r = X[i] + hx*(1+p)/2 if axisymmetric else np.ones(len(i))
            B = np.zeros((len(i), 4, 18))
            B[:, 0, 0::2] = B[:, 2, 1::2] = np.outer(dn, m).ravel()*2/hx[:, None]
            B[:, 1, 1::2] = B[:, 2, 0::2] = np.outer(n, dm).ravel()*2/hy[:, None]
            if axisymmetric: B[:, 3, 0::2] = np.outer(n, m).ravel()/r[:, None]
            D = np.zeros((len(i), 4, 4))
            for a in (0, 1, 3):
                for b in (0, 1, 3): D[:, a, b] = lam
                D[:, a, a] += 2*mu
            D[:, 2, 2] = mu
            w = wp*wq*hx*hy/4*r*(2*np.pi if axisymmetric else 1)
            K += np.einsum("e,eai,eab,ebj->eij", w, B, D, B, optimize=True)
    dofs = np.stack([2*nodes, 2*nodes+1], 2).reshape(len(i), 18)
    size = 2*len(x)*len(y)
    A = sp.csr_matrix((K.ravel(), (np.repeat(dofs, 18, 1).ravel(), np.tile(dofs, (1, 18)).ravel())), shape=(size, size))
    at = np.meshgrid(x, y, indexing="ij")
    values = np.full((len(x)*len(y), 2), np.nan)
    hold(at[0].ravel(), at[1].ravel(), values)
    held, force = ~np.isnan(values.ravel()), np.zeros(size)
    for k in range(ny):
        for b, part in zip(range(3), (1/6, 4/6, 1/6)):
            force[2*(2*nx*(2*ny+1) + 2*k+b) + 1] += traction*part*(Y[k+1]-Y[k])
    u = np.where(held, values.ravel(), 0.0)
    u[~held] = sl.spsolve(A[~held][:, ~held].tocsc(), (force - A@u)[~held])
    return A, u, force
def rows(parts, per):
    """Of (thickness, E, nu) from below: edges, finer at the faces of each, and laws."""
    Y, laws = [0.0], []
    for t, E, nu in parts:
        Y += list(Y[-1] + t*(1-np.cos(np.pi*np.arange(1, per+1)/per))/2)
        laws += [lame(E, nu)]*per
    return np.array(Y), laws
def deflection(parts, span, nx=60, per=8):
    """Mean deflection of the end under a force of 1 per width, clamped at x = 0."""
    Y, laws = rows(parts, per)
    s = np.linspace(0, 1, nx+1)
    def hold(x, y, values): values[x == 0] = 0
    _, u, force = solve(span*(.7*s**3+.3*s), Y, laws, hold, 1/Y[-1])
    return force@u
def stiffness(parts, half, axisymmetric, nx=60, per=12):
    """Force by unit nominal strain between rigid plates: of a disc by its radius, or of half a strip by half its width."""
    Y, laws = rows(parts, per)
    H = Y[-1]
    def hold(x, y, values):
        values[x == 0, 0] = 0
        values[y == 0] = 0
        values[y > H*(1-1e-12)] = 0, H
    A, u, _ = solve(half*(1-(1-np.linspace(0, 1, nx+1))**1.8), Y, laws, hold, axisymmetric=axisymmetric)
    return u@(A@u)/H

if __name__ == "__main__":
    for name, shares, stiff in (("halves", (.5, .5), (1, 0)), ("film", (.1, .9), (1, 0)), ("skins", (.1, .8, .1), (1, 0, 1)),
                                ("core", (1/3, 1/3, 1/3), (0, 1, 0))):
        print(name, *(f"{deflection([(1.5*a, r if s else 1, .3) for a, s in zip(shares, stiff)], 25):.6g}"
                      for r in (1, 4, 10, 100)))
    for nu in (.35, .44, .469):
        print(nu, *(f"{f:.6g}" for f in (stiffness([(1, 1, nu)], 5, True), stiffness([(1, 1, nu)], 3, False),
                                         stiffness([(1, 1000, .3), (1, 1, nu), (1, 1000, .3)], 3, False))))
