"""How deep tetrahedra are in each other, by separating axes: what Scree states of its packings, for those of another program."""
import itertools
import math

EDGES = tuple(itertools.combinations(range(4), 2))


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def directions(one, other):
    """Those along which two tetrahedra can be apart: normals of faces, and what two edges are both normal to."""
    for body in (one, other):
        for a, b, c in itertools.combinations(body, 3):
            yield cross(minus(b, a), minus(c, a))
    for i, j in EDGES:
        along = minus(one[j], one[i])
        for k, l in EDGES:
            yield cross(along, minus(other[l], other[k]))


def depth(one, other):
    """The least translation that would part them; negative where they are apart already [m]."""
    least = math.inf
    for x, y, z in directions(one, other):
        length = math.sqrt(x * x + y * y + z * z)
        if length < 1e-9:
            continue
        first, second = ([x * p[0] + y * p[1] + z * p[2] for p in body] for body in (one, other))
        least = min(least, min(max(first) - min(second), max(second) - min(first)) / length)
    return least


def near(bodies, distance):
    """Pairs whose boxes are not farther apart."""
    boxes = sorted(([min(axis) for axis in zip(*body)], [max(axis) for axis in zip(*body)], body) for body in bodies)
    for n, (low, high, body) in enumerate(boxes):
        for other_low, other_high, other in boxes[n + 1:]:
            if other_low[0] > high[0] + distance:
                break
            if all(other_low[a] <= high[a] + distance and low[a] <= other_high[a] + distance for a in (1, 2)):
                yield body, other


def measure(bodies, distance):
    """The largest depth, the mean over the pairs that touch, and their number: pairs and bodies on the plane z = 0 no farther apart."""
    depths = [d for d in (depth(*pair) for pair in near(bodies, distance)) if d > -distance]
    depths += [-low for low in (min(corner[2] for corner in body) for body in bodies) if low < distance]
    return max(depths), sum(max(d, 0) for d in depths) / len(depths), len(depths)
