// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/points/sink.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::io::scans {

using namespace points;

/// Collects the points of a file and never makes room for more than the rest of the file can hold.
class CloudBuilder {
 public:
  /// least_bytes: that a point takes in this kind of file.
  CloudBuilder(const ByteBlocks& bytes, const ScanReadOptions& options, std::size_t least_bytes, Fail fail);

  void set_content(bool normals, bool passes) {
    normals_ = normals && !batch_;
    passes_ = passes;
  }

  /// Whether add() gets them.
  void set_intensities(bool intensities) { intensities_ = intensities; }
  /// Where the scanner stood that took the points to come, in the unit of the file.
  void set_station(std::uint16_t pass, const Vec3& place);

  bool has_passes() const { return passes_; }
  void drop_passes() {
    passes_ = false;
    scan_.cloud.passes = {};
  }

  /// Makes room for points that the file promises from here on; refuses what it cannot hold or what is too many.
  void expect(std::uint64_t count);

  /// Makes room for points whose data are there already; refuses what is too many.
  void reserve(std::uint64_t count);

  /// The normal is made a unit vector, or zero where it says nothing.
  void add(const Vec3& point, const Eigen::Vector3f& normal = Eigen::Vector3f::Zero(), std::uint16_t pass = 0,
           float intensity = std::numeric_limits<float>::quiet_NaN()) {
    ++scan_.points_in_file;
    if (!point.allFinite()) {
      ++scan_.not_finite;
      return;
    }
    if ((box_ && !box_->contains(point)) || (ranges_ && is_out_of_range(point, intensity))) {
      ++scan_.outside;
      return;
    }
    if (scan_.cloud.points.size() == scan_.cloud.points.capacity()) grow();
    scan_.cloud.points.push_back(point);
    if (normals_) scan_.cloud.normals.push_back(unit_or_zero(normal));
    if (passes_) scan_.cloud.passes.push_back(pass);
    if (intensities_ && !batch_) scan_.cloud.intensities.push_back(intensity);
  }

  /// Whether add() would take the point.
  bool takes(const Vec3& point) const {
    return point.allFinite() && (!box_ || box_->contains(point)) &&
           !(ranges_ && is_out_of_range(point, std::numeric_limits<float>::quiet_NaN()));
  }

  /// A place without a point: the file says that the scanner got no echo there.
  void add_lost() {
    ++scan_.points_in_file;
    ++scan_.not_finite;
  }

  void add_withheld() {
    ++scan_.points_in_file;
    ++scan_.withheld;
  }

  /// The pass that a number of the file names; fails for what is no whole number up to 65535.
  std::uint16_t pass(double number) const {
    if (!(number >= 0.0 && number <= 65535.0) || number != static_cast<double>(to_whole<std::uint16_t>(number)))
      bad_pass(number);
    return to_whole<std::uint16_t>(number);
  }

  Scan& scan() { return scan_; }

  /// Forgets passes that are the same everywhere. Whether there are several (of batches: in all of them).
  bool keep_different_passes();

  /// The result; Error(input_data) where there is no finite point.
  Scan finish(std::string format, std::optional<LengthUnit> unit);

  static Eigen::Vector3f unit_or_zero(const Eigen::Vector3f& normal);

 private:
  void grow();
  void hand_over();
  void make_room(std::size_t count);
  bool is_out_of_range(const Vec3& point, float intensity) const;
  [[noreturn]] void bad_pass(double number) const;

  const ByteBlocks& bytes_;
  std::size_t most_points_, least_bytes_;
  Fail fail_;
  std::optional<Eigen::AlignedBox3d> box_;
  std::function<void(PointCloud&)> batch_;
  std::size_t handed_over_ = 0;      ///< points that went with batches
  std::uint16_t pass_of_batch_ = 0;  ///< of the last point of these
  bool normals_ = false, passes_ = false, intensities_ = false;
  std::optional<ScanRanges> ranges_;
  std::optional<Vec3> station_;  ///< of the points to come
  bool station_of_file_ = false;
  Scan scan_;
};

}  // namespace treadmark::io::scans
