# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# The headers of toml++ without its library, which is made for GCC's standard library.
include(FindPackageHandleStandardArgs)
find_path(tomlplusplus_INCLUDE_DIR toml++/toml.h)
mark_as_advanced(tomlplusplus_INCLUDE_DIR)
if(tomlplusplus_INCLUDE_DIR)
  file(STRINGS "${tomlplusplus_INCLUDE_DIR}/toml++/impl/version.h" tomlplusplus_VERSION REGEX "TOML_LIB_(MAJOR|MINOR|PATCH) +[0-9]")
  string(REGEX MATCHALL "[0-9]+" tomlplusplus_VERSION "${tomlplusplus_VERSION}")
  list(JOIN tomlplusplus_VERSION "." tomlplusplus_VERSION)
endif()
find_package_handle_standard_args(tomlplusplus REQUIRED_VARS tomlplusplus_INCLUDE_DIR VERSION_VAR tomlplusplus_VERSION)
if(tomlplusplus_FOUND AND NOT TARGET tomlplusplus::tomlplusplus)
  add_library(tomlplusplus::tomlplusplus INTERFACE IMPORTED)
  set_target_properties(tomlplusplus::tomlplusplus PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${tomlplusplus_INCLUDE_DIR}")
endif()
