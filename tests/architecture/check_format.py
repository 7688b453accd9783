#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Checks that all C++ sources are formatted as .clang-format says. Prints the files that are not; exit status 1 when there is one.

usage: check_format.py ROOT [CLANG_FORMAT]

To format: git ls-files '*.cpp' '*.hpp' | xargs clang-format -i
"""
import concurrent.futures
import pathlib
import subprocess
import sys

from check_architecture import files

AT_ONCE = 60  # files a call of clang-format


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    root, program = pathlib.Path(sys.argv[1]), (sys.argv[2:] or ["clang-format"])[0]
    sources = [path for path in files(root) if path.suffix in (".cpp", ".hpp")]
    if not sources:
        sys.exit(f"no sources in {root}")

    def unformatted(some):
        done = subprocess.run([program, "--dry-run", "--Werror", *some], capture_output=True, text=True)
        if done.returncode == 0:
            return []
        bad = [str(path) for path in some if f"{path}:" in done.stderr]
        return bad or [done.stderr]

    parts = [sources[i:i + AT_ONCE] for i in range(0, len(sources), AT_ONCE)]
    with concurrent.futures.ThreadPoolExecutor() as pool:
        bad = [line for lines in pool.map(unformatted, parts) for line in lines]
    print("\n".join(bad) or f"{len(sources)} files are formatted")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
