"""Two slabs on each other for CalculiX: four-node tetrahedra, gap conductance, the iterative solver; half of the steps until the first of TIMES,
half from there."""
from two_slabs import BOTTOM, CAPACITY, CONDUCTANCE, CONDUCTIVITY, SIDE, START, TIMES

FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # S1 to S4
DENSITY = 2500.0
# The slabs are pressed into each other by this: contacts face to face that rounding leaves open by a hair pass no heat. [m]
PRESSED = 1e-6


def write(path, slabs, kind, steps):
    """`slabs`: nodes and tetrahedra of the lower and the upper one, each from zero; `kind` of contact pair."""
    (lower, below), (upper, above) = slabs
    upper = [(x, y, z - PRESSED) for x, y, z in upper]
    with open(path, "w") as out:
        out.write("*NODE, NSET=ALL\n" + "".join(f"{n}, {x:.9g}, {y:.9g}, {z:.9g}\n" for n, (x, y, z) in enumerate(lower + upper, 1)))
        for name, elements, first, shift in (("LOWER", below, 1, 1), ("UPPER", above, 1 + len(below), 1 + len(lower))):
            out.write(f"*ELEMENT, TYPE=C3D4, ELSET={name}\n")
            out.writelines(f"{e}, " + ", ".join(str(n + shift) for n in element) + "\n" for e, element in enumerate(elements, first))
        write_surface(out, "UNDER", lower, below, 1)
        write_surface(out, "OVER", upper, above, 1 + len(below))
        write_set(out, "BOTTOM", lower, lambda x, y, z: z < 1e-9)
        write_set(out, "LINE", lower + upper, lambda x, y, z: abs(x - SIDE / 2) + abs(y - SIDE / 2) < 1e-9)
        for name, conductivity in zip(("LOWER", "UPPER"), CONDUCTIVITY):
            out.write(f"*MATERIAL, NAME={name}\n*CONDUCTIVITY\n{conductivity}\n*SPECIFIC HEAT\n{CAPACITY / DENSITY}\n*DENSITY\n{DENSITY}\n")
            out.write(f"*SOLID SECTION, ELSET={name}, MATERIAL={name}\n")
        # Heat passes only where a contact spring does: the conductance is given over its pressure, the same at all.
        out.write("*SURFACE INTERACTION, NAME=JOINT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e8, 1\n")
        out.write(f"*GAP CONDUCTANCE\n{CONDUCTANCE}, -1e9, 0\n{CONDUCTANCE}, 1e9, 0\n")
        # The finer side is the dependent one, as the manual advises.
        out.write(f"*CONTACT PAIR, INTERACTION=JOINT, TYPE={kind}\nOVER, UNDER\n")
        out.write(f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, {START}\n")
        for begin, end in zip((0, *TIMES), TIMES):
            out.write(f"*STEP, INC={steps}\n*HEAT TRANSFER, DIRECT, SOLVER=ITERATIVE CHOLESKY\n{2 * (end - begin) / steps}, {end - begin}\n")
            out.write(f"*BOUNDARY\nBOTTOM, 11, 11, {BOTTOM}\n*NODE PRINT, NSET=LINE, FREQUENCY={steps}\nNT\n*END STEP\n")


def write_surface(out, name, nodes, elements, first):
    """The faces that lie in the joint."""
    touching = [abs(z - SIDE) < 2 * PRESSED for x, y, z in nodes]
    out.write(f"*SURFACE, NAME={name}\n")
    out.writelines(f"{e}, S{1 + f}\n" for e, element in enumerate(elements, first) for f, corners in enumerate(FACES)
                   if all(touching[element[c]] for c in corners))


def write_set(out, name, nodes, inside):
    out.write(f"*NSET, NSET={name}\n" + "".join(f"{n}\n" for n, node in enumerate(nodes, 1) if inside(*node)))
