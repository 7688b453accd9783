#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Builds everything with warnings as errors and runs all tests. Exit status 0 when all passed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash scripts/install-packages.sh --tests
cmake -S . -B build/test -G Ninja -DCMAKE_BUILD_TYPE=Release -DTREADMARK_BUILD_TESTS=ON -DTREADMARK_BUILD_BENCH=ON \
  -DTREADMARK_WARNINGS_AS_ERRORS=ON
cmake --build build/test
ctest --test-dir build/test --output-on-failure -j2
