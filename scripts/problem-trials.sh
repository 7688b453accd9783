#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Many random wheels on random rails through the checks of tests/solvers/wheelrail/random_problems.hpp: force balance from fields, no
# penetration, friction; mirror, order, threads; and through random representations, which stand as high within their stated errors.
# usage: problem-trials.sh [COUNT [FIRST]], default 10000 from 1.
# Takes the tests of $BUILD (build/release), built before. Exit status 1: a violation without a status; its number runs it alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

count=${1:-10000} first=${2:-1}
[[ $count$first =~ ^[0-9]+$ && $# -le 2 ]] || { sed -n '4,7s/^# //p' "$0" >&2; exit 2; }
export TREADMARK_PROBLEMS=$count TREADMARK_SEED=$first
tests=${BUILD:-build/release}/tests
"$tests/solvers/wheelrail/solvers_wheelrail_tests" --gtest_filter='RandomProblems.*'
"$tests/representation/representation_tests" --gtest_filter='RandomRepresentations.*'
