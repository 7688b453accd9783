#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Readers, and whole small commands, under inputs that nobody thought of. usage: fuzz.sh MINUTES [TARGET...] | fuzz.sh replay [SECONDS]
#   MINUTES  of all targets together on all cores, with libFuzzer under the sanitizers of addresses and undefined behaviour (Clang,
#            scripts/install-packages.sh --fuzz). What reaches new code goes to tests/fuzz/corpus, small inputs only.
#   replay   what the corpus holds, then mutants of it for some seconds (60), in the GCC build of scripts/sanitize.sh address
# The report is printed and kept as build/fuzz/report.txt. Exit status 1: something was found; it lies in build/fuzz/finds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

corpus=tests/fuzz/corpus
export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0"

[[ ${1:-} != replay ]] || exec bash scripts/sanitize.sh replay "${2:-60}"
[[ ${1:-} =~ ^[0-9]+$ ]] || { sed -n '4,9s/^# //p' "$0" >&2; exit 2; }
minutes=$1
shift

build=build/fuzz
cmake -S . -B $build -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DTREADMARK_BUILD_FUZZERS=ON -DTREADMARK_BUILD_BENCH=OFF -DTREADMARK_REPORT=OFF -DTREADMARK_SANITIZE=fuzzer-no-link,address,undefined
all=($(find tests/fuzz -mindepth 2 -name 'fuzz_*.cpp' -printf '%f\n' | sed 's/\.cpp$//' | sort))
targets=("${@:-${all[@]}}")
cmake --build $build --target "${targets[@]}"

cores=$(nproc)
seconds=$((minutes * 60 * cores / ${#targets[@]}))
((seconds > 0)) || seconds=1
mkdir -p $build/finds $build/logs
before=$(find $build/finds -type f | wc -l)

one_target() {
  local target=$1 build=$2 corpus=$3 seconds=$4 own
  own=$build/corpus/$target
  mkdir -p "$own" "$corpus/$target"
  # A target ends at its first find. Whole commands solve contacts: they may take longer.
  "$build/tests/fuzz/$target" -max_total_time="$seconds" -timeout=30 -rss_limit_mb=4096 -print_final_stats=1 \
    -artifact_prefix="$build/finds/$target-" "$own" "$corpus/$target" >"$build/logs/$target.txt" 2>&1 || true
  # What adds to the corpus, the smallest first; no input of more than 4 kB, no more than 40 of a target.
  "$build/tests/fuzz/$target" -merge=1 -max_len=4096 -timeout=30 -rss_limit_mb=4096 -artifact_prefix="$build/finds/$target-" \
    "$corpus/$target" "$own" >"$build/logs/$target-merge.txt" 2>&1 || true
  git ls-files --others --exclude-standard -z -- "$corpus/$target" | xargs -0 -r ls -Sr |
    tail -n +$((41 - $(git ls-files -- "$corpus/$target" | wc -l))) | xargs -r rm -f
}
export -f one_target
printf '%s\0' "${targets[@]}" | xargs -0 -P "$cores" -I {} bash -c 'one_target "$@"' _ {} $build $corpus $seconds

{
  printf '%-24s %12s %8s %8s %8s %8s\n' target executions per_s edges corpus finds
  for target in "${targets[@]}"; do
    log=$build/logs/$target.txt
    stat() { sed -n "s/^stat::$1: *//p" "$log" | tail -n 1; }
    printf '%-24s %12s %8s %8s %8s %8s\n' "$target" "$(stat number_of_executed_units)" "$(stat average_exec_per_sec)" \
      "$(grep -o ' cov: [0-9]*' "$log" | tail -n 1 | tr -dc 0-9)" "$(find "$corpus/$target" -type f | wc -l)" \
      "$(find $build/finds -type f -name "$target-*" | wc -l)"
  done
} | tee $build/report.txt
found=$(($(find $build/finds -type f | wc -l) - before))
if ((found > 0)); then
  echo "fuzz: $found finds in $build/finds; $build/tests/fuzz/TARGET FIND repeats one" >&2
  exit 1
fi
echo "fuzz: nothing found in ${#targets[@]} targets; new inputs are in $corpus" >&2
