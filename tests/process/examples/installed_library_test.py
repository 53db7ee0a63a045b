"""The installed library in a program whose author chose other switches than ours."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import own_program  # noqa: E402

CONSUMER = Path(__file__).resolve().parent / "consumer"
ARCHIVE = own_program.BUILD / "lib/liblevitas.a"
# Nearly ours; and everything that makes copies of inline functions differ: no optimisation, assertions,
# vectors of this processor (Eigen aligns and allocates otherwise with AVX), contracted arithmetic. Linked
# to the plain libraries of the build, the second ends with a double free on a processor with AVX.
SWITCHES = {"near": "-O1 -DNDEBUG", "far": "-O0 -D_GLIBCXX_ASSERTIONS -march=native -ffp-contract=fast"}


def symbols():
    lines = own_program.must("nm", "--defined-only", "--format=posix", ARCHIVE).splitlines()
    return [tuple(line.split()[:2]) for line in lines if len(line.split()) > 1]


class InstalledLibrary(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.prefix = cls.folder / "usr"
        own_program.install(cls.prefix)
        cls.headers = sorted((cls.prefix / "include/levitas").rglob("*.hpp"))
        names = [path.relative_to(cls.prefix / "include/levitas") for path in cls.headers]
        includes = "".join(f'#include "{name}"\n' for name in reversed(names))
        (cls.prefix / "include/levitas/all_headers.hpp").write_text(includes, encoding="utf-8")

    def test_gives_the_same_bits_whatever_the_program_is_compiled_with(self):
        said = {}
        for name, flags in SWITCHES.items():
            own_program.build(CONSUMER, self.folder / name, self.prefix, flags)
            done = own_program.run(self.folder / name / "consumer", cwd=self.folder,
                                   env={"LEVITAS_CONFIG": str(own_program.SOURCE / "config")})
            self.assertEqual(done.returncode, 0, name + done.stdout + done.stderr)
            said[name] = done.stdout
        self.assertTrue(said["near"].startswith("levitating 10 stands\n"), said["near"])
        self.assertEqual(said["near"], said["far"])

    def test_shares_no_inline_function_and_no_object_with_the_program(self):
        shared = [name for name, kind in symbols() if kind in "WVu"]
        tables = [name for name in shared if re.match(r"_ZT[VIS]N7levitas", name)]
        renamed = [name for name in shared if name.startswith("levitas_own")]
        self.assertEqual(sorted(tables + renamed), sorted(shared))
        self.assertTrue(tables)

    def test_defines_nothing_outside_its_namespace(self):
        strong = [name for name, kind in symbols() if kind in "TDBR"]
        self.assertTrue(strong)
        self.assertEqual([name for name in strong if "7levitas" not in name], [])

    def test_its_headers_need_nothing_but_the_standard_library(self):
        found = set()
        for path in self.headers:
            found |= set(re.findall(r"^#include <(\w+)/", path.read_text(encoding="utf-8"), re.M))
        self.assertEqual(found, set())
        self.assertLess(len(self.headers), 100)  # a surface, not the source

    def test_another_version_is_refused(self):
        (self.folder / "asks").mkdir()
        (self.folder / "asks/CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES CXX)\n"
            "find_package(Levitas 0.1 REQUIRED)\n", encoding="utf-8")
        done = subprocess.run([own_program.CMAKE, "-S", self.folder / "asks", "-B", self.folder / "asked",
                               f"-DCMAKE_PREFIX_PATH={self.prefix}"], capture_output=True, text=True,
                              check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("compatible", done.stderr)


if __name__ == "__main__":
    unittest.main()
