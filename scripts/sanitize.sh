#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Builds a part of the tests with sanitizers and runs it. usage: sanitize.sh [address|all|replay [SECONDS]|thread|trap|memcheck]
#   address   address and undefined behaviour: readers of files, and splines and Kalker's solvers where the newest
#             commits changed them; and replay beside them
#   all       address and undefined behaviour under every test that a sanitized program can run: for a night
#   replay    the same build of the readers under the corpus of tests/fuzz, then under mutants of it for some seconds (60)
#   thread    data races; without oneTBB and OpenVDB, in which the sanitizer does not see how threads wait for each other
#   trap      signed overflow (-ftrapv) and floating-point division by zero and overflow end a test where they happen: Kalker's
#             solvers, in which neither is meant. Invalid operations do not: a missing surface is a quiet NaN, and to compare one is
#             such an operation. Surfaces are left out: where an arc ends upright its slope is meant to be infinite
#   memcheck  valgrind over the release program: values that nobody set, in small cases of both kinds
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

kind=${1:-address}
programs=()
case "$kind" in
  address)
    preset=asan
    programs=(io/cases/io_cases_tests io/scans/io_scans_tests io/profiles/io_profiles_tests core/core_tests model/model_tests
      io/json/io_json_tests io/meshes/io_meshes_tests)
    newest=$(git log --first-parent -n 12 --name-only --format= 2>/dev/null) || newest=""
    for program in backends/spline/backends_spline_tests solvers/kalker/solvers_kalker_tests; do
      if [[ -z "$newest" ]] || grep -q -E "^(tests/)?${program%/*}/" <<<"$newest"; then programs+=("$program"); fi
    done
    ;;
  replay) preset=asan ;;
  all)
    cmake --preset asan -DTREADMARK_REPORT=ON -DTREADMARK_BUILD_BENCH=OFF
    cmake --build --preset asan
    export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp"
    exec ctest --test-dir build/asan -j"$(nproc)" --output-on-failure
    ;;
  thread)
    preset=tsan
    programs=(core/core_tests search/search_tests backends/spline/backends_spline_tests backends/mesh/backends_mesh_tests
      solvers/kalker/solvers_kalker_tests)
    ;;
  trap)
    preset=trap
    programs=(core/core_tests model/model_tests solvers/kalker/solvers_kalker_tests solvers/tangential/solvers_tangential_tests)
    ;;
  memcheck)
    program=build/release/app/treadmark
    [[ -x $program ]] || { echo "memcheck runs $program: build it first (cmake --build --preset release)" >&2; exit 2; }
    for file in tests/fuzz/corpus/fuzz_contact_run/*.inp tests/fuzz/corpus/fuzz_case_run/*.toml; do
      valgrind --quiet --error-exitcode=9 --leak-check=no "$program" --threads 1 --quiet run "$file" >/dev/null
      echo "memcheck: no finding in $file"
    done
    exit 0
    ;;
  *) sed -n '4,15s/^# //p' "$0" >&2; exit 2 ;;
esac

# Targets of readers whose tests are built here anyway, and of what reads TOML.
cmake --preset $preset -DTREADMARK_REPORT=OFF -DTREADMARK_BUILD_BENCH=OFF -DTREADMARK_TESTS_AT_ONCE=16 \
  "-DTREADMARK_REPLAYED=cases;json;meshes;profiles;scans;simulations"
export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp"
targets=("${programs[@]##*/}")
[[ $preset != asan ]] || targets+=(fuzz_replay)
cmake --build --preset $preset --target "${targets[@]}"

replay=""
if [[ $preset == asan ]]; then
  build/asan/tests/fuzz/fuzz_replay --seconds "${2:-60}" &
  replay=$!
fi
# Every other test of each program, and beside them the others.
half() {
  local program
  for program in "${programs[@]}"; do
    GTEST_TOTAL_SHARDS=2 GTEST_SHARD_INDEX=$1 "build/$preset/tests/$program" --gtest_brief=1 || return 1
  done
}
half 0 & other=$!
status=0
half 1 || status=1
wait $other || status=1
[[ -z $replay ]] || wait $replay || status=1
((status == 0)) || exit 1
echo "sanitize: no finding in ${#targets[@]} programs"
