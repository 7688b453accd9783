# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Finds the commands `treadmark ...` in documents."""
import re
import shlex

COMMAND = re.compile(r"treadmark [a-z-][^`\n]*")


def pages_of(root):
    return [root / "README.md", *sorted((root / "docs").glob("*.md")), *sorted(root.glob("*/README.md"))]


def commands_of(text):
    """(line, words, whether in a block of code) of each command; lines that end with a backslash go on, comments and what the shell does with it end it."""
    code = []
    inside = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            inside = not inside
        elif inside:
            if code and code[-1][2] and code[-1][1].endswith("\\"):
                code[-1] = (code[-1][0], code[-1][1][:-1] + " " + line.strip(), True)
            else:
                code.append((number, line.strip().removeprefix("$ "), True))
        else:
            code += [(number, span, False) for span in re.findall(r"`([^`]+)`", line)]
    for number, line, block in code:
        for part in re.split(r"&&|\|\||[|;>]", line):
            found = COMMAND.search(part)
            if found and "import treadmark" not in part and re.search(r"(^|^mpirun .*|^srun .*|\s|/)$", part[: found.start()]):
                try:
                    yield number, shlex.split(found.group().split(" # ")[0].split("  #")[0]), block
                except ValueError:  # a quotation that the split above has cut
                    yield number, found.group().split(), block
