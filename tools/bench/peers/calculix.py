"""Writes the heated cube for CalculiX: eight-node bricks, fixed steps, the iterative solver; and reads its temperatures."""
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
    seen, time, line = {}, None, []

    def close():
        for t in TIMES:
            if time is not None and abs(time - t) < 1:
                seen[t] = {z: between(line, z, cells) for z in HEIGHTS}

    for text in open(path):
        if "time" in text:
            close()
            time, line = float(text.split()[-1]), []
        elif text.split() and text.split()[0].isdigit():
            line.append(float(text.split()[1]))
    close()
    return seen


def between(line, z, cells):
    k = min(int(z * cells + 1e-9), cells - 1)
    part = z * cells - k
    return (1 - part) * line[k] + part * line[k + 1]
