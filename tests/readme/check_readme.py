#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The C++ program in README.md must be the body of examples/first_contact.cpp, and every file it links to must exist."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
readme = (root / "README.md").read_text()
example = (root / "examples" / "first_contact.cpp").read_text()

shown = re.search(r"```cpp\n(.*?)```", readme, re.S)
failed = False
if not shown or shown.group(1).strip() not in example:
    print("README.md does not show examples/first_contact.cpp as it is")
    failed = True
for target in re.findall(r"\]\(([^)#:]+)\)", readme) + re.findall(r'src="([^":]+)"', readme):
    if not (root / target).exists():
        print(f"README.md links to {target}, which does not exist")
        failed = True
sys.exit(1 if failed else 0)
