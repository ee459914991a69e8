"""Two slabs with a joint between them, heated from below: the exact temperatures at the compared places and times."""
import math

SIDE = 0.2  # of both cubes [m]
CONDUCTIVITY, CAPACITY = (3.1, 10.0), 2500.0 * 880.0  # of the lower and the upper one [W/m/K], of both [J/m3/K]
CONDUCTANCE = 20.0  # of the joint [W/m2/K]
START, BOTTOM = 25.0, 100.0
HEIGHTS = (0.05, 0.1, 0.15, 0.1999, 0.2001, 0.25, 0.3, 0.4)  # on the vertical centre line [m]
TIMES = (3600.0, 43200.0)  # [s]
MODES = 60


class Mode:
    """sin(p z) in the lower slab and `upper` cos(q (2 SIDE - z)) in the upper one, decaying with the square of `rate`."""

    def __init__(self, rate):
        self.rate = rate
        self.p, self.q = (rate * math.sqrt(CAPACITY / k) for k in CONDUCTIVITY)
        p, q = self.p, self.q
        # Heat enters the upper slab as it leaves the lower one, or, where a mode has next to none there, by the jump.
        jump = math.sin(p * SIDE) + CONDUCTIVITY[0] * p * math.cos(p * SIDE) / CONDUCTANCE
        flux = CONDUCTIVITY[0] * p * math.cos(p * SIDE) / (CONDUCTIVITY[1] * q)
        self.upper = jump / math.cos(q * SIDE) if abs(math.cos(q * SIDE)) > 0.5 else flux / math.sin(q * SIDE)
        self.whole = (1 - math.cos(p * SIDE)) / p + self.upper * math.sin(q * SIDE) / q
        square = SIDE / 2 - math.sin(2 * p * SIDE) / (4 * p) + self.upper**2 * (SIDE / 2 + math.sin(2 * q * SIDE) / (4 * q))
        self.part = self.whole / square  # of a field of one

    def at(self, z):
        return math.sin(self.p * z) if z < SIDE else self.upper * math.cos(self.q * (2 * SIDE - z))


def mismatch(rate):
    """Zero for a mode: the heat that the joint passes is the heat that leaves the lower slab, free of poles."""
    p, q = (rate * math.sqrt(CAPACITY / k) for k in CONDUCTIVITY)
    leaving, entering = CONDUCTIVITY[0] * p * math.cos(p * SIDE), CONDUCTIVITY[1] * q * math.sin(q * SIDE)
    return leaving * entering + CONDUCTANCE * (math.sin(p * SIDE) * entering - leaving * math.cos(q * SIDE))


def modes():
    """The slowest, each bracketed by a change of sign and bisected. That none is left out shows in the sum of their parts."""
    found, low, step = [], 1e-9, 2e-6
    while len(found) < MODES:
        high = low + step
        if mismatch(low) * mismatch(high) < 0:
            found.append(Mode(bisected(low, high)))
        low = high
    missing = 1 - sum(mode.part * mode.whole for mode in found) / (2 * SIDE)
    assert 0 < missing < 0.01, f"modes are missing: {missing}"
    return found


def bisected(low, high):
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if mismatch(low) * mismatch(middle) > 0 else (low, middle)
    return low


def exact():
    """Temperatures by time and height [deg C]."""
    found = modes()
    return {t: {z: BOTTOM + (START - BOTTOM) * sum(mode.part * mode.at(z) * math.exp(-mode.rate**2 * t) for mode in found) for z in HEIGHTS}
            for t in TIMES}
