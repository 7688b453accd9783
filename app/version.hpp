// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/core/version.hpp"

namespace treadmark::app {

using treadmark::git_revision;
using treadmark::version;
std::string source_time();  ///< of that commit, else of the configuration of the build: "2026-01-31T12:00:00Z"
/// Parts that are in and those left out (core/parts.hpp), and the licence that the binary thereby has, for --version.
std::string build_description();
std::string licence();  ///< that the program has with what it is linked to, as SPDX expression

/// What the program is made with.
struct LinkedLibrary {
  std::string name, version;  ///< as found when the program was built
  std::string licence;        ///< SPDX expression
  std::string shared;         ///< beginning of the name of the shared library that is loaded; empty: none
  bool script = false;        ///< a package of npm in the scripts of reports; else headers, where nothing is loaded
};
std::vector<LinkedLibrary> linked_libraries();  ///< in the order of cmake/TreadmarkDependencies.cmake

/// All of this as JSON, for programs.
std::string version_json();
/// The same as a bill of materials: SPDX 2.3 in JSON. The same bytes from the same sources and libraries.
std::string version_spdx();

}  // namespace treadmark::app
