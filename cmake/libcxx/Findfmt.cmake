# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# The headers of fmt without its library, which is made for GCC's standard library.
include(FindPackageHandleStandardArgs)
find_path(fmt_INCLUDE_DIR fmt/format.h)
mark_as_advanced(fmt_INCLUDE_DIR)
if(fmt_INCLUDE_DIR)
  file(STRINGS "${fmt_INCLUDE_DIR}/fmt/core.h" fmt_VERSION REGEX "^#define FMT_VERSION ")
  string(REGEX REPLACE ".* 0*([0-9]+)([0-9][0-9])([0-9][0-9])$" "\\1.\\2.\\3" fmt_VERSION "${fmt_VERSION}")
  string(REGEX REPLACE "\\.0([0-9])" ".\\1" fmt_VERSION "${fmt_VERSION}")
endif()
find_package_handle_standard_args(fmt REQUIRED_VARS fmt_INCLUDE_DIR VERSION_VAR fmt_VERSION)
if(fmt_FOUND AND NOT TARGET fmt::fmt)
  add_library(fmt::fmt INTERFACE IMPORTED)
  set_target_properties(fmt::fmt PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${fmt_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS FMT_HEADER_ONLY)
endif()
