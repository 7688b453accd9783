#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Builds a part of the tests with sanitizers and runs it. usage: sanitize.sh [address|thread]
#   address  address and undefined behaviour: readers of files, splines, Kalker's solvers
#   thread   data races; without oneTBB and OpenVDB, in which the sanitizer does not see how threads wait for each other
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-address}" in
  address)
    preset=asan
    programs=(core/core_tests model/model_tests io/json/io_json_tests io/profiles/io_profiles_tests io/meshes/io_meshes_tests
      io/cases/io_cases_tests io/scans/io_scans_tests backends/spline/backends_spline_tests solvers/kalker/solvers_kalker_tests)
    ;;
  thread)
    preset=tsan
    programs=(core/core_tests search/search_tests backends/spline/backends_spline_tests backends/mesh/backends_mesh_tests
      solvers/kalker/solvers_kalker_tests)
    ;;
  *) sed -n '4,7s/^# //p' "$0" >&2; exit 2 ;;
esac

cmake --preset $preset -DTREADMARK_WITH_CGAL=OFF -DTREADMARK_REPORT=OFF -DTREADMARK_VEHICLE=OFF -DTREADMARK_BUILD_BENCH=OFF
cmake --build --preset $preset --target "${programs[@]##*/}"
export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp"
printf "build/$preset/tests/%s\0" "${programs[@]}" | xargs -0 -n 1 -P 2 bash -c '"$0" --gtest_brief=1 || exit 255'
echo "sanitize: no finding in ${#programs[@]} test programs"
