#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# What building costs, in an empty folder and without ccache: processor time of the program's and of the tests' compilation, the time
# from an edit of one source to a running program, and the processor time of treadmark --version. For an idle machine.
# usage: measure-build.sh [FOLDER]   default build/measure, removed first
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=${1:-build/measure}
export CCACHE_DISABLE=1
rm -rf "$folder"
TIMEFORMAT='%1U user + %1S system seconds of processor time, %1R s'
step() {
  echo "== $1" >&2
  shift
  time "$@" >/dev/null
}
options=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DTREADMARK_WARNINGS_AS_ERRORS=ON)
cmake -S . -B "$folder" "${options[@]}" -DTREADMARK_BUILD_TESTS=OFF >/dev/null
step "program" cmake --build "$folder"
cmake -S . -B "$folder" "${options[@]}" -DTREADMARK_BUILD_TESTS=ON -DTREADMARK_BUILD_BENCH=ON >/dev/null
step "tests and benchmarks beside it" cmake --build "$folder"
for source in solvers/kalker/contact_solver.cpp io/results/write_json.cpp app/cli/run_command.cpp; do
  touch "$source"
  step "program after an edit of $source" cmake --build "$folder" --target treadmark_cli
done
step "ten times treadmark --version" bash -c "for i in 1 2 3 4 5 6 7 8 9 10; do '$folder/app/treadmark' --version; done"
