// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/io/hdf5/hdf5_file.hpp"

namespace treadmark::io {

/// A group of an HDF5 file. Errors of all functions: Error(input_data) that names file and object, for objects that are
/// missing or hold something else: other types, other sizes, more values than are stored. Not to be used from two
/// threads at once, not even for different files.
class Hdf5GroupReader {
 public:
  bool has(const std::string& name) const;  ///< a group or dataset; Error only where a damaged file does not tell
  Hdf5GroupReader open_group(const std::string& name) const;
  std::vector<std::string> names() const;  ///< of groups and datasets, sorted

  /// Attributes of the group.
  bool has_attribute(const std::string& name) const;
  std::string text(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;
  int integer(const std::string& name) const;
  double number(const std::string& name) const;
  Vec3 vector(const std::string& name) const;
  Mat3 matrix(const std::string& name) const;

  /// Attribute of a dataset.
  std::string text_of(const std::string& dataset, const std::string& name) const;

  /// Values of a dataset, rows first.
  std::vector<double> numbers(const std::string& dataset) const;
  std::vector<std::uint8_t> bytes(const std::string& dataset) const;
  std::vector<std::string> strings(const std::string& dataset) const;

  /// The same of a dataset that must have this shape, which is looked at first.
  std::vector<double> numbers(const std::string& dataset, const std::vector<std::size_t>& shape) const;
  std::vector<std::uint8_t> bytes(const std::string& dataset, const std::vector<std::size_t>& shape) const;
  std::vector<std::size_t> shape(const std::string& dataset) const;

  const std::string& file() const { return file_; }

 private:
  friend class Hdf5Reader;
  Hdf5GroupReader(Hdf5Id id, std::string file) : id_(std::move(id)), file_(std::move(file)) {}
  Hdf5Id id_;
  std::string file_;
};

/// An HDF5 file opened for reading. Errors: Error(input_data) for files that are missing or no HDF5 files.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& file);
  const Hdf5GroupReader& root() const { return root_; }

 private:
  Hdf5Silence silence_;
  Hdf5Id file_;
  Hdf5GroupReader root_;
};

}  // namespace treadmark::io
