# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# GoogleTest from its sources, as Debian's library is made for GCC's standard library.
include(FindPackageHandleStandardArgs)
find_path(GTest_SOURCES googlemock/CMakeLists.txt PATHS /usr/src/googletest NO_DEFAULT_PATH)
mark_as_advanced(GTest_SOURCES)
find_package_handle_standard_args(GTest REQUIRED_VARS GTest_SOURCES)
if(GTest_FOUND AND NOT TARGET GTest::gtest)
  set(INSTALL_GTEST OFF)
  add_subdirectory("${GTest_SOURCES}" "${CMAKE_BINARY_DIR}/googletest" EXCLUDE_FROM_ALL SYSTEM)
endif()
