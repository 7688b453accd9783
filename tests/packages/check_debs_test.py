# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Makes small packages with one fault at a time and expects the checker to find it and nothing else."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import check_debs


def part(name, **changes):
    return {"SPDXID": f"SPDXRef-{name}", "name": name, "versionInfo": "1", "licenseConcluded": "MIT", **changes}


def make(folder, name="treadmark", depends="libc6 (>= 2)", parts=("libc6", "Eigen"), copyright="It holds parts of\n  Eigen 1 (MIT)\n", changes={}, file=b"x", leave=()):
    root = folder / "root"
    doc = root / "usr" / "share" / "doc" / name
    doc.mkdir(parents=True)
    (root / "DEBIAN").mkdir()
    (root / "DEBIAN" / "control").write_text(f"Package: {name}\nVersion: 1\nArchitecture: all\nMaintainer: a <a@b.invalid>\nDescription: d\nDepends: {depends}\n")
    for held in check_debs.HELD.get(name.removesuffix("-gpl"), []):
        if held not in leave:
            (root / "usr" / held).parent.mkdir(parents=True, exist_ok=True)
            (root / "usr" / held).write_bytes(file)
    (doc / "copyright").write_text(copyright)
    relations = [{"relationshipType": "CONTAINS" if name == "Eigen" else "DYNAMIC_LINK", "relatedSpdxElement": f"SPDXRef-{name}"} for name in parts]
    (doc / f"{name}.spdx.json").write_text(json.dumps({"spdxVersion": "SPDX-2.3", "packages": [part(p, **changes) for p in parts], "relationships": relations}))
    subprocess.run(["dpkg-deb", "--root-owner-group", "-b", root, folder / f"{name}_1_all.deb"], check=True, capture_output=True)
    shutil.rmtree(root)


class Planted(unittest.TestCase):
    def found(self, **fault):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for package in ("treadmark", "libtreadmark0", "libtreadmark-dev"):
                make(folder, **{"name": package, **(fault if package == fault.get("name", "treadmark") else {})})
            return check_debs.check(folder, ["/where/it/was/built"])

    def expect(self, word, **fault):
        found = self.found(**fault)
        self.assertEqual(len(found), 1, found)
        self.assertIn(word, found[0])

    def test_nothing_planted(self):
        self.assertEqual(self.found(), [])

    def test_faults(self):
        self.expect("has no usr/bin/treadmark", leave=["bin/treadmark"])
        self.expect("needs libocct-", depends="libc6, libocct-foundation-7.6", parts=("libc6", "libocct-foundation-7.6", "Eigen"))
        self.expect("needs libfftw3", depends="libc6, libfftw3-double3", parts=("libc6", "libfftw3-double3", "Eigen"))
        self.expect("leaves out libc6", parts=("Eigen",))
        self.expect("copyright leaves out Eigen", copyright="It holds parts of\n")
        self.expect("disagree about the GPL", copyright="GNU General Public License\nIt holds parts of\n  Eigen 1 (MIT)\n")
        self.expect("no licence or version of libc6", parts=("libc6",), changes={"licenseConcluded": "NOASSERTION"})
        self.assertIn("names /where/it/was/built", "\n".join(self.found(file=b"in /where/it/was/built/x")))
        self.assertIn("no debug information", "\n".join(self.found(file=pathlib.Path("/bin/true").read_bytes())))
        with unittest.mock.patch.dict(check_debs.LIMITS, treadmark=1e-6):
            self.expect("more than")

    def test_names(self):
        with tempfile.TemporaryDirectory() as name:
            make(pathlib.Path(name))
            self.assertEqual(check_debs.check(pathlib.Path(name)), ["no package libtreadmark-dev", "no package libtreadmark0"])


if __name__ == "__main__":
    if not shutil.which("dpkg-deb"):
        sys.exit(77)
    unittest.main()
