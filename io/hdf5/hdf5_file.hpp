// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::io {

/// Whether the heaps in which an HDF5 file keeps texts ("global heaps") are in order. They are the one part of its
/// structure without check sums, and the HDF5 library trusts the sizes in them. True for files without any, and for
/// files that cannot be read. Thread-safe.
bool text_heaps_sound(const std::filesystem::path& file);

/// Owns an identifier of the HDF5 library, of any kind; < 0 = none. Move-only.
class Hdf5Id {
 public:
  explicit Hdf5Id(std::int64_t id = -1) : id_(id) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Hdf5Id();

  std::int64_t get() const noexcept { return id_; }
  /// Gives the identifier up: the caller closes it.
  std::int64_t release() noexcept { return std::exchange(id_, -1); }

 private:
  std::int64_t id_;
};

/// Keeps the HDF5 library from printing its errors while it lives.
class Hdf5Silence {
 public:
  Hdf5Silence();
  ~Hdf5Silence();
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

 private:
  void* function_ = nullptr;
  void* data_ = nullptr;
};

/// A number, vector or text that describes a part of a file, in SI units.
struct Attribute {
  using Value = std::variant<int, double, Vec3, Mat3, std::string, std::vector<std::string>>;
  std::string name;
  Value value;
};

}  // namespace treadmark::io
