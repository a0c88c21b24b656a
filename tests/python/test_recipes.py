# SPDX-License-Identifier: GPL-3.0-or-later
"""What guides tell to type is typed, and gives what they say."""
import contextlib
import io
import re
import shutil
import unittest

from support import BUILD, SOURCE, InFolder


class Recipes(InFolder):
    def test_the_torsion_of_a_turbine_by_four_range_meters(self):
        guide = (SOURCE / "docs/guide/lecturer.md").read_text(encoding="utf-8")
        part = guide.split("## Four range meters before a turbine", 1)[1]
        recipe = re.search(r"```python\n(.*?)```", part, flags=re.S).group(1)
        shutil.copy(BUILD / "share/standpoint/samples/turbine.ifc", "turbine.ifc")
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            exec(compile(recipe, "recipe", "exec"), {})
        head, *rows = said.getvalue().splitlines()
        self.assertIn(f"    {head}\n", part)
        self.assertEqual(len(rows), 4)
        for row in rows:
            self.assertIn(f"    {row}\n", part, "the guide shows what comes out")
            radius, torsion, sigma, passages = map(float, row.split())
            self.assertAlmostEqual(torsion, 4 * radius / 60, delta=0.01)
            self.assertLess(sigma, 0.01)
            self.assertEqual(passages, 11)


if __name__ == "__main__":
    unittest.main()
