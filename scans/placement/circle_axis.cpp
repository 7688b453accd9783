// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/circle_axis.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/scans/placement/voxels.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kStrips = 24, kFewest = 12;
constexpr double kFlat = 0.25;  // least to middle variance of a wheel's points
constexpr int kRounds = 12;

struct Basis {
  Vec3 e1, e2;
};
Basis basis_of(const Vec3& direction) {
  const Vec3 e1 = direction.cross(std::fabs(direction.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
  return {e1, direction.cross(e1)};
}

/// Points sorted into strips along the direction, between its 2nd and 98th percentile.
std::vector<std::vector<Vec3>> strips_of(std::span<const Vec3> points, const Axis& axis) {
  std::vector<double> along;
  along.reserve(points.size());
  for (const Vec3& p : points) along.push_back((p - axis.point).dot(axis.direction));
  std::vector<double> values = along;
  const auto part = static_cast<std::ptrdiff_t>(values.size() / 50), last = std::ssize(values) - 1;
  std::nth_element(values.begin(), values.begin() + part, values.end());
  const double low = values[static_cast<std::size_t>(part)];
  std::nth_element(values.begin(), values.begin() + (last - part), values.end());
  const double high = values[static_cast<std::size_t>(last - part)];
  std::vector<std::vector<Vec3>> out(kStrips);
  if (!(high > low)) return out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double place = (along[i] - low) / (high - low) * kStrips;
    if (place >= 0.0 && place < static_cast<double>(kStrips)) out[static_cast<std::size_t>(place)].push_back(points[i]);
  }
  return out;
}

}  // namespace

double radius_scatter(std::span<const Vec3> points, const Axis& axis, double extent) {
  const std::vector<std::vector<Vec3>> strips = strips_of(points, axis);
  std::vector<double> scatters(strips.size(), -1.0);
  parallel_for(strips.size(), [&](std::size_t k) {
    if (strips[k].size() < kFewest) return;
    std::vector<double> r;
    r.reserve(strips[k].size());
    for (const Vec3& p : strips[k]) r.push_back((p - axis.point).cross(axis.direction).norm());
    const double level = median_of(r);
    for (double& value : r) value = std::fabs(value - level);
    scatters[k] = median_of(r);
  });
  std::erase_if(scatters, [](double scatter) { return scatter < 0.0; });
  return scatters.empty() ? extent : median_of(scatters);
}

std::optional<RoughAxis> circle_axis(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                     const SurfaceElements& elements) {
  // one point a cube, so that dense parts do not count more
  const Voxels voxels(points, elements.centre, elements.radius / 80.0, keep);
  std::vector<double> counts;
  for (std::size_t v = 0; v < voxels.count(); ++v) counts.push_back(static_cast<double>(voxels.points_of(v).size()));
  // nor outliers, which have nearly empty cubes of their own
  const double fewest = counts.empty() ? 0.0 : 0.2 * median_of(counts);
  std::vector<Vec3> thinned;
  for (std::size_t v = 0; v < voxels.count(); ++v)
    if (static_cast<double>(voxels.points_of(v).size()) >= fewest)
      thinned.push_back(points[voxels.points_of(v).front()]);
  std::erase_if(thinned, [&](const Vec3& p) { return (p - elements.centre).norm() > 1.5 * elements.radius; });
  if (thinned.size() < 10 * kFewest) return std::nullopt;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : thinned) mean += p;
  mean /= static_cast<double>(thinned.size());
  Mat3 square = Mat3::Zero();
  for (const Vec3& p : thinned) square += (p - mean) * (p - mean).transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> eigen(square);
  if (!(eigen.eigenvalues()[0] < kFlat * eigen.eigenvalues()[1])) return std::nullopt;
  RoughAxis out;
  out.axis = {mean, eigen.eigenvectors().col(0)};
  for (int round = 0; round < kRounds; ++round) {
    const Basis b = basis_of(out.axis.direction);
    // centre of a circle in every strip: linear least squares (Kasa 1976), twice without what lies far off
    std::vector<std::vector<Vec3>> strips = strips_of(thinned, out.axis);
    std::vector<std::optional<Vec3>> centre_of(strips.size());
    parallel_for(strips.size(), [&](std::size_t number) {
      std::vector<Vec3>& strip = strips[number];
      for (int trim = 0; trim < 3 && strip.size() >= kFewest; ++trim) {
        Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
        Vec3 rhs = Vec3::Zero();
        double place = 0.0;
        for (const Vec3& p : strip) {
          const double x = (p - out.axis.point).dot(b.e1), y = (p - out.axis.point).dot(b.e2);
          const Vec3 row(x, y, 1.0);
          matrix += row * row.transpose();
          rhs += row * (x * x + y * y);
          place += (p - out.axis.point).dot(out.axis.direction);
        }
        const Vec3 c = matrix.ldlt().solve(rhs);
        const double cx = 0.5 * c.x(), cy = 0.5 * c.y(), r = std::sqrt(std::max(0.0, c.z() + cx * cx + cy * cy));
        if (trim == 2) {
          centre_of[number] = Vec3(cx, cy, place / static_cast<double>(strip.size()));
          break;
        }
        std::vector<double> off;
        off.reserve(strip.size());
        const auto distance = [&](const Vec3& p) {
          return std::fabs(std::hypot((p - out.axis.point).dot(b.e1) - cx, (p - out.axis.point).dot(b.e2) - cy) - r);
        };
        for (const Vec3& p : strip) off.push_back(distance(p));
        const double limit = 4.0 * 1.4826 * median_of(off) + 1e-6 * elements.radius;
        std::erase_if(strip, [&](const Vec3& p) { return distance(p) > limit; });
      }
    });
    std::vector<Vec3> centres;
    centres.reserve(strips.size());
    for (const std::optional<Vec3>& centre : centre_of)
      if (centre) centres.push_back(*centre);
    if (centres.size() < 4) return std::nullopt;
    // a line through the centres, without the worst ones
    for (int trim = 0; trim < 3; ++trim) {
      Eigen::Matrix2d m = Eigen::Matrix2d::Zero();
      Eigen::Matrix2d rhs = Eigen::Matrix2d::Zero();
      for (const Vec3& c : centres) {
        const Vec2 row(1.0, c.z());
        m += row * row.transpose();
        rhs += row * c.head<2>().transpose();
      }
      const Eigen::Matrix2d line = m.ldlt().solve(rhs);  // rows: at 0, slope
      if (trim == 2) {
        out.axis.point += b.e1 * line(0, 0) + b.e2 * line(0, 1);
        out.axis.direction = (out.axis.direction + b.e1 * line(1, 0) + b.e2 * line(1, 1)).normalized();
        break;
      }
      std::vector<double> off;
      off.reserve(centres.size());
      const auto distance = [&](const Vec3& c) {
        return std::hypot(c.x() - line(0, 0) - c.z() * line(1, 0), c.y() - line(0, 1) - c.z() * line(1, 1));
      };
      for (const Vec3& c : centres) off.push_back(distance(c));
      const double limit = 4.0 * median_of(off) + 1e-9 * elements.radius;
      std::erase_if(centres, [&](const Vec3& c) { return distance(c) > limit; });
      if (centres.size() < 4) return std::nullopt;
    }
  }
  out.residual = radius_scatter(thinned, out.axis, elements.radius);
  out.inliers = 1.0;
  return out;
}

}  // namespace treadmark::scans
