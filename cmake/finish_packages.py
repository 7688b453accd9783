#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Finishes the packages that CPack has made: licences and a bill of materials (SPDX) of what each holds and needs, static libraries without
debug information, debug information in packages whose names apt takes, and bytes that depend on the contents alone.

usage: finish_packages.py BUILD FOLDER    BUILD/*.deb and *.ddeb, finished in FOLDER; $SOURCE_DATE_EPOCH is their time
"""
import base64
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Headers that are compiled into what the packages hold, the Debian packages that they come from, and which of ours hold them: what is
# linked with all of Treadmark (None), or one.
HEADERS = {"Eigen": ("libeigen3-dev", None), "JSON for Modern C++": ("nlohmann-json3-dev", None), "CLI11": ("libcli11-dev", "treadmark"),
           "nanoflann": ("libnanoflann-dev", None), "CGAL": ("libcgal-dev", None), "OpenVDB": ("libopenvdb-dev", "treadmark-openvdb"),
           "NanoVDB": ("libnanovdb-dev", None)}
SITE = {"Furo": ("furo", "MIT"), "Sphinx": ("sphinx-common", "BSD-2-Clause")}  # style sheets and scripts of the documents
# By source package, beside those of the libraries in the program's own list.
LICENCES = {"glibc": "LGPL-2.1-or-later", "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1", "numpy": "BSD-3-Clause",
            "python3-defaults": "PSF-2.0", "imath": "BSD-3-Clause"}


def output(*command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


def installed(package):
    """Source and version of a Debian package of this machine."""
    return output("dpkg-query", "-W", "-f", "${source:Package}\t${Version}", package).split("\t")


class Bill:
    """SPDX 2.3 of one package of ours, and its file of licences."""

    def __init__(self, name, version):
        self.gpl = name.endswith("-gpl")
        self.packages, self.relations, self.texts = [], [], []
        self.add("DESCRIBES", name, version, "GPL-3.0-or-later" if self.gpl else "Apache-2.0")

    def add(self, relation, name, version, licence, purl=None, digest=None, text=""):
        own = {"SPDXID": "SPDXRef-" + re.sub("[^A-Za-z0-9.]", "-", name), "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION",
               "filesAnalyzed": False, "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION"}
        if purl:
            own["externalRefs"] = [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": purl}]
        if digest:
            own["checksums"] = [{"algorithm": "SHA512", "checksumValue": digest}]
        self.packages.append(own)
        self.relations.append({"spdxElementId": "SPDXRef-DOCUMENT" if relation == "DESCRIBES" else self.packages[0]["SPDXID"],
                               "relationshipType": relation, "relatedSpdxElement": own["SPDXID"]})
        if relation == "CONTAINS":
            self.texts.append((f"{name} {version} ({licence})", text))

    def debian(self, relation, package, licence=None, name=None, text=None):
        source, version = installed(package)
        if relation == "CONTAINS" and text is None:
            text = pathlib.Path(f"/usr/share/doc/{package}/copyright").read_text(encoding="utf-8")
        self.add(relation, name or package, version, licence or LICENCES.get(source, "NOASSERTION"),
                 f"pkg:deb/debian/{package}@{urllib.parse.quote(version, safe='')}", text=text)

    def json(self, epoch):
        name = "{name}-{versionInfo}".format(**self.packages[0])
        return json.dumps({"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": name,
                           "documentNamespace": f"https://treadmark.invalid/spdx/{name}-{epoch}",
                           "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(epoch)), "creators": ["Tool: finish_packages.py"]},
                           "packages": self.packages, "relationships": self.relations}, indent=1) + "\n"

    def licences(self):
        text = "Copyright Treadmark contributors\n\nLicensed under the Apache License, Version 2.0: /usr/share/common-licenses/Apache-2.0.\n"
        if self.gpl:
            text += ("\nThis package as a whole is under the GNU General Public License, version 3 or later: /usr/share/common-licenses/GPL-3. It is\n"
                     "linked with FFTW or holds parts of CGAL.\n")
        text += "\nIt holds parts of\n" * bool(self.texts) + "".join(f"  {what}\n" for what, _ in self.texts)
        return text + "".join(f"\n{'-' * 78}\n{what}\n\n{licence.strip()}\n" for what, licence in self.texts)


def bill_of(control, root, build):
    name, plain = control["Package"], control["Package"].removesuffix("-gpl")
    bill, all_of_it = Bill(name, control["Version"]), not plain.startswith("treadmark-")
    # What report/pages hold stands in them uncompressed.
    scripts = all_of_it and any(b"three.js" in path.read_bytes() for path in root.rglob("*") if path.is_file() and path.suffix in ("", ".a", ".so"))
    locked = json.loads((ROOT / "report" / "web" / "package-lock.json").read_text())["packages"]
    for row, version, licence, shared, script in re.findall(r'\{"(.*?)", "(.*?)", "(.*?)", "(.*?)"(, true)?\}', (build / "app" / "version.cpp").read_text()):
        package, only_in = HEADERS.get(row, (None, None))
        if script and scripts:
            (text,) = [path for path in (build / "report" / "web" / "node_modules" / row).iterdir() if re.match(r"licen[cs]e(\.|$)", path.name, re.I)]
            digest = base64.b64decode(locked[f"node_modules/{row}"]["integrity"].removeprefix("sha512-")).hex()
            bill.add("CONTAINS", row, version, licence, f"pkg:npm/{row}@{version}", digest, text.read_text(encoding="utf-8"))
        elif package and (plain == only_in if only_in else all_of_it):
            bill.debian("CONTAINS", package, licence, row)
        if owner := output("dpkg-query", "-S", f"*/{shared}.so*").split(":")[0] if shared else package:
            LICENCES.setdefault(installed(owner)[0], licence)
    for path in sorted(root.glob("usr/lib/treadmark/fmu/licenses/*.txt")):
        if path.stem == "LICENSE-FMI":
            bill.add("CONTAINS", "Functional Mock-up Interface", "3.0", "BSD-2-Clause", text=path.read_text())
        else:
            bill.debian("CONTAINS", path.stem, name=f"{path.stem} in FMUs", text=f"See /{path.relative_to(root)}.")
    for what, (package, licence) in SITE.items() if plain == "treadmark-doc" else ():
        bill.debian("CONTAINS", package, licence, what)
    for package in dict.fromkeys(re.findall(r"(?:^|, )([a-z0-9][a-z0-9+.-]+)", control.get("Depends", ""))):
        if re.match(r"(lib|python3-)?treadmark", package):
            bill.add("DEPENDS_ON", package, control["Version"], "GPL-3.0-or-later" if package.endswith("-gpl") else "Apache-2.0")
        else:
            bill.debian("DYNAMIC_LINK" if re.match(r"lib.*(?<!-dev)$", package) else "DEPENDS_ON", package)
    return bill


def finish(deb, root, build, target, epoch):
    output("dpkg-deb", "-R", deb, root)
    control_file = root / "DEBIAN" / "control"
    control = dict(re.findall(r"^(\S+): (.*)$", control_file.read_text(), re.M))
    name, debug = control["Package"], control["Package"].endswith("-dbgsym")
    for archive in root.rglob("*.a"):
        output("strip", "--strip-debug", "--enable-deterministic-archives", archive)
    if not debug:
        bill, place = bill_of(control, root, build), root / "usr" / "share" / "doc" / name
        (place / f"{name}.spdx.json").write_text(bill.json(epoch))
        (place / "copyright").write_text(bill.licences(), encoding="utf-8")
    files = sorted(path for path in (root / "usr").rglob("*") if path.is_file() and not path.is_symlink())
    (root / "DEBIAN" / "md5sums").write_text("".join(f"{hashlib.md5(path.read_bytes()).hexdigest()}  {path.relative_to(root)}\n" for path in files))
    size = sum(-(-path.stat().st_size // 1024) for path in files)
    control_file.write_text(re.sub(r"^Installed-Size: .*$", f"Installed-Size: {size}", control_file.read_text(), flags=re.M))
    for path in root.rglob("*"):
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() or (path.stat().st_mode & 0o100 and not debug) else 0o644)
    output("dpkg-deb", "--root-owner-group", "-Zxz", "--threads-max=1", "-b", root, target / f"{deb.stem}.deb")


def main():
    build, target = (pathlib.Path(name).resolve() for name in sys.argv[1:])
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    for deb in sorted([*build.glob("*.deb"), *build.glob("*.ddeb")]):
        with tempfile.TemporaryDirectory() as work:
            finish(deb, pathlib.Path(work) / "root", build, target, int(os.environ["SOURCE_DATE_EPOCH"]))


if __name__ == "__main__":
    main()
