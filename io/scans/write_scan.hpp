// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/core/output_file.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/model/shape/point_cloud.hpp"

namespace treadmark::io::scans {

/// Text that goes to a file piece by piece; the file appears under its name with commit().
class BlockWriter {
 public:
  explicit BlockWriter(const std::filesystem::path& file) : file_(file) {}

  /// What to append to; call flush_if_full() now and then.
  std::string& text() { return text_; }
  void flush_if_full() {
    constexpr std::size_t kFull = 1'000'000;
    if (text_.size() >= kFull) flush();
  }
  void commit();

 private:
  void flush();
  OutputFile file_;
  std::string text_;
};

void write_ply(const std::filesystem::path& file, const PointCloud& cloud, LengthUnit unit);
void write_columns(const std::filesystem::path& file, const PointCloud& cloud, LengthUnit unit, char separator);
void write_las(const std::filesystem::path& file, const PointCloud& cloud, LengthUnit unit);

}  // namespace treadmark::io::scans
