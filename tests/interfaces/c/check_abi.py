#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The binary interface of treadmark.h and its library against the list that is kept: what stood there must still be there, as it was
(docs/compatibility.md).

usage: check_abi.py HEADER LIBRARY LIST [--write]
A line of the list: a function with its types, a type, an enumerator with its value, or a name with its unit that can be asked for.
--write adds what is new; it neither removes nor changes a line.
"""
import ctypes
import pathlib
import re
import subprocess
import sys

TABLES = ("case", "solution", "patch", "field", "motion", "force")


def bare(parameter):
    """Type of a parameter; its name is nobody's business."""
    parameter = " ".join(parameter.split())
    if parameter in ("void", "...", ""):
        return parameter
    return re.sub(r"\b(\w+)(\[\d*\])?$", r"\2", parameter).strip() if re.search(r"[\s*]\w+(\[\d*\])?$", parameter) else parameter


def of_header(text):
    text = re.sub(r"/\*.*?\*/|^\s*#[^\n]*(\\\n[^\n]*)*", " ", text, flags=re.DOTALL | re.MULTILINE)
    for result, name, parameters in re.findall(r"TM_API\s+([\w\s*]+?)\s*\b(\w+)\(([^;]*)\);", text):
        yield f"function {' '.join(result.split())} {name}({', '.join(bare(p) for p in parameters.split(','))})"
    for result, name, parameters in re.findall(r"typedef\s+([\w\s*]+?)\s*\(\*(\w+)\)\(([^;]*)\);", text):
        yield f"callback {' '.join(result.split())} {name}({', '.join(bare(p) for p in parameters.split(','))})"
    for name in re.findall(r"typedef struct \w+ (\w+);", text):
        yield f"type {name}"
    for enumerators, name in re.findall(r"typedef enum \w+ \{([^}]*)\} (\w+);", text):
        for enumerator, value in re.findall(r"(\w+) = (\d+)", enumerators):
            yield f"enumerator {name} {enumerator} = {value}"
    for name, members in re.findall(r"struct (\w+) \{([^}]*)\}", text):
        yield f"layout {name} {' '.join(members.split())}"


def of_library(path):
    dynamic = subprocess.run(["readelf", "-d", path], capture_output=True, text=True, check=True).stdout
    yield "soname " + re.search(r"SONAME.*?\[(.*?)\]", dynamic)[1]
    library = ctypes.CDLL(path)
    name, unit, meaning = ctypes.c_char_p(), ctypes.c_char_p(), ctypes.c_char_p()
    for table, word in enumerate(TABLES):
        i = 0
        while library.tm_list(table, ctypes.c_size_t(i), ctypes.byref(name), ctypes.byref(unit), ctypes.byref(meaning)) == 0:
            yield f"{word} {name.value.decode()} [{unit.value.decode()}]"
            i += 1


def check(kept, there):
    """(what is gone or changed, what is new)"""
    kept, there = set(kept), set(there)
    return sorted(kept - there), sorted(there - kept)


def main(header, library, list_file, write):
    path = pathlib.Path(list_file)
    kept = [line for line in path.read_text().splitlines() if line and not line.startswith("#")] if path.exists() else []
    there = [*of_header(pathlib.Path(header).read_text()), *of_library(library)]
    assert len(there) > 100, there
    gone, new = check(kept, there)
    for line in gone:
        print(f"gone or changed: {line}")
    if new and write:
        lines = sorted([*kept, *new])
        path.write_text("# What treadmark.h and its library promise: tests/interfaces/c/check_abi.py --write adds to it.\n" + "\n".join(lines) + "\n")
    elif new:
        print("\n".join(f"new, not in the list (--write adds it): {line}" for line in new))
    return 1 if gone or (new and not write) else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:4], "--write" in sys.argv[4:]))
