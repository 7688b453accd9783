// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>

#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/points/unit_words.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/column_layout.hpp"
#include "treadmark/io/scans/lzf.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

constexpr std::uint64_t kMostPoints = 1'000'000'000'000;
constexpr std::size_t kLongestRecord = 1'000'000;  // bytes of a point

/// What a dimension of a field holds (0 to 7: x y z nx ny nz pass intensity), and where.
struct PcdField {
  std::string name;
  std::size_t size = 4, count = 1;
  char type = 'F';
  int value = -1;
  std::size_t offset = 0;  ///< in a record [bytes]
  std::size_t column = 0;  ///< in a line of text
};

struct PcdHeader {
  enum class Data { ascii, binary, compressed };
  Data data = Data::ascii;
  std::vector<PcdField> fields;
  std::size_t record = 0;   ///< bytes
  std::size_t columns = 0;  ///< of text
  std::uint64_t points = 0;
  bool normals = false, pass = false, intensity = false, moved = false;  ///< moved: the viewpoint is not the origin
  UnitFinder unit;
};

/// Reads the header, which are lines of text up to that of DATA, and leaves the bytes where the points begin.
class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(ByteBlocks& bytes) : lines_(bytes) {}

  PcdHeader read() {
    std::string_view line;
    while (lines_.next(line)) {
      constexpr int kMostLines = 1000;
      if (lines_.number() > kMostLines) break;
      if (kind_of_line(line) == LineKind::comment) {
        header_.unit.look_at(comment_text(line));
        continue;
      }
      words_ = fields_of(line, ' ');
      if (words_.empty()) continue;
      if (take(profiles::lower(words_.front().text))) {
        finish();
        return std::move(header_);
      }
    }
    lines_.fail("the header of a PCD file ends with a line DATA, there is none", 0, "is the file truncated?");
  }

  int number() const { return lines_.number(); }

 private:
  /// Takes the line of a key. Whether it was the last of the header.
  bool take(const std::string& key) {
    if (key == "version") {
      seen_ = true;
    } else if (key == "fields" || key == "columns") {
      seen_ = true;
      header_.fields.clear();
      for (std::size_t k = 1; k < words_.size(); ++k) header_.fields.push_back({std::string(words_[k].text)});
      if (header_.fields.empty()) fail("FIELDS names nothing");
    } else if (key == "size") {
      for_fields([&](PcdField& field, const Field& word) { field.size = whole(word, 1, 8); });
    } else if (key == "type") {
      for_fields([&](PcdField& field, const Field& word) {
        field.type = word.text.size() == 1 ? word.text[0] : ' ';
        if (field.type != 'F' && field.type != 'U' && field.type != 'I')
          lines_.fail("a type is one of F, U and I, this is " + profiles::printable(word.text), word.column);
      });
    } else if (key == "count") {
      for_fields([&](PcdField& field, const Field& word) { field.count = whole(word, 1, kLongestRecord); });
    } else if (key == "width" || key == "height" || key == "points") {
      if (words_.size() != 2) fail("one number is expected behind " + profiles::printable(words_.front().text));
      (key == "width" ? width_ : key == "height" ? height_ : points_) = whole(words_[1], 0, kMostPoints);
    } else if (key == "viewpoint") {
      constexpr double kNone[] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
      if (words_.size() != 8) fail("VIEWPOINT has seven numbers: a place and a quaternion");
      for (std::size_t k = 0; k < 7; ++k) header_.moved |= number_in(lines_, words_[k + 1]) != kNone[k];
    } else if (key == "data") {
      const std::string how = words_.size() == 2 ? profiles::lower(words_[1].text) : "";
      if (how != "ascii" && how != "binary" && how != "binary_compressed")
        fail("DATA is ascii, binary or binary_compressed");
      header_.data = how == "ascii"    ? PcdHeader::Data::ascii
                     : how == "binary" ? PcdHeader::Data::binary
                                       : PcdHeader::Data::compressed;
      return true;
    } else if (!seen_) {
      lines_.fail("a PCD file begins with its header (VERSION, FIELDS ...), this is " +
                      profiles::printable(words_.front().text),
                  words_.front().column, "if these are columns of points, rename the file to .xyz");
    } else {
      lines_.fail("unknown line " + profiles::printable(words_.front().text) + " in the header", words_.front().column);
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }

  template <class Set>
  void for_fields(const Set& set) {
    if (header_.fields.empty() || words_.size() != header_.fields.size() + 1)
      fail(fmt::format("{} for {} FIELDS", words_.size() - 1, header_.fields.size()));
    for (std::size_t k = 0; k < header_.fields.size(); ++k) set(header_.fields[k], words_[k + 1]);
  }

  std::uint64_t whole(const Field& word, std::uint64_t least, std::uint64_t most) const {
    const std::uint64_t value = count_in(lines_, word);
    if (value < least || value > most) lines_.fail(fmt::format("{} to {} is possible here", least, most), word.column);
    return value;
  }

  void finish() {
    if (header_.fields.empty()) fail("the header lacks FIELDS");
    if (width_ && height_) {
      const std::uint64_t product = *height_ > 0 && *width_ > kMostPoints / *height_ ? kMostPoints : *width_ * *height_;
      if (points_ && *points_ != product) fail(fmt::format("POINTS is {}, WIDTH times HEIGHT {}", *points_, product));
      header_.points = product;
    } else if (points_ || width_) {
      header_.points = points_ ? *points_ : *width_;
    } else {
      fail("the header lacks POINTS");
    }
    std::vector<std::string> names;
    for (PcdField& field : header_.fields) {
      const bool known = field.type == 'F' ? field.size == 4 || field.size == 8
                                           : field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8;
      if (!known && field.name != "_")
        fail(fmt::format("the field {} cannot be of type {} and {} bytes", profiles::printable(field.name), field.type,
                         field.size));
      field.offset = header_.record;
      field.column = header_.columns;
      header_.record += field.size * field.count;
      header_.columns += field.count;
      names.push_back(field.name);
    }
    if (header_.record > kLongestRecord) fail("a point of more than a million bytes");
    const ColumnNames found = find_names(names);
    if (found.twice) fail("a coordinate is named twice in FIELDS");
    if (!found.has_xyz) fail("FIELDS does not name x, y and z");
    header_.normals = found.has_normals;
    for (std::size_t k = 0; k < names.size(); ++k) {
      PcdField& field = header_.fields[k];
      const bool is_pass = found.value[k] == ColumnLayout::kPass;
      if (is_pass && (found.loose_pass || field.type == 'F')) continue;
      if (found.value[k] >= 0 && !is_pass && field.count != 1)
        fail("COUNT of " + profiles::printable(field.name) + " must be 1");
      if (field.count != 1) continue;
      field.value = found.value[k];
      header_.pass |= is_pass;
      header_.intensity |= field.value == ColumnLayout::kIntensity;
    }
    header_.unit.add(found.unit);
  }

  LineBlocks lines_;
  std::vector<Field> words_;
  PcdHeader header_;
  std::optional<std::uint64_t> width_, height_, points_;
  bool seen_ = false;
};

double pcd_value(const char* at, const PcdField& field) {
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? static_cast<double>(load<std::int8_t>(at)) : static_cast<double>(load<std::uint8_t>(at));
    case 2:
      return is_signed ? static_cast<double>(load<std::int16_t>(at)) : static_cast<double>(load<std::uint16_t>(at));
    case 4:
      if (field.type == 'F') return static_cast<double>(load<float>(at));
      return is_signed ? static_cast<double>(load<std::int32_t>(at)) : static_cast<double>(load<std::uint32_t>(at));
    default:
      if (field.type == 'F') return load<double>(at);
      return is_signed ? static_cast<double>(load<std::int64_t>(at)) : static_cast<double>(load<std::uint64_t>(at));
  }
}

void add_values(CloudBuilder& builder, const VertexValues& v) {
  builder.add({v[0], v[1], v[2]}, {static_cast<float>(v[3]), static_cast<float>(v[4]), static_cast<float>(v[5])},
              builder.has_passes() ? builder.pass(v[kPassValue]) : std::uint16_t{0},
              static_cast<float>(v[kIntensityValue]));
}

void read_text(const PcdHeader& header, LineBlocks& lines, CloudBuilder& builder) {
  std::string_view line;
  VertexValues values{};
  std::optional<char> separator;
  std::vector<int> value(header.columns, -1);
  for (const PcdField& field : header.fields)
    if (field.value >= 0) value[field.column] = field.value;
  builder.expect(header.points);
  for (std::uint64_t i = 0; i < header.points;) {
    if (!lines.next(line))
      lines.fail(fmt::format("{} points are promised, the file ends after {}", header.points, i), 0,
                 "is it truncated?");
    if (line.find_first_not_of(" \t\v\f") == std::string_view::npos) continue;
    if (!separator) separator = line.find(',') == std::string_view::npos ? ' ' : ',';
    FieldScanner fields(line, *separator);
    Field field;
    for (std::size_t k = 0; k < header.columns; ++k) {
      if (!fields.next(field))
        lines.fail(fmt::format("the line has {} numbers, FIELDS and COUNT ask for {}", k, header.columns), 0,
                   "is the file truncated?");
      if (value[k] >= 0) values[static_cast<std::size_t>(value[k])] = number_in(lines, field);
    }
    if (fields.next(field) && !field.text.empty())
      lines.fail("the line has more numbers than FIELDS and COUNT ask for", field.column);
    add_values(builder, values);
    ++i;
  }
  while (lines.next(line))
    if (line.find_first_not_of(" \t\v\f") != std::string_view::npos)
      lines.fail(fmt::format("more lines than the {} points that are promised", header.points), 1,
                 "correct WIDTH and POINTS in the header");
}

void read_records(ByteBlocks& bytes, const PcdHeader& header, CloudBuilder& builder) {
  VertexValues values{};
  builder.expect(header.points);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const char* const at = bytes.need(header.record);
    for (const PcdField& field : header.fields)
      if (field.value >= 0) values[static_cast<std::size_t>(field.value)] = pcd_value(at + field.offset, field);
    add_values(builder, values);
    bytes.consume(header.record);
  }
}

/// Two 32-bit lengths, then LZF: all values of the first field, then all of the second ...
void read_compressed(ByteBlocks& bytes, const PcdHeader& header, CloudBuilder& builder) {
  const char* const lengths = bytes.need(8);
  const std::uint64_t packed = load<std::uint32_t>(lengths), unpacked = load<std::uint32_t>(lengths + 4);
  bytes.consume(8);
  const std::uint64_t left = bytes.left();
  if (packed > left)
    bytes.fail(fmt::format("{} compressed bytes are promised, the file holds {}", packed, left), "is it truncated?");
  if (header.points > unpacked / std::max<std::size_t>(header.record, 1) || header.points * header.record != unpacked)
    bytes.fail(fmt::format("{} points of {} bytes are promised, {} bytes are compressed", header.points, header.record,
                           unpacked),
               "is the file damaged?");
  if (unpacked > packed * kMostOfLzf)
    bytes.fail(fmt::format("{} bytes cannot stand for {}", packed, unpacked), "is the file damaged?");
  std::string data(static_cast<std::size_t>(unpacked), '\0');
  if (!unpack_lzf({bytes.need(static_cast<std::size_t>(packed)), static_cast<std::size_t>(packed)}, data))
    bytes.fail("the compressed data are damaged", "was the file copied to its end, and as binary?");
  bytes.consume(static_cast<std::size_t>(packed));
  builder.reserve(header.points);
  VertexValues values{};
  for (std::uint64_t i = 0; i < header.points; ++i) {
    for (const PcdField& field : header.fields)
      if (field.value >= 0)
        values[static_cast<std::size_t>(field.value)] =
            pcd_value(data.data() + field.offset * header.points + i * field.size, field);
    add_values(builder, values);
  }
}

}  // namespace

Scan parse_pcd(ByteBlocks& bytes, const ScanReadOptions& options) {
  PcdHeaderReader reader(bytes);
  const PcdHeader header = reader.read();
  const bool text = header.data == PcdHeader::Data::ascii;
  std::optional<LineBlocks> lines;
  if (text) lines.emplace(bytes, reader.number() + 1);
  CloudBuilder builder(bytes, options, text ? 2 * header.columns : header.record,
                       [&](const std::string& message, const std::string& advice) {
                         if (lines && lines->start() > 0) lines->fail(message, 0, advice);
                         bytes.fail(message, advice);
                       });
  builder.set_content(header.normals, header.pass);
  builder.set_intensities(header.intensity);
  if (header.data == PcdHeader::Data::ascii)
    read_text(header, *lines, builder);
  else if (header.data == PcdHeader::Data::binary)
    read_records(bytes, header, builder);
  else
    read_compressed(bytes, header, builder);
  std::string format = fmt::format("PCD, {}", text                                     ? "ASCII"
                                              : header.data == PcdHeader::Data::binary ? "binary"
                                                                                       : "binary compressed");
  if (header.normals) format += ", normals";
  if (header.pass && builder.keep_different_passes()) {
    const auto pass = std::find_if(header.fields.begin(), header.fields.end(),
                                   [](const PcdField& f) { return f.value == ColumnLayout::kPass; });
    format += ", pass from the field " + profiles::lower(pass->name);
  }
  if (header.moved) format += ", viewpoint ignored";
  return builder.finish(std::move(format), header.unit.unit());
}

}  // namespace treadmark::io::scans
