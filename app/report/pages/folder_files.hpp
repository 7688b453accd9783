// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// A result folder's files that a page can do without. What is not there is remembered, to be said on the page. Not
/// thread-safe.
class OptionalFiles {
 public:
  explicit OptionalFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path path(const std::string& file) const { return folder_ / file; }

  /// Whether a file is there. what: what the page lacks without it.
  bool has(const std::string& file, const std::string& what);

  /// A picture as a figure; nothing if it is not there.
  std::vector<Block> picture(const std::string& file, const std::string& id, const std::string& title,
                             const std::string& note = {});

  /// The text of a file; empty if it is not there. Errors: Error(input_data) where it cannot be read.
  std::string text(const std::string& file, const std::string& what);

  /// A note about what was missing; nothing where all was there.
  std::vector<Block> note() const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> missing_;
};

/// Adds all of them.
void append(std::vector<Block>& to, std::vector<Block> blocks);

}  // namespace treadmark::app::report
