// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/platform/bit_cast.hpp"
#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/e57_layout.hpp"
#include "treadmark/io/scans/e57_pages.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

enum E57Value { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kState, kIntensity, kE57Values };

/// The packed values of a field, as far as packets have brought them.
struct E57Stream {
  const E57Field* field = nullptr;
  int value = -1;        ///< which of E57Value it is; -1: not looked at
  unsigned bits = 0;     ///< of a record
  std::string bytes;     ///< not yet decoded
  std::size_t next = 0;  ///< bit

  std::uint64_t records() const { return (8 * bytes.size() - next) / bits; }

  /// The next `bits`, least first.
  std::uint64_t take() {
    std::size_t byte = next / 8;
    const unsigned shift = next % 8;
    next += bits;
    if (bits == 0) return 0;
    std::uint64_t raw = static_cast<std::uint8_t>(bytes[byte]) >> shift;
    for (unsigned got = 8 - shift; got < bits; got += 8)
      raw |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(bytes[++byte])) << got;
    return bits == 64 ? raw : raw & ((std::uint64_t{1} << bits) - 1);
  }

  void forget_decoded() {
    constexpr std::size_t kWorth = 1 << 16;
    if (next / 8 < std::max(kWorth, bytes.size() / 2)) return;
    bytes.erase(0, next / 8);
    next %= 8;
  }
};

class E57Points {
 public:
  E57Points(ByteBlocks& bytes, E57Pages& pages, const E57Scan& scan, std::size_t number)
      : bytes_(bytes), pages_(pages), scan_(scan), number_(number) {
    find_streams();
    find_pose();
  }

  bool normals() const { return normals_; }
  bool intensities() const { return intensities_; }
  /// Whether the scanner stood where the pose is: what has neither a pose nor beams may have been put together of
  /// several scans.
  bool has_station() const { return scan_.has_pose || spherical_; }

  void read(CloudBuilder& builder, std::uint16_t pass, bool stations) {
    if (stations) builder.set_station(pass, pose_.origin);
    pages_.seek(scan_.file_offset);
    char head[32];
    pages_.read(head, sizeof head);
    left_ = load<std::uint64_t>(head + 8);
    if (load<std::uint8_t>(head) != 1 || left_ < sizeof head || left_ > bytes_.size())
      fail("no section of points lies where the XML says so", "is the file damaged?");
    left_ -= sizeof head;
    refuse_too_many(left_);
    pages_.seek(load<std::uint64_t>(head + 16));
    builder.reserve(std::min(scan_.records, left_ / 3));
    for (std::uint64_t done = 0; done < scan_.records;) {
      read_packet();
      std::uint64_t ready = scan_.records - done;
      for (const E57Stream& stream : streams_)
        if (stream.value >= 0 && stream.bits > 0) ready = std::min(ready, stream.records());
      for (std::uint64_t i = 0; i < ready; ++i) add(builder, pass);
      done += ready;
      for (E57Stream& stream : streams_) stream.forget_decoded();
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& advice) const {
    bytes_.fail(fmt::format("scan {}: {}", number_, message), advice);
  }

  void find_streams() {
    constexpr std::string_view kPlane[] = {"cartesianX", "cartesianY", "cartesianZ"},
                               kSphere[] = {"sphericalRange", "sphericalAzimuth", "sphericalElevation"},
                               kNormal[] = {"nor:normalX", "nor:normalY", "nor:normalZ"};
    streams_.resize(scan_.fields.size());
    for (std::size_t k = 0; k < streams_.size(); ++k) {
      streams_[k].field = &scan_.fields[k];
      if (scan_.fields[k].kind != E57Field::Kind::text) streams_[k].bits = scan_.fields[k].bits();
    }
    const auto find = [&](std::string_view name) {
      return std::find_if(streams_.begin(), streams_.end(), [&](const E57Stream& s) {
        return s.field->name == name && s.field->kind != E57Field::Kind::text;
      });
    };
    const auto take_three = [&](const std::string_view(&names)[3], int first) {
      for (const std::string_view name : names)
        if (find(name) == streams_.end()) return false;
      for (int k = 0; k < 3; ++k) find(names[k])->value = first + k;
      return true;
    };
    spherical_ = !take_three(kPlane, kX);
    if (spherical_ && !take_three(kSphere, kX))
      fail("its records have neither cartesianX, Y and Z nor sphericalRange, Azimuth and Elevation",
           "export it with coordinates");
    normals_ = take_three(kNormal, kNormalX);
    if (const auto state = find(spherical_ ? "sphericalInvalidState" : "cartesianInvalidState");
        state != streams_.end())
      state->value = kState;
    if (const auto intensity = find("intensity"); intensity != streams_.end()) {
      intensity->value = kIntensity;
      intensities_ = true;
    }
  }

  void find_pose() {
    const double* const q = scan_.quaternion;
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    constexpr double kRounded = 1e-3;
    if (!(std::abs(turn.norm() - 1.0) < kRounded))
      fail(fmt::format("the quaternion of its pose has the length {:g}, not 1", turn.norm()), "is the file damaged?");
    pose_.rotation = turn.normalized().toRotationMatrix();
    pose_.origin = scan_.translation;
  }

  void refuse_too_many(std::uint64_t section) const {
    unsigned bits = 0;
    for (const E57Stream& stream : streams_)
      if (stream.value >= 0) bits = std::max(bits, stream.bits);
    if (bits == 0) fail("all of its points lie at one place", "was it exported properly?");
    if (scan_.records > 8 * section / bits)
      fail(fmt::format("{} points are promised, more than its section of {} bytes can hold", scan_.records, section),
           "is the file damaged?");
  }

  void spend(std::uint64_t count) {
    if (count > left_) fail("the section of points ends before the last of them", "is the file damaged?");
    left_ -= count;
  }

  /// One packet of the section: values of all fields, an index, or nothing.
  void read_packet() {
    constexpr std::uint64_t kShort = 4, kHead = 6;
    constexpr unsigned kIndex = 0, kEmpty = 2;
    spend(kShort);
    char head[kHead];
    pages_.read(head, kShort);
    const unsigned type = load<std::uint8_t>(head);
    std::uint64_t length = std::uint64_t{load<std::uint16_t>(head + 2)} + 1;
    if (length < kShort || type > kEmpty) fail("a packet of its points is damaged", "is the file damaged?");
    length -= kShort;
    spend(length);
    if (type == kIndex || type == kEmpty) return pages_.skip(length);
    const std::uint64_t table = 2 + 2 * streams_.size();
    if (length < table) fail("a packet of its points is damaged", "is the file damaged?");
    std::string lengths(static_cast<std::size_t>(table), '\0');
    pages_.read(lengths.data(), lengths.size());
    length -= table;
    if (load<std::uint16_t>(lengths.data()) != streams_.size())
      fail(
          fmt::format("a packet has {} fields, the prototype {}", load<std::uint16_t>(lengths.data()), streams_.size()),
          "is the file damaged?");
    for (std::size_t k = 0; k < streams_.size(); ++k) {
      const std::size_t count = load<std::uint16_t>(lengths.data() + 2 + 2 * k);
      if (count > length) fail("a packet of its points is damaged", "is the file damaged?");
      length -= count;
      E57Stream& stream = streams_[k];
      if (stream.value < 0) {
        pages_.skip(count);
        continue;
      }
      const std::size_t have = stream.bytes.size();
      stream.bytes.resize(have + count);
      pages_.read(stream.bytes.data() + have, count);
    }
    pages_.skip(length);
  }

  double number(E57Stream& stream) const {
    const E57Field& field = *stream.field;
    const std::uint64_t raw = stream.take();
    if (field.kind == E57Field::Kind::single)
      return static_cast<double>(bit_cast<float>(static_cast<std::uint32_t>(raw)));
    if (field.kind == E57Field::Kind::real) return bit_cast<double>(raw);
    if (raw > static_cast<std::uint64_t>(field.most) - static_cast<std::uint64_t>(field.least))
      fail("a value of " + profiles::printable(field.name) + " lies beyond its maximum", "is the file damaged?");
    const auto value = static_cast<double>(static_cast<std::int64_t>(static_cast<std::uint64_t>(field.least) + raw));
    return field.kind == E57Field::Kind::scaled ? value * field.scale + field.offset : value;
  }

  void add(CloudBuilder& builder, std::uint16_t pass) {
    std::array<double, kE57Values> v{};
    for (E57Stream& stream : streams_)
      if (stream.value >= 0) v[static_cast<std::size_t>(stream.value)] = number(stream);
    if (v[kState] != 0.0) return builder.add_lost();
    Vec3 p(v[kX], v[kY], v[kZ]);
    if (spherical_) p = v[0] * Vec3(std::cos(v[2]) * std::cos(v[1]), std::cos(v[2]) * std::sin(v[1]), std::sin(v[2]));
    const Vec3 normal = pose_.rotation * Vec3(v[kNormalX], v[kNormalY], v[kNormalZ]);
    builder.add(pose_.apply(p), normal.cast<float>(), pass,
                intensities_ ? static_cast<float>(v[kIntensity]) : std::numeric_limits<float>::quiet_NaN());
  }

  ByteBlocks& bytes_;
  E57Pages& pages_;
  const E57Scan& scan_;
  std::size_t number_;
  std::vector<E57Stream> streams_;
  Pose pose_;
  std::uint64_t left_ = 0;  ///< of the section
  bool spherical_ = false, normals_ = false, intensities_ = false;
};

E57Layout read_layout(ByteBlocks& bytes, E57Pages& pages) {
  constexpr std::size_t kHead = 48;
  bytes.want(kHead);
  if (!bytes.window().starts_with("ASTM-E57"))
    bytes.fail("an E57 file begins with ASTM-E57", "is the extension right?");
  const char* const head = bytes.need(kHead);
  const auto major = load<std::uint32_t>(head + 8);
  const auto size = load<std::uint64_t>(head + 16), xml = load<std::uint64_t>(head + 24),
             page = load<std::uint64_t>(head + 40);
  std::uint64_t length = load<std::uint64_t>(head + 32);
  if (major != 1) bytes.fail(fmt::format("version {} of E57 is not known", major), "version 1 is read");
  if (page != E57Pages::kPage)
    bytes.fail(fmt::format("pages of {} bytes, E57 has {}", page, E57Pages::kPage), "is the file damaged?");
  if (size > bytes.size())
    bytes.fail(fmt::format("the file should have {} bytes, it has {}", size, bytes.size()), "is it truncated?");
  if (length > bytes.size())
    bytes.fail(fmt::format("an XML of {} bytes, more than the file holds", length), "is the file damaged?");
  pages.seek(0);  // checks the page of these numbers
  pages.seek(xml);
  E57Xml reader(bytes.file());
  while (length > 0) {
    const std::string_view piece = pages.take(length);
    length -= piece.size();
    reader.feed(piece, false);
  }
  reader.feed({}, true);
  return std::move(reader.layout());
}

}  // namespace

Scan parse_e57(ByteBlocks& bytes, const ScanReadOptions& options) {
  E57Pages pages(bytes);
  const E57Layout layout = read_layout(bytes, pages);
  CloudBuilder builder(bytes, options, 1, [&](const std::string& m, const std::string& a) { bytes.fail(m, a); });
  std::vector<E57Points> scans;
  for (std::size_t k = 0; k < layout.scans.size(); ++k)
    if (layout.scans[k].records > 0) scans.emplace_back(bytes, pages, layout.scans[k], k + 1);
  const bool normals =
      !scans.empty() && std::all_of(scans.begin(), scans.end(), [](const E57Points& s) { return s.normals(); });
  builder.set_content(normals, true);
  builder.set_intensities(std::any_of(scans.begin(), scans.end(), [](const E57Points& s) { return s.intensities(); }));
  const bool stations = std::all_of(scans.begin(), scans.end(), [](const E57Points& s) { return s.has_station(); });
  for (std::size_t k = 0; k < scans.size(); ++k)
    scans[k].read(builder, builder.pass(static_cast<double>(k + 1)), stations);
  std::string format = fmt::format("E57, {} scan{}", scans.size(), scans.size() == 1 ? "" : "s");
  if (normals) format += ", normals";
  if (builder.keep_different_passes()) format += ", pass from the scan";
  Scan scan = builder.finish(std::move(format), LengthUnit::metre);
  constexpr std::size_t kLongest = 80;
  scan.reference = layout.reference.substr(0, kLongest);
  for (char& c : scan.reference)
    if (c < ' ' || c > '~') c = '?';
  return scan;
}

}  // namespace treadmark::io::scans
