#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: stranger.sh [FOLDER]
# What somebody does who has Debian 12, our packages and the README: in a minimal system that mmdebstrap makes and throws away, installs the
# packages in FOLDER (build/release unless told; made there with cpack -G DEB), begins a case with `treadmark new case`, puts a wheel profile
# of two columns in, checks it, runs it and keeps the report, out/stranger.html. Prints the seconds of each step; fails where something does,
# or where the stranger needs more than five minutes. Needs the mirrors of Debian. Exit status 77 where mmdebstrap is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
packages=${1:-build/release}
readonly limit_s=300

command -v mmdebstrap >/dev/null || { echo "mmdebstrap is missing: install the Debian package mmdebstrap" >&2; exit 77; }
[[ -n $(compgen -G "$packages/treadmark_*.deb") ]] || (cd "$packages" && cpack -G DEB >&2)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$packages"/treadmark_*.deb "$packages"/libtreadmark0_*.deb "$work"

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
step "apt-get update" apt-get -q update
step "apt-get install ./treadmark_*.deb ./libtreadmark0_*.deb" env DEBIAN_FRONTEND=noninteractive apt-get -q -y install /root/treadmark_*.deb /root/libtreadmark0_*.deb
step "treadmark new case" treadmark new case
step "own profile into case.toml" own_profile
step "treadmark check case.toml" treadmark check case.toml
grep -q "wheel.csv" step.log
step "treadmark run case.toml --report case.html" treadmark run case.toml --report case.html --json result.json
grep -q '"status": "ok"' result.json
step "manual page, examples, bill of materials" ls /usr/share/man/man1/treadmark.1 /usr/share/doc/treadmark/{examples/wheel-flat.toml,treadmark.spdx.json,copyright}
awk -v a="$begun" -v b="$(date +%s.%N)" -v size="$(stat -c %s case.html)" \
  'BEGIN { printf "%7.1f s  in all; the report has %.1f MB\n", b - a, size / 1e6; printf "%.1f\n", b - a >"/root/seconds" }'
VISIT

mkdir -p out
echo "making a minimal Debian 12" >&2
mmdebstrap --quiet --variant=minbase --format=null \
  --customize-hook="copy-in $work/visit.sh $(echo "$work"/*.deb) /root" \
  --customize-hook='chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root bash /root/visit.sh' \
  --customize-hook="copy-out /root/case.html /root/seconds $work" \
  bookworm /dev/null
mv "$work/case.html" out/stranger.html
awk -v s="$(cat "$work/seconds")" -v limit=$limit_s 'BEGIN { exit !(s < limit) }' || { echo "more than $limit_s s" >&2; exit 1; }
echo "out/stranger.html is the report" >&2
