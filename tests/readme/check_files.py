#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Checks that the files and folders that the documents name exist. Prints a line a violation; exit status 1 when there is one.

usage: check_files.py ROOT

Documents are README.md, CONTRIBUTING.md, docs/*.md and the README.md of every folder. What they name in back-quotes:
  a path with a slash, of a source, document or case file, or below a main folder: from the root (also with treadmark/ before
  it), from the document's folder, or, in the documents at the root and in docs/, from a folder of solvers/;
  the name of a header or source alone: somewhere below the document's folder, or below the root if that is docs/.
`a/b.*` and `a/b` may also mean a/b.hpp; braces stand for each of their parts; with < > * in it a name must fit some file. Capitals before
a slash (FOLDER/...) stand for what the reader chooses.
What they link to must exist, too. Program text between fences is not looked at.
"""
import itertools
import pathlib
import re
import sys

ENDINGS = r"hpp|cpp|md|py|toml|sh|cmake|def|ts|json"
FILE = re.compile(rf"[\w.<>*{{}},/-]+\.({ENDINGS}|\*)")
PATH = re.compile(r"[\w.<>*{},/-]+/[\w.<>*{},/-]*")
CODE = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^)#: ]+)(?:#[^)]*)?\)")
SKIPPED = re.compile(r"(\.git|\.cache|__pycache__|node_modules)$")
SKIPPED_AT_ROOT = re.compile(r"(build|out)")  # as in .gitignore


def folders(folder, at_root=True):
    yield folder
    for path in sorted(folder.iterdir()):
        if path.is_dir() and not path.is_symlink() and not SKIPPED.match(path.name) and not (
                at_root and SKIPPED_AT_ROOT.match(path.name)):
            yield from folders(path, False)


def documents(root):
    yield from (root / name for name in ("README.md", "CONTRIBUTING.md") if (root / name).exists())
    yield from sorted((root / "docs").glob("*.md"))
    yield from (folder / "README.md" for folder in folders(root) if folder != root and (folder / "README.md").exists())


def meant(name):
    """The names that a name with braces stands for."""
    parts = re.split(r"\{([^{}]*)\}", name)
    choices = [part.split(",") if i % 2 else [part] for i, part in enumerate(parts)]
    return ["".join(choice) for choice in itertools.product(*choices)]


def exists(place, name):
    name = re.sub(r"<[^<>]*>", "*", name.rstrip("/"))
    spellings = [name, name + ".hpp"]
    if "*" in name:
        return any(next(place.glob(spelling), None) for spelling in spellings)
    return any((place / spelling).exists() for spelling in spellings)


def check(root):
    """All violations, as texts "document: what"."""
    tops = {path.name for path in root.iterdir() if path.is_dir() and not SKIPPED_AT_ROOT.match(path.name)}
    sources = [path for folder in folders(root) for path in folder.iterdir() if path.suffix in (".hpp", ".cpp")]
    violations, named = [], 0
    for document in documents(root):
        folder, title = document.parent, document.relative_to(root).as_posix()
        general = folder in (root, root / "docs")
        places = [root, folder]
        if general:
            places += [root / "solvers", root / "solvers" / "kalker", root / "solvers" / "wheelrail"]
        text = re.sub(r"^\s*```.*?^\s*```", "", document.read_text(), flags=re.S | re.M)
        for name in CODE.findall(text):
            if "//" in name or re.match(r"/|-|[A-Z]+/", name) or not (FILE.fullmatch(name) or PATH.fullmatch(name)):
                continue
            if "/" in name:
                name = name.removeprefix("treadmark/")
                if not FILE.fullmatch(name) and name.split("/")[0] not in tops and not (name.endswith("/") and not general):
                    continue
                named += 1
                if not all(any(exists(place, one) for place in places) for one in meant(name)):
                    violations.append(f"{title}: no {name}")
            elif re.fullmatch(r"[\w{},]+\.(hpp|cpp)", name):
                named += 1
                below = root if general else folder
                for one in meant(name):
                    if not any(path.name == one and path.is_relative_to(below) for path in sources):
                        violations.append(f"{title}: no {one} below {below.relative_to(root).as_posix()}")
        for target in LINK.findall(text):
            named += 1
            if not (folder / target).exists():
                violations.append(f"{title}: links to {target}, which does not exist")
    if not named:
        violations.append("no document names a file")
    return violations


def main():
    if len(sys.argv) != 2 or not (pathlib.Path(sys.argv[1]) / "core").is_dir():
        sys.exit(__doc__)
    violations = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(violations) or "all files that the documents name are there")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
