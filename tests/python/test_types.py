# SPDX-License-Identifier: GPL-3.0-or-later
"""The types that are written beside the package name each function with its keywords; mypy agrees, where it is installed."""
import ast
import importlib.util
import inspect
import subprocess
import sys
import unittest
from pathlib import Path

from support import InFolder

import standpoint

STUB = Path(standpoint.__file__).with_name("__init__.pyi")

RIGHT = """
import numpy as np
import standpoint as sp
answer = sp.scan("house", instrument="leica-rtc360", set={"resolution": "12mm"}, output="s.e57", compensator=False)
seconds: float = answer["seconds"]
house = sp.Project("house")
house.station(add="S1", on=np.array([1.0, 2.0])).description.upper()
xyz = sp.read_cloud("s.e57")[0].xyz
xyz.mean(axis=0)
house.mesh().faces.max()
"""
WRONG = """
import standpoint as sp
sp.scan("house", instrument="leica-rtc360", output="s.e57", seed="one")
sp.scan("house", output="s.e57")
sp.scan("house", instrument="leica-rtc360", output="s.e57", quality="best")
sp.Project("house").station(ad="S1")
"""


class Types(InFolder):
    def test_the_stub_has_every_function_with_its_keywords(self):
        tree = ast.parse(STUB.read_text(encoding="utf-8"))
        written = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
        for verb in standpoint._verbs.TABLE:
            name = standpoint._verbs.spelled(verb["name"])
            arguments = written[name].args
            signature = inspect.signature(getattr(standpoint, name))
            self.assertEqual([a.arg for a in arguments.args + arguments.kwonlyargs], list(signature.parameters), name)
            self.assertEqual(ast.get_docstring(written[name]), inspect.getdoc(getattr(standpoint, name)), name)
        for name in standpoint.__all__:
            self.assertRegex(STUB.read_text(encoding="utf-8"), rf"(def|class|as) {name}\b")

    def mypy(self, text):
        Path("script.py").write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, "-m", "mypy", "--strict", "script.py"], capture_output=True, text=True,
                              env={"MYPYPATH": str(STUB.parents[1]), "PATH": "/usr/bin"})

    @unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
    def test_mypy_takes_what_is_right_and_finds_what_is_wrong(self):
        ran = self.mypy(RIGHT)
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
        ran = self.mypy(WRONG)
        self.assertEqual(sum("script.py" in line and "error" in line for line in ran.stdout.splitlines()), 4, ran.stdout)


if __name__ == "__main__":
    unittest.main()
