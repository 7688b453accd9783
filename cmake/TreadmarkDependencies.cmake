# SPDX-License-Identifier: Apache-2.0
# Every third-party dependency is looked up here and nowhere else.

macro(treadmark_require package apt_package)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "Treadmark needs ${package}: install the Debian package ${apt_package}")
  endif()
endmacro()

treadmark_require(Threads g++)
treadmark_require(Eigen3 libeigen3-dev 3.4)
treadmark_require(TBB libtbb-dev)
treadmark_require(fmt libfmt-dev)
treadmark_require(nlohmann_json nlohmann-json3-dev 3.11)
treadmark_require(tomlplusplus libtomlplusplus-dev 3.3)
treadmark_require(CLI11 libcli11-dev 2.1)
treadmark_require(HDF5 libhdf5-dev COMPONENTS C)

treadmark_require(embree libembree-dev 3)

# OpenVDB ships a find module only, and its messages are about Python bindings nobody asked for.
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB")
set(saved_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
set(CMAKE_MESSAGE_LOG_LEVEL ERROR)
treadmark_require(OpenVDB "libopenvdb-dev and libboost-iostreams-dev")
set(CMAKE_MESSAGE_LOG_LEVEL "${saved_log_level}")

set(TREADMARK_HAVE_FFTW OFF)
if(TREADMARK_WITH_FFTW)
  find_path(FFTW3_INCLUDE_DIR fftw3.h)
  find_library(FFTW3_LIBRARY fftw3)
  if(NOT FFTW3_INCLUDE_DIR OR NOT FFTW3_LIBRARY)
    message(FATAL_ERROR "TREADMARK_WITH_FFTW is on but FFTW 3 was not found: "
                        "install the Debian package libfftw3-dev or configure with -DTREADMARK_WITH_FFTW=OFF")
  endif()
  set(TREADMARK_HAVE_FFTW ON)
else()
  find_path(KISSFFT_INCLUDE_DIR kissfft/kissfft.hh)
  if(NOT KISSFFT_INCLUDE_DIR)
    message(FATAL_ERROR "KISS FFT was not found: install the Debian package libkissfft-dev")
  endif()
endif()

if(TREADMARK_BUILD_TESTS)
  treadmark_require(GTest libgtest-dev)
endif()
if(TREADMARK_BUILD_BENCH)
  treadmark_require(benchmark libbenchmark-dev)
endif()
