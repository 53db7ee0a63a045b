"""Every notebook of examples/ runs from its first cell to its last, whose assertions hold.

Not run (status 77) where no interpreter has nbclient, ipykernel and numpy (packages-notebooks.txt).
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["LEVITAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/support"))
from interpreter import SKIP_STATUS, having  # noqa: E402
from lcm_network import BINARIES  # noqa: E402
from waiting import LIMIT_S  # noqa: E402

FOLDER = SOURCE / "examples/notebooks"
# In a process of its own, so that another interpreter than this one may have the packages.
RUN = """
import sys, nbclient, nbformat
from jupyter_client.manager import AsyncKernelManager
from jupyter_client.kernelspec import KernelSpec
manager = AsyncKernelManager()
# This interpreter as the kernel, whatever kernels are registered on the machine.
manager._kernel_spec = KernelSpec(argv=[sys.executable, "-B", "-m", "ipykernel_launcher", "-f", "{connection_file}"],
                                  display_name="own", language="python")
notebook = nbformat.read(sys.argv[1], as_version=4)
nbformat.validate(notebook)
nbclient.NotebookClient(notebook, km=manager, timeout=int(sys.argv[2]), startup_timeout=int(sys.argv[2])).execute(cwd=sys.argv[3])
nbformat.write(notebook, sys.argv[3] + "/done.ipynb")
"""


PYTHON = having("nbclient", "ipykernel", "numpy")


class Notebooks(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def run_in(self, path):
        """The status, what was said, and the text that the cells printed."""
        environment = {**os.environ, "LEVITAS_AMB": str(BINARIES / "amb"), "PYTHONPATH": str(SOURCE / "python"),
                       "LEVITAS_CATALOGUE": "", "HOME": str(self.folder), "IPYTHONDIR": str(self.folder / "ipython"),
                       "JUPYTER_RUNTIME_DIR": str(self.folder / "runtime"), "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run([PYTHON, "-B", "-c", RUN, path, str(int(LIMIT_S)), self.folder], capture_output=True,
                              text=True, check=False, timeout=LIMIT_S, env=environment)
        made = self.folder / "done.ipynb"
        printed = ""
        if made.exists():
            for cell in json.loads(made.read_text(encoding="utf-8"))["cells"]:
                printed += "".join("".join(out.get("text", [])) for out in cell.get("outputs", []))
        return done.returncode, done.stderr, printed

    def runs(self, name, *said):
        status, errors, printed = self.run_in(FOLDER / f"{name}.ipynb")
        self.assertEqual(status, 0, errors)
        for text in said:
            self.assertIn(text, printed)

    def test_run(self):
        self.runs("run", "ACCEPTED", "once per turn")

    def test_own_data(self):
        self.runs("own_data", "kind: import_map", "mine.lcm.zst")

    def test_identify(self):
        self.runs("identify", "Hz  +-")

    def test_diagnose(self):
        self.runs("diagnose", "effect cross_coupled_stiffness", "report.html")

    def test_an_assertion_that_does_not_hold_is_seen(self):
        notebook = json.loads((FOLDER / "run.ipynb").read_text(encoding="utf-8"))
        notebook["cells"] = [{"cell_type": "code", "execution_count": None, "id": "one", "metadata": {}, "outputs": [],
                              "source": ["assert 1 == 2, 'seen'"]}]
        (self.folder / "false.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
        status, errors, _ = self.run_in(self.folder / "false.ipynb")
        self.assertNotEqual(status, 0)
        self.assertIn("seen", errors)


class Files(unittest.TestCase):
    def test_each_has_a_test_no_outputs_and_assertions_at_its_end(self):
        paths = sorted(FOLDER.glob("*.ipynb"))
        self.assertEqual([path.stem for path in paths],
                         sorted(name[len("test_"):] for name in dir(Notebooks)
                                if name.startswith("test_") and "assertion" not in name))
        for path in paths:
            cells = [cell for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]
                     if cell["cell_type"] == "code"]
            self.assertTrue(all(not cell["outputs"] and cell["execution_count"] is None for cell in cells), path)
            self.assertIn("assert", "".join(cells[-1]["source"]), path)
            self.assertLess(path.stat().st_size, 20_000, path)


if __name__ == "__main__":
    if PYTHON is None:
        print("no nbclient, ipykernel and numpy here (packages-notebooks.txt): no notebook was run")
        sys.exit(SKIP_STATUS)
    unittest.main()
