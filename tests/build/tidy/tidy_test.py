"""clang-tidy is alive: a file with one violation of each family is refused for each of them."""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
CLANG_TIDY = shutil.which("clang-tidy-14")
SKIP_STATUS = 77

SEEDED = [
    "bugprone-integer-division", "bugprone-use-after-move", "cppcoreguidelines-no-malloc",
    "cppcoreguidelines-pro-type-member-init", "modernize-use-nullptr",
    "performance-unnecessary-value-param", "readability-identifier-naming",
]


def tidy(text):
    """Status and output of clang-tidy with the project's settings on this text."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "seeded.cpp"
        path.write_text(text)
        done = subprocess.run(
            [CLANG_TIDY, "--quiet", f"--config-file={SOURCE / '.clang-tidy'}", path, "--", "-std=c++20"],
            capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


class Tidy(unittest.TestCase):
    def test_each_family_refuses_its_seeded_violation(self):
        status, said = tidy((SOURCE / "tests/build/tidy/seeded.txt").read_text())
        self.assertNotEqual(status, 0)
        for check in SEEDED:
            with self.subTest(check):
                self.assertIn(f"[{check},-warnings-as-errors]", said)

    def test_every_family_of_the_settings_is_seeded(self):
        settings = (SOURCE / ".clang-tidy").read_text()
        checks = settings.split("Checks:")[1].split("WarningsAsErrors")[0].split(",")
        families = {name.strip().split("-")[0] for name in checks
                    if name.strip()[:1].isalpha()} - {">"}
        self.assertEqual({name.split("-")[0] for name in SEEDED}, families)

    def test_a_digest_changes_with_the_text_and_its_exceptions_and_with_nothing_else(self):
        script = importlib.util.spec_from_file_location("tidy_script", SOURCE / "scripts/tidy.py")
        module = importlib.util.module_from_spec(script)
        script.loader.exec_module(module)
        with tempfile.TemporaryDirectory() as folder:
            module.ROOT = Path(folder)
            source = Path(folder) / "seeded.cpp"
            command = ["clang++-14", "-std=c++20", "-Wall", "-Werror", "-c", str(source),
                       "-o", "seeded.o"]
            digests = []
            for text in ["int a;", "int a;", "int b;", "int b;  // NOLINT"]:
                source.write_text(text + "\n")
                digests.append(module.digest(source, command, folder, b"settings"))
        self.assertNotIn(None, digests)
        self.assertEqual(digests[0], digests[1])
        self.assertEqual(len(set(digests)), 3)

    def test_a_clean_file_is_accepted(self):
        status, said = tidy("namespace clean {\nint Twice(int count) { return 2 * count; }\n}\n")
        self.assertEqual(status, 0, said)


if __name__ == "__main__":
    if CLANG_TIDY is None:
        print("clang-tidy-14 is not installed (packages-ci.txt); nothing was checked")
        sys.exit(SKIP_STATUS)
    unittest.main()
