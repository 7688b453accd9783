#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Counts the instructions of the main paths and compares them with bench/instructions/baseline.json. Times are not looked at.
#   scripts/check-instructions.sh [--build FOLDER] [--update] [PATH-PATTERN]
# --build: a build folder, default build/bench, configured and built first if there is none; --update: writes the counts to the
# baseline; a pattern (extended regular expression) picks some of the paths.
# Exit status: 0 none grew by more than 5 %, 1 one did or gives wrong answers, 2 nothing could be counted or compared.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() { sed -n '5,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
build=build/bench pattern=. update=()
while (($#)); do
  case $1 in
    --build) [[ $# -gt 1 ]] || usage; build=$2; shift 2 ;;
    --update) update=(--update); shift ;;
    -*) usage ;;
    *) pattern=$1; shift ;;
  esac
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Prints the instructions of a command.
count_callgrind() {
  valgrind --tool=callgrind --callgrind-out-file="$work/$BASHPID" "$@" >/dev/null 2>"$work/$BASHPID.err" ||
    { cat "$work/$BASHPID.err" >&2; return 1; }
  sed -n 's/^\(totals\|summary\): \([0-9]*\).*/\2/p' "$work/$BASHPID" | tail -1
}
count_perf() {
  perf stat -x, -e instructions:u -o "$work/$BASHPID" -- "$@" >/dev/null
  sed -n 's/^\([0-9][0-9]*\),.*instructions.*/\1/p' "$work/$BASHPID"
}

if command -v valgrind >/dev/null; then
  tool=callgrind
elif command -v perf >/dev/null && [[ -n $(count_perf true 2>/dev/null) ]]; then
  tool=perf
else
  echo "instructions cannot be counted here: install valgrind (Debian package valgrind), or linux-perf on a machine whose" >&2
  echo "processor lets programs count instructions (perf stat -e instructions:u true)" >&2
  exit 2
fi

if [[ ! -f $build/CMakeCache.txt ]]; then
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTREADMARK_BUILD_TESTS=OFF -DTREADMARK_BUILD_BENCH=ON >&2
fi
cmake --build "$build" --target bench_instructions >&2
program=$build/bench/instructions/bench_instructions

mapfile -t paths < <("$program" list | grep -E -- "$pattern")
((${#paths[@]})) || { echo "no path matches $pattern (see: $program list)" >&2; exit 2; }
"$program" check "${paths[@]}" || { echo "wrong answers are not counted" >&2; exit 1; }

# Two runs that differ in their repeats only: what is left of their difference is the path itself.
one_path() {
  local path=$1 unit units few=1 many=4 first second
  read -r unit units < <("$program" run "$path" 0)
  first=$("count_$tool" "$program" run "$path" "$few")
  second=$("count_$tool" "$program" run "$path" "$many")
  echo "$path $unit $(((second - first) / (many - few))) $units"
}
export -f one_path count_callgrind count_perf
export program tool work
printf '%s\n' "${paths[@]}" | xargs -P "$(nproc)" -I{} bash -c 'set -euo pipefail; one_path {}' >"$work/counts" ||
  { echo "counting failed" >&2; exit 2; }

# The instructions depend on the kernels that this processor runs.
kernels=$(grep -qw avx2 /proc/cpuinfo && echo AVX2 || echo generic)
python3 bench/instructions/compare_counts.py bench/instructions/baseline.json "$work/counts" \
  --configuration "$("$program" compiler), $kernels, $tool" "${update[@]}"
