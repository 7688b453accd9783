#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The headers that docs/public-headers.md lists must exist, be installed and say what they are for, and programs that are written
like those of users (examples, the consumer of the installed package, program text in documents) must need no others.
That they compile from an installed package, whatever is included before, is held by tests/consumer.

usage: check_public_headers.py ROOT
"""
import pathlib
import re
import sys


def installed_folders(root):
    """Folders whose headers are installed: those of treadmark_library and its ROOMS."""
    folders = set()
    tops = [path for path in root.iterdir() if path.is_dir() and not re.match(r"tests$|build|out|\.", path.name)]
    for path in (path for top in tops for path in top.rglob("CMakeLists.txt")):
        for folder, rest in re.findall(r"treadmark_library\((\S+)([^)]*)\)", path.read_text()):
            rooms = re.search(r"\bROOMS((?:\s+[a-z_/]+)+)", rest)
            folders |= {folder} | {f"{folder}/{room}" for room in (rooms.group(1).split() if rooms else [])}
    return folders


def check(root):
    text = (root / "docs/public-headers.md").read_text()
    rows = re.findall(r"^\| `([^`]+\.hpp)` \| *(.*?) *\|$", text, re.M)
    headers = [name for name, _ in rows]
    folders = installed_folders(root)
    if not headers:
        yield "docs/public-headers.md lists no headers"
    for name, purpose in rows:
        if not (root / name).exists():
            yield f"{name} does not exist"
        if name.rsplit("/", 1)[0] not in folders:
            yield f"{name} is not installed: its folder is that of no treadmark_library"
        if not purpose:
            yield f"{name}: what is it for?"
        if headers.count(name) > 1:
            yield f"{name} is listed twice"
    programs = [*root.glob("examples/*.cpp"), *root.glob("tests/consumer/project/*.?pp"), root / "README.md", *root.glob("docs/*.md")]
    for program in programs:
        for name in re.findall(r'#include "treadmark/([^"<>]+)"', program.read_text()):
            if name not in headers:
                yield f"{program.relative_to(root)} needs {name}, which is no public header"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    violations = list(check(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(violations) or "the list of public headers is right")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
