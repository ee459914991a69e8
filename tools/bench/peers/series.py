"""The exact temperatures of the heated cube at the compared places and times (the images of a hot bottom)."""
import math

HEIGHTS = (0.1, 0.2, 0.3, 0.5, 0.7, 0.9)  # on the vertical centre line [m]
TIMES = (4320.0, 43200.0)  # [s]
CONDUCTIVITY, DENSITY, HEAT = 3.1, 2500.0, 880.0
START, BOTTOM = 25.0, 100.0


def exact(z, t):
    s = 2 * math.sqrt(CONDUCTIVITY / (DENSITY * HEAT) * t)
    rise = sum((-1) ** k * (math.erfc((2 * k + z) / s) + math.erfc((2 * k + 2 - z) / s)) for k in range(6))
    return START + (BOTTOM - START) * rise


def errors(values):
    """Largest difference at each of TIMES; `values[t][z]` in degrees C."""
    return [max(abs(values[t][z] - exact(z, t)) for z in HEIGHTS) for t in TIMES]
