#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Finishes the packages that CPack has made: licences and a bill of materials (SPDX) of what each holds and needs, static libraries without
debug information, debug information in packages whose names apt takes, and bytes that depend on the contents alone.

usage: finish_packages.py BUILD FOLDER    BUILD/*.deb and *.ddeb, finished in FOLDER; $SOURCE_DATE_EPOCH is their time
"""
import base64
import datetime
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
WEB = ROOT / "report" / "web" / "package-lock.json"
OWN = re.compile(r"^(lib|python3-)?treadmark")
# Headers that are compiled into what the packages hold, and the Debian packages that they come from.
HEADERS = {"Eigen": "libeigen3-dev", "JSON for Modern C++": "nlohmann-json3-dev", "CLI11": "libcli11-dev", "nanoflann": "libnanoflann-dev",
           "CGAL": "libcgal-dev", "Boost": "libboost-dev", "OpenVDB": "libopenvdb-dev"}
ONLY_IN = {"CLI11": {"treadmark"}, "OpenVDB": {"treadmark-openvdb"}, "Boost": {"treadmark-openvdb"}}
SITE = [("Furo", "furo", "MIT"), ("Sphinx", "sphinx-common", "BSD-2-Clause")]  # style sheets and scripts of the documents
# By source package, beside those of the libraries in the program's own list.
LICENCES = {"glibc": "LGPL-2.1-or-later", "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1", "numpy": "BSD-3-Clause",
            "python3-defaults": "PSF-2.0", "boost-defaults": "BSL-1.0", "hwloc": "BSD-3-Clause"}


def output(*command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


def installed(package):
    """Source and version of a Debian package of this machine."""
    return output("dpkg-query", "-W", "-f", "${source:Package}\t${Version}", package).split("\t")


def libraries(build):
    """The rows of app/version.cpp: name, version, licence, shared library, whether it is a script."""
    rows = re.findall(r'\{"(.*?)", "(.*?)", "(.*?)", "(.*?)"(, true)?\}', (build / "app" / "version.cpp").read_text())
    for name, _, licence, shared, script in rows:
        owner = output("dpkg-query", "-S", f"*/{shared}.so*").split(":")[0] if shared else HEADERS.get(name)
        if owner and not script:
            LICENCES.setdefault(installed(owner)[0], licence)
    return rows


class Bill:
    """SPDX 2.3 of one package, and the texts that go with what it holds."""

    def __init__(self, name, version, licence):
        self.texts, self.packages, self.relations = [], [], []
        self.add("DESCRIBES", name, version, licence, copyright="Copyright Treadmark contributors")
        self.packages[0]["licenseDeclared"] = "Apache-2.0"

    def add(self, relation, name, version, licence, purl=None, digest=None, text=None, copyright="NOASSERTION"):
        own = {"SPDXID": "SPDXRef-" + re.sub("[^A-Za-z0-9.]", "-", name), "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION",
               "filesAnalyzed": False, "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": copyright}
        if purl:
            own["externalRefs"] = [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": purl}]
        if digest:
            own["checksums"] = [{"algorithm": "SHA512", "checksumValue": digest}]
        self.relations.append({"spdxElementId": self.packages[0]["SPDXID"] if self.packages else "SPDXRef-DOCUMENT",
                               "relationshipType": relation, "relatedSpdxElement": own["SPDXID"]})
        self.packages.append(own)
        if relation == "CONTAINS":
            self.texts.append((f"{name} {version} ({licence})", text))

    def debian(self, relation, package, licence=None, name=None, text=None):
        source, version = installed(package)
        self.add(relation, name or package, version, licence or LICENCES.get(source, "NOASSERTION"),
                 f"pkg:deb/debian/{package}@{urllib.parse.quote(version, safe='')}", text=text)

    def json(self, time):
        first = self.packages[0]
        name = f"{first['name']}-{first['versionInfo']}"
        return json.dumps({"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": name,
                           "documentNamespace": f"https://treadmark.invalid/spdx/{name}",
                           "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Organization: Treadmark contributors"]},
                           "packages": self.packages, "relationships": self.relations}, indent=1) + "\n"


def debian_text(package):
    return pathlib.Path(f"/usr/share/doc/{package}/copyright").read_text(encoding="utf-8")


def bill_of(control, root, build, rows):
    name, plain = control["Package"], control["Package"].removesuffix("-gpl")
    bill = Bill(name, control["Version"], "GPL-3.0-or-later" if plain != name else "Apache-2.0")
    whole = not plain.startswith("treadmark-")  # neither documents nor a module
    has_scripts = whole and any(b"three.js" in path.read_bytes() for path in root.rglob("*") if path.suffix in ("", ".a", ".so") and path.is_file())
    locked = json.loads(WEB.read_text())["packages"]
    for row, version, licence, shared, script in rows:
        if script:
            if has_scripts:
                folder = build / "report" / "web" / "node_modules" / row
                (text,) = [path for path in folder.iterdir() if re.match(r"licen[cs]e(\.|$)", path.name, re.I)]
                digest = base64.b64decode(locked[f"node_modules/{row}"]["integrity"].removeprefix("sha512-")).hex()
                bill.add("CONTAINS", row, version, licence, f"pkg:npm/{row}@{version}", digest, text.read_text(encoding="utf-8"))
        elif row in HEADERS and (plain in ONLY_IN[row] if row in ONLY_IN else whole):
            bill.debian("CONTAINS", HEADERS[row], licence, row, None if row == "Boost" else debian_text(HEADERS[row]))  # Boost asks for none in programs
    fmu = root / "usr" / "lib" / "treadmark" / "fmu" / "licenses"
    if fmu.exists():
        bill.add("CONTAINS", "Functional Mock-up Interface", "3.0", "BSD-2-Clause", text=(fmu / "LICENSE-FMI.txt").read_text())
        for path in sorted(fmu.glob("lib*.txt")):
            bill.debian("CONTAINS", path.stem, name=f"{path.stem} in FMUs", text=f"See /{path.relative_to(root)}.\n")
    if plain == "treadmark-doc":
        for what, package, licence in SITE:
            bill.debian("CONTAINS", package, licence, what, debian_text(package))
    for package in dict.fromkeys(re.findall(r"(?:^|, )([a-z0-9][a-z0-9+.-]+)", control.get("Depends", ""))):
        if OWN.match(package):
            bill.add("DEPENDS_ON", package, control["Version"], "GPL-3.0-or-later" if package.endswith("-gpl") else "Apache-2.0")
        else:
            bill.debian("DYNAMIC_LINK" if re.match(r"lib.*\d", package) and not package.endswith("-dev") else "DEPENDS_ON", package)
    return bill


def copyright_of(name, bill):
    text = f"{name}: Copyright Treadmark contributors\n\nLicensed under the Apache License, Version 2.0: /usr/share/common-licenses/Apache-2.0.\n"
    if name.endswith("-gpl"):
        text += ("\nThis package as a whole is under the GNU General Public License, version 3 or later (/usr/share/common-licenses/GPL-3), for it is\n"
                 "linked with FFTW or holds parts of CGAL.\n")
    if bill.texts:
        text += "\nIt holds parts of\n" + "".join(f"  {what}\n" for what, _ in bill.texts)
    return text + "".join(f"\n{'-' * 78}\n{what}\n\n{licence.strip()}\n" for what, licence in bill.texts if licence)


def finish(deb, folder, build, rows, time):
    with tempfile.TemporaryDirectory() as work:
        root = pathlib.Path(work) / "root"
        output("dpkg-deb", "-R", deb, root)
        control_file = root / "DEBIAN" / "control"
        control = dict(re.findall(r"^(\S+): (.*)$", control_file.read_text(), re.M))
        name = control["Package"]
        for archive in root.rglob("*.a"):
            output("strip", "--strip-debug", "--enable-deterministic-archives", archive)
        if not name.endswith("-dbgsym"):
            bill, place = bill_of(control, root, build, rows), root / "usr" / "share" / "doc" / name
            place.mkdir(parents=True, exist_ok=True)
            (place / f"{name}.spdx.json").write_text(bill.json(time))
            (place / "copyright").write_text(copyright_of(name, bill), encoding="utf-8")
        files = sorted(path for path in (root / "usr").rglob("*") if path.is_file() and not path.is_symlink())
        sums = "".join(f"{hashlib.md5(path.read_bytes()).hexdigest()}  {path.relative_to(root)}\n" for path in files)
        (root / "DEBIAN" / "md5sums").write_text(sums)
        size = sum(-(-path.stat().st_size // 1024) for path in files)
        control_file.write_text(re.sub(r"^Installed-Size: .*$", f"Installed-Size: {size}", control_file.read_text(), flags=re.M))
        for path in root.rglob("*"):
            if not path.is_symlink():
                path.chmod(0o755 if path.is_dir() or (path.stat().st_mode & 0o100 and not name.endswith("-dbgsym")) else 0o644)
                os.utime(path, (time.timestamp(), time.timestamp()))
        output("dpkg-deb", "--root-owner-group", "-Zxz", "--threads-max=1", "-b", root, folder / f"{deb.stem}.deb")


def main():
    build, folder = (pathlib.Path(name).resolve() for name in sys.argv[1:])
    time = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    rows = libraries(build)
    for deb in sorted([*build.glob("*.deb"), *build.glob("*.ddeb")]):
        finish(deb, folder, build, rows, time)
        deb.unlink()


if __name__ == "__main__":
    main()
