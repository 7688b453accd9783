// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/las_header.hpp"

#include <fmt/format.h>

#include <cmath>

#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/points/unit_words.hpp"

namespace treadmark::io::scans {

namespace {

/// Least lengths of records of the point data formats 0 to 10.
constexpr std::size_t kRecord[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

}  // namespace

std::optional<std::size_t> LasHeader::source_id() const {
  if (minor == 0) return std::nullopt;
  return format >= 6 ? 20 : 18;
}

LasHeader read_las_header(ByteBlocks& bytes) {
  const auto fail_at = [&](std::size_t byte, const std::string& message, const std::string& advice) {
    throw Error(ErrorKind::input_data, fmt::format("at byte {}: {}", byte, message), {bytes.file(), 0, 0}, advice);
  };
  bytes.want(las::kSize14);
  const std::string_view head = bytes.window();
  if (!head.starts_with("LASF")) fail_at(0, "a LAS file begins with LASF", "is the extension right?");
  if (head.size() < las::kSize12)
    fail_at(head.size(), fmt::format("the file ends within its header of {} bytes", las::kSize12), "is it truncated?");

  LasHeader header;
  const int major = load<std::uint8_t>(&head[24]);
  header.minor = load<std::uint8_t>(&head[25]);
  if (major != 1 || header.minor > 4)
    fail_at(24, fmt::format("LAS version {}.{} is not known", major, header.minor), "versions 1.0 to 1.4 are read");
  const std::size_t size = load<std::uint16_t>(&head[las::kHeaderSize]);
  const std::size_t least = header.minor == 4 ? las::kSize14 : las::kSize12;
  if (size < least)
    fail_at(las::kHeaderSize,
            fmt::format("a header of {} bytes, version 1.{} has at least {}", size, header.minor, least), "");
  if (head.size() < least)
    fail_at(head.size(), fmt::format("the file ends within its header of {} bytes", least), "is it truncated?");
  const int format = load<std::uint8_t>(&head[las::kFormat]);
  if ((format & 0xc0) != 0)
    fail_at(las::kFormat, "the points are compressed (LAZ)",
            "decompress the file to .las first, for example with laszip");
  if (format >= static_cast<int>(std::size(kRecord)))
    fail_at(las::kFormat, fmt::format("the point data format {} is not known", format), "0 to 10 are read");
  header.format = format;
  header.record_length = load<std::uint16_t>(&head[las::kRecordLength]);
  if (header.record_length < kRecord[format])
    fail_at(las::kRecordLength,
            fmt::format("records of {} bytes, point data format {} has at least {}", header.record_length, format,
                        kRecord[format]),
            "");
  header.count = load<std::uint32_t>(&head[las::kCount]);
  if (header.minor == 4)
    if (const auto count = load<std::uint64_t>(&head[las::kCount14]); count > 0) header.count = count;
  header.data_offset = load<std::uint32_t>(&head[las::kDataOffset]);
  if (header.data_offset < size)
    fail_at(las::kDataOffset, fmt::format("the points would begin at byte {}, within the header", header.data_offset),
            "");
  for (std::size_t k = 0; k < 3; ++k) {
    header.scale[k] = load<double>(&head[las::kScale + 8 * k]);
    header.origin[k] = load<double>(&head[las::kOrigin + 8 * k]);
    if (!(header.scale[k] != 0.0 && std::isfinite(header.scale[k])))
      fail_at(las::kScale + 8 * k, fmt::format("a scale of {:g}", header.scale[k]), "is the file damaged?");
    if (!std::isfinite(header.origin[k]))
      fail_at(las::kOrigin + 8 * k, fmt::format("an offset of {:g}", header.origin[k]), "is the file damaged?");
  }
  UnitFinder unit;
  for (const std::size_t at : {las::kSystemId, las::kSoftware}) {
    const std::string_view text = head.substr(at, las::kTextLength);
    unit.look_at(text.substr(0, text.find('\0')));
  }
  header.unit = unit.unit();

  if (header.data_offset > bytes.size() || header.count > (bytes.size() - header.data_offset) / header.record_length)
    fail_at(
        las::kCount,
        fmt::format("{} points are promised, the file holds {}", header.count,
                    header.data_offset > bytes.size() ? 0 : (bytes.size() - header.data_offset) / header.record_length),
        "is it truncated?");
  bytes.skip(header.data_offset);
  return header;
}

}  // namespace treadmark::io::scans
