#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Makes the pictures and measured tables of docs/ again, by the commands that their pages name, and shows what moved.
#   scripts/refresh-figures.sh [--list] [PATTERN]
# A page says in a comment how a picture is made: <!-- renew FILE: COMMAND -->, FILE from docs/ on, a pattern or "tables"; or
# <!-- by hand: FILE -->. Commands run in the checkout, with the program as treadmark on the path, its file in $PROGRAM (default
# build/release/app/treadmark) and an empty folder in $OUT. PATTERN (extended regular expression) picks some of them. Times are
# measured on this machine: run it idle.
# --list: prints the commands and does not run them; exit status 1 where a picture of a page has none.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
PROGRAM=${PROGRAM:-$root/build/release/app/treadmark}
export PROGRAM
exec python3 - "$@" <<'PYTHON'
import fnmatch
import os
import pathlib
import re
import subprocess
import sys
import tempfile

words = sys.argv[1:]
listed = "--list" in words
pattern = next((word for word in words if word != "--list"), "")
pages = [pathlib.Path("README.md"), *sorted(pathlib.Path("docs").glob("*.md"))]

texts = {page: page.read_text() for page in pages}
commands = {}  # files by command
made = []  # patterns of what has one, or is drawn by hand
for text in texts.values():
    for files, command in re.findall(r"<!-- renew ([^:]+): (.*?) -->", text, re.DOTALL):
        commands.setdefault(" ".join(command.split()), set()).update(files.split())
        made += files.split()
    for files in re.findall(r"<!-- by hand: (.*?) -->", text, re.DOTALL):
        made += files.split()
bare = []
for page, text in texts.items():
    for source in re.findall(r'<img src="([^"]+)"|!\[[^\]]*\]\(([^)]+)\)', text):
        picture = (page.parent / (source[0] or source[1])).as_posix()
        if picture.startswith("docs/") and not any(fnmatch.fnmatch(picture.removeprefix("docs/"), name) for name in made):
            bare.append(f"{page}: no page says how {picture} is made")

if listed:
    for command, files in commands.items():
        print(f"{' '.join(sorted(files))}: {command}")
    print("\n".join(bare), file=sys.stderr)
    sys.exit(1 if bare else 0)

program = pathlib.Path(os.environ["PROGRAM"])
if not os.access(program, os.X_OK):
    sys.exit(f"no program at {program}: build the target treadmark_cli, or name it in PROGRAM")
failed = []
with tempfile.TemporaryDirectory() as folder:
    # the name treadmark, whatever the program's file is called
    (pathlib.Path(folder) / "bin").mkdir()
    (pathlib.Path(folder) / "bin" / "treadmark").symlink_to(program)
    path = f"{folder}/bin:{os.environ['PATH']}"
    for number, (command, files) in enumerate(commands.items()):
        if not re.search(pattern, command + " " + " ".join(files)):
            continue
        out = pathlib.Path(folder) / str(number)
        out.mkdir()
        print(f"$ {command}", file=sys.stderr)
        if subprocess.run(["bash", "-euo", "pipefail", "-c", command], env={**os.environ, "PATH": path, "OUT": str(out)},
                          stdout=subprocess.DEVNULL).returncode:
            failed.append(command)

# What moved: lines of pages word by word, and of pictures their words and numbers.
moved = subprocess.run(["git", "diff", "--name-only", "--", "docs", "README.md"], stdout=subprocess.PIPE, text=True).stdout.split()
for name in moved:
    before = subprocess.run(["git", "show", f"HEAD:{name}"], stdout=subprocess.PIPE, text=True, errors="replace").stdout
    if name.endswith(".svg"):
        old, new = (re.findall(r">([^<>]*\w[^<>]*)<", text) for text in (before, pathlib.Path(name).read_text()))
        texts = [f"  {a} -> {b}" for a, b in zip(old, new) if a != b]
        print(f"{name}: " + (f"{len(texts)} of its {len(new)} texts" if len(old) == len(new) else f"{len(new)} texts instead of {len(old)}"))
        print("\n".join(texts[:10] if len(old) == len(new) else []))
    else:
        print(f"{name}:")
        subprocess.run(["git", "--no-pager", "diff", "--unified=0", "--word-diff=plain", "--", name])
if not moved:
    print("nothing moved")
for command in failed:
    print(f"failed: {command}", file=sys.stderr)
sys.exit(1 if failed else 0)
PYTHON
