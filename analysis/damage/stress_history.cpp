// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/stress_history.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::damage {
namespace {

/// Deviators in coordinates in which their length is sqrt(2 J2): xx, yy, zz, and sqrt(2) times xy, xz, yz.
using Deviator = Eigen::Matrix<double, 6, 1>;

Deviator deviator(const Mat3& stress) {
  const double mean = stress.trace() / 3.0, root = std::sqrt(2.0);
  return {stress(0, 0) - mean, stress(1, 1) - mean, stress(2, 2) - mean,
          root * stress(0, 1), root * stress(0, 2), root * stress(1, 2)};
}

/// Half the difference of the outer principal stresses.
double largest_shear(const Deviator& s) {
  const double root = std::sqrt(0.5);
  Mat3 m;
  m << s[0], root * s[3], root * s[4], root * s[3], s[1], root * s[5], root * s[4], root * s[5], s[2];
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(m, Eigen::EigenvaluesOnly).eigenvalues();
  return 0.5 * (principal[2] - principal[0]);
}

struct Ball {
  Deviator centre = Deviator::Zero();
  double square = -1.0;            ///< of the radius; < 0: holds nothing
  std::vector<Deviator> touching;  ///< points that make it

  bool holds(const Deviator& p) const {
    constexpr double kRounding = 1e-10;
    return (p - centre).squaredNorm() <= (1.0 + kRounding) * square;
  }
};

/// The smallest ball that has all these points on its surface.
Ball ball_through(const std::vector<Deviator>& points) {
  Ball ball;
  ball.touching = points;
  if (points.empty()) return ball;
  const auto n = static_cast<Eigen::Index>(points.size()) - 1;
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6> edges(6, n);
  for (Eigen::Index i = 0; i < n; ++i) edges.col(i) = points[static_cast<std::size_t>(i) + 1] - points.front();
  Deviator to_centre = Deviator::Zero();
  if (n > 0)
    to_centre =
        edges.transpose().completeOrthogonalDecomposition().solve(0.5 * edges.colwise().squaredNorm().transpose());
  ball.centre = points.front() + to_centre;
  ball.square = to_centre.squaredNorm();
  return ball;
}

/// The smallest ball round the first count of some points that has others on its surface (Welzl 1991).
Ball ball_round(const std::vector<Deviator>& points, std::size_t count, const std::vector<Deviator>& on_surface) {
  constexpr std::size_t kMost = 7;  // points that make a ball in six dimensions
  Ball ball = ball_through(on_surface);
  for (std::size_t i = 0; i < count && on_surface.size() < kMost; ++i)
    if (!ball.holds(points[i])) {
      std::vector<Deviator> more = on_surface;
      more.push_back(points[i]);
      ball = ball_round(points, i, more);
    }
  return ball;
}

/// The smallest ball round points: that of the few that touch it, with the farthest one of the others added until
/// none is outside (Gaertner 1999).
Ball smallest_ball(const std::vector<Deviator>& points) {
  constexpr int kMostSteps = 1000;
  Ball ball = ball_through({points.front()});
  for (int step = 0; step < kMostSteps; ++step) {
    const auto far =
        ranges::max_element(points, {}, [&](const Deviator& p) { return (p - ball.centre).squaredNorm(); });
    if (ball.holds(*far)) break;
    std::vector<Deviator> few = ball.touching;
    few.insert(few.begin(), *far);
    const Ball larger = ball_round(few, few.size(), {});
    if (!(larger.square > ball.square)) {  // as good as rounding allows: enclose for certain
      ball.square = (*far - ball.centre).squaredNorm();
      break;
    }
    ball = larger;
  }
  return ball;
}

/// The change of stress between two instants turns on one plane with its largest shear.
double largest_amplitude(const std::vector<Deviator>& points) {
  double longest = 0.0, largest = 0.0;
  Deviator first = Deviator::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (const Deviator change = points[i] - points[k]; change.squaredNorm() > longest)
        longest = change.squaredNorm(), first = change;
  largest = 0.5 * largest_shear(first);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Deviator change = points[i] - points[k];
      // no shear is more than sqrt(J2)
      if (0.5 * change.squaredNorm() > 4.0 * largest * largest)
        largest = std::max(largest, 0.5 * largest_shear(change));
    }
  return largest;
}

/// Residual stresses xx, yy and xy move the centre in all coordinates but xz and yz. Those are kept as a distance that
/// points and their mirror images have from where the centre may be.
double least_yield(const std::vector<Deviator>& points) {
  std::vector<Deviator> mirrored;
  mirrored.reserve(2 * points.size());
  for (const Deviator& p : points)
    for (const double side : {-1.0, 1.0}) {
      Deviator q = p;
      q[4] = side * std::hypot(p[4], p[5]);
      q[5] = 0.0;
      mirrored.push_back(q);
    }
  return std::sqrt(0.5 * smallest_ball(mirrored).square);
}

}  // namespace

StressMeasures stress_measures(std::span<const Mat3> history, double dang_van_slope) {
  std::vector<Deviator> points{Deviator::Zero()};
  points.reserve(history.size() + 1);
  for (const Mat3& stress : history) points.push_back(deviator(stress));
  StressMeasures out;
  for (const Deviator& p : points) out.von_mises = std::max(out.von_mises, std::sqrt(1.5 * p.squaredNorm()));
  out.shear = largest_amplitude(points);
  out.shakedown = least_yield(points);
  const Deviator middle = smallest_ball(points).centre;
  out.dang_van = largest_shear(points.front() - middle);
  for (std::size_t i = 0; i < history.size(); ++i)
    out.dang_van =
        std::max(out.dang_van, largest_shear(points[i + 1] - middle) + dang_van_slope * history[i].trace() / 3.0);
  return out;
}

}  // namespace treadmark::damage
