#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# clang-tidy with the checks of .clang-tidy over library sources. usage: tidy.sh [--all | FILES...]
# Without arguments: the sources that the newest commits changed, at most 8, for a file takes 10 to 20 s.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folders='^(core|model|io|report|backends|analysis|scans|detection|solvers|app|interfaces)/.*\.cpp$'
if [[ "${1:-}" == --all ]]; then
  mapfile -t files < <(git ls-files | grep -E "$folders")
elif (($# > 0)); then
  files=("$@")
else
  mapfile -t files < <(git log --first-parent -n 12 --name-only --diff-filter=d --format= | grep -E "$folders" | grep -v '/without_' |
    awk '!seen[$0]++' | while read -r file; do if [[ -f "$file" ]]; then echo "$file"; fi; done | head -8)
fi
if ((${#files[@]} == 0)); then
  echo "tidy: no sources changed"
  exit 0
fi
# Every source by itself, so that each has its own command; nothing is built there.
cmake -S . -B build/tidy -G Ninja -DCMAKE_BUILD_TYPE=Release -DTREADMARK_SHARED_PARSING=OFF -DTREADMARK_BUILD_TESTS=OFF \
  -DTREADMARK_REPORT_SCRIPTS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P 2 clang-tidy -p build/tidy --quiet 2> >(grep -v 'warnings generated' >&2)
echo "tidy: ${#files[@]} sources without a finding"
