// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/las_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/points/unit_words.hpp"

namespace treadmark::io::scans {

namespace {

/// Least lengths of records of the point data formats 0 to 10.
constexpr std::size_t kRecord[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// What the records about the coordinate system say: keys of GeoTIFF 1.0 or well-known text (OGC 01-009, ISO 19162).
class Reference {
 public:
  void take(unsigned record, std::string_view content) {
    constexpr unsigned kText = 2112, kDirectory = 34735, kWords = 34737;
    if (record == kText) take_text(content.substr(0, content.find('\0')));
    if (record == kWords) words_ = content;
    if (record == kDirectory) directory_ = content;
  }

  void put_into(LasHeader& header) {
    constexpr std::size_t kLongest = 80;
    take_directory();
    if (!map_) return;
    header.reference = name_.empty() ? "without a name" : name_.substr(0, kLongest);
    for (char& c : header.reference)
      if (c < ' ' || c > '~') c = '?';
    header.degrees = degrees_;
  }

 private:
  void take_text(std::string_view text) {
    const std::string_view kind = text.substr(0, text.find_first_of("[("));
    const std::size_t from = text.find('"'), to = from == text.npos ? text.npos : text.find('"', from + 1);
    // drawings and machines have coordinate systems of their own (LOCAL_CS, ENGCRS), which say nothing here
    for (const std::string_view known : {"PROJCS", "PROJCRS", "PROJECTEDCRS", "COMPD_CS", "COMPOUNDCRS", "GEOCCS",
                                         "GEOGCS", "GEOGCRS", "GEODCRS", "GEODETICCRS", "BOUNDCRS"})
      if (kind == known) map_ = true;
    degrees_ = kind == "GEOGCS" || kind == "GEOGCRS";
    if (map_ && to != text.npos) name_ = text.substr(from + 1, to - from - 1);
  }

  void take_directory() {
    constexpr std::size_t kEntry = 8;
    constexpr unsigned kModel = 1024, kCitation = 1026, kGeographic = 2048, kProjected = 3072, kOther = 32767;
    std::optional<unsigned> code;
    for (std::size_t at = kEntry; at + kEntry <= directory_.size(); at += kEntry) {
      const auto value = [&](std::size_t k) { return unsigned{load<std::uint16_t>(&directory_[at + 2 * k])}; };
      const unsigned key = value(0);
      if (key == kModel && value(1) == 0) {
        constexpr unsigned kLongitudes = 2, kMostModels = 3;
        map_ |= value(3) >= 1 && value(3) <= kMostModels;
        degrees_ |= value(3) == kLongitudes;
      }
      if ((key == kProjected || (key == kGeographic && !code)) && value(1) == 0 && value(3) < kOther) code = value(3);
      if (key == kCitation && name_.empty() && value(3) < words_.size()) name_ = words_.substr(value(3), value(2));
    }
    while (!name_.empty() && (name_.back() == '|' || name_.back() == '\0')) name_.pop_back();
    if (code && name_.empty()) name_ = fmt::format("EPSG {}", *code);
  }

  std::string directory_, words_, name_;
  bool map_ = false, degrees_ = false;
};

/// Looks at the variable records, and in LAS 1.4 at those behind the points. Broken ones end the search.
void read_reference(ByteBlocks& bytes, std::size_t header_size, LasHeader& header) {
  constexpr std::uint64_t kMostContent = 100'000;
  const std::string_view head = bytes.window();
  const std::uint32_t records = load<std::uint32_t>(&head[las::kRecords]);
  std::uint64_t late_at = 0;
  std::uint32_t late = 0;
  if (header.minor == 4) {
    late_at = load<std::uint64_t>(&head[las::kLateRecords]);
    late = load<std::uint32_t>(&head[las::kLateRecords + 8]);
  }
  Reference reference;
  const auto look = [&](std::uint64_t at, std::uint64_t end, std::uint32_t count, std::size_t size) {
    for (; count > 0 && at <= end && end - at >= size; --count) {
      bytes.seek(at);
      const std::string_view record(bytes.need(size), size);
      const std::string_view user = record.substr(2, 16);
      const unsigned id = load<std::uint16_t>(&record[18]);
      const std::uint64_t length =
          size == las::kRecordHead ? load<std::uint16_t>(&record[20]) : load<std::uint64_t>(&record[20]);
      const bool wanted = user.substr(0, user.find('\0')) == "LASF_Projection";
      at += size;
      if (length > end - at) return;
      if (wanted && length <= kMostContent) {
        const auto bytes_of = static_cast<std::size_t>(length);
        const char* const from = bytes.need(size + bytes_of) + size;
        reference.take(id, {from, bytes_of});
      }
      at += length;
    }
  };
  look(header_size, std::min(header.data_offset, bytes.size()), records, las::kRecordHead);
  if (late_at >= header_size && late_at < bytes.size()) look(late_at, bytes.size(), late, las::kLateRecordHead);
  reference.put_into(header);
}

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
            "decompress the file first: 'laszip -i in.laz -o out.las', or 'pdal translate in.laz out.las'");
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
  read_reference(bytes, size, header);
  if (header.degrees)
    fail_at(0, "the coordinates are longitudes and latitudes (" + header.reference + ")",
            "export the points in metres, in the scanner's own coordinates if possible");
  bytes.seek(header.data_offset);
  return header;
}

}  // namespace treadmark::io::scans
