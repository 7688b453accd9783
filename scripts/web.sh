#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: web.sh [BUILD], the folder of a build of the program, default build/release
# Builds the program for browsers with Debian's emscripten (install-packages.sh --web), puts it where the program of BUILD finds it for
# `treadmark live`, and compares the two; with Chromium, uses the page as a reader would. Prints times and size.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$(realpath "${1:-build/release}")
program=$build/app/treadmark
[[ -x $program && -d $build/report/web ]] || { echo "web.sh: there is no program with scripts for reports in $build: build it first" >&2; exit 1; }
command -v em++ >/dev/null || { echo "web.sh: needs emscripten: bash scripts/install-packages.sh --web" >&2; exit 1; }

cmake --preset web >/dev/null
time cmake --build --preset web
modules=$build/lib/treadmark
mkdir -p "$modules"
cp build/web/interfaces/web/treadmark-web.{wasm,js} "$modules/"
printf 'treadmark-web.wasm: %d bytes, %d compressed\n' "$(stat -c %s "$modules/treadmark-web.wasm")" "$(gzip -9 -c "$modules/treadmark-web.wasm" | wc -c)"

cmake "$build" >/dev/null  # both of the same commit
cmake --build "$build" --target treadmark_cli
export TREADMARK=$program TREADMARK_WEB=$modules OUT=$build/live-pages
TREADMARK_MODULES=$modules "$program" --quiet live --no-open -o "$modules/live.html"  # for the site of the documents
cd "$build/report/web"
node test/run.mjs live
if command -v chromium >/dev/null; then
  CHROMIUM=$(command -v chromium) node --test test/live.browser.mjs
else
  echo "skipped: the page in a browser (Chromium is not installed)" >&2
fi
