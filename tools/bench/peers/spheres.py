"""The bed of spheres that the programs heat: n to an edge on a simple cubic lattice, of which a square of the lowest layer is held hot."""
import math
import random

SPACING, DIAMETER, DENSITY, HEAT = 0.01, 0.01002, 7800.0, 500.0  # [m], [m], [kg/m3], [J/kg/K]
CONDUCTIVITY, CONTACT_AREA = 50.0, 1e-8  # [W/m/K], [m2]
CONDUCTANCE = 2 * CONDUCTIVITY * math.sqrt(CONTACT_AREA)  # of a contact, as fix heat/gran has it [W/K]
CAPACITY = DENSITY * HEAT * math.pi / 6 * DIAMETER ** 3  # of a sphere [J/K]
START, HOT = 298.15, 373.15  # [K]
TIMES = (600.0, 3600.0)  # [s]


def held(n):
    """How many spheres along an edge of the held square."""
    return n // 2


def compared(n):
    """Places (x, y, z) on the lattice of spheres that are compared: sixty, half of them near the held ones."""
    draw = random.Random(n)
    near = [tuple(draw.randrange(min(n, held(n) + 2)) for _ in range(2)) + (draw.randrange(1, 4),) for _ in range(30)]
    return near + [tuple(draw.randrange(n) for _ in range(3)) for _ in range(30)]


def lattice(low, high):
    """Copies from the place `low` to before `high`, for a scene."""
    count = [b - a for a, b in zip(low, high)]
    centre = ", ".join(f"{0.5 * (a + b) * SPACING:.9g}" for a, b in zip(low, high))
    return f"{{count: {count}, spacing: [{SPACING}, {SPACING}, {SPACING}], centre: [{centre}]}}"


def scene(n):
    """For Scree: a cube around every sphere with the sphere's heat capacity, and joints whose faces conduct as a contact does."""
    m = held(n)
    parts = {"hot": ((0, 0, 0), (m, m, 1)), "beside": ((m, 0, 0), (n, m, 1)), "behind": ((0, m, 0), (n, n, 1)), "above": ((0, 0, 1), (n, n, n))}
    bodies = "".join(
        f"  {name}: {{box: {{size: [{SPACING}, {SPACING}, {SPACING}]}}, lattice: {lattice(*part)}, material: steel, mesh_size: {SPACING}, "
        "elements: hexahedron}\n" for name, part in parts.items())
    probes = "".join(
        f"    s{i}: [{', '.join(f'{(a + 0.5) * SPACING:.9g}' for a in place)}]\n" for i, place in enumerate(compared(n)))
    return f"""title: a bed of spheres
materials:
  steel: {{density: {CAPACITY / HEAT / SPACING ** 3:.15g}, conductivity: {CONDUCTIVITY}, specific_heat: {HEAT}}}
bodies:
{bodies}contact: {{conductance: {CONDUCTANCE / SPACING ** 2:.15g}}}
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
