// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/thb/fit_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {
namespace {

/// What a sum of squares of n independent normal numbers of variance 1 hardly ever exceeds (Wilson and Hilferty 1931).
double hardly_exceeded(double n) {
  constexpr double kDeviations = 3.5;
  const double q = 2.0 / (9.0 * n);
  return n * std::pow(1.0 - q + kDeviations * std::sqrt(q), 3);
}

Vec3 normal_in_the_middle(const ThbPiece& b, int degree) {
  const auto p = static_cast<std::size_t>(degree);
  const KnotWeights w = bernstein_values(degree, 0.5), d = bernstein_values(degree - 1, 0.5);
  Vec3 along = Vec3::Zero(), across = Vec3::Zero();
  for (std::size_t i = 0; i < p; ++i)
    for (std::size_t j = 0; j <= p; ++j) {
      along += (d[i] * w[j]) * (b[i + 1][j] - b[i][j]);
      across += (d[i] * w[j]) * (b[j][i + 1] - b[j][i]);
    }
  const Vec3 normal = along.cross(across);
  const double length = normal.norm();
  return length > 0.0 ? Vec3(normal / length) : Vec3(0.0, 0.0, 1.0);
}

}  // namespace

KnotWeights bernstein_values(int degree, double s) {
  const double r = 1.0 - s;
  if (degree == 3) return {r * r * r, 3.0 * r * r * s, 3.0 * r * s * s, s * s * s};
  if (degree == 2) return {r * r, 2.0 * r * s, s * s, 0.0};
  if (degree == 1) return {r, s, 0.0, 0.0};
  return {1.0, 0.0, 0.0, 0.0};
}

int FitLine::half(int from, int to) const {
  const bool outer = !closed() && (from == 0 || to == last());
  return to - from >= 2 * std::max(least, outer ? least_outer : 1) ? (from + to) / 2 : 0;
}

std::vector<int> FitLine::even(int intervals, int degree) const {
  const int most = std::max(1, last() / std::max(least, least_outer));
  const int n = std::clamp(intervals, closed() ? std::min(degree + 1, last()) : 1, std::max(most, 1));
  std::vector<int> out;
  for (int i = 0; i <= n; ++i) out.push_back(static_cast<int>(static_cast<long>(i) * last() / n));
  return out;
}

std::vector<int> FitLine::halved(const std::vector<int>& breaks, int limit) const {
  std::vector<int> out{0};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const int middle = breaks[i + 1] - breaks[i] > limit ? half(breaks[i], breaks[i + 1]) : 0;
    if (middle > 0) out.push_back(middle);
    out.push_back(breaks[i + 1]);
  }
  return out;
}

KnotLine FitLine::knots(int degree, const std::vector<int>& breaks) const {
  std::vector<double> places;
  places.reserve(breaks.size());
  for (const int b : breaks) places.push_back(place(b));
  return closed() ? KnotLine::periodic(degree, places) : KnotLine::open(degree, places);
}

Eigen::Matrix4d second_differences(int degree) {
  Eigen::Matrix4d out = Eigen::Matrix4d::Zero();
  const Eigen::Vector3d d(1.0, -2.0, 1.0);
  for (int k = 0; k + 1 < degree; ++k) out.block<3, 3>(k, k) += d * d.transpose();
  return out;
}

double median_of(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Remainder RemainderSum::result() const {
  Remainder out = out_;
  for (std::size_t k = 0; k < off_.size(); ++k) {
    if (points_[k] == 0) continue;
    out.parts += off_[k] * off_[k] / points_[k];
    ++out.filled_parts;
    out.points += points_[k];
  }
  return out;
}

bool FitTolerance::exceeded(const Remainder& left) const {
  if (!left.beyond) return false;
  if (!noisy()) return true;
  // against what points of one part differ by: noise need not be the same everywhere
  const auto points = static_cast<double>(left.points), parts = static_cast<double>(left.filled_parts);
  return points > parts && left.parts > (left.sum - left.parts) / (points - parts) * hardly_exceeded(parts);
}

FitPoints::FitPoints(const sampling::PointGrid& grid, int degree)
    : u_{grid.u, grid.closed ? 2.0 * std::numbers::pi : 0.0, 4 - degree, 2},
      v_{chord_lengths(grid), 0.0, 4 - degree, 2},
      columns_(static_cast<int>(grid.y.size())) {
  // quadratic splines cannot go through points at all of their knots: two points to each of their intervals
  points_.reserve(grid.h.size());
  for (std::size_t i = 0; i < grid.u.size(); ++i)
    for (std::size_t j = 0; j < grid.y.size(); ++j) points_.push_back(grid.point(i, j));
  doubt_.assign(points_.size(), 0.0f);
  const int nu = static_cast<int>(grid.u.size()), nv = static_cast<int>(grid.y.size());
  const auto add_doubt = [&](int lines, int along, std::size_t step_line, std::size_t step, bool round) {
    for (int l = 0; l < lines; ++l)
      for (int i = 0; i < along; ++i) {
        const int first = round ? i - 2 : std::clamp(i - 2, 0, along - 5);
        const auto at = [&](int k) {
          return points_[static_cast<std::size_t>(l) * step_line +
                         static_cast<std::size_t>((first + k + along) % along) * step];
        };
        const double off = degree == 3 ? (at(0) - 4.0 * at(1) + 6.0 * at(2) - 4.0 * at(3) + at(4)).norm() / 384.0
                                       : std::max((at(3) - 3.0 * at(2) + 3.0 * at(1) - at(0)).norm(),
                                                  (at(4) - 3.0 * at(3) + 3.0 * at(2) - at(1)).norm()) /
                                             16.0;
        doubt_[static_cast<std::size_t>(l) * step_line + static_cast<std::size_t>(i) * step] += static_cast<float>(off);
      }
  };
  if (nu >= 5) add_doubt(nv, nu, 1, grid.y.size(), grid.closed);
  if (nv >= 5) add_doubt(nu, nv, grid.y.size(), 1, false);
}

FitPoints::FitPoints(std::vector<double> u, std::vector<double> v, std::vector<Vec3> points, bool closed,
                     double length_of_u, double points_a_place) {
  const auto [u_low, u_high] = std::minmax_element(u.begin(), u.end());
  const auto [v_low, v_high] = std::minmax_element(v.begin(), v.end());
  const double from_u = closed ? -std::numbers::pi : *u_low, width_v = *v_high - *v_low;
  const double width_u = closed ? 2.0 * std::numbers::pi : *u_high - from_u;
  const double step = std::sqrt(width_u * length_of_u * width_v * points_a_place / static_cast<double>(points.size()));
  const int rows = std::max(1, to_whole<int>(width_u * length_of_u / step));
  columns_ = std::max(1, to_whole<int>(width_v / step));
  const auto places = [](double from, double width, int steps, bool round) {
    std::vector<double> out;
    out.reserve(static_cast<std::size_t>(steps) + 1);
    for (int i = 0; i < steps + (round ? 0 : 1); ++i) out.push_back(from + width * i / steps);
    return out;
  };
  u_.at = places(from_u, width_u, rows, closed);
  u_.period = closed ? width_u : 0.0;
  v_.at = places(*v_low, width_v, columns_, false);
  const auto cell = [&](std::size_t k) {
    const int i = std::clamp(to_whole<int>((u[k] - from_u) / width_u * rows), 0, rows - 1),
              j = std::clamp(to_whole<int>((v[k] - v_.at.front()) / width_v * columns_), 0, columns_ - 1);
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(j);
  };
  begin_.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns_) + 1, 0);
  for (std::size_t k = 0; k < points.size(); ++k) ++begin_[cell(k) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  at_u_.resize(points.size()), at_v_.resize(points.size()), points_.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t to = next[cell(k)]++;
    at_u_[to] = u[k], at_v_[to] = v[k], points_[to] = points[k];
  }
}

std::size_t FitPoints::count(const Block& block) const {
  if (!scattered())
    return static_cast<std::size_t>(block.i1 - block.i0) * static_cast<std::size_t>(block.j1 - block.j0);
  std::size_t sum = 0;
  for (int i = block.i0; i < block.i1; ++i) {
    const std::size_t row = static_cast<std::size_t>(i) * static_cast<std::size_t>(columns_);
    sum += begin_[row + static_cast<std::size_t>(block.j1)] - begin_[row + static_cast<std::size_t>(block.j0)];
  }
  return sum;
}

CellSums FitPoints::sums(const Block& block, const ThbRange& range, int degree, const ThbPiece& piece, double allowed,
                         bool only_left) const {
  CellSums out;
  out.moments.setZero();
  out.right.setZero();
  Eigen::Matrix<double, 16, 3> control;
  for (std::size_t k = 0; k < 16; ++k) control.row(static_cast<Eigen::Index>(k)) = piece[k / 4][k % 4].transpose();
  const Vec3 normal = normal_in_the_middle(piece, degree);
  const double per_u = 1.0 / (range.u1 - range.u0), per_v = 1.0 / (range.v1 - range.v0);
  RemainderSum sum;
  Eigen::Matrix<double, 16, 1> b;
  each(block, [&](std::size_t place, double u, double v, const Vec3& point) {
    const double s = (u - range.u0) * per_u, t = (v - range.v0) * per_v;
    const KnotWeights along = bernstein_values(degree, s), across = bernstein_values(degree, t);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) b[static_cast<Eigen::Index>(4 * i + j)] = along[i] * across[j];
    const Vec3 left = point - control.transpose() * b;
    sum.add(left.squaredNorm(), normal.dot(left), std::max(allowed, doubt(place)), s, t);
    if (only_left) return;
    out.right += b * left.transpose();
    if (scattered()) out.moments.selfadjointView<Eigen::Lower>().rankUpdate(b);
  });
  out.left = sum.result();
  if (only_left) return out;
  if (scattered()) {
    out.moments.triangularView<Eigen::StrictlyUpper>() = out.moments.transpose();
    return out;
  }
  const auto line_moments = [&](const FitLine& line, int from, int to, double low, double per) {
    Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
    for (int i = from; i < to; ++i) {
      const KnotWeights w = bernstein_values(degree, (line.place(i) - low) * per);
      const Eigen::Vector4d values(w[0], w[1], w[2], w[3]);
      m += values * values.transpose();
    }
    return m;
  };
  const Eigen::Matrix4d of_u = line_moments(u_, block.i0, block.i1, range.u0, per_u),
                        of_v = line_moments(v_, block.j0, block.j1, range.v0, per_v);
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index k = 0; k < 4; ++k) out.moments.block<4, 4>(4 * i, 4 * k) = of_u(i, k) * of_v;
  return out;
}

}  // namespace treadmark::spline
