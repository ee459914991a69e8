"""`import scree`, against the command, against C++ and against what is known.

Usage: scree_test.py SOURCE_FOLDER CPP_EXAMPLE, with the module's folder in PYTHONPATH.
"""

import ast
import gc
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest

import numpy

import scree

SOURCE = pathlib.Path(sys.argv[1])
CPP_EXAMPLE = sys.argv[2]
SMALL_PILE = SOURCE / "scenes/small_pile.yaml"
# Four stones fall, and the floor heats them.
STONES = """
materials: {ore: {density: 2500, conductivity: 3, specific_heat: 880, friction: 0.5}}
bodies:
  plate: {box: {size: [1, 1, 0.1], centre: [0, 0, -0.05]}, material: ore, mesh_size: 0.3, fixed: true}
  stone:
    box: {size: [0.1, 0.1, 0.1]}
    lattice: {count: [2, 2, 1], spacing: [0.2, 0.2, 0.2], centre: [0, 0, 0.06]}
    material: ore
    mesh_size: 0.1
settle: {limit: 5 s}
heat:
  initial: 300
  boundaries: [{body: plate, temperature: 400}]
  until: 2 h
  tolerance: 0.1 K
output: {every: 30 min, probes: {top: {point: [0.1, 0.1, 0.09], reach: 2 cm}}}
"""
# A cube in a wind.
CUBE = """
materials: {steel: {density: 7800, conductivity: 45, specific_heat: 480}}
bodies: {cube: {box: {size: [0.1, 0.1, 0.1], centre: [0, 0, 0]}, material: steel, mesh_size: 0.05}}
heat:
  initial: 300
  blocks: {model: lumped}
  boundaries: [{body: cube, convection: {coefficient: 20, surroundings: 400}}]
  until: 600
output: {every: 600}
"""

# A wall between two temperatures, steady: linear.
WALL = """
dimension: 2
materials: {rock: {density: 2500, conductivity: 3, specific_heat: 880}}
bodies: {wall: {box: {size: [1, 0.2], centre: [0.5, 0]}, material: rock, mesh_size: 0.1}}
heat:
  initial: 300
  boundaries:
    - {body: wall, surface: x_low, temperature: 300}
    - {body: wall, surface: x_high, temperature: 400}
  steady: true
output: {probes: {}}
"""


class Scenes(unittest.TestCase):
    def test_a_scene_is_checked_like_any_other(self):
        with self.assertRaisesRegex(scree.InputError, r"scene:\d+:\d+: heat.tolerance is 3 m"):
            scree.Scene.from_text(STONES.replace("0.1 K", "3 m"))
        with self.assertRaisesRegex(ValueError, "Did you mean until"):
            scree.Scene.from_text(STONES, {"heat.untill": 60})

    def test_changes_take_numbers_lists_and_texts_with_units(self):
        base = scree.Scene.from_text(STONES)
        other = base.changed({"heat.until": "1 h", "bodies.plate.fixed": True, "settle.gravity": [0, 0, -1.6], "title": "moon"})
        self.assertIn("gravity: [0, 0, -1.6]", other.effective)
        self.assertEqual(other.title, "moon")
        self.assertEqual(base.title, "")
        self.assertEqual(base.changed(types.MappingProxyType({"title": "moon"})).title, "moon")
        self.assertNotIn("settle", base.changed({"settle": None}).effective)

    def test_changes_take_the_numbers_of_numpy_and_paths(self):
        base = scree.Scene.from_text(STONES)
        other = base.changed({"settle.iterations": numpy.int64(60), "heat.until": numpy.float32(1800),
                              "settle.gravity": numpy.array([0, 0, -1.5]), "bodies.plate.fixed": numpy.bool_(True)})
        self.assertIn("iterations: 60", other.effective)
        self.assertIn("gravity: [0.0, 0.0, -1.5]", other.effective)
        exact = base.changed({"heat.until": numpy.longdouble(1800), "settle.gravity": numpy.array([0, 0, -1.5], numpy.longdouble)})
        self.assertIn("until: 1800", exact.effective)
        with self.assertRaisesRegex(TypeError, "no place for a <class 'object'>"):
            base.changed({"heat.until": object()})
        with self.assertRaisesRegex(TypeError, "must be a text, not 1"):
            base.changed({1: 2})
        with self.assertRaisesRegex(scree.InputError, "packing is .*none.h5"):
            base.changed({"settle": None, "packing": pathlib.Path("none.h5")})

    def test_a_text_stays_the_text_that_it_is(self):
        for text in ("a: b", "yes", "1e3", "[1, 2]", "null", "Haufen \u03bb \U0001f600", "say \"no\""):
            self.assertEqual(scree.Scene.from_text(STONES, {"title": text}).title, text)

    def test_it_is_read_again_where_it_was_when_the_program_has_gone_elsewhere(self):
        start = os.getcwd()
        table = STONES.replace("temperature: 400", "temperature: {table: oven.csv}")
        try:
            with tempfile.TemporaryDirectory() as folder:
                os.chdir(folder)
                pathlib.Path("s.yaml").write_text(table)
                pathlib.Path("oven.csv").write_text("time [h],temperature [K]\n0,300\n9,400\n")
                bases = [scree.Scene("s.yaml"), scree.Scene.from_text(table)]
                os.chdir(start)
                for base in bases:
                    self.assertEqual(base.changed({"title": "elsewhere"}).title, "elsewhere")
        finally:
            os.chdir(start)

    def test_it_says_what_is_in_it(self):
        scene = scree.Scene(SMALL_PILE)
        self.assertEqual((scene.dimension, scene.bodies, scene.probes), (3, ["plate", "cube"], ["inside"]))


class Packings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = scree.Scene.from_text(STONES)
        cls.packing = scree.settle(cls.scene)

    def test_several_threads_settle_as_one_does(self):
        hashes = {}

        def settle(number):
            hashes[number] = scree.settle(self.scene).nodes.tobytes()

        threads = [threading.Thread(target=settle, args=(number,)) for number in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(hashes, {number: self.packing.nodes.tobytes() for number in range(3)})

    def test_the_stones_lie_on_the_floor(self):
        self.assertTrue(self.packing.report["at_rest"])
        self.assertEqual(self.packing.block_count, 5)
        of_stones = numpy.unique(self.packing.elements[self.packing.element_blocks > 0])
        z = self.packing.nodes[of_stones, 2]
        self.assertAlmostEqual(z.min(), 0, delta=1e-4)
        self.assertAlmostEqual(z.max(), self.packing.report["top"], delta=1e-12)

    def test_elements_fill_the_volume_of_the_shapes(self):
        corners = self.packing.nodes[self.packing.elements]
        volumes = numpy.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
        self.assertTrue((volumes > 0).all())
        self.assertAlmostEqual(volumes.sum(), 0.1 + 4 * 0.001, delta=1e-12)

    def test_arrays_look_into_the_same_memory_and_keep_it_alive(self):
        self.assertTrue(numpy.shares_memory(self.packing.nodes, self.packing.nodes))
        self.assertFalse(self.packing.nodes.flags.owndata)
        with self.assertRaises(ValueError):
            self.packing.nodes[0, 0] = 1
        nodes = scree.settle(self.scene.changed({"settle": None})).nodes
        before = nodes.copy()
        gc.collect()
        scree.settle(self.scene.changed({"settle": None}))
        self.assertTrue((nodes == before).all())

    def test_one_that_still_moves_is_an_error_that_holds_it(self):
        short = {"settle.limit": "0.25 s", "settle.rest_speed": "1e-9 m/s"}
        with self.assertRaisesRegex(scree.NotSettled, "still moving at 0.25 s") as raised:
            scree.settle(self.scene.changed(short))
        self.assertIsInstance(raised.exception, scree.RunError)
        self.assertFalse(raised.exception.packing.report["at_rest"])
        accepted = scree.settle(self.scene.changed({**short, "settle.accept_moving": True}))
        self.assertTrue((accepted.nodes == raised.exception.packing.nodes).all())

    def test_it_comes_back_from_its_file_to_the_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            self.packing.save(f"{folder}/p.h5")
            self.assertTrue((scree.load_packing(f"{folder}/p.h5").nodes == self.packing.nodes).all())
            with self.assertRaises(scree.InputError):
                scree.load_packing(f"{folder}/none.h5")


class Heatings(unittest.TestCase):
    def test_the_run_in_memory_is_the_run_of_the_command(self):
        scene = scree.Scene.from_text(STONES)
        with tempfile.TemporaryDirectory() as folder:
            summary = scree.run(scene, folder)
            self.assertEqual(summary["status"], "complete")
            table = numpy.loadtxt(f"{folder}/probes.csv", delimiter=",", comments="#", skiprows=0, dtype=str)
            packing = scree.load_packing(f"{folder}/packing.h5")
        settled = scree.settle(scene)
        self.assertTrue((settled.nodes == packing.nodes).all())
        heating = scree.Heating(scene, settled)
        history = heating.follow()
        rows = table[1:].astype(float)
        numpy.testing.assert_allclose(history["time"], rows[:, 0], rtol=1e-9)
        numpy.testing.assert_allclose(history["top"], rows[:, 1], rtol=1e-9)
        self.assertEqual(history["top"][-1], heating.probes["top"])
        self.assertEqual(summary["heat"]["probes"]["top"]["temperature"], heating.probes["top"])
        self.assertLess(heating.ledger_residual, 1e-10)
        self.assertLess(heating.time_error, 0.1)

    def test_a_lumped_block_has_one_temperature_at_all_its_nodes(self):
        scene = scree.Scene.from_text(CUBE)
        packing = scree.settle(scene)
        heating = scree.Heating(scene, packing)
        heating.advance_to(600)
        exact = 400 - 100 * math.exp(-600 * 6 * 20 / (7800 * 480 * 0.1))
        numpy.testing.assert_allclose(heating.temperature, numpy.full(len(packing.nodes), exact), atol=0.1)
        self.assertEqual(numpy.ptp(heating.temperature), 0)
        self.assertGreater(heating.lumping_error, 0)

    def test_a_steady_wall_is_linear(self):
        scene = scree.Scene.from_text(WALL)
        packing = scree.settle(scene)
        heating = scree.Heating(scene, packing)
        numpy.testing.assert_allclose(heating.temperature, 300 + 100 * packing.nodes[:, 0], rtol=1e-12)
        self.assertIsNone(packing.report)
        with self.assertRaisesRegex(scree.InputError, "steady"):
            heating.advance_to(1)

    def test_a_temperature_that_was_kept_stays_and_time_goes_on(self):
        scene = scree.Scene.from_text(STONES)
        heating = scree.Heating(scene, scree.settle(scene))
        heating.advance_to(600)
        early = heating.temperature
        self.assertTrue(numpy.shares_memory(early, heating.temperature))
        before = early.copy()
        heating.advance_to(3600)
        self.assertTrue((early == before).all())
        self.assertGreater(heating.temperature.mean(), early.mean())
        self.assertEqual(heating.time, 3600)
        with self.assertRaisesRegex(scree.InputError, "must be at least 3600 s"):
            heating.advance_to(60)
        with self.assertRaisesRegex(ValueError, "must be a number"):
            heating.advance_to(math.inf)

    def test_threads_take_turns_with_one_heating(self):
        scene = scree.Scene.from_text(STONES)
        packing = scree.settle(scene)
        alone, shared = scree.Heating(scene, packing), scree.Heating(scene, packing)
        alone.advance_to(3600)
        seen = []
        reader = threading.Thread(target=lambda: seen.extend(shared.temperature.copy() for _ in range(50)))
        worker = threading.Thread(target=lambda: shared.advance_to(3600))
        for thread in (worker, reader):
            thread.start()
        for thread in (worker, reader):
            thread.join()
        self.assertEqual(len(seen), 50)
        self.assertTrue((shared.temperature == alone.temperature).all())

    def test_heat_that_crosses_contacts_is_the_heat_the_stones_take_up(self):
        scene = scree.Scene.from_text(STONES, {"heat.tolerance": "1 mK"})
        packing = scree.settle(scene)
        heating = scree.Heating(scene, packing)
        contacts = heating.contacts
        self.assertTrue((contacts["owner"] != contacts["target"]).all())
        self.assertTrue((contacts["area"] > 0).all())
        self.assertLess(numpy.abs(contacts["point"][:, 2]).max(), 0.11)
        self.assertTrue(numpy.shares_memory(contacts["area"], heating.contacts["area"]))

        def into_stones():
            sign = numpy.where(contacts["target"] > 0, 1, 0) - numpy.where(contacts["owner"] > 0, 1, 0)
            return (sign * heating.contact_flows).sum()

        def stored():
            corners = packing.nodes[packing.elements]
            volumes = numpy.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
            stones = packing.element_blocks > 0
            return 2500 * 880 * (volumes * heating.temperature[packing.elements].mean(axis=1))[stones].sum()

        heating.advance_to(1800)
        heat, flow = stored(), into_stones()
        heating.advance_to(1810)
        # The trapezoidal rule over ten seconds.
        self.assertAlmostEqual((stored() - heat) / (5 * (flow + into_stones())), 1, delta=1e-3)

    def test_a_run_that_is_refused_leaves_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = scree.Scene.from_text(STONES, {"heat.boundaries": [{"body": "plate", "surface": "nope", "temperature": 400}]})
            with self.assertRaisesRegex(scree.InputError, "must be a surface of body plate"):
                scree.run(scene, f"{folder}/out")
            self.assertEqual(os.listdir(folder), [])

    def test_the_packing_of_another_scene_is_refused(self):
        base = scree.Scene.from_text(STONES)
        packing = scree.settle(base)
        scree.Heating(base.changed({"materials.ore.conductivity": 9, "heat.until": "1 h"}), packing)
        for change in [{"bodies.stone.mesh_size": 0.05}, {"settle.seed": 1}, {"materials.ore.density": 2600}]:
            with self.assertRaisesRegex(scree.InputError, "packing is of another scene"):
                scree.Heating(base.changed(change), packing)
        with tempfile.TemporaryDirectory() as folder:
            packing.save(f"{folder}/p.h5")
            loaded = scree.load_packing(f"{folder}/p.h5")
        with self.assertRaisesRegex(scree.InputError, r"bodies.stone.mesh_size is 0.05 m \(must be as in the packing: 0.1 m"):
            scree.Heating(base.changed({"bodies.stone.mesh_size": 0.05}), loaded)
        with self.assertRaisesRegex(scree.InputError, "its body 2 is called stone, the scene's pebble"):
            scree.Heating(scree.Scene.from_text(STONES.replace("stone:", "pebble:")), loaded)

    def test_a_packing_from_a_file_takes_the_materials_of_the_scene(self):
        metal = STONES.replace("materials: {", "materials: {metal: {density: 2500, conductivity: 300, specific_heat: 1, "
                                               "friction: 0.5}, ")
        scene = scree.Scene.from_text(metal.replace("material: ore\n    mesh", "material: metal\n    mesh"))
        other = scree.settle(scree.Scene.from_text(STONES))
        with tempfile.TemporaryDirectory() as folder:
            other.save(f"{folder}/p.h5")
            loaded = scree.load_packing(f"{folder}/p.h5")
        heating = scree.Heating(scene, loaded)
        heating.advance_to(60)
        slower = scree.Heating(scree.Scene.from_text(STONES), other)
        slower.advance_to(60)
        self.assertGreater(heating.probes["top"], slower.probes["top"] + 10)

    def test_another_dimension_is_refused(self):
        with self.assertRaisesRegex(ValueError, "dimension"):
            scree.Heating(scree.Scene.from_text(WALL), scree.settle(scree.Scene.from_text(STONES, {"settle": None})))


class Module(unittest.TestCase):
    def test_the_stub_names_what_there_is(self):
        def names(nodes):
            found = {}
            for node in nodes:
                if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and (not node.name.startswith("_") or node.name == "__init__"):
                    found[node.name] = names(node.body) if isinstance(node, ast.ClassDef) else {}
            return found

        def real(thing):
            return {name for name in vars(thing) if not name.startswith("_") or name == "__init__"}

        stub = names(ast.parse((SOURCE / "tools/python/scree.pyi").read_text(encoding="utf-8")).body)
        self.assertEqual(set(stub), real(scree))
        for name in ["Scene", "Packing", "Heating"]:
            self.assertEqual(set(stub[name]) - {"__init__"}, real(getattr(scree, name)) - {"__init__"}, name)

    def test_a_number_of_threads_that_cannot_be_is_refused(self):
        for count in (0, -1, 10**6):
            with self.assertRaisesRegex(ValueError, "1 to 1024"):
                scree.use_threads(count)

    def test_a_process_made_by_fork_heats_like_its_parent(self):
        scene = scree.Scene.from_text(STONES)
        packing = scree.settle(scene)
        heating = scree.Heating(scene, packing)
        heating.advance_to(3600)
        with tempfile.NamedTemporaryFile(suffix=".npy") as file:
            child = os.fork()
            if child == 0:
                forked = scree.Heating(scene, packing)
                forked.advance_to(3600)
                numpy.save(file.name, forked.temperature)
                os._exit(0)
            ended = 0
            for _ in range(600):
                ended, status = os.waitpid(child, os.WNOHANG)
                if ended:
                    break
                time.sleep(0.1)
            if not ended:
                os.kill(child, signal.SIGKILL)
                os.waitpid(child, 0)
            self.assertTrue(ended, "it hung")
            self.assertEqual(status, 0)
            self.assertTrue((numpy.load(file.name) == heating.temperature).all())

    def test_everything_has_a_docstring(self):
        for name in ["Scene", "Packing", "Heating"]:
            for member in vars(getattr(scree, name)):
                if not member.startswith("_"):
                    self.assertTrue(getattr(getattr(scree, name), member).__doc__, f"{name}.{member}")

    def test_the_examples_in_python_and_cpp_say_the_same(self):
        def says(*command):
            text = subprocess.run([*command, str(SMALL_PILE)], check=True, text=True, capture_output=True).stdout
            return re.findall(r"(\d+) blocks, ([\d.]+) m|beta +(\d+): +([\d.]+) degC inside after 1 h, (\d+) kJ", text)

        in_python = says(sys.executable, str(SOURCE / "tools/python/settle_once_heat_many.py"))
        self.assertEqual(len(in_python), 4, in_python)
        self.assertEqual(in_python, says(CPP_EXAMPLE))
        heats = [float(line[3]) for line in in_python[1:]]
        self.assertLess(heats[0], heats[1])
        self.assertLess(heats[1], heats[2])


unittest.main(argv=sys.argv[:1])
