#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The C++ program in docs/cpp.md must be the body of examples/first_contact.cpp, the C++ in docs/write-a-backend.md must be
parts of the program in tests/consumer/project, and every file the two link to must exist."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
readme = (root / "README.md").read_text()
program = (root / "docs" / "cpp.md").read_text()
example = (root / "examples" / "first_contact.cpp").read_text()

shown = re.search(r"```cpp\n(.*?)```", program, re.S)
failed = False
if not shown or shown.group(1).strip() not in example:
    print("docs/cpp.md does not show examples/first_contact.cpp as it is")
    failed = True
guide = (root / "docs" / "write-a-backend.md").read_text()
backend = "".join(path.read_text() for path in sorted((root / "tests/consumer/project").glob("*.cpp")))
parts = re.findall(r"```cpp\n(.*?)```", guide, re.S)
for part in parts:
    if part not in backend:
        print(f"docs/write-a-backend.md shows what is not in tests/consumer/project:\n{part}")
        failed = True
failed = failed or not parts
for name, folder, text in (("README.md", root, readme), ("docs/cpp.md", root / "docs", program), ("docs/write-a-backend.md", root / "docs", guide)):
    for target in re.findall(r"\]\(([^)#:]+)\)", text) + re.findall(r'src="([^":]+)"', text):
        if not (folder / target).exists():
            print(f"{name} links to {target}, which does not exist")
            failed = True
sys.exit(1 if failed else 0)
