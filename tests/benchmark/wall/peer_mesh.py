"""Meshes of the peer out of a case's grid, and their rigid motions."""

import numpy as np
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

# Six tetrahedra of a box around the diagonal from corner 0 to 7, by corners of a tensor product: the same cut in every box, so that
# they fit together.
TETRAHEDRA = [[0, 1, 3, 7], [0, 1, 5, 7], [0, 2, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 4, 6, 7]]
TRIANGLES = [[[0, 1, 3], [0, 2, 3]], [[0, 1, 2], [1, 2, 3]]]


def make_mesh(case, kind):
    n, cells = case.dimension, case.cells
    if kind == "simplices" and n == 2:
        cells = np.where(case.parity[:, None, None] == 0, cells[:, TRIANGLES[0]], cells[:, TRIANGLES[1]]).reshape(-1, 3)
    elif kind == "simplices":
        cells = cells[:, TETRAHEDRA].reshape(-1, 4)
    name = {"simplices": {2: "triangle", 3: "tetrahedron"}, "boxes": {2: "quadrilateral", 3: "hexahedron"}}[kind][n]
    return mesh.create_mesh(MPI.COMM_SELF, cells.astype(np.int64), case.points, ufl.Mesh(ufl.VectorElement("Lagrange", name, 1)))


def rigid_motions(space, n):
    x, vectors = space.tabulate_dof_coordinates(), []
    rotations = [(0, 1)] if n == 2 else [(0, 1), (1, 2), (2, 0)]
    for k in range(n + len(rotations)):
        motion = fem.Function(space)
        values = motion.x.array.reshape(-1, n)
        if k < n:
            values[:, k] = 1.0
        else:
            a, b = rotations[k - n]
            values[:, a], values[:, b] = -x[:, b], x[:, a]
        vectors.append(motion.vector.copy())
    for i, v in enumerate(vectors):
        for w in vectors[:i]:
            v.axpy(-w.dot(v), w)
        v.normalize()
    return PETSc.NullSpace().create(vectors=vectors, comm=MPI.COMM_SELF)
