// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/model/shape/slices.hpp"

namespace treadmark::io {

/// A slices file of a rail with so many slices that they are read some at a time. Thread-safe after check().
class SliceFile {
 public:
  /// Reads the list alone. Errors: as read_slices, of the list.
  SliceFile(const std::filesystem::path& file, const ProfileOptions& options,
            const SourcePosition& referenced_from = {});
  ~SliceFile();

  /// [m]
  std::vector<double> u() const;
  bool has_features() const;

  /// What all slices decide together, before any is read: their check sum, and which way up they are. Errors: as
  /// read_slices.
  void check();
  /// Slices [from, to), as those of the whole set, of any number of points. Errors: as read_slices, for files that have
  /// changed since.
  SliceSet read(std::size_t from, std::size_t to) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace treadmark::io
