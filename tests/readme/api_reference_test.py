#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What cmake/api_reference.py hands to Doxygen, and which of its warnings count.

usage: api_reference_test.py ROOT
"""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(sys.argv.pop(1)) / "cmake"))
from api_reference import filtered, lacking  # noqa: E402


class Filter(unittest.TestCase):
    def expect(self, text, result):
        self.assertEqual(filtered(text), result)
        self.assertEqual(text.count("\n"), result.count("\n"))  # warnings name the right line

    def test_one_declaration_each(self):
        self.expect("  double x = 0.0, y = 1.0;  ///< [m]; both", "  double x = 0.0; /**< [m]; both */ double y = 1.0; /**< [m]; both */")
        self.expect("std::vector<double> x, y;  ///< [m]", "std::vector<double> x; /**< [m] */ std::vector<double> y; /**< [m] */")
        self.expect("Vec3 a = Vec3(0, 1, 2), b;  ///< [m]\n  ///< or feet", "Vec3 a = Vec3(0, 1, 2); /**< [m] or feet */ Vec3 b; /**< [m] or feet */\n")
        self.expect("/// [m]\ndouble x, y;", "/// [m]\ndouble x; double y; /**< [m] */")

    def test_left_alone(self):
        for text in ("double x = 0.0;  ///< [m]", "double x, y;", "void f(int a, int b);  ///< c", "/// [m]\ndouble x;",
                     "  friend bool operator==(const A&, const A&) = default;"):
            self.expect(text, text)

    def test_comments_about_what_follows(self):
        self.expect("/// All of it.\n\n/// [m]\ndouble x;", "\n\n/// [m]\ndouble x;")


class Lacking(unittest.TestCase):
    def test_which_count(self):
        with tempfile.TemporaryDirectory() as folder:
            header = pathlib.Path(folder, "a.hpp")
            header.write_text("double x = 0.0;\nMaterial material;\nvoid f();\nA(A&&) noexcept;\nbool operator==(const A&);\n")

            def warning(line, what):
                return f"{header}:{line}: warning: Member {what} of struct A is not documented."

            counting = [warning(1, "x (variable)"), warning(3, "f() (function)"), f"{header}:3: warning: unknown command"]
            passed = [warning(2, "material (variable)"), warning(4, "A(A &&) noexcept (function)"),
                      warning(5, "operator==(const A &) (friend)")]
            self.assertEqual(list(lacking(counting + passed)), counting)


if __name__ == "__main__":
    unittest.main()
