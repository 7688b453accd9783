// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {

/// A folder with a complete, small wheel-rail case in CONTACT's input format (rail.prr, wheel.txt, case.inp), removed
/// at the end. Tests break one file of it at a time.
class SampleInput {
 public:
  SampleInput();

  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path inp() const { return folder() / "case.inp"; }

  /// Replaces the first occurrence of a text in a file; it must be there.
  void edit(const std::string& file, const std::string& from, const std::string& to) const;
  void write(const std::string& file, const std::string& text) const;
  std::string read(const std::string& file) const;

  /// Turns the wheel into slices (wheel.slcw with slice_*.txt).
  void use_slices() const;

 private:
  TemporaryFolder folder_;
};

}  // namespace treadmark::testing
