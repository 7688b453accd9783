# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Plants one violation at a time and expects the checker to find it and nothing else."""
import copy
import unittest

from check_packages import check

PACKAGE = {"dependencies": {"a": "1.2.3"}, "devDependencies": {"b": "2.0.0"}}
ENTRY = {"version": "1.2.3", "license": "MIT", "integrity": "sha512-" + 86 * "A" + "=="}
LOCK = {"packages": {"": PACKAGE, "node_modules/a": ENTRY, "node_modules/b": {**ENTRY, "dev": True, "license": "Python-2.0"}}}
NOTICE = "Scripts are bundled with z, a and\nothers (MIT), c (ISC)"
RULES = '    COMMAND "${TREADMARK_NPM}" ci --ignore-scripts --no-audit\n'


class Planted(unittest.TestCase):
    def expect(self, word, package=PACKAGE, lock=LOCK, rules=RULES, notice=NOTICE):
        found = check(package, lock, rules, notice)
        self.assertEqual(len(found), 1, found)
        self.assertIn(word, found[0])

    def changed(self, place, **values):
        lock = copy.deepcopy(LOCK)
        lock["packages"][place].update(values)
        return lock

    def test_nothing_planted(self):
        self.assertEqual(check(PACKAGE, LOCK, RULES, NOTICE), [])

    def test_ranges(self):
        package = {**PACKAGE, "dependencies": {"a": "^1.2.3"}}
        self.expect("pinned", package, self.changed("", **package))

    def test_lock_of_another_package(self):
        self.expect("not those", {**PACKAGE, "devDependencies": {"b": "2.0.1"}})

    def test_digests(self):
        self.expect("SHA-512", lock=self.changed("node_modules/b", integrity="sha1-abc"))

    def test_places(self):
        self.expect("comes from", lock=self.changed("node_modules/a", resolved="elsewhere/a.tgz"))

    def test_licences(self):
        self.expect("GPL-3.0", lock=self.changed("node_modules/a", license="GPL-3.0"))

    def test_notice(self):
        self.expect("not named", notice=NOTICE.replace(" a ", " b "))
        self.expect("not named", lock=self.changed("node_modules/a", license="ISC"))

    def test_calls(self):
        self.expect("npm is called", rules=RULES.replace(" --ignore-scripts", ""))
        self.expect("npm is called", rules=RULES.replace(" ci ", " install "))


if __name__ == "__main__":
    unittest.main()
