"""The chapter on layers of docs/architecture.md names every library on its layer, and nothing else."""

import os
import re
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])


def declared():
    """name -> layer, of every levitas_library, levitas_program and levitas_lcm_types."""
    found = {}
    for path in SOURCE.rglob("CMakeLists.txt"):
        parts = path.relative_to(SOURCE).parts
        if parts[0] in ("build", "tests") or parts[:2] == ("benchmark", "speed"):
            continue
        text = re.sub(r"#.*", "", path.read_text())
        found |= {name: int(layer) for name, layer in re.findall(
            r"levitas_library\(\s*([\w-]+)\s[^)]*?LAYER\s+(\d+)", text)}
        found |= dict.fromkeys(re.findall(r"levitas_program\(\s*([\w-]+)", text), 5)
        found |= dict.fromkeys(re.findall(r"levitas_lcm_types\(\s*([\w-]+)", text), 0)
    return found


def documented():
    table = {}
    chapter = (SOURCE / "docs/architecture.md").read_text().split("\n## Libraries on six layers\n")[1]
    for layer, names in re.findall(r"^\| (\d+) \| ([^|]*) \|", chapter.split("\n## ")[0], re.M):
        table |= dict.fromkeys(re.findall(r"`([\w-]+)`", names), int(layer))
    return table


class LayerTable(unittest.TestCase):
    def test_equals_what_the_build_declares(self):
        self.assertGreater(len(declared()), 10)
        self.assertEqual(documented(), declared())


class Links(unittest.TestCase):
    def test_every_link_of_a_document_to_a_file_leads_somewhere(self):
        documents = [SOURCE / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
        for document in documents + sorted((SOURCE / "docs").glob("*.md")):
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", document.read_text()):
                with self.subTest(f"{document.name} -> {target}"):
                    self.assertTrue((document.parent / target).exists())


if __name__ == "__main__":
    unittest.main()
