#!/usr/bin/env python3
"""Sorts include blocks as clang-format (Google, blocks preserved) does. usage: sort_includes.py FILE...; prints files whose other lines need clang-format: none."""
import pathlib, re, sys

def sort(path):
    lines = pathlib.Path(path).read_text().split("\n")
    out, i, first, main_found = [], 0, True, False
    stem = pathlib.Path(path).stem
    while i < len(lines):
        j = i
        while j < len(lines) and re.match(r"\s*#\s*include\b", lines[j]):
            j += 1
        if j == i:
            out.append(lines[i]); i += 1
            continue
        block = []
        for n, line in enumerate(lines[i:j]):
            name = re.search(r'[<"]([^>"]+)', line)[1]
            angled = "<" in line.split(name)[0]
            priority = (1 if name.endswith(".h") and not name.startswith("ext/") else 2) if angled else 3
            if not angled and first and not main_found and pathlib.Path(path).suffix == ".cpp" and re.fullmatch(re.escape(pathlib.PurePath(name).stem) + r"([-_](test|unittest))?", stem, re.I):
                priority, main_found = 0, True
            block.append((priority, ("<" if angled else '"') + name, n, line))
        seen = []
        for entry in sorted(block, key=lambda e: (e[0], e[1], e[2])):
            if entry[3] not in seen:
                seen.append(entry[3])
        out += seen
        first = False
        i = j
    new = "\n".join(out)
    if new != "\n".join(lines):
        pathlib.Path(path).write_text(new)
        return True

if __name__ == "__main__":
    for path in sys.argv[1:]:
        if sort(path): print(path)
