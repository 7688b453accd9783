#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Checks that the scripts of reports are made of known bytes: packages of the registry by version and SHA-512, none of whose scripts run.

usage: check_packages.py ROOT

Prints a line a violation; exit status 1 when there is one. Bundled are the dependencies of package.json with what they depend on; all
others only build and test.
"""
import json
import pathlib
import re
import sys

VERSION = re.compile(r"\d+\.\d+\.\d+")
DIGEST = re.compile(r"sha512-[A-Za-z0-9+/]{86}==")
BUNDLED_LICENCES = {"ISC", "MIT", "BSD-2-Clause", "BSD-3-Clause", "Apache-2.0"}  # each text stands in every report


def check(package, lock, rules, notice):
    """All violations of package.json, package-lock.json (both parsed), the CMake rules that call npm and NOTICE (texts)."""
    found = []
    noted = {name: licence for names, licence in re.findall(r"([^()]*)\(([^()]*)\)", notice) for name in re.split(r"[\s,]+", names)}
    for kind in ("dependencies", "devDependencies"):
        wanted = package.get(kind, {})
        found += [f"package.json: {name} is not pinned to one version" for name, version in wanted.items() if not VERSION.fullmatch(version)]
        if lock["packages"][""].get(kind, {}) != wanted:
            found.append(f"package-lock.json: its {kind} are not those of package.json")
    for place, entry in lock["packages"].items():
        if not place:
            continue
        if not DIGEST.fullmatch(entry.get("integrity", "")):
            found.append(f"package-lock.json: {place} has no SHA-512")
        if "resolved" in entry:  # the registry is whoever builds chooses; the bytes are the same
            found.append(f"package-lock.json: {place} comes from {entry['resolved']}")
        if not entry.get("dev") and entry.get("license") not in BUNDLED_LICENCES:
            found.append(f"package-lock.json: {place} is bundled under {entry.get('license')}")
        elif not entry.get("dev") and noted.get(place.removeprefix("node_modules/")) != entry["license"]:
            found.append(f"NOTICE: {place} is not named with its licence, {entry['license']}")
    for call in re.findall(r"\"\$\{TREADMARK_NPM\}\"(.*)", rules):
        if " ci " not in call or "--ignore-scripts" not in call:
            found.append(f"assets.cmake: npm is called with{call}")
    return found


def main():
    web = pathlib.Path(sys.argv[1]) / "report" / "web"
    package, lock = (json.loads((web / name).read_text()) for name in ("package.json", "package-lock.json"))
    found = check(package, lock, (web.parent / "assets.cmake").read_text(), (web.parent.parent / "NOTICE").read_text())
    print("\n".join(found) or f"{len(lock['packages']) - 1} packages, each with its digest")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
