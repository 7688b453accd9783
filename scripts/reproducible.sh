#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: reproducible.sh [OPTIONS OF CMAKE]
# Makes the packages of HEAD twice, from its archive of sources, in folders of different names, without ccache, and compares their bytes.
# Takes twice what scripts/packages.sh takes. Exit status 1 where they differ.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export CCACHE_DISABLE=1
for place in a another/place; do
  mkdir -p "$work/$place"
  bash scripts/source-archive.sh HEAD "$work/$place" >&2
  tar -xzf "$work/$place"/*.tar.gz -C "$work/$place"
  TZ=Asia/Tokyo bash "$work/$place"/treadmark-*/scripts/packages.sh "$work/$place/packages" "$@" >&2
  (cd "$work/$place/packages" && sha256sum -- ../*.tar.gz *.deb) >>"$work/sums"
  rm -rf "$work/$place"/treadmark-*/build
done
sort "$work/sums" | uniq -c | tee /dev/stderr | awk '$1 != 2 { differ = 1 } END { exit differ }'
