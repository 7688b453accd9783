// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace treadmark::report {

/// How the numbers of an array are stored.
enum class Precision { byte, two_bytes, single };

/// An array of numbers in a blob. Byte and two bytes: value = low + step code, and the greatest code is NaN where
/// `none` is set; single: IEEE numbers. Arrays of more than one byte a number have all lowest bytes first, then all
/// second ones ...: that compresses better.
struct Packed {
  int blob = 0;
  std::size_t offset = 0, count = 0;  ///< offset in bytes in the inflated blob
  Precision precision = Precision::byte;
  double low = 0.0, step = 0.0;
  bool none = false;
};

/// Arrays of numbers, packed into compressed blobs. Not thread-safe.
class BlobStore {
 public:
  /// The arrays that follow go into a blob of their own, which a reader unpacks at once.
  void begin_blob();

  /// Quantised between the least and the greatest finite value; infinities become NaN. A value lies within half a step
  /// of what was given, a step being the range over 253 or more (byte), 65533 or more (two bytes). Zero stays zero.
  Packed add(std::span<const double> values, Precision precision);

  /// Codes 0, 1, 2 ... as they are.
  Packed add_codes(std::span<const unsigned char> codes);

  /// All blobs as base64 texts of zlib streams; afterwards nothing can be added.
  const std::vector<std::string>& finish();

  /// Size of the texts of all finished blobs [bytes].
  std::size_t text_size() const;

 private:
  std::vector<std::byte>& open_blob();
  void close_blob();

  std::vector<std::string> texts_;
  std::vector<std::byte> current_;
  bool open_ = false;
};

/// The bytes as a zlib stream (RFC 1950). The same bytes give the same stream. Thread-safe. Errors: Error(numerical)
/// without memory.
std::vector<std::byte> deflated(std::span<const std::byte> bytes);

}  // namespace treadmark::report
