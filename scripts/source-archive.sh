#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: source-archive.sh [COMMIT [FOLDER]]
# Writes the sources of a commit (HEAD unless told) to FOLDER/treadmark-VERSION-COMMIT.tar.gz (out unless told) and prints its SHA-256. The same
# commit gives the same bytes, on any day and machine with this git and gzip. What is built from it knows its commit (cmake/revision.txt).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
commit=$(git rev-parse --verify "${1:-HEAD}^{commit}")
folder=${2:-out}
version=$(git show "$commit:CMakeLists.txt" | sed -n 's/^project(Treadmark VERSION \([0-9.]*\).*/\1/p')
[[ $version ]] || { echo "CMakeLists.txt of $commit has no version" >&2; exit 1; }
name=treadmark-$version-${commit:0:8}
mkdir -p "$folder"
git -c tar.umask=0022 archive --format=tar --prefix="$name/" "$commit" | gzip -9n >"$folder/$name.tar.gz.part"
mv "$folder/$name.tar.gz.part" "$folder/$name.tar.gz"
(cd "$folder" && sha256sum "$name.tar.gz")
