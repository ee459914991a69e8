"""The bed of spheres that the programs heat: n by n copies of a tile with periodic sides that LIGGGHTS has settled.

Contacts conduct as in LIGGGHTS's fix heat/gran, 2 k sqrt(A) with A the circle in which two spheres overlap. Spheres of the
lowest layer are held hot where x and y are in the lower half of the bed.
"""
import itertools
import math
import random

COUNT, SIDE = 1000, 0.1  # spheres of a tile, and its sides [m]
DIAMETER, DENSITY, HEAT, CONDUCTIVITY = 0.01, 7800.0, 500.0, 5.0  # [m], [kg/m3], [J/kg/K], [W/m/K]
CAPACITY = DENSITY * HEAT * math.pi / 6 * DIAMETER ** 3  # of a sphere [J/K]
START, HOT = 298.15, 373.15  # [K]
TIMES = (600.0, 3600.0)  # [s]


def read_tile(path):
    """Centres as LIGGGHTS has dumped them."""
    rows = path.read_text().split("ITEM: ATOMS")[1].splitlines()[1:]
    return [tuple(float(word) for word in row.split()[1:]) for row in rows]


def tile_contacts(tile):
    """Of spheres i and j, which counts as being `over` tiles further in x and y: (i, j, over, conductance [W/K])."""
    for (i, a), (j, b) in itertools.combinations(enumerate(tile), 2):
        over = tuple(-round((b[axis] - a[axis]) / SIDE) for axis in range(2))
        distance = math.dist(a, (b[0] + over[0] * SIDE, b[1] + over[1] * SIDE, b[2]))
        if distance < DIAMETER:
            yield i, j, over, 2 * CONDUCTIVITY * math.sqrt(math.pi / 4 * (DIAMETER ** 2 - distance ** 2))


class Bed:
    """Centres, which are held, contacts (i, j, conductance [W/K]), which are compared: thirty near the held, thirty of all."""

    def __init__(self, tile, n):
        copies = list(itertools.product(range(n), repeat=2))
        self.centres = [(x + SIDE * across, y + SIDE * deep, z) for across, deep in copies for x, y, z in tile]
        self.held = [max(x, y) < n * SIDE / 2 and z < 0.75 * DIAMETER for x, y, z in self.centres]
        start = {copy: len(tile) * number for number, copy in enumerate(copies)}
        self.contacts = [(start[at] + i, start[to] + j, conductance) for i, j, over, conductance in tile_contacts(tile)
                         for at in copies if (to := (at[0] + over[0], at[1] + over[1])) in start]
        self.compared = self.drawn(n)

    def drawn(self, n):
        draw = random.Random(n)
        reach = n * SIDE / 2 + 2 * DIAMETER
        near = [i for i, (x, y, z) in enumerate(self.centres) if max(x, y) < reach and DIAMETER < z < 4 * DIAMETER]
        return draw.sample(near, 30) + draw.sample(range(len(self.centres)), 30)


def write_data(path, bed):
    """For LIGGGHTS; held spheres are of type 2."""
    low, high = (f(x for centre in bed.centres for x in centre) for f in (min, max))
    sides = "".join(f"{low - DIAMETER} {high + DIAMETER} {axis}lo {axis}hi\n" for axis in "xyz")
    atoms = "".join(f"{i + 1} {1 + held} {DIAMETER} {DENSITY} {x:.12f} {y:.12f} {z:.12f}\n"
                    for i, (held, (x, y, z)) in enumerate(zip(bed.held, bed.centres)))
    path.write_text(f"a bed of spheres\n\n{len(bed.centres)} atoms\n2 atom types\n\n{sides}\nAtoms\n\n{atoms}")
