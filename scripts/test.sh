#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Builds everything, the parts under the GPL too, with warnings as errors and runs all tests; counts the instructions of the main paths; then
# the smallest build and some of its tests, clang-tidy over what changed, and under the address sanitizer the readers, and splines and
# solvers where they changed.
# Prints the minutes of each.
# Exit status 0 when all passed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# What ended took so long, and what begins.
phase=packages begun=0
next() {
  printf '== %s: %d min %02d s\n' "$phase" $(((SECONDS - begun) / 60)) $(((SECONDS - begun) % 60)) >&2
  phase=$1 begun=$SECONDS
}

bash scripts/install-packages.sh --tests
next build
# What two of the builds below have in common is compiled once, precompiled headers too.
export CCACHE_BASEDIR=$PWD CCACHE_SLOPPINESS=pch_defines,time_macros
# The folder of scripts/main-job.sh: what that has compiled is not compiled again.
cmake --preset release -DTREADMARK_BUILD_TESTS=ON -DTREADMARK_BUILD_BENCH=ON -DTREADMARK_WARNINGS_AS_ERRORS=ON \
  -DTREADMARK_WITH_FFTW=ON -DTREADMARK_WITH_CGAL=ON -DTREADMARK_TESTS_AT_ONCE=16
cmake --build --preset release
next tests
# One more at a time than there are processors: some wait for a browser, a cluster, a disk or a lock. A browser or a cluster that
# does not answer on a busy machine is asked once more.
ctest --preset release -j$(($(nproc) + 1)) --repeat after-timeout:2

next "program for browsers"
# Not installed for this: emscripten takes a minute, and the build some.
if command -v em++ >/dev/null; then
  bash scripts/web.sh build/release
else
  echo "skipped: program for browsers and its page (emscripten is not installed: scripts/install-packages.sh --web)" >&2
fi

next instructions
# No path may take 5 % more instructions than it did. Where they cannot be counted or compared, the script says why.
status=0
bash scripts/check-instructions.sh --build build/release --no-build --short || status=$?
case $status in
  0) ;;
  3) echo "skipped: instructions of the main paths" >&2 ;;
  *) exit "$status" ;;
esac

next "smallest build"
# The smallest build, which leaves out all that may be left out: its program, what it says of the rest, and the example of the README.
cmake --preset smallest -DTREADMARK_BUILD_TESTS=ON -DTREADMARK_WARNINGS_AS_ERRORS=ON
cmake --build --preset smallest --target treadmark_cli core_tests left_out_tests example_first_contact
ctest --preset smallest -j2 -R '^(Parts|ParallelFor|ThreadLimit|LeftOut|Readme)\.'

next clang-tidy
bash scripts/tidy.sh
next sanitizers
bash scripts/sanitize.sh address
next end
