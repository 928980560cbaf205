# Cantilevers, 25 x 1.5 mm, of a material with inclined fibres, by quadratic elements (27 nodes): what the test
# inclined_fibres.cpp compares with. Strips 6 mm wide, and slices in plane strain. Needs NumPy and SciPy.
import numpy as np, scipy.sparse as sp, scipy.sparse.linalg as sl

POINTS, WEIGHTS = np.array([-np.sqrt(.6), 0, np.sqrt(.6)]), np.array([5, 8, 5])/9
PAIRS = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
def shapes(s):
    return np.array([s*(s-1)/2, 1-s*s, s*(s+1)/2]), np.array([s-.5, -2*s, s+.5])
def stiffness(E, nu, G, axes):
    """E of the axes 1, 2, 3, nu and G of 12, 23, 13; the axes are columns. Voigt's notation, in Pa."""
    S = np.zeros((6, 6))
    S[:3, :3] = [[1/E[0], -nu[0]/E[0], -nu[2]/E[0]], [-nu[0]/E[0], 1/E[1], -nu[1]/E[1]], [-nu[2]/E[0], -nu[1]/E[1], 1/E[2]]]
    S[3, 3], S[4, 4], S[5, 5] = 1/G[1], 1/G[2], 1/G[0]
    C, full = np.linalg.inv(S), np.zeros((3, 3, 3, 3))
    for a, (i, j) in enumerate(PAIRS):
        for b, (k, l) in enumerate(PAIRS):
            for p, q in {(i, j), (j, i)}:
                for r, s in {(k, l), (l, k)}: full[p, q, r, s] = C[a, b]
    full = np.einsum("ia,jb,kc,ld,abcd->ijkl", *4*[axes], full, optimize=True)
    return np.array([[full[i, j, k, l] for k, l in PAIRS] for i, j in PAIRS])
def turned(about, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array({"z": [[c, -s, 0], [s, c, 0], [0, 0, 1]], "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]]}[about])
def deflection(C, cells, width, is_plane, span=25e-3, height=1.5e-3):
    """Mean deflection of the end along y [m] under 1 N, clamped at x = 0; C of all elements, or of each."""
    t = np.linspace(0, 1, cells[0]+1)
    X, Y = span*(t - .7*np.sin(2*np.pi*t)/(2*np.pi)), np.linspace(0, height, cells[1]+1)
    t = np.linspace(0, 1, cells[2]+1)
    Z = width*(t if is_plane else t - .7*np.sin(2*np.pi*t)/(2*np.pi))
    n = [2*k+1 for k in cells]
    i, j, k = (a.ravel() for a in np.meshgrid(*map(range, cells), indexing="ij"))
    number = lambda a, b, c: (a*n[1] + b)*n[2] + c
    nodes = np.stack([number(2*i+a, 2*j+b, 2*k+c) for a in range(3) for b in range(3) for c in range(3)], 1)
    h = [np.diff(X)[i], np.diff(Y)[j], np.diff(Z)[k]]
    K = np.zeros((len(i), 81, 81))
    for p, wp in zip(POINTS, WEIGHTS):
        for q, wq in zip(POINTS, WEIGHTS):
            for r, wr in zip(POINTS, WEIGHTS):
                (a, da), (b, db), (c, dc) = shapes(p), shapes(q), shapes(r)
                x, y, z = (np.outer(2/size, np.einsum("a,b,c->abc", *of).ravel())
                           for size, of in zip(h, ((da, b, c), (a, db, c), (a, b, dc))))
                B = np.zeros((len(i), 6, 81))
                B[:, 0, 0::3] = B[:, 4, 2::3] = B[:, 5, 1::3] = x
                B[:, 1, 1::3] = B[:, 3, 2::3] = B[:, 5, 0::3] = y
                B[:, 2, 2::3] = B[:, 3, 1::3] = B[:, 4, 0::3] = z
                K += (wp*wq*wr*h[0]*h[1]*h[2]/8)[:, None, None]*np.matmul(B.transpose(0, 2, 1), np.matmul(C, B))
    dofs = np.stack([3*nodes, 3*nodes+1, 3*nodes+2], 2).reshape(len(i), 81)
    size = 3*n[0]*n[1]*n[2]
    A = sp.csr_matrix((K.ravel(), (np.repeat(dofs, 81, 1).ravel(), np.tile(dofs, (1, 81)).ravel())), shape=(size, size))
    force = np.zeros(size)
    for b in range(cells[1]):
        for c in range(cells[2]):
            for p, wp in zip(range(3), (1/6, 4/6, 1/6)):
                for q, wq in zip(range(3), (1/6, 4/6, 1/6)):
                    force[3*number(n[0]-1, 2*b+p, 2*c+q)+1] += wp*wq*(Y[b+1]-Y[b])*(Z[c+1]-Z[c])/(height*width)
    free = np.ones(size, bool)
    free[:3*n[1]*n[2]] = False
    if is_plane: free[2::3] = False
    u = sl.splu(A[free][:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", options=dict(SymmetricMode=True)).solve(force[free])
    return force[free]@u

def across(cells, stiffness_at):
    """C of each element by its place across, 0 to 1."""
    j = np.arange(cells[0]*cells[1]*cells[2])//cells[2] % cells[1]
    return np.array([stiffness_at((k + .5)/cells[1]) for k in range(cells[1])])[j]

if __name__ == "__main__":
    constants = (140e9, 10e9, 10e9), (.3, .4, .3), (5e9, 3.6e9, 5e9)
    for angle in (15, 30, 45, 60):
        C = stiffness(*constants, turned("z", angle))
        print(f"slice of 1 m, {angle} degrees", *(f"{deflection(C, cells, 1.0, True):.5e}" for cells in ((40, 6, 1), (80, 12, 1))))
    for name, axes in (("z 30", turned("z", 30)), ("z 45", turned("z", 45)), ("y 30", turned("y", 30)),
                       ("z 30 and y 30", turned("y", 30)@turned("z", 30))):
        C = stiffness(*constants, axes)
        print(name, *(f"{deflection(C, cells, 6e-3, False):.5e}" for cells in ((16, 3, 5), (24, 4, 8))))
    for a, b in ((30, 35), (30, 60), (60, 30), (-20, 20), (-30, 30)):
        at = lambda y: stiffness(*constants, turned("z", a + (b - a)*y))
        print(f"slice of 1 m, {a} to {b} degrees", *(f"{deflection(across(cells, at), cells, 1.0, True):.5e}" for cells in ((40, 16, 1), (60, 32, 1))))
    for a, b in ((30, 40), (30, 60)):
        at = lambda y: stiffness(*constants, turned("z", a + (b - a)*y))
        print(f"z {a} to {b}", *(f"{deflection(across(cells, at), cells, 6e-3, False):.5e}" for cells in ((16, 8, 5), (16, 12, 8))))
    bar = deflection(stiffness(*constants, turned("z", 30)), (24, 4, 4), 1.5e-3, False)
    print(f"bar 1.5 mm wide, z 30, under 1 N/m of its width {1.5e-3*bar:.5e}")
