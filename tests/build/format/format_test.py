"""All C++ is formatted as .clang-format says, and a badly formatted file is noticed."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/build/files"))
import source_rules as rules  # noqa: E402

# Version 14 only: another version formats differently.
CLANG_FORMAT = shutil.which("clang-format-14")
SKIP_STATUS = 77


def badly_formatted(paths):
    """Names of the files that clang-format would change."""
    done = subprocess.run([CLANG_FORMAT, "--dry-run", "--Werror", *map(str, paths)],
                          capture_output=True, text=True, check=False, cwd=SOURCE)
    return sorted({line.split(":")[0] for line in done.stderr.splitlines() if ": error:" in line})


class Format(unittest.TestCase):
    def test_every_source_file_is_formatted(self):
        found = badly_formatted(rules.source_files(SOURCE, (".cpp", ".hpp")))
        found = [str(Path(name).relative_to(SOURCE)) for name in found if name.startswith("/")]
        self.assertFalse(found, "\nrun: clang-format-14 -i " + " ".join(found))

    def test_a_badly_formatted_file_is_noticed(self):
        # Inside the repository, so that its .clang-format is the one found.
        with tempfile.TemporaryDirectory(dir=SOURCE / "build") as folder:
            seeded = Path(folder) / "seeded.cpp"
            seeded.write_text("int  main( ){return 0 ;}\n")
            self.assertEqual(badly_formatted([seeded]), [str(seeded)])
            seeded.write_text("int* Pointer(int* left) { return left; }\n")
            self.assertEqual(badly_formatted([seeded]), [])


if __name__ == "__main__":
    if CLANG_FORMAT is None:
        print("clang-format-14 is not installed (packages-ci.txt); nothing was checked")
        sys.exit(SKIP_STATUS)
    unittest.main()
