"""The heated cube in DOLFINx: tetrahedra, BDF2 with fixed steps, conjugate gradients with incomplete Cholesky.

dolfinx_cube.py CELLS STEPS [DEGREE]: prints a line of JSON. Of degree 1 the mass is lumped; of degree 2 it is consistent, as lumping would
make masses of zero.
"""
import json
import sys
import time

import numpy as np
import ufl
from dolfinx import fem, geometry, mesh
from mpi4py import MPI
from petsc4py import PETSc

from series import BOTTOM, CONDUCTIVITY, DENSITY, HEAT, HEIGHTS, START, TIMES

cells, steps = int(sys.argv[1]), int(sys.argv[2])
degree = int(sys.argv[3]) if len(sys.argv) > 3 else 1
domain = mesh.create_unit_cube(MPI.COMM_WORLD, cells, cells, cells)
space = fem.FunctionSpace(domain, ("Lagrange", degree))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
bottom = fem.dirichletbc(
    PETSc.ScalarType(BOTTOM), fem.locate_dofs_geometrical(space, lambda x: np.isclose(x[2], 0)), space)
dt = TIMES[-1] / steps
stiffness = fem.form(CONDUCTIVITY * ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx)
if degree == 1:
    mass = fem.petsc.assemble_vector(fem.form(DENSITY * HEAT * v * ufl.dx))
else:
    mass = fem.petsc.assemble_matrix(fem.form(DENSITY * HEAT * u * v * ufl.dx))
    mass.assemble()
k = fem.petsc.assemble_matrix(stiffness)
k.assemble()

fixed = bottom.dof_indices()[0]
values = np.full(space.dofmap.index_map.size_local, START)
values[fixed] = BOTTOM
older, old = values.copy(), values.copy()


def matrix(factor):
    a = k.copy()
    if degree == 1:
        a.setDiagonal(a.getDiagonal() + factor / dt * mass)
    else:
        a.axpy(factor / dt, mass, PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
    a.zeroRowsColumns(fixed, 1.0)
    solver = PETSc.KSP().create(MPI.COMM_WORLD)
    solver.setOperators(a)
    solver.setType("cg")
    solver.getPC().setType("icc")
    solver.setTolerances(rtol=1e-8)
    solver.setInitialGuessNonzero(True)
    solver.setUp()
    return solver


# What the fixed nodes send into the others.
held = k.createVecRight()
held.set(0)
held.setValues(fixed, np.full(len(fixed), BOTTOM))
into, stored = k.createVecRight(), k.createVecRight()
k.mult(held, into)
first, later = matrix(1.0), matrix(1.5)
x, b = k.createVecRight(), k.createVecRight()
x.array[:] = old
assembled = time.perf_counter()
nodes = domain.geometry.x
line = {z: int(np.argmin(np.linalg.norm(space.tabulate_dof_coordinates() - np.array([0.5, 0.5, z]), axis=1))) for z in HEIGHTS}
tree = geometry.BoundingBoxTree(domain, domain.topology.dim)


def at_heights():
    found = fem.Function(space)
    found.x.array[:] = old
    points = np.array([[0.5, 0.5, z] for z in HEIGHTS])
    candidates = geometry.compute_collisions(tree, points)
    hit = geometry.compute_colliding_cells(domain, candidates, points)
    return {z: float(found.eval(points[i], hit.links(i)[0])[0]) for i, z in enumerate(HEIGHTS)}


seen = {}
for n in range(1, steps + 1):
    # The fixed nodes have not changed: their part of the mass is left out on both sides.
    x.array[:] = old if n == 1 else 2 * old - 0.5 * older
    x.array[fixed] = 0
    if degree == 1:
        stored.pointwiseMult(mass, x)
    else:
        mass.mult(x, stored)
    b.array[:] = stored.array / dt - into.array
    x.array[:] = old
    b.array[fixed] = BOTTOM
    (first if n == 1 else later).solve(b, x)
    older, old = old, x.array.copy()
    for t in TIMES:
        if abs(n * dt - t) < 0.5 * dt:
            seen[t] = at_heights()
end = time.perf_counter()
print(json.dumps({"nodes": len(values), "steps": steps, "values": seen, "loop": end - assembled}))
