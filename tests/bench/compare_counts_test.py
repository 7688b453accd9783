#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Tests of bench/instructions/compare_counts.py: compare_counts_test.py ROOT"""
import json
import pathlib
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

    def compare(self, counts, *options, configuration="GNU 12"):
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
