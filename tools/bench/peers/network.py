"""The exact temperatures of the bed: C dT/dt = -K T of spheres that each have one, as the exponential of the matrix.

network.py N HELD TIME [TIME ...]: prints a line of JSON, a list of the temperatures [K] at the compared spheres for every time [s].
"""
import json
import sys

import numpy
import scipy.sparse
import scipy.sparse.linalg

from spheres import CAPACITY, CONDUCTANCE, HOT, START, compared


def chain(n):
    """Conductance matrix of n spheres in a row, in conductances of a contact."""
    degree = numpy.full(n, 2.0)
    degree[[0, -1]] = 1
    return scipy.sparse.diags([degree, -numpy.ones(n - 1), -numpy.ones(n - 1)], [0, 1, -1])


def main():
    n, held, times = int(sys.argv[1]), int(sys.argv[2]), [float(word) for word in sys.argv[3:]]
    one = scipy.sparse.identity(n)
    # Numbered with x fastest.
    k = sum(scipy.sparse.kron(a, scipy.sparse.kron(b, c)) for a, b, c in ((one, one, chain(n)), (one, chain(n), one), (chain(n), one, one)))
    i = numpy.arange(n ** 3)
    free = ~((i % n < held) & (i // n % n < held) & (i < n * n))
    a = (-CONDUCTANCE / CAPACITY * k.tocsr()[free][:, free]).tocsc()
    # What is left of the way to the held temperature, to which all spheres tend.
    left = numpy.full(int(free.sum()), START - HOT)
    spheres = [x + n * (y + n * z) for x, y, z in compared(n)]
    table = []
    for time in times:
        temperature = numpy.full(n ** 3, HOT)
        temperature[free] += scipy.sparse.linalg.expm_multiply(a * time, left)
        table.append([float(temperature[s]) for s in spheres])
    print(json.dumps(table))


main()
