// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/stray_points.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/scans/strays/neighbours.hpp"
#include "treadmark/scans/strays/point_checks.hpp"
#include "treadmark/scans/strays/point_clusters.hpp"
#include "treadmark/scans/strays/point_spacing.hpp"

namespace treadmark::scans {

namespace {

constexpr std::size_t kLeastPoints = 100;
constexpr double kOutlierDistance = 4.0;  // times the median of the same distance
constexpr double kClusterGap = 6.0;       // times the median spacing

void check(const StraySettings& s) {
  const auto fail = [](const char* why) { throw Error(ErrorKind::configuration, why); };
  if (s.neighbours < 1) fail("stray points: the number of neighbours must be positive");
  if (!(s.outlier_distance >= 0.0) || !(s.cluster_gap >= 0.0)) fail("stray points: a distance is negative");
  if (!(s.least_cluster >= 0.0 && s.least_cluster <= 1.0)) fail("stray points: least_cluster must lie between 0 and 1");
}

/// Marks the points of groups that are small beside the largest one. Outliers bridge no gaps and count for no group.
void mark_clusters(std::span<const Vec3> points, double gap, double least_cluster, StrayResult& result) {
  std::vector<Vec3> rest;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (result.of_point[i] == Stray::no) {
      rest.push_back(points[i]);
      index.push_back(i);
    }
  const std::vector<std::uint32_t> group = cluster_points(rest, gap);
  std::vector<std::size_t> size;
  for (const std::uint32_t g : group) {
    if (g >= size.size()) size.resize(g + 1, 0);
    ++size[g];
  }
  if (size.empty()) return;
  const double least = least_cluster * static_cast<double>(*std::max_element(size.begin(), size.end()));
  const auto is_stray = [&](std::size_t points_of_group) { return static_cast<double>(points_of_group) < least; };
  result.clusters = static_cast<std::size_t>(std::count_if(size.begin(), size.end(), is_stray));
  for (std::size_t i = 0; i < group.size(); ++i)
    if (is_stray(size[group[i]])) {
      result.of_point[index[i]] = Stray::cluster;
      ++result.cluster_points;
    }
}

}  // namespace

StrayResult find_strays(std::span<const Vec3> points, const StraySettings& settings) {
  check(settings);
  check_points(points, kLeastPoints, "stray points");
  const NormalisedPoints normal = normalise_points(points);

  std::vector<double> distance(points.size()), spacing(points.size());
  const int neighbours = std::max(settings.neighbours, kSpacingNeighbours);
  for_each_neighbourhood(normal.points, neighbours, [&](std::uint32_t i, std::span<const Neighbour> near) {
    const auto mean = [&](int count) {
      const std::size_t used = std::min(near.size(), static_cast<std::size_t>(count));
      double sum = 0.0;
      for (const Neighbour& n : near.first(used)) sum += std::sqrt(n.squared_distance);
      return sum / static_cast<double>(used);
    };
    distance[i] = mean(settings.neighbours);
    spacing[i] = mean(kSpacingNeighbours);
  });
  StrayResult result;
  const double typical = median(spacing);
  if (!(typical > 0.0))
    throw Error(ErrorKind::input_data, "stray points: most points coincide with others", {}, "thin them first");
  result.spacing = typical * normal.unit;

  const double outlier =
      settings.outlier_distance > 0.0 ? settings.outlier_distance / normal.unit : kOutlierDistance * median(distance);
  result.of_point.assign(points.size(), Stray::no);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (distance[i] > outlier) {
      result.of_point[i] = Stray::outlier;
      ++result.outliers;
    }
  const double gap = settings.cluster_gap > 0.0 ? settings.cluster_gap / normal.unit : kClusterGap * typical;
  mark_clusters(normal.points, gap, settings.least_cluster, result);
  return result;
}

}  // namespace treadmark::scans
