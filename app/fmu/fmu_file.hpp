// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/app/fmu/model_description.hpp"

namespace treadmark::fmi {

/// What an FMU is made of.
struct FmuContent {
  std::filesystem::path input;         ///< a case file or a simulation
  std::vector<std::string> overrides;  ///< "key.path=value"
  int number = 0;                      ///< of the case, from 1; 0: the first one of a wheel on a rail
  bool wheelset = false;               ///< both sides: the first case of each, or one case for both
  Version version = Version::fmi3;
  std::filesystem::path output;
};

/// What was written.
struct WrittenFmu {
  std::string title;
  std::size_t variables = 0;
  std::size_t bytes = 0;
};

/// Writes an FMU: the description, the resources (the case with every file that it names, below one folder), this
/// machine's shared library with the libraries that it needs, documentation and licences. The model is opened from the
/// resources as they are packed, so that what is written can be opened. The same input makes the same bytes.
/// Errors: those of reading and opening; Error(configuration) for what cannot be packed, and where Treadmark's library
/// for FMUs is not installed.
WrittenFmu write_fmu(const FmuContent& content);

}  // namespace treadmark::fmi
