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

# What each may weigh [MB], and what it must hold below usr/; of others neither is asked.
NEEDED = {"treadmark": (40, ["bin/treadmark", "share/man/man1/treadmark.1", "share/doc/treadmark/examples/wheel-flat.toml"]),
          "libtreadmark0": (10, []),
          "libtreadmark-dev": (20, ["include/treadmark.h", "lib/pkgconfig/treadmark.pc", "lib/cmake/Treadmark/TreadmarkConfig.cmake"])}
# What no other package may need.
APART = {"treadmark-cad": "libocct-", "treadmark-openvdb": "libopenvdb|libboost-iostreams", "GPL": "libfftw3|libgmp|libmpfr|libcgal"}


def build_ids(files):
    for path in files:
        with path.open("rb") as file:
            if file.read(4) == b"\x7fELF":
                yield from re.findall(r"Build ID: ([0-9a-f]+)", subprocess.run(["readelf", "-n", path], capture_output=True, text=True).stdout)


def wrong_papers(name, depends, place):
    """Of licences and bill of materials."""
    try:
        licences, bill = (place / "copyright").read_text(), json.loads((place / f"{name}.spdx.json").read_text())
    except (OSError, ValueError) as error:
        yield f"no licence or bill of materials: {error}"
        return
    packages = {package["SPDXID"]: package for package in bill["packages"]}
    if len(packages) != len(bill["packages"]) or bill["spdxVersion"] != "SPDX-2.3":
        yield "its bill of materials is no SPDX 2.3 in which each has an identifier of its own"
    yield from (f"its bill of materials has no licence or version of {package['name']}" for package in packages.values()
                if "NOASSERTION" in (package["licenseConcluded"], package["versionInfo"]))
    relations = {packages[relation["relatedSpdxElement"]]["name"]: relation["relationshipType"] for relation in bill["relationships"]}
    yield from (f"its bill of materials leaves out {package}" for package in re.findall(r"(?:^|, )([a-z0-9][a-z0-9+.-]+)", depends)
                if package not in relations)
    yield from (f"its copyright leaves out {part}" for part, how in relations.items() if how == "CONTAINS" and f"\n  {part} " not in licences)
    if ("GNU General Public License" in licences.split("It holds parts of")[0]) != name.endswith("-gpl"):
        yield "its copyright and its name disagree about the GPL"


def wrong(deb, root, paths, debug):
    """All that is wrong with one package, unpacked at root. debug: the build ids of which there is debug information."""
    control = dict(re.findall(r"^(\S+): (.*)$", (root / "DEBIAN" / "control").read_text(), re.M))
    name, depends = control["Package"], control.get("Depends", "")
    plain = name.removesuffix("-gpl")
    files = [path for path in (root / "usr").rglob("*") if path.is_file() and not path.is_symlink()]
    if deb.name != f"{name}_{control['Version']}_{control['Architecture']}.deb":
        yield f"it is {name} {control['Version']}"
    yield from (f"{path.relative_to(root)} names {word}" for path in files for word in paths if word.encode() in path.read_bytes())
    if name.endswith("-dbgsym"):
        return
    most, held = NEEDED.get(plain, (1e3, []))
    if deb.stat().st_size > 1e6 * most:
        yield f"it has {deb.stat().st_size / 1e6:.1f} MB, more than {most}"
    yield from (f"it has no usr/{path}" for path in held if not (root / "usr" / path).exists())
    may = {plain, "GPL" if name != plain else ""}
    yield from (f"it needs {found[0]}" for apart, libraries in APART.items() if apart not in may and (found := re.search(libraries, depends)))
    of_its_own = (path for path in files if "fmu" not in path.relative_to(root).as_posix())
    yield from (f"no debug information of {number}" for number in build_ids(of_its_own) if number not in debug)
    yield from wrong_papers(name, depends, root / "usr" / "share" / "doc" / name)


def check(folder, paths=()):
    with tempfile.TemporaryDirectory() as work:
        roots = {deb: pathlib.Path(work) / deb.stem for deb in sorted(folder.glob("*.deb"))}
        for deb, root in roots.items():
            subprocess.run(["dpkg-deb", "-R", deb, root], check=True)
        names = {deb.name.split("_")[0].removesuffix("-gpl") for deb in roots}
        debug = {path.parent.name + path.stem for path in pathlib.Path(work).glob("*/usr/lib/debug/.build-id/*/*.debug")}
        return [f"no package {name}" for name in NEEDED if name not in names] + [
            f"{deb.name}: {line}" for deb, root in roots.items() for line in wrong(deb, root, paths, debug)]


if __name__ == "__main__":
    faults = check(pathlib.Path(sys.argv[1]), sys.argv[2:])
    print("\n".join(faults) or "packages: nothing wrong")
    sys.exit(1 if faults else 0)
