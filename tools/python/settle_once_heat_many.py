"""Settles a small pile once and heats it with joints of several conductances.

Usage: settle_once_heat_many.py SCENE, such as scenes/small_pile.yaml
"""

import sys

import numpy

import scree


def main():
    base = scree.Scene(sys.argv[1], {"heat.until": "1 h"})
    packing = scree.settle(base)
    print(f"{packing.block_count} blocks, {packing.report['top']:.3f} m high")

    for beta in [1, 10, 100]:
        heating = scree.Heating(base.changed({"contact.stiffness_factor": beta}), packing)
        history = heating.follow()
        # The contact through which most heat flows, of arrays that look into the heating's own memory.
        flows = numpy.abs(heating.contact_flows)
        busiest = heating.contacts["point"][flows.argmax()]
        print(f"beta {beta:4}: {history['inside'][-1] - 273.15:5.1f} degC inside after {history['time'][-1] / 3600:g} h, "
              f"{heating.heat_stored / 1e3:.0f} kJ stored, most heat at {numpy.round(busiest, 3)}, "
              f"time error {heating.time_error:.2g} K")


main()
