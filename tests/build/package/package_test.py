"""The Debian package: what lies in it, and that it runs from where it was unpacked."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["LEVITAS_SOURCE"]) / "tests/support"))
import own_program  # noqa: E402
from own_program import run  # noqa: E402

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
BUILD = Path(os.environ["LEVITAS_BUILD"])
SKIP_STATUS = 77


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        made = run("cpack", "-G", "DEB", "-B", cls.folder / "made", cwd=BUILD)
        if made.returncode != 0:
            raise AssertionError(made.stdout + made.stderr)
        (cls.file,) = (cls.folder / "made").glob("*.deb")
        cls.root = cls.folder / "unpacked"
        subprocess.run(["dpkg-deb", "-x", cls.file, cls.root], check=True)

    def amb(self, *words):
        environment = {key: value for key, value in os.environ.items() if key != "LEVITAS_CONFIG"}
        done = run(self.root / "usr/bin/amb", *words, cwd=self.folder, env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def field(self, name):
        return run("dpkg-deb", "-f", self.file, name).stdout.strip()

    def test_names_the_libraries_it_is_linked_to(self):
        self.assertEqual(self.field("Package"), "levitas")
        for library in ("libfmt9", "libyaml-cpp0.7", "libgpiod2", "libsqlite3-0",
                        "libsodium23", "libzstd1"):
            self.assertIn(library, self.field("Depends"))

    def test_holds_programs_shipped_files_page_and_completion(self):
        usr = self.root / "usr"
        for name in ("amb", "amb-controller", "amb-plant", "amb-rig"):
            self.assertTrue(os.access(usr / "bin" / name, os.X_OK), name)
        for kind in ("rigs", "controllers", "scenarios"):
            self.assertEqual({path.name for path in (usr / "share/levitas" / kind).iterdir()},
                             {path.name for path in (SOURCE / "config" / kind).glob("*.yaml")})
        for name in ("share/doc/levitas/copyright", "share/doc/levitas/effects.md",
                     "share/levitas/lcmtypes/sensor_frame_t.lcm",
                     "share/levitas/python/levitas_msg/sensor_frame_t.py",
                     "share/bash-completion/completions/amb"):
            self.assertGreater((usr / name).stat().st_size, 0, name)
        for path in (usr / "bin").iterdir():
            page = (usr / f"share/man/man1/{path.name}.1").read_text(encoding="utf-8")
            self.assertIn(f".SH NAME\n{path.name} ".replace("-", "\\-"), page)
            self.assertIn(path.name, (usr / "share/bash-completion/completions" / path.name).read_text())

    def test_nothing_else_lies_in_it(self):
        usr = self.root / "usr"
        self.assertEqual({path.name for path in usr.iterdir()}, {"bin", "share", "include", "lib"})
        self.assertEqual({path.name for path in (usr / "include").iterdir()}, {"levitas"})
        self.assertEqual({str(path.relative_to(usr / "lib")) for path in (usr / "lib").rglob("*") if path.is_file()},
                         {"liblevitas.a", "cmake/Levitas/LevitasConfig.cmake",
                          "cmake/Levitas/LevitasConfigVersion.cmake"})
        self.assertEqual({path.suffix for path in (usr / "include").rglob("*") if path.is_file()}, {".hpp"})
        for name in ("amb", "amb-controller"):
            self.assertNotIn("debug_info", run("file", self.root / "usr/bin" / name).stdout)

    def test_finds_the_shipped_files_that_were_unpacked_with_it(self):
        rigs = self.root / "usr/share/levitas/rigs"
        shutil.copy(rigs / "ufu_rig.yaml", rigs / "only_here.yaml")
        self.addCleanup((rigs / "only_here.yaml").unlink)
        self.assertIn("Hz", self.amb("modes", "--rig", "only_here"))

    def test_an_example_is_built_from_it_alone_and_levitates(self):
        usr = self.root / "usr"
        built = self.folder / "example"
        own_program.build(usr / "share/levitas/examples/closed_loop", built, usr)
        read = run("ninja", "-C", built, "-t", "deps").stdout
        self.assertIn(str(usr / "include/levitas/controller/cycle/control_cycle.hpp"), read)
        self.assertNotIn(f"{SOURCE}/", read.replace(str(self.folder), ""))  # no header of the sources
        done = own_program.run_on(usr, built / "closed_loop")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"2\.0 s  levitating  orbit +[0-6]\.")  # objective: 7 um

    def test_levitates(self):
        self.amb("run", "--duration", "0.5", "--record", "run.lcm")
        self.assertIn("reproduced", self.amb("replay", "run.lcm"))


if __name__ == "__main__":
    if shutil.which("dpkg-shlibdeps") is None or shutil.which("file") is None:
        print("no dpkg-dev or file here (packages-deb.txt): no package was made")
        sys.exit(SKIP_STATUS)
    unittest.main()
