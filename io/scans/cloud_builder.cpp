// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/cloud_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::io::scans {

CloudBuilder::CloudBuilder(const ByteBlocks& bytes, const ScanReadOptions& options, std::size_t least_bytes, Fail fail)
    : bytes_(bytes),
      most_points_(options.most_points),
      least_bytes_(std::max<std::size_t>(least_bytes, 1)),
      fail_(std::move(fail)),
      box_(options.box),
      batch_(options.batch),
      ranges_(options.ranges),
      station_(options.station) {
  scan_.cloud.name = bytes.file();
  if (station_) scan_.cloud.stations[0] = *station_;
}

void CloudBuilder::set_station(std::uint16_t pass, const Vec3& place) {
  if (station_ && !station_of_file_) return;  // what was asked for
  station_of_file_ = true;
  station_ = place;
  scan_.cloud.stations[pass] = place;
}

bool CloudBuilder::is_out_of_range(const Vec3& point, float intensity) const {
  const double away = station_ ? (point - *station_).norm() : ranges_->nearest;
  return away < ranges_->nearest || away > ranges_->farthest ||
         static_cast<double>(intensity) < ranges_->least_intensity;
}

void CloudBuilder::make_room(std::size_t count) {
  PointCloud& cloud = scan_.cloud;
  cloud.points.reserve(count);
  if (normals_) cloud.normals.reserve(count);
  if (passes_) cloud.passes.reserve(count);
  if (intensities_ && !batch_) cloud.intensities.reserve(count);
}

void CloudBuilder::expect(std::uint64_t count) {
  if (count > bytes_.left() / least_bytes_ + 1)
    fail_(fmt::format("{} points are promised, more than the file can hold", count), "is it truncated?");
  reserve(count);
}

void CloudBuilder::reserve(std::uint64_t count) {
  if (count > most_points_)
    fail_(fmt::format("{} points, more than the {} allowed", count, most_points_), "thin out the points");
  if (batch_) return;  // grow() makes room for one
  PointCloud& cloud = scan_.cloud;
  const std::size_t have = cloud.points.size();
  std::size_t room = have + static_cast<std::size_t>(count);
  if (room <= cloud.points.capacity()) return;
  // many small parts one after the other must not move all points each time
  const std::size_t rest = static_cast<std::size_t>(bytes_.left() / least_bytes_) + 1;
  if (have > 0) room = std::max(room, have + std::min(have / 2, rest));
  make_room(room);
}

void CloudBuilder::grow() {
  PointCloud& cloud = scan_.cloud;
  if (batch_) {
    hand_over();
    make_room(ScanReadOptions::kBatch);
  }
  const std::size_t have = cloud.points.size();
  if (have + handed_over_ >= most_points_)
    fail_(fmt::format("more than the {} points allowed", most_points_), "thin out the points");
  if (batch_) return;
  // The points so far tell how many the rest of the file has. Room that is not used costs no memory, moving costs
  // twice.
  constexpr std::size_t kFirst = 4096;
  std::size_t room = have + std::max(kFirst, have / 8);
  if (have >= kFirst) {
    const double density = static_cast<double>(have) / static_cast<double>(bytes_.offset() + 1);
    const double rest = 1.02 * density * static_cast<double>(bytes_.left());
    const double most = static_cast<double>(bytes_.left() / least_bytes_ + 1);
    room = std::max(room, have + to_whole<std::size_t>(std::min(rest, most)));
  }
  make_room(std::min(room, most_points_));
}

void CloudBuilder::hand_over() {
  PointCloud& cloud = scan_.cloud;
  if (cloud.points.empty()) return;
  keep_different_passes();
  if (passes_) pass_of_batch_ = cloud.passes.back();
  handed_over_ += cloud.points.size();
  batch_(cloud);
  cloud.points.clear();
  cloud.passes.clear();
}

Eigen::Vector3f CloudBuilder::unit_or_zero(const Eigen::Vector3f& normal) {
  const Vec3 n = normal.cast<double>();
  const double square = n.squaredNorm();
  if (std::abs(square - 1.0) < 1e-5) return normal;  // as the file has it
  if (!(square > 0.0 && std::isfinite(square))) return Eigen::Vector3f::Zero();
  return (n / std::sqrt(square)).cast<float>();
}

void CloudBuilder::bad_pass(double number) const {
  fail_(fmt::format("the pass {:g} is not a whole number from 0 to 65535", number),
        "number the passes so, or remove or rename this column");
  throw Error(ErrorKind::input_data, "wrong pass", {bytes_.file(), 0, 0});  // fail_ has thrown
}

bool CloudBuilder::keep_different_passes() {
  const std::vector<std::uint16_t>& passes = scan_.cloud.passes;
  if (std::adjacent_find(passes.begin(), passes.end(), std::not_equal_to<>()) != passes.end() ||
      (handed_over_ > 0 && !passes.empty() && passes.front() != pass_of_batch_))
    scan_.several_passes = true;
  if (!scan_.several_passes && !batch_) {
    // one alone is that of all points
    if (!passes.empty() && scan_.cloud.stations.size() > 1)
      std::erase_if(scan_.cloud.stations, [&](const auto& one) { return one.first != passes.front(); });
    drop_passes();
  }
  return scan_.several_passes;
}

Scan CloudBuilder::finish(std::string format, std::optional<LengthUnit> unit) {
  PointCloud& cloud = scan_.cloud;
  const auto refuse = [&](const std::string& message, const std::string& advice) {
    throw Error(ErrorKind::input_data, message, {bytes_.file(), 0, 0}, advice);
  };
  if (scan_.points_in_file == 0) refuse("the file holds no points", "is it the right file?");
  if (ranges_ && ranges_->by_distance() && !station_)
    refuse("the file does not say where the scanner stood, from which scan.nearest and scan.farthest count",
           "say it by scan.station");
  if (ranges_ && ranges_->by_intensity() && !intensities_)
    refuse("the file has no intensities, by which scan.least_intensity chooses", "leave it out");
  if (cloud.points.empty() && handed_over_ == 0)
    refuse(fmt::format("none of the {} points is finite and in use{}", scan_.points_in_file,
                       scan_.outside > 0 ? " within the box or ranges" : ""),
           scan_.outside > 0 ? "is the box in the frame and unit of the file, and are the ranges?"
                             : "was the scan exported properly?");
  if (batch_) cloud.normals = {};  // which files with vertices apart from their normals have nonetheless
  const auto is_zero = [](const Eigen::Vector3f& n) { return n.isZero(0.0f); };
  if (!cloud.normals.empty() && std::all_of(cloud.normals.begin(), cloud.normals.end(), is_zero)) {
    cloud.normals = {};
    format += "; the normals are all zero and ignored";
  }
  // the same everywhere they say nothing
  const std::vector<float>& echoes = cloud.intensities;
  const auto known = std::find_if(echoes.begin(), echoes.end(), [](float one) { return !std::isnan(one); });
  if (std::all_of(known, echoes.end(), [&](float one) { return std::isnan(one) || one == *known; }))
    cloud.intensities = {};
  if (batch_) hand_over();
  if (!passes_) scan_.several_passes = false;  // what went with batches before was none
  scan_.format = std::move(format);
  scan_.unit = unit;
  bytes_.finish();
  return std::move(scan_);
}

}  // namespace treadmark::io::scans
