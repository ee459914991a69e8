"""The checks beside this one find what they are for, and accept what is right."""

import unittest

import check_layers
import check_text

WRAPPED = {
    "engine/base/ids.h": "#include <vector>",
    "engine/rigid/world.h": "#include <btBulletDynamicsCommon.h>",
    "engine/rigid/settle.h": '#include "engine/base/ids.h"',
    "engine/rigid/settle.cpp": '#include "engine/rigid/settle.h"\n#include "engine/rigid/world.h"',
    "tests/rigid/world_test.cpp": '#include "engine/rigid/world.h"',
}


class Layers(unittest.TestCase):
    def breaches(self, **changes):
        return check_layers.check(WRAPPED | {path.replace("__", "/") + ".h": text for path, text in changes.items()})

    def test_accept_includes_that_point_down(self):
        self.assertEqual(self.breaches(contact__a='#include "engine/rigid/settle.h"'), [])

    def test_find_an_include_that_points_up(self):
        found = self.breaches(engine__base__a='#include "engine/rigid/settle.h"')
        self.assertIn("engine/base must not include engine/rigid", found[0])

    def test_find_an_include_between_neighbours(self):
        found = self.breaches(engine__output__a='  # include "engine/rigid/settle.h"  // why not')
        self.assertIn("engine/output must not include engine/rigid", found[0])

    def test_find_a_path_that_does_not_start_at_the_root(self):
        self.assertIn('"ids.h" is no file', self.breaches(engine__base__a='#include "ids.h"')[0])

    def test_find_a_foreign_header_outside_its_room(self):
        self.assertIn("VTK is for engine/output alone", self.breaches(tools__a="#include <vtkCell.h>")[0])

    def test_find_a_foreign_header_behind_a_public_one(self):
        found = self.breaches(contact__a='#include "engine/rigid/world.h"')
        self.assertIn("engine/rigid/world.h -> btBulletDynamicsCommon.h", found[0])

    def test_find_a_file_in_no_room(self):
        self.assertIn("belongs to no room", self.breaches(extra__a="")[0])


class Text(unittest.TestCase):
    def test_accept_what_is_short_and_speaks_of_the_repository(self):
        text = "see ../work/notes, https://example.org/home/, build/tmp and out/pile\n"
        self.assertEqual(check_text.check({"a.md": text, "b.cpp": "\n" * 400}), [])

    def test_find_a_long_source_but_not_a_long_table(self):
        found = check_text.check({"a.cpp": "\n" * 401, "tools/run": "\n" * 401, "a.txt": "\n" * 401})
        self.assertEqual([breach.split(":")[0] for breach in found], ["a.cpp", "tools/run"])

    def test_find_a_place_on_one_machine(self):
        for place in ("home/me/a.stl", "work/main", "root/x"):
            self.assertIn("a.md:2:", check_text.check({"a.md": f"one\n`/{place}`\n"})[0])


if __name__ == "__main__":
    unittest.main()
