// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/scans/parse_points.hpp"

#include <utility>

#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/points/parse_obj.hpp"
#include "treadmark/io/points/parse_off.hpp"
#include "treadmark/io/points/parse_ply.hpp"
#include "treadmark/io/points/parse_stl.hpp"
#include "treadmark/io/points/unit_words.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

/// Collects points, and the unit that comments state.
class CloudSink : public CloudBuilder {
 public:
  using Options = ScanReadOptions;
  static constexpr bool kFaces = false;
  using CloudBuilder::CloudBuilder;

  static double number(const LineBlocks& lines, const Field& field) { return number_in(lines, field); }
  static std::uint64_t count(const LineBlocks& lines, const Field& field) { return count_in(lines, field); }
  [[noreturn]] static void too_few(const LineBlocks& lines, const Field& key, const char* what) {
    lines.fail(what, key.column, "is the file truncated?");
  }
  void comment(std::string_view text) { unit_.look_at(text); }
  void expect(std::uint64_t vertices, std::uint64_t) { CloudBuilder::expect(vertices); }
  void add_values(const VertexValues& v) {
    CloudBuilder::add({v[0], v[1], v[2]},
                      {static_cast<float>(v[3]), static_cast<float>(v[4]), static_cast<float>(v[5])},
                      has_passes() ? pass(v[kPassValue]) : std::uint16_t{0}, static_cast<float>(v[kIntensityValue]));
  }
  /// Bit by bit the same point counts once.
  void add_corner(const Vec3& p) {
    if (!takes(p) || known_.insert(p, scan().cloud.points)) add(p);
  }
  void end_face() {}
  Scan finish(std::string format) { return CloudBuilder::finish(std::move(format), unit_.unit()); }

 private:
  UnitFinder unit_;
  VertexSet known_;
};

/// Normals of OBJ files stand apart from the vertices: they count where each vertex has its own.
class ObjCloudSink : public CloudSink {
 public:
  using CloudSink::CloudSink;

  void add(const Vec3& p) {
    if (!takes(p)) left_out_.push_back(scan().points_in_file);
    CloudSink::add(p);
  }
  void add_normal(const Vec3& n) { normals_.push_back(unit_or_zero(n.cast<float>())); }
  bool wants_corners() const { return own_normals_; }

  /// Whether the corner "7//7" or "7/2/7" takes the normal of the vertex's own number. Negative numbers count back from
  /// the last vertex and normal so far.
  void add_obj_corner(const LineBlocks&, const Field& field) {
    const std::string_view corner = field.text;
    const std::size_t first = corner.find('/'), last = corner.rfind('/');
    if (first == std::string_view::npos || first == last) return;  // no normal is named
    const auto number = [](std::string_view text, std::size_t count) {
      long long value = 0;
      from_chars(text.data(), text.data() + text.size(), value);
      return value < 0 ? static_cast<long long>(count) + 1 + value : value;
    };
    own_normals_ =
        number(corner.substr(0, first), scan().points_in_file) == number(corner.substr(last + 1), normals_.size());
  }

  Scan finish(std::string format) {
    if (!normals_.empty() && normals_.size() == scan().points_in_file && own_normals_) {
      format += ", normals";
      std::size_t kept = 0;
      auto skip = left_out_.begin();
      for (std::size_t i = 0; i < normals_.size(); ++i) {
        if (skip != left_out_.end() && *skip == i)
          ++skip;
        else
          normals_[kept++] = normals_[i];
      }
      normals_.resize(kept);
      scan().cloud.normals = std::move(normals_);
    } else if (!normals_.empty()) {
      format += ", normals ignored (not one for each vertex)";
    }
    return CloudSink::finish(std::move(format));
  }

 private:
  std::vector<Eigen::Vector3f> normals_;
  std::vector<std::size_t> left_out_;  ///< vertices that are not finite
  bool own_normals_ = true;
};

}  // namespace

Scan parse_ply(ByteBlocks& bytes, const ScanReadOptions& options) {
  return points::parse_ply<CloudSink>(bytes, options);
}

Scan parse_stl(ByteBlocks& bytes, const ScanReadOptions& options) {
  ScanReadOptions limited = options;
  limited.most_points = std::min(options.most_points, VertexSet::kMost);
  limited.batch = {};  // corners are looked for among all points
  Scan scan = points::parse_stl<CloudSink>(bytes, limited);
  if (!options.batch) return scan;
  const std::vector<Vec3> all = std::exchange(scan.cloud.points, {});
  for (std::size_t from = 0; from < all.size(); from += ScanReadOptions::kBatch) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(from);
    scan.cloud.points.assign(begin,
                             begin + static_cast<std::ptrdiff_t>(std::min(ScanReadOptions::kBatch, all.size() - from)));
    options.batch(scan.cloud);
  }
  scan.cloud.points.clear();
  return scan;
}

Scan parse_obj(ByteBlocks& bytes, const ScanReadOptions& options) {
  return points::parse_obj<ObjCloudSink>(bytes, options);
}

Scan parse_off(ByteBlocks& bytes, const ScanReadOptions& options) {
  return points::parse_off<CloudSink>(bytes, options);
}

}  // namespace treadmark::io::scans
