// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace treadmark {

/// While it lives, no file that was there under the name of an output is read, whatever name it is read by: a command
/// would overwrite its input. Made before anything is read; one made while another lives ends before it.
class OutputClaim {
 public:
  /// Names that are empty, "-" or those of devices do not count. Errors: Error(configuration) where two are the same.
  explicit OutputClaim(const std::vector<std::string>& outputs);
  ~OutputClaim();
  OutputClaim(const OutputClaim&) = delete;
  OutputClaim& operator=(const OutputClaim&) = delete;

 private:
  std::size_t before_ = 0;  ///< files that others claim
};

/// Readers call it before they open a file. Errors: Error(configuration) where an output is claimed there; writing that
/// output (core/output_file.hpp) is an error from then on, too. Thread-safe.
void refuse_output_as_input(const std::filesystem::path& input);

/// Errors: as above, where a target is the file of an output that was to be read. Thread-safe.
void refuse_input_as_output(const std::filesystem::path& target);

}  // namespace treadmark
