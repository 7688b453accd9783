#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: install-packages.sh [--tests|--fuzz|--libcxx|--web]
# Installs what building needs on Debian 12, with --tests also what only tests and the parts under the GPL need, with --fuzz also what
# libFuzzer needs, with --libcxx also what the preset clang-libcxx needs, with --web also what the preset web needs. Does nothing where all of it is installed already.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache git ca-certificates python3
  libeigen3-dev libtbb-dev libfmt-dev nlohmann-json3-dev libtomlplusplus-dev libcli11-dev libhdf5-dev zlib1g-dev libexpat1-dev libzip-dev libnanoflann-dev libnlopt-dev
  libembree-dev libocct-data-exchange-dev libopenvdb-dev libboost-iostreams-dev libnanovdb-dev
  pybind11-dev python3-dev python3-numpy
  libgtest-dev libgmock-dev libbenchmark-dev libboost-dev openmpi-bin
)

[[ ${1:-} != --tests ]] || packages+=(libfftw3-dev libcgal-dev libgmp-dev libmpfr-dev chromium clang-format clang-tidy doxygen dpkg-dev file gfortran python3-h5py python3-pytest python3-mypy python3-pandas python3-xarray python3-matplotlib python3-distributed python3-pip python3-setuptools python3-venv python3-wheel libxml2-utils libsimbody-dev slurmctld slurmd slurm-client munge valgrind
  python3-sphinx python3-myst-parser furo)
[[ ${1:-} != --fuzz ]] || packages+=(clang libclang-rt-14-dev)
[[ ${1:-} != --libcxx ]] || packages+=(clang libc++-dev libc++abi-dev googletest)
[[ ${1:-} != --web ]] || packages+=(emscripten)
# Node.js from elsewhere is as good as Debian's, which brings npm in a package of its own.
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm)

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  [[ $state == "install ok installed" ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "all packages are installed" >&2
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || { echo "installing packages needs root: run as root or install sudo" >&2; exit 1; }
  as_root=(sudo)
fi
echo "installing: ${missing[*]}" >&2
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
