#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Do the tests notice when the program is wrong? Draws small errors in sources and runs the tests of their folders on each.
#   scripts/mutate.sh [--count N] [--seed N] [--out FOLDER] [--build FOLDER] SOURCE-FOLDER...
# For nights: 5 to 20 s each. --count: errors (100) over all folders, in proportion to their lines; --seed: of the draw (the day);
# --build: of a configured build with tests (build/release), in which the tests needed are built first; --out (out/mutants):
# survivors.md, those that no test noticed, results.json. Survivors that cannot be noticed, with the reason, stand in
# tests/mutants.txt and do not count. Exit status: 0 all were noticed or have their reason, 1 some survived, 2 no tests, or they fail as they are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/release
words=("$@")
for ((i = 0; i < $#; i++)); do
  [[ ${words[i]} != --build ]] || build=${words[i + 1]}
done
[[ -f $build/build.ninja ]] || { echo "no build in $build: cmake --preset release -DTREADMARK_BUILD_TESTS=ON" >&2; exit 2; }
mapfile -t targets < <(python3 scripts/mutants.py --targets "$@")
((${#targets[@]})) || { echo "no tests belong to these folders" >&2; exit 2; }
cmake --build "$build" --target "${targets[@]}" >&2
exec python3 scripts/mutants.py "$@"
