# SPDX-License-Identifier: GPL-3.0-or-later
"""Every cell of docs/notebooks runs, in an empty folder; they are kept without outputs."""
import json
import os
import sys
import unittest
from pathlib import Path

from support import SOURCE, InFolder

try:
    import ipykernel  # noqa: F401
    import matplotlib  # noqa: F401
    import nbclient
    import nbformat
except ImportError as missing:
    print(f"skipped: {missing.name} is not installed (packages-notebooks.txt)")
    sys.exit(77)

NOTEBOOKS = sorted((SOURCE / "docs/notebooks").glob("*.ipynb"))


class Notebooks(InFolder):
    def test_there_are_three_without_outputs(self):
        self.assertGreaterEqual(len(NOTEBOOKS), 3)
        for file in NOTEBOOKS:
            book = json.loads(file.read_text(encoding="utf-8"))
            for cell in book["cells"]:
                self.assertFalse(cell.get("outputs"), file)
                self.assertIsNone(cell.get("execution_count"), file)

    def run_notebook(self, file: Path):
        book = nbformat.read(file, as_version=4)
        os.environ.update(IPYTHONDIR=os.path.abspath("ipython"), JUPYTER_RUNTIME_DIR=os.path.abspath("runtime"))
        nbclient.NotebookClient(book, timeout=100, kernel_name="python3").execute()
        outputs = [out for cell in book.cells if cell.cell_type == "code" for out in cell.outputs]
        pictures = [out for out in outputs if "image/png" in out.get("data", {})]
        self.assertGreaterEqual(len(pictures), 1, file)
        return outputs


def add(file: Path) -> None:
    def test(self):
        self.run_notebook(file)

    setattr(Notebooks, f"test_{file.stem.replace('-', '_')}_runs", test)


for notebook in NOTEBOOKS:
    add(notebook)

if __name__ == "__main__":
    unittest.main()
