#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Builds a part of the tests with sanitizers and runs it. usage: sanitize.sh [address|thread]
#   address  address and undefined behaviour: readers and writers of files, surfaces, detection, Kalker's solvers
#   thread   data races: what runs in parallel, with tests/tsan.supp
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-address}" in
  address)
    preset=asan
    targets=(core_tests model_tests io_cases_tests io_json_tests io_meshes_tests io_profiles_tests io_scans_tests io_hdf5_tests
      io_results_tests io_simulations_tests backends_analytic_tests backends_spline_tests backends_displacement_tests
      backends_offset_tests backends_sampling_tests detection_tests solvers_kalker_tests solvers_tangential_tests)
    ;;
  thread)
    preset=tsan
    targets=(core_tests backends_offset_tests detection_tests solvers_wheelrail_tests)
    ;;
  *) sed -n '4,7s/^# //p' "$0" >&2; exit 2 ;;
esac

cmake --preset $preset -DTREADMARK_WITH_CGAL=OFF -DTREADMARK_REPORT=OFF -DTREADMARK_BUILD_BENCH=OFF
cmake --build --preset $preset --target "${targets[@]}"
# Every test program has its name as label. What takes long here beside its worth: many shapes, many grids.
slow='Converge|Table|Random|BruteForce|EveryThread'
ctest --preset $preset -j2 -L "^($(IFS='|'; echo "${targets[*]}"))$" -E "$slow"
