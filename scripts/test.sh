#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Builds everything with warnings as errors and runs all tests. Exit status 0 when all passed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash scripts/install-packages.sh --tests
# The folder and the options of scripts/main-job.sh: what that has compiled is not compiled again.
cmake --preset release -DTREADMARK_BUILD_TESTS=ON -DTREADMARK_BUILD_BENCH=ON -DTREADMARK_WARNINGS_AS_ERRORS=ON
cmake --build --preset release
ctest --preset release -j2
