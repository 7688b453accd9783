#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The check of the files that documents name must find what is planted, and nothing in a clean tree."""
import pathlib
import tempfile
import unittest

from check_files import check

CLEAN = {
    "core/README.md": "`pose.hpp`, [frames](../docs/frames.md#axes), `text`, `/tmp/x.toml`, `OUT/result.json`",
    "core/pose.hpp": "",
    "docs/frames.md": "`core/pose.hpp` `treadmark/core/pose.hpp` `core/pose` `core/{pose,grid}.hpp` `core/p*.hpp` `pose.hpp` `core/<what>.hpp`",
    "core/grid.hpp": "",
    "solvers/kalker/normal/hertz.hpp": "",
    "README.md": "`kalker/normal/hertz.hpp` `core/`\n```\n`core/none.hpp`\n```\n",
}


class Planted(unittest.TestCase):
    def violations(self, planted):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**CLEAN, **planted}.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return check(pathlib.Path(folder))

    def test_clean_tree(self):
        self.assertEqual(self.violations({}), [])

    def test_missing_files(self):
        for name, text, found in [
                ("README.md", "`core/none.hpp`", "core/none.hpp"), ("CONTRIBUTING.md", "`docs/none.md`", "docs/none.md"),
                ("docs/a.md", "`core/none`", "core/none"), ("docs/a.md", "`none.cpp`", "none.cpp"),
                ("docs/a.md", "`core/{pose,none}.hpp`", "core/{pose,none}.hpp"), ("docs/a.md", "`core/n*.hpp`", "core/n*.hpp"),
                ("docs/a.md", "[a](../core/none.hpp)", "../core/none.hpp"), ("core/b/README.md", "`pose.hpp`", "pose.hpp"),
                ("core/b/README.md", "`none/`", "none/"), ("docs/a.md", "`treadmark/core/none.hpp`", "core/none.hpp")]:
            with self.subTest(name=name, text=text):
                violations = self.violations({name: text})
                self.assertEqual(len(violations), 1, violations)
                self.assertIn(name, violations[0])
                self.assertIn(found, violations[0])


if __name__ == "__main__":
    unittest.main()
