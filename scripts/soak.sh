#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Endurance of a pair of bodies: random problems on surfaces that change, two threads, for some hours. usage: soak.sh HOURS
# Prints calls and memory as it goes, and what memory would be after 1e7 calls. Exit status 1: memory grew, or a problem that came
# back had another answer. The benchmark (bench/endurance) has the limits.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

[[ ${1:-} =~ ^[0-9]+([.][0-9]+)?$ ]] || { sed -n '4,6s/^# //p' "$0" >&2; exit 2; }
cmake --preset bench
cmake --build --preset bench --target bench_endurance
exec build/bench/bench/endurance/bench_endurance --hours "$1"
