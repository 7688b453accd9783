#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# From a fresh machine to the pressure under a wheel flat: packages, release build, one run with its report.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash scripts/install-packages.sh
cmake --preset release -DTREADMARK_BUILD_TESTS=OFF -DTREADMARK_WARNINGS_AS_ERRORS=ON
cmake --build --preset release
mkdir -p out/wheel-flat
build/release/app/treadmark run examples/wheel-flat.toml -o out/wheel-flat --json out/wheel-flat/result.json --report out/wheel-flat/report.html
echo "results: out/wheel-flat (open report.html in a browser; numbers in result.json, formats in docs/results.md)
the program: $PWD/build/release/app/treadmark; to call it as treadmark: export PATH=$PWD/build/release/app:\$PATH" >&2
