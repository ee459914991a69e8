"""The exact temperatures of the bed: C dT/dt = -K T of spheres that each have one, as the exponential of the matrix.

network.py TILE N: prints a line of JSON, for each of TIMES a list of the temperatures [K] at the compared spheres.
"""
import json
import pathlib
import sys

import numpy
import scipy.sparse
import scipy.sparse.linalg

from spheres import CAPACITY, HOT, START, TIMES, Bed, read_tile


def conductance_matrix(bed):
    first, second, conductance = (numpy.array(column) for column in zip(*bed.contacts))
    count = len(bed.centres)
    passed = scipy.sparse.coo_matrix((conductance, (first, second)), (count, count)).tocsr()
    passed += passed.T
    return scipy.sparse.diags(numpy.asarray(passed.sum(axis=1)).ravel()) - passed


def main():
    bed = Bed(read_tile(pathlib.Path(sys.argv[1])), int(sys.argv[2]))
    free = ~numpy.array(bed.held)
    a = (-1 / CAPACITY * conductance_matrix(bed).tocsr()[free][:, free]).tocsc()
    # What is left of the way to the held temperature, to which all spheres tend that are joined to held ones.
    left = numpy.full(int(free.sum()), START - HOT)
    table = []
    for time in TIMES:
        temperature = numpy.full(len(free), HOT)
        temperature[free] += scipy.sparse.linalg.expm_multiply(a * time, left)
        table.append([float(temperature[sphere]) for sphere in bed.compared])
    print(json.dumps(table))


main()
