"""Tetrahedra that fall onto a plane in YADE: yade settling_yade.py STONES.json YOUNG STEP STEPS; writes yade.json into the working folder.

Polyhedra with the volumetric law, friction 0.6, local damping 0.3.
"""
import json
import math
import sys
import time

from yade import polyhedra_utils

stones, young, step, steps = sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
rock = PolyhedraMat(density=2500, young=young, poisson=0.2, frictionAngle=math.atan(0.6))
O.materials.append(rock)
with open(stones) as file:
    blocks = [polyhedra_utils.polyhedra(rock, v=[Vector3(*corner) for corner in corners]) for corners in json.load(file)]
O.bodies.append(blocks)
O.bodies.append(utils.wall(0, axis=2, material=rock))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom(), Ig2_Wall_Polyhedra_PolyhedraGeom()],
                    [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()], [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81)),
]
O.dt = step
wall, processor = time.perf_counter(), time.process_time()
O.run(steps, True)
wall, processor = time.perf_counter() - wall, time.process_time() - processor
placed = [[list(block.state.pos + block.state.ori * corner) for corner in block.shape.v] for block in blocks]
with open("yade.json", "w") as file:
    json.dump({"wall": wall, "processor": processor, "blocks": placed}, file)
