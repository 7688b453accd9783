#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Tests of bench/instructions/compare_counts.py: compare_counts_test.py ROOT"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(sys.argv.pop(1)) / "bench" / "instructions" / "compare_counts.py"


class CompareCounts(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.baseline = pathlib.Path(self.folder.name) / "baseline.json"
        self.counts = pathlib.Path(self.folder.name) / "counts"

    def tearDown(self):
        self.folder.cleanup()

    def compare(self, counts, *options, configuration="GNU 12", paths=None):
        if paths is not None:
            names = pathlib.Path(self.folder.name) / "paths"
            names.write_text("".join(f"{path}\n" for path in paths))
            options += ("--paths", str(names))
        self.counts.write_text("".join(f"{path} point 10 {instructions}\n" for path, instructions in counts.items()))
        return subprocess.run([sys.executable, str(SCRIPT), str(self.baseline), str(self.counts), "--configuration", configuration, *options],
                              capture_output=True, text=True)

    def test_growth_decides(self):
        self.assertEqual(self.compare({"a": 1000, "b": 2000}, "--update").returncode, 0)
        self.assertEqual(json.loads(self.baseline.read_text()), {"GNU 12": {"a": 100.0, "b": 200.0}})
        self.assertEqual(self.compare({"a": 1040, "b": 500}).returncode, 0)
        grown = self.compare({"a": 1060, "b": 2000})
        self.assertEqual(grown.returncode, 1)
        self.assertIn("1.060  GREW", grown.stdout)
        self.assertIn("a grew by more than 5 %", grown.stderr)
        self.assertNotIn("b grew", grown.stderr)

    def test_new_paths_are_no_failure(self):
        self.compare({"a": 1000}, "--update")
        result = self.compare({"a": 1000, "c": 7})
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stdout, r"c +0\.7 point +- +new")

    def test_what_fell_is_named(self):
        self.compare({"a": 1000, "b": 1000}, "--update")
        result = self.compare({"a": 940, "b": 960})
        self.assertEqual(result.returncode, 0)
        self.assertIn("fell by more than 5 %, which --update would keep: a\n", result.stderr)

    def test_paths_that_are_gone_are_missed(self):
        self.compare({"a": 1000, "b": 2000}, "--update")
        self.assertEqual(self.compare({"a": 1000}, paths=["a", "b"]).returncode, 0)  # not counted this time
        result = self.compare({"a": 1000}, paths=["a", "c"])
        self.assertEqual(result.returncode, 1)
        self.assertIn("b is in the baseline, but not among the paths", result.stderr)
        self.assertEqual(self.compare({"a": 1000}, "--update", paths=["a", "c"]).returncode, 0)
        self.assertEqual(json.loads(self.baseline.read_text()), {"GNU 12": {"a": 100.0}})

    def test_the_guard_fails_in_ci_where_it_cannot_count(self):
        root = SCRIPT.parents[2]
        with tempfile.TemporaryDirectory() as bare:
            for tool in ("bash", "dirname", "mktemp", "rm", "sed", "cat"):
                (pathlib.Path(bare) / tool).symlink_to(shutil.which(tool))
            for ci, status in (("true", 1), ("", 3)):
                result = subprocess.run(["bash", str(root / "scripts" / "check-instructions.sh"), "--no-build"], env={"PATH": bare, "CI": ci},
                                        capture_output=True, text=True)
                self.assertEqual(result.returncode, status, result.stderr)
                self.assertIn("instructions cannot be counted here", result.stderr)

    def test_other_configurations_are_not_compared(self):
        self.compare({"a": 1000}, "--update")
        other = self.compare({"a": 5000}, configuration="Clang 15")
        self.assertEqual(other.returncode, 3)
        self.assertIn("no baseline of this configuration", other.stderr)
        self.compare({"a": 5000}, "--update", configuration="Clang 15")
        self.assertEqual(self.compare({"a": 1000}).returncode, 0)

    def test_update_keeps_paths_that_were_not_counted(self):
        self.compare({"a": 1000, "b": 2000}, "--update")
        self.compare({"a": 3000}, "--update")
        self.assertEqual(json.loads(self.baseline.read_text()), {"GNU 12": {"a": 300.0, "b": 200.0}})


if __name__ == "__main__":
    unittest.main()
