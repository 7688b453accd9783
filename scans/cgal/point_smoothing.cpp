// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/point_smoothing.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "treadmark/scans/strays/neighbours.hpp"

namespace treadmark::scans {

namespace {

constexpr int kNormalNeighbours = 16;
constexpr int kSmoothingNeighbours = 24;
constexpr double kDistanceDecay = 4.0;  // a neighbour as far as the farthest one has the weight exp(-4)
constexpr int kNormalRounds = 2;        // fitted planes lean over an edge; their agreement sharpens it again

/// Weight of a neighbour: how near it is, and how well its normal agrees (Huang et al. 2013).
struct Weight {
  double bandwidth;
  double operator()(double squared_distance, double squared_radius, const Vec3& n, const Vec3& m) const {
    const double turn = (1.0 - n.dot(m)) / bandwidth;
    return std::exp(-kDistanceDecay * squared_distance / squared_radius - turn * turn);
  }
};

std::vector<Vec3> agreed_normals(std::span<const Vec3> points, const std::vector<Vec3>& normals, const Weight& weight) {
  std::vector<Vec3> agreed(normals.size());
  for_each_neighbourhood(points, kSmoothingNeighbours, [&](std::uint32_t i, std::span<const Neighbour> near) {
    Vec3 sum = normals[i];
    for (const Neighbour& n : near)
      sum += weight(n.squared_distance, near.back().squared_distance, normals[i], normals[n.index]) * normals[n.index];
    agreed[i] = sum.normalized();  // never zero: normals turned by more than 90 degrees have no weight
  });
  return agreed;
}

}  // namespace

std::vector<Vec3> estimate_normals(std::span<const Vec3> points, std::span<const Vec3> outward) {
  std::vector<Vec3> normals(points.size());
  for_each_neighbourhood(points, kNormalNeighbours, [&](std::uint32_t i, std::span<const Neighbour> near) {
    Vec3 mean = points[i];
    for (const Neighbour& n : near) mean += points[n.index];
    mean /= static_cast<double>(near.size() + 1);
    Mat3 spread = (points[i] - mean) * (points[i] - mean).transpose();
    for (const Neighbour& n : near) spread += (points[n.index] - mean) * (points[n.index] - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(spread);  // eigenvalues ascend: the first direction is the thinnest
    const Vec3 normal = eigen.eigenvectors().col(0).normalized();
    normals[i] = normal.dot(outward[i]) < 0.0 ? Vec3(-normal) : normal;
  });
  return normals;
}

void smooth_points(std::vector<Vec3>& points, std::span<const Vec3> outward, double sharpness_deg, int rounds) {
  const Weight weight{1.0 - std::cos(sharpness_deg * std::numbers::pi / 180.0)};
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vec3> normals = estimate_normals(points, outward);
    for (int i = 0; i < kNormalRounds; ++i) normals = agreed_normals(points, normals, weight);
    std::vector<Vec3> moved(points.size());
    for_each_neighbourhood(points, kSmoothingNeighbours, [&](std::uint32_t i, std::span<const Neighbour> near) {
      double height = 0.0, total = 1.0;  // the point itself
      for (const Neighbour& n : near) {
        const double w = weight(n.squared_distance, near.back().squared_distance, normals[i], normals[n.index]);
        height += w * 0.5 * (points[i] - points[n.index]).dot(normals[i] + normals[n.index]);
        total += w;
      }
      moved[i] = points[i] - height / total * normals[i];
    });
    points = std::move(moved);
  }
}

}  // namespace treadmark::scans
