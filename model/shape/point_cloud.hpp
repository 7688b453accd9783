// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark {

/// Points of a scanner in the frame and unit of their file, in the order of the file.
struct PointCloud {
  std::string name;          ///< where it comes from, for messages
  std::vector<Vec3> points;  ///< finite
  std::vector<Eigen::Vector3f>
      normals;                        ///< unit vectors as the file has them, or empty; no promise which way they point
  std::vector<std::uint16_t> passes;  ///< which pass of the scanner took the point, or empty (one pass)
  std::vector<float> intensities;     ///< of the echo as the file has it, or empty; NaN: not known
  std::map<std::uint16_t, Vec3> stations;  ///< where the scanner stood, by pass; one alone is that of all points
};

/// Where the scanner stood that took a point; nullptr: not known.
inline const Vec3* station_of(const std::map<std::uint16_t, Vec3>& stations, const std::vector<std::uint16_t>& passes,
                              std::size_t point) {
  if (stations.size() == 1) return &stations.begin()->second;
  if (passes.empty()) return nullptr;
  const auto found = stations.find(passes[point]);
  return found == stations.end() ? nullptr : &found->second;
}
inline const Vec3* station_of(const PointCloud& cloud, std::size_t point) {
  return station_of(cloud.stations, cloud.passes, point);
}

/// Leaves the points for which keep(number) is true, with all that is known of them.
template <class Keep>
void keep_points(PointCloud& cloud, const Keep& keep) {
  const std::size_t count = cloud.points.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!keep(i)) continue;
    cloud.points[kept] = cloud.points[i];
    if (!cloud.normals.empty()) cloud.normals[kept] = cloud.normals[i];
    if (!cloud.passes.empty()) cloud.passes[kept] = cloud.passes[i];
    if (!cloud.intensities.empty()) cloud.intensities[kept] = cloud.intensities[i];
    ++kept;
  }
  cloud.points.resize(kept);
  if (!cloud.normals.empty()) cloud.normals.resize(kept);
  if (!cloud.passes.empty()) cloud.passes.resize(kept);
  if (!cloud.intensities.empty()) cloud.intensities.resize(kept);
}

}  // namespace treadmark
