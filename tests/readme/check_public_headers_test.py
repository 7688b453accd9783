#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The check of the public headers must find what is planted, and nothing in a clean tree."""
import pathlib
import tempfile
import unittest

from check_public_headers import check

CLEAN = {
    "docs/public-headers.md": "| header | for |\n|---|---|\n| `core/a.hpp` | poses |\n| `app/cases/b.hpp` | cases |\n",
    "core/CMakeLists.txt": "treadmark_library(core PUBLIC Eigen3::Eigen)\n",
    "app/CMakeLists.txt": "treadmark_library(app LIGHT ROOMS cases surfaces PUBLIC treadmark::core)\n",
    "core/a.hpp": "",
    "app/cases/b.hpp": "",
    "app/cases/c.hpp": "",
    "README.md": '```cpp\n#include "treadmark/core/a.hpp"\n```\n',
}


class Planted(unittest.TestCase):
    def violations(self, planted):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**CLEAN, **planted}.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(check(pathlib.Path(folder)))

    def listed(self, row):
        return {"docs/public-headers.md": CLEAN["docs/public-headers.md"] + row}

    def test_clean_tree(self):
        self.assertEqual(self.violations({}), [])

    def test_planted(self):
        for planted, found in [
                (self.listed("| `core/none.hpp` | nothing |\n"), "does not exist"),
                (self.listed("| `app/cli/d.hpp` | the program |\n") | {"app/cli/d.hpp": ""}, "not installed"),
                (self.listed("| `app/cases/c.hpp` | |\n"), "what is it for"),
                ({"docs/public-headers.md": "none\n", "README.md": ""}, "lists no headers"),
                ({"examples/e.cpp": '#include "treadmark/app/cases/c.hpp"\n'}, "needs app/cases/c.hpp"),
                ({"docs/guide.md": '#include "treadmark/app/cases/c.hpp"\n'}, "needs app/cases/c.hpp")]:
            with self.subTest(found=found):
                violations = self.violations(planted)
                self.assertEqual(len(violations), 1, violations)
                self.assertIn(found, violations[0])
        self.assertEqual(len(self.violations(self.listed("| `core/a.hpp` | again |\n"))), 2)


if __name__ == "__main__":
    unittest.main()
