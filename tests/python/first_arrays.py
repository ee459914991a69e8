"""Threads that make their first arrays at once do not wait for each other: the module must not find numpy imported here."""

from concurrent.futures import ThreadPoolExecutor

import scree

BAR = """
materials: {ore: {density: 2500, conductivity: 3, specific_heat: 880}}
bodies: {bar: {box: {size: [0.1, 0.1, 0.4], centre: [0, 0, 0]}, material: ore, mesh_size: 0.05}}
heat:
  initial: 300
  boundaries: [{body: bar, surface: z_low, temperature: 400}]
  until: 2 h
output: {every: 30 min, probes: {top: [0, 0, 0.2]}}
"""

scene = scree.Scene.from_text(BAR)
packing = scree.settle(scene)


def top(conductivity: float) -> float:
    changed = scene.changed({"materials.ore.conductivity": conductivity})
    return scree.Heating(changed, packing).follow()["top"][-1]


with ThreadPoolExecutor(3) as pool:
    temperatures = list(pool.map(top, [1, 2, 3]))
assert temperatures == sorted(set(temperatures)), "the better it conducts, the warmer the top"
