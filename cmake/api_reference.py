#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Makes the reference of the public headers with Doxygen. Prints what their comments lack; exit status 1 if anything.

usage: api_reference.py DOXYGEN DOXYFILE
       api_reference.py --filter FILE     a header or document as Doxygen reads it

Where Doxygen was not found (DOXYGEN ends with NOTFOUND) the exit status is 77, with CI=true 1.

Everything public says what it is, except members of plain data that are no numbers and whose name and type say it
(Material material), and operators that do what they do with numbers. A number always says its unit or what it counts.
"""
import os
import pathlib
import re
import subprocess
import sys

DECLARATION = re.compile(r"^(\s*)((?:inline |constexpr |static |const )*[A-Za-z_][\w:]*(?:<[^;=]*>)? )(\w+[^;]*,[^;]*);(.*)$")
UNDOCUMENTED = re.compile(r"^(?P<place>.*?:\d+): (?:warning|error): (?P<what>(?:Member|Compound) .* is not documented\.)$")
VARIABLE = re.compile(r"Member \S+ \(variable\) of")
IN_LINE_WITH_NUMBERS = re.compile(r"Member (operator(==|\+=|=)|(\w+)\(\3 ?&&)")  # compares, adds, assigns, moves: what it says
NUMBER = re.compile(r"\b(double|float|int|long|size_t|SixValues|Vec2|Vec3)\b")


def split_list(text):
    """The parts of a list, at its commas outside of brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "({[<") - (letter in ")}]>")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def filtered(text):
    """What Doxygen would take otherwise than it is meant. Several members in one declaration become one declaration each, in
    the same line, since it gives their comment to one only; a comment that an empty line follows is about what comes after it
    in general, not about the next declaration alone, and is taken out."""
    lines, before = text.split("\n"), []
    for i, line in enumerate(lines):
        stripped = line.strip()
        if stripped.startswith("///") and not stripped.startswith("///<"):
            before.append(i)
            continue
        if not stripped:
            for k in before:
                lines[k] = ""
        found = DECLARATION.match(line)
        if found and "(" not in found.group(3).split("=")[0]:
            space, kind, names, rest = found.groups()
            own = [rest.strip()] if "///<" in rest else []
            while own and i + len(own) < len(lines) and lines[i + len(own)].strip().startswith("///<"):
                own.append(lines[i + len(own)].strip())
            for k in range(1, len(own)):
                lines[i + k] = ""
            said = " ".join(part.removeprefix("///<").strip() for part in own or (lines[k].strip()[3:] for k in before))
            parts = split_list(names)
            if len(parts) > 1 and said:
                text_after = [f" /**< {said} */" if own or k > 0 else "" for k in range(len(parts))]
                lines[i] = space + " ".join(f"{kind}{part};{after}" for part, after in zip(parts, text_after))
        before = []
    return "\n".join(lines)


def lacking(warnings):
    """Of Doxygen's warnings those that count."""
    for warning in warnings:
        found = UNDOCUMENTED.match(warning)
        if found and VARIABLE.search(found["what"]):
            file, number = found["place"].rsplit(":", 1)
            line = pathlib.Path(file).read_text().split("\n")[int(number) - 1]
            if not NUMBER.search(line.split("=")[0]):
                continue
        if found and IN_LINE_WITH_NUMBERS.search(found["what"]):
            continue
        yield warning


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    if sys.argv[1] == "--filter":
        path = pathlib.Path(sys.argv[2])
        text = path.read_text()
        if path.suffix == ".md":  # of the documents only this one is part of the reference: links to others stay words
            text = re.sub(r"\[([^]\n]*)\]\([^)\n]*\)", r"\1", text)
        elif path.suffix == ".hpp":
            text = filtered(text)
        print(text, end="")
        return 0
    if sys.argv[1].endswith("NOTFOUND"):
        print("Doxygen was not found: install the Debian package doxygen")
        return 1 if os.environ.get("CI") == "true" else 77
    settings = pathlib.Path(sys.argv[2]).read_text()
    log = pathlib.Path(re.search(r"^WARN_LOGFILE\s*=\s*(.+?)\s*$", settings, re.M).group(1))
    log.parent.mkdir(parents=True, exist_ok=True)
    log.write_text("")
    status = subprocess.run([sys.argv[1], sys.argv[2]], check=False).returncode
    left = list(lacking(line for line in log.read_text().split("\n") if line.strip()))
    print("\n".join(left) or "the public headers say what they should")
    return 1 if left or status else 0


if __name__ == "__main__":
    sys.exit(main())
