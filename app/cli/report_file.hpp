// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>

#include "treadmark/app/report/page.hpp"

namespace treadmark::cli {

/// Makes the page and writes it as a live report; an empty name: does nothing.
void write_report_file(const std::filesystem::path& file, const std::function<app::report::Page()>& page);

/// The folder of a command's results: the one that was asked for, or for a report alone one that exists only as long as
/// this object.
class ResultFolder {
 public:
  ResultFolder(const std::filesystem::path& folder, const std::filesystem::path& report_file);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  bool wanted() const { return !path_.empty(); }
  const std::filesystem::path& path() const { return path_; }

  /// The report of what lies in the folder, if one was asked for.
  void write_report() const;

 private:
  std::filesystem::path path_, report_file_;
  bool temporary_ = false;
};

}  // namespace treadmark::cli
