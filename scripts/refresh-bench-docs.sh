#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Measures with `treadmark bench` and writes table and picture into docs/bench.md and docs/bench.svg.
#   scripts/refresh-bench-docs.sh [PROGRAM]     default build/release/app/treadmark, built first
# Nothing is written when something does not agree.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if (($#)); then
  program=$1
else
  cmake --preset release >&2
  cmake --build --preset release --target treadmark_cli >&2
  program=build/release/app/treadmark
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" bench --markdown -o "$work" >"$work/table.md"
python3 - "$work/table.md" docs/bench.md <<'PYTHON'
import pathlib
import re
import sys

table, page = (pathlib.Path(name) for name in sys.argv[1:])
begin, end = "<!-- begin: treadmark bench -->", "<!-- end: treadmark bench -->"
content = f"{begin}\n{table.read_text()}\n![Costs by representation](bench.svg)\n{end}"
text, count = re.subn(re.escape(begin) + ".*?" + re.escape(end), lambda _: content, page.read_text(), flags=re.S)
if count != 1:
    sys.exit(f"{page} has no place for the table")
page.write_text(text)
PYTHON
cp "$work/bench.svg" docs/bench.svg
echo "written: docs/bench.md, docs/bench.svg" >&2
