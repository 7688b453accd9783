#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: first-jobs.sh [BUILD]
# The first jobs of three users with a build (build/release unless told), timed: a railway engineer takes a profile of her own to a report by
# README.md alone; a student takes a scan to forces and pressures by the notebook; a C++ engineer builds a backend of his own against the
# installed package and runs it. Prints the seconds of each; fails where a job does, or takes longer than its limit.
# scripts/stranger.sh starts earlier, with packages in a minimal Debian.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$(realpath "${1:-build/release}")
python=$(sed -n 's/^TREADMARK_PYTHON_EXECUTABLE[^=]*=//p' "$build/CMakeCache.txt")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

failed=0
job() {  # LIMIT [s], what it is, command
  local begun status=ok
  begun=$(date +%s.%N)
  timeout "$1" "${@:3}" >"$work/log" 2>&1 || { status="failed, or more than $1 s"; failed=1; cat "$work/log" >&2; }
  awk -v a="$begun" -v b="$(date +%s.%N)" -v what="$2" -v status="$status" 'BEGIN { printf "%7.1f s  %s: %s\n", b - a, what, status }'
}
report() { python3 -B tests/readme/run_readme.py . "$build/app/treadmark"; }
scan() { PYTHONPATH=$build/interfaces/python "${python:-python3}" -B tests/interfaces/python/run_notebook.py examples/python/scan_to_figures.ipynb; }
backend() {
  cmake --install "$build" --prefix "$work/prefix"
  cmake -S tests/consumer/project -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix"
  cmake --build "$work/build" --parallel
  "$work/build/consumer"
}
export build python work
export -f report scan backend
job 60 "own profile to report, by the README" bash -euc report
job 180 "scan to forces and pressures, by the notebook" bash -euc scan
job 300 "own backend in C++, against the installed package" bash -euc backend
exit $failed
