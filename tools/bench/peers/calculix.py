"""The heated cube for CalculiX: eight-node bricks, fixed steps, the iterative solver; and the temperatures that it prints."""
import bisect
import re

from series import BOTTOM, CONDUCTIVITY, DENSITY, HEAT, HEIGHTS, START, TIMES


def write(path, cells, steps):
    n = cells + 1
    number = lambda i, j, k: 1 + i + n * (j + n * k)
    with open(path, "w") as out:
        out.write("*NODE, NSET=ALL\n")
        for k in range(n):
            for j in range(n):
                for i in range(n):
                    out.write(f"{number(i, j, k)}, {i / cells:.9g}, {j / cells:.9g}, {k / cells:.9g}\n")
        out.write("*ELEMENT, TYPE=DC3D8, ELSET=CUBE\n")
        e = 0
        for k in range(cells):
            for j in range(cells):
                for i in range(cells):
                    e += 1
                    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
                    out.write(f"{e}, " + ", ".join(str(number(i + a, j + b, k + c)) for a, b, c in corners) + "\n")
        out.write("*NSET, NSET=BOTTOM\n" + "".join(f"{number(i, j, 0)}\n" for j in range(n) for i in range(n)))
        out.write("*NSET, NSET=LINE\n" + "".join(f"{number(cells // 2, cells // 2, k)}\n" for k in range(n)))
        out.write(f"*MATERIAL, NAME=ROCK\n*CONDUCTIVITY\n{CONDUCTIVITY}\n*SPECIFIC HEAT\n{HEAT}\n*DENSITY\n{DENSITY}\n")
        out.write("*SOLID SECTION, ELSET=CUBE, MATERIAL=ROCK\n")
        out.write(f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, {START}\n")
        dt = TIMES[-1] / steps
        out.write(f"*STEP, INC={steps + 1}\n*HEAT TRANSFER, DIRECT, SOLVER=ITERATIVE CHOLESKY\n{dt}, {TIMES[-1]}\n")
        out.write(f"*BOUNDARY\nBOTTOM, 11, 11, {BOTTOM}\n*NODE PRINT, NSET=LINE, FREQUENCY={steps // 10}\nNT\n*END STEP\n")


def read(path, cells):
    """Temperatures at HEIGHTS for TIMES, linear between the nodes of the line."""
    heights = [k / cells for k in range(cells + 1)]
    return {t: {z: between(heights, line, z) for z in HEIGHTS} for t, line in printed(path, TIMES).items()}


def printed(path, times):
    """The temperatures of the printed nodes, in the order of their numbers, at each of `times`."""
    blocks = re.split(r"temperatures for set LINE and time\s+(\S+)", path.read_text())[1:]
    values = {float(t): [float(number) for number in text.split()[1::2]] for t, text in zip(blocks[::2], blocks[1::2])}
    return {t: line for t in times for at, line in values.items() if abs(at - t) < 1}


def between(heights, line, z):
    k = max(1, min(bisect.bisect_left(heights, z), len(heights) - 1))
    part = (z - heights[k - 1]) / (heights[k] - heights[k - 1])
    return (1 - part) * line[k - 1] + part * line[k]
