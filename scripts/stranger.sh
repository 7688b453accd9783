#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: stranger.sh [FOLDER]
# What somebody does who has Debian 12, our packages and the README: in a minimal system that mmdebstrap makes and throws away, installs the
# package treadmark in FOLDER (out/packages unless told; scripts/packages.sh makes it), begins a case with `treadmark new case`, puts a wheel
# profile of two columns in, checks it, runs it and keeps the report, out/stranger.html; then asks for CAD and offsets, installs what the errors
# name, and builds a program in C++ and one in C with libtreadmark-dev. Prints the seconds of each step and the megabytes that apt-get takes;
# fails where something does, or where the report needs more than five minutes or 60 MB. Needs the mirrors of Debian. Exit status 77 where
# mmdebstrap is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
packages=${1:-out/packages}

command -v mmdebstrap >/dev/null || { echo "mmdebstrap is missing: install the Debian package mmdebstrap" >&2; exit 77; }
[[ -n $(compgen -G "$packages/treadmark_*.deb") ]] || bash scripts/packages.sh "$packages" >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$packages"/{treadmark,treadmark-cad,treadmark-openvdb,libtreadmark0,libtreadmark-dev}_*.deb tests/io/cad/data/rail.step "$work"
awk '/^```c$/ { on = 1; next } /^```$/ && on { exit } on' docs/c-interface.md >"$work/quick_start.c"

cat >"$work/visit.sh" <<'VISIT'
set -euo pipefail
cd /root
begun=$(date +%s.%N)
step() {
  local from
  from=$(date +%s.%N)
  "${@:2}" >/root/step.log 2>&1 || { cat /root/step.log >&2; echo "failed: $1" >&2; exit 1; }
  awk -v a="$from" -v b="$(date +%s.%N)" -v what="$1" 'BEGIN { printf "%7.1f s  %s\n", b - a, what }'
}
own_profile() {  # a cone of 1:20 with a flange, as somebody may have measured it: y and z in mm
  awk 'BEGIN { for (y = -70; y <= 60; y += 0.5) printf "%.2f, %.4f\n", y, 27 * exp(-((y + 56) / 9) ^ 2) - y / 20 }' >wheel.csv
  sed -i 's/^shape.standard = "S1002".*/shape.file = "wheel.csv"/' case.toml
  grep -q '^shape.file = "wheel.csv"' case.toml
}
install() {  # ours by name, others too
  local files=() name
  for name; do
    if compgen -G "/root/${name}_*.deb" >/dev/null; then files+=(/root/"$name"_*.deb); else files+=("$name"); fi
  done
  megabytes=$(apt-get -qq -y --no-install-recommends --print-uris install "${files[@]}" | awk '{ bytes += $3 } END { printf "%.1f", bytes / 1e6 }')
  step "apt-get install $*: $megabytes MB" env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install "${files[@]}"
}
names_package() {  # what the command that fails says to install
  ! "${@:2}" >says.log 2>&1 && grep -q "install the Debian package $1" says.log
}
program_in_cxx() {
  mkdir -p cxx
  cp /usr/share/doc/treadmark/examples/first_contact.cpp cxx
  printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(first CXX)' 'find_package(Treadmark CONFIG REQUIRED)' \
    'add_executable(first first_contact.cpp)' 'target_link_libraries(first PRIVATE treadmark::treadmark)' >cxx/CMakeLists.txt
  cmake -S cxx -B cxx/build && cmake --build cxx/build && cxx/build/first
}
program_in_c() { gcc quick_start.c -o quick_start -ltreadmark && ./quick_start; }
step "apt-get update" apt-get -q update
install treadmark
awk -v m="$megabytes" 'BEGIN { exit !(m <= 60) }' || { echo "more than 60 MB" >&2; exit 1; }
step "treadmark new case" treadmark new case
step "own profile into case.toml" own_profile
step "treadmark check case.toml" treadmark check case.toml
grep -q "wheel.csv" step.log
step "treadmark run case.toml --report case.html" treadmark run case.toml --report case.html --json result.json
grep -q '"status": "ok"' result.json
step "manual page, examples, bill of materials" ls /usr/share/man/man1/treadmark.1 /usr/share/doc/treadmark/{examples/wheel-flat.toml,treadmark.spdx.json,copyright}
awk -v a="$begun" -v b="$(date +%s.%N)" -v size="$(stat -c %s case.html)" \
  'BEGIN { printf "%7.1f s  to the report, which has %.1f MB\n", b - a, size / 1e6; exit !(b - a < 300) }' || { echo "more than 300 s" >&2; exit 1; }
step "CAD that is not there names its package" names_package treadmark-cad treadmark check rail.step
install treadmark-cad
step "treadmark check rail.step" treadmark check rail.step
sed -i 's/^shape.file = "wheel.csv"/&\nbackend = "level-set"/' case.toml
step "level sets that are not there name their package" names_package treadmark-openvdb treadmark run case.toml
install treadmark-openvdb
step "treadmark run case.toml with level sets" treadmark run case.toml
install libtreadmark-dev libtreadmark0 g++ cmake make
step "program in C" program_in_c
step "program in C++, with CMake" program_in_cxx
VISIT

mkdir -p out
echo "making a minimal Debian 12" >&2
mmdebstrap --quiet --variant=minbase --format=null \
  --customize-hook="copy-in $(echo "$work"/*) /root" \
  --customize-hook='chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root bash /root/visit.sh' \
  --customize-hook="copy-out /root/case.html $work" \
  bookworm /dev/null
mv "$work/case.html" out/stranger.html
echo "out/stranger.html is the report" >&2
