"""Boxes of tetrahedra, the same for every program, and files of tetrahedra for Scree."""
import array
import itertools


def box(cells, size, low):
    """Nodes and tetrahedra (four numbers from 0) of a box whose cells are cut into six along a diagonal."""
    across, deep, high = (n + 1 for n in cells)
    number = lambda i, j, k: i + across * (j + deep * k)
    nodes = [tuple(low[a] + size[a] * at[a] / cells[a] for a in range(3))
             for at in ((i, j, k) for k in range(high) for j in range(deep) for i in range(across))]
    return nodes, [[number(*corner) for corner in path] for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])
                   for path in paths((i, j, k))]


def paths(start):
    """The six ways from a corner of a cell to the opposite one, each a tetrahedron of positive volume."""
    for order in itertools.permutations(range(3)):
        corner, path = list(start), [tuple(start)]
        for axis in order:
            corner[axis] += 1
            path.append(tuple(corner))
        if order in ((0, 2, 1), (2, 1, 0), (1, 0, 2)):
            path[1], path[2] = path[2], path[1]
        yield path


def apart(nodes, tetrahedra, scale):
    """The corners of each tetrahedron, drawn in towards its middle, so that none touches another."""
    result = []
    for corners in ([nodes[n] for n in tetrahedron] for tetrahedron in tetrahedra):
        middle = [sum(corner[a] for corner in corners) / 4 for a in range(3)]
        result.append([[middle[a] + scale * (corner[a] - middle[a]) for a in range(3)] for corner in corners])
    return result


def write_msh(path, nodes, tetrahedra):
    """Gmsh's format 4.1, one volume."""
    low, high = ([f(node[a] for node in nodes) for a in range(3)] for f in (min, max))
    with open(path, "w") as out:
        out.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 " + " ".join(f"{x:.9g}" for x in low + high) + " 0 0\n$EndEntities\n")
        out.write(f"$Nodes\n1 {len(nodes)} 1 {len(nodes)}\n3 1 0 {len(nodes)}\n" + "".join(f"{n + 1}\n" for n in range(len(nodes))))
        out.write("".join(f"{x:.12g} {y:.12g} {z:.12g}\n" for x, y, z in nodes) + "$EndNodes\n")
        out.write(f"$Elements\n1 {len(tetrahedra)} 1 {len(tetrahedra)}\n3 1 4 {len(tetrahedra)}\n")
        out.write("".join(f"{e + 1} " + " ".join(str(n + 1) for n in element) + "\n" for e, element in enumerate(tetrahedra)) + "$EndElements\n")


def write_vtu(path, nodes, tetrahedra):
    """VTK's XML format, the numbers in binary behind it."""
    count, flat = len(tetrahedra), itertools.chain.from_iterable
    arrays = (("Points", "Points", "Float64", 3, array.array("d", flat(nodes))),
              ("Cells", "connectivity", "Int64", 1, array.array("q", flat(tetrahedra))),
              ("Cells", "offsets", "Int64", 1, array.array("q", range(4, 4 * count + 1, 4))),
              ("Cells", "types", "UInt8", 1, array.array("B", [10]) * count))
    head, data = {"Points": "", "Cells": ""}, b""
    for section, name, kind, components, values in arrays:
        head[section] += f'<DataArray Name="{name}" type="{kind}" NumberOfComponents="{components}" format="appended" '\
                         f'offset="{len(data)}"/>'
        data += array.array("Q", [len(values) * values.itemsize]).tobytes() + values.tobytes()
    sections = "".join(f"<{section}>{text}</{section}>" for section, text in head.items())
    text = '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"><UnstructuredGrid>'\
           f'<Piece NumberOfPoints="{len(nodes)}" NumberOfCells="{count}">{sections}</Piece></UnstructuredGrid>'\
           '<AppendedData encoding="raw">_'
    path.write_bytes(text.encode() + data + b"</AppendedData></VTKFile>")
