// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::testing {

/// A command that writes. In its words $ stands for the folder of the inputs, @ for that of the outputs.
struct OutputRow {
  const char* name;
  const char* parts;    ///< of parts(), which it needs, by blanks
  const char* prepare;  ///< commands that make inputs, by semicolons
  const char* command;
  const char* older;     ///< the same with other content, for what stood there before; nullptr: nothing does
  int points;            ///< injected a fault and start; 0: the program takes long, so few faults and one each
  bool resumes = false;  ///< goes on where it was interrupted
};

std::ostream& operator<<(std::ostream& out, const OutputRow& row);

/// All verbs that write files, in all their formats.
const std::vector<OutputRow>& output_rows();

/// The first of these parts, by blanks, that this build leaves out, or "".
std::string missing_part(const std::string& parts);

/// At the beginning of a test of a row: it is skipped where this build leaves out a part that the row needs.
#define TREADMARK_NEEDS_PARTS_OF(row)                                                                 \
  if (const std::string missing = ::treadmark::testing::missing_part((row).parts); missing.empty()) { \
  } else                                                                                              \
    GTEST_SKIP() << ::treadmark::left_out_message(missing, "what this test needs")

/// The inputs, and an empty folder for outputs whose path has no links.
class OutputScene {
 public:
  OutputScene();

  const std::filesystem::path& out() const { return out_; }
  const SampleSimulation& input() const { return input_; }
  /// The words of a command of a row.
  std::vector<std::string> words(const std::string& command) const;
  /// Runs what makes the inputs of a row. Fails the test where one fails.
  void prepare(const OutputRow& row) const;

 private:
  SampleSimulation input_;
  std::filesystem::path out_;
};

}  // namespace treadmark::testing
