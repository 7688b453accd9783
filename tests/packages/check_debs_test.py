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

LICENCES = "It holds parts of\n  Eigen 1 (MIT)\n"


def make(folder, name, depends="libc6 (>= 2)", parts=("libc6", "Eigen"), licences=LICENCES, licence="MIT", content=b"x", leave=()):
    root = folder / "root"
    texts = {"DEBIAN/control": f"Package: {name}\nVersion: 1\nArchitecture: all\nMaintainer: a <a@b.invalid>\nDescription: d\nDepends: {depends}\n",
             f"usr/share/doc/{name}/copyright": licences, f"usr/share/doc/{name}/{name}.spdx.json": json.dumps({
                 "spdxVersion": "SPDX-2.3",
                 "packages": [{"SPDXID": part, "name": part, "versionInfo": "1", "licenseConcluded": licence} for part in parts],
                 "relationships": [{"relationshipType": "CONTAINS" if part == "Eigen" else "", "relatedSpdxElement": part} for part in parts]})}
    for path, text in [*texts.items(), *((f"usr/{held}", None) for held in check_debs.NEEDED[name][1] if held not in leave)]:
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_bytes(text.encode() if text is not None else content)
    subprocess.run(["dpkg-deb", "--root-owner-group", "-Znone", "-b", root, folder / f"{name}_1_all.deb"], check=True, capture_output=True)
    shutil.rmtree(root)


class Planted(unittest.TestCase):
    def found(self, names=tuple(check_debs.NEEDED), **fault):
        with tempfile.TemporaryDirectory() as folder:
            for name in names:
                make(pathlib.Path(folder), name, **(fault if name == "treadmark" else {}))
            return check_debs.check(pathlib.Path(folder), ["/where/it/was/built"])

    def expect(self, *words, **fault):
        found = self.found(**fault)
        self.assertEqual([word in line for word, line in zip(words, found, strict=True)], [True] * len(words), found)

    def test_planted(self):
        self.expect()
        self.expect("no package libtreadmark-dev", names=("treadmark", "libtreadmark0"))
        self.expect("has no usr/bin/treadmark", leave=["bin/treadmark"])
        self.expect("needs libocct-", depends="libc6, libocct-foundation-7.6", parts=("libc6", "libocct-foundation-7.6", "Eigen"))
        self.expect("needs libfftw3", depends="libc6, libfftw3-double3", parts=("libc6", "libfftw3-double3", "Eigen"))
        self.expect("leaves out libc6", parts=("Eigen",))
        self.expect("copyright leaves out Eigen", licences="It holds parts of\n")
        self.expect("disagree about the GPL", licences="GNU General Public License\n" + LICENCES)
        self.expect("no licence or version of libc6", parts=("libc6",), licence="NOASSERTION")
        self.expect(*["names /where/it/was/built"] * 3, content=b"in /where/it/was/built/x")
        self.expect(*["no debug information"] * 3, content=pathlib.Path("/bin/true").read_bytes())
        with unittest.mock.patch.dict(check_debs.NEEDED, treadmark=(1e-6, [])):
            self.expect("more than")


if __name__ == "__main__":
    if not shutil.which("dpkg-deb"):
        sys.exit(77)
    unittest.main()
