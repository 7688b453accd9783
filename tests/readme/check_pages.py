#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Pages of docs/ begin with what they are for and one command, stand in the index, and the glossary and the page of symbols name what there is;
README.md fits on a screen.

usage: check_pages.py ROOT
- README.md: at most 60 lines of 100 characters, with both commands that set everything up;
- docs/*.md: a title, a paragraph, then a block of one command, or of a program, within the first 12 lines; a link to it in docs/index.md;
- what docs/index.md lists below How-to: its last section is what can go wrong;
- docs/glossary.md, docs/symbols.md: what they put in back-quotes stands in another document, too;
- CMakeLists.txt, CITATION.cff, the package for Python and the newest section of CHANGELOG.md have one version (and date); entries of that section have one line.
"""
import pathlib
import re
import sys

LINES, WIDTH = 60, 100
SET_UP = ("bash scripts/main-job.sh", "bash scripts/test.sh")
GLOSSARIES = ("glossary.md", "symbols.md")


def wrong_readme(text):
    lines = text.splitlines()
    if len(lines) > LINES:
        yield f"README.md has {len(lines)} lines, more than {LINES}"
    for number, line in enumerate(lines, 1):
        if len(line) > WIDTH and not line.startswith("<img"):
            yield f"README.md:{number}: more than {WIDTH} characters"
    for command in SET_UP:
        if command not in text:
            yield f"README.md lacks the command {command}"


def wrong_beginning(name, text):
    found = re.match(r"# [^\n]+\n\n((?:[^\n#`|]|`[^`])[^\n]*\n)+\n```(\w*)\n(.*?)```", text, re.DOTALL)
    if not found:
        yield f"{name} does not begin with a title, what it is for and a command"
        return
    if text[: found.end()].count("\n") > 12 and not found[2]:
        yield f"{name}: its first command stands below line 12"
    if not found[2] and len(found[3].strip().splitlines()) != 1:
        yield f"{name}: its first block has more than one command"


def wrong_ends(index, pages):
    listed = re.search(r"^## How-to\n\n((?:- .*\n)+)", index, re.MULTILINE)
    for name in re.findall(r"\]\(([\w-]+\.md)\)", listed[1]) if listed else []:
        if re.findall(r"^## (.*)$", pages.get(name, ""), re.MULTILINE)[-1:] != ["What can go wrong"]:
            yield f"docs/{name} does not end with what can go wrong"


def wrong_words(name, text, others):
    for words in re.findall(r"`([^`\n]+)`", re.sub(r"```.*?```", "", text, flags=re.DOTALL)):
        if words not in others:
            yield f"{name} names {words}, which no other document does"


def wrong_versions(root):
    patterns = {"CMakeLists.txt": r"project\(Treadmark VERSION ([\d.]+)", "CITATION.cff": r"^version: ([\d.]+)", "CHANGELOG.md": r"^## ([\d.]+)"}
    found = {name: re.search(pattern, (root / name).read_text(), re.MULTILINE) for name, pattern in patterns.items()}
    versions = {name: match[1] if match else "none" for name, match in found.items()}
    if len(set(versions.values())) != 1:
        yield "versions differ: " + ", ".join(f"{name} {version}" for name, version in versions.items())
    dates = [re.search(pattern, (root / name).read_text(), re.MULTILINE) for name, pattern in
             (("CHANGELOG.md", r"^## [\d.]+ \(([\d-]+)\)"), ("CITATION.cff", r"^date-released: ([\d-]+)"))]
    if not all(dates) or dates[0][1] != dates[1][1]:
        yield "CHANGELOG.md and CITATION.cff have not the same date"
    newest = re.split(r"^## ", (root / "CHANGELOG.md").read_text(), flags=re.MULTILINE)[1]
    for line in newest.splitlines()[1:]:
        if line and not re.match(r"### (Added|Changed|Fixed)$|- \S", line):
            yield f"CHANGELOG.md: neither Added, Changed, Fixed nor an entry of one line: {line[:60]}"


def problems(root):
    yield from wrong_readme((root / "README.md").read_text())
    yield from wrong_versions(root)
    index = (root / "docs/index.md").read_text()
    pages = {page.name: page.read_text() for page in sorted((root / "docs").glob("*.md"))}
    others = "".join(text for name, text in pages.items() if name not in GLOSSARIES)
    others += (root / "core/README.md").read_text()
    yield from wrong_ends(index, pages)
    for name, text in pages.items():
        yield from wrong_beginning(f"docs/{name}", text)
        if name != "index.md" and f"]({name})" not in index:
            yield f"docs/{name} is not in docs/index.md"
        if name in GLOSSARIES:
            yield from wrong_words(f"docs/{name}", text, others)


if __name__ == "__main__":
    found = list(problems(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
