#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Counts the instructions of the main paths and compares them with bench/instructions/baseline.json. Times are not looked at.
#   scripts/check-instructions.sh [--build FOLDER] [--no-build] [--update] [--short] [PATH-PATTERN]
# --build: a build folder, default build/bench, made if there is none; --no-build: takes what is built there; --update: writes
# the counts to the baseline; --short: one representation of each path, what scripts/test.sh looks at; a pattern (extended
# regular expression) picks some of the paths.
# Exit status: 0 none grew by more than 5 %, 1 one did, is gone or gives wrong answers, 2 counting failed, 3 nothing to count with,
# or no baseline of this compiler, processor and tool; with CI=true that is 1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() { sed -n '5,11s/^# \{0,1\}//p' "$0" >&2; exit 2; }
build=build/bench pattern=. update=() no_build=0
while (($#)); do
  case $1 in
    --build) [[ $# -gt 1 ]] || usage; build=$2; shift 2 ;;
    --no-build) no_build=1; shift ;;
    --short) pattern='^(heights/(wheel|rail)/(analytic|spline)/|search/.*/analytic|distance/analytic|normal|large|case|rolling|build/mesh/rail|import/ply)'; shift ;;
    --update) update=(--update); shift ;;
    -*) usage ;;
    *) pattern=$1; shift ;;
  esac
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A guard that says nothing is none.
not_compared() { [[ ${CI:-} != true ]] || exit 1; exit 3; }

# Lines "path unit units instructions" of some paths.
# callgrind: one run of all of them, collecting in one function only and dumped whenever it ends (two patterns, because a
# pattern has one meaning only).
count_callgrind() {
  local out=$work/callgrind.$BASHPID i=0 instructions
  valgrind --tool=callgrind --toggle-collect='*counted_run*' --dump-after='*counted_run(*' --callgrind-out-file="$out" \
    "$program" count "$@" >"$out.lines" 2>"$out.err" || { cat "$out.err" >&2; return 1; }
  while read -r line; do
    i=$((i + 1))
    instructions=$(sed -n 's/^totals: //p' "$out.$i")
    [[ $instructions -gt 0 ]] || { echo "callgrind counted nothing for $line" >&2; return 1; }
    echo "$line $instructions"
  done <"$out.lines"
}
# perf: two runs that differ in their repeats only; what is left of their difference is the path itself.
count_perf() {
  local path unit few=2 many=12 first second
  for path in "$@"; do
    unit=$("$program" run "$path" 0)
    first=$(instructions_perf "$program" run "$path" "$few")
    second=$(instructions_perf "$program" run "$path" "$many")
    echo "$path $unit $(((second - first) / (many - few)))"
  done
}
instructions_perf() {
  perf stat -x, -e instructions:u -o "$work/perf.$BASHPID" -- "$@" >/dev/null
  sed -n 's/^\([0-9][0-9]*\),.*instructions.*/\1/p' "$work/perf.$BASHPID"
}

if command -v valgrind >/dev/null; then
  tool=callgrind
elif command -v perf >/dev/null && [[ -n $(instructions_perf true 2>/dev/null) ]]; then
  tool=perf
else
  echo "instructions cannot be counted here: install valgrind (Debian package valgrind), or linux-perf on a machine whose" >&2
  echo "processor lets programs count instructions (perf stat -e instructions:u true)" >&2
  not_compared
fi

if [[ ! -f $build/CMakeCache.txt ]]; then
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTREADMARK_BUILD_TESTS=OFF -DTREADMARK_BUILD_BENCH=ON \
    -DTREADMARK_WITH_FFTW=ON >&2  # as the baseline
fi
((no_build)) || cmake --build "$build" --target bench_instructions >&2
program=$build/bench/instructions/bench_instructions

"$program" list >"$work/paths"
mapfile -t paths < <(grep -E -- "$pattern" "$work/paths")
((${#paths[@]})) || { echo "no path matches $pattern (see: $program list)" >&2; exit 2; }
"$program" check "${paths[@]}" || { echo "wrong answers are not counted" >&2; exit 1; }

echo "counting with $tool" >&2
# Two processes, each with every other path.
half() { local i; for ((i = $1; i < ${#paths[@]}; i += 2)); do echo "${paths[i]}"; done; }
mapfile -t even < <(half 0)
mapfile -t odd < <(half 1)
"count_$tool" "${even[@]}" >"$work/counts.even" & pid=$!
status=0
((${#odd[@]} == 0)) || "count_$tool" "${odd[@]}" >"$work/counts.odd" || status=$?
wait "$pid" || status=$?
((status == 0)) || { echo "counting failed" >&2; exit 2; }
cat "$work"/counts.* >"$work/counts"

# The instructions depend on the kernels that this processor runs.
kernels=$(grep -qw avx2 /proc/cpuinfo && echo AVX2 || echo generic)
status=0
python3 bench/instructions/compare_counts.py bench/instructions/baseline.json "$work/counts" --paths "$work/paths" \
  --configuration "$("$program" compiler), $kernels, $tool" "${update[@]}" || status=$?
((status != 3)) || not_compared
exit "$status"
