#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Checks packages for Debian: names, sizes, what they depend on and hold, licences, bills of materials, debug information.

usage: check_debs.py FOLDER [PATH...]    no file may hold a PATH, such as the folder where they were built

Prints a line a violation; exit status 1 when there is one.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

# What each may weigh [MB]; extras, Python and those with debug information as they are.
LIMITS = {"treadmark": 20, "libtreadmark0": 6, "treadmark-doc": 8}
NEEDED = {"treadmark", "libtreadmark0", "libtreadmark-dev"}
APART = {"treadmark-cad": r"libocct-", "treadmark-openvdb": r"libopenvdb|libboost-iostreams"}  # whose libraries no other may need
GPL = r"libfftw3|libgmp|libmpfr|libcgal"
# What goes with the first report, and where the debug information of a program lies.
HELD = {"treadmark": ["bin/treadmark", "share/man/man1/treadmark.1", "share/doc/treadmark/examples/wheel-flat.toml"],
        "libtreadmark-dev": ["include/treadmark.h", "lib/pkgconfig/treadmark.pc", "lib/cmake/Treadmark/TreadmarkConfig.cmake"],
        "treadmark-doc": ["share/doc/treadmark/html/index.html"]}


def output(*command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


def build_ids(files):
    for path in files:
        with path.open("rb") as file:
            if file.read(4) != b"\x7fELF":
                continue
        yield from re.findall(r"Build ID: ([0-9a-f]+)", subprocess.run(["readelf", "-n", path], capture_output=True, text=True).stdout)


def wrong_papers(name, control, root):
    """Of licences and bill of materials."""
    place = root / "usr" / "share" / "doc" / name
    try:
        copyright, bill = (place / "copyright").read_text(), json.loads((place / f"{name}.spdx.json").read_text())
    except (OSError, ValueError) as error:
        yield f"no licence or bill of materials: {error}"
        return
    packages = {package["SPDXID"]: package for package in bill["packages"]}
    if len(packages) != len(bill["packages"]) or bill["spdxVersion"] != "SPDX-2.3":
        yield "its bill of materials is no SPDX 2.3 with names of its own for all"
    for package in packages.values():
        if "NOASSERTION" in (package["licenseConcluded"], package["versionInfo"]):
            yield f"its bill of materials has no licence or version of {package['name']}"
    named = {packages[relation["relatedSpdxElement"]]["name"] for relation in bill["relationships"]}
    for package in re.findall(r"(?:^|, )([a-z0-9][a-z0-9+.-]+)", control.get("Depends", "")):
        if package not in named:
            yield f"its bill of materials leaves out {package}"
    for relation in bill["relationships"]:
        if relation["relationshipType"] == "CONTAINS" and f"  {packages[relation['relatedSpdxElement']]['name']} " not in copyright:
            yield f"its copyright leaves out {packages[relation['relatedSpdxElement']]['name']}"
    if ("GNU General Public License" in copyright.split("It holds parts of")[0]) != name.endswith("-gpl"):
        yield "its copyright and its name disagree about the GPL"


def wrong(deb, root, paths, debug):
    """All that is wrong with one package, unpacked at root. debug: the build ids of which there is debug information."""
    control = dict(re.findall(r"^(\S+): (.*)$", (root / "DEBIAN" / "control").read_text(), re.M))
    name, depends = control["Package"], control.get("Depends", "")
    plain = name.removesuffix("-gpl")
    files = [path for path in (root / "usr").rglob("*") if path.is_file() and not path.is_symlink()]
    if deb.name != f"{name}_{control['Version']}_{control['Architecture']}.deb":
        yield f"it is {name} {control['Version']}"
    for path in files:
        content = path.read_bytes()
        yield from (f"{path.relative_to(root)} names {word}" for word in paths if word.encode() in content)
    if name.endswith("-dbgsym"):
        return
    if deb.stat().st_size > 1e6 * LIMITS.get(plain, 1e3):
        yield f"it has {deb.stat().st_size / 1e6:.1f} MB, more than {LIMITS[plain]}"
    for apart, libraries in [*APART.items(), *([(None, GPL)] if plain == name else [])]:
        if apart != plain and re.search(libraries, depends):
            yield f"it needs {re.search(libraries, depends)[0]}"
    yield from (f"it has no usr/{held}" for held in HELD.get(plain, []) if not (root / "usr" / held).exists())
    fmu = root / "usr" / "lib" / "treadmark" / "fmu"
    yield from (f"no debug information of {number}" for number in build_ids(path for path in files if fmu not in path.parents) if number not in debug)
    yield from wrong_papers(name, control, root)


def check(folder, paths=()):
    debs, found = sorted(folder.glob("*.deb")), []
    names = {deb.name.split("_")[0] for deb in debs}
    for name in sorted(NEEDED - {name.removesuffix("-gpl") for name in names}):
        found.append(f"no package {name}")
    with tempfile.TemporaryDirectory() as work:
        roots = {deb: pathlib.Path(work) / deb.stem for deb in debs}
        for deb, root in roots.items():
            output("dpkg-deb", "-R", deb, root)
        debug = {path.parent.name + path.stem for path in pathlib.Path(work).glob("*/usr/lib/debug/.build-id/*/*.debug")}
        for deb, root in roots.items():
            found += [f"{deb.name}: {line}" for line in wrong(deb, root, paths, debug)]
    return found


if __name__ == "__main__":
    faults = check(pathlib.Path(sys.argv[1]), sys.argv[2:])
    print("\n".join(faults) or "packages: nothing wrong")
    sys.exit(1 if faults else 0)
