// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "treadmark/io/points/byte_blocks.hpp"
#include "treadmark/model/shape/length_unit.hpp"

namespace treadmark::io::scans {

using namespace points;

/// Places in the public header block of LAS 1.0 to 1.4 (ASPRS).
namespace las {
inline constexpr std::size_t kSystemId = 26, kSoftware = 58, kTextLength = 32, kHeaderSize = 94, kDataOffset = 96,
                             kFormat = 104, kRecordLength = 105, kCount = 107, kReturns = 111, kScale = 131,
                             kOrigin = 155, kBounds = 179, kSize12 = 227, kRecords = 100, kLateRecords = 235,
                             kCount14 = 247, kSize14 = 375, kRecordHead = 54, kLateRecordHead = 60;
}  // namespace las

/// What of the header tells where the points are.
struct LasHeader {
  int minor = 0;                  ///< of version 1.x
  int format = 0;                 ///< of point data records, 0 to 10
  std::size_t record_length = 0;  ///< with extra bytes
  std::uint64_t data_offset = 0, count = 0;
  std::array<double, 3> scale{}, origin{};
  std::optional<LengthUnit> unit;
  std::string reference;  ///< coordinate system of the Earth that a record names, in words
  bool degrees = false;   ///< whether it is one of longitudes and latitudes

  /// Byte of the point source ID within a record; LAS 1.0 has none.
  std::optional<std::size_t> source_id() const;
  /// Byte and bit of the mark of withheld points; LAS 1.0 has none.
  std::size_t withheld_byte() const { return 15; }
  unsigned withheld_bit() const { return minor == 0 ? 0u : format >= 6 ? 0x04u : 0x80u; }
};

/// Reads the header, which begins the bytes, and leaves them where the points begin.
/// Error(input_data) at the byte of the wrong field, with advice on compressed files.
LasHeader read_las_header(ByteBlocks& bytes);

}  // namespace treadmark::io::scans
