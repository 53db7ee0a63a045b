"""An upward use, and a sideways one that nobody declared, stop the configuration.

Each case writes a project of a few empty libraries, includes the real cmake/Layers.cmake, and
configures it. The environment names CMAKE and LEVITAS_SOURCE.
"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
CMAKE = os.environ.get("CMAKE", "cmake")

# name -> (folder, layer, uses)
BASE = {
    "law": ("controller/law", 1, ""),
    "magnet": ("plant_sim/magnet", 1, ""),
    "port_lcm": ("transport", 4, ""),
    "words": ("common", 0, ""),
}


def configure(libraries, files, last=""):
    """Status and output of configuring a project with these libraries and files (path -> text)."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        lines = ["cmake_minimum_required(VERSION 3.25)", "project(seeded LANGUAGES NONE)",
                 f'include("{SOURCE}/cmake/Layers.cmake")']
        for name, (where, layer, uses) in libraries.items():
            lines.append(f"levitas_library({name} LAYER {layer} FOLDER {where} {uses})")
        lines += [last, "levitas_check_layers()"]
        (root / "CMakeLists.txt").write_text("\n".join(lines) + "\n")
        for path, text in files.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text)
        done = subprocess.run([CMAKE, "-G", "Ninja", "-S", root, "-B", root / "build"],
                              capture_output=True, text=True, check=False)
        return done.returncode, " ".join((done.stdout + done.stderr).split())


class Layers(unittest.TestCase):
    def assert_refused(self, libraries, files, sentence, last=""):
        status, said = configure(libraries, files, last)
        self.assertNotEqual(status, 0, said)
        self.assertIn(sentence, said)

    def test_accept_downward_uses(self):
        status, said = configure(
            {**BASE, "port_lcm": ("transport", 4, "USES law words")},
            {"transport/port.hpp": '#include "controller/law/pid.hpp"\n',
             "controller/law/pid.hpp": '#include "common/axes.hpp"\n#include <vector>\n'})
        self.assertEqual(status, 0, said)

    def test_refuse_a_declared_upward_use(self):
        self.assert_refused({**BASE, "law": ("controller/law", 1, "USES port_lcm")}, {},
                            "law (layer 1) may not use port_lcm (layer 4)")

    def test_accept_a_sideways_use_that_is_declared_or_reached_through_one(self):
        libraries = {**BASE, "law": ("controller/law", 1, "USES magnet"),
                     "cycle": ("controller/cycle", 1, "USES law")}
        status, said = configure(libraries, {
            "controller/law/pid.hpp": '#include "plant_sim/magnet/force.hpp"\n',
            "controller/cycle/cycle.hpp": '#include "plant_sim/magnet/force.hpp"\n'})
        self.assertEqual(status, 0, said)

    def test_refuse_libraries_that_use_each_other(self):
        self.assert_refused({**BASE, "law": ("controller/law", 1, "USES magnet"),
                             "magnet": ("plant_sim/magnet", 1, "USES law")}, {},
                            "libraries that use each other: law -> magnet -> law")

    def test_refuse_what_is_kept_apart_although_it_is_declared(self):
        libraries = {**BASE, "gap": ("plant_sim/gap", 1, "USES magnet")}
        apart = "levitas_keep_apart(WALL law FROM magnet)"
        self.assertEqual(configure(libraries, {}, apart)[0], 0)
        self.assert_refused({**libraries, "law": ("controller/law", 1, "USES gap")}, {},
                            "law may not reach magnet: they are kept apart", apart)
        self.assert_refused({**libraries, "magnet": ("plant_sim/magnet", 1, "USES law")}, {},
                            "magnet may not reach law: they are kept apart", apart)

    def test_refuse_an_upward_include_and_name_the_file(self):
        self.assert_refused(
            BASE, {"controller/law/pid.cpp": '#include "transport/lcm_port.hpp"\n'},
            "law (layer 1) may not use port_lcm (layer 4): controller/law/pid.cpp has")

    def test_refuse_a_sideways_include(self):
        self.assert_refused(
            BASE, {"plant_sim/magnet/force.hpp": '#include "controller/law/pid.hpp"\n'},
            "magnet (layer 1) may not use law (layer 1)")

    def test_refuse_an_include_in_angle_brackets_and_with_spaces(self):
        self.assert_refused(
            BASE, {"controller/law/pid.hpp": "  #  include <transport/lcm_port.hpp>  // why\n"},
            "law (layer 1) may not use port_lcm (layer 4)")

    def test_refuse_an_include_from_a_subfolder_nobody_owns(self):
        self.assert_refused(
            BASE, {"controller/law/detail/deep.hpp": '#include "transport/lcm_port.hpp"\n'},
            "law (layer 1) may not use port_lcm (layer 4)")

    def test_refuse_an_include_across_a_wall_also_of_a_lower_layer(self):
        libraries = {**BASE, "cycle": ("controller/cycle", 3, "USES words")}
        files = {"controller/cycle/cycle.cpp": '#include "plant_sim/magnet/force.hpp"\n'}
        self.assertEqual(configure(libraries, files)[0], 0)
        self.assert_refused(libraries, files, "cycle may not use magnet: they are kept apart: "
                            "controller/cycle/cycle.cpp has",
                            "levitas_keep_apart(WALL cycle FROM magnet)")

    def test_refuse_a_library_without_a_layer_and_one_above_the_last(self):
        for layer in ("", 7):
            self.assert_refused({**BASE, "law": ("controller/law", layer, "")}, {},
                                f"levitas_library(law): LAYER '{layer}', allowed 0 to 5")

    def test_refuse_a_use_of_something_that_is_not_ours(self):
        self.assert_refused({**BASE, "law": ("controller/law", 1, "USES nothing_known")}, {},
                            "law uses nothing_known, which is not a library of this project")

    def test_refuse_a_misspelt_keyword(self):
        self.assert_refused({"law": ("controller/law", 1, "NEEDS words")}, {},
                            "levitas_library(law): unknown words NEEDS;words")


if __name__ == "__main__":
    unittest.main()
