#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: packages.sh [FOLDER [OPTIONS OF CMAKE]]
# Makes the packages for Debian in FOLDER (out/packages unless told), checks them and prints their SHA-256: builds the preset `packages` in
# build/packages and the documents as pages, and has cmake/finish_packages.py add licences and bills of materials. The same commit gives the
# same bytes on any day and in any folder, with the same Debian packages installed (scripts/reproducible.sh). Needs what
# scripts/install-packages.sh --tests installs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=$(realpath -m "${1:-out/packages}")
umask 022
[[ -e .git ]] && SOURCE_DATE_EPOCH=$(git log -1 --format=%ct) || read -r _ SOURCE_DATE_EPOCH <cmake/revision.txt
export SOURCE_DATE_EPOCH

cmake --preset packages "${@:2}"
cmake --build build/packages
cmake --build build/packages --target site api
rm -f build/packages/*.deb build/packages/*.ddeb
(cd build/packages && cpack -G DEB >&2)
python3 -B cmake/finish_packages.py build/packages "$folder"
python3 -B tests/packages/check_debs.py "$folder" "$PWD"
/usr/bin/python3 -B tests/readme/site_test.py . build/packages/site
(cd "$folder" && sha256sum -- *.deb)
