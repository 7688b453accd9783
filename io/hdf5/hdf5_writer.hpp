// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "treadmark/io/hdf5/hdf5_file.hpp"

namespace treadmark::io {

/// What is written with the values of a dataset.
struct Hdf5Dataset {
  std::string name;
  std::vector<std::size_t> shape;  ///< rows first; empty = one value
  std::string unit, meaning;       ///< its attributes
  bool compressed = false;         ///< where deflate is available and there are values
};

/// Values of a file that wait to be compressed.
struct Hdf5Pending;

/// A group of an HDF5 file being written. Equal calls give equal bytes: no times are stored.
/// Names are not empty, not ".", and have no slash and no zero byte. Errors of all functions: Error(configuration).
/// Not to be used from two threads at once, not even for different files: the HDF5 library may not be thread-safe.
class Hdf5GroupWriter {
 public:
  Hdf5GroupWriter make_group(const std::string& name) const;
  void add(const Attribute& attribute) const;
  void add(std::span<const Attribute> attributes) const;
  void write(const Hdf5Dataset& dataset, std::span<const double> values) const;
  void write(const Hdf5Dataset& dataset, std::span<const std::uint8_t> values) const;
  void write(const Hdf5Dataset& dataset, std::span<const std::string> values) const;  ///< UTF-8

  /// Everything in another HDF5 file becomes a group of this one. Errors: also Error(input_data) where it cannot be
  /// read.
  void copy_file(const std::filesystem::path& source, const std::string& name) const;

 private:
  friend class Hdf5Writer;
  Hdf5GroupWriter(Hdf5Id id, std::shared_ptr<Hdf5Pending> pending) : id_(std::move(id)), pending_(std::move(pending)) {}
  Hdf5Id id_;
  std::shared_ptr<Hdf5Pending> pending_;  ///< of the file
};

/// The bytes of a file that was made in memory.
struct Hdf5Image {
  struct Free {
    void operator()(char* memory) const { std::free(memory); }
  };
  std::unique_ptr<char, Free> bytes;
};

/// An HDF5 file being written, readable by the HDF5 library from version 1.8 on. It is made in memory, where it takes
/// as much as on the disk and what waits to be compressed, on all threads at a time, as much again as 64 MiB; nothing
/// of it stands on the disk before commit(). The same bytes for any number of threads.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(std::filesystem::path file);

  const Hdf5GroupWriter& root() const { return root_; }

  /// Writes the file, replacing what was there (core/output_file.hpp). Errors: Error(configuration). No group is used
  /// afterwards.
  void commit();

 private:
  Hdf5Silence silence_;
  std::filesystem::path target_;
  Hdf5Image image_;
  Hdf5Id file_;
  Hdf5GroupWriter root_;
};

/// A column of a file that is filled piece by piece.
struct Hdf5Column {
  enum class Kind { number, byte, text };
  std::string name, unit, meaning;
  Kind kind = Kind::number;
  std::size_t rows = 0;
  std::size_t width = sizeof(double);  ///< bytes of a value: 8, 1, or those of the longest text (UTF-8)
};

/// An HDF5 file of columns that need not fit into memory. The library makes it without values, which then are put to
/// their places, so that a disk that is full is an error as of any other file. Not compressed; equal values give equal
/// bytes. Written straight: for files within an OutputFolder. Errors of all functions: Error(configuration). Not to be
/// made from two threads at once.
class Hdf5ColumnFile {
 public:
  Hdf5ColumnFile(std::filesystem::path file, std::span<const Attribute> attributes,
                 std::span<const Hdf5Column> columns);
  ~Hdf5ColumnFile();
  Hdf5ColumnFile(const Hdf5ColumnFile&) = delete;
  Hdf5ColumnFile& operator=(const Hdf5ColumnFile&) = delete;

  /// Values from this row on.
  void write(std::size_t column, std::size_t row, std::span<const double> values);
  void write(std::size_t column, std::size_t row, std::span<const std::uint8_t> values);
  void write(std::size_t column, std::size_t row, const std::string& text);
  /// Adds the check sum, with check points. No value is written afterwards.
  void finish();

 private:
  struct Place {
    std::uint64_t offset;
    std::size_t width;
  };
  void put(std::uint64_t at, const void* bytes, std::size_t size);

  std::filesystem::path file_;
  std::vector<Place> places_;  ///< by column
  int descriptor_ = -1;
};

}  // namespace treadmark::io
