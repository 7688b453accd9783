#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The check of the binary interface must see what breaks programs that are built, and nothing in what does not."""
import unittest

from check_abi import check, of_header

HEADER = """
#define TM_API __attribute__((visibility("default")))
typedef enum tm_status { TM_OK = 0, /* well */ TM_FAILED = 3 } tm_status;
typedef struct tm_case tm_case;  /* given */
typedef int (*tm_heights)(void *user, double u, const double *y);
/* TM_API int tm_old(void); */
TM_API tm_status tm_read(const char *file, const char *const *assignments, const double origin[3],
                         tm_case **out);
TM_API const char *tm_text(void);
"""


class Changes(unittest.TestCase):
    def compared(self, old, new):
        self.assertIn(old, HEADER)
        return check(of_header(HEADER), of_header(HEADER.replace(old, new)))

    def test_same(self):
        self.assertEqual(sorted(of_header(HEADER)), [
            "callback int tm_heights(void *, double, const double *)", "enumerator tm_status TM_FAILED = 3", "enumerator tm_status TM_OK = 0",
            "function const char * tm_text(void)", "function tm_status tm_read(const char *, const char *const *, const double [3], tm_case **)",
            "type tm_case"])
        for old, new in (("*file", "*name"), ("/* given */", ""), ("assignments, const", "assignments,\n  const")):
            with self.subTest(new=new):
                self.assertEqual(self.compared(old, new), ([], []))

    def test_broken(self):
        for old, new in (("const char *file", "char *file"), ("TM_FAILED = 3", "TM_FAILED = 4"), ("double u", "float u"), ("origin[3]", "origin[4]"),
                         ("const char *tm_text", "char *tm_text"), ("tm_text", "tm_words"), ("TM_FAILED", "TM_BAD")):
            with self.subTest(new=new):
                self.assertTrue(self.compared(old, new)[0])

    def test_new(self):
        gone, new = self.compared("TM_API const", "typedef struct tm_box { double x; } tm_box;\nTM_API int tm_new(int);\nTM_API const")
        self.assertEqual(gone, [])
        self.assertEqual(new, ["function int tm_new(int)", "layout tm_box double x;"])


unittest.main()
