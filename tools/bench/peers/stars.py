"""The bed of spheres for Scree, which has no spheres that touch in points: a star of tetrahedra for each, and the scene."""
import math
import random

from meshes import write_vtu
from spheres import CAPACITY, CONDUCTIVITY, DIAMETER, HEAT, HOT, START, TIMES

# What a joint conducts [W/m2/K], so much that faces are small, and the volume of a star [m3], a bit more than its tetrahedra at
# nine contacts have; so all stay within their spheres. Faces of a contact are GAP apart [m], since nodes may not coincide.
JOINT, VOLUME, GAP = 1e5, 3e-9, 1e-7
NARROW = math.cos(math.radians(25))  # tetrahedra reach 5 degrees from their way at contacts, 19 where they fill the volume


def face(centre, normal, height, area):
    """Three corners, the same ones from the other side."""
    least = min(range(3), key=lambda axis: abs(normal[axis]))
    across = [(axis == least) - normal[least] * normal[axis] for axis in range(3)]
    across = [part / math.hypot(*across) for part in across]
    along = [normal[axis - 2] * across[axis - 1] - normal[axis - 1] * across[axis - 2] for axis in range(3)]
    radius = math.sqrt(4 * area / math.sqrt(27))
    turns = [(radius * math.cos(angle), radius * math.sin(angle)) for angle in (0, 2 * math.pi / 3, 4 * math.pi / 3)]
    return [[c + height * n + cosine * p + sine * q for c, n, p, q in zip(centre, normal, across, along)]
            for cosine, sine in turns]


def free_way(normals, draw):
    """A direction in which a sphere has no contact."""
    while True:
        way = [draw.gauss(0, 1) for _ in range(3)]
        way = [part / math.hypot(*way) for part in way]
        if all(sum(p * q for p, q in zip(way, normal)) < NARROW for normal in normals):
            return way


def stars(bed):
    """For every sphere its nodes, the centre first, then three for each of the tetrahedra that share it: one with a face at
    each contact, whose joint conducts as the contact does, and one that makes the volumes of all alike."""
    nodes, normals, left = [[centre] for centre in bed.centres], [[] for _ in bed.centres], [VOLUME] * len(bed.centres)
    for i, j, conductance in bed.contacts:
        distance = math.dist(bed.centres[i], bed.centres[j])
        height, area = (distance - GAP) / 2, conductance / JOINT
        for here, there in ((i, j), (j, i)):
            normals[here].append([(q - p) / distance for p, q in zip(bed.centres[here], bed.centres[there])])
            nodes[here] += face(bed.centres[here], normals[here][-1], height, area)
            left[here] -= area * height / 3
    draw, height = random.Random(1), 0.4 * DIAMETER
    for centre, star, ways, volume in zip(bed.centres, nodes, normals, left):
        star += face(centre, free_way(ways, draw), height, 3 * volume / height)
    return nodes


def mesh_of(parts):
    """Nodes and tetrahedra of stars."""
    nodes, tetrahedra = [], []
    for part in parts:
        centre = len(nodes)
        nodes += part
        tetrahedra += [(centre, first, first + 1, first + 2) for first in range(centre + 1, len(nodes), 3)]
    return nodes, tetrahedra


def scene(bed):
    """For Scree, beside hot.vtu and cold.vtu."""
    probes = "".join(f"    s{i}: [{', '.join(f'{x:.12f}' for x in bed.centres[i])}]\n" for i in sorted(set(bed.compared)))
    return f"""title: a bed of spheres
materials:
  steel: {{density: {CAPACITY / HEAT / VOLUME:.15g}, conductivity: {CONDUCTIVITY}, specific_heat: {HEAT}}}
bodies:
  hot: {{mesh: {{file: hot.vtu, position: [0, 0, 0]}}, material: steel, mesh_size: {DIAMETER}}}
  cold: {{mesh: {{file: cold.vtu, position: [0, 0, 0]}}, material: steel, mesh_size: {DIAMETER}}}
contact: {{conductance: {JOINT}}}
heat:
  initial: {START}
  blocks: {{model: lumped}}
  boundaries: [{{body: hot, temperature: {HOT}}}]
  until: {TIMES[-1]}
  tolerance: 0.1 K
output:
  every: {TIMES[0]}
  frames_every: {TIMES[-1]}
  probes:
{probes}"""


def write_scene(folder, bed):
    (folder / "bed.yaml").write_text(scene(bed))
    parts = stars(bed)
    for name, hot in (("hot", True), ("cold", False)):
        write_vtu(folder / f"{name}.vtu", *mesh_of(part for part, held in zip(parts, bed.held) if held == hot))
