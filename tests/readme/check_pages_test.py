#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The check of the pages must find what is planted, and nothing in a clean tree."""
import pathlib
import tempfile
import unittest

from check_pages import problems

PAGE = "# Scans\n\nFrom points to surfaces.\n\n```\ntreadmark import a.ply\n```\n\n`pmax_MPa`\n"
WHOLE = PAGE + "\n## What can go wrong\n\nHoles.\n"
CLEAN = {
    "README.md": "# Treadmark\n\n```\nbash scripts/main-job.sh\nbash scripts/test.sh\n```\n",
    "CMakeLists.txt": "project(Treadmark VERSION 0.2.0 LANGUAGES CXX)\n",
    "CITATION.cff": "version: 0.2.0\ndate-released: 2026-01-01\n",
    "CHANGELOG.md": "# Changelog\n\n## 0.2.0 (2026-01-01)\n\n### Added\n\n- Scans.\n\n## 0.1.0\n\n- First\n  version.\n",
    "core/README.md": "",
    "docs/index.md": PAGE + "\n## How-to\n\n- [Scans](scans.md): points\n\n[glossary](glossary.md) [C](c.md)\n",
    "docs/scans.md": WHOLE,
    "docs/c.md": "# C\n\nFor programs in C.\n\n```c\n#include <stdio.h>\n\nint main(void) { return 0; }\n```\n",
    "docs/glossary.md": PAGE,
}


class Planted(unittest.TestCase):
    def problems(self, planted):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**CLEAN, **planted}.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(problems(pathlib.Path(folder)))

    def test_clean_tree(self):
        self.assertEqual(self.problems({}), [])

    def test_violations(self):
        for name, text, found in [
                ("README.md", CLEAN["README.md"] + "\n" * 60, "lines"), ("README.md", CLEAN["README.md"] + "a" * 101, "characters"),
                ("README.md", CLEAN["README.md"].replace("test.sh", "tests.sh"), "lacks"), ("CITATION.cff", "version: 0.1.0\ndate-released: 2026-01-01\n", "versions differ"),
                ("CITATION.cff", "version: 0.2.0\ndate-released: 2026-01-02\n", "date"),
                ("CHANGELOG.md", CLEAN["CHANGELOG.md"].replace("Scans.", "Scans\n  in two lines."), "in two lines"),
                ("CHANGELOG.md", CLEAN["CHANGELOG.md"].replace("0.2.0", "0.3.0"), "versions differ"),
                ("docs/scans.md", WHOLE.replace("From points to surfaces.\n\n", ""), "does not begin"),
                ("docs/scans.md", WHOLE.replace("treadmark import a.ply\n", "treadmark import a.ply\ntreadmark list\n"), "more than one command"),
                ("docs/scans.md", PAGE, "can go wrong"),
                ("docs/scans.md", WHOLE.replace("From", "\n".join(["From"] * 12)), "below line 12"), ("docs/more.md", PAGE, "not in docs/index.md"),
                ("docs/glossary.md", PAGE + "`pmin_MPa`\n", "pmin_MPa")]:
            with self.subTest(name=name, text=text):
                problems_found = self.problems({name: text})
                self.assertEqual(len(problems_found), 1, problems_found)
                self.assertIn(found, problems_found[0])


unittest.main()
