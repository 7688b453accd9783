// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/rough_axis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t kMostElements = 40'000;
constexpr std::size_t kScored = 2'000;
constexpr int kSamples = 400;
constexpr double kNear = 0.02;       // distance of a normal from the axis over the radius of the scan, in samples
constexpr double kEnough = 0.4;      // part of the elements that must agree
constexpr double kWellKnown = 1e-4;  // how far the second best axis must be from fitting, relative

/// Normals as lines in coordinates in which the scan has radius 1.
struct Lines {
  std::vector<Vec6> moment_normal;  ///< (p x n, n): zero product with (direction, moment) of a line that it meets
  std::vector<double> weight;
  double part = 1.0;
};

Lines lines_of(const SurfaceElements& elements) {
  Lines out;
  const std::size_t stride = std::max<std::size_t>(1, elements.position.size() / kMostElements);
  for (std::size_t i = 0; i < elements.position.size(); i += stride) {
    const Vec3 p = (elements.position[i] - elements.centre) / elements.radius;
    Vec6 line;
    line << p.cross(elements.normal[i]), elements.normal[i];
    out.moment_normal.push_back(line);
    out.weight.push_back(elements.weight[i]);
  }
  return out;
}

struct LineSolution {
  Vec3 direction, moment;  ///< moment of the axis: point x direction
  double least = 0.0, second = 0.0;
};

/// min |direction . (p x n) + moment . n|^2 over unit directions; the moment is eliminated.
std::optional<LineSolution> solve(const Mat6& normal_matrix) {
  const Mat3 mm = normal_matrix.topLeftCorner<3, 3>(), mn = normal_matrix.topRightCorner<3, 3>(),
             nn = normal_matrix.bottomRightCorner<3, 3>();
  Eigen::SelfAdjointEigenSolver<Mat3> of_nn(nn);
  const double greatest = of_nn.eigenvalues()[2];
  if (!(greatest > 0.0)) return std::nullopt;
  // normals of a cylinder are all perpendicular to it and say nothing of the moment along it
  Mat3 inverse = Mat3::Zero();
  for (int k = 0; k < 3; ++k)
    if (of_nn.eigenvalues()[k] > 1e-6 * greatest)
      inverse += of_nn.eigenvectors().col(k) * of_nn.eigenvectors().col(k).transpose() / of_nn.eigenvalues()[k];
  const Mat3 reduced = mm - mn * inverse * mn.transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> eigen(0.5 * (reduced + reduced.transpose()));
  LineSolution out;
  out.direction = eigen.eigenvectors().col(0);
  out.moment = -(inverse * mn.transpose() * out.direction);
  out.moment -= out.direction * out.direction.dot(out.moment);  // a rotation, no screw
  out.least = std::max(eigen.eigenvalues()[0], 0.0);
  out.second = std::max(eigen.eigenvalues()[1], 0.0);
  return out;
}

double residual(const Vec6& line, const LineSolution& axis) {
  return axis.direction.dot(line.head<3>()) + axis.moment.dot(line.tail<3>());
}

}  // namespace

RoughAxis rough_revolution(const SurfaceElements& elements) {
  const Lines lines = lines_of(elements);
  const std::size_t count = lines.moment_normal.size();
  Random random(1);
  std::vector<std::size_t> scored(std::min(count, kScored));
  for (std::size_t& i : scored) i = to_whole<std::size_t>(random.uniform() * static_cast<double>(count));
  std::optional<LineSolution> best;
  std::size_t best_count = 0;
  for (int sample = 0; sample < kSamples; ++sample) {
    Mat6 matrix = Mat6::Zero();
    for (int k = 0; k < 8; ++k) {
      const Vec6& line = lines.moment_normal[to_whole<std::size_t>(random.uniform() * static_cast<double>(count))];
      matrix += line * line.transpose();
    }
    const auto axis = solve(matrix);
    if (!axis) continue;
    std::size_t near = 0;
    for (const std::size_t i : scored) near += std::fabs(residual(lines.moment_normal[i], *axis)) < kNear ? 1 : 0;
    if (near > best_count) {
      best_count = near;
      best = axis;
    }
  }
  const auto refuse = [&](const char* why) {
    throw Error(
        ErrorKind::input_data, fmt::format("the scan is no wheel: {}", why), {},
        "a wheel must be scanned along enough of its circumference; is it a rail, or is something else in the scan?");
  };
  if (!best) refuse("its normals have no common axis");
  LineSolution axis = *best;
  double scale = kNear, inliers = 0.0, square = 0.0;
  for (int round = 0; round < 20; ++round) {
    Mat6 matrix = Mat6::Zero();
    std::vector<double> sizes;
    double sum = 0.0;
    inliers = square = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double r = residual(lines.moment_normal[i], axis) / (4.685 * scale);
      sizes.push_back(std::fabs(r) * 4.685 * scale);
      if (!(std::fabs(r) < 1.0)) continue;
      const double w = lines.weight[i] * (1.0 - r * r) * (1.0 - r * r);
      matrix += w * lines.moment_normal[i] * lines.moment_normal[i].transpose();
      inliers += 1.0;
      square += sizes.back() * sizes.back();
      sum += w;
    }
    if (!(sum > 0.0)) refuse("its normals have no common axis");
    const auto next = solve(matrix / sum);
    if (!next) refuse("its normals are all parallel");
    // normals that hardly turn about the axis, as all those of a plane along it, meet it nowhere
    const Mat3 about = Mat3::Identity() - next->direction * next->direction.transpose();
    const Mat3 turning =
        about * (matrix.bottomRightCorner<3, 3>() / sum) * about + next->direction * next->direction.transpose();
    // and those of a sphere miss no axis by more than the best one
    constexpr double kNoBetter = 4.0;
    if (next->second < std::max(kWellKnown * 1e-2, kNoBetter * next->least) ||
        Eigen::SelfAdjointEigenSolver<Mat3>(turning).eigenvalues()[0] < kWellKnown)
      refuse("its axis is not determined, as that of a plane or a sphere");
    const double change =
        std::min((next->direction - axis.direction).norm(), (next->direction + axis.direction).norm());
    axis = *next;
    scale = std::clamp(1.4826 * median_of(sizes), 1e-4, kNear);
    if (change < 1e-9 && round > 5) break;
  }
  RoughAxis out;
  out.inliers = inliers / static_cast<double>(count);
  out.residual = elements.radius * std::sqrt(square / std::max(inliers, 1.0));
  if (out.inliers < kEnough)
    refuse(fmt::format("only {:.0f} % of its surface turns about the best common axis", 100.0 * out.inliers).c_str());
  out.axis.direction = axis.direction.normalized();
  out.axis.point = elements.centre + elements.radius * axis.direction.cross(axis.moment) / axis.direction.squaredNorm();
  return out;
}

RoughAxis rough_sweep(const SurfaceElements& elements) {
  const std::size_t stride = std::max<std::size_t>(1, elements.position.size() / kMostElements);
  constexpr double kNearAngle = 0.1, kLeastScale = 1e-4;
  const auto refuse = [&](const char* why) {
    throw Error(ErrorKind::input_data, fmt::format("the scan is no rail: {}", why), {},
                "is it a wheel, or is something else in the scan?");
  };
  // directions of pairs of normals, scored by how many normals are perpendicular to them
  Random random(1);
  const std::size_t count = elements.position.size();
  const auto any = [&] { return to_whole<std::size_t>(random.uniform() * static_cast<double>(count)); };
  std::vector<std::size_t> scored(std::min(count, kScored));
  for (std::size_t& i : scored) i = any();
  Vec3 direction = Vec3::Zero();
  std::size_t best = 0;
  for (int sample = 0; sample < kSamples; ++sample) {
    const Vec3 cross = elements.normal[any()].cross(elements.normal[any()]);
    if (cross.norm() < 0.2) continue;
    const Vec3 candidate = cross.normalized();
    std::size_t near = 0;
    for (const std::size_t i : scored) near += std::fabs(candidate.dot(elements.normal[i])) < 0.3 * kNearAngle ? 1 : 0;
    if (near > best) {
      best = near;
      direction = candidate;
    }
  }
  if (best == 0) refuse("its normals are all parallel, so that its direction is not determined");
  double scale = kNearAngle, inliers = 0.0, square = 0.0, second = 0.0;
  for (int round = 0; round < 20; ++round) {
    Mat3 matrix = Mat3::Zero();
    std::vector<double> sizes;
    double sum = 0.0, used = 0.0;
    inliers = square = 0.0;
    for (std::size_t i = 0; i < count; i += stride) {
      const double r = direction.dot(elements.normal[i]) / (4.685 * scale);
      sizes.push_back(std::fabs(r) * 4.685 * scale);
      used += 1.0;
      if (!(std::fabs(r) < 1.0)) continue;
      const double w = elements.weight[i] * (1.0 - r * r) * (1.0 - r * r);
      matrix += w * elements.normal[i] * elements.normal[i].transpose();
      sum += w;
      inliers += 1.0;
      square += sizes.back() * sizes.back();
    }
    if (!(sum > 0.0)) refuse("its normals have no common plane");
    Eigen::SelfAdjointEigenSolver<Mat3> eigen(matrix / sum);
    second = eigen.eigenvalues()[1];
    direction = eigen.eigenvectors().col(0);
    inliers /= used;
    square = std::sqrt(square / std::max(1.0, inliers * used));
    scale = std::clamp(1.4826 * median_of(sizes), kLeastScale, kNearAngle);
  }
  if (second < 1e-3) refuse("its normals are all parallel, so that its direction is not determined");
  if (inliers < kEnough || square > kNearAngle) refuse("its surface follows no common direction");
  return {{elements.centre, direction}, inliers, square};
}

}  // namespace treadmark::scans
